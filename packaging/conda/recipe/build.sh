#!/usr/bin/env bash
# conda-build runs this with PREFIX, SP_DIR, PYTHON and CMAKE_ARGS. Without MPI: a chain then runs in one process.
set -euo pipefail
cmake -S . -B build-conda -G Ninja ${CMAKE_ARGS} -DCMAKE_BUILD_TYPE=Release -DSLIPFRONT_TESTS=OFF -DSLIPFRONT_BENCH=OFF \
  -DSLIPFRONT_MPI=OFF -DSLIPFRONT_PYTHON=ON -DPython3_EXECUTABLE="${PYTHON}" -DSLIPFRONT_PYTHON_DIR="${SP_DIR#"${PREFIX}"/}"
cmake --build build-conda -j "${CPU_COUNT:-1}"
cmake --install build-conda
