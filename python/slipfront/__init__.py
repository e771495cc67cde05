"""Slip pulses on frictional interfaces: from the stress stored along an interface to how fast it slips, and back.

Functions have the names of the command line and give xarray Datasets. Everything is dimensionless unless `units` says
otherwise; the attribute `dimensional_unit` of a variable is what to multiply it by, `references` the equation of the
paper (Gershenzon, Bambakidis and Skinner 2015, doi 10.3390/lubricants3020311).

    relations   stress, rupture velocity and slip velocity of a frictionless pulse, each from any other (Eqs. 8-10)
    friction_ratio
                what friction leaves of the slip velocity (Fig. 10)
    damping_number
                the damping number from that: Fig. 10, read the other way
    train       the uniform train of dislocations (Eqs. 4-5) and the closed-form profile of a pulse
    medium      constants of rock and interface (Eqs. 1-3)
    pulse       the modulation equations with friction (Eqs. 7), on a scenario
    chain       every dislocation, directly (Eqs. 1 and 3)
    compare     closed form, pulse and chain side by side
    sweep       pulse or chain over a grid of settings, on all cores or a Dask cluster
    event       stress and contact ratio of observed events
    check, open a scenario without running it; a file that was written
    cases       folder of the scenarios that come with slipfront
"""

import pathlib

from . import medium, train
from ._event import event
from ._friction_ratio import damping_number, friction_ratio
from ._relations import relations
from ._run import chain, check, compare, open, pulse
from ._sweep import sweep
from ._slipfront import FileError, InputError, NumericsError, __version__

cases = pathlib.Path(__file__).parent / "cases"

__all__ = ["FileError", "InputError", "NumericsError", "__version__", "cases", "chain", "check", "compare", "damping_number", "event", "friction_ratio", "medium", "open",
           "pulse", "relations", "sweep", "train"]
