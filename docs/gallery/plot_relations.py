"""
Velocities against stress
=========================

The closed form gives the velocities of both fronts and the slip velocity for every stress before the rupture
(Eqs. 8-10).
"""
import numpy as np

import slipfront
from slipfront import plots

figure = plots.relations(slipfront.relations(stress=np.linspace(0.05, 1.5, 200)))
