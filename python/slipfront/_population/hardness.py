"""Posterior of the hardness over modulus h of laboratory fronts, by quadrature on a grid in (ln h,
ln s).

The front i has its own y_i = ln h_i, which is normal about ln h with the standard deviation s. Its
likelihood L_i(y) is known on a grid of y, as point masses. The posterior is the prior times the
product over i of the integral of L_i(y) N(y; ln h, s) over y.
"""

import math

from .. import _slipfront
from .._numbers import np

#: Smallest stress for which the closed form has a velocity, and the probability outside the range
#: of a measurement that is left out.
LEAST_STRESS, TAIL = 0.0045, 1e-10
LARGEST_LN_STRESS = 700.0  # its exponential is still a double

#: Cells across the range of y of a front, and those of a front whose range is wide because its
#: velocity is near c or near 0.
CELLS, CELLS_IF_WIDE, WIDE = 120, 800, 2.0

#: A sum of equal Gaussians is smooth if their width is at least this many spacings (its ripple is
#: below 1e-4).
NARROWEST = 0.7


def closed_form(ln_stress):
    """Returns (V / c, 1 - Sigma(0) / Sigma-) of ln Sigma- (Eqs. 8-10)."""
    stress = np.exp(np.clip(np.atleast_1d(ln_stress), math.log(LEAST_STRESS),
                            LARGEST_LN_STRESS)).ravel()
    columns = dict(zip((about[0] for about in _slipfront.relations_quantities),
                       _slipfront.relations("stress", stress, 1)))
    shape = np.shape(np.atleast_1d(ln_stress))
    return (columns["rupture_velocity"].reshape(shape),
            (1 - columns["stress_at_origin"] / columns["stress"]).reshape(shape))


def ln_stress_of(velocity):
    return math.log(_slipfront.relations("rupture_velocity", np.array([velocity]), 1)[0][0])


class Cells:
    """Equal cells in a logarithm with a mass in each. An exact number is one cell."""

    def __init__(self, centres, masses):
        self.centres, self.masses = centres, masses

    @staticmethod
    def of_input(measured, spacing):
        """The distribution of ln x of a measured x > 0."""
        if measured.is_exact:
            return Cells(np.array([math.log(measured.middle)]), np.ones(1))
        low, high = ends_of(measured)
        edges = low + spacing * np.arange(math.ceil((high - low) / spacing) + 1)
        masses = np.diff(measured.share_below(np.exp(edges)))
        return Cells((edges[1:] + edges[:-1]) / 2, masses / masses.sum())


def ends_of(measured):
    """Returns a range of ln x for a measured x > 0, outside which there is almost nothing."""
    if measured.is_exact:
        return math.log(measured.middle), math.log(measured.middle)
    low, high = float(measured.quantile(TAIL)), float(measured.quantile(1 - TAIL))
    return math.log(max(low, 1e-3 * measured.middle)), math.log(high)


def velocity_range(measured, speed, highest):
    """Returns the range of ln Sigma-, up to `highest`, that a front velocity permits."""
    low, high = (float(measured.quantile(p)) / speed
                 for p in ((TAIL, 1 - TAIL) if not measured.is_exact else (0.5, 0.5)))
    lowest = math.log(LEAST_STRESS)
    return (max(lowest, ln_stress_of(low)) if low > 1e-300 else lowest,
            ln_stress_of(high) if high < 1 - 1e-12 else highest)


def velocity_likelihood(measured, speed, ends, spacing):
    """Returns the Cells of ln Sigma- with the integral of the likelihood of the velocity over each
    cell.

    The integral is exact if the velocity (lognormal errors: its logarithm) is linear in ln Sigma-
    across a cell."""
    if measured.is_exact:
        return Cells(np.array([ends[0]]), np.ones(1))
    edges = ends[0] + spacing * np.arange(max(1, math.ceil((ends[1] - ends[0]) / spacing)) + 1)
    velocity = closed_form(edges)[0] * speed
    across = np.diff(np.log(velocity) if measured.is_lognormal else velocity)
    share = np.diff(measured.share_below(velocity))
    middle = measured.middle
    # The likelihood of a normal error falls towards 0, see docs/events.md.
    if not (measured.is_lognormal or measured.is_range):
        even = measured.least_even_share * middle
        share *= np.minimum(1, (velocity[1:] + velocity[:-1]) / 2 / even)
    below, above = measured.share_below(middle * np.array([1 - 1e-6, 1 + 1e-6]))
    peak = float(above - below)
    peak /= math.log((1 + 1e-6) / (1 - 1e-6)) if measured.is_lognormal else 2e-6 * middle
    # The velocity no longer depends on the stress
    flat = across < 1e-9 * (1 if measured.is_lognormal else middle)
    masses = np.where(flat, peak * measured.likelihood(velocity[1:]),
                      share / np.where(flat, 1, across))
    return Cells((edges[1:] + edges[:-1]) / 2, masses * spacing)


class Evidence:
    """The likelihood L(y) of one front as masses at points y = ln h, on several levels, each with
    twice the spacing of the one before.

    `ratio` has the distribution of ln(tau / sigma_N). `possible` is false where velocity and stress
    drop exclude each other."""

    def __init__(self, front, speed, ln_factor, highest):
        """ln Sigma- = y + `ln_factor` + ln(tau / sigma_N), with y at most `highest`."""
        tau, normal = ends_of(front.shear_stress), ends_of(front.normal_stress)
        ends = velocity_range(front.front_velocity, speed, highest + ln_factor + tau[1] - normal[0])
        width = ends[1] - ends[0] + tau[1] - tau[0] + normal[1] - normal[0]
        spacing = width / (CELLS if width < WIDE else CELLS_IF_WIDE) or 1.0
        stress = velocity_likelihood(front.front_velocity, speed, ends, spacing)
        shear, pressure = (Cells.of_input(measured, spacing)
                           for measured in (front.shear_stress, front.normal_stress))
        joint = stress.masses[:, None] * shear.masses
        if front.stress_drop is not None:
            drops = closed_form(stress.centres)[1][:, None] * np.exp(shear.centres)
            joint = joint * front.stress_drop.likelihood(drops)
        i, j = np.indices(joint.shape)
        difference = np.bincount((i - j + shear.masses.size - 1).ravel(), weights=joint.ravel())
        masses = np.convolve(difference, pressure.masses)
        first = stress.centres[0] - shear.centres[-1] + pressure.centres[0] - ln_factor
        ratios = np.convolve(shear.masses, pressure.masses[::-1])
        least = shear.centres[0] - pressure.centres[-1]
        self.ratio = Cells(least + spacing * np.arange(ratios.size), ratios)
        self.possible = bool(masses.sum() > 0)
        self.levels = self._levels(first + spacing * np.arange(masses.size),
                                   masses / (masses.sum() or 1), spacing)
        self.mean = float((self.levels[0][0] * self.levels[0][1]).sum())

    @staticmethod
    def _levels(points, masses, spacing):
        """Returns [(points, masses, spacing, variance added by merging)], finest first."""
        levels, added = [], 0.0
        while True:
            there = masses > 0
            levels.append((points[there], masses[there], spacing if masses.size > 1 else 0.0,
                           added))
            if masses.size < 16:
                return levels
            # Each second point gives half of its mass to either neighbour
            merged = np.convolve(masses, [0.5, 1, 0.5])
            points = points[0] + spacing * (np.arange(merged[::2].size) * 2 - 1)
            masses, added = merged[::2], added + spacing**2 / 2
            spacing *= 2

    def log_likelihood(self, y, scatter):
        """Returns ln of the integral of L(x) N(x; y, scatter) over x, for an array of y."""
        points, masses, spacing, added = next((level for level in reversed(self.levels)
                                               if level[2] <= scatter / 1.5), self.levels[0])
        variance = max(scatter**2 - added, (NARROWEST * spacing) ** 2)
        exponents = (np.asarray(y)[:, None] - points) ** 2 * (-0.5 / variance) + np.log(masses)
        top = exponents.max(axis=1)
        return top + np.log(np.exp(exponents - top[:, None]).sum(axis=1)) - 0.5 * math.log(variance)

    def quantiles(self, shares):
        points, masses = self.levels[0][:2]
        return np.interp(shares, np.cumsum(masses) - masses / 2,
                         points) if points.size > 1 else np.full(len(shares), points[0])


def zoom(function, low, high, count, depth):
    """Returns (points, values) of the part of [low, high] within `depth` of the maximum."""
    while True:
        points = np.linspace(low, high, count)
        values = function(points)
        there = np.flatnonzero(values > values.max() - depth)
        first, last = max(there[0] - 1, 0), min(there[-1] + 1, count - 1)
        if last - first >= 0.4 * (count - 1) or points[last] - points[first] < 1e-12:
            return points, values
        low, high = points[first], points[last]


def refined(points, density, factor=6):
    """Returns (points, shares below) of a density at equal steps, by cubic interpolation."""
    at = np.linspace(0, points.size - 1, (points.size - 1) * factor + 1)
    first = np.clip(at.astype(int) - 1, 0, points.size - 4)
    t = at - first
    factors = (-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2,
               -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6)
    finer = np.maximum(sum(factor * density[..., first + k] for k, factor in enumerate(factors)), 0)
    shares = np.cumsum((finer[..., 1:] + finer[..., :-1]) / 2, axis=-1)
    shares = np.concatenate([np.zeros((*density.shape[:-1], 1)), shares], axis=-1)
    return np.linspace(points[0], points[-1], at.size), shares / shares[..., -1:]


class Posterior:
    """The posterior of (ln h, ln s) on a grid. Each scatter s has its own grid of ln h."""

    def __init__(self, evidence, prior, scatter_prior):
        self._evidence, self._ends = evidence, np.log(prior)
        self._last = self._ends
        self._grids: dict[float, tuple] = {}

        def log_evidence(ln_scatters):
            return np.array([self._at(x) for x in ln_scatters[::-1]])[::-1]

        nodes, logs = zoom(log_evidence, math.log(scatter_prior[0]), math.log(scatter_prior[1]), 33,
                           12)
        weights = np.exp(logs - logs.max())
        self.ln_scatter, self.scatter_shares = refined(nodes, weights)
        weights[[0, -1]] /= 2  # trapezoidal rule
        self.nodes, self.weights = nodes, weights / weights.sum()
        grids = [refined(y, np.exp(values - values.max()))
                 for y, values in (self._grids[x] for x in nodes)]
        self.y, self.shares = (np.array(arrays) for arrays in zip(*grids))

    def _at(self, ln_scatter):
        """Returns the logarithm of the integral over ln h at one scatter, and keeps the grid.

        The search begins near the grid of the scatter before, which was a little larger."""
        def log_density(y):
            return sum(one.log_likelihood(y, math.exp(ln_scatter)) for one in self._evidence)

        margin, (least, most) = np.ptp(self._last) / 2, self._ends
        low, high = max(self._last[0] - margin, least), min(self._last[-1] + margin, most)
        y, logs = zoom(log_density, low, high, 49, 18)
        cut = logs > logs.max() - 9
        if (low > least and cut[0] and y[0] == low) or (high < most and cut[-1] and y[-1] == high):
            y, logs = zoom(log_density, least, most, 49, 18)
        self._last, self._grids[ln_scatter] = y, (y, logs)
        total = np.exp(logs - logs.max())
        return logs.max() + math.log((total.sum() - (total[0] + total[-1]) / 2) * (y[1] - y[0]))

    def share_below(self, y):
        """Returns the posterior probability that ln h is below y."""
        return float(sum(weight * np.interp(y, grid, shares)
                         for weight, grid, shares in zip(self.weights, self.y, self.shares)))

    def share_of_scatter_below(self, ln_scatter):
        """Returns the posterior probability that ln s is below a value."""
        return float(np.interp(ln_scatter, self.ln_scatter, self.scatter_shares))

    def quantiles(self, shares):
        y = np.unique(self.y)
        below = sum(weight * np.interp(y, grid, rows)
                    for weight, grid, rows in zip(self.weights, self.y, self.shares))
        return np.interp(shares, below, y), np.interp(shares, self.scatter_shares, self.ln_scatter)

    def draws(self, count, random):
        """Returns `count` draws of (ln h, ln s): stratified in s, and independent in h."""
        at = random.permutation((np.arange(count) + random.random(count)) / count)
        ln_scatter = np.interp(at, self.scatter_shares, self.ln_scatter)
        position = np.interp(ln_scatter, self.nodes, np.arange(self.nodes.size))
        below = np.minimum(position.astype(int), self.nodes.size - 2)
        row = below + (random.random(count) < position - below)
        y, level = np.empty(count), random.random(count)
        for i in np.unique(row):
            y[row == i] = np.interp(level[row == i], self.shares[i], self.y[i])
        return y, ln_scatter
