#!/usr/bin/python3
"""Compares the posterior of `slipfront event` with that of another sampler: emcee (affine-invariant ensemble) on the same density.

Usage: emcee_posterior.py SLIPFRONT COEFFICIENTS     (the folder src/friction/ratio)
Exit codes: 0 if medians and 5/95 % points agree within Monte Carlo error, 1 if they do not, 77 if emcee is not installed.

The relations of Eqs. 8-10 use scipy's elliptic integrals, and numpy evaluates the friction ratio from the shipped table. The
script uses no code of the library.
"""

import json
import subprocess
import sys
import tempfile

try:
    import emcee
    import numpy as np
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipkm1
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ENDS = np.log1p([0, 1, 3, 15, 100, 1000, 1e4, 1e8])
STRESS = np.array([0.05 / 1.05, 3 / 4])
C_SPEED = 6000 * np.sqrt(0.4) / 0.7
PLASTIC = np.sqrt(0.35)

# name, measure, [rupture velocity, sd], [slip velocity, factor], [contact ratio, factor]
EVENTS = [
    ("crust", "origin", (3000, 150), (0.5, 1.2), (0.01, 1.3)),
    ("crust, mean", "mean", (2500, 200), (0.3, 1.3), (0.004, 1.5)),
    ("peak", "peak", (3300, 100), (2.0, 1.1), (0.03, 1.2)),
    ("slow, mean in time", "time-mean", (0.116, 0.02), (3e-9, 1.5), (4e-5, 1.5)),
    ("slow", "mean", (0.116, 0.02), (3e-9, 1.5), (4e-5, 1.5)),
    ("strongly damped", "origin", (1000, 100), (1e-3, 1.3), (0.02, 1.2)),
]


def numbers(path):
    return np.array([float(number) for number in open(path).read().replace("\n", "").rstrip(",").split(",")])


def table(folder):
    """Coefficients [measure, piece, y, u] and corners [measure, y] of closure "consistent"."""
    return numbers(f"{folder}/coefficients.csv").reshape(2, 4, 7, 15, 9)[0], numbers(f"{folder}/corners.csv").reshape(2, 4, 9)[0]


def sound_speed(psi):
    m1 = np.tanh(psi) ** 2
    return np.tanh(psi) * ellipkm1(m1) / ellipe(1 - m1)


def closed_form(V):
    """Sigma- and W(0) without friction at the rupture velocity V, in c."""
    psi = brentq(lambda x: np.log(sound_speed(np.exp(x)) / V), -70, 3)
    psi = np.exp(psi)
    stress = np.pi * np.cosh(psi) / ellipkm1(np.tanh(psi) ** 2)
    at_origin = np.exp(brentq(lambda x: np.log((np.exp(x) + np.arctanh(sound_speed(np.exp(x)))) / psi), -80, np.log(psi)))
    phi = np.arctanh(sound_speed(at_origin))
    return stress, np.pi * np.sinh(phi) * np.cosh(at_origin) / ellipkm1(np.tanh(at_origin) ** 2)


def ln_ratio(coefficients, corner, stress, u):
    """The logarithm of the friction ratio, for arrays of states."""
    y = (2 * stress / (1 + stress) - STRESS.sum()) / (STRESS[1] - STRESS[0])
    ends = np.tile(ENDS, (len(y), 1))
    if corner[0] != 0:
        ends[:, 1] = np.polynomial.chebyshev.chebval(y, corner)
        ends[:, 2] = (ends[:, 1] + ends[:, 3]) / 2
    piece = np.clip((ends <= u[:, None]).sum(axis=1) - 1, 0, 6)
    every = np.arange(len(y))
    x = (u - ends[every, piece]) / (ends[every, piece + 1] - ends[every, piece])
    if corner[0] != 0:
        x = np.where(piece == 1, np.sqrt(np.abs(x)), x)
    in_stress, in_damping = (np.polynomial.chebyshev.chebvander(at, degree) for at, degree in ((y, 14), (2 * x - 1, 8)))
    return np.einsum("si,sij,sj->s", in_stress, coefficients[piece], in_damping)


def sampled(event, coefficients, corners):
    """The 5, 50 and 95 % points of ln A and ln(1 + Gamma) by emcee, and their Monte Carlo errors."""
    _, measure, (V0, sd), (w0, w_factor), (A0, A_factor) = event
    grid = np.linspace(np.log(max(V0 - 6 * sd, V0 / 30)), np.log(min(V0 + 6 * sd, 0.97 * C_SPEED)), 400)
    forms = np.array([closed_form(np.exp(v) / C_SPEED) for v in grid])
    index = ["origin", "mean", "peak", "time-mean"].index(measure)

    def ln_density(states):
        """The logarithm of the density, for all states of one step of the ensemble."""
        ln_V, ln_A, u = states.T
        allowed = (grid[0] < ln_V) & (ln_V < grid[-1]) & (np.log(1e-8) < ln_A) & (ln_A < np.log(PLASTIC)) & (0 < u) & (u < ENDS[-1])
        density = np.full(len(states), -np.inf)
        density[allowed] = ln_density_within(ln_V[allowed], ln_A[allowed], u[allowed])
        return density

    def ln_density_within(ln_V, ln_A, u):
        stress, W = (np.interp(ln_V, grid, forms[:, 0]), np.exp(np.interp(ln_V, grid, np.log(forms[:, 1]))))
        ln_w = ln_A + np.log(C_SPEED / np.pi * W) + ln_ratio(coefficients[index], corners[index], stress, u)
        fall = np.minimum(0, ln_V - np.log(0.7 * V0))  # the likelihood of a normal error, see docs/events.md
        return (fall - 0.5 * ((np.exp(ln_V) - V0) / sd) ** 2 - 0.5 * ((ln_w - np.log(w0)) / np.log(w_factor)) ** 2
                - 0.5 * ((ln_A - np.log(A0)) / np.log(A_factor)) ** 2)

    random = np.random.default_rng(1)
    np.random.seed(1)
    start = np.column_stack([np.log(V0) + 0.01 * random.standard_normal(24), np.log(A0) + 0.1 * random.standard_normal(24),
                             random.uniform(0.5, 12, 24)])
    sampler = emcee.EnsembleSampler(24, 3, ln_density, vectorize=True)
    sampler.run_mcmc(start, 6000)
    chain = sampler.get_chain(discard=1500)
    parts = np.array([[np.quantile(part[:, :, i], [0.05, 0.5, 0.95]) for i in (1, 2)] for part in np.array_split(chain, 9)])
    return np.array([np.quantile(chain[:, :, i], [0.05, 0.5, 0.95]) for i in (1, 2)]), parts.std(axis=0) / 3


def main(program, path):
    coefficients, corners = table(path)
    good = True
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write("name,slip_velocity_is,rupture_velocity_is,rupture_velocity,slip_velocity,contact_ratio\n")
        for name, measure, V, w, A in EVENTS:
            file.write(f'"{name}",{measure},characteristic,{V[0]} +- {V[1]} m/s,{w[0]} */ {w[1]} m/s,{A[0]} */ {A[1]}\n')
        file.flush()
        run = subprocess.run([program, "event", file.name, "--json", "--samples", "20000"], capture_output=True, check=True)
    ours = json.loads(run.stdout)["events"]
    for event, result in zip(EVENTS, ours):
        points, errors = sampled(event, coefficients, corners)
        p = result["posterior"]
        for row, key, scale in ((0, "contact_ratio", np.log), (1, "damping_number", np.log1p)):
            mine = scale([p[key + "_interval"][0], p[key], p[key + "_interval"][1]])
            spread = points[row][2] - points[row][0]
            allowed = 4 * errors[row] + 0.01 * spread  # Monte Carlo error of emcee; ours with 20,000 samples is below 1 %
            off = np.abs(mine - points[row])
            good &= bool(np.all(off <= allowed))
            print(f"{event[0]:16} {key:15} ln: ours {np.round(mine, 3)}  emcee {np.round(points[row], 3)}  off {np.round(off, 3)}"
                  f"  allowed {np.round(allowed, 3)}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
