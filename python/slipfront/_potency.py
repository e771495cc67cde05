"""The function slipfront.moment_duration, and the table of potencies."""

import functools
import math
import pathlib

from . import _slipfront
from ._dataset import of_columns
from ._numbers import flat, np, past_nan
from ._slipfront import InputError

#: Ranges of Sigma- and of Gamma that the table covers. Above the last Gamma the potency falls as 1
#: / Gamma, the limit of diffusion.
LEAST_STRESS, MOST_STRESS, MOST_DAMPING = 0.05, 3.0, 1e8

#: Ranges of the variables Sigma- / (1 + Sigma-) and ln(1 + Gamma), and how many polynomials there
#: are in each (tools/potency/make.py).
RANGES = ((LEAST_STRESS / (1 + LEAST_STRESS), MOST_STRESS / (1 + MOST_STRESS)),
          (0.0, math.log1p(MOST_DAMPING)))
ORDERS = (13, 49)

#: Columns of moment_duration: name, long_name, dimensional_unit and reference.
DESCRIBED = (("potency", "slip integrated along the fault, over the square of the duration",
              "c^2 A / pi", "Eq. 7"), ("exponent", "d ln(potency) / d ln(duration) at given "
                                       "stress, contact ratio and friction", "", "Eq. 7"))


def stress_of(y):
    """Returns Sigma- of the variable Sigma- / (1 + Sigma-)."""
    return y / (1 - y)


@functools.lru_cache(maxsize=None)
def table():
    """Returns the coefficients of ln(potency / (|V-| W(0) T^2))."""
    return np.loadtxt(pathlib.Path(__file__).parent / "potency.csv", delimiter=",")


def _unit(values, limits):
    return (2 * values - limits[0] - limits[1]) / (limits[1] - limits[0])


def share(stress, damping):
    """Returns ln(potency / (|V-| W(0) T^2)), frictionless V- and W, and d/d ln(Gamma) of it."""
    inside = np.minimum(damping, MOST_DAMPING)
    s, t = _unit(stress / (1 + stress), RANGES[0]), _unit(np.log1p(inside), RANGES[1])
    in_stress = np.polynomial.chebyshev.chebvander(s, ORDERS[0] - 1) @ table()
    polynomials = np.polynomial.chebyshev.chebvander(t, ORDERS[1] - 1)
    slopes = in_stress @ np.polynomial.chebyshev.chebder(np.eye(ORDERS[1]), axis=0).T
    value = np.einsum("ij,ij->i", in_stress,
                      polynomials) - np.log(np.maximum(damping, MOST_DAMPING) / MOST_DAMPING)
    slope = (np.einsum("ij,ij->i", slopes, polynomials[:, :-1]) * 2 / (RANGES[1][1] - RANGES[1][0])
             * inside / (1 + inside))
    return value, np.where(damping > MOST_DAMPING, -1.0, slope)


def _columns(stress, damping):
    for name, values, low, high in (("stress", stress, LEAST_STRESS, MOST_STRESS),
                                    ("damping_number", damping, 0, math.inf)):
        wrong = values[~((values >= low) & (values <= high) & np.isfinite(values))]
        if wrong.size:
            raise InputError(f"{name} = {wrong[0]:g}: out of range; allowed: "
                             f"{f'{low:g} to {high:g}' if high < math.inf else '>= 0'}")
    free = _slipfront.relations("stress", stress, 1)
    names = [about[0] for about in _slipfront.relations_quantities]
    value, slope = share(stress, damping)
    return [free[names.index("rupture_velocity")] * free[names.index("slip_velocity")]
            * np.exp(value), 2 + slope]


def moment_duration(stress, damping_number):
    """Returns how the potency of a slip pulse grows with its duration under viscous friction.

    Potency is slip integrated along the fault: seismic moment over shear modulus and fault width.
    The values are read from a table that was computed with the pulse solver, closure "consistent"
    (docs/population.md). `stress` and `damping_number` broadcast, and NaN in either gives NaN.

    Parameters
    ----------
    stress : array_like
        Stress Sigma- before the rupture, in mu A / pi; 0.05 to 3. The initial stress is a step into
        the empty interface.
    damping_number : array_like
        Gamma = C T >= 0, or C T c A / b with units. It is proportional to the duration T.

    Returns
    -------
    xarray.Dataset with `potency`, over the square of the duration and in c^2 A / pi (slip is the
    relative slip of both faces, as in `event`); and `exponent`, that of the duration in the potency
    at given stress, contact ratio and friction. It falls from 2 without friction to 1.

    Raises
    ------
    InputError if an argument is out of range, or the shapes do not match.

    Examples
    --------
    >>> slipfront.moment_duration(0.855, [0.01, 1, 20, 100]).exponent.round(2).values.tolist()
    [2.0, 1.72, 1.05, 1.01]
    """
    (stress, damping), *rest = flat(stress=stress, damping_number=damping_number)
    columns = past_nan(_columns, stress, damping, instead=(1.0, 1.0))
    return of_columns(DESCRIBED, columns, *rest).assign_attrs(closure="consistent")
