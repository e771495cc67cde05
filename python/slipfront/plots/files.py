"""Files that slipfront writes -> Datasets."""

import pathlib

import xarray

from .._optional import import_optional
from .._run import read as read_netcdf


def read(path, si=None) -> xarray.Dataset:
    """The Dataset of a NetCDF file, or of a CSV file of `slipfront relations` or `event` (one row a
    state or event). `si` chooses the units of a run, by default those of its file.

    Raises OSError, in one line with the file's name, where it cannot be read; ValueError where it
    is neither.
    """
    path = pathlib.Path(path)
    try:
        with path.open("rb") as file:
            start = file.read(8)
    except OSError as error:
        raise OSError(f"{path}: {error.strerror}") from error
    if start.startswith((b"\x89HDF", b"CDF")):
        return netcdf(path, si)
    if path.suffix.lower() == ".csv":
        return rows(path)
    raise ValueError(f"{path}: neither NetCDF nor CSV by its start and name; allowed: files of "
                     "pulse, chain, compare, event (-o), relations, event (--csv)")


def netcdf(path, si=None) -> xarray.Dataset:
    try:
        data = read_netcdf(path, any_file=True, si=si)
        return data.slipfront.si() if si else data
    except OSError as error:
        raise OSError(f"not a whole NetCDF file: {error}") from error


def rows(path) -> xarray.Dataset:
    pandas = import_optional("pandas")
    try:
        table = pandas.read_csv(path)
    except (ValueError, UnicodeError) as error:  # pandas' own errors are ValueErrors
        raise ValueError(f"{path}: not a CSV file: {' '.join(str(error).split())}") from error
    if table.empty:
        raise ValueError(f"{path}: no rows below the header; allowed: one or more")
    return xarray.Dataset.from_dataframe(table.rename_axis("row"))
