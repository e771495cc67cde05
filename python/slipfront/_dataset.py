"""From arrays and what is said of them to xarray."""

from . import _slipfront
from ._optional import import_optional


def attributes(about):
    """CF attributes of a variable from its (name, long_name, dimensional_unit, reference), as in the NetCDF files."""
    _, long_name, dimensional_unit, reference = about
    return {"long_name": long_name, "units": "1", "dimensional_unit": dimensional_unit, "references": _slipfront.reference_of(reference)}


def dataset(variables, coordinates=None, attrs=None):
    """xarray.Dataset of {name: (dimensions, values, attributes)}."""
    return import_optional("xarray").Dataset(variables, coordinates, attrs)


def of_columns(descriptions, columns, shape, dims, coords):
    """Dataset of one variable a column, each of that shape, described; coordinates that are no variable stay."""
    names = [about[0] for about in descriptions]
    return dataset({about[0]: (dims, column.reshape(shape), attributes(about)) for about, column in zip(descriptions, columns)},
                   {key: value for key, value in coords.items() if key not in names})
