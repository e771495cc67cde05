"""The folder of a reproduction: pictures, their data, the table of numbers."""

import contextlib
import csv
import os
import pathlib
import shutil

from ..plots.style import save


@contextlib.contextmanager
def whole_folder(path):
    """A folder beside `path` to write into, that takes its place when all is done; whatever fails leaves nothing, and an earlier one as it was.

    Raises ValueError where something stands there that is no earlier reproduction, OSError where it cannot be written.
    """
    path = pathlib.Path(os.path.abspath(path))
    if path.exists() and not (path / "report.html").is_file() and (not path.is_dir() or any(path.iterdir())):
        raise ValueError(f"-o {path}: something else is there; allowed: a new name, an empty folder or an earlier reproduction")
    beside, old = (path.with_name(f".{path.name}.{kind}-{os.getpid()}") for kind in ("new", "old"))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        beside.mkdir()
        yield beside
        if path.exists():
            path.rename(old)
        beside.rename(path)
    except OSError as error:
        raise OSError(f"{error.filename or path}: {error.strerror or error}") from error
    finally:
        if old.exists() and not path.exists():
            old.rename(path)
        shutil.rmtree(beside, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


def write_picture(folder, picture) -> None:
    """A picture as SVG and PNG, its data as NetCDF and CSV. What has several dimensions has one row for each combination."""
    for ending in ("svg", "png"):
        save(picture.figure, folder / f"{picture.name}.{ending}")
    picture.data.to_netcdf(folder / f"{picture.name}.nc")
    picture.data.to_dataframe().to_csv(folder / f"{picture.name}.csv")


def write_rows(path, rows) -> None:
    """A table as CSV."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
