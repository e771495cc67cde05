"""Solves the sine-Gordon equation by the simplest scheme, with which tests compare the library's chain:

    u_tt - u_xx + a(x)^2 sin u = F - f(u_t)

The scheme is leapfrog on a grid, of second order. Viscous friction uses the mean of old and new velocity, other laws the
old one. The initial state is built dislocation by dislocation. Each gets the psi that belongs to its length times the
local a(x); the library integrates a phase instead. Lengths and times of the scenario are multiplied by `scale`, friction
and F divided by it.
"""

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipj, ellipkm1


def psi_of_length(length):
    """psi of a train at rest whose dislocations are `length` apart: length cosh psi = 2 K."""
    def excess(z):
        psi = np.exp(z)
        K = np.log(4 / psi) if psi < 1e-8 else float(ellipkm1(np.tanh(psi)**2))
        return 2 * K - length * np.cosh(psi)
    return float(np.exp(brentq(excess, -700, 3)))


def one_dislocation(share, psi):
    """Returns u of one dislocation at the fraction `share` of its length: u = pi - 2 am(K (2 share - 1)).

    u falls from 2 pi at share = 0 to 0 at share = 1.
    """
    K = np.log(4 / psi) if psi < 1e-8 else float(ellipkm1(np.tanh(psi)**2))
    z = K * (2 * share - 1)
    if psi < 1e-6:  # the dislocations are so far apart that each is a kink of the sine-Gordon equation
        return np.pi - 2 * (2 * np.arctan(np.exp(z)) - np.pi / 2)
    return np.pi - 2 * ellipj(z, 1 / np.cosh(psi)**2)[3]


def lay(x, number, contact):
    """Returns u on the grid. The increasing function `number` is the number of dislocations to the left of x."""
    q = np.array([number(v) for v in x])
    u = np.empty_like(x)
    for j in range(int(np.floor(q[0])), int(np.floor(q[-1])) + 1):
        here = np.flatnonzero((q >= j) & (q < j + 1))
        if len(here) == 0:
            continue
        # A dislocation ends where q is a whole number. The domain cuts the outermost dislocations, so we extrapolate
        # their lengths from the local density.
        i = here[len(here) // 2]
        density = (q[min(i + 1, len(q) - 1)] - q[i - 1]) / (x[min(i + 1, len(x) - 1)] - x[i - 1]) if i > 0 else 0
        left, right = np.interp([j, j + 1], q, x)
        inside = q[0] <= j and q[-1] >= j + 1
        length = right - left if inside else 1 / density
        u[here] = one_dislocation(q[here] - j, psi_of_length(length * contact(x[i]))) - 2 * np.pi * j
    return u


class SlowChain:
    """A chain with fixed ends, which waves must not reach."""

    def __init__(self, stress, left, right, scale, law="none", coefficient=0.0, exponent=1.0, forcing=None, contact=None,
                 spacing=0.1):
        self.scale, self.law, self.n = scale, law, exponent
        self.C = coefficient / scale if law != "none" else 0.0
        self.forcing, self.contact = forcing, contact or (lambda x: 1 + 0 * x)
        sites = int(np.ceil((right - left) * scale / spacing))
        self.x = np.linspace(left, right, sites + 1)  # in units of the scenario
        self.h = (right - left) * scale / sites
        middle = (self.x[1:] + self.x[:-1]) / 2
        k = np.array([stress(v) for v in middle])
        number = np.concatenate([[0], np.cumsum(k)]) * self.h / (2 * np.pi)
        number -= np.interp(0, self.x, number)
        self.first = lay(self.x * scale, lambda v: np.interp(v, self.x * scale, number),
                         lambda v: float(self.contact(np.float64(v / scale))))
        self.square = self.contact(self.x)**2

    def force(self, u, velocity, t):
        out = np.zeros_like(u)
        out[1:-1] = (u[2:] - 2 * u[1:-1] + u[:-2]) / self.h**2
        out -= self.square * np.sin(u)
        if self.forcing:
            out += self.forcing(self.x, t / self.scale) / self.scale
        if self.law == "power":
            out -= self.C * np.abs(velocity)**self.n * np.sign(velocity)
        elif self.law == "coulomb":
            out -= self.C * np.tanh(velocity / 1e-4)
        out[0] = out[-1] = 0
        return out

    def run(self, end):
        """Returns the slip of the sites: the change of u, divided by the scale."""
        dt = 0.9 * self.h
        steps = int(np.ceil(end * self.scale / dt))
        dt = end * self.scale / steps
        drag = self.C * dt / 2 if self.law == "viscous" else 0.0
        u = self.first.copy()
        before = u.copy()
        for step in range(steps):
            push = self.force(u, (u - before) / dt, step * dt)
            if step == 0:
                after = u + dt**2 / 2 * push
            else:
                after = (2 * u - (1 - drag) * before + dt**2 * push) / (1 + drag)
            before, u = u, after
        return (u - self.first) / self.scale
