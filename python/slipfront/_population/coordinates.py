"""Coordinates in which the posterior of a population is close to a normal distribution.

Stress, normal stress and friction depend on each other along a curved ridge: more friction slows
the front, and more stress makes up for it. So the sampler uses the front and the size of the median
event, the spread of the front, and kappa = ln(A C / b)."""

from .._numbers import np
from .._optional import import_optional
from . import forward, priors

# Is added to d ln(V) / d ln(Sigma-), so that the front grows with the stress everywhere
LEAST_SLOPE = 0.1
NEWTON = 4  # steps to the stress of a front


class Coordinates:
    """Coordinates y of parameters x, for the sampler. `parts` and the call are densities in y."""

    def __init__(self, likelihood):
        spline = import_optional("scipy.interpolate").RectBivariateSpline
        events = likelihood.events
        self.likelihood, self.place = likelihood, float(np.mean(likelihood.place))
        self.front, self.size = (spline(forward.LOG_STRESS, forward.LOG_DAMPING, table, ky=1)
                                 for table in (forward.front(float(np.median(events.threshold))),
                                               forward.size(int(np.median(events.kind)))))

    def _damping(self, kappa):
        return np.clip(kappa + self.place, forward.LOG_DAMPING[0], forward.LOG_DAMPING[-1])

    def _front(self, log_stress, damping):
        return (self.front(log_stress, damping)[:, 0] + LEAST_SLOPE * log_stress,
                np.maximum(self.front(log_stress, damping, dx=1)[:, 0], 0) + LEAST_SLOPE)

    def of(self, x):
        """Returns the coordinates of x; Sigma- must be in the table."""
        prior = self.likelihood.prior
        logs = np.log(prior.medians) + np.log(prior.factors) * x
        contact = logs[2] - self.likelihood.log_hardness
        kappa = contact + logs[4]
        front, slope = self._front(logs[:1], self._damping(kappa))
        size = self.size(logs[0], self._damping(kappa))[0, 0]
        return np.array([front[0], logs[1] + np.log(slope[0]), contact + size, logs[3], kappa,
                         logs[5], logs[6]])

    def _stress(self, front, damping):
        """Returns ln(Sigma-) of this front, and the slope there, or None outside the table."""
        fronts = self._front(forward.LOG_STRESS, damping)[0]
        if not fronts[0] < front < fronts[-1]:
            return None
        log_stress = np.interp(front, fronts, forward.LOG_STRESS)
        for _ in range(NEWTON):
            value, slope = self._front(np.array([log_stress]), damping)
            log_stress = np.clip(log_stress + (front - value[0]) / slope[0], forward.LOG_STRESS[0],
                                 forward.LOG_STRESS[-1])
        return log_stress, slope[0]

    def x(self, y):
        """Returns x and ln of |dx / dy|, up to a constant, or None outside the table."""
        damping = self._damping(y[4])
        found = self._stress(y[0], damping)
        if found is None:
            return None
        log_stress, slope = found
        contact = y[2] - self.size(log_stress, damping)[0, 0]
        logs = np.array([log_stress, y[1] - np.log(slope), contact + self.likelihood.log_hardness,
                         y[3], y[4] - contact, y[5], y[6]])
        prior = self.likelihood.prior
        return (logs - np.log(prior.medians)) / np.log(prior.factors), -np.log(slope)

    def parts(self, y):
        """Returns ln of the prior density of y, and the log likelihood there."""
        found = self.x(y)
        if found is None:
            return -np.inf, -np.inf
        x, jacobian = found
        density = priors.log_density(x)
        return density + jacobian, self.likelihood.log_posterior(x) - density

    def __call__(self, y):
        return sum(self.parts(y))
