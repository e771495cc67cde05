"""slipfront.relations"""

from . import _slipfront
from ._dataset import attributes, dataset, of_columns
from ._numbers import dimensions, flat, numbers, past_nan, thread_count
from ._slipfront import InputError

_ways = "stress, rupture_velocity or slip_velocity"


def relations(*, stress=None, rupture_velocity=None, slip_velocity=None, stress_right=None,
              threads=None):
    """The frictionless slip pulse from a step of stress into an empty interface (Eqs. 8-10): any
    one of three quantities gives all the others.

    Parameters
    ----------
    stress : array of any shape
        Sigma-, before the rupture, in mu A / pi; 0.00447 to 1e308.
    rupture_velocity : array of any shape
        |V-| of the fast front, in c; 2e-302 to 1, exclusive.
    slip_velocity : array of any shape
        W at x = 0, in c A / pi; 7.2e-308 to 5e307.
    stress_right : array, optional
        Stress ahead of the leading front, in mu A / pi, instead of an empty interface: 0, or 0.0045
        to the stress. Only with stress, whose shape it must match.
    threads : int, optional
        All cores unless given; results do not depend on it.

    Returns
    -------
    xarray.Dataset of the shape given, with stress, rupture_velocity, leading_velocity,
    velocity_ratio, slip_velocity, stress_at_origin, dislocation_velocity_at_origin, psi and
    psi_at_origin, each to a few ulp times the condition of the question. With stress_right: stress,
    stress_right, rupture_velocity, leading_velocity, velocity_ratio, slip_velocity, slip (at x = 0,
    over the time), stress_at_origin, dislocation_velocity_at_origin (the mean over all trains) and
    trains_at_origin, with errors of about 1e-12 (docs/theory/9_trains.md). Dimensions and
    coordinates are those of a DataArray, else "state" or dim_0, dim_1, ...

    Raises
    ------
    InputError unless exactly one quantity is given, all of it in its range or NaN. NaN gives NaN.

    Examples
    --------
    >>> states = slipfront.relations(stress=[0.855, 1.03])
    >>> states.rupture_velocity.round(4).values.tolist()
    [0.3644, 0.5439]
    """
    given = [(name, values)
             for name, values in (("stress", stress), ("rupture_velocity", rupture_velocity),
                                  ("slip_velocity", slip_velocity)) if values is not None]
    if len(given) != 1:
        raise InputError("relations: "
                         f"{'nothing was' if not given else 'more than one quantity was'} given; "
                         f"allowed: {_ways}")
    name, values = given[0]
    if stress_right is not None:
        if name != "stress":
            raise InputError(f"relations: stress_right with {name}; allowed: stress_right with "
                             "stress")
        (left, right), shape, dims, coords = flat(stress=values, stress_right=stress_right)
        columns = _slipfront.step_relations(left, right, thread_count(threads))
        return of_columns(_slipfront.step_quantities, columns, shape, dims, coords)
    array = numbers(name, values)
    count = thread_count(threads)
    columns = past_nan(lambda values: _slipfront.relations(name, values, count), array.reshape(-1),
                       instead=(0.5,))
    dims, coords = dimensions(values, array)
    return dataset({about[0]: (dims, column.reshape(array.shape), attributes(about))
                    for about, column in zip(_slipfront.relations_quantities, columns)},
                   {key: value for key, value in coords.items()
                    if key not in dict.fromkeys(a[0] for a in _slipfront.relations_quantities)})
