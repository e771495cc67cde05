"""The sine-Gordon equation by the plainest scheme there is, a second opinion on the library's chain:

    u_tt - u_xx + a(x)^2 sin u = F - f(u_t)

Leapfrog on a grid, friction by the mean of old and new velocity (viscous) or on the old one (other laws); second order.
The first state is laid dislocation by dislocation, each with the psi of its own length times a(x) there; the library
integrates a phase instead. Lengths and times are the scenario's, stretched by `scale`; friction and F divided by it.
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
    """u from 2 pi down to 0 over one dislocation, at shares 0 ... 1 of its length: u = pi - 2 am(K (2 share - 1))."""
    K = np.log(4 / psi) if psi < 1e-8 else float(ellipkm1(np.tanh(psi)**2))
    z = K * (2 * share - 1)
    if psi < 1e-6:  # dislocations apart: the kink itself
        return np.pi - 2 * (2 * np.arctan(np.exp(z)) - np.pi / 2)
    return np.pi - 2 * ellipj(z, 1 / np.cosh(psi)**2)[3]


def lay(x, number, contact):
    """u on the grid where `number` is the number of dislocations left of each place, a function of x that ascends."""
    q = np.array([number(v) for v in x])
    u = np.empty_like(x)
    for j in range(int(np.floor(q[0])), int(np.floor(q[-1])) + 1):
        here = np.flatnonzero((q >= j) & (q < j + 1))
        if len(here) == 0:
            continue
        # Its ends, where q is a whole number, seen from the grid; the outermost ones are cut by the domain.
        i = here[len(here) // 2]
        density = (q[min(i + 1, len(q) - 1)] - q[i - 1]) / (x[min(i + 1, len(x) - 1)] - x[i - 1]) if i > 0 else 0
        left, right = np.interp([j, j + 1], q, x)
        inside = q[0] <= j and q[-1] >= j + 1
        length = right - left if inside else 1 / density
        u[here] = one_dislocation(q[here] - j, psi_of_length(length * contact(x[i]))) - 2 * np.pi * j
    return u


class SlowChain:
    """The ends are fixed: waves must not reach them."""

    def __init__(self, stress, left, right, scale, law="none", coefficient=0.0, exponent=1.0, forcing=None, contact=None,
                 spacing=0.1):
        self.scale, self.law, self.n = scale, law, exponent
        self.C = coefficient / scale if law != "none" else 0.0
        self.forcing, self.contact = forcing, contact or (lambda x: 1 + 0 * x)
        sites = int(np.ceil((right - left) * scale / spacing))
        self.x = np.linspace(left, right, sites + 1)  # in the scenario's unit
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
        """u at the end, less u at the start, over the scale: slip at the sites."""
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
