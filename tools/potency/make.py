"""Writes python/slipfront/potency.csv: the potency of a pulse as Chebyshev polynomials (docs/population.md).

Usage: make.py > potency.csv   with the package slipfront on PYTHONPATH. It takes some minutes on one core.

A row is a polynomial in Sigma- / (1 + Sigma-), a column one in ln(1 + Gamma). The value is ln(potency / (|V-| W(0) T^2)), where |V-| and
W(0) are those without friction.
"""

import math
import sys
import warnings

import numpy as np

import slipfront
from slipfront._potency import ORDERS, RANGES, stress_of

CELLS = 800


def potency(stress, damping, cells=CELLS):
    """Returns the potency at time 1 of a step into the empty interface, over |V-| W(0) without friction."""
    free = slipfront.relations(stress=stress)
    # The moving part ends at the trailing edge, V T. At late times, when slip diffuses, it ends far inside this edge.
    reach = float(free.rupture_velocity) * min(1.02, 9 / math.sqrt(damping) if damping else 2)
    friction = {"law": "viscous", "coefficient": damping} if damping else {"law": "none"}
    run = slipfront.pulse({"initial": {"profile": "step", "stress_left": stress, "stress_right": 0}, "friction": friction, "time": {"end": 1},
                           "pulse": {"cells": cells}, "domain": {"left": -reach, "right": reach}}, set={"output.times": [1.0]}, threads=1)
    return float(run.potency[-1]) / float(free.rupture_velocity * free.slip_velocity)


def nodes(order):
    """Returns the Chebyshev points from -1 to 1, ends included."""
    return -np.cos(np.pi * np.arange(order) / (order - 1))


def coefficients(values):
    """Returns the coefficients of the Chebyshev polynomials through values at the nodes, for each axis."""
    for axis, order in enumerate(ORDERS):
        inverse = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes(order), order - 1))
        values = np.moveaxis(np.tensordot(inverse, values, axes=(1, axis)), 0, axis)
    return values


def main():
    warnings.simplefilter("ignore")
    ys, us = (low + (high - low) * (1 + nodes(order)) / 2 for (low, high), order in zip(RANGES, ORDERS))
    values = np.empty(ORDERS)
    for i, y in enumerate(ys):
        for j, u in enumerate(us):
            values[i, j] = math.log(potency(stress_of(y), math.expm1(u) if j else 0.0))
        print(f"{i + 1} of {len(ys)} stresses", file=sys.stderr, flush=True)
    for row in coefficients(values):
        print(",".join(f"{value:.9g}" for value in row))


if __name__ == "__main__":
    main()
