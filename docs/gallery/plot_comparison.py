"""
The averages against every dislocation
======================================

Three methods solve one scenario: the closed form, the averaged equations, and chains that follow every dislocation.
"""
import slipfront
from slipfront import plots

scenario = {"title": "A step of stress", "initial": {"profile": "step", "stress_left": 0.855, "stress_right": 0},
            "time": {"end": 3}}
figure = plots.comparison(slipfront.compare(scenario, scales=[100, 300]))
