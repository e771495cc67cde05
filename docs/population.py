"""Draws docs/population-moment.png and prints its numbers (docs/population.md).

Usage: population.py curve     with the package slipfront on PYTHONPATH
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import slipfront  # noqa: E402

HERE = pathlib.Path(__file__).parent
STYLE = HERE.parent / "python" / "slipfront" / "slipfront.mplstyle"
STRESSES = (0.1, 0.2, 0.855, 2)
DAMPING = (0.01, 0.1, 1, 2, 4, 10, 20, 40, 100, 1000)


def solved(stress, damping):
    """Returns the potency over the square of the duration, from a run of the pulse solver with 800 cells."""
    run = slipfront.pulse({"initial": {"profile": "step", "stress_left": stress, "stress_right": 0}, "friction": {"law": "viscous", "coefficient": damping},
                           "time": {"end": 1}, "pulse": {"cells": 800}, "output": {"times": [1]}}, threads=1)
    return float(run.potency[-1])


def curve():
    """Draws docs/population-moment.png: potency and its exponent against duration."""
    rows = {stress: slipfront.moment_duration(stress, DAMPING).exponent.values for stress in STRESSES}
    for i, damping in enumerate(DAMPING):
        print(f"| {damping:g} | " + " | ".join(f"{rows[stress][i]:.2f}" for stress in STRESSES) + " |")
    means = slipfront.moment_duration(0.855, DAMPING).potency.values * np.square(DAMPING)
    for low, high in ((1, 2), (2, 4), (20, 40)):
        i, j = DAMPING.index(low), DAMPING.index(high)
        print(f"mean exponent from {low} to {high}: {np.log(means[j] / means[i]) / np.log(high / low):.2f}")
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.4))
    damping = np.geomspace(1e-3, 1e4, 400)
    for stress in STRESSES:
        data = slipfront.moment_duration(stress, damping)
        relative = data.potency.values / float(slipfront.moment_duration(stress, 1.0).potency)
        left.loglog(damping, relative * damping**2, label=f"Σ− = {stress:g}")
        right.semilogx(damping, data.exponent, label=f"Σ− = {stress:g}")
    points = np.geomspace(1e-3, 1e4, 8)
    scale = float(slipfront.moment_duration(0.855, 1.0).potency)
    left.loglog(points, [solved(0.855, g) / scale * g * g for g in points], "o", color="black", label="pulse solver, 0.855")
    left.set(xlabel="duration, as Γ = C T", ylabel="potency, over that at Γ = 1", title="Potency against duration")
    right.set(xlabel="duration, as Γ = C T", ylabel="exponent of the duration", title="d ln P / d ln T at given Σ−, A, C", ylim=(0.9, 2.1))
    left.legend()
    right.legend()
    figure.savefig(HERE / "population-moment.png")


PARTS = {"curve": curve}


def main():
    for name in sys.argv[1:] or PARTS:
        with matplotlib.rc_context(fname=STYLE):
            PARTS[name]()


if __name__ == "__main__":
    main()
