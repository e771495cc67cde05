"""Draws parameters of a population from their posterior distribution.

Particles from the prior are tempered to the posterior (sequential Monte Carlo), so that no mode is
lost; emcee continues from them. Both are done twice, independently, so that R-hat compares two
answers."""

import dataclasses

from .._numbers import np
from .._optional import import_optional
from .._slipfront import NumericsError
from . import priors
from .coordinates import Coordinates

ENSEMBLES, WALKERS = 2, 20
# Particles that are tempered for an ensemble, and their moves at each temperature
PARTICLES, SWEEPS = 100, 2
TRIES = 2000  # draws from the prior for each ensemble, to find particles
WARM_UP = 2 / 5  # share of the steps
# Variance of jumps over that of the particles, and degrees of freedom of their t distribution
WIDER, FREEDOM = 1.2, 6
EFFECTIVE = 0.5  # share of the particles that stays effective from one temperature to the next


@dataclasses.dataclass
class Draws:
    """Posterior draws of the parameters, one row each, in the order of priors.PARAMETERS."""

    values: np.ndarray
    effective: float  # number of independent draws, for the parameter that has the fewest
    rhat: float  # largest R-hat of the halves of the ensembles
    acceptance: float


def _particles(target, generator):
    """Returns particles from the prior, ln of their densities, and finite log likelihoods."""
    found = []
    for _ in range(TRIES):
        x = generator.standard_normal(len(priors.NAMES))
        if np.isfinite(target.likelihood.log_posterior(x)):
            y = target.of(x)
            found.append((y, *target.parts(y)))
            if len(found) == PARTICLES:
                return tuple(np.array(part) for part in zip(*found))
    raise NumericsError("population: no parameters that the prior allows agree with the events; "
                        "check their units and the detection limit")


def _next(power, logs):
    """Returns the largest power of the likelihood that leaves a share EFFECTIVE of particles."""
    def effective(end):
        weights = np.exp((end - power) * (logs - logs.max()))
        return weights.sum() ** 2 / np.square(weights).sum() / len(logs)

    if effective(1.0) >= EFFECTIVE:
        return 1.0
    low, high = power, 1.0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if effective(middle) >= EFFECTIVE else (low, middle)
    return high


class Jumps:
    """Draws from a t distribution around weighted particles, whatever the current x."""

    def __init__(self, x, weights):
        self.centre, self.size = np.average(x, axis=0, weights=weights), x.shape[1]
        covariance = WIDER * np.cov(x.T, aweights=weights)
        self.shape = np.linalg.cholesky(covariance + 1e-6 * np.eye(self.size))

    def draw(self, generator, count):
        scale = np.sqrt(FREEDOM / generator.chisquare(FREEDOM, (count, 1)))
        return self.centre + scale * generator.standard_normal((count, self.size)) @ self.shape.T

    def log_density(self, x):
        """Returns the logarithm of the density, up to a constant."""
        distance = np.square(np.linalg.solve(self.shape, (x - self.centre).T)).sum(axis=0)
        return -0.5 * (FREEDOM + self.size) * np.log1p(distance / FREEDOM)

    def propose(self, x, generator):
        """Returns new x and ln of the factor of acceptance, as a move of emcee."""
        new = self.draw(generator, len(x))
        return new, self.log_density(x) - self.log_density(new)


def _proposal(jumps, x, i, generator):
    """Returns a proposal for particle i, by a jump or a step, and ln of its factor."""
    count, size = x.shape
    kind = generator.random()
    if kind < 0.4:
        new, factor = jumps.propose(x[i:i + 1], generator)
        return new[0], factor[0]
    small = jumps.shape @ generator.standard_normal(size)
    if kind < 0.6:
        return x[i] + generator.choice([1.0, 0.4]) * 2.38 / np.sqrt(size) * small, 0.0
    first, second = generator.choice(count - 1, 2, replace=False)
    along = x[first + (first >= i)] - x[second + (second >= i)]
    return x[i] + generator.choice([1.0, 0.6, 0.3]) * along + 1e-2 * small, 0.0


def _sweep(target, power, particles, jumps, generator):
    y, prior, logs = particles
    for i in range(len(y)):
        new, factor = _proposal(jumps, y, i, generator)
        new_prior, new_log = target.parts(new)
        gain = power * (new_log - logs[i]) + new_prior - prior[i] + factor
        if np.isfinite(new_log) and np.log(generator.random()) < gain:
            y[i], prior[i], logs[i] = new, new_prior, new_log


def _tempered(target, generator):
    """Returns particles that were tempered from the prior to the posterior."""
    particles, power = _particles(target, generator), 0.0
    while power < 1:
        logs = particles[2]
        last, power = power, _next(power, logs)
        weights = np.exp((power - last) * (logs - logs.max()))
        weights /= weights.sum()
        jumps = Jumps(particles[0], weights)
        places = np.searchsorted(np.cumsum(weights),
                                 (np.arange(len(logs)) + generator.random()) / len(logs))
        particles = tuple(part[np.minimum(places, len(logs) - 1)] for part in particles)
        for _ in range(SWEEPS):
            _sweep(target, power, particles, jumps, generator)
    return particles[0] + 1e-3 * generator.standard_normal(particles[0].shape) @ jumps.shape.T


def _rhat(chains):
    """Returns R-hat of chains[ensemble, step, walker], of both halves of each ensemble."""
    half = chains.shape[1] // 2
    parts = np.concatenate([chains[:, :half], chains[:, half:2 * half]])
    parts = parts.reshape(2 * len(chains), -1)
    return float(np.sqrt(1 + parts.mean(axis=1).var(ddof=1) / parts.var(axis=1, ddof=1).mean()))


def sample(likelihood, steps, seed, progress=None):
    """Returns Draws after `steps` steps of each walker, without the warm-up."""
    emcee, target = import_optional("emcee"), Coordinates(likelihood)
    generator = np.random.default_rng(seed)
    chains, times, acceptance = [], [], []
    for ensemble in range(ENSEMBLES):
        particles = _tempered(target, generator)
        # The particles are too few to cover the long ridge of stress and its spread. Moves along
        # differences of walkers follow it; jumps around the particles would keep the walkers where
        # the particles are.
        moves = [(emcee.moves.MHMove(Jumps(particles, None).propose), 0.1),
                 (emcee.moves.DEMove(), 0.5), (emcee.moves.DESnookerMove(), 0.2),
                 (emcee.moves.StretchMove(), 0.2)]
        sampler = emcee.EnsembleSampler(WALKERS, len(priors.NAMES), target, moves=moves)
        sampler.random_state = np.random.RandomState(generator.integers(2**31)).get_state()
        start = generator.permutation(particles)[:WALKERS]
        for step, _ in enumerate(sampler.sample(start, iterations=steps), 1):
            if progress:
                progress(ensemble * steps + step, ENSEMBLES * steps)
        chains.append(sampler.get_chain(discard=int(steps * WARM_UP)))
        times.append(emcee.autocorr.integrated_time(chains[-1], tol=0).max())
        acceptance.append(sampler.acceptance_fraction.mean())
    drawn = np.array(chains)
    drawn = np.array([target.x(y)[0]
                      for y in drawn.reshape(-1, drawn.shape[-1])]).reshape(drawn.shape)
    return Draws(values=likelihood.prior.values(drawn.reshape(-1, drawn.shape[-1])),
                 effective=float(drawn.shape[0] * drawn.shape[1] * WALKERS / max(times)),
                 rhat=max(_rhat(drawn[..., i]) for i in range(drawn.shape[-1])),
                 acceptance=float(np.mean(acceptance)))
