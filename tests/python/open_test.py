"""slipfront.open returns what the run returned: dimensions, coordinates, values and attributes."""

import os
import tempfile
import unittest
import warnings

import numpy as np

import slipfront
from support import SOURCE

STEP = os.path.join(SOURCE, "cases/step-viscous.toml")
LOADED = os.path.join(SOURCE, "cases/stick-slip.toml")
SHORT = {"time.end": 100, "output.every": 50, "domain.left": -31.41592653589793, "domain.right": 31.41592653589793}

#: Attributes that describe only the computation. Files do not hold them.
OF_COMPUTATION = {"steps", "solve_seconds", "wall_seconds", "first_crossing_time", "first_crossing_position"}
OF_CHAIN = OF_COMPUTATION | {"dislocations", "energy_drift", "ranks", "threads", "sites", "site_updates_per_second", "scale", "spacing", "window", "smooth_window",
                             "event_count", "event_recurrence_time", "event_median_stress_drop", "event_median_peak_velocity"}


class Open(unittest.TestCase):
    def pair(self, run, *arguments, **options):
        """The Dataset that a run returns, and the one that its file gives."""
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            path = os.path.join(folder, "file.nc")
            return run(*arguments, **options, output=path), slipfront.open(path)

    def same(self, data, opened, absent=(), more=()):
        self.assertEqual(set(data.variables) - set(absent), set(opened.variables) - set(more))
        for name in set(data.variables) - set(absent):
            one, other = data[name], opened[name]
            self.assertEqual((one.dims, one.attrs), (other.dims, other.attrs), name)
            self.assertEqual((name in data.coords, name in data.indexes), (name in opened.coords, name in opened.indexes), name)
            np.testing.assert_array_equal(one.values, other.values, name)

    def attributes(self, data, opened, absent):
        self.assertEqual({name for name in data.attrs if not name.endswith(("_error", "_reason"))} - set(absent), set(opened.attrs) - {"conservation_error", "charge_error"})
        for name, value in opened.attrs.items():
            self.assertIs(type(value), type(data.attrs[name]), name)
            np.testing.assert_equal(value, data.attrs[name], name)

    def test_pulse(self):
        settings = {"friction.coefficient": 2, "friction.closure": "paper", "pulse.cells": 60, "output.every": 1}
        for change in (settings, {**settings, "friction.law": "coulomb", "friction.coefficient": 0.01}):
            data, opened = self.pair(slipfront.pulse, STEP, set=change)
            self.same(data, opened)
            self.attributes(data, opened, OF_COMPUTATION)
            self.assertEqual((opened.attrs["cells"], opened.attrs["closure"]), (60, "paper"))

    def test_chain(self):
        for case, change in ((STEP, {"chain.scale": 50}), (LOADED, SHORT)):
            data, opened = self.pair(slipfront.chain, case, set=change)
            self.same(data, opened)
            self.attributes(data, opened, OF_CHAIN)

    def test_compare(self):
        data, opened = self.pair(slipfront.compare, STEP, scales=[30])
        self.same(data, opened, absent={"closure", "window", "smooth_window", "wall_seconds", "difference", "quantity", "trend_exponent", "trend_extrapolated", "trend_difference"})
        self.assertTrue(opened.sel(name="chain-30").slip_at_origin.identical(data.sel(name="chain-30").slip_at_origin.drop_vars("quantity", errors="ignore")))

    def test_event(self):
        event = {"name": "a", "rupture_velocity": "3.0 +- 0.2 km/s", "slip_velocity": "0.5 m/s"}
        for options in ({}, {"draws": 7}):
            data, opened = self.pair(slipfront.event, [event, {"rupture_velocity": "9 km/s"}], **options)
            population = {name for name in opened.variables if str(name).startswith(("population_", "line_", "decade"))}
            self.assertTrue(population)
            self.same(data, opened, more=population)

    def test_sweep(self):
        axes = {"friction.coefficient": [-1.0, 0.5], "friction.closure": ["paper", "consistent"], "pulse.cells": [50, 60]}
        data, opened = self.pair(slipfront.sweep, STEP, axes)
        self.assertTrue(opened.identical(data))

    def test_an_unfinished_run_has_no_values_at_its_end(self):
        def stop(*_):
            raise InterruptedError

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "file.nc")
            with self.assertRaises(InterruptedError):
                slipfront.pulse(STEP, set={"pulse.cells": 4000}, output=path, progress=stop)
            opened = slipfront.open(path)
        self.assertEqual(opened.attrs["finished"], 0)
        self.assertNotIn("slip_at_origin", opened.attrs)


if __name__ == "__main__":
    unittest.main()
