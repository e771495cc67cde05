"""Slip pulses on frictional interfaces.

slipfront computes how fast an interface slips from the stress that is stored along it, and the
stress from the slip.

The functions have the names of the commands of the program and return xarray Datasets. A variable
is dimensionless unless its attribute `units` gives a unit. Multiply a dimensionless variable by its
attribute `dimensional_unit`. The attribute `references` gives its equation in the paper
(Gershenzon, Bambakidis and Skinner 2015, doi 10.3390/lubricants3020311).

    relations   stress, rupture velocity and slip velocity of a frictionless pulse, each from any
    other (Eqs. 8-10) riemann     the waves between two uniform trains of dislocations that meet:
    fans and shocks (Eqs. 6-7) friction_ratio
                share of the slip velocity that remains under viscous friction (Fig. 10)
    damping_number
                inverse of friction_ratio: the damping number for a given share
    moment_duration
                potency of a pulse against its duration, and the exponent of the duration
    train       the uniform train of dislocations (Eqs. 4-5) and the closed-form profile of a pulse
    medium      constants of rock and interface (Eqs. 1-3)
    pulse       runs a scenario with the modulation equations and friction (Eqs. 7)
    chain       runs a scenario with every dislocation (Eqs. 1 and 3)
    plane       runs a rupture on a fault plane (Eqs. 7 on a plane), or every dislocation line
    compare     runs a scenario with closed form, pulse and chain, and compares them
    sweep       runs a pulse or a chain over a grid of settings, on all cores or on a Dask cluster
    event       stress and contact ratio of observed events
    fronts      fronts of a run: path, velocity, and the stress ahead
    arrivals    velocity of a front from its arrival times at gauges
    laboratory  hardness over modulus from the velocities of fronts in the laboratory
    laboratory_events  stick-slip events in the record of an experiment
    population  stress, normal stress and friction of many events, and how much they scatter
    check       checks a scenario without running it
    open        reads a file that slipfront has written
    dataset.slipfront.si
                converts a Dataset to SI units
    cases       folder of the scenarios that come with slipfront
    __version__ version of the package
"""

import pathlib
import sys
import types

from ._optional import require_compiled

require_compiled()

from . import _accessor, medium, train
from ._arrivals import arrivals
from ._event import event
from ._friction_ratio import damping_number, friction_ratio
from ._fronts import fronts
from ._population.laboratory import laboratory
from ._population.hierarchy import population
from ._potency import moment_duration
from ._relations import relations
from ._riemann import riemann
from ._run import chain, check, compare, open, plane, pulse
from ._sweep import sweep
from ._shown import shortened
from ._slipfront import FileError, InputError, NumericsError, __version__


def _shorten_messages(error):
    """Makes str(error) short, whatever long names or values its message has."""
    base = error.__mro__[1]
    error.__str__ = lambda self: shortened(base.__str__(self))


for _error in (FileError, InputError, NumericsError):
    _shorten_messages(_error)

_accessor.register()

cases = pathlib.Path(__file__).parent / "cases"


class _Package(types.ModuleType):
    """The package. `import slipfront.cases` finds a folder and would replace the path `cases`."""

    def __setattr__(self, name, value):
        if name != "cases" or not isinstance(value, types.ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package

__all__ = ["FileError", "InputError", "NumericsError", "__version__", "cases", "chain", "check",
           "compare", "damping_number", "event", "friction_ratio", "fronts", "laboratory", "medium",
           "moment_duration", "open", "plane", "population", "pulse", "relations", "riemann",
           "sweep", "train"]
