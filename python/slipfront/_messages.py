"""Exit codes and messages of the subcommands that are written in Python."""

import contextlib
import sys
from collections.abc import Callable

from . import _table
from ._shown import shortened

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
