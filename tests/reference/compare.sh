#!/usr/bin/env bash
# The committed tables are what the script makes.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
for table in "$here"/*.csv; do cmp "$table" "$1/$(basename "$table")"; done
