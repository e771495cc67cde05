"""Compares printed numbers with computed ones. The first of these verdicts that applies counts:

same: the computed number rounds to the printed digits, or satisfies the printed bound.
follows from a printed number that differs: so does the paper's formula of other printed numbers.
the paper rounds or misreads: they differ by at most one unit of the last digit and a tenth of the
    number or, for a number that is read off a figure, by the error of a ruler.
the paper is wrong: none of these.
"""

import dataclasses
import decimal
import math

SAME = "same"
FOLLOWS = "follows from a printed number that differs"
READING = "the paper rounds or misreads"
WRONG = "the paper is wrong"

#: Error of a reading with a ruler, as a fraction of the axis: 2 mm on an axis of 80 mm.
RULER = 2 / 80

#: For each printed bound, a function that returns whether a value satisfies it.
BOUNDS = {"more than": lambda value, printed: value > printed,
          "at least": lambda value, printed: value >= printed}


@dataclasses.dataclass(frozen=True)
class Printed:
    """A number as the paper prints it."""

    text: str  #: its printed digits
    bound: str = ""  #: "more than" or "at least" if the paper prints a bound, otherwise empty
    axis: tuple = ()  #: both ends of the axis off which the paper reads the number
    log: bool = False  #: whether that axis is logarithmic


def unit_of_last_digit(text) -> float:
    """Returns one unit of the last printed digit, such as 0.01 for "0.55"."""
    return 10.0 ** int(decimal.Decimal(text).as_tuple().exponent)


def rounded(value, text) -> str:
    """Returns a value with as many decimals as `text` has, and in its notation."""
    mantissa, e, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return f"{value / 10.0 ** int(exponent or 0):.{decimals}f}{e}{exponent}"


def same(value, printed) -> bool:
    """Returns whether a value rounds to the printed digits, or satisfies the printed bound."""
    if printed.bound:
        return BOUNDS[printed.bound](value, float(printed.text))
    return abs(value - float(printed.text)) <= 0.5 * unit_of_last_digit(printed.text) * (1 + 1e-9)


def readable(value, printed) -> bool:
    """Returns whether a ruler, or one unit of the last digit, explains the difference."""
    number = float(printed.text)
    if abs(value - number) <= min(unit_of_last_digit(printed.text), abs(number) / 10):
        return True
    if not printed.axis:
        return False
    low, high = printed.axis
    off, span = (math.log(value / number),
                 math.log(high / low)) if printed.log else (value - number, high - low)
    return abs(off) <= RULER * span


def verdict(value, printed, by_printed=()) -> str:
    """Returns the verdict on a number. by_printed: values from other printed numbers."""
    if same(value, printed):
        return SAME
    if any(same(other, printed) for other in by_printed):
        return FOLLOWS
    return READING if readable(value, printed) else WRONG
