"""Likelihood of the parameters of a population, with the states of all events integrated out.

The state of an event is ln(Sigma-), ln(A) and ln(C / b). Given Sigma- and Gamma, the observed size is proportional to A, so that the integral
over A is in closed form. The others are sums: over kappa = ln(A C / b), which gives Gamma, and over ln(Sigma-) where the front allows it.
"""

import functools

from .._numbers import np
from .._optional import import_optional
from . import forward, priors
from .selection import Selection

STEP = 0.3  # between nodes in kappa
REACH = 4.5  # standard deviations of kappa that are summed
KAPPA = np.arange(-36.0, 14.0, STEP)
FRONT_REACH = 4.0  # standard deviations of ln(V) that are summed
STRESS_NODES = 24
STUDY_REACH = 4.0  # standard deviations between studies
STUDY_NODES = 13
LEAST_IN_TABLE = 0.9  # share of the events of a population whose Sigma- must be in the table
FINE = np.linspace(-STUDY_REACH, STUDY_REACH, 81)
#: Offsets of a study at which likelihoods are computed, in standard deviations between studies.
STUDY = np.linspace(-STUDY_REACH, STUDY_REACH, STUDY_NODES)


@functools.lru_cache(maxsize=None)
def _between():
    """Returns the matrix of the cubic spline that interpolates between the offsets STUDY to the offsets FINE."""
    return import_optional("scipy.interpolate").CubicSpline(STUDY, np.eye(STUDY_NODES))(FINE)


def _columns(grid, log_damping):
    """Returns the columns of a grid at these ln(Gamma), one a row."""
    return forward.at(grid, forward.LOG_STRESS[None, :], log_damping[:, None])


def _nodes(fronts, sizes, low, high, error, width):
    """Returns nodes in ln(Sigma-) between the fronts `low` and `high`, and the logarithm of their weights in a sum; a row for each kappa.

    Equal steps are best for integrands close to normal densities. These are equal in ln(V) / error + ln(size) / width."""
    nodes = np.empty((len(fronts), STRESS_NODES))
    for row, column, steps in zip(nodes, fronts, fronts / error + sizes / width):
        ends = np.interp(np.interp([low, high], column, forward.LOG_STRESS), forward.LOG_STRESS, steps)
        row[:] = np.interp(np.linspace(*ends, STRESS_NODES), steps, forward.LOG_STRESS)
    edges = np.concatenate([nodes[:, :1], (nodes[:, 1:] + nodes[:, :-1]) / 2, nodes[:, -1:]], axis=1)
    impossible = (low >= fronts[:, -1]) | (high <= fronts[:, 0])
    with np.errstate(divide="ignore", invalid="ignore"):
        return nodes, np.where(impossible[:, None], -np.inf, np.log(np.diff(edges, axis=1)))


class Likelihood:
    """Log likelihood of a population. `log_hardness` is ln of the hardness in Pa."""

    def __init__(self, events, log_hardness, prior=None):
        self.events, self.log_hardness, self.prior = events, log_hardness, prior or priors.Prior()
        shape = (len(events), len(KAPPA), STRESS_NODES)
        self.log_stress, self.blur, self.weight, self.log_contact = (np.empty(shape, dtype=np.float32) for _ in range(4))
        for i in range(len(events)):
            self._place_nodes(i)
        variance = np.maximum(events.front_error, 1e-6) ** 2
        self.error = np.sqrt(np.maximum(events.size_error**2 - events.shared**2 / variance, 1e-8))
        sizes = np.bincount(events.study)
        self.single = sizes[events.study] == 1
        self.several = np.flatnonzero(~self.single)
        self.studies = np.unique(events.study[self.several], return_inverse=True)[1] if len(self.several) else np.empty(0, dtype=int)
        self.selection = Selection(events) if np.isfinite(events.smallest).any() else None

    def _place_nodes(self, i):
        events = self.events
        log_damping = KAPPA + np.log(events.speed[i]) + events.log_duration[i]
        grid, error = forward.front(events.threshold[i]), max(events.front_error[i], 1e-3)
        front = events.log_front[i]
        sizes, width = forward.size(events.kind[i]), 0.1 + 1.3 * events.size_error[i]
        log_stress, weight = _nodes(_columns(grid, log_damping), _columns(sizes, log_damping), front - FRONT_REACH * error, front + FRONT_REACH * error, error, width)
        fronts = forward.at(grid, log_stress, log_damping[:, None])
        # A population may be narrower than the steps between nodes. So half a step of the error of the front is moved to the population,
        # as its variance: the convolution of both is the same.
        rest = np.sqrt(np.maximum(error**2 - np.square(np.gradient(fronts, axis=1) / 2), 0.5 * error**2))
        off = front - fronts
        self.log_stress[i] = log_stress
        self.blur[i] = np.square(np.gradient(log_stress, axis=1) / 2)
        self.weight[i] = weight - 0.5 * (off / rest) ** 2 - np.log(rest * np.sqrt(2 * np.pi))
        size = forward.at(sizes, log_stress, log_damping[:, None])
        self.log_contact[i] = events.log_size[i] - size - events.shared[i] / error**2 * off  # ln(A) without error and study

    def terms(self, values, chosen=slice(None)):
        """Returns the logarithm of the weight of each node, ln(A) that its size lacks, its standard deviation, and the slice of kappa."""
        stress, stress_spread, normal, normal_spread, friction, friction_spread, _ = values
        contact = np.log(normal) - self.log_hardness
        centre, variance = contact + np.log(friction), normal_spread**2 + friction_spread**2
        reach = REACH * np.sqrt(variance)
        every = 2 if variance > 0.5**2 else 1
        first, last = np.searchsorted(KAPPA, [centre - reach, centre + reach])
        part = slice(max(first, 0), max(last, first + 1), every)
        off = KAPPA[part] - centre
        log_kappa = np.log(STEP * every) - 0.5 * off**2 / variance - 0.5 * np.log(2 * np.pi * variance)
        log_stress = self.log_stress[chosen, part]
        width = self.blur[chosen, part] + np.float32(stress_spread**2)
        weight = self.weight[chosen, part] - np.float32(0.5) * (np.square(log_stress - np.float32(np.log(stress))) / width + np.log(width))
        weight += (log_kappa - np.log(share_in_table(values)) - 0.5 * np.log(2 * np.pi)).astype(np.float32)[:, None]
        expected = contact + normal_spread**2 / variance * off
        rest = self.log_contact[chosen, part] - expected.astype(np.float32)[:, None]
        deviation = np.sqrt(self.error[chosen] ** 2 + (normal_spread * friction_spread) ** 2 / variance)
        return weight, rest, deviation, part

    def __call__(self, values):
        """Returns the logarithm of the likelihood of these parameters; -inf if too few events of the population would be in the table or in the catalogue."""
        spread = values[-1]
        if share_in_table(values) < LEAST_IN_TABLE:
            return -np.inf
        if self.selection and not self.selection.prepare(values, self.log_hardness):
            return -np.inf
        total = 0.0
        if self.single.any():
            weight, rest, deviation, _ = self.terms(values, self.single)
            deviation = np.hypot(deviation, spread)
            total += np.sum(_log_sum(weight, rest, deviation))
            if self.selection:
                total -= np.sum(self.selection.log_probability(np.zeros(1), self.single, single=True))
        if len(self.several):
            total += np.sum(_log_mean(self.by_study(values)))
        return total if np.isfinite(total) else -np.inf

    def by_study(self, values):
        """Returns the logarithm of the likelihood of each study with several events, for the offsets FINE * study_spread."""
        weight, rest, deviation, _ = self.terms(values, self.several)
        offsets = values[-1] * STUDY
        each = np.stack([_log_sum(weight, rest - np.float32(offset), deviation) for offset in offsets], axis=1)
        if self.selection:
            each -= self.selection.log_probability(offsets, self.several)
        sums = np.zeros((self.studies.max() + 1, STUDY_NODES))
        np.add.at(sums, self.studies, np.maximum(each, -1e4))
        return sums @ _between().T

    def log_posterior(self, x):
        """Returns the logarithm of the posterior density of standard normal numbers x, up to a constant."""
        if np.any(np.abs(x) > 5):
            return -np.inf
        return self(self.prior.values(x)) + priors.log_density(x)


def share_in_table(values):
    """Returns the share of events of a population whose Sigma- is in the range of the table."""
    ndtr = import_optional("scipy.special").ndtr
    low, high = (ndtr((forward.LOG_STRESS[end] - np.log(values[0])) / values[1]) for end in (0, -1))
    return high - low


def _log_sum(weight, rest, deviation):
    """Returns ln of the sum over all nodes of weight times the normal density of `rest`."""
    exponent = weight - np.square(rest) * (0.5 / deviation**2).astype(np.float32)[:, None, None]
    exponent = exponent.reshape(len(exponent), -1)
    most = np.maximum(exponent.max(axis=1), -1e30)
    with np.errstate(divide="ignore"):
        return most + np.log(np.exp(exponent - most[:, None]).sum(axis=1)) - np.log(deviation * np.sqrt(2 * np.pi))


def _log_mean(logarithms):
    """Returns ln of the mean over the offsets of a study, which are standard normal."""
    exponent = logarithms - 0.5 * FINE**2
    most = exponent.max(axis=1)
    return most + np.log(np.exp(exponent - most[:, None]).sum(axis=1) * (FINE[1] - FINE[0]) / np.sqrt(2 * np.pi))
