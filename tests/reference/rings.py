"""Rings of dislocation lines, each followed by leapfrog steps of the radial sine-Gordon equation.

    u_tt = u_rr + u_r / r - sin u - f(u_t)

in the units of docs/theory/8_plane.md, on a plane that is stretched by a scale s. The initial lines are a train at rest whose mean
slip is a given function of r. The inner end is fixed, the outer end is free. This file shares no code with slipfront;
tests/cli/plane_rings_test.py compares both.
"""

import numpy as np
from scipy import special
from scipy.optimize import brentq


def flow_in_own_frame(psi):
    """J0 of a train."""
    return 4 / np.pi * np.cosh(psi) * special.ellipe(np.cosh(psi)**-2)


def density(psi):
    """The density of lines of a train at rest, kappa = 2 pi N."""
    return np.pi * np.cosh(psi) / special.ellipk(np.cosh(psi)**-2)


def psi_of_density(kappa):
    return brentq(lambda psi: density(psi) - kappa, 1e-12, 20, xtol=1e-15)


def psi_of_flow(flow):
    return brentq(lambda psi: flow_in_own_frame(psi) - flow, 1e-12, 20, xtol=1e-15)


class Rings:
    """Initial rings between `inner` and `outer`, from a table of the density kappa over r."""

    def __init__(self, inner, outer, kappa, points=401):
        self.r = np.linspace(inner, outer, points)
        self.kappa = np.array([kappa(r) for r in self.r])
        widths = np.diff(self.r)
        steps = (self.kappa[1:] + self.kappa[:-1]) / 2 * widths
        self.slip = np.append(np.cumsum(steps[::-1])[::-1], 0.)  # mean slip: 0 outside

    def table(self):
        """The text of a file for initial.profile = "radial"."""
        return "r,slip\n" + "".join(f"{r:.12g},{u:.12g}\n" for r, u in zip(self.r, self.slip))


def in_equilibrium(inner, outer, flow, points=401):
    """Rings at rest with J0 = flow / r, whose tension balances their pressure."""
    return Rings(inner, outer, lambda r: density(psi_of_flow(flow / r)), points)


def resting(rings, scale, rho):
    """The displacement u of resting lines at the distances rho of the stretched plane."""
    r = rho / scale
    phase = scale * np.interp(r, rings.r, rings.slip, left=rings.slip[0], right=0.)
    psi = np.array([psi_of_density(kappa) for kappa in rings.kappa])
    modulus = np.cosh(np.interp(r, rings.r, psi))**-2
    turns = np.floor(phase / (2 * np.pi))
    quarter = special.ellipk(modulus)
    amplitude = special.ellipj(quarter * (phase / np.pi - 2 * turns - 1), modulus)[3]
    return np.where(r < rings.r[-1], 2 * np.pi * turns + np.pi + 2 * amplitude, 0.)


def follow(rings, scale, end, probes, friction=None, outer=None, spacing=0.1, half_width=0.05):
    """Follows every ring to the time `end`. Returns the slip at the distances `probes`, as means over 2 half_width, and the
    distance of the outermost line. `friction` is f(w), where w is u_t of the averaged slip; at scale s it is divided by s."""
    inner, outer = rings.r[0], outer or rings.r[-1] + end + 0.2
    sites = round(scale * (outer - inner) / spacing)
    h = scale * (outer - inner) / sites
    rho = scale * inner + h * np.arange(sites + 1)
    start = resting(rings, scale, rho)
    steps = int(np.ceil(scale * end / (0.9 * h)))
    dt = scale * end / steps
    before, now = start.copy(), start.copy()
    for step in range(steps):
        force = np.zeros_like(now)
        force[1:-1] = (now[2:] - 2 * now[1:-1] + now[:-2]) / h**2 + (now[2:] - now[:-2]) / (2 * h * rho[1:-1])
        force[-1] = 2 * (now[-2] - now[-1]) / h**2
        force -= np.sin(now)
        velocity = (now - before) / dt
        if friction is not None:
            force -= friction(velocity) / scale
        after = now + dt * (velocity + (dt / 2 if step == 0 else dt) * force)
        after[0] = start[0]
        before, now = now, after
    slip = [np.mean((now - start)[np.abs(rho / scale - r) <= half_width]) / scale for r in probes]
    first = np.flatnonzero(now > np.pi)[-1]
    front = rho[first] + h * (now[first] - np.pi) / (now[first] - now[first + 1])
    return slip, front / scale
