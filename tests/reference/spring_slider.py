"""The spring-slider of the field: one block with rate-and-state friction, pulled through a spring.

    u'' = kappa (v t - u) - f(u', theta),    theta' = 1 - |u'| theta / D,
    f = a asinh((w / 2 w0) exp((f0 + b ln(theta w0 / D)) / a)),

integrated by scipy's Radau with f and ln theta as variables, which have all decades of the velocity.
Knows nothing of slipfront. Prints the critical stiffness, by the eigenvalues of steady sliding, and of the limit cycle
at each stiffness the period, the largest velocity and the slip of one cycle: the numbers of tests/chain/loading_test.cpp.

Usage: spring_slider.py [TOLERANCE]      (default 1e-10)
"""

import sys

import numpy as np
from scipy.integrate import solve_ivp

F0, W0, D, V = 0.05, 0.01, 1.0, 0.001
A, B = 0.01, 0.015
TOLERANCE = float(sys.argv[1]) if len(sys.argv) > 1 else 1e-10


def critical_stiffness():
    """Where growth changes sign: of lambda^2 + kappa + (lambda / v)(a - b / (1 + lambda D / v)) = 0, by bisection."""
    low, high = 1e-9, 1.0
    for _ in range(200):
        kappa = (low + high) / 2
        q = D / V  # (lambda^2 + kappa)(1 + lambda q) + (lambda / V)(A (1 + lambda q) - B) = 0
        roots = np.roots([q, 1 + A * q / V, kappa * q + (A - B) / V, kappa])
        low, high = (kappa, high) if roots.real.max() > 0 else (low, kappa)
    return kappa


def scale_of_velocity(log_theta):
    """2 w0 exp(-(f0 + b ln(theta w0 / D)) / a): friction is a asinh(w / this)."""
    return 2 * W0 * np.exp(-(F0 + B * (log_theta + np.log(W0 / D))) / A)


def slope(t, y, kappa):
    stretch, s, log_theta = y  # stretch = v t - u; friction a s
    scale = scale_of_velocity(log_theta)
    w = scale * np.sinh(s)
    heals = np.exp(-log_theta) - abs(w) / D
    return [V - w, (kappa * stretch - A * s) / (scale * np.cosh(s)) + B / A * np.tanh(s) * heals, heals]


def cycles(kappa, end):
    """Times, velocities and slips of the peaks of the velocity, from rest."""
    def peak(t, y, kappa):
        return kappa * y[0] - A * y[1]
    peak.direction = -1
    done = solve_ivp(slope, (0, end), [0.0, 0.0, np.log(D / W0)], "Radau", args=(kappa,), rtol=TOLERANCE, atol=TOLERANCE, events=peak)
    assert done.success, done.message
    times, states = done.t_events[0], done.y_events[0]
    return times, scale_of_velocity(states[:, 2]) * np.sinh(states[:, 1]), V * times - states[:, 0]


if __name__ == "__main__":
    print(f"critical stiffness {critical_stiffness():.10f}   (b - a) / D {(B - A) / D}   with inertia {(B - A) / D * (1 + V**2 / (A * D)):.10f}")
    for kappa in (0.0025, 0.0012):
        times, peaks, slips = cycles(kappa, 12 * 4 * 0.05 / (kappa * V))
        big = peaks > 10 * V
        t, w, u = times[big], peaks[big], slips[big]
        print(f"kappa {kappa}: period {t[-1] - t[-2]:.8g}, before {t[-2] - t[-3]:.8g}; peak velocity {w[-1]:.8g}; slip {u[-1] - u[-2]:.8g}; peaks {len(t)}")
