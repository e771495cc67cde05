#!/usr/bin/env bash
# The committed tables are what the script makes.
set -euo pipefail
here="$(dirname "$(readlink -f "$0")")"
for table in "$here"/*.csv; do cmp "$table" "$1/$(basename "$table")"; done
