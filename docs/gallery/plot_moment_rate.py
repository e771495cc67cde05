"""
Moment rate and spectrum of a rupture
=====================================

The moment rate of a rupture on a plane, and its amplitude spectrum with the corner frequency.
"""
import matplotlib.pyplot as plt

import slipfront

rupture = slipfront.plane(slipfront.cases / "plane-arrest.toml", set={"plane.cells": 60},
                          errors=False)
figure, (time, frequency) = plt.subplots(1, 2, figsize=(8, 3), layout="constrained")
time.plot(rupture.series_time, rupture.moment_rate)
time.set(xlabel="time t, b / (c A)", ylabel="moment rate, μ b² c / (2π A)")
frequency.loglog(rupture.frequency, rupture.moment_rate_spectrum)
frequency.set(xlabel="frequency, c A / b", ylabel="spectrum, μ b³ / (2π A²)")
