"""The folder of a reproduction: pictures, their data, the table of numbers."""

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
    """Holds the lock of a folder; yields whether it was free."""
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
            fcntl.flock(descriptor, fcntl.LOCK_UN)  # a process that was started meanwhile has the descriptor too
        os.close(descriptor)


def tidy(path):
    """What a killed reproduction left beside `path`: an earlier one that it had moved away comes back, all else goes. What a
    living process writes is locked and stays."""
    if not path.parent.is_dir():
        return
    for kind in ("old", "new"):
        for left in sorted(path.parent.iterdir()):
            if not re.fullmatch(rf"\.{re.escape(path.name)}\.{kind}-\d+", left.name) or left.is_symlink() or not left.is_dir():
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
    """A folder beside `path` to write into, that takes its place when all is done; whatever fails leaves nothing, and an earlier one as it was.

    Raises ValueError where something stands there that is no earlier reproduction, OSError where it cannot be written.
    """
    path = pathlib.Path(os.path.abspath(path))
    with told_of(path):
        tidy(path)
    if path.exists() and not (path / "report.html").is_file() and (not path.is_dir() or any(path.iterdir())):
        raise ValueError(f"-o {path}: something else is there; allowed: a new name, an empty folder or an earlier reproduction")
    beside, old = (path.with_name(f".{path.name}.{kind}-{os.getpid()}") for kind in ("new", "old"))

    def undo():
        if old.exists() and not path.exists():
            old.rename(path)
        for folder in (beside, old, old):  # once more, where something failed on the way
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
    """A picture as SVG and PNG, its data as NetCDF and CSV. What has several dimensions has one row for each combination."""
    for ending in ("svg", "png"):
        save(picture.figure, folder / f"{picture.name}.{ending}")
    write_dataset(picture.data, folder / f"{picture.name}.nc")
    write_text(folder / f"{picture.name}.csv", picture.data.to_dataframe().to_csv())


def write_rows(path, rows) -> None:
    """A table as CSV."""
    file = io.StringIO(newline="")
    writer = csv.DictWriter(file, rows[0].keys())
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, file.getvalue())
