"""What the comparison of a printed number with a computed one says. The rules, in their order:

same: the computed number rounds to the digits printed (or is beyond the printed bound).
follows from a printed number that differs: it does not, but the paper's formula on the paper's own printed numbers does.
the paper rounds or misreads: it is away by one unit of the last digit at most (and by a tenth of the number), or, for a number
    read off a figure, no farther than a ruler reads.
the paper is wrong: none of these.
"""

import dataclasses
import decimal
import math

SAME = "same"
FOLLOWS = "follows from a printed number that differs"
READING = "the paper rounds or misreads"
WRONG = "the paper is wrong"

#: A reading with a ruler: 2 mm on an axis of 80 mm, as a share of the axis.
RULER = 2 / 80

#: Words of a printed bound -> whether a value satisfies it.
BOUNDS = {"more than": lambda value, printed: value > printed, "at least": lambda value, printed: value >= printed}


@dataclasses.dataclass(frozen=True)
class Printed:
    """A number as the paper prints it."""

    text: str  #: its digits
    bound: str = ""  #: "more than" or "at least", where it is no value
    axis: tuple = ()  #: both ends of the axis that it was read off
    log: bool = False  #: whether that axis is logarithmic


def unit_of_last_digit(text) -> float:
    """1 in the place of the last digit printed: 0.01 for "0.55"."""
    return 10.0 ** int(decimal.Decimal(text).as_tuple().exponent)


def rounded(value, text) -> str:
    """A value with as many decimals as `text` has, in its notation."""
    mantissa, e, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return f"{value / 10.0 ** int(exponent or 0):.{decimals}f}{e}{exponent}"


def same(value, printed) -> bool:
    """Whether a value rounds to the digits printed, or satisfies the printed bound."""
    if printed.bound:
        return BOUNDS[printed.bound](value, float(printed.text))
    return abs(value - float(printed.text)) <= 0.5 * unit_of_last_digit(printed.text) * (1 + 1e-9)


def readable(value, printed) -> bool:
    """Whether a ruler, or rounding by one unit of the last digit, takes the value for the printed one."""
    number = float(printed.text)
    if abs(value - number) <= min(unit_of_last_digit(printed.text), abs(number) / 10):
        return True
    if not printed.axis:
        return False
    low, high = printed.axis
    off, span = (math.log(value / number), math.log(high / low)) if printed.log else (value - number, high - low)
    return abs(off) <= RULER * span


def verdict(value, printed, by_printed=()) -> str:
    """The verdict on a printed number. value: computed. by_printed: values that the paper's own printed numbers give."""
    if same(value, printed):
        return SAME
    if any(same(other, printed) for other in by_printed):
        return FOLLOWS
    return READING if readable(value, printed) else WRONG
