#!/usr/bin/env python3
"""Prints the slip velocity at x = 0 that the test Pulse.TanhStepWithFrictionAgreesWithTheSlowSolver expects, from the slow solver (slow_pulse.py).

Each line has the values with 200, 400 and 800 parcels, and the limits if the error falls as 1 / parcels and as its square.
Usage: tests/reference/slow_values.py        (a minute)"""

import numpy as np

from slow_pulse import Friction, SlowPulse


def stress(x):
    return 0.179 + 0.676 * (1 - np.tanh(x)) / 2


def slip_velocity(parcels, closure):
    slow = SlowPulse(stress, -8, 6, parcels, Friction("viscous", 0.5, closure=closure))
    return slow.slip_velocity(slow.run([2 * np.pi])[-1], 0)


if __name__ == "__main__":
    for closure in ("consistent", "paper"):
        coarse, middle, fine = (slip_velocity(parcels, closure) for parcels in (200, 400, 800))
        first, second = fine + (fine - middle), fine + (fine - middle) / 3
        print(f"{closure:<11} {coarse:.7f} {middle:.7f} {fine:.7f}  limits {first:.7f} {second:.7f}")
