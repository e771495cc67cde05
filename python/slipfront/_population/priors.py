"""Parameters of the population and their priors."""

import math
from dataclasses import dataclass

from .._numbers import np


@dataclass(frozen=True)
class Parameter:
    """A parameter with a lognormal prior, whose standard deviation is a factor of `factor`."""

    name: str
    long_name: str
    units: str
    median: float
    factor: float


#: Each quantity is lognormal between events, with this median and with this standard deviation of
#: its logarithm (spread).
PARAMETERS = (
    Parameter("stress_median", "median of the stress before the rupture, in mu A / pi", "1", 0.4,
              math.exp(0.5)), Parameter("stress_spread", "standard deviation of ln(stress) between "
                                        "events", "1", 0.15, math.exp(0.6)),
    Parameter("normal_stress_median", "median of the effective normal stress: contact ratio times "
              "hardness", "Pa", 1e7, math.exp(2)),
    Parameter("normal_stress_spread", "standard deviation of ln(normal stress) between events", "1",
              0.5, math.exp(0.5)),
    Parameter("friction_median", "median of friction coefficient over asperity spacing, C / b",
              "m-1", 1e-2, math.exp(3)), Parameter("friction_spread", "standard deviation of ln(C "
                                                   "/ b) between events", "1", 0.7, math.exp(0.5)),
    Parameter("study_spread", "standard deviation of ln(slip) or ln(moment) between studies of one "
              "event", "1", 0.3, math.exp(0.4)),)
NAMES = tuple(parameter.name for parameter in PARAMETERS)


class Prior:
    """Lognormal priors of the parameters. `changes` are {name: (median, factor)}."""

    def __init__(self, changes=None):
        given = {parameter.name: (parameter.median, parameter.factor)
                 for parameter in PARAMETERS} | dict(changes or {})
        self.medians, self.factors = (np.array([given[name][i] for name in NAMES]) for i in (0, 1))

    def values(self, x):
        """Returns the parameters (last axis) of standard normal numbers x."""
        return self.medians * self.factors**x

    def broad(self):
        """Returns the parameters of a population as wide as the prior."""
        values = self.medians.copy()
        for median, spread in ((0, 1), (2, 3), (4, 5)):
            values[spread] = np.hypot(values[spread], np.log(self.factors[median]))
        return values


def log_density(x):
    """Returns the logarithm of the prior density of standard normal numbers x, up to a constant."""
    return -0.5 * np.sum(np.square(x), axis=-1)
