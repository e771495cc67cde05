"""The modulation equations per dislocation, by another route than the library's: a second opinion for tests.

    x_t = U    M_t = -p_q + 2 pi F - friction - l <1 - cos u> (a^2)_x    p = 2 a^2 sinh^2 psi    q counts dislocations
    l = x_q = 2 K / (a cosh phi cosh psi)    M = 8 a sinh phi cosh psi E

Places x and momenta M live on the faces between parcels, spacing and pressure in the parcels between them: a staggered
grid, plain central differences, an artificial viscosity at shocks (von Neumann & Richtmyer), and scipy's LSODA in time.
The library has finite volumes, WENO, Riemann invariants and Rodas instead. Second order where smooth.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator
from scipy.special import ellipe, ellipkm1

_S, _WEIGHT = np.polynomial.legendre.leggauss(48)
_S, _WEIGHT = (_S + 1) / 2, _WEIGHT / 2
_SIN2 = np.sin(np.pi * _S**4 / 2)**2  # sin^2(u / 2) at points u in 0 ... pi that crowd at u = 0
_WEIGHT = _WEIGHT * 4 * _S**3  # the mean over u


class Unsuitable(ValueError):
    """A scenario that the slow solver is not made for."""


def complete(psi):
    """K and E of m1 = tanh^2 psi."""
    m1 = np.tanh(psi)**2
    K = np.where(psi < 1e-8, np.log(4 / np.maximum(psi, 1e-300)), ellipkm1(np.maximum(m1, 1e-300)))
    return K, ellipe(1 - m1)


def find_psi(spacing, momentum, psi):
    """psi of parcels by Newton's method in ln psi: l sqrt(cosh^2 psi + (M / 8E)^2) = 2 K, in local units."""
    z = np.log(psi)
    for _ in range(100):
        psi = np.exp(z)
        K, E = complete(psi)
        root = np.sqrt(np.cosh(psi)**2 + (momentum / (8 * E))**2)
        slope = spacing / 2 * (np.cosh(psi) * np.sinh(psi)
                               - (momentum / 8)**2 / E**3 * (K - E) * np.tanh(psi)) / root
        slope = psi * slope + psi * (E - np.tanh(psi)**2 * K) / np.tanh(psi)
        step = np.clip((K - spacing / 2 * root) / slope, -2, 0.5)
        z = np.clip(z + np.nan_to_num(step), -690, 3)
        if np.max(np.abs(step)) < 1e-12:
            break
    return np.exp(z)


class Friction:
    """Loss of momentum of one dislocation: 2 pi <f>, the mean over u (closure consistent) or over x (paper)."""

    def __init__(self, law="none", coefficient=0.0, exponent=1.0, closure="consistent"):
        self.C = coefficient if law != "none" else 0.0
        self.n = {"viscous": 1.0, "coulomb": 0.0, "power": exponent}.get(law, 1.0)
        self.paper = closure == "paper"
        self.at_rest = 0.0  # below this rapidity dry friction (n < 1) grows smoothly

    def __call__(self, phi, psi, contact, momentum):
        if self.C == 0:
            return 0 * phi
        if self.n == 1 and not self.paper:
            return self.C * momentum
        w = 2 * contact * np.sinh(phi)
        size = np.sqrt(w * w + self.at_rest**2) if self.n < 1 else np.abs(w)
        S = np.sqrt(np.sinh(psi)[:, None]**2 + _SIN2)  # w(u) / (2 sinh phi)
        if self.paper:  # du / sigma is dx, and the integral of 1 / S over a period is 4 K / cosh psi
            mean = (2 * np.pi * S**(self.n - 1)) @ _WEIGHT / (4 * complete(psi)[0] / np.cosh(psi))
        else:
            mean = S**self.n @ _WEIGHT
        return 2 * np.pi * self.C * np.where(size > 0, size, 1)**(self.n - 1) * w * mean


class SlowPulse:
    """One stressed stretch. `ends`: for each end "free" (empty beyond), "continued" or "fixed"."""

    def __init__(self, stress, left, right, parcels=400, friction=None, forcing=None, contact=None):
        self.friction = friction or Friction()
        self.forcing = forcing or (lambda x, t: 0 * x)
        self.contact = contact or (lambda x: 1 + 0 * x)
        x = np.linspace(left, right, 40001)
        if left < 0 < right:  # a step stands on a point
            x = np.concatenate([np.linspace(left, 0, 20001), np.linspace(0, right, 20001)[1:]])
        k = np.array([stress(v) for v in (x[1:] + x[:-1]) / 2])
        inside = np.flatnonzero(k > 0)
        if len(inside) < 2 or inside[-1] - inside[0] + 1 != len(inside):
            raise Unsuitable("the slow solver wants one stressed stretch")
        self.ends = ["free" if inside[0] > 0 else "continued", "free" if inside[-1] < len(k) - 1 else "continued"]
        x, k = x[inside[0]:inside[-1] + 2], k[inside[0]:inside[-1] + 1]
        number = np.concatenate([[0], np.cumsum(k * np.diff(x))]) / (2 * np.pi)
        self.faces = self.lay(x, k, parcels)
        self.q = np.interp(self.faces, x, number)
        self.dq = np.diff(self.q)
        self.q0 = PchipInterpolator(self.faces, self.q)
        local = np.diff(self.faces) / self.dq * self.contact((self.faces[1:] + self.faces[:-1]) / 2)
        self.psi = find_psi(local, 0 * local, np.minimum(np.exp(-local / 2) * 4, 1) + 1e-300)
        self.friction.at_rest = 1e-4 * float(np.max(self.psi))
        self.friction.at_rest = min(self.friction.at_rest, 1e-4)

    def lay(self, x, k, parcels):
        """Faces: even in x, with half of them where the stress changes, and finer towards free edges."""
        k = np.interp(x, (x[1:] + x[:-1]) / 2, k)
        box = np.ones(len(x) // 16) / (len(x) // 16)
        smooth = np.convolve(np.pad(k, len(box), mode="edge"), box, "same")[len(box):-len(box)]
        change = np.concatenate([[0], np.cumsum(np.abs(np.diff(smooth)))])
        share = (x - x[0]) / (x[-1] - x[0]) + change / max(change[-1], 1e-3 * k.max())
        s = np.linspace(0, 1, parcels + 1)
        free = [end == "free" for end in self.ends]
        s = s * s * (3 - 2 * s) if all(free) else s * s if free[0] else 1 - (1 - s)**2 if free[1] else s
        faces = np.interp(s * share[-1], share, x)
        jump = np.argmax(np.abs(np.diff(k)))
        if abs(k[jump + 1] - k[jump]) > 0.02 * k.max():  # a step: a face on it
            step = x[jump] if abs(x[jump]) < abs(x[jump + 1]) else x[jump + 1]
            faces[1 + np.argmin(np.abs(faces[1:-1] - step))] = step
        return faces

    def parts(self, y):
        x, M = y[0::2], y[1::2]
        a, middle = self.contact(x), (x[1:] + x[:-1]) / 2
        a_in = self.contact(middle)
        spacing, M_in = np.diff(x) / self.dq, (M[1:] + M[:-1]) / 2
        self.psi = psi = find_psi(np.maximum(spacing * a_in, 1e-9), M_in / a_in, self.psi)
        K, E = complete(psi)
        inertia = np.cosh(psi) * E
        at_faces = np.concatenate([[1.0 if self.ends[0] == "free" else inertia[0]], (inertia[1:] + inertia[:-1]) / 2,
                                   [1.0 if self.ends[1] == "free" else inertia[-1]]])
        phi = np.arcsinh(M / (8 * a * at_faces))
        return x, M, a, a_in, spacing, psi, K, E, phi

    def rates(self, t, y):
        x, M, a, a_in, spacing, psi, K, E, phi = self.parts(y)
        U = np.tanh(phi)
        if self.fixed(0):
            U[0] = 0
        if self.fixed(1):
            U[-1] = 0
        p = 2 * a_in**2 * np.sinh(psi)**2
        closing = np.maximum(U[:-1] - U[1:], 0)
        boost = np.cosh((phi[1:] + phi[:-1]) / 2)**2
        p = p + closing * boost * (2 * a_in * np.sinh(2 * psi) + 16 * closing / spacing)
        outside = [0 if self.ends[0] == "free" else p[0], 0 if self.ends[1] == "free" else p[-1]]
        jump = np.diff(np.concatenate([[outside[0]], p, [outside[1]]]))
        mass = np.concatenate([[self.dq[0] / 2], (self.dq[1:] + self.dq[:-1]) / 2, [self.dq[-1] / 2]])
        psi_face = np.concatenate([psi[:1], np.sqrt(psi[1:] * psi[:-1]), psi[-1:]])
        force = -jump / mass + 2 * np.pi * self.forcing(x, t) - self.friction(phi, psi_face, a, M)
        substrate = spacing * 2 * np.cosh(psi)**2 * (E / K - np.tanh(psi)**2)
        slope = (self.contact(x + 1e-5)**2 - self.contact(x - 1e-5)**2) / 2e-5
        force -= slope * np.concatenate([substrate[:1], (substrate[1:] + substrate[:-1]) / 2, substrate[-1:]])
        rate = np.empty_like(y)
        rate[0::2], rate[1::2] = U, force
        return rate

    def fixed(self, end):
        return self.ends[end] == "fixed"

    def run(self, times, tolerance=1e-7):
        """States at the times, as an array of [x, M, x, M ...] of the faces."""
        y = np.zeros(2 * len(self.faces))
        y[0::2] = self.faces
        # A wave needs 8 psi^2 of momentum to be seen.
        scale = np.empty_like(y)
        scale[0::2] = np.interp(np.arange(len(self.faces)), np.arange(len(self.dq)) + 0.5, np.diff(self.faces))
        scale[1::2] = max(float(np.max(self.psi)), 1e-12)
        done = solve_ivp(self.rates, (0, times[-1]), y, method="LSODA", t_eval=times, lband=3, uband=3,
                         rtol=1e-12, atol=tolerance * scale)
        self.evaluations = done.nfev
        if not done.success:
            raise ArithmeticError(done.message)
        return done.y.T

    def slip(self, y, places):
        """2 pi times the number of dislocations that have passed these places."""
        now = PchipInterpolator(y[0::2], self.q)
        places = np.asarray(places, float)

        def count(curve, faces):
            return np.where(places <= faces[0], self.q[0], np.where(places >= faces[-1], self.q[-1], curve(places)))

        return 2 * np.pi * (count(self.q0, self.faces) - count(now, y[0::2]))

    def slip_velocity(self, y, place):
        """W = U k between the faces around a place."""
        x, _, _, _, spacing, _, _, _, phi = self.parts(y)
        if not x[0] < place < x[-1]:
            return 0.0
        i = np.searchsorted(x, place) - 1
        middle = (x[1:] + x[:-1]) / 2
        return float(np.interp(place, x, np.tanh(phi)) * np.interp(place, middle, 2 * np.pi / spacing)) if i >= 0 else 0.0
