"""
A catalogue of slip events
==========================

The slip of each event of a block against its length, and its stress drop against the time since the
last one.
"""
import slipfront
from slipfront import plots

block = slipfront.chain(slipfront.cases / "precursors.toml", set={"time.end": "6 s"})
figure = plots.catalogue(block)
