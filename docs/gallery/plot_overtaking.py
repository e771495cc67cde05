"""
Trains that overtake each other
===============================

Two falls of stress follow each other, and the dislocations of the second are faster. Lines enclose
the regions with two and with three trains at one position. Live in the explorer: panel Pulse.
"""
import slipfront
from slipfront import plots

pulse = slipfront.pulse(slipfront.cases / "overtaking.toml", errors=False)
figure = plots.space_time(pulse, fields=("W",))
