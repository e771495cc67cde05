"""
Dislocations that overtake each other
=====================================

The stress on the right is not 0. Without friction the dislocations from the left are faster, and
run through the train on the right: a dispersive shock.
"""
import slipfront
from slipfront import plots

chain = slipfront.chain(slipfront.cases / "shock.toml",
                        set={"chain.scale": 80, "output.dislocations": True, "output.every": 0.1})
figure = plots.paths(chain)
