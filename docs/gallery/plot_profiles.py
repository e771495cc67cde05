"""
A slip pulse at several times
=============================

A step of stress opens into a pulse with two fronts. The lines show the slip velocity and the stress at several times.
"""
import slipfront
from slipfront import plots

pulse = slipfront.pulse({"initial": {"profile": "step", "stress_left": 0.855, "stress_right": 0},
                         "friction": {"law": "viscous", "coefficient": 0.5}, "time": {"end": 6}, "output": {"every": 1.5}})
figure = plots.profiles(pulse)
