"""
Posterior of one event
======================

The rupture velocity, the slip velocity and the stress drop of an event, each with its error, give a posterior of
stress, contact ratio and friction. The stress drop is static: the stress before the event minus that after it.
"""
import slipfront
from slipfront import plots

event = slipfront.event({"name": "an earthquake",
                         "rupture_velocity": "2.7 +- 0.2 km/s",
                         "slip_velocity": "0.5 */ 1.3 m/s",
                         "stress_drop": "8 */ 1.5 MPa"}, draws=2000)
figure = plots.corner(event)
