"""The functions slipfront.friction_ratio and slipfront.damping_number."""

from . import _slipfront
from ._dataset import of_columns
from ._numbers import flat, past_nan


def friction_ratio(stress, damping_number, *, measure="origin", closure="consistent"):
    """Returns the share of the slip velocity that remains under viscous friction (Fig. 10).

    The values are read from a table that was computed with the pulse solver
    (docs/friction_ratio.md). `stress` and `damping_number` broadcast, and NaN in either gives NaN.

    Parameters
    ----------
    stress : array_like
        Stress Sigma- before the rupture, in mu A / pi; 0.05 to 3. The initial stress is a step into
        the empty interface.
    damping_number : array_like
        Gamma = C T >= 0. C is the coefficient of the viscous friction f = C w, and T the time since
        the rupture began. Above 1e8 the diffusion limit is used, where the ratio falls as
        Gamma^(-1/2).
    measure : str, optional
        Slip velocity under friction: "origin" (at x = 0), "mean" (over the pulse, weighted with
        slip), "peak" or "time-mean" (slip at x = 0 over duration).
    closure : "consistent" or "paper", optional
        How friction is averaged over the dislocations of a train.

    Returns
    -------
    xarray.Dataset with `ratio`, the slip velocity over the frictionless one at x = 0;
    `by_damping_number` and `by_stress`, its derivatives; and `uncertainty`, its largest relative
    error.

    Raises
    ------
    InputError if an argument is out of range, or the shapes do not match.

    Examples
    --------
    >>> round(float(slipfront.friction_ratio(0.855, 6.28).ratio), 3)
    0.218
    """
    (stress, damping_number), *rest = flat(stress=stress, damping_number=damping_number)
    columns = past_nan(lambda s, d: _slipfront.friction_ratio(s, d, str(measure), str(closure)),
                       stress, damping_number, instead=(1.0, 1.0))
    return of_columns(_slipfront.friction_ratio_described, columns,
                      *rest).assign_attrs(measure=str(measure), closure=str(closure))


def damping_number(stress, slip_velocity_ratio, *, measure="origin", closure="consistent"):
    """Returns the damping number at which viscous friction leaves a given share of the slip
    velocity.

    This is the inverse of `friction_ratio`. The paper reads it with a ruler from its Fig. 10. The
    friction coefficient of a pulse of age T is C = damping_number / T. `stress` and
    `slip_velocity_ratio` broadcast, and NaN in either gives NaN.

    Parameters
    ----------
    stress : array_like
        Stress Sigma- before the rupture, in mu A / pi; 0.05 to 3. The initial stress is a step into
        the empty interface.
    slip_velocity_ratio : array_like
        Slip velocity over the frictionless one at x = 0. It is above 0 and at most its value
        without friction, which is 1 for the measures "origin" and "time-mean".
    measure : str, optional
        Slip velocity under friction: "origin", "mean", "peak" or "time-mean", as in
        `friction_ratio`.
    closure : "consistent" or "paper", optional
        How friction is averaged over the dislocations of a train.

    Returns
    -------
    xarray.Dataset with `damping_number` and its largest error `damping_number_error`. The error
    includes only that of the table.

    Raises
    ------
    InputError if an argument is out of range, or the shapes do not match.

    Examples
    --------
    >>> round(float(slipfront.damping_number(0.855, 0.5).damping_number), 3)
    1.592
    """
    (stress, ratio), *rest = flat(stress=stress, slip_velocity_ratio=slip_velocity_ratio)
    columns = past_nan(lambda s, r: _slipfront.damping_number(s, r, str(measure), str(closure)),
                       stress, ratio, instead=(1.0, 0.5))
    return of_columns(_slipfront.damping_number_described, columns,
                      *rest).assign_attrs(measure=str(measure), closure=str(closure))
