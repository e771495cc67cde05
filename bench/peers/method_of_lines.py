"""Compare the paper's way to solve Eqs. (7) with `slipfront pulse`, in one run.

The paper's way is the method of lines on the non-conservative form, with a general ODE solver (scipy.integrate.solve_ivp). We use upwind and
central differences. The problem is a tanh profile of width 1 with Sigma- = 0.855, Sigma+ = 0.179 and C = 0.5 (closure consistent) to
t = 2 pi. The result is W at x = 0.
Usage: method_of_lines.py PATH_OF_SLIPFRONT.   Needs python3-scipy.
"""

import json
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipe, ellipkm1

LEFT, RIGHT, END, C = -7.5, 5.5, 2 * np.pi, 0.5
REFERENCE = 0.0093369823  # slipfront, 1600 cells
ROBUST = 97  # the error of slipfront is below 1e-3 for this and every larger number of cells (tried up to 160)
SLIPFRONT_CELLS = (50, 75, ROBUST, 150, 200)


def k_e(psi):
    m1 = np.tanh(psi) ** 2
    return ellipkm1(m1), ellipe(1 - m1)


def stress(x):
    return 0.179 + 0.676 * (1 - np.tanh(x)) / 2


def rates(t, y, dx, central):
    """Rates of phi and psi: phi +- psi travel at lambda_pm (docs/theory/3_modulation.md 3.2), and friction reduces M at the rate C at constant spacing l."""
    n = y.size // 2
    phi, psi = y[:n], np.maximum(y[n:], 1e-12)
    K, E = k_e(psi)
    s = np.tanh(psi)
    c0, U = s * K / E, np.tanh(phi)
    speed = {+1: (U + c0) / (1 + U * c0), -1: (U - c0) / (1 - U * c0)}
    moved = {}
    for sign in (+1, -1):
        r = np.pad(phi + sign * psi, 1, mode="edge")
        forward, backward = (r[2:] - r[1:-1]) / dx, (r[1:-1] - r[:-2]) / dx
        slope = (forward + backward) / 2 if central else np.where(speed[sign] > 0, backward, forward)
        moved[sign] = -speed[sign] * slope
    # dl = 0: (E/K - s^2)/s dpsi + tanh(phi) dphi + s dpsi = 0;  dM = -C M
    a = U / (E / (K * s))  # -dpsi/dphi at constant l
    cosh_phi, sinh_phi, cosh_psi, sinh_psi = np.cosh(phi), np.sinh(phi), np.cosh(psi), np.sinh(psi)
    dphi = -C * sinh_phi * cosh_psi * E / (cosh_phi * cosh_psi * E - sinh_phi * sinh_psi * K * a)
    dpsi = -a * dphi
    return np.concatenate([(moved[1] + moved[-1]) / 2 + dphi, (moved[1] - moved[-1]) / 2 + dpsi])


def method_of_lines(n, central):
    x = np.linspace(LEFT, RIGHT, n)
    psi = np.array([brentq(lambda p: np.pi * np.cosh(p) / k_e(p)[0] - stress(xi), 1e-12, 1) for xi in x])
    begun = time.perf_counter()
    done = solve_ivp(rates, (0, END), np.concatenate([np.zeros(n), psi]), method="RK45", rtol=1e-5, atol=1e-8,
                     args=(x[1] - x[0], central))
    seconds = time.perf_counter() - begun
    phi, psi = np.interp(0, x, done.y[:n, -1]), np.interp(0, x, done.y[n:, -1])
    return np.pi * np.sinh(phi) * np.cosh(psi) / k_e(psi)[0], seconds


def slipfront(program, cells):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(f"[initial]\nprofile = 'tanh'\nstress_left = 0.855\nstress_right = 0.179\n[friction]\nlaw = 'viscous'\n"
                   f"coefficient = {C}\n[domain]\nleft = {LEFT}\nright = {RIGHT}\n[pulse]\ncells = {cells}\n")
        file.flush()
        runs = [json.loads(subprocess.run([program, "pulse", file.name, "--json"], capture_output=True, check=True).stdout)
                for _ in range(20)]
    return runs[0]["slip_velocity_at_origin"], *(min(r[key] for r in runs) for key in ("solve_seconds", "wall_seconds"))


def main(program="build/release/bin/slipfront"):
    """Returns the time steps' time of the method of lines over that of slipfront, or None."""
    fastest = {}
    print(f"{'method':<22}{'cells':>6}{'W(0)':>14}{'error':>10}{'solve ms':>10}{'whole ms':>10}")
    for name, run, sizes in (("lines, upwind", lambda n: method_of_lines(n, False), (200, 400, 800, 1600, 3200)),
                             ("lines, central", lambda n: method_of_lines(n, True), (200, 400, 800, 1600)),
                             ("slipfront", lambda n: slipfront(program, n), SLIPFRONT_CELLS)):
        for n in sizes:
            W, seconds, *whole = run(n)
            error = abs(W / REFERENCE - 1)
            print(f"{name:<22}{n:>6}{W:>14.7f}{error:>10.1e}{seconds * 1e3:>10.2f}" + "".join(f"{s * 1e3:>10.2f}" for s in whole))
            if error <= 1e-3 and (not whole or n >= ROBUST):
                fastest.setdefault(name.split(",")[0], []).append([seconds, *whole])
    ours = min(fastest["slipfront"])
    if not fastest.get("lines"):
        print(f"W(0) to 1e-3: slipfront {ours[0] * 1e3:.2f} ms; the method of lines does not reach it")
        return None
    lines = min(fastest["lines"])[0]
    print(f"W(0) to 1e-3, method of lines / slipfront: solve against solve {lines / ours[0]:.0f}, "
          f"solve against the whole command {lines / ours[1]:.0f}")
    return lines / ours[0]


if __name__ == "__main__":
    main(*sys.argv[1:])
