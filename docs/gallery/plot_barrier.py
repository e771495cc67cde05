"""
A barrier stops a pulse
=======================

A dislocation has more energy if the contact ratio is larger. The pulse climbs the barrier as far as
the dislocations behind push it. Live in the explorer: panel Pulse.
"""
import slipfront
from slipfront import plots

pulse = slipfront.pulse(slipfront.cases / "barrier.toml", errors=False)
figure = plots.profiles(pulse, fields=("Sigma", "slip"), times=6)
