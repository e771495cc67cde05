"""
One slip event
==============

The slip velocity of one event over time and position, with the front that arrives at each position
and the rupture velocity that fits it.
"""
import slipfront
from slipfront import plots

block = slipfront.chain(slipfront.cases / "precursors.toml",
                        set={"time.end": "3 s", "output.per_event": 40})
figure = plots.slip_event(block)
