"""Writes the table of friction ratios as whole numbers and powers of ten, half the size of doubles: pack_table.py IN OUT.

A mantissa of up to 15 digits and a power of ten up to 1e22 are exact doubles, so their quotient is the double that the
decimal number means."""

import re
import sys

with open(sys.argv[1], encoding="ascii") as file:
    text = file.read()
tables = re.findall(r"const layout::(\w+) (\w+) = (.*?);", text, re.DOTALL)
lines = ["// Made from src/friction_ratio/coefficients.cpp.", '#include "unpack_table.hpp"', "namespace slipfront::friction_ratio {"]
for kind, name, body in tables:
    mantissas, powers = [], []
    for sign, whole, decimals, exponent in re.findall(r"([-+]?)(\d+)\.?(\d*)(?:e([-+]?\d+))?", body):
        mantissas.append(sign + str(int(whole + decimals)))
        powers.append(int(exponent or 0) - len(decimals))
        if abs(int(mantissas[-1])) >= 2**31 or not -22 <= powers[-1] <= 22:
            sys.exit(f"pack_table.py: {sign}{whole}.{decimals}e{exponent} is none of the numbers that this is for")
    lines.append(f"static const std::int32_t {name}_mantissas[] = {{{','.join(mantissas)}}};")
    lines.append(f"static const std::int8_t {name}_powers[] = {{{','.join(map(str, powers))}}};")
    lines.append(f"const layout::{kind} {name} = unpacked<layout::{kind}>({name}_mantissas, {name}_powers);")
lines.append("}")
with open(sys.argv[2], "w", encoding="ascii") as file:
    file.write("\n".join(lines) + "\n")
