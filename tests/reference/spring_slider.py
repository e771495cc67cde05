"""The spring-slider of the field: one block with rate-and-state friction, pulled through a spring.

    u'' = kappa (v t - u) - f(u', theta),    theta' = 1 - |u'| theta / D    or    -x ln x, x = |u'| theta / D,
    f = a asinh((w / 2 w0) exp((f0 + b ln(theta w0 / D)) / a)).

scipy's Radau integrates it in the stretch of the spring, f / a and ln theta. These variables resolve all decades of the
velocity: a block at rest with f0 / a = 60 creeps at 1e-26 and less. This file shares no code with slipfront. It prints the
critical stiffness, from the eigenvalues of steady sliding, the limit cycle at two stiffnesses, and blocks with friction as
in a laboratory: the numbers of tests/chain/implicit/spring_slider_test.cpp.

Usage: spring_slider.py [TOLERANCE]      (default 1e-10)
"""

import dataclasses
import math
import sys

import numpy as np
from scipy.integrate import Radau

LARGEST = 300.0  # exponent that Newton's method may try


@dataclasses.dataclass
class Block:
    """Friction and loading. `theta` is the state at t = 0; an event begins where the velocity passes `event`."""
    f0: float
    a: float
    b: float
    D: float
    w0: float
    kappa: float
    v: float
    theta: float
    event: float
    state: str = "ageing"
    sliding: float = 0.0  # velocity at t = 0; the spring then balances friction at the state theta

    def logarithms(self, s, log_theta):
        """Of |w| and of the slope of w over s = f / a."""
        scale = math.log(2 * self.w0) - (self.f0 + self.b * (log_theta + math.log(self.w0 / self.D))) / self.a
        size = max(abs(s), 1e-250)
        if size > 20:
            return scale + size - math.log(2), scale + size - math.log(2)
        return scale + math.log(math.sinh(size)), scale + math.log(math.cosh(size))

    def velocity(self, y):
        return math.copysign(math.exp(min(self.logarithms(y[1], y[2])[0], LARGEST)), y[1]) if y[1] != 0 else 0.0

    def slope(self, _, y):
        stretch, s, log_theta = y
        log_w, log_slope = self.logarithms(s, log_theta)
        w = self.velocity(y)
        if self.state == "slip":
            heals = -abs(w) / self.D * (log_w + log_theta - math.log(self.D)) if w != 0 else 0.0
        else:
            heals = math.exp(min(-log_theta, LARGEST)) - abs(w) / self.D
        accelerates = (self.kappa * stretch - self.a * s) * math.exp(min(-log_slope, LARGEST))
        return [self.v - w, accelerates + self.b / self.a * math.tanh(s) * heals, heals]

    def start(self):
        log_theta = math.log(self.theta)
        log_scale = self.logarithms(0.0, log_theta)[1]
        s = math.asinh(self.sliding * math.exp(-log_scale)) if self.sliding > 0 else 0.0
        return [self.a * s / self.kappa, s, log_theta]

    def steps(self, end, tolerance):
        """Times, velocities and stretches, with five points of the interpolant in each step."""
        solver = Radau(self.slope, 0.0, self.start(), end, rtol=tolerance, atol=tolerance)
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise ArithmeticError(message)
            interpolant = solver.dense_output()
            for t in np.linspace(solver.t_old, solver.t, 6)[1:]:
                y = interpolant(t)
                yield t, self.velocity(y), y[0]

    def run(self, end, tolerance=1e-9):
        """Onsets and peak velocities of the events, whether the last is complete, slip and velocity at the end."""
        onsets, peaks, within, last = [], [], False, (0.0, 0.0)
        t = w = stretch = 0.0
        for t, w, stretch in self.steps(end, tolerance):
            if not within and w > self.event:
                part = math.log(self.event / last[1]) / math.log(w / last[1]) if last[1] > 0 else 0
                onsets.append(last[0] + (t - last[0]) * part)
                peaks.append(0.0)
                within = True
            if within:
                peaks[-1] = max(peaks[-1], w)
                within = w >= self.event / 2
            last = (t, w)
        return onsets, peaks, not within, self.v * t - (stretch - self.start()[0]), w


LIMIT_CYCLES = [Block(0.05, 0.01, 0.015, 1, 0.01, kappa, 0.001, 100, 0.01) for kappa in (0.0025, 0.0012)]
LABORATORY = [  # f0 / a of 60, 44 and 200; the second slides steadily after its first motion
    (Block(0.6, 0.01, 0.015, 1, 0.01, 0.004, 0.001, 100, 0.01), 450000),
    (Block(0.129, 0.00294, 0.002593, 0.06724, 0.001114, 0.003593, 0.0009073, 277.3, 0.009073, "slip"), 118714.24557756461),
    (Block(0.2, 0.001, 0.0015, 0.5, 0.001, 0.0007, 0.0001, 500, 0.001), 8e6)]
SLIDING = [  # steady sliding, disturbed by 1 %: a stable one, and two that become stick-slip
    (Block(0.6, 0.01, 0.008, 1, 0.01, 0.004, 0.001, 1000, 0.01, "ageing", 0.00101), 20000),
    (Block(0.6, 0.01, 0.015, 1, 0.01, 0.004, 0.001, 1000, 0.01, "ageing", 0.00101), 120000),
    (Block(0.6, 0.01, 0.015, 1, 0.01, 0.004, 0.001, 1000, 0.01, "slip", 0.00101), 120000)]


def critical_stiffness(a=0.01, b=0.015, D=1.0, v=0.001):
    """Where growth changes sign: of lambda^2 + kappa + (lambda / v)(a - b / (1 + lambda D / v)) = 0, by bisection."""
    low, high = 1e-9, 1.0
    for _ in range(200):
        kappa = (low + high) / 2
        q = D / v  # (lambda^2 + kappa)(1 + lambda q) + (lambda / v)(a (1 + lambda q) - b) = 0
        roots = np.roots([q, 1 + a * q / v, kappa * q + (a - b) / v, kappa])
        low, high = (kappa, high) if roots.real.max() > 0 else (low, kappa)
    return kappa


def main():
    tolerance = float(sys.argv[1]) if len(sys.argv) > 1 else 1e-10
    print(f"critical stiffness {critical_stiffness():.10f}   with inertia {0.005 * (1 + 0.001**2 / 0.01):.10f}")
    for block in LIMIT_CYCLES:
        onsets, peaks, *_ = block.run(12 * 4 * 0.05 / (block.kappa * block.v), tolerance)
        periods = np.diff(onsets)
        print(f"kappa {block.kappa}: period {periods[-1]:.8g}, before {periods[-2]:.8g}; peak velocity {peaks[-2]:.8g}")
    for block, end in LABORATORY + SLIDING:
        onsets, peaks, complete, slip, w = block.run(end, tolerance)
        first = f"first onset {onsets[0]:.8g}, peak {peaks[0]:.8g}" if onsets else "no event"
        print(f"f0/a {block.f0 / block.a:.3g}, {block.state}, from {block.sliding or 'rest'}: {len(onsets)} events, {first}; "
              f"slip {slip:.8g}, velocity {w:.8g} at the end, last complete {complete}")


if __name__ == "__main__":
    main()
