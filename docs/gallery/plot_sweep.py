"""
Slip against friction
=====================

A sweep runs a scenario with many values of a key. Here the slip at x = 0 falls with the coefficient
of viscous friction.
"""
import numpy as np

import slipfront
from slipfront import plots

data = slipfront.sweep(slipfront.cases / "step-viscous.toml",
                       {"friction.coefficient": np.geomspace(0.05, 20, 13), "pulse.cells": [100]},
                       variables=["slip_at_origin", "leading_front"])
figure = plots.sweep(data, "slip_at_origin")
