"""
Observed events and the closed form
===================================

The rupture velocity of each event of the shipped catalogue gives its stress.
"""
import numpy as np

import slipfront
from slipfront import plots

figure = plots.events(slipfront.event(), slipfront.relations(stress=np.geomspace(0.1, 3, 300)))
