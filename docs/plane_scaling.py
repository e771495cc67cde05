"""Draws docs/plane-scaling.png, and prints how moment grows with duration (docs/plane.md).

Usage: plane_scaling.py [COUNT]

COUNT ruptures without friction and COUNT with strong friction (150 each by default) have random radius, stress, and held middle.
The script needs the Python package slipfront and python3-scipy. It takes a quarter of an hour on two cores.
"""

import concurrent.futures
import pathlib
import sys
import tempfile
import warnings

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import slipfront  # noqa: E402

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests" / "reference"))
import rings  # noqa: E402

KINDS = {"no friction": 0., "friction C = 10": 10.}


def rupture(radius, held, flow, friction, loops=40):
    """Rings at rest between held * radius and radius, with J0 = flow * radius / (2 r), are released at the outside. Returns the
    largest potency and the time in which it grows from 5 to 95 %."""
    try:
        return _rupture(radius, held, flow, friction, loops)
    except slipfront.NumericsError:  # strong friction needs more cells
        return rupture(radius, held, flow, friction, 2 * loops)


def _rupture(radius, held, flow, friction, loops):
    inner = held * radius
    table = rings.in_equilibrium(inner, radius, flow * radius / 2, points=201).table()
    end = (2 + friction * radius) * radius
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "rings.csv"
        file.write_text(table)
        while True:
            data = slipfront.plane({
                "plane": {"left": -4 * radius, "right": 4 * radius, "bottom": -4 * radius, "top": 4 * radius,
                          "fixed": f"x^2 + y^2 < {inner**2}", "angles": 8, "loops": loops, "cells": 8},
                "initial": {"profile": "radial", "file": str(file)},
                "friction": {"law": "viscous", "coefficient": friction} if friction else {"law": "none"},
                "time": {"end": end}, "output": {"every": end / 100},
            }, errors=False)
            potency, time = data["potency"].values, data["series_time"].values
            last = int(np.argmax(potency))
            if last < len(potency) - 1 or potency[-1] < 1.002 * potency[int(0.7 * len(potency))]:
                break
            end *= 2
    early, late = np.interp([0.05 * potency[last], 0.95 * potency[last]], potency[:last + 1], time[:last + 1])
    return potency[last], late - early


def _one(arguments):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about times after the largest potency, which are not used
        return rupture(*arguments)


def sample(count, friction, seed):
    """Random ruptures: rows of radius, held, flow, potency, duration."""
    draw = np.random.default_rng(seed)
    settings = [(10**draw.uniform(0, 0.7), draw.uniform(0.3, 0.7), draw.uniform(3, 6), friction) for _ in range(count)]
    with concurrent.futures.ProcessPoolExecutor() as pool:
        found = list(pool.map(_one, settings, chunksize=4))
    return np.array([[*setting[:3], *result] for setting, result in zip(settings, found)])


def exponent(duration, potency, seed=1):
    """The exponent n of M ~ T^n by least squares of the logarithms, and its interval of 90 % by resampling."""
    x, y = np.log(duration), np.log(potency)
    draw = np.random.default_rng(seed)
    found = [np.polyfit(x[i], y[i], 1)[0] for i in draw.integers(0, len(x), (2000, len(x)))]
    return np.polyfit(x, y, 1)[0], *np.quantile(found, [0.05, 0.95])


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 150
    plt.style.use(HERE.parent / "python" / "slipfront" / "slipfront.mplstyle")
    figure, axes = plt.subplots(figsize=(4.7, 3.6), layout="constrained")
    for marker, (name, friction) in zip("os", KINDS.items()):
        *_, potency, duration = sample(count, friction, seed=int(friction) + 1).T
        n, low, high = exponent(duration, potency)
        print(f"{name}: {count} ruptures, M ~ T^{n:.3f}, 90 % interval {low:.3f} to {high:.3f}")
        axes.loglog(duration, potency, marker, ms=3, alpha=0.6, label=f"{name}: $M \\sim T^{{{n:.2f}}}$")
        # One rupture at three radii shows the exponent for equal stress and shape.
        sizes = np.array([_one((size, 0.5, 4., friction)) for size in (1., 2., 4.)])
        print(f"{name}, radius alone: M ~ T^{np.polyfit(np.log(sizes[:, 1]), np.log(sizes[:, 0]), 1)[0]:.3f}")
    axes.set(xlabel="duration T, b / (c A)", ylabel="potency, $b^3 / (2 \\pi A^2)$", title="Moment against duration")
    axes.legend()
    figure.savefig(HERE / "plane-scaling.png")


if __name__ == "__main__":
    main()
