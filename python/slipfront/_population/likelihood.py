"""Likelihood of the parameters of a population, with the states of all events integrated out.

The state of an event is ln(Sigma-), ln(A) and ln(C / b). Given Sigma- and Gamma, the observed size
is proportional to A, so that the integral over A is in closed form. The others are sums over nodes
of the table of the theory: over kappa = ln(A C / b), which gives Gamma, and over ln(Sigma-). The
nodes cover the population, and their steps are narrower than the integrand, so that the sums are
accurate to about 1e-3.
"""

import dataclasses
import functools

from .._numbers import np
from .._optional import import_optional
from . import forward, priors
from .selection import Selection

REACH = 5.0  # standard deviations of kappa, ln(Sigma-) and the front that are summed
RESOLUTION = 1.4  # largest step between nodes, in standard deviations of the narrowest integrand
LEAST_ERROR = 0.01  # errors of the front below this are replaced by it
STRIDES = np.array([1, 2, 3, 4, 5, 6, 8, 9, 10, 12])  # Nodes are so many X
# Weights of Gregory's formula, for a sum that ends where the integrand is not zero
END_WEIGHTS = np.array([3 / 8, 7 / 6, 23 / 24])
STEP = forward.LOG_DAMPING[1] - forward.LOG_DAMPING[0]
# Largest ln(Gamma) of a node; the front and the size of larger ones are those of this one
MOST_DAMPING = 60.0
CHUNK = 60_000  # nodes that are summed at once, so that they fit into the cache
STUDY_REACH = 4.0  # standard deviations between studies
LEAST_IN_TABLE = 0.9  # share of the events of a population whose Sigma- must be in the table
FINE = np.linspace(-STUDY_REACH, STUDY_REACH, 81)


#: Stresses of the table. At low stress ln|V-| is about -3 / Sigma-, so that equal steps are in u =
#: 3 ln(Sigma-) - 3 / Sigma-.
STRESS_STEPS = 1440
_u = 3 * forward.LOG_STRESS - 3 * np.exp(-forward.LOG_STRESS)
LOG_STRESS = np.interp(np.linspace(_u[0], _u[-1], STRESS_STEPS + 1), _u, forward.LOG_STRESS)
STRESS_STEP = (_u[-1] - _u[0]) / STRESS_STEPS
U_SLOPE = 3 + 3 * np.exp(-LOG_STRESS)  # du / d ln(Sigma-)


@functools.lru_cache(maxsize=None)
def _between(count):
    """Returns `count` offsets of a study in standard deviations, and their spline to FINE."""
    offsets = np.linspace(-STUDY_REACH, STUDY_REACH, count)
    return offsets, import_optional("scipy.interpolate").CubicSpline(offsets, np.eye(count))(FINE)


def _tables(function, keys):
    """Returns tables of function(key), their number of rows, and the steepest slopes in u."""
    log_damping = np.arange(forward.LOG_DAMPING[0], MOST_DAMPING, STEP)
    tables = np.array([forward.at(function(key), LOG_STRESS, log_damping[:, None]) for key in keys])
    slope = np.abs(np.gradient(tables, STRESS_STEP, axis=2)).max(axis=(0, 1))
    return tables.reshape(-1, STRESS_STEPS + 1).astype(np.float32), len(log_damping), slope


@dataclasses.dataclass
class Nodes:
    """Nodes of events (first axis) in kappa (second) and ln(Sigma-) (third)."""

    # Ln of the weight of each node: the population times the likelihood of the front
    weight: np.ndarray
    rest: np.ndarray  # ln(A) that the size of each node lacks
    deviation: np.ndarray  # standard deviation of `rest`, for each event
    kappa: np.ndarray
    kappa_step: float
    column: np.ndarray  # column of the table for the first ln(Sigma-)
    stride: int  # columns between nodes


class Likelihood:
    """Log likelihood of a population. `log_hardness` is ln of the hardness in Pa."""

    def __init__(self, events, log_hardness, prior=None):
        self.events, self.log_hardness, self.prior = events, log_hardness, prior or priors.Prior()
        self.front_error = np.maximum(events.front_error, LEAST_ERROR)
        self.slant = events.shared / self.front_error**2
        self.error = np.sqrt(np.maximum(events.size_error**2 - events.shared * self.slant, 1e-8))
        thresholds, which = np.unique(events.threshold, return_inverse=True)
        self.fronts, self.rows, self.front_slope = _tables(forward.front, thresholds)
        self.front_row = which * self.rows
        self.front_rise = np.abs(np.diff(self.fronts.reshape(-1, self.rows, STRESS_STEPS + 1),
                                         axis=1)).max() / STEP
        kinds, which = np.unique(events.kind, return_inverse=True)
        self.sizes, _, self.size_slope = _tables(forward.size, kinds)
        self.size_row = which * self.rows
        self.place = events.log_duration + np.log(events.speed)
        self.low, self.high = self._windows()
        count = np.bincount(events.study)
        self.single = count[events.study] == 1
        self.several = np.flatnonzero(~self.single)
        self.studies = (np.unique(events.study[self.several], return_inverse=True)[1]
                        if len(self.several) else np.empty(0, dtype=int))
        self.selection = Selection(events) if np.isfinite(events.smallest).any() else None

    def _windows(self):
        """Returns the columns that agree with each event's front, for each row of the table."""
        windows = np.empty((2, len(self.events), self.rows), dtype=int)
        for end, sign in zip(windows, (-1, 1)):
            front = (self.events.log_front + sign * REACH * self.front_error).astype(np.float32)
            for first in np.unique(self.front_row):
                chosen = self.front_row == first
                for row in range(self.rows):
                    rising = np.maximum.accumulate(self.fronts[first + row])
                    end[chosen, row] = np.searchsorted(rising, front[chosen])
        return np.clip(windows[0] - 1, 0, STRESS_STEPS), np.clip(windows[1], 0, STRESS_STEPS)

    def _stress_nodes(self, values, scatter, resolution):
        """Returns first and last column, stride, and ln of the weight of each column."""
        centre, spread = np.log(values[0]), values[1]
        low, high = np.searchsorted(LOG_STRESS, [centre - REACH * spread, centre + REACH * spread])
        low, high = min(max(low - 1, 0), STRESS_STEPS - 1), min(high, STRESS_STEPS)
        size_error = np.sqrt(self.error.min() ** 2 + scatter)
        steepest = (np.square(self.front_slope / self.front_error.min())
                    + np.square(self.size_slope / size_error) + np.square(1 / (spread * U_SLOPE)))
        largest = resolution / np.sqrt(steepest[low:high + 1].max()) / STRESS_STEP
        stride = STRIDES[max(np.searchsorted(STRIDES, largest, side="right") - 1, 0)]
        ends = np.ones(STRESS_STEPS + 1)
        ends[::stride][:3] = ends[::-stride][:3] = END_WEIGHTS
        weight = (np.log(ends * stride * STRESS_STEP / U_SLOPE / (spread * np.sqrt(2 * np.pi)))
                  - 0.5 * np.square((LOG_STRESS - centre) / spread))
        return low, high, stride, weight - np.log(share_in_table(values))

    def _columns(self, values, scatter, chosen, rows, resolution):
        """Returns first columns by event and row, stride, columns, and ln of their weights."""
        low, high, stride, weight = self._stress_nodes(values, scatter, resolution)
        first = np.clip(self.low[chosen[:, None], rows], low, high) // stride
        last = -(-np.clip(self.high[chosen[:, None], rows], low, high) // stride)
        most = STRESS_STEPS // stride + 1
        count = min(max((last - first).max() + 1, 6), most)
        first = np.clip(first, 0, most - count) * stride
        columns = first[:, :, None] + stride * np.arange(count)
        return first, stride, columns, np.take(weight.astype(np.float32), columns)

    def _kappa_stride(self, values, scatter, resolution):
        """Returns the rows of the table between nodes: 2 if these are narrow enough, else 1."""
        variance = values[3] ** 2 + values[5] ** 2
        share = values[3] ** 2 / variance
        steepest = 1 / variance + np.square(self.front_rise / self.front_error.min())
        # The slope d ln(size) / d ln(Gamma) is between -1 and 0.
        steepest += max(share, 1 - share) ** 2 / (self.error.min() ** 2 + scatter)
        return 2 if 2 * STEP <= resolution / np.sqrt(steepest) else 1

    def _kappa_nodes(self, values, chosen, stride):
        """Returns rows of the table for each event, kappa there and ln of the weights."""
        centre = np.log(values[2]) - self.log_hardness + np.log(values[4])
        spread = np.hypot(values[3], values[5])
        shift = self.place[chosen] - forward.LOG_DAMPING[0]
        first = np.ceil((centre - REACH * spread + shift) / STEP).astype(int)
        rows = first[:, None] + stride * np.arange(int(2 * REACH * spread / (STEP * stride)) + 1)
        kappa = rows * STEP - shift[:, None]
        weight = (np.log(STEP * stride / (spread * np.sqrt(2 * np.pi)))
                  - 0.5 * np.square((kappa - centre) / spread))
        return np.clip(rows, 0, self.rows - 1), kappa, weight

    def nodes(self, values, chosen, resolution=RESOLUTION):
        _, _, normal, normal_spread, friction, friction_spread, _ = values
        variance = normal_spread**2 + friction_spread**2
        scatter = (normal_spread * friction_spread) ** 2 / variance
        kappa_stride = self._kappa_stride(values, scatter, resolution)
        rows, kappa, kappa_weight = self._kappa_nodes(values, chosen, kappa_stride)
        first, stride, columns, weight = self._columns(values, scatter, chosen, rows, resolution)
        contact = np.log(normal) - self.log_hardness
        expected = contact + normal_spread**2 / variance * (kappa - contact - np.log(friction))
        error = self.front_error[chosen][:, None]
        kappa_weight = kappa_weight - np.log(error * np.sqrt(2 * np.pi))
        places = columns + (rows * (STRESS_STEPS + 1))[:, :, None]

        def of_table(table, row):
            return np.take(table, places + (row[chosen] * (STRESS_STEPS + 1))[:, None, None])

        def single(array):
            return array.astype(np.float32)[:, :, None]

        off = single(self.events.log_front[chosen, None]) - of_table(self.fronts, self.front_row)
        off *= single(1 / error)
        rest = single(self.events.log_size[chosen, None] - expected)
        rest = rest - of_table(self.sizes, self.size_row)
        if self.slant[chosen].any():
            rest -= single(self.slant[chosen, None] * error) * off
        weight += single(kappa_weight) - np.float32(0.5) * np.square(off)
        return Nodes(weight, rest, np.sqrt(self.error[chosen] ** 2 + scatter), kappa,
                     STEP * kappa_stride, first, stride)

    def each(self, values, offsets, chosen, further=0.0):
        """Returns the log likelihood of each chosen event (first axis), without selection, for each
        offset of its study (second axis).

        `further` is a standard deviation that is added to the error of the size."""
        found: list[np.ndarray] = []
        count = 1
        chosen = np.asarray(chosen)
        while len(found) < len(chosen):
            nodes = self.nodes(values, chosen[len(found):len(found) + count])
            found.extend(_log_sums(nodes, offsets, further))
            count = max(CHUNK // (nodes.weight.size // len(nodes.weight)), 1)
        return np.array(found)

    def __call__(self, values):
        """Returns ln of the likelihood; -inf if too few events are in table or catalogue."""
        if share_in_table(values) < LEAST_IN_TABLE:
            return -np.inf
        if self.selection and not self.selection.prepare(values, self.log_hardness):
            return -np.inf
        total = 0.0
        if self.single.any():
            zero, singles = np.zeros(1), np.flatnonzero(self.single)
            total += np.sum(self.each(values, zero, singles, values[-1]))
            if self.selection:
                total -= np.sum(self.selection.log_probability(zero, self.single, single=True))
        if len(self.several):
            total += np.sum(_log_mean(self.by_study(values)))
        return total if np.isfinite(total) else -np.inf

    def by_study(self, values):
        """Returns ln of the likelihood of each study of several events, over FINE."""
        offsets, between = _between(13 if values[-1] < 0.5 else 21)
        each = self.each(values, values[-1] * offsets, self.several)
        if self.selection:
            each -= self.selection.log_probability(values[-1] * offsets, self.several)
        sums = np.zeros((self.studies.max() + 1, len(offsets)))
        np.add.at(sums, self.studies, np.maximum(each, -1e4))
        return sums @ between.T

    def log_posterior(self, x):
        """Returns ln of the posterior density of standard normal x, up to a constant."""
        if np.any(np.abs(x) > 5):
            return -np.inf
        return self(self.prior.values(x)) + priors.log_density(x)


def share_in_table(values):
    """Returns the share of events of a population whose Sigma- is in the range of the table."""
    ndtr = import_optional("scipy.special").ndtr
    low, high = (ndtr((forward.LOG_STRESS[end] - np.log(values[0])) / values[1]) for end in (0, -1))
    return high - low


def _log_sums(nodes, offsets, further):
    """Returns ln of the sum over nodes of weight times the density of `rest` minus offset."""
    count = len(nodes.weight)
    deviation = np.hypot(nodes.deviation, further)
    slope = nodes.rest.reshape(count, -1)
    base = (nodes.weight.reshape(count, -1)
            - np.square(slope) * (0.5 / deviation**2).astype(np.float32)[:, None])
    slope = slope * (1 / deviation**2).astype(np.float32)[:, None]
    sums, exponent = np.empty((count, len(offsets))), np.empty_like(base)
    for i, offset in enumerate(offsets):
        np.multiply(slope, np.float32(offset), out=exponent)
        exponent += base
        most = np.maximum(exponent.max(axis=1), -1e30)
        exponent -= most[:, None]
        sums[:, i] = most + np.log(np.exp(exponent, out=exponent).sum(axis=1) + 1e-30)
    return (sums - 0.5 * np.square(offsets / deviation[:, None])
            - np.log(deviation * np.sqrt(2 * np.pi))[:, None])


def _log_mean(logarithms):
    """Returns ln of the mean over the offsets of a study, which are standard normal."""
    exponent = logarithms - 0.5 * FINE**2
    most = exponent.max(axis=1)
    sums = np.exp(exponent - most[:, None]).sum(axis=1)
    return most + np.log(sums * (FINE[1] - FINE[0]) / np.sqrt(2 * np.pi))
