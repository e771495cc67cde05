"""
A rupture on a fault plane
==========================

Slip velocity, slip and rupture time of a rupture that opens from a stressed region, with friction on
one side. Live in the explorer: panel Fault plane.
"""
import slipfront
from slipfront import plots

rupture = slipfront.plane(slipfront.cases / "plane-friction.toml", set={"plane.cells": 60},
                          errors=False)
figure = plots.plane(rupture)
