"""How far long work is."""

import sys
import time

from ._shown import shown
from ._slipfront import InputError


def watcher(progress):
    """What to call now and then for a `progress` argument: None or False for nothing, True for a line on stderr, or any
    callable."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return Line()
    if callable(progress):
        return progress
    raise InputError(f"progress = '{shown(progress)}': neither a callable nor a bool; allowed: True, or a function of (done, total, steps, level)")


class Line:
    """A bar with the time left, on one line of stderr. Called with (done, total, ...)."""

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
        print(f"\r{level + ' ' if level else ''}[{bar}] {100 * share:5.1f} %  {done:.6g} of {total:.6g}  {left}\x1b[K", end="",
              file=sys.stderr, flush=True)

    def close(self):
        if self._start is not None:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


class showing:
    """Context in which work tells `progress` how far it is; a Line is wiped at the end."""

    def __init__(self, progress):
        self._call = watcher(progress)

    def __enter__(self):
        return self._call

    def __exit__(self, *_):
        if isinstance(self._call, Line):
            self._call.close()
