"""The rule for births at a pulled end (docs/theory/7_loading.md, 7.4) against the chain."""

import math
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import births as rule  # noqa: E402


def viscous(momentum, dt):
    return momentum * np.exp(-dt)


def dry(momentum, dt):
    return np.sign(momentum) * np.maximum(np.abs(momentum) - 2 * np.pi * dt, 0)


class Births(unittest.TestCase):
    def compare(self, stress_at, friction, average_friction, within):
        times = [2, 4]
        chain = rule.births(stress_at, friction, 150, 2.2, times)
        averages = [row[1:] for row in rule.Gas(0.01).run(stress_at, average_friction, times)]
        np.testing.assert_allclose(np.array(averages)[:, 0], chain[:, 0], rtol=within)

    def test_empty_interface_takes_all_work_of_the_end_in_a_uniform_train(self):
        for stress in (2.1, 3, 4):
            frequency, phi, psi = rule.state_at_end(stress, np.zeros(3300))
            self.assertLess(abs(rule.action_flux(phi, psi) / stress - 1), 0.004)
            self.assertLess(abs(rule.birth_frequency(stress) / frequency - 1), 0.012)

    def test_train_in_front_of_the_end_sets_the_stress_there(self):
        for psi, factor in ((0.3, 1.1), (0.5, 1.02), (0.8, 1.2), (0.2, 1.35)):
            stress = factor * 2 * math.cosh(psi)
            _, *state = rule.state_at_end(stress, rule.train_at_rest(psi, 330, 0.1))
            self.assertLess(abs(rule.end_stress(*state) / stress - 1), 0.02)

    def test_births_at_constant_stress_and_viscous_friction_agree_within_five_percent(self):
        for stress in (2.1, 2.6, 4):
            with self.subTest(stress=stress):
                self.compare(lambda time, number, stress=stress: stress, lambda w: w, viscous, 0.05)

    def test_births_under_dry_friction_agree_within_five_percent(self):
        self.compare(lambda time, number: 2.6, lambda w: np.tanh(w / 0.05), dry, 0.05)

    def test_births_and_stress_of_an_end_pulled_through_a_spring_agree(self):
        def stress_at(time, number):
            return 2 * (2 * time - 2 * np.pi * number)
        times = [2, 4]
        chain = rule.births(stress_at, lambda w: w, 150, 1.8, times)
        averages = [row[1:] for row in rule.Gas(0.01).run(stress_at, viscous, times)]
        np.testing.assert_allclose(averages, chain, rtol=0.03)


if __name__ == "__main__":
    unittest.main()
