"""Functions of arrays: relations, friction_ratio, damping_number and riemann."""

from . import _slipfront
from ._dataset import about, of_columns, profile
from ._numbers import dimensions, flat, np, numbers, one_number, past_nan, thread_count
from ._slipfront import InputError


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
    ways = {"stress": stress, "rupture_velocity": rupture_velocity, "slip_velocity": slip_velocity}
    given = [(name, values) for name, values in ways.items() if values is not None]
    if len(given) != 1:
        many = "more than one quantity was" if given else "nothing was"
        raise InputError(f"relations: {many} given; "
                         "allowed: stress, rupture_velocity or slip_velocity")
    name, values = given[0]
    count = thread_count(threads)
    if stress_right is not None:
        if name != "stress":
            raise InputError(f"relations: stress_right with {name}; "
                             "allowed: stress_right with stress")
        (left, right), *rest = flat(stress=values, stress_right=stress_right)
        columns = _slipfront.step_relations(left, right, count)
        return of_columns(_slipfront.step_quantities, columns, *rest)
    array = numbers(name, values)
    columns = past_nan(lambda values: _slipfront.relations(name, values, count), array.reshape(-1),
                       instead=(0.5,))
    return of_columns(_slipfront.relations_quantities, columns, array.shape,
                      *dimensions(values, array))


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
    stress, measure, closure
        As in `friction_ratio`.
    slip_velocity_ratio : array_like
        Slip velocity over the frictionless one at x = 0. It is above 0 and at most its value
        without friction, which is 1 for the measures "origin" and "time-mean".

    Returns
    -------
    xarray.Dataset with `damping_number` and its largest error `damping_number_error`. The error
    includes only that of the table.

    Raises
    ------
    As `friction_ratio`.

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


_waves = {"kind": {"long_name": "kind of the wave"}, "from": about("x / t of its left edge", "c"),
          "to": about("x / t of its right edge", "c"),
          "trains": about("number of trains at one position in the wave")}


def _train(name, value):
    """Returns stress and velocity of a side, which is a stress or a pair."""
    if isinstance(value, (tuple, list)):
        if len(value) != 2:
            raise InputError(f"{name} = {value!r}: {len(value)} numbers; allowed: a stress, or a "
                             "stress and a velocity")
        return tuple(one_number(f"{name}[{i}]", number) for i, number in enumerate(value))
    return one_number(name, value), 0.0


def riemann(left, right, x_over_t=None, solution="trains"):
    """The motion without friction that follows if two uniform trains of dislocations meet at x = 0:
    the exact Riemann problem, of which the slip pulse (Eqs. 8-9) is the case with an empty right
    side. Where dislocations overtake each other, there are two trains at one position.

    Parameters
    ----------
    left, right : number or (number, number)
        Stress of the train in mu A / pi (0, or 0.0045 to 1e6), and the velocity U of its
        dislocations in c (default: 0). A stress of 0 is the empty interface. One of the two
        stresses is above 0.
    x_over_t : array of any shape, optional
        Positions in the solution, in c. By default there are 201, from a quarter of the width on
        the left of what moves to as much on the right.

    solution : str
        "trains": exact. "shocks": one train at each position, with shocks that conserve
        dislocations and momentum, as in slipfront.pulse. This is an approximation that depends on
        the frame of reference.

    Returns
    -------
    xarray.Dataset with U, Sigma, W and P at x_over_t, and the same four between the waves as
    star_U, star_Sigma, star_W and star_P. The exact solution also has slip (slip since t = 0 over
    t), trains (the number of trains at a position), and Sigma_1, W_1, Sigma_2 and W_2 of each
    train, from the slower one; those of absent trains are NaN. Attributes: left_wave and right_wave
    ("fan", "two-trains", "shock" or "none"), left_wave_edges and right_wave_edges (x/t of the edges
    of the wave, in c, the outer one first), left_edge and right_edge (x/t of the edges of all that
    moves). The exact solution lists its waves from left to right along the dimension wave:
    wave_kind ("fan", "two-trains", "vacuum" or "constant"), wave_from and wave_to (x/t), and
    wave_trains. The relative error is 1e-12 for |U| below 0.9999.

    Raises
    ------
    InputError if a number is out of range, both sides are empty, or the solution is neither
    "trains" nor "shocks".

    Examples
    --------
    >>> meeting = slipfront.riemann((1.0, 0.3), (0.5, -0.2))
    >>> meeting.left_wave, meeting.right_wave, round(float(meeting.star_Sigma), 4)
    ('two-trains', 'two-trains', 1.1814)
    """
    if solution not in ("trains", "shocks"):
        raise InputError(f"solution = {solution!r}: not a solution of the Riemann problem; "
                         "allowed: trains, shocks")
    exact = solution == "trains"
    sides = _train("left", left), _train("right", right)
    if not any(stress for stress, _ in sides):
        raise InputError("left = 0: both sides are empty; allowed: a stress above 0 on one side")
    solve = _slipfront.riemann_trains if exact else _slipfront.riemann
    edges, left_wave, right_wave, between, at, *waves = solve(*sides[0], *sides[1])
    width = edges[1] - edges[0]
    given = np.linspace(edges[0] - width / 4, edges[1] + width / 4,
                        201) if x_over_t is None else x_over_t
    (x,), *rest = flat(x_over_t=given)
    described = _slipfront.profile_described
    data = profile(_slipfront.profile_of_trains_described if exact else described, at(x), x, *rest)
    for (name, long_name, *_), value in zip(described, between):
        data[f"star_{name}"] = (), value, {**data[name].attrs,
                                           "long_name": f"{long_name} between the waves"}
    if exact:
        for key, attrs in _waves.items():
            data[f"wave_{key}"] = "wave", [wave[key] for wave in waves[0]], attrs
    return data.assign_attrs(left_wave=left_wave[0], left_wave_edges=left_wave[1:],
                             right_wave=right_wave[0], right_wave_edges=right_wave[1:],
                             left_edge=edges[0], right_edge=edges[1])
