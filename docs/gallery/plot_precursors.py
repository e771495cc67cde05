"""
Precursors of a block that is pushed at its edge
================================================

Slip begins at the pushed edge and stops inside, again and again, until a front crosses the whole
block. Each line is a front. Live in the explorer: panel Stick-slip.
"""
import slipfront
from slipfront import plots

block = slipfront.chain(slipfront.cases / "precursors.toml", set={"time.end": "3 s"})
figure = plots.fronts(slipfront.fronts(block))
