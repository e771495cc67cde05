#!/usr/bin/env bash
# Installs the build tree $1 in the folder $2 and uses the Python package from there, with the interpreter $3.
set -euo pipefail
build="$1" work="$2" python="$3"
launcher="$(dirname "$(readlink -f "$0")")/../../python/launcher/slipfront"
rm -rf "$work"
cmake --install "$build" --prefix "$work" >/dev/null
unset PYTHONPATH
cd "$work"
PYTHONPATH="$work/lib/python3/dist-packages" "$python" -c "
import slipfront
assert slipfront.__file__.startswith('$work'), slipfront.__file__
assert abs(float(slipfront.relations(stress=1.03).slip_velocity) - 0.1000039) < 1e-7
assert slipfront.check(slipfront.cases / 'step.toml')['cells'] == 400
assert slipfront.event().sizes['event'] > 40
"
# The program must find its Python package. If it does, the error about the missing file comes from Python, and the
# program does not suggest to install pybind11-dev.
if ./bin/slipfront plot /nowhere.nc 2>errors; then exit 1; fi
! grep -q pybind11-dev errors
# The package hands commands in C++ to the program, and the launcher of a wheel starts the program in the package.
PYTHONPATH="$work/lib/python3/dist-packages" "$python" -m slipfront relations --stress 1.03 >answer
grep -q '^rupture_velocity *0\.5439026' answer
mkdir -p site/slipfront/bin
touch site/slipfront/__init__.py
ln -s "$work/bin/slipfront" site/slipfront/bin/slipfront
PYTHONPATH="$work/site" "$python" "$launcher" --version --json >facts
grep -q "\"python\":\"$python\"" facts
if PYTHONPATH= "$python" -P "$launcher" --version 2>errors; then exit 1; fi
grep -q 'pip install' errors
