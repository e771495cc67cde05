"""
Slip velocity in space and time
===============================

The map shows where and when the interface slips. The solid and the dashed line are the two fronts of the pulse.
"""
import slipfront
from slipfront import plots

pulse = slipfront.pulse({"initial": {"profile": "formula", "formula": "0.2 + 0.6/(1 + exp(4*x)) + 0.3*exp(-(x + 1.5)^2)"},
                         "domain": {"left": -9, "right": 5}, "friction": {"law": "viscous", "coefficient": 0.3},
                         "time": {"end": 8}, "output": {"every": 0.25}})
figure = plots.space_time(pulse)
