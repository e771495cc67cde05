"""The uniform train of dislocations (Eqs. 4-5) and the closed-form slip pulse (Eqs. 8-9),
vectorised.

A train is two numbers: phi, with U = tanh(phi) the velocity of the dislocations in c, and psi >= 0,
with sqrt(1 - m) = tanh(psi) of the elliptic parameter m; psi = 0 is the empty interface. Arguments
broadcast as in numpy; results are Datasets over "state", dim_0 ..., or the dimensions of the first
argument that is a DataArray.
"""

from . import _slipfront
from ._dataset import of_columns
from ._dataset import profile as _profile
from ._numbers import flat, one_number
from ._slipfront import InputError

__all__ = ["averages", "edge_speeds", "fields", "jacobi", "profile", "psi_at_rest", "spacing",
           "stress_at_rest"]


def averages(phi, psi, contact=1.0):
    """Averages over a period: k (= stress Sigma), W, <sigma^2>, <sigma^3>, <1 - cos u>, and the
    densities and fluxes P, Q, H, I, J of the conservation laws (Eqs. 5-7), where the relative
    contact ratio is `contact` > 0.

    >>> round(float(slipfront.train.averages(0.1, 1.0).W), 4)
    0.271
    """
    (phi, psi, contact), *rest = flat(phi=phi, psi=psi, contact=contact)
    return of_columns(_slipfront.averages_described, _slipfront.averages(phi, psi, contact), *rest)


def edge_speeds(edges):
    """Speeds of the edges of the bands of rapidities that N trains at one position fill, in c, as
    an array. `edges` are the 2 N rapidities, rising: band, gap, band ... band
    (docs/theory/9_trains.md 9.1). A width may be 0.

    >>> slipfront.train.edge_speeds([-0.1, 0.05, 0.2, 0.45]).round(4).tolist()
    [-0.5541, -0.0799, 0.1358, 0.7522]
    """
    (rapidities,), shape, *_ = flat(edges=edges)
    if len(shape) != 1 or shape[0] % 2 or not shape[0]:
        raise InputError(f"edges: shape {shape}; allowed: one row of an even number of rapidities")
    return _slipfront.edge_speeds(rapidities)


def fields(phi, psi, xi):
    """Slip u, stress sigma and slip velocity w at xi = x - U t from the centre of a dislocation
    (Eq. 4). psi > 0.

    >>> round(float(slipfront.train.fields(0.1, 1.0, 0.0).sigma), 4)
    3.1016
    """
    (phi, psi, xi), *rest = flat(phi=phi, psi=psi, xi=xi)
    return of_columns(_slipfront.fields_described, _slipfront.fields(phi, psi, xi), *rest)


def jacobi(z, psi):
    """Jacobi's am, sn, cn and dn of z at sqrt(1 - m) = tanh(psi), psi > 0.

    >>> round(float(slipfront.train.jacobi(0.5, 1.0).sn), 4)
    0.4721
    """
    (z, psi), *rest = flat(z=z, psi=psi)
    return of_columns(_slipfront.jacobi_described, _slipfront.jacobi(z, psi), *rest)


def spacing(phi, psi):
    """Length of a period, 2 pi / k, in b / A, as an array. psi > 0.

    >>> round(float(slipfront.train.spacing(0.1, 1.0)), 4)
    2.3106
    """
    (phi, psi), shape, *_ = flat(phi=phi, psi=psi)
    return _slipfront.spacing(phi, psi)[0].reshape(shape)


def psi_at_rest(stress):
    """psi of a train at rest under a stress in mu A / pi (0, or 0.0045 to 1e6), as an array.

    >>> round(float(slipfront.train.psi_at_rest(1.0)), 4)
    0.1694
    """
    (stress,), shape, *_ = flat(stress=stress)
    return _slipfront.psi_at_rest(stress)[0].reshape(shape)


def stress_at_rest(psi):
    """Stress of a train at rest, pi cosh(psi) / K, in mu A / pi, as an array. psi > 0.

    >>> round(float(slipfront.train.stress_at_rest(1.0)), 4)
    2.7058
    """
    (psi,), shape, *_ = flat(psi=psi)
    return _slipfront.stress_at_rest(psi)[0].reshape(shape)


def profile(stress, x_over_t, stress_right=0.0):
    """The frictionless pulse that a step of stress becomes (Eqs. 8-9; where the right side is
    stressed, the exact Riemann problem, with two trains at one position): U, Sigma, W and P at x/t
    in c. Attributes left_edge and right_edge are x/t of the edges of what moves.

    >>> slipfront.train.profile(0.855, [-0.1, 0.0, 0.1]).W.round(4).values.tolist()
    [0.0436, 0.0482, 0.026]
    """
    left, right = one_number("stress", stress), one_number("stress_right", stress_right)
    (x,), *rest = flat(x_over_t=x_over_t)
    (left_edge, right_edge), _, _, _, at, _ = _slipfront.riemann_trains(left, 0.0, right, 0.0)
    described = _slipfront.profile_described
    data = _profile(described, at(x)[:len(described)], x, *rest)
    return data.assign_attrs(stress=left, stress_right=right, left_edge=left_edge,
                             right_edge=right_edge)
