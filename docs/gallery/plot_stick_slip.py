"""
Stick-slip of a laboratory block
================================

A block of PMMA, 20 cm long, is pulled through a spring, under rate-and-state friction. Live in the
explorer: panel Stick-slip.
"""
import slipfront
from slipfront import plots

block = slipfront.chain(slipfront.cases / "laboratory-block.toml")
figure = plots.loading(block)
