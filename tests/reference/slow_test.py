"""The slow solvers against what is known exactly, and against each other."""

import math
import pathlib
import sys
import unittest

import numpy as np
from mpmath import mp, mpf

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import oracle  # noqa: E402
from slow_chain import SlowChain  # noqa: E402
from slow_pulse import Friction, SlowPulse, complete, find_psi  # noqa: E402


def step(left, right):
    return lambda x: left if x < 0 else right


def tanh(left, right):
    return lambda x: right + (left - right) * (1 - np.tanh(x)) / 2


class SlowSolvers(unittest.TestCase):
    def test_psi_solves_its_equation(self):
        psi = np.array([1e-40, 1e-9, 1e-3, 0.3, 1.5])
        for phi in (0.0, 1e-3, 2.0):
            K, E = complete(psi)
            found = find_psi(2 * K / (np.cosh(phi) * np.cosh(psi)), 8 * np.sinh(phi) * np.cosh(psi) * E, 0 * psi + 1e-2)
            np.testing.assert_allclose(found, psi, rtol=1e-9)

    def test_step_into_empty_is_the_closed_form(self):
        with mp.workdps(oracle.DIGITS):
            W = float(oracle.pulse(oracle.psi_of_stress(mpf("0.855")))[4])
        solver = SlowPulse(step(0.855, 0), -3, 1, 200)
        slip = solver.slip(solver.run([0, 4], 1e-5)[-1], [0.0])[0]
        self.assertLess(abs(slip / (4 * W) - 1), 2e-3)

    def test_step_into_a_train_is_the_riemann_problem(self):
        with mp.workdps(oracle.DIGITS):
            psi = [oracle.psi_of_stress(mpf(stress)) for stress in ("0.855", "0.179")]
            W = float(oracle.riemann(mpf(0), psi[0], mpf(0), psi[1])[3])
        solver = SlowPulse(step(0.855, 0.179), -3, 3, 150)
        slip = solver.slip(solver.run([0, 4], 1e-4)[-1], [0.0])[0]
        self.assertLess(abs(slip / (4 * W) - 1), 1e-2)

    def test_uniform_train_under_a_force(self):
        F, C, end = 0.02, 0.7, 3.0
        solver = SlowPulse(step(0.8, 0.8), -1, 1, 20, Friction("viscous", C), lambda x, t: F + 0 * x)
        momentum = solver.run([0, end])[-1][1::2]
        np.testing.assert_allclose(momentum, 2 * math.pi * F / C * (1 - math.exp(-C * end)), rtol=1e-5)

    def test_friction_laws_that_are_one(self):
        phi, psi, contact = np.array([1e-3, 0.4]), np.array([0.02, 0.5]), np.array([1.0, 1.3])
        momentum = 8 * contact * np.sinh(phi) * np.cosh(psi) * complete(psi)[1]
        for closure in ("consistent", "paper"):
            viscous = Friction("viscous", 0.3, closure=closure)(phi, psi, contact, momentum)
            power = Friction("power", 0.3, 1 + 1e-9, closure)(phi, psi, contact, momentum)
            np.testing.assert_allclose(viscous, power, rtol=1e-6)

    def test_chain_follows_the_pulse(self):
        end, left, right = 3.0, -4, 4
        pulse = SlowPulse(tanh(0.855, 0.4), left, right, 150, Friction("viscous", 0.5))
        chain = SlowChain(tanh(0.855, 0.4), left, right, 200, "viscous", 0.5, spacing=0.25)
        edges = np.linspace(left, right, 41)
        slip = np.array([np.mean(part) for part in np.split(chain.run(end), np.searchsorted(chain.x, edges[1:-1]))])
        expected = pulse.slip(pulse.run([0, end], 1e-5)[-1], (edges[1:] + edges[:-1]) / 2)
        self.assertLess(np.sum(np.abs(slip - expected)) / np.sum(np.abs(expected)), 0.05)


if __name__ == "__main__":
    unittest.main()
