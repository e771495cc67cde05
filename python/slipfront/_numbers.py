"""Arrays as users give them."""

import os

from . import _slipfront
from ._optional import import_optional
from ._messages import shown
from ._slipfront import InputError

np = import_optional("numpy")


def numbers(name, values):
    """Returns real numbers as an array of doubles, copied only if need be. Raises InputError."""
    if np.ma.is_masked(values):
        raise InputError(f"{name}: some of it is masked; allowed: numbers")
    try:
        array = np.asarray(values)
    except Exception as error:
        raise InputError(f"{name}: not an array: {error}; allowed: numbers") from error
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name}: an array of {array.dtype}; allowed: real numbers")
    return np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)


def one_number(name, value):
    """A single real number. Raises InputError."""
    array = numbers(name, value)
    if array.ndim:
        raise InputError(f"{name}: an array of shape {array.shape}; allowed: one number")
    return float(array)


def broadcasting(**given):
    """The arguments as arrays of doubles. Raises InputError unless their shapes broadcast."""
    arrays = [numbers(name, values) for name, values in given.items()]
    try:
        np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(given, arrays))
        raise InputError(f"{shapes}: shapes do not match; allowed: shapes that broadcast") from None
    return arrays


def dimensions(values, array):
    """Returns dimensions and coordinates of a DataArray; else "state" or dim_0, dim_1, ..."""
    if hasattr(values, "dims") and hasattr(values, "coords"):
        return values.dims, dict(values.coords)
    return (("state",) if array.ndim == 1 else tuple(f"dim_{i}" for i in range(array.ndim))), {}


def flat(**given):
    """The arguments as arrays of one shape, flat; that shape; and the names of its dimensions."""
    arrays = np.broadcast_arrays(*broadcasting(**given))
    named = [values for values in given.values()
             if hasattr(values, "dims") and np.shape(values) == arrays[0].shape]
    dims, coords = dimensions(named[0] if named else None, arrays[0])
    return [np.ascontiguousarray(array).reshape(-1)
            for array in arrays], arrays[0].shape, dims, coords


def past_nan(call, *arrays, instead):
    """Returns the columns of call(*arrays), with NaN where an array is, called with `instead`."""
    missing = np.isnan(arrays).any(axis=0)
    columns = call(*(np.where(missing, other, array) for array, other in zip(arrays, instead)))
    for column in columns:
        column[missing] = np.nan
    return columns


def whole(name, value, least=0, most=None):
    """Returns a whole number from `least` to `most`. Raises InputError."""
    if (isinstance(value, bool) or not isinstance(value, (int, np.integer))
            or not least <= value <= (most or 2**63 - 1)):
        limit = f" to {most}" if most else ""
        raise InputError(f"{name} = '{shown(value)}': out of range; "
                         f"allowed: a whole number from {least}{limit}")
    return int(value)


def thread_count(threads):
    """Number of threads for a `threads` argument; None means all cores."""
    if threads is None:
        return len(os.sched_getaffinity(0))
    return _slipfront.sensible_threads(whole("threads", threads, 1, 4096))
