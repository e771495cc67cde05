"""slipfront.friction_ratio and slipfront.damping_number"""

from . import _slipfront
from ._dataset import of_columns
from ._numbers import flat, past_nan


def friction_ratio(stress, damping_number, *, measure="origin", closure="consistent"):
    """What viscous friction leaves of the slip velocity (Fig. 10, against the damping number), from a table that the pulse
    solver made.

    Parameters
    ----------
    stress : Sigma- of a step of stress into the empty interface, in mu A / pi, 0.05 to 3.
    damping_number : Gamma = C T >= 0, with f = C w and T the time since the rupture began. Arguments broadcast.
    measure : "origin" (slip velocity at x = 0), "mean" (weighted with slip), "peak" or "time-mean" (slip over duration).
    closure : "consistent" or "paper".

    Returns a Dataset: ratio (over the frictionless slip velocity at x = 0), its derivatives by_damping_number and by_stress,
    and uncertainty, its largest relative error. Raises InputError.
    """
    (stress, damping_number), *rest = flat(stress=stress, damping_number=damping_number)
    columns = past_nan(lambda s, d: _slipfront.friction_ratio(s, d, str(measure), str(closure)), stress, damping_number, instead=(1.0, 1.0))
    return of_columns(_slipfront.friction_ratio_described, columns, *rest).assign_attrs(measure=str(measure), closure=str(closure))


def damping_number(stress, slip_velocity_ratio, *, measure="origin", closure="consistent"):
    """The damping number from what viscous friction leaves of the slip velocity: friction_ratio read the other way, as with a ruler
    on the paper's Fig. 10. The friction coefficient is C = damping_number / T.

    Parameters
    ----------
    stress : Sigma- of a step of stress into the empty interface, in mu A / pi, 0.05 to 3.
    slip_velocity_ratio : over the frictionless slip velocity at x = 0, above 0 and at most its value without friction (1 for
        "origin" and "time-mean"). Arguments broadcast.
    measure, closure : as of friction_ratio.

    Returns a Dataset: damping_number and damping_number_error, its largest error, from that of the table alone. Raises InputError.
    """
    (stress, ratio), *rest = flat(stress=stress, slip_velocity_ratio=slip_velocity_ratio)
    columns = past_nan(lambda s, r: _slipfront.damping_number(s, r, str(measure), str(closure)), stress, ratio, instead=(1.0, 0.5))
    return of_columns(_slipfront.damping_number_described, columns, *rest).assign_attrs(measure=str(measure), closure=str(closure))
