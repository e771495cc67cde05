#!/usr/bin/env bash
# Installs the build tree $1 below $2 and uses the package from there, with the interpreter $3.
set -euo pipefail
build="$1" work="$2" python="$3"
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
# The program finds its package: what it says of a file that is not there is said by Python.
if ./bin/slipfront plot /nowhere.nc 2>said; then exit 1; fi
! grep -q pybind11-dev said
