"""Packs the tables of coefficients for the page: pack_table.py FOLDER OUT, with the folder src/friction/ratio.

A coefficient becomes a whole multiple of a quantum: 1e-8 for a table of doubles, which is far below the error of the
tables, and 1 for a table of whole numbers. The numbers are written in bytes, seven bits each, so that a small one has one
byte. Of the tables of observed fronts and stress drops, only the first half is kept, that of the closure "consistent",
because the page has no other closure for them; unpack_table.hpp makes the rest useless on purpose."""

import pathlib
import sys

#: File of numbers -> its type.
TABLES = {"coefficients": "layout::Table", "corners": "layout::Corners", "front_coefficients": "front_layout::FrontTable",
          "drop_coefficients": "front_layout::DropTable"}
QUANTUM = 1e-8


def packed(numbers):
    """The bytes of whole numbers. The sign is the lowest bit."""
    data = []
    for number in numbers:
        rest = 2 * number if number >= 0 else -2 * number - 1
        while rest >= 128:
            data.append(rest & 127 | 128)
            rest >>= 7
        data.append(rest)
    return data


lines = ["// Made by pack_table.py.", '#include "unpack_table.hpp"', "namespace slipfront::friction_ratio {"]
for name, kind in TABLES.items():
    found = (pathlib.Path(sys.argv[1]) / f"{name}.csv").read_text(encoding="ascii").replace("\n", "").rstrip(",").split(",")
    doubles = kind.startswith("layout")
    values = [round(float(number) / QUANTUM) for number in found] if doubles else [int(number) for number in found[:len(found) // 2]]
    lines.append(f"static const unsigned char {name}_bytes[] = {{{','.join(map(str, packed(values)))}}};")
    unpack = f"unpacked_doubles<{kind}>({name}_bytes, {QUANTUM})" if doubles else f"unpacked_half<{kind}>({name}_bytes)"
    lines.append(f"const {kind} {name} = {unpack};")
lines.append("}")
pathlib.Path(sys.argv[2]).write_text("\n".join(lines) + "\n", encoding="ascii")
