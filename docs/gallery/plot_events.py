"""
Observed events and the closed form
===================================

The rupture velocity of each event of the shipped catalogue gives its least stress (arrows). If the slip velocity is
known too, the stress has an interval, also in MPa.
"""
import numpy as np

import slipfront
from slipfront import plots

figure = plots.events(slipfront.event(), slipfront.relations(stress=np.geomspace(0.1, 3, 300)))
