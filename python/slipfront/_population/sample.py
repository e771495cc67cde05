"""Draws parameters of a population from their posterior distribution with emcee."""

import dataclasses

from .._numbers import np
from .._optional import import_optional
from .._slipfront import NumericsError
from . import priors

ENSEMBLES, WALKERS = 2, 20
STARTS = 200  # draws from the prior; climbs to the modes start at the best of them
CLIMBS, CLIMB = 5, 350  # number of climbs, and evaluations of each
LOWER = 8.0  # a mode whose ln(density) is lower than that of the highest by more is left out
WARM_UP = 1 / 4  # share of the steps
WORST = 15.0  # smallest ln(density) of a start, below that of the mode
DIFFERENCE = 0.15  # step for second derivatives, in standard deviations of the prior


@dataclasses.dataclass
class Draws:
    """Posterior draws of the parameters: `values` has a row for each draw, in the order of priors.PARAMETERS."""

    values: np.ndarray
    effective: float  # number of independent draws, for the parameter that has the fewest
    rhat: float  # largest R-hat of the halves of the ensembles
    acceptance: float


def _modes(log_posterior, generator):
    """Returns the parameters x of the largest posterior densities that climbs from several starts reach, the largest first."""
    minimize = import_optional("scipy.optimize").minimize
    x = generator.standard_normal((STARTS, len(priors.NAMES)))
    x[0] = 0
    density = np.array([log_posterior(row) for row in x])
    possible = np.flatnonzero(np.isfinite(density))
    if not len(possible):
        raise NumericsError("population: no parameters that the prior allows agree with the events; check their units and the detection limit")
    found = []
    for start in x[possible[np.argsort(density[possible])[::-1][:CLIMBS]]]:
        simplex = start + np.vstack([np.zeros(x.shape[1]), 0.4 * np.eye(x.shape[1])])
        found.append(minimize(lambda y: -max(log_posterior(y), -1e9), start, method="Nelder-Mead",
                              options={"initial_simplex": simplex, "maxfev": CLIMB, "xatol": 0.02, "fatol": 0.1}))
    found.sort(key=lambda climb: climb.fun)
    return [climb.x for climb in found if climb.fun < found[0].fun + LOWER]


def _covariance(log_posterior, mode):
    """Returns the covariance of the normal distribution that has the curvature of the posterior at its mode. It is not wider than the prior."""
    size, step = len(mode), DIFFERENCE * np.eye(len(mode))

    def at(offset):
        return max(log_posterior(mode + offset), -1e9)

    precision = np.empty((size, size))
    for i in range(size):
        for j in range(i + 1):
            mixed = at(step[i] + step[j]) - at(step[i] - step[j]) - at(step[j] - step[i]) + at(-step[i] - step[j])
            precision[i, j] = precision[j, i] = -mixed / (4 * DIFFERENCE**2)
    widths, axes = np.linalg.eigh(precision)
    return (axes / np.maximum(widths, 1)) @ axes.T


def _starts(log_posterior, generator):
    """Returns a start x for each walker of each ensemble, from the normal distributions around the modes."""
    modes = _modes(log_posterior, generator)
    shapes, least = [_covariance(log_posterior, mode) for mode in modes], log_posterior(modes[0]) - WORST
    starts: list[np.ndarray] = []
    scale = 1.0
    while len(starts) < ENSEMBLES * WALKERS:
        which = len(starts) % len(modes)
        start = generator.multivariate_normal(modes[which], scale * shapes[which])
        if log_posterior(start) > least:
            starts.append(start)
        else:
            scale *= 0.95
    return generator.permutation(np.array(starts)).reshape(ENSEMBLES, WALKERS, -1)


def _rhat(chains):
    """Returns R-hat of chains[ensemble, step, walker]: of the two halves of each ensemble, with all its walkers."""
    half = chains.shape[1] // 2
    parts = np.concatenate([chains[:, :half], chains[:, half:2 * half]]).reshape(2 * len(chains), -1)
    return float(np.sqrt(1 + parts.mean(axis=1).var(ddof=1) / parts.var(axis=1, ddof=1).mean()))


def sample(likelihood, steps, seed, progress=None):
    """Returns Draws of the posterior of a Likelihood after `steps` steps of each walker; those of the warm-up are left out. Raises NumericsError if there is no start."""
    emcee, log_posterior = import_optional("emcee"), likelihood.log_posterior
    generator = np.random.default_rng(seed)
    moves = [(emcee.moves.DEMove(), 0.5), (emcee.moves.DEMove(gamma0=1.0), 0.1), (emcee.moves.DESnookerMove(), 0.1), (emcee.moves.StretchMove(), 0.3)]
    chains, times, acceptance = [], [], []
    for ensemble, start in enumerate(_starts(log_posterior, generator)):
        sampler = emcee.EnsembleSampler(WALKERS, len(priors.NAMES), log_posterior, moves=moves)
        sampler.random_state = np.random.RandomState(generator.integers(2**31)).get_state()
        for step, _ in enumerate(sampler.sample(start, iterations=steps), 1):
            if progress:
                progress(ensemble * steps + step, ENSEMBLES * steps)
        chains.append(sampler.get_chain(discard=int(steps * WARM_UP)))
        times.append(emcee.autocorr.integrated_time(chains[-1], tol=0).max())
        acceptance.append(sampler.acceptance_fraction.mean())
    drawn = np.array(chains)
    return Draws(values=likelihood.prior.values(drawn.reshape(-1, drawn.shape[-1])), effective=float(drawn.shape[0] * drawn.shape[1] * WALKERS / max(times)),
                 rhat=max(_rhat(drawn[..., i]) for i in range(drawn.shape[-1])), acceptance=float(np.mean(acceptance)))
