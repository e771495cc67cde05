"""The probability that an event of the population is large enough to enter its catalogue."""

from .._numbers import np
from .._optional import import_optional
from . import forward

KAPPA_NODES, SIZE_NODES = 13, 14
STRESS_NODES = 24, 48  # for populations of a spread of stress below and above WIDE
WIDE = 0.2
DURATION_STEP = 0.6  # largest step of ln(duration) between nodes
REACH = 5.0  # standard deviations that are summed
STUDY_REACH = 4.0  # standard deviations between studies
LEAST = 1e-3  # A population of which fewer events would enter the catalogue is excluded.
ERROR_STEP = 0.05  # Errors of sizes are rounded to multiples of this.


_legendre = [np.polynomial.legendre.leggauss(count) for count in STRESS_NODES]
_kappa_places = np.linspace(-REACH, REACH, KAPPA_NODES)
_kappa_weights = np.exp(-0.5 * _kappa_places**2) / np.exp(-0.5 * _kappa_places**2).sum()


def _stress_nodes(stress, spread):
    """Returns nodes of ln(Sigma-) and normal weights, which are NaN outside the table."""
    low, high = (np.clip(np.log(stress) + reach * spread, forward.LOG_STRESS[0],
                         forward.LOG_STRESS[-1]) for reach in (-REACH, REACH))
    places, weights = _legendre[int(spread > WIDE)]
    places = (low + high) / 2 + (high - low) / 2 * places
    weights = weights * np.exp(-0.5 * np.square((places - np.log(stress)) / spread))
    with np.errstate(invalid="ignore"):
        return places, weights / weights.sum() * (1.0 if high > low else np.nan)


class Selection:
    """Detection: a catalogue has the events whose observed size is above events.smallest."""

    def __init__(self, events):
        if len(np.unique(events.kind)) > 1:
            raise ValueError("events of a catalogue with a detection limit must all have the same "
                             "kind of size")
        self.events, self.kind = events, events.kind[0]
        self.place = events.log_duration + np.log(events.speed)
        low, high = self.place.min() - 1e-3, self.place.max() + 1e-3
        self.grid = np.linspace(low, high, 4 + int((high - low) / DURATION_STEP))
        self.level = np.maximum(np.round(events.size_error / ERROR_STEP), 1) * ERROR_STEP
        self.levels = np.unique(self.level)
        self.any_single = (np.bincount(events.study)[events.study] == 1).any()

    def _sizes(self, values, log_hardness):
        """Returns sizes without scatter by duration and node of (stress, kappa), and weights."""
        stress, stress_spread, normal, normal_spread, friction, friction_spread, _ = values
        contact, variance = np.log(normal) - log_hardness, normal_spread**2 + friction_spread**2
        log_stress, stress_weights = _stress_nodes(stress, stress_spread)
        off = np.sqrt(variance) * _kappa_places
        kappa = contact + np.log(friction) + off
        sizes = forward.at(forward.size(self.kind), log_stress[:, None, None],
                           (kappa[None, :, None] + self.grid[None, None, :]))
        sizes = sizes + (contact + normal_spread**2 / variance * off)[None, :, None]
        weights = stress_weights[:, None] * _kappa_weights
        return (sizes.reshape(-1, len(self.grid)).T, weights.ravel(),
                normal_spread * friction_spread / np.sqrt(variance))

    def _table(self, sizes, weights, deviation):
        """Returns a spline of ln P(size > limit), in ln(duration) and the limit."""
        ndtr = import_optional("scipy.special").ndtr
        spline = import_optional("scipy.interpolate").RectBivariateSpline
        above = ndtr((sizes[:, :, None] - self.limits) / deviation)
        probability = np.tensordot(above, weights, axes=(1, 0))
        return spline(self.grid, self.limits, np.log(np.maximum(probability, 1e-12)))

    def prepare(self, values, log_hardness):
        """Computes the probabilities. Returns whether enough events enter the catalogue."""
        sizes, weights, scatter = self._sizes(values, log_hardness)
        if not np.isfinite(weights).all():
            return False
        reach = values[-1] * STUDY_REACH + 1e-3
        self.limits = np.linspace(self.events.smallest.min() - reach,
                                  self.events.smallest.max() + reach, SIZE_NODES)
        deviations = {level: np.hypot(level, scatter) for level in self.levels}
        self.together = {level: self._table(sizes, weights, deviation)
                         for level, deviation in deviations.items()}
        self.alone = {level: self._table(sizes, weights, np.hypot(deviation, values[-1]))
                      if self.any_single else None for level, deviation in deviations.items()}
        return self.log_probability(np.zeros(1), slice(None)).min() > np.log(LEAST)

    def log_probability(self, offsets, chosen, single=False):
        """Returns ln P(detected) of each chosen event, for each offset of its study."""
        limit = self.events.smallest[chosen][:, None] - offsets[None, :]
        place = np.broadcast_to(self.place[chosen][:, None], limit.shape)
        out = np.empty(limit.shape)
        for level, table in (self.alone if single else self.together).items():
            rows = self.level[chosen] == level
            if rows.any():
                out[rows] = np.minimum(table.ev(place[rows], limit[rows]), 0)
        return out
