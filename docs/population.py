"""Draws docs/population-moment.png and prints its numbers, and tests slopes by shuffling (docs/population.md).

Usage: population.py [curve] [shuffle]     with the package slipfront on PYTHONPATH
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


def slope(log_slip_velocity, log_front):
    """Returns the slope of a straight line through log slip velocity against log rupture velocity."""
    return float(np.polyfit(log_front, log_slip_velocity, 1)[0])


def invented_slopes(events=701, shuffles=200):
    """Returns slopes of shuffled populations of invented events whose slip, length and duration do not depend on each other."""
    generator = np.random.default_rng(1)
    length, slip, duration = (generator.uniform(np.log(low), np.log(high), events) for low, high in ((1e4, 3e5), (0.01, 5), (10, 3e7)))
    return [slope(generator.permutation(slip) - duration, length - duration) for _ in range(shuffles)]


def catalogue_slopes(shuffles=2000):
    """Returns how many events of the shipped catalogue have velocity, slip and a time, their slope, and the slopes with shuffled slips."""
    rows = slipfront._slipfront.observations([("", str(HERE.parent / "cases" / "catalogue.csv"), True)], ["", "", ""])
    values = [(row["rupture_velocity"][0], row["slip"][0], row["rise_time" if np.isfinite(row["rise_time"][0]) else "duration"][0]) for row in rows]
    front, slip, time = np.array([row for row in values if np.isfinite(row).all()]).T
    generator = np.random.default_rng(1)
    return len(slip), slope(slip - time, front), [slope(generator.permutation(slip) - time, front) for _ in range(shuffles)]


def shuffle():
    """Prints the slope of log slip velocity against log rupture velocity, as it is and with slip shuffled among the events."""
    print("invented events: slope with shuffled slip %.2f, 5 %% to 95 %%: %.2f to %.2f" % tuple(np.quantile(invented_slopes(), (0.5, 0.05, 0.95))))
    events, own, shuffled = catalogue_slopes()
    print(f"shipped catalogue, {events} events: slope {own:.2f}; with shuffled slip {np.median(shuffled):.2f}, 5 % to 95 %: "
          "{:.2f} to {:.2f}".format(*np.quantile(shuffled, (0.05, 0.95))))


PARTS = {"curve": curve, "shuffle": shuffle}


def main():
    for name in sys.argv[1:] or PARTS:
        with matplotlib.rc_context(fname=STYLE):
            PARTS[name]()


if __name__ == "__main__":
    main()
