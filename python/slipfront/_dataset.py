"""Builds xarray Datasets from arrays and their descriptions."""

from . import _slipfront
from ._optional import import_optional


def attributes(about):
    """Returns the CF attributes of a variable, as in the NetCDF files. `about` is (name, long_name, dimensional_unit, reference)."""
    _, long_name, dimensional_unit, reference = about
    return {"long_name": long_name, "units": "1", "dimensional_unit": dimensional_unit, "references": _slipfront.reference_of(reference)}


def dataset(variables, coordinates=None, attrs=None):
    """Returns the xarray.Dataset of {name: (dimensions, values, attributes)}."""
    return import_optional("xarray").Dataset(variables, coordinates, attrs)


def of_columns(descriptions, columns, shape, dims, coords):
    """Returns a Dataset with one variable for each column, of the given shape and with its description. Coordinates that have
    the name of a variable are left out."""
    names = [about[0] for about in descriptions]
    return dataset({about[0]: (dims, column.reshape(shape), attributes(about)) for about, column in zip(descriptions, columns)},
                   {key: value for key, value in coords.items() if key not in names})
