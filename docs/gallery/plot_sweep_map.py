"""
Slip against friction and stress
================================

Two keys vary: the map shows the slip velocity at x = 0 for each pair of stress and friction.
"""
import numpy as np

import slipfront
from slipfront import plots

data = slipfront.sweep(slipfront.cases / "step-viscous.toml",
                       {"friction.coefficient": np.geomspace(0.1, 10, 9),
                        "initial.stress_left": np.linspace(0.2, 1.2, 8)},
                       variables=["slip_velocity_at_origin"], set={"pulse.cells": 60})
figure = plots.sweep(data, "slip_velocity_at_origin")
