"""Reads tables of laboratory fronts: one row has shear and normal stress and velocity."""

import dataclasses
import math
from typing import Any

from .. import _slipfront
from .._event import column_map, source
from .._messages import shown
from .._slipfront import InputError

REQUIRED = ("shear_stress", "normal_stress", "rupture_velocity")


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
class Table:
    file: str
    fronts: list[Front]
    errors: list[str]  # one line for each row that could not be read
    ignored_columns: list[str]
    notes: list[str]


def _check_complete(front, file):
    """Raises InputError for a front that lacks a value, or has only a bound."""
    for quantity in ("shear_stress", "normal_stress", "front_velocity"):
        if getattr(front, quantity) is None:
            _slipfront.refuse(file, front.line, quantity, "", "no value", "a number with its unit")


def _check_stresses(front, file):
    """Raises InputError for stresses or errors that no experiment has and that overflow."""
    for quantity in ("shear_stress", "normal_stress"):
        value = getattr(front, quantity)
        if not value.quantile(1 - 1e-10) < 1e9 * value.middle:
            _slipfront.refuse(file, front.line, quantity, "", "the error is too large",
                              "a factor of 20 or less")
    shear, normal = front.shear_stress.middle, front.normal_stress.middle
    ratio = shear / normal if normal > 1e-9 * shear else math.inf
    if not 1e-9 <= ratio <= 1e9:
        _slipfront.refuse(file, front.line, "shear_stress", "",
                          f"it is {ratio:.3g} of the normal stress", "1e-9 to 1e9")


def text_of(table):
    text, name, is_path = source(table, "table", "{'tau [MPa]': [1.2, 1.4], ...}")
    try:
        return (_slipfront.read_text(name) if is_path else text), name
    except UnicodeDecodeError:
        raise InputError(f"{shown(name)}: not UTF-8; allowed: a CSV table in UTF-8") from None


def _without_useless_drops(found):
    """Removes stress drops without an error, which decide nothing, with a note."""
    useless = [front for front in found.fronts
               if front.stress_drop is not None and front.stress_drop.is_exact]
    for front in useless:
        front.stress_drop = None
    if useless:
        found.notes.append(f"{len(useless)} of {len(found.fronts)} stress drops have no error and "
                           f"are not used, the first in line {useless[0].line}; allowed: an error, "
                           "such as 0.20 +- 0.03 MPa")


def read(table, strict=False, columns=None, normal_stress=None):
    """Returns the Table of a path, a text, a dict of columns or a DataFrame. A row that cannot be
    read is an error of the Table.

    `normal_stress` is that of fronts without their own. Raises InputError if the header is unusable
    or no row can be read; if `strict`, also for one bad row."""
    text, file = text_of(table)
    constant = None
    if normal_stress is not None:
        unit = "" if isinstance(normal_stress, str) else "Pa"
        constant = _slipfront.parse_measured(str(normal_stress), "pressure", unit, "", 0,
                                             "normal_stress")
    required = [name for name in REQUIRED if constant is None or name != "normal_stress"]
    rows, ignored, notes = _slipfront.fronts(text, file, column_map(columns), required)
    found = Table(file, [], [], ignored, notes)
    for name, line, error, shear, normal, velocity, drop in rows:
        front = Front(name, line, shear, normal or constant, velocity, drop)
        try:
            if error:
                raise InputError(error)
            _check_complete(front, file)
            _check_stresses(front, file)
            found.fronts.append(front)
        except InputError as problem:
            found.errors.append(str(problem))
            if strict:
                raise
    if not found.fronts:
        raise InputError(found.errors[0] if found.errors else f"{shown(file)}: no front; allowed: "
                         "a header line and one row a front")
    _without_useless_drops(found)
    return found
