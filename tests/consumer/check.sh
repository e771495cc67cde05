#!/usr/bin/env bash
# Installs the build tree $1 in the folder $2. Then builds the project in the folder of this script with the compiler $3
# against the installed library, and runs it.
set -euo pipefail
build="$1" work="$2" compiler="$3"
here="$(dirname "$(readlink -f "$0")")"
rm -rf "$work"
cmake --install "$build" --prefix "$work/prefix" >/dev/null
# The project includes all public headers, which must compile without the headers of src/.
mkdir "$work/generated"
(cd "$work/prefix/include" && find slipfront -name '*.hpp' -printf '#include "%p"\n') | sort >"$work/generated/all_headers.hpp"
cmake -G Ninja -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="-I$work/generated" >/dev/null
cmake --build "$work/build" >/dev/null
"$work/build/consumer"
"$work/prefix/bin/slipfront" relations --stress 1.03 --csv >/dev/null
