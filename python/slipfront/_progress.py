"""Reports the progress of long work."""

import sys
import time

from ._messages import shown
from ._slipfront import InputError


def watcher(progress):
    """Returns the function to call, or None, for an argument `progress`. Raises InputError."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return Line()
    if callable(progress):
        return progress
    raise InputError(f"progress = '{shown(progress)}': neither a bool nor a function; allowed: "
                     "True, or a function of (done, total, steps, level)")


class Line:
    """A bar with the remaining time on stderr. It is called with (done, total, ...)."""

    def __init__(self):
        self._start = self._label = None

    def __call__(self, done, total, _steps=0, level=""):
        now = time.monotonic()
        if self._start is None or level != self._label:
            self._start, self._first, self._label = now, done, level
        share = done / total if total else 1
        rate = (done - self._first) / (now - self._start) if now > self._start else 0
        left = f"{(total - done) / rate:.0f} s left" if rate > 0 else ""
        bar = ("#" * int(30 * share)).ljust(30, ".")
        print(f"\r{level + ' ' if level else ''}[{bar}] {100 * share:5.1f} %  {done:.6g} of "
              f"{total:.6g}  {left}\x1b[K", end="", file=sys.stderr, flush=True)

    def close(self):
        if self._start is not None:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


class showing:
    """Context manager with the function to call, or None. It clears a Line at the end."""

    def __init__(self, progress):
        self._call = watcher(progress)

    def __enter__(self):
        return self._call

    def __exit__(self, *_):
        if isinstance(self._call, Line):
            self._call.close()
