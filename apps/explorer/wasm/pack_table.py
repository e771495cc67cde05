"""Packs a table of coefficients for the page: pack_table.py IN OUT.

A coefficient becomes a whole multiple of a quantum: 1e-8 for a table of doubles, which is far below the error of the
tables, and 1 for a table of whole numbers. The numbers are written in bytes, seven bits each, so that a small one has one
byte. Of the tables of observed fronts and stress drops, only the first half is kept, that of the closure "consistent",
because the page has no other closure for them; unpack_table.hpp makes the rest useless on purpose."""

import re
import sys

DOUBLES, WHOLE = "layout", "front_layout"
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


with open(sys.argv[1], encoding="ascii") as file:
    text = file.read()
lines = ["// Made by pack_table.py.", '#include "unpack_table.hpp"', "namespace slipfront::friction_ratio {"]
for space, kind, name, body in re.findall(r"const (layout|front_layout)::(\w+) (\w+) = (.*?);", text, re.DOTALL):
    found = re.findall(r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?", body)
    values = [round(float(number) / QUANTUM) for number in found] if space == DOUBLES else [int(number) for number in found[:len(found) // 2]]
    lines.append(f"static const unsigned char {name}_bytes[] = {{{','.join(map(str, packed(values)))}}};")
    unpack = f"unpacked_doubles<{space}::{kind}>({name}_bytes, {QUANTUM})" if space == DOUBLES else f"unpacked_half<{space}::{kind}>({name}_bytes)"
    lines.append(f"const {space}::{kind} {name} = {unpack};")
lines.append("}")
with open(sys.argv[2], "w", encoding="ascii") as file:
    file.write("\n".join(lines) + "\n")
