"""Files that are whole or not there."""

import contextlib
import os
import pathlib


@contextlib.contextmanager
def beside(path):
    """A name beside `path`, with its ending, to write to: renamed to `path` at the end, removed where that is not reached."""
    path = pathlib.Path(path)
    written = path.parent / f".{path.stem}.{os.getpid()}{path.suffix}"
    try:
        yield written
        written.replace(path)
    finally:
        written.unlink(missing_ok=True)
