#!/usr/bin/env bash
# Checks that the committed tables equal those in the folder $1, which make_tables.py has just written.
set -euo pipefail
here="$(dirname "$(readlink -f "$0")")"
for table in "$here"/*.csv; do cmp "$table" "$1/$(basename "$table")"; done
