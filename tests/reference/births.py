"""A rule for the births of dislocations at a pulled end (docs/theory/7_loading.md), and a chain to compare it with.

Both are half lines x > 0, pulled at x = 0. Friction is divided by the scale s of the chain. Times and numbers of births are
divided by s too, so they have a limit for large s. The averages follow cells of dislocations and are of first order.
"""

import math

import numpy as np
from scipy.special import ellipe, ellipkm1

LOSS = 10.5  # fitted to chains, as are the numbers of birth_frequency
PSI = np.geomspace(1e-6, 2, 600)


def birth_frequency(stress):
    """Angular frequency of births into an empty interface, (7.9)."""
    excess = stress - 2
    return np.sqrt(0.42 + 2.75 * excess + 1.06 * excess**2)


def integrals(psi):
    """K and E of m1 = tanh^2 psi."""
    m1 = np.tanh(psi)**2
    return ellipkm1(m1), ellipe(1 - m1)


def action_flux(phi, psi):
    """Flux J of wave action."""
    return 4 / np.pi * np.cosh(phi) * np.cosh(psi) * integrals(psi)[1]


def end_stress(phi, psi):
    """Stress at an end where the train is slower than its waves, (7.10)."""
    rest = 2 * np.cosh(psi) - action_flux(0, psi)
    return action_flux(phi, psi) + rest / (1 + LOSS * psi**2 * np.maximum(phi, 0))


def wave_number(phi, psi):
    return np.pi * np.cosh(phi) * np.cosh(psi) / integrals(psi)[0]


def momentum(phi, psi):
    """Momentum per dislocation."""
    return 8 * np.sinh(phi) * np.cosh(psi) * integrals(psi)[1]


def free_birth(stress):
    """Rapidity phi and psi of the train that leaves into an empty interface, from (7.8) and (7.9)."""
    phi = np.arccosh(np.maximum(stress / action_flux(0, PSI), 1))
    flux = np.tanh(phi) * wave_number(phi, PSI)
    rising = slice(0, np.argmax(flux) + 1)
    return tuple(np.interp(birth_frequency(stress), flux[rising], values[rising]) for values in (phi, PSI))


def held_birth(stress, invariant):
    """State at the end from (7.10) and the invariant phi - psi, which arrives from the train. None: nothing is born."""
    psi = np.linspace(max(1e-6, -invariant), 2, 400)
    excess = end_stress(psi + invariant, psi) - stress
    last = np.flatnonzero((excess[:-1] < 0) & (excess[1:] >= 0))
    if not last.size:
        return None
    i = last[-1]
    psi = psi[i] - excess[i] * (psi[i + 1] - psi[i]) / (excess[i + 1] - excess[i])
    return psi + invariant, psi


class Gas:
    """Cells with a number of dislocations each; the first one, next to the end, grows and is halved."""

    def __init__(self, cell):
        self.cell, self.number, self.log_psi = cell, np.zeros(0), np.zeros(0)
        self.edges = np.zeros(1)
        self.total = np.zeros(0)  # momentum of each cell

    def states(self):
        length, per = np.diff(self.edges) / self.number, self.total / self.number

        def residual(y):
            K, E = integrals(np.exp(y))
            return length * np.hypot(np.cosh(np.exp(y)), per / 8 / E) - 2 * K
        y = self.log_psi
        for _ in range(40):
            here = residual(y)
            change = here * 1e-5 / (residual(y + 1e-5) - here)
            y = np.minimum(y - np.clip(change, -1.5, 1.5), 1.5)
            if np.max(np.abs(change)) < 1e-8:
                break
        self.log_psi = y
        psi = np.exp(y)
        return np.arcsinh(per / (8 * np.cosh(psi) * integrals(psi)[1])), psi

    def end(self, stress, phi, psi):
        """State at the end, or None if nothing enters."""
        free = free_birth(stress) if stress > 2 else None
        if not self.number.size:
            return free
        if free:
            mean = (phi[0] + free[0]) / 2, (psi[0] + free[1]) / 2
            k, k0 = wave_number(*free), wave_number(phi[0], psi[0])
            K, E = integrals(mean[1])
            speed = (np.tanh(free[0]) * k - np.tanh(phi[0]) * k0) / (k - k0) if abs(k - k0) > 0.1 * k else \
                np.tanh(mean[0]) - np.tanh(mean[1]) * K / E
            if speed > 0:
                return free
        return held_birth(stress, phi[0] - psi[0])

    def run(self, stress_at, friction, outputs):
        """Yields (time, births, stress) at the outputs. friction(momentum, dt) returns the momentum after dt."""
        time, births = 0., 0.
        for output in outputs:
            while time < output - 1e-9:
                stress = stress_at(time, births)
                if not self.number.size:
                    time += 1e-3 if stress <= 2 else 0
                    if stress > 2:
                        self.first(free_birth(stress))
                        births += self.cell
                        time += self.edges[-1] / np.tanh(free_birth(stress)[0])
                    continue
                dt, entering = self.step(stress, friction, output - time)
                time += dt
                births += entering
            yield time, births, stress_at(time, births)

    def first(self, state):
        self.number = np.array([self.cell])
        self.edges = np.array([0, self.cell * 2 * np.pi / wave_number(*state)])
        self.total = self.cell * np.array([momentum(*state)])
        self.log_psi = np.log([state[1]])

    def step(self, stress, friction, longest):
        phi, psi = self.states()
        velocity, pressure = np.tanh(phi), 2 * np.sinh(psi)**2
        stiffness = 2 * np.sinh(2 * psi) * np.cosh(phi)**2 + 1e-200
        state = self.end(stress, phi, psi)
        entering = into = 0.
        if state:
            entering = np.tanh(state[0]) * wave_number(*state) / 2 / np.pi
            into = entering * momentum(*state) + 2 * np.sinh(state[1])**2
        else:  # the train rests against the end
            into = 2 * np.sinh(max(psi[0] - phi[0], 0))**2
        a, b = stiffness[:-1], stiffness[1:]
        face = (a * velocity[:-1] + b * velocity[1:] - np.diff(pressure)) / (a + b)
        at_face = (b * pressure[:-1] + a * pressure[1:] - a * b * np.diff(velocity)) / (a + b)
        face = np.concatenate(([0], np.clip(face, -1, 1), [np.tanh(phi[-1] + psi[-1])]))
        at_face = np.concatenate(([0], np.maximum(at_face, 0), [0]))
        dt = min(0.4 * np.min(np.diff(self.edges)), longest)
        self.edges = self.edges + dt * face
        self.total -= dt * np.diff(at_face)
        self.total[0] += dt * into
        self.total = self.number * friction(self.total / self.number, dt)
        self.number[0] += dt * entering
        if self.number[0] > 2 * self.cell:
            for name in ("number", "total"):
                old = getattr(self, name)
                setattr(self, name, np.concatenate(([old[0] / 2, old[0] / 2], old[1:])))
            self.edges = np.concatenate(([0, self.edges[1] / 2], self.edges[1:]))
            self.log_psi = np.concatenate((self.log_psi[:1], self.log_psi))
        return dt, dt * entering


def state_of(wave_number_, frequency):
    """Rapidity phi and psi of a uniform train."""
    phi = np.arctanh(frequency / wave_number_)
    return phi, np.interp(wave_number_, wave_number(phi, PSI), PSI)


def train_at_rest(psi, length, h):
    """Slip of a train at rest whose stress at x = 0 is the largest that it supports."""
    def slope(u):
        return -2 * math.hypot(math.sinh(psi), math.sin(u / 2))
    u = [-math.pi]
    for _ in range(int(length / h)):
        middle = u[-1] + h / 2 * slope(u[-1])
        u.append(u[-1] + h * slope(middle))
    return np.array(u)


def chain(stress_at, friction, scale, start, outputs, h=0.1):
    """Yields (time, slip of all sites, stress) at the outputs. friction(u_t) is multiplied by 1 / scale."""
    before, now = start.copy(), start.copy()
    step = 0
    for output in outputs:
        while step * h < output * scale - 1e-9:
            # A spring at site 0 would make this scheme unstable, so it follows site 1.
            stress = stress_at(step * h / scale, (now[1] - start[1]) / (2 * np.pi * scale))
            both = np.empty_like(now)
            both[1:-1] = now[2:] + now[:-2]
            both[0] = 2 * (now[1] + h * stress)
            both[-1] = 2 * now[-1]
            after = both - before - h**2 * np.sin(both / 2)
            after -= h**2 * friction((after - before) / (2 * h)) / scale
            after[-1] = start[-1]
            before, now = now, after
            step += 1
        yield output, now, stress


def births(stress_at, friction, scale, length, outputs):
    """Number of births on an empty chain, and stress at its end, at the outputs."""
    start = np.zeros(int(length * scale / 0.1))
    return np.array([(u[0] / (2 * np.pi * scale), stress) for _, u, stress in chain(stress_at, friction, scale, start, outputs)])


def state_at_end(stress, start, end=300, h=0.1):
    """Frequency of births, phi and psi near the end of a chain without friction under a constant stress."""
    near, far = int(10 / h), int(40 / h)
    slip, strain = [], []
    for _, u, _ in chain(lambda time, number: stress, lambda w: 0, 1, start, np.arange(end / 2, end, 0.3), h):
        slip.append(u[near])
        strain.append((u[near] - u[far]) / (40 - 10))
    frequency = np.polyfit(np.arange(len(slip)) * 0.3, slip, 1)[0]
    return frequency, *state_of(np.mean(strain), frequency)
