"""Writes the folder of a reproduction: pictures, their data, the tables."""

import contextlib
import csv
import fcntl
import io
import os
import pathlib
import re
import shutil

from .._files import UNFINISHED, told_of, write_dataset, write_text
from ..plots.style import save


@contextlib.contextmanager
def locked(folder):
    """Context manager that locks a folder. It yields whether the lock was free."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            free = True
        except OSError:
            free = False
        yield free
    finally:
        with contextlib.suppress(OSError):
            # A process that was forked in the meantime also has the descriptor
            fcntl.flock(descriptor, fcntl.LOCK_UN)
        os.close(descriptor)


def tidy(path):
    """Cleans up after a reproduction that was killed while it wrote `path`.

    An earlier reproduction that it had moved away is restored, and its other folders are removed.
    Folders that a running process writes are locked and are not touched.
    """
    if not path.parent.is_dir():
        return
    for kind in ("old", "new"):
        for left in sorted(path.parent.iterdir()):
            if not re.fullmatch(rf"\.{re.escape(path.name)}\.{kind}-\d+",
                                left.name) or left.is_symlink() or not left.is_dir():
                continue
            with locked(left) as free:
                if not free:
                    continue
                if kind == "old" and not path.exists():
                    left.rename(path)
                else:
                    shutil.rmtree(left, ignore_errors=True)


@contextlib.contextmanager
def whole_folder(path):
    """Context manager that yields a temporary folder next to `path`, which replaces `path` at the
    end.

    After an error nothing remains of the temporary folder, and an earlier reproduction is
    unchanged. Raises ValueError if `path` exists and is neither an earlier reproduction nor an
    empty folder, OSError if it cannot be written.
    """
    path = pathlib.Path(os.path.abspath(path))
    with told_of(path):
        tidy(path)
    replaceable = not path.exists() or (path / "report.html").is_file()
    if not replaceable and (not path.is_dir() or any(path.iterdir())):
        raise ValueError(f"-o {path}: exists and is not a reproduction; allowed: a new name, an "
                         "empty folder or an earlier reproduction")
    beside, old = (path.with_name(f".{path.name}.{kind}-{os.getpid()}") for kind in ("new", "old"))

    def undo():
        if old.exists() and not path.exists():
            old.rename(path)
        for folder in (beside, old, old):  # a second time, in case rmtree failed
            with contextlib.suppress(OSError):
                shutil.rmtree(folder, ignore_errors=True)

    with told_of(path), contextlib.ExitStack() as locks:
        try:
            UNFINISHED.add(undo)
            path.parent.mkdir(parents=True, exist_ok=True)
            beside.mkdir()
            locks.enter_context(locked(beside))
            yield beside
            if path.exists():
                locks.enter_context(locked(path))
                path.rename(old)
            beside.rename(path)
        finally:
            undo()
            UNFINISHED.discard(undo)


def write_picture(folder, picture) -> None:
    """Writes a picture as SVG and PNG, and its data as NetCDF and CSV."""
    for ending in ("svg", "png"):
        save(picture.figure, folder / f"{picture.name}.{ending}")
    write_dataset(picture.data, folder / f"{picture.name}.nc")
    write_text(folder / f"{picture.name}.csv", picture.data.to_dataframe().to_csv())


def write_rows(path, rows) -> None:
    file = io.StringIO(newline="")
    writer = csv.DictWriter(file, rows[0].keys())
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, file.getvalue())
