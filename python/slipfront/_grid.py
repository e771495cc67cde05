"""Values of a key as the command line gives them: `0.1,0.5,2`, `0:2:9` or `0.1:10:5:log`."""

import math
import re

#: A number, without spaces.
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
#: A number and its unit.
QUANTITY = re.compile(rf"({NUMBER})\s*([^\W\d].*)")
_range = re.compile(rf"({NUMBER}):({NUMBER}):({NUMBER})(:log)?(\s*[^\W\d].*)?")
_most_values = 10_000_000
_truths = {"true": True, "false": False}


def values_of(text, kind):
    """Returns the values of a list such as `0.1,0.5` or `0:2:9`. `kind` is the type of the key as
    in `slipfront keys`.

    Raises ValueError with the values that are allowed."""
    values = [value for part in _parts(text) for value in _values(part.strip(), kind)]
    if kind != "number":  # a quantity without a unit is in SI units
        return values
    with_unit = next((value for value in values
                      if isinstance(value, str) and QUANTITY.fullmatch(value)), None)
    without = next((value for value in values if isinstance(value, float) and value != 0), None)
    if with_unit and without:
        raise ValueError(f"{without!r} has no unit, but {with_unit} has one; allowed: a unit after "
                         "each value, as in 1 MPa,3 MPa, or after none")
    return values


def _parts(text):
    """Splits a text at the commas outside of brackets, which a formula may have."""
    parts, depth = [""], 0
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return parts


def _values(part, kind):
    if not part:
        raise ValueError("a value is empty; allowed: values with a comma between them, such as "
                         "0.1,0.5,2")
    found = _range.fullmatch(part)
    if found:
        first, last, count, logarithmic, unit = found.groups()
        numbers = _between(float(first), float(last), float(count), bool(logarithmic))
        return ([f"{number!r} {unit.strip()}" for number in numbers] if unit
                else [_one(repr(number), kind, rounds=True) for number in numbers])
    if kind in ("number", "whole number", "quantity") and ":" in part:
        raise ValueError(f"'{part}': not a range; allowed: first:last:count or "
                         "first:last:count:log, such as 0:2:9 or 0.1:10:5:log")
    return [_one(part, kind)]


def _between(first, last, count, logarithmic):
    """Returns the numbers of a range, equal to those of `slipfront relations`."""
    if not (math.isfinite(first) and math.isfinite(last)):
        raise ValueError("an end of a range is not finite; allowed: finite numbers")
    if not 1 <= count <= _most_values or count % 1:
        raise ValueError(f"a range of {count:.15g} values; allowed: a whole number from 1 to "
                         f"{_most_values}")
    if logarithmic and not (first > 0 and last > 0):
        raise ValueError("a logarithmic range has an end that is not positive; allowed: ends > 0")

    def at(share):
        if logarithmic:
            return math.exp(math.log(first) * (1 - share) + math.log(last) * share)
        return first * (1 - share) + last * share

    return [first, *(at(i / (count - 1)) for i in range(1, int(count) - 1)),
            *([last] if count > 1 else [])]


def _one(text, kind, rounds=False):
    """Returns a value by the type of its key. `rounds` rounds it for a key of whole numbers."""
    if kind == "truth value":
        return _truths.get(text, text)
    if kind not in ("number", "whole number", "quantity") or not re.fullmatch(NUMBER, text):
        return text
    number = float(text)
    whole = kind == "whole number" and math.isfinite(number) and (rounds or number.is_integer())
    return round(number) if whole else number
