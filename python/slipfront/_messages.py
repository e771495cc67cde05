"""Exit codes and messages of the subcommands that are written in Python."""

import contextlib
import sys
from collections.abc import Callable

from . import _table

DONE, INPUT, FILE, NUMERICS, INTERRUPTED = 0, 2, 3, 4, 130


def complain(error):
    """Prints an error or a warning as one line on stderr, broken to fit a terminal."""
    text = shortened(" ".join(str(error).split())) or type(error).__name__
    # Without the compiled module, that is the error to print
    with contextlib.suppress(ImportError):
        from ._slipfront import printable

        text = printable(text.encode("utf-8", "surrogateescape"))
    with contextlib.suppress(OSError):
        print(_table.fitted_message(f"slipfront: {text}"), file=sys.stderr)


class Interruption:
    """Whether the user has interrupted the program. Libraries may hide a KeyboardInterrupt."""

    seen = False

    #: Returns how to continue, to be printed after the word "interrupted".
    advice: Callable[[], str] = staticmethod(lambda: "")


def shown(value, most=80):
    """The value as text of at most `most` characters, or its type if it is nested too deeply."""
    try:
        text = str(value)
    except (RecursionError, ValueError):  # the second: an int of more digits than Python prints
        return f"a {type(value).__name__} that is nested too deeply or too long"
    return text if len(text) <= most else text[:most - 3] + "..."


def shortened(text, most=2000, part=800):
    """The text without the middle of lines longer than `most`: the ends have name and reason."""
    return "\n".join(line if len(line) <= most else f"{line[:part]}...{line[-part:]}"
                     for line in text.split("\n"))
