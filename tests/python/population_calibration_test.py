"""Populations whose parameters are known: docs/population_calibration.py, and the states of events."""

import unittest
import unittest.mock

import numpy as np

from population_test import LOG_HARDNESS, SOURCE, script
from slipfront._population import priors, sample, single, synthetic
from slipfront._population.likelihood import Likelihood


class Calibration(unittest.TestCase):
    @unittest.mock.patch.object(sample, "PARTICLES", 25)
    def test_the_calibration_runs(self):
        calibration = script(SOURCE / "docs" / "population_calibration.py")
        options = calibration.arguments(["--events", "12", "--studies", "4", "--steps", "20"])
        seed, ranks, *_ = calibration.rank((3, options))
        self.assertEqual((seed, ranks.shape), (3, (len(priors.NAMES),)))
        self.assertTrue(((ranks >= 0) & (ranks <= 1)).all())
        np.testing.assert_array_equal(calibration.rank((3, options))[1], ranks)

    def test_states_of_events_are_those_that_were_drawn(self):
        generator = np.random.default_rng(4)
        events = synthetic.design(generator, 60, 12, threshold=1e-3)
        values = np.array([0.4, 0.15, 1e7, 0.5, 1e-2, 0.7, 0.3])
        truth = synthetic.observe(generator, events, values, LOG_HARDNESS)
        likelihood = Likelihood(events, LOG_HARDNESS)
        draws = np.array([single.draw(likelihood, values, generator) for _ in range(200)])
        for i in range(3):
            inside = (draws[:, i] < truth[:, i]).mean(axis=0)
            self.assertGreater(((inside > 0.05) & (inside < 0.95)).mean(), 0.8)
        alone = np.array([single.draw(likelihood, likelihood.prior.broad(), generator) for _ in range(100)])
        self.assertGreater(np.median(alone[:, 1].std(axis=0)), np.median(draws[:, 1].std(axis=0)))


if __name__ == "__main__":
    unittest.main()
