"""
Every dislocation of a step
===========================

A chain follows each of the dislocations. The lines are their paths: the train opens to both sides,
and viscous friction slows it down. Live in the explorer: panel Dislocations.
"""
import slipfront
from slipfront import plots

chain = slipfront.chain(slipfront.cases / "step-viscous.toml",
                        set={"chain.scale": 150, "output.dislocations": True, "output.every": 0.2})
figure = plots.paths(chain)
