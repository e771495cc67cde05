"""
From single dislocations to a steady slope
==========================================

A train at rest under four stresses. At low stress each dislocation is a step of u by 2π. At high
stress u falls almost steadily.
"""
import matplotlib.pyplot as plt
import numpy as np

import slipfront

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
x = np.linspace(0, 30, 1500)
for stress in (0.2, 0.5, 1, 2):
    train = slipfront.train.fields(0, slipfront.train.psi_at_rest(stress), x)
    axes.plot(x, train.u / (2 * np.pi), label=f"Σ = {stress}")
axes.set(xlabel="position x, b / A", ylabel="u / 2π")
axes.legend()
