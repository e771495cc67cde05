"""
Dislocation lines around a barrier
==================================

The direct solver follows every dislocation line. Where the contact is stronger, the lines bow around
it, as they do around an obstacle in a crystal.
"""
import slipfront
from slipfront import plots

rupture = slipfront.plane(slipfront.cases / "plane-barrier.toml", direct=True,
                          set={"plane.cells": 60, "output.lines": True, "time.end": 2,
                               "chain.scale": 12}, errors=False)
figure = plots.plane(rupture)
