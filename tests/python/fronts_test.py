"""slipfront.fronts: paths of synthetic and of exact fronts, recorded arrivals, the case of precursors, the command and its figure."""

import json
import math
import os
import tempfile
import tomllib
import unittest

import numpy as np
from commands import PythonCommands, run_here
import slipfront
from slipfront import _front_paths
from support import SOURCE, run

STEP = os.path.join(SOURCE, "cases/step.toml")
CASE = os.path.join(SOURCE, "cases/precursors.toml")
X = np.linspace(0.05, 9.95, 100)


class Synthetic(unittest.TestCase):
    def fronts(self, times, tolerance=0.2):
        found = _front_paths.fronts_of(times, tolerance)
        return found, [_front_paths.velocities(X, times, *pair)[1] for pair in found]

    def test_a_constant_velocity(self):
        for noise, error in ((0, 1e-12), (0.02, 0.1)):
            times = 3 + X / 0.4 + noise * np.random.default_rng(1).standard_normal(X.size)
            found, (velocity,) = self.fronts(times)
            self.assertEqual(found, [(0, 99)])
            np.testing.assert_allclose(velocity[3:-3], 0.4, rtol=error)

    def test_a_bad_arrival_has_no_effect(self):
        times = X / 0.4
        times[50] += 0.15
        _, (velocity,) = self.fronts(times)
        np.testing.assert_allclose(velocity, 0.4, rtol=0.04)

    def test_a_front_that_slows_down_and_stops(self):
        """V = 0.8 (1 - x / 6): the front needs an infinite time to reach 6, and the record ends at 5."""
        times = np.where(X < 5, -np.log(1 - np.minimum(X, 5) / 6) * 6 / 0.8, math.nan)
        found, (velocity,) = self.fronts(times)
        self.assertEqual(found, [(0, 49)])
        exact = 0.8 * (1 - X[:50] / 6)
        np.testing.assert_allclose(velocity[3:-3], exact[3:-3], rtol=0.01)
        np.testing.assert_allclose(velocity, exact, rtol=0.15)  # windows at the ends are one-sided

    def test_fronts_in_both_directions_and_one_that_comes_to_meet_them(self):
        times = np.minimum(np.abs(X - 3) / 0.5, 5 + np.abs(X - 8) / 0.25)
        times[-2:] = math.nan
        found, velocity = self.fronts(times)
        starts = sorted({begin for begin, _ in found})
        np.testing.assert_allclose(X[starts], [3, 8], atol=0.1)
        self.assertEqual(len(found), 4)
        self.assertEqual({found[i] for i in range(4) if math.isclose(np.median(velocity[i]), 0.5, rel_tol=0.02)}, {pair for pair in found if pair[0] == starts[0]})
        self.assertEqual({found[i] for i in range(4) if math.isclose(np.median(velocity[i]), 0.25, rel_tol=0.02)}, {pair for pair in found if pair[0] == starts[1]})

    def test_slip_that_begins_at_once_over_a_stretch_has_a_front_at_each_end(self):
        times = np.maximum(np.abs(X - 4), 1) / 0.5
        found, _ = self.fronts(times)
        self.assertEqual(found, [(30, 0), (49, 99)])
        mirrored, _ = self.fronts(times[::-1])
        self.assertEqual(sorted((99 - begin, 99 - end) for begin, end in mirrored), sorted(found))

    def test_slip_everywhere_at_once_and_at_single_positions(self):
        found, (velocity,) = self.fronts(np.full(100, 2.0))
        self.assertTrue(np.isinf(velocity).all())
        times = np.full(100, math.nan)
        times[[10, 20, 21]] = 1.0, 2.0, 3.0
        self.assertEqual(_front_paths.fronts_of(times, 0.2), [(10, 10), (20, 21)])
        self.assertTrue(np.isnan(_front_paths.velocities(X, times, 20, 21)[1]).all())
        self.assertEqual(_front_paths.fronts_of(np.full(100, math.nan), 0.2), [])

    def test_rayleigh_waves(self):
        """Known values of c_R / c_s: 0.9194 for nu = 1/4 (its square is 2 - 2 / sqrt(3)), 0.8741 for nu = 0, 0.9553 for nu = 1/2."""
        for nu, ratio in ((0.25, math.sqrt(2 - 2 / math.sqrt(3))), (0, 0.874032), (0.4999999, 0.955313)):
            self.assertAlmostEqual(_front_paths.rayleigh_speed(nu) / math.sqrt((1 - nu) / 2), ratio, 5)


class Exact(unittest.TestCase):
    def test_both_fronts_of_a_step_without_friction(self):
        """The pulse is a function of x / t, so a threshold moves at a constant velocity, which the closed form gives."""
        pulse = slipfront.pulse(STEP, set={"output.every": 0.1, "pulse.cells": 800}, errors=False)
        stress = float(pulse["Sigma"][0].max())
        ray = np.linspace(-1, 1, 40001)
        W = slipfront.train.profile(stress, ray).W.values
        for threshold in (1e-3, 0.1):
            moving = ray[W > threshold * W.max()]
            found = slipfront.fronts(pulse, threshold=threshold)
            ends = found.front_end.values
            # The slip velocity jumps at the leading edge, so that this front is read to a cell only. Few cells per output once made it 5 % fast.
            for side, exact, error in ((ends < 0, -moving[0], 0.005), (ends > 0, moving[-1], 0.006)):
                self.assertEqual(side.sum(), 1)
                self.assertAlmostEqual(float(found.front_velocity[side][0]) / exact, 1, delta=error)
            np.testing.assert_allclose(found.front_stress.values[ends < 0], stress, rtol=1e-9)

    def test_fronts_that_cross_few_cells_per_output_have_the_stated_error(self):
        exact = float(slipfront.relations(stress=0.855).leading_velocity)
        pulse = slipfront.pulse(STEP, set={"output.every": 0.05, "pulse.cells": 400}, errors=False)
        for every in (1, 2, 3, 4, 5, 8):  # 0.6 to 4.8 cells per output
            found = slipfront.fronts(pulse.isel(time=slice(0, None, every)))
            slow = int(np.argmax(found.front_end.values))
            velocity, error = float(found.front_velocity[slow]), float(found.front_velocity_error[slow])
            self.assertLess(abs(velocity - exact), error)
            self.assertLess(error, 0.06 * exact)

    def test_a_chain_of_dislocations_has_the_same_fast_front(self):
        chain = slipfront.chain(STEP, set={"output.every": 0.2, "chain.scale": 200, "pulse.cells": 100})
        pulse = slipfront.pulse(STEP, set={"output.every": 0.2, "pulse.cells": 400}, errors=False)
        fast = []
        for level in (chain, pulse):
            found = slipfront.fronts(level, threshold=0.1)
            fast.append(float(found.front_velocity[int(np.argmin(found.front_end.values))]))
        self.assertAlmostEqual(fast[0] / fast[1], 1, delta=0.03)


class Recorded(PythonCommands):
    """Arrivals that a loaded chain records."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file_of_block = os.path.join(cls.folder.name, "block.nc")
        slipfront.chain(CASE, output=cls.file_of_block)
        cls.block = slipfront.open(cls.file_of_block, si=False)
        cls.found = slipfront.fronts(cls.block)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_precursors_grow_until_a_front_crosses_the_block(self):
        found = self.found
        crosses = found.event_crosses.values > 0
        first = int(np.argmax(crosses))
        self.assertTrue(crosses.any())
        self.assertGreaterEqual(first, 10)
        load, length = found.event_load.values[:first], found.event_length.values[:first]
        # Later lengths depend on rounding, and thereby on the machine. Ten runs with other roundings and steps have correlations
        # of 0.48 to 0.77, and longest precursors of 6.6 to 7.4. Without a relation 25 events exceed 0.34 once in twenty runs.
        self.assertTrue((np.diff(length[:5]) > 0).all())
        self.assertGreater(length.max(), 3 * length[0])
        self.assertGreater(np.corrcoef(load, length)[0, 1], 0.34)
        for row in range(first):
            fronts = found.front_event.values == found.event_number.values[row]
            self.assertIn("stops", found.front_stop.values[fronts])

    def test_recorded_arrivals_are_those_of_dense_outputs(self):
        """The second route is the slip between outputs. The steps of a run do not depend on its outputs, so the events are equal to the bit."""
        event, count = 5, self.block.sizes["position"]
        onset, duration = (float(self.block[name][event]) for name in ("event_onset", "event_duration"))
        times = np.linspace(onset - duration / 2, onset + duration, 400)
        with open(CASE, encoding="utf-8") as file:
            scenario = tomllib.loads(file.read())
        speed = float(slipfront.medium.speed_from_shear_modulus(3e9, 1180, 0.33))
        seconds = [f"{time * 0.01 / (speed * 0.5)!r} s" for time in times.tolist()]
        scenario["output"] = {"times": seconds, "fronts": count}
        dense = slipfront.chain(scenario, set={"time.end": seconds[-1], "pulse.cells": count}, si=False)
        self.assertEqual(float(dense["event_onset"][event]), onset)
        level = 1e-3 / float(slipfront.medium.slip_velocity_unit(speed, 0.5))
        rates = np.diff(dense["slip"].sel(time=times, method="nearest").values, axis=0) / np.diff(times)[:, None]
        seen = _front_paths.arrivals((times[1:] + times[:-1]) / 2, rates, level)
        recorded = dense["event_arrival"].values[event]
        both = np.isfinite(recorded) & np.isfinite(seen) & (recorded > times[1])
        both &= dense["position"].values > 7.5 / 32  # nearer to the edge the mean of the slip is that further inside
        self.assertGreater(both.sum(), 5)
        # Slip in the file is a mean over a sixteenth of the block. A front needs this time to cross half of it.
        velocity = np.nanmax(self.found.velocity.values[self.found.front_event.values == event + 1], axis=0)
        self.assertTrue((np.abs(seen - recorded) < 7.5 / 32 / velocity + 2 * (times[1] - times[0]))[both].all())

    def test_every_front_has_a_class_and_a_ratio(self):
        found, c = self.found, float(self.found.attrs["c_m_s"])
        self.assertAlmostEqual(c, float(slipfront.medium.speed_from_shear_modulus(3e9, 1180, 0.33)))
        self.assertEqual(found.attrs["tau"], "traction")
        later = found.front_event.values > found.event_number.values[np.argmax(found.event_crosses.values)]
        ratio = found.front_stress_ratio.values[later]
        self.assertTrue(((ratio > 0) & (ratio < 0.7)).all())  # at most the strength, 0.4 + 0.015 ln(theta / theta_0)
        for kind, velocity in zip(found.front_kind.values, found.front_velocity.values):
            bounds = {"slow": (0, 0.1), "sub-Rayleigh": (0.1, 1), "above Rayleigh": (1, 1 / found.rayleigh_speed), "faster than c": (1 / found.rayleigh_speed, math.inf)}
            if kind == "too short":
                self.assertTrue(math.isnan(velocity))
            else:
                low, high = bounds[kind]
                self.assertTrue(low <= velocity / found.rayleigh_speed <= high)

    def test_the_command_prints_and_writes_the_fronts(self):
        with tempfile.TemporaryDirectory() as folder:
            block, out, table = self.file_of_block, os.path.join(folder, "fronts.nc"), os.path.join(folder, "fronts.csv")
            text = run("fronts", block, "-o", out).stdout  # starts the program
            self.assertNotIn("m/s", self.ok("fronts", block, "--dimensionless").splitlines()[1])
            self.assertIn("cross the whole block", text)
            fronts = json.loads(self.ok("fronts", block, "--json"))["fronts"]
            self.assertEqual(len(fronts), self.found.sizes["front"])
            written = slipfront.open(out)
            np.testing.assert_array_equal(written.arrival.values, self.found.slipfront.si().arrival.values)
            self.assertEqual(written.front_kind.values.tolist(), self.found.front_kind.values.tolist())
            with open(table, "w", encoding="utf-8") as file:
                file.write(self.ok("fronts", block, "--csv"))
            done = run_here("laboratory", table, "--poisson-ratio", "0.33", "--shear-modulus", "3 GPa", "--density", "1180 kg/m3")
            self.assertIn("hardness over modulus", done.stdout)
            self.assertEqual(written.front_velocity.units, "m s-1")
            self.ok("plot", out, "-o", os.path.join(folder, "fronts.png"))
            self.refused(2, "plot", out, "--event", "10000", "-o", os.path.join(folder, "no.png"), says=["event 10000"])
            self.refused(2, "fronts", block, "--threshold", "0.1", says=["threshold"])

    def test_a_run_in_si_units_has_the_same_fronts(self):
        block = slipfront.open(self.file_of_block)
        found, metric = slipfront.fronts(block, si=False), slipfront.fronts(block)
        np.testing.assert_allclose(found.front_velocity, self.found.front_velocity, rtol=1e-9)
        np.testing.assert_allclose(found.arrival, self.found.arrival, rtol=1e-12)
        self.assertEqual(found.front_onset.dimensional_unit, "b / (c A)")
        self.assertEqual((metric.front_onset.units, metric.arrival.units), ("s", "s"))
        np.testing.assert_array_equal(metric.arrival, found.slipfront.si().arrival)

    def test_refuses_runs_without_arrivals(self):
        loaded = slipfront.chain(CASE, set={"time.end": "0.1 s", "output.fronts": 10})
        with self.assertRaisesRegex(slipfront.InputError, "output.fronts"):
            slipfront.fronts(loaded)
        pulse = slipfront.pulse(STEP, errors=False)
        rock = {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s", "poisson_ratio": 0.3}
        with self.assertRaisesRegex(slipfront.InputError, "missing constants"):  # its scenario does not give them
            slipfront.fronts(pulse.slipfront.si(contact_ratio=0.01, spacing=1e-3, medium=rock))
        with self.assertRaisesRegex(slipfront.InputError, "threshold = '2'"):
            slipfront.fronts(pulse, threshold=2)
        self.refused(2, "chain", CASE, "--set", "output.fronts=1000", says=["output.fronts", "<= 100"])
        self.refused(2, "chain", STEP, "--set", "output.fronts=10", says=["output.fronts", "[loading]"])


if __name__ == "__main__":
    unittest.main()
