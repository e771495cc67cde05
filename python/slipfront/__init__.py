"""Slip pulses on frictional interfaces.

slipfront computes how fast an interface slips from the stress that is stored along it, and the
stress from the slip.

The functions have the names of the commands of the program and return xarray Datasets. A variable
is dimensionless unless its attribute `units` gives a unit. Multiply a dimensionless variable by its
attribute `dimensional_unit`. The attribute `references` gives its equation in the paper
(Gershenzon, Bambakidis and Skinner 2015, doi 10.3390/lubricants3020311).

`train`, `medium` and `plots` are modules, `cases` is the folder of the scenarios that come with
slipfront, `__version__` its version, and `dataset.slipfront.si` converts a Dataset to SI units.
docs/python.md lists the functions by what they do.
"""

import pathlib
import sys
import types

from ._optional import require_compiled

require_compiled()

from . import _accessor, medium, train
from ._arrivals import arrivals
from ._event import event
from ._fronts import fronts
from ._laboratory_events import laboratory_events
from ._messages import shortened
from ._population.laboratory import laboratory
from ._population.hierarchy import population
from ._potency import moment_duration
from ._run import chain, check, compare, open, plane, pulse
from ._sweep import sweep
from ._theory import damping_number, friction_ratio, relations, riemann
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

__all__ = ["FileError", "InputError", "NumericsError", "__version__", "arrivals", "cases", "chain",
           "check", "compare", "damping_number", "event", "friction_ratio", "fronts", "laboratory",
           "laboratory_events", "medium", "moment_duration", "open", "plane", "population", "pulse",
           "relations", "riemann", "sweep", "train"]
