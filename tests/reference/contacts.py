"""One block whose contacts age and whose pores dilate, by another method than slipfront's.

    u'' + a2 sin u = F + kappa (v t - u) - (1 - p) f(u', theta)
    theta' = 1 - |u'| theta / D,    p' = -(p - p0) / tp + E (ln theta)',    a2 = (1 - p)^2 (1 + beta ln(1 + theta / theta_c))
    f = a asinh((w / 2 w0) exp((f0 + b ln(theta w0 / D)) / a))

integrated by scipy's Radau in u, u', ln(theta) and p (where there is a substrate), and in the stretch, f, ln(theta) and p
(where the block only rubs). Knows nothing of slipfront. Prints the numbers of tests/chain/contacts_test.cpp: critical
stiffness with dilatancy by the eigenvalues of steady sliding, limit cycles, and the motion of a block over its substrate.

Usage: contacts.py [TOLERANCE]      (default 1e-11)
"""

import sys

import numpy as np
from scipy.integrate import solve_ivp

TOLERANCE = float(sys.argv[1]) if len(sys.argv) > 1 else 1e-11
A, B, D, W0, F0, V = 0.01, 0.015, 1.0, 0.01, 0.05, 0.001


def friction(w, log_theta, f0=F0, a=A, b=B, w0=W0, d=D):
    return a * np.arcsinh(w / (2 * w0) * np.exp((f0 + b * (log_theta + np.log(w0 / d))) / a))


def growth(kappa, v, E, tp, p0):
    """Largest growth rate of a disturbance of sliding at v: the eigenvalues of the equations' Jacobian, by differences."""
    force = (1 - p0) * friction(v, np.log(D / v))

    def rates(y):
        u, w, q, p = y  # u is that beyond steady sliding
        heals = np.exp(-q) - w / D
        drained = -(p - p0) / tp if np.isfinite(tp) else 0
        return np.array([w - v, force - kappa * u - (1 - p) * friction(w, q), heals, drained + E * heals])

    start = np.array([0, v, np.log(D / v), p0])
    steps = np.array([1, v, 1, 1]) * 1e-5
    jacobian = np.array([(rates(start + s) - rates(start - s)) / (2 * step) for s, step in zip(np.diag(steps), steps)]).T
    return np.linalg.eigvals(jacobian).real.max()


def critical_stiffness(v, E, tp, p0):
    low, high = 1e-6, 1.0
    for _ in range(100):
        kappa = np.sqrt(low * high)
        # pores that never drain have a neutral disturbance of their own
        low, high = (kappa, high) if growth(kappa, v, E, tp, p0) > 1e-11 else (low, kappa)
    return np.sqrt(low * high)


def cycle(kappa, E, tp, p0=0.0, v=V, end=None):
    """Period, largest velocity, and least p of the limit cycle."""
    scale = lambda q: 2 * W0 * np.exp(-(F0 + B * (q + np.log(W0 / D))) / A)

    def slope(t, y):
        stretch, s, q, p = y  # friction a s
        at = scale(q)
        w = at * np.sinh(s)
        heals = np.exp(-q) - abs(w) / D
        return [v - w, (kappa * stretch - (1 - p) * A * s) / (at * np.cosh(s)) + B / A * np.tanh(s) * heals, heals, -(p - p0) / tp + E * heals]

    def peak(t, y):
        return kappa * y[0] - (1 - y[3]) * A * y[1]
    peak.direction = -1
    done = solve_ivp(slope, (0, end or 600 / (kappa * 1000)), [0.0, 0.0, np.log(D / W0), p0], "Radau", rtol=TOLERANCE, atol=TOLERANCE, events=peak)
    assert done.success, done.message
    w = scale(done.y_events[0][:, 2]) * np.sinh(done.y_events[0][:, 1])
    big = w > 10 * v
    times = done.t_events[0][big]
    return times[-1] - times[-2], times[-2] - times[-3], w[big][-1], done.y[3].min()


def block(F, beta, theta_c, E, tp, p0, law, times, start=(0.0, 0.0)):
    """u, u', theta and p of a block over its substrate."""
    f0, a, b, d, w0 = law

    def slope(t, y):
        u, w, q, p = y
        heals = np.exp(-q) - abs(w) / d
        a2 = (1 - p) ** 2 * (1 + beta * np.log1p(np.exp(q) / theta_c))
        return [w, F - a2 * np.sin(u) - (1 - p) * friction(w, q, f0, a, b, w0, d), heals, -(p - p0) / tp + E * heals]

    done = solve_ivp(slope, (0, times[-1]), [*start, np.log(d / w0), p0], "Radau", t_eval=times, rtol=TOLERANCE, atol=TOLERANCE)
    assert done.success, done.message
    return np.array([done.y[0], done.y[1], np.exp(done.y[2]), done.y[3]])


if __name__ == "__main__":
    steady = A * np.arcsinh(V / (2 * W0) * np.exp((F0 + B * np.log(W0 / V)) / A))
    print(f"steady friction at v = {V}: {steady:.10f}")
    for E, tp, p0 in ((0, 1.0, 0), (0.03, np.inf, 0), (0.03, 1e3, 0), (0.03, 1e-3, 0), (0.03, 1e3, 0.4)):
        print(f"E {E} tp {tp} p0 {p0}: critical stiffness {critical_stiffness(V, E, tp, p0):.10f}"
              f"   drained {(1 - p0) * (B - A) / D:.6f}   undrained {((1 - p0) * (B - A) - steady * E) / D:.6f}")
    for kappa, E, tp in ((0.0012, 0.0, 1.0), (0.0012, 0.02, 1e3), (0.0012, 0.02, 1e5)):
        print(f"kappa {kappa} E {E} tp {tp}: period %.8g, before %.8g; peak velocity %.8g; least p %.8g" % cycle(kappa, E, tp, end=1.2e6))
    law = (0.05, 0.01, 0.015, 6.0, 0.05)
    for name, contacts in {"plain": (0, 1.0, 0, 1.0, 0), "ages": (0.1, 5.0, 0, 1.0, 0), "dilates": (0, 1.0, 0.05, 30.0, 0.1), "both": (0.1, 5.0, 0.05, 30.0, 0.1)}.items():
        for row in block(0.06, *contacts, law, [10.0, 30.0, 60.0], (0.0, 2.5)).T:
            print(name, " ".join(f"{value:.12g}" for value in row))
