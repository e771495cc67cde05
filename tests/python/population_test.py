"""slipfront.moment_duration and slipfront.population."""

import importlib.util
import os
import pathlib
import unittest
import warnings

import numpy as np

import slipfront

SOURCE = pathlib.Path(os.environ["SLIPFRONT_SOURCE"])


def script(path):
    """Returns a script of the repository as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class MomentDuration(unittest.TestCase):
    def test_the_exponent_falls_from_two_to_one(self):
        damping = np.array([0.01, 1, 2, 4, 20, 40, 100, 1e4, 1e9])
        for stress in (0.2, 0.855):
            data = slipfront.moment_duration(stress, damping)
            exponent = data.exponent.values
            self.assertTrue((np.diff(exponent) < 1e-3).all(), exponent)
            np.testing.assert_allclose(exponent[[0, 6, 7, 8]], [2, 1, 1, 1], atol=0.012)
            mean = 2 + np.diff(np.log(data.potency.values)) / np.diff(np.log(damping))
            np.testing.assert_allclose(mean[[1, 2, 4]], [1.62, 1.41, 1.04], atol=0.01)
            self.assertEqual(float(slipfront.moment_duration(stress, 0).exponent), 2)

    def test_agrees_with_the_solver(self):
        potency = script(SOURCE / "tools" / "potency" / "make.py").potency
        for stress, damping in ((0.09, 3.0), (0.3, 250.0), (0.855, 0.0), (0.855, 0.7), (2.5, 30.0)):
            free = slipfront.relations(stress=stress)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                expected = potency(stress, damping) * float(free.rupture_velocity * free.slip_velocity)
            self.assertLess(abs(float(slipfront.moment_duration(stress, damping).potency) / expected - 1), 3e-3, (stress, damping))

    def test_the_exponent_is_the_slope(self):
        damping = np.geomspace(1e-3, 1e10, 2001)
        data = slipfront.moment_duration(0.4, damping)
        slope = 2 + np.gradient(np.log(data.potency.values), np.log(damping))
        np.testing.assert_allclose(data.exponent[1:-1], slope[1:-1], atol=1e-3)

    def test_out_of_range(self):
        for arguments, message in (((0.01, 1), "stress = 0.01: out of range; allowed: 0.05 to 3"), ((1, -1), "damping_number = -1: out of range; allowed: >= 0")):
            with self.assertRaisesRegex(slipfront.InputError, message):
                slipfront.moment_duration(*arguments)
        self.assertTrue(np.isnan(slipfront.moment_duration(np.nan, 1).potency))


if __name__ == "__main__":
    unittest.main()
