"""
An asperity between creeping ends
=================================

Friction weakens with velocity in the middle and strengthens outside. The map shows earthquakes,
the locked asperity (bright), and afterslip. Live in the explorer: panel Stick-slip.
"""
import slipfront
from slipfront import plots

fault = slipfront.chain(slipfront.cases / "asperity.toml", set={"chain.spacing": "500 m"})
figure = plots.loading(fault)
