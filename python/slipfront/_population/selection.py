"""The probability that an event of the population is large enough to enter its catalogue."""

from .._numbers import np
from .._optional import import_optional
from . import forward

STRESS_NODES, KAPPA_NODES, DURATION_NODES, SIZE_NODES = 41, 11, 6, 14
REACH = 4.0  # standard deviations that are summed
STUDY_REACH = 4.0  # standard deviations between studies
LEAST = 1e-3  # A population of which fewer events would enter the catalogue is excluded.
ERROR_STEP = 0.1  # Errors of sizes are rounded to multiples of this.


def _normal_nodes(count):
    places = np.linspace(-REACH, REACH, count)
    weights = np.exp(-0.5 * places**2)
    return places, weights / weights.sum()


_stress_places, _stress_weights = _normal_nodes(STRESS_NODES)
_kappa_places, _kappa_weights = _normal_nodes(KAPPA_NODES)


class Selection:
    """Detection of the events of a catalogue. An event enters it if its observed size is above `events.smallest`."""

    def __init__(self, events):
        if len(np.unique(events.kind)) > 1:
            raise ValueError("events of a catalogue with a detection limit must all have the same kind of size")
        self.events, self.kind = events, events.kind[0]
        self.place = events.log_duration + np.log(events.speed)
        self.grid = np.linspace(self.place.min() - 1e-3, self.place.max() + 1e-3, DURATION_NODES)
        self.level = np.maximum(np.round(events.size_error / ERROR_STEP), 1) * ERROR_STEP
        self.levels = np.unique(self.level)
        self.any_single = (np.bincount(events.study)[events.study] == 1).any()

    def _sizes(self, values, log_hardness):
        """Returns sizes without scatter at the nodes of stress and kappa (second axis) for each duration of the grid, and their weights."""
        stress, stress_spread, normal, normal_spread, friction, friction_spread, _ = values
        contact, variance = np.log(normal) - log_hardness, normal_spread**2 + friction_spread**2
        log_stress = np.log(stress) + stress_spread * _stress_places
        inside = (log_stress >= forward.LOG_STRESS[0]) & (log_stress <= forward.LOG_STRESS[-1])
        off = np.sqrt(variance) * _kappa_places
        kappa = contact + np.log(friction) + off
        sizes = forward.at(forward.size(self.kind), log_stress[:, None, None], (kappa[None, :, None] + self.grid[None, None, :]))
        sizes = sizes + (contact + normal_spread**2 / variance * off)[None, :, None]
        weights = (_stress_weights * inside)[:, None] * _kappa_weights
        with np.errstate(invalid="ignore"):
            weights = weights.ravel() / weights.sum()
        return sizes.reshape(-1, DURATION_NODES).T, weights, normal_spread * friction_spread / np.sqrt(variance)

    def _table(self, sizes, weights, deviation):
        """Returns ln of the probability of a size above each of the limits, for each duration of the grid."""
        ndtr = import_optional("scipy.special").ndtr
        return np.log(np.maximum(np.tensordot(ndtr((sizes[:, :, None] - self.limits) / deviation), weights, axes=(1, 0)), 1e-12))

    def prepare(self, values, log_hardness):
        """Computes the probabilities for these parameters. Returns whether enough events of this population would enter the catalogue."""
        sizes, weights, scatter = self._sizes(values, log_hardness)
        if not np.isfinite(weights).all():
            return False
        reach = values[-1] * STUDY_REACH + 1e-3
        self.limits = np.linspace(self.events.smallest.min() - reach, self.events.smallest.max() + reach, SIZE_NODES)
        deviations = {level: np.hypot(level, scatter) for level in self.levels}
        self.together = {level: self._table(sizes, weights, deviation) for level, deviation in deviations.items()}
        self.alone = {level: self._table(sizes, weights, np.hypot(deviation, values[-1])) if self.any_single else None for level, deviation in deviations.items()}
        return self.log_probability(np.zeros(1), slice(None)).min() > np.log(LEAST)

    def log_probability(self, offsets, chosen, single=False):
        """Returns ln of the probability that each chosen event is detected (first axis), for each offset of its study (second axis)."""
        limit = self.events.smallest[chosen][:, None] - offsets[None, :]
        place = np.broadcast_to(((self.place[chosen] - self.grid[0]) / (self.grid[1] - self.grid[0]))[:, None], limit.shape)
        out = np.empty(limit.shape)
        for level, table in (self.alone if single else self.together).items():
            rows = self.level[chosen] == level
            if rows.any():
                places = [place[rows], (limit[rows] - self.limits[0]) / (self.limits[1] - self.limits[0])]
                out[rows] = np.minimum(import_optional("scipy.ndimage").map_coordinates(table, places, order=3, mode="nearest"), 0)
        return out
