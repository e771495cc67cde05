"""slipfront.riemann"""

from . import _slipfront
from ._dataset import about, profile
from ._numbers import flat, np, one_number
from ._slipfront import InputError

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
