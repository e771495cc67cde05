"""Solves the block of cases/laboratory-block.toml in SI units, with code that slipfront does not share.

    m x'' = K (V t - x) - sigma f(x', theta),    theta' = 1 - x' theta / Dc,
    f = a asinh((w / 2 V0) exp((f0 + b ln(theta V0 / Dc)) / a)).

Below 1e-4 m/s inertia is negligible: the spring balances friction, so its stretch gives the velocity. scipy's Radau
integrates the stretch and ln theta there. Above, it integrates stretch, ln w and ln theta with inertia. With f0 / a = 80 no
single set of variables serves both: at rest a rounding error of the force is more than all of the velocity.

It prints the onset, the interval and the peak velocity of each event: the numbers of tests/cli/laboratory_test.py.

Usage: laboratory_block.py [TOLERANCE]      (default 1e-9)
"""

import math
import sys

import numpy as np
from scipy.integrate import Radau

NORMAL, A, B, DC, V0, F0 = 5e6, 0.005, 0.009, 0.5e-6, 1e-6, 0.4
STIFFNESS, VELOCITY, END = 2e10, 1e-6, 300.0
MASS = 1180 * 0.1  # per area: density times height
FAST = 1e-4  # velocity above which inertia counts
DIRECT = A * NORMAL


def exponent(log_theta):
    return (F0 + B * (log_theta + math.log(V0 / DC))) / A


def log_velocity(s, log_theta):
    """The logarithm of the velocity where friction is DIRECT s."""
    log_sinh = math.log(math.sinh(s)) if s < 20 else s - math.log(2)
    return math.log(2 * V0) - exponent(log_theta) + log_sinh


def friction(log_w, log_theta):
    z = log_w - math.log(2 * V0) + exponent(log_theta)
    return DIRECT * (math.asinh(math.exp(z)) if z < 20 else z + math.log(2))


def balanced(_, y):
    stretch, log_theta = y
    w = math.exp(log_velocity(STIFFNESS * stretch / DIRECT, log_theta))
    return [VELOCITY - w, math.exp(-log_theta) - w / DC]


def with_inertia(_, y):
    stretch, log_w, log_theta = y
    w = math.exp(log_w)
    return [VELOCITY - w, (STIFFNESS * stretch - friction(log_w, log_theta)) / (MASS * w), math.exp(-log_theta) - w / DC]


def until(equations, t, y, tolerance, stop):
    """Integrates until stop(y) or the end. Returns the time, the state, and the interpolated states on the way."""
    solver, seen = Radau(equations, t, y, END, rtol=tolerance, atol=1e-3 * tolerance), []
    while solver.status == "running" and not stop(solver.y):
        message = solver.step()
        if solver.status == "failed":
            raise ArithmeticError(message)
        seen.extend(solver.dense_output()(t) for t in np.linspace(solver.t_old, solver.t, 6)[1:])
    return solver.t, solver.y, seen


def events(tolerance):
    """Yields onset and peak velocity of each event."""
    t, slow = 0.0, [1e-3 * DIRECT / STIFFNESS, math.log(DC / V0)]
    while True:
        t, slow, _ = until(balanced, t, slow, tolerance, lambda y: log_velocity(STIFFNESS * y[0] / DIRECT, y[1]) > math.log(FAST))
        if t >= END:
            return
        fast = [slow[0], log_velocity(STIFFNESS * slow[0] / DIRECT, slow[1]), slow[1]]
        onset = t
        t, fast, seen = until(with_inertia, t, fast, tolerance, lambda y: y[1] < math.log(FAST / 10))
        yield onset, math.exp(max(y[1] for y in seen))
        slow = [fast[0], fast[2]]


def main():
    last = math.nan
    for onset, peak in events(float(sys.argv[1]) if len(sys.argv) > 1 else 1e-9):
        print(f"onset {onset:.4f} s   interval {onset - last:.4f} s   peak velocity {peak:.5f} m/s")
        last = onset


if __name__ == "__main__":
    main()
