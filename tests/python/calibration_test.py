"""docs/calibration.py on few events: truths from the prior, tables that slipfront reads, and coverage near 0.9."""

import contextlib
import importlib.util
import io
import os
import unittest

import numpy as np

from support import SOURCE


def script():
    spec = importlib.util.spec_from_file_location("calibration", os.path.join(SOURCE, "docs", "calibration.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Calibration(unittest.TestCase):
    def test_intervals_contain_the_truth_of_nine_events_in_ten(self):
        calibration = script()
        options = calibration.arguments(["--events", "100"])
        for number in (3, 12):
            rows, _ = calibration.calibrate(number, options)
            for name in calibration.QUANTITIES:
                with_interval, coverage, counts = rows[name]
                self.assertGreater(with_interval, 0.95)
                self.assertLess(abs(coverage - 0.9), 4 * (0.09 / 100)**0.5, f"{number} {name}")
                self.assertEqual(counts.sum(), round(100 * with_interval))
                self.assertGreater(calibration.probability(counts), 1e-6, f"{number} {name}: {counts}")

    def test_prints_the_table(self):
        calibration = script()
        with contextlib.redirect_stdout(io.StringIO()) as out:
            calibration.main(["--events", "20", "--only", "1,4"])
        rows = [line for line in out.getvalue().splitlines() if line.startswith("| ")]
        self.assertEqual([row.split("|")[1].strip() for row in rows], ["no.", "1", "4"])
        self.assertIn("outside 0.885 to 0.915", out.getvalue())

    def test_finds_ranks_that_are_not_uniform(self):
        calibration = script()
        self.assertGreater(calibration.probability(np.full(10, 150)), 0.99)
        self.assertLess(calibration.probability(np.array([200, 180, 160, 150, 140, 140, 140, 140, 130, 120])), 1e-3)


if __name__ == "__main__":
    unittest.main()
