"""Reads tables of laboratory fronts: one front a row, with its shear stress, normal stress and velocity."""

import csv
import dataclasses
import io
import math
import re
from collections.abc import Mapping
from typing import Any

from . import _slipfront
from ._scenario import is_path, path
from ._shown import shown
from ._slipfront import InputError

#: Titles of the columns, and the quantity of each.
TITLES = {"tau": "shear_stress", "shear_stress": "shear_stress", "sigma_n": "normal_stress", "normal_stress": "normal_stress",
          "front_velocity": "front_velocity", "rupture_velocity": "front_velocity", "stress_drop": "stress_drop"}
REQUIRED = ("shear_stress", "normal_stress", "front_velocity")
NAMES = ("name", "front", "event")
MISSING = ("", "-", "nan", "n/a", "na")
_TITLE = re.compile(rf"\s*({'|'.join(sorted(TITLES, key=len, reverse=True))})(_err|_error|_sd)?(?:\s*[\[(]\s*([^\])]*?)\s*[\])]|_(\w+))?\s*", re.IGNORECASE)


@dataclasses.dataclass
class Front:
    """One row of the table. Quantities are Measured values in SI units."""

    name: str
    line: int
    shear_stress: Any
    normal_stress: Any
    front_velocity: Any
    stress_drop: Any = None


@dataclasses.dataclass
class Column:
    title: str
    quantity: str
    is_error: bool
    unit: str

    @property
    def dimension(self):
        return "velocity" if self.quantity == "front_velocity" else "pressure"


@dataclasses.dataclass
class Table:
    file: str
    fronts: list[Front]
    errors: list[str]  # one line for each row that could not be read
    ignored_columns: list[str]


def _column(title, file, line):
    """Returns the Column of a title, or None if it is no quantity of a front."""
    found = _TITLE.fullmatch(title)
    if not found:
        return None
    unit = found[3] or (found[4] or "").replace("_", "/")
    column = Column(title.strip(), TITLES[found[1].lower()], bool(found[2]), unit)
    if unit:
        _slipfront.check_unit(unit, column.dimension, file, line, column.title)
    return column


def _header(titles, file, line):
    """Returns the Column of each title, and the index of the column of names, or None."""
    columns = [_column(title, file, line) for title in titles]
    have = [(column.quantity, column.is_error) for column in columns if column]
    for one in dict.fromkeys(have):
        if have.count(one) > 1:
            _slipfront.refuse(file, line, one[0], "", "the quantity has two columns", "one column for each quantity")
    for quantity in REQUIRED:
        if (quantity, False) not in have:
            titles_of = [title for title, name in TITLES.items() if name == quantity]
            _slipfront.refuse(file, line, quantity, "", "the table has no such column", f"a column {' or '.join(titles_of)} with its unit")
    return columns, next((i for i, title in enumerate(titles) if title.strip().lower() in NAMES), None)


def _texts(columns, cells):
    """Returns {quantity: (text, column)} of a row. A column of errors is joined to the value: "2.7" and "0.3" are "2.7 +- 0.3"."""
    texts = {column.quantity: (cell.strip(), column) for column, cell in zip(columns, cells) if column and not column.is_error}
    for column, cell in zip(columns, cells):
        if column and column.is_error and cell.strip().lower() not in MISSING:
            text, value = texts.get(column.quantity, ("", column))
            if column.unit and value.unit and column.unit != value.unit:
                raise InputError(f"{column.title}: its unit is not that of {value.title}; allowed: the same unit")
            texts[column.quantity] = (f"{text} +- {cell.strip()}", dataclasses.replace(value, unit=value.unit or column.unit))
    return texts


def _front(columns, cells, name, file, line):
    """Returns the Front of a row. Raises InputError."""
    if len(cells) != len(columns):
        _slipfront.refuse(file, line, "", "", f"the row has {len(cells)} {'cell' if len(cells) == 1 else 'cells'}", f"{len(columns)} cells, as in the header")
    values = {}
    for quantity, (text, column) in _texts(columns, cells).items():
        if text.lower() not in MISSING:
            values[quantity] = _slipfront.parse_measured(text, column.dimension, column.unit, file, line, column.title)
        elif quantity in REQUIRED:
            _slipfront.refuse(file, line, column.title, text, "no value", "a number with its unit")
    _check_stresses(values, file, line)
    drop = values.get("stress_drop")
    if drop is not None and drop.is_exact:
        _slipfront.refuse(file, line, "stress_drop", "", "a stress drop without an error", "an error, such as 0.20 +- 0.03 MPa")
    return Front(cells[name].strip() if name is not None and cells[name].strip() else f"line {line}", line, **values)


def _check_stresses(values, file, line):
    """Raises InputError for stresses or errors that no experiment has. Numbers would overflow further on."""
    for quantity in ("shear_stress", "normal_stress"):
        if not values[quantity].quantile(1 - 1e-10) < 1e9 * values[quantity].middle:
            _slipfront.refuse(file, line, quantity, "", "the error is too large", "a factor of 20 or less")
    ratio = values["shear_stress"].middle / values["normal_stress"].middle if values["normal_stress"].middle > 1e-9 * values["shear_stress"].middle else math.inf
    if not 1e-9 <= ratio <= 1e9:
        _slipfront.refuse(file, line, "shear_stress", "", f"it is {ratio:.3g} of the normal stress", "1e-9 to 1e9")


def _records(text):
    """Yields (line, cells) of the rows that are not empty and no comment. Commas, semicolons or tabs separate the cells."""
    lines = text.removeprefix("\ufeff").splitlines(keepends=True)
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    rows = csv.reader(lines, delimiter=max(",;\t", key=first.count))
    try:
        for cells in rows:
            if any(cell.strip() for cell in cells) and not cells[0].startswith("#"):
                yield rows.line_num, cells
    except csv.Error as error:
        raise InputError(f"line {rows.line_num}: {error}; allowed: a CSV table") from None


def _text_of(table):
    """Returns (text, name) of a table as the user gives it."""
    if isinstance(table, Mapping):
        try:
            lengths = {len(values) for values in table.values() if not isinstance(values, str)}
        except TypeError:
            lengths = set()
        if len(lengths) != 1 or any(isinstance(values, str) for values in table.values()):
            raise InputError("table: a dict whose values are not lists of one length; allowed: {'tau [MPa]': [1.2, 1.4], ...}")
        out = io.StringIO()
        csv.writer(out).writerows([list(table), *zip(*table.values())])
        return out.getvalue(), "table"
    if hasattr(table, "to_csv") and hasattr(table, "columns"):
        return table.to_csv(index=False), "table"
    if not is_path(table):
        if isinstance(table, str):
            return table, "table"
        raise InputError(f"table: a {type(table).__name__}; allowed: a path, the text of a CSV table, a dict of columns or a DataFrame")
    name = path("table", table)
    try:
        return _slipfront.read_text(name), name
    except UnicodeDecodeError:
        raise InputError(f"{shown(name)}: not UTF-8; allowed: a CSV table in UTF-8") from None


def read(table, strict=False):
    """Returns the Table of a path, a text, a dict of columns or a DataFrame. A row that cannot be read is an error of the Table.

    Raises InputError if the header is unusable or no row can be read; if `strict`, also for one bad row."""
    text, file = _text_of(table)
    found, columns, name, titles = Table(file, [], [], []), None, None, []
    for line, cells in _records(text):
        if columns is None:
            titles = cells
            columns, name = _header(cells, file, line)
            continue
        try:
            found.fronts.append(_front(columns, cells, name, file, line))
        except InputError as error:
            found.errors.append(str(error))
            if strict:
                raise
    if not found.fronts:
        raise InputError(found.errors[0] if found.errors else f"{shown(file)}: no front; allowed: a header line and one row a front")
    found.ignored_columns = [title.strip() for i, (title, column) in enumerate(zip(titles, columns or [])) if column is None and i != name]
    return found
