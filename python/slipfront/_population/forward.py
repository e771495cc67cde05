"""Predictions of the theory for one event, on a grid of ln(Sigma-) and ln(Gamma)."""

import functools

from .. import _slipfront
from .._numbers import np
from .._optional import import_optional
from .._potency import LEAST_STRESS, MOST_STRESS, share

#: The grid. Below its first Gamma there is no friction to speak of; above 1e8 everything follows
#: its limit of diffusion.
LOG_STRESS = np.linspace(np.log(LEAST_STRESS), np.log(MOST_STRESS), 401)
LOG_DAMPING = np.arange(-9.0, 27.01, 0.25)

#: Kinds of observed size: slip, as time-mean slip velocity, and moment, as potency.
SLIP, MOMENT = 0, 1


def _on_grid(function):
    # Exp(ln x) differs from x by rounding
    stresses = np.clip(np.exp(LOG_STRESS), LEAST_STRESS, MOST_STRESS)
    stress, damping = (grid.ravel()
                       for grid in np.meshgrid(stresses, np.exp(LOG_DAMPING), indexing="ij"))
    return function(stress, damping).reshape(len(LOG_STRESS), len(LOG_DAMPING))


def _free(name):
    names = [about[0] for about in _slipfront.relations_quantities]
    columns = _slipfront.relations("stress", np.exp(LOG_STRESS), 1)
    return np.log(columns[names.index(name)])[:, None]


@functools.lru_cache(maxsize=None)
def size(kind):
    """Returns ln(size / A): pi w / c for slip (w = slip over T), pi P / (c T)^2 for potency P."""
    if kind == SLIP:
        ratio = _on_grid(lambda s, g: _slipfront.friction_ratio(s, g, "time-mean", "consistent")[0])
        return _free("slip_velocity") + np.log(ratio)
    potency = _on_grid(lambda s, g: share(s, g)[0])
    return _free("rupture_velocity") + _free("slip_velocity") + potency


@functools.lru_cache(maxsize=None)
def front(threshold):
    """Returns ln(V / c) of the front above a threshold of an observer; 0 means |V-|."""
    free = _free("rupture_velocity") + np.zeros(len(LOG_DAMPING))
    if not threshold:
        return free
    ratio = _on_grid(lambda s, g: _slipfront.front_ratio(s, g, threshold, "consistent"))
    return free + np.log(ratio)


def at(grid, log_stress, log_damping):
    """Returns the values of a grid, interpolated linearly. Outside the grid they are those of its
    edge, except that sizes and fronts follow their last slope above the largest Gamma."""
    image = import_optional("scipy.ndimage")
    log_stress, log_damping = np.broadcast_arrays(log_stress, log_damping)
    places = [(log_stress - LOG_STRESS[0]) / (LOG_STRESS[1] - LOG_STRESS[0]),
              (log_damping - LOG_DAMPING[0]) / (LOG_DAMPING[1] - LOG_DAMPING[0])]
    values = image.map_coordinates(grid, places, order=1, mode="nearest")
    slope = (grid[0, -1] - grid[0, -2]) / (LOG_DAMPING[1] - LOG_DAMPING[0])
    return values + slope * np.maximum(log_damping - LOG_DAMPING[-1], 0)
