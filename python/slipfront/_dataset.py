"""Builds xarray Datasets from arrays and their descriptions."""

from . import _slipfront
from ._numbers import np
from ._optional import import_optional


def about(long_name, dimensional_unit="", units="1", **further):
    """Returns the attributes of a variable: a number, to be multiplied by its dimensional_unit."""
    unit = {"dimensional_unit": dimensional_unit} if dimensional_unit else {}
    return {"long_name": long_name, "units": units, **unit, **further}


#: Coordinates of the ends of an interval, and of shares of the values below.
BOUND = {"bound": ("bound", ["5 %", "95 %"], {"long_name": "ends of an interval"})}
QUANTILE = {"quantile": ("quantile", [0.05, 0.5, 0.95], about("share of the values below"))}


def texts(dims, values, long_name):
    return dims, np.array(values, dtype=object), {"long_name": long_name}


def attributes(described):
    """Returns the CF attributes of a variable, as in the NetCDF files.

    `described` is (name, long_name, dimensional_unit, reference)."""
    _, long_name, unit, reference = described
    return {"long_name": long_name, "units": "1", "dimensional_unit": unit,
            "references": _slipfront.reference_of(reference)}


def dataset(variables, coordinates=None, attrs=None):
    return import_optional("xarray").Dataset(variables, coordinates, attrs)


def of_columns(descriptions, columns, shape, dims, coords):
    """Returns a Dataset with a variable for each column, of this shape and with its description.

    Coordinates that have the name of a variable are left out."""
    variables = {described[0]: (dims, column.reshape(shape), attributes(described))
                 for described, column in zip(descriptions, columns)}
    return dataset(variables, {key: value for key, value in coords.items() if key not in variables})


def profile(descriptions, columns, x, shape, dims, coords):
    """Returns a Dataset of columns over x / t, which is its dimension unless it has its own."""
    data = of_columns(descriptions, columns, shape, dims, coords)
    if dims == ("state",):
        x_over_t = ("x_over_t", x, about("x / t", "c"))
        return data.rename(state="x_over_t").assign_coords(x_over_t=x_over_t)
    return data
