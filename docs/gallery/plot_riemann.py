"""
The wave of a step of stress
============================

The exact solution of a step depends on x / t only. Where the stress on the right is not 0, two trains
overlap. Live in the explorer: panel Riemann.
"""
import matplotlib.pyplot as plt

import slipfront

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
for right in (0, 0.2, 0.4, 0.6):
    wave = slipfront.riemann(0.855, right)
    axes.plot(wave.x_over_t, wave.W, label=f"stress on the right: {right}")
axes.set(xlabel="x / t, c", ylabel="slip velocity W, c A / π")
axes.legend()
