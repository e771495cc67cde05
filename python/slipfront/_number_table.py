"""Reads tables of numbers, such as the record of an experiment, into columns in SI units."""

import csv
import dataclasses
import math
import re
import tomllib
from typing import Any

from . import _slipfront
from ._event import column_map
from ._messages import shown
from ._numbers import np
from ._population.fronts import text_of
from ._slipfront import InputError

#: Words that are no part of the name of a quantity.
_FILLING = {"the", "of", "measured", "mean", "at"}

#: A unit of each dimension, for messages.
_EXAMPLES = {"time": "s", "length": "um", "pressure": "MPa"}


@dataclasses.dataclass(frozen=True)
class Quantity:
    """A quantity that a column may give: its dimension as the readers of events name it ("" for a
    text), and its titles."""

    dimension: str
    titles: tuple[str, ...]
    required: bool = True


@dataclasses.dataclass
class Columns:
    file: str
    values: dict[str, Any]  # arrays in SI units; lists of texts for a quantity without dimension
    notes: list[str]


def _plain(title):
    """Returns the words of a title in lower case, joined by single blanks."""
    return " ".join(
        word for word in re.split(r"[\s_]+", title.strip().lower()) if word not in _FILLING
    )


def _factor(unit, dimension, file, line, title):
    return _slipfront.parse_measured(f"1 {unit}", dimension, "", file, line, title).middle


def _meaning(title, quantities):
    """Returns (quantity, unit) of a title such as `shear stress [MPa]` or `time_s`; (None, "") if
    it is none of them."""
    found = re.fullmatch(r"(.*?)\s*[\[(](.*)[\])]\s*", title)
    candidates = [found.groups()] if found else [(title, "")]
    if not found and "_" in title:
        words = title.split("_")
        candidates += [
            ("_".join(words[:-n]), "/".join(words[-n:])) for n in (1, 2) if len(words) > n
        ]
    for name, unit in candidates:
        for key, quantity in quantities.items():
            if _plain(name) in quantity.titles or _plain(name) == _plain(key):
                return key, unit
    return None, ""


def _mapped(columns, quantities):
    """Returns {title: (quantity, unit)} of a map of columns. Raises InputError for a meaning that
    is none."""
    text, file = column_map(columns)
    if file:
        text = _slipfront.read_text(file)
    if not text:
        return {}
    try:
        given = tomllib.loads(text).get("columns", {})
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{shown(file or 'columns')}: {error}") from None
    found = {}
    for title, meaning in given.items():
        words = str(meaning).split()
        name = next(
            (
                key
                for key in sorted(quantities, key=len, reverse=True)
                if _plain(str(meaning)).startswith(_plain(key))
            ),
            None,
        )
        if meaning != "ignore" and name is None:
            raise InputError(
                f"{shown(file or 'columns')}: {shown(title)} = '{shown(meaning)}': no quantity of"
                f" this table; allowed: {', '.join(quantities)} with a unit, or ignore"
            )
        found[title.strip()] = (name, " ".join(words[len(name.split()) :])) if name else (None, "")
    return found


def _separator(line):
    return next((mark for mark in "\t;," if mark in line), " ")


def _cells(line, separator):
    return (
        line.split()
        if separator == " "
        else [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    )


def _number(cell):
    try:
        return float(cell)
    except ValueError:
        return math.nan


def _columns_of(titles, line, file, quantities, mapped):
    """Returns {quantity: (index, factor)}."""
    found = {}
    for i, title in enumerate(titles):
        name, unit = mapped[title] if title in mapped else _meaning(title, quantities)
        if name is None or name in found:
            continue
        dimension = quantities[name].dimension
        if dimension and not unit:
            raise InputError(
                f"{shown(file)}:{line}: {shown(title)}: no unit; allowed: a unit in the title, such"
                f" as '{shown(title)} [{_EXAMPLES[dimension]}]'"
            )
        found[name] = (i, _factor(unit, dimension, file, line, title) if dimension else 1.0)
    for name, quantity in quantities.items():
        if quantity.required and name not in found:
            raise InputError(
                f"{shown(file)}:{line}: {name}: the table has no such column; allowed: a title such"
                f" as '{quantity.titles[0]}' with its unit, or a map (--columns)"
            )
    return found


def read_numbers(table, quantities, columns=None):
    """Returns the Columns of a path, a text, a dict of columns or a DataFrame. Raises InputError if
    the header is unusable or no row has numbers."""
    text, file = text_of(table)
    lines = [
        (number, line)
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith(("#", "%"))
    ]
    if not lines:
        raise InputError(
            f"{shown(file)}: the table is empty; allowed: a header line with units and rows of"
            " numbers"
        )
    number, header = lines[0]
    found = _columns_of(
        _cells(header, _separator(header)), number, file, quantities, _mapped(columns, quantities)
    )
    separator = _separator(lines[-1][1])
    rows, bad = [], []
    for number, line in lines[1:]:
        cells = _cells(line, separator)
        row = [cells[i] if i < len(cells) else "" for i, _ in found.values()]
        values = [
            cell if not quantities[name].dimension else _number(cell) * factor
            for cell, (name, (_, factor)) in zip(row, found.items())
        ]
        if any(quantities[name].required and value != value for value, name in zip(values, found)):
            bad.append(number)
        else:
            rows.append(values)
    if not rows:
        raise InputError(
            f"{shown(file)}: no row has all of"
            f" {', '.join(name for name, q in quantities.items() if q.required)}; allowed: one"
            " number in each of these columns"
        )
    notes = (
        [
            f"{shown(file)}: rows without all numbers, left out: {len(bad)}, the first in line"
            f" {bad[0]}"
        ]
        if bad
        else []
    )
    columns_of_rows = dict(zip(found, zip(*rows)))
    return Columns(
        file,
        {
            name: np.array(values) if quantities[name].dimension else list(values)
            for name, values in columns_of_rows.items()
        },
        notes,
    )
