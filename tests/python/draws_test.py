"""The groups of `slipfront event --draws N -o OUT.nc`: the layout that ArviZ opens, and what its values mean."""

import os
import unittest

import numpy as np
import xarray as xr

import slipfront
from support import CommandLine

EVENTS = """name,rupture_velocity,slip_velocity,contact_ratio,stress_drop
normal,2.7 +- 0.3 km/s,0.5 */ 1.3 m/s,0.01 +- 0.002,
static drop,2.5 */ 1.2 km/s,0.5 */ 1.3 m/s,,5 */ 1.5 MPa
nothing,,,,
exact,3 km/s,0.5 m/s,0.01,
too fast,9 km/s,,,
range,2.4..2.6 km/s,0.5 +0.3/-0.1 m/s,0.01 +- 0.002,
"""
WITH_DRAWS = [True, True, False, True, False, True]
GROUPS = {"posterior": ("chain", "draw", "event"), "prior": ("chain", "draw", "event"), "posterior_predictive": ("chain", "draw", "event"),
          "observed_data": ("event",), "sample_stats": ("event",)}
DRAWS = 2000


class Draws(CommandLine):
    def setUp(self):
        super().setUp()
        events = self.file("events.csv", EVENTS)
        self.path = os.path.join(os.path.dirname(events), "draws.nc")
        slipfront.event(events, draws=DRAWS, output=self.path)

    def group(self, name):
        return slipfront.open(self.path, group=name)

    def test_have_the_dimensions_and_coordinates_of_arviz(self):
        for name, dimensions in GROUPS.items():
            with xr.open_dataset(self.path, group=name) as data:
                self.assertTrue(data.data_vars, name)
                for variable in data.data_vars.values():
                    self.assertEqual(variable.dims, dimensions)
                    self.assertTrue(bool(variable.notnull().any()), variable.name)
                self.assertEqual(data.attrs["inference_library"], "slipfront")
                np.testing.assert_array_equal(data.event, range(6))
                self.assertEqual(list(data.event_name.values), [line.split(",")[0] for line in EVENTS.splitlines()[1:]])
                if "draw" in dimensions:
                    np.testing.assert_array_equal(data.draw, range(DRAWS))
                    np.testing.assert_array_equal(data.chain, [0])
        self.assertIn("resampled", self.group("posterior").attrs["comment"])
        with self.assertRaises(slipfront.FileError):
            self.group("none")

    def test_posterior_and_diagnostics_are_those_of_the_events(self):
        root, posterior, statistics = slipfront.open(self.path), self.group("posterior"), self.group("sample_stats")
        for name, values in posterior.data_vars.items():
            np.testing.assert_array_equal(values.isel(chain=0).transpose("event", "draw").values, root[f"draw_{name}"].values, name)
        np.testing.assert_array_equal(posterior.stress.notnull().all(["chain", "draw"]), WITH_DRAWS)
        for name in ("effective_samples", "pareto_k", "samples"):
            np.testing.assert_array_equal(statistics[name].values, root[name].values, name)

    def test_prior_is_uniform_in_the_logarithms(self):
        prior = self.group("prior").isel(event=0, chain=0)
        for values, low, high in [(np.log(prior.contact_ratio), np.log(1e-8), None), (np.log1p(prior.damping_number), 0, np.log1p(1e8)),
                                  (np.log(prior.characteristic_velocity), None, None)]:
            low = float(values.min()) if low is None else low
            high = float(values.max()) if high is None else high
            shares = (np.sort(values) - low) / (high - low)
            self.assertLess(np.abs(shares - (np.arange(DRAWS) + 0.5) / DRAWS).max(), 0.01)
        stress = slipfront.relations(rupture_velocity=prior.characteristic_velocity.values).stress
        np.testing.assert_allclose(prior.stress, stress, rtol=1e-9)

    def test_repeated_observations_have_the_error_of_the_observation(self):
        posterior, repeated, observed = (self.group(name).isel(event=0) for name in ("posterior", "posterior_predictive", "observed_data"))
        for name, values, spread in [("rupture_velocity", posterior.rupture_velocity_m_s, 300), ("contact_ratio", posterior.contact_ratio, 0.002)]:
            error = (repeated[name] - values).values / spread
            self.assertLess(abs(error.mean()), 4 / DRAWS**0.5, name)
            self.assertLess(abs(error.std() - 1), 4 / (2 * DRAWS)**0.5, name)
        self.assertEqual(float(observed.rupture_velocity), 2700)
        self.assertTrue(np.isnan(float(observed.stress_drop)) and bool(repeated.stress_drop.isnull().all()))
        ratio = slipfront.friction_ratio(posterior.stress.values, posterior.damping_number.values).ratio.values
        speed = float(slipfront.open(self.path).c_m_s[0])
        slip_velocity = speed * posterior.contact_ratio / np.pi * posterior.frictionless_slip_velocity * ratio
        error = np.log(repeated.slip_velocity / slip_velocity).values / np.log(1.3)
        self.assertLess(abs(error.std() - 1), 4 / (2 * DRAWS)**0.5)

    def test_exact_observations_repeat_themselves_and_ranges_keep_their_width(self):
        repeated, posterior = self.group("posterior_predictive"), self.group("posterior")
        exact = repeated.isel(event=3)
        np.testing.assert_allclose(exact.rupture_velocity, 3000, rtol=1e-12)
        np.testing.assert_allclose(exact.slip_velocity, 0.5, rtol=1e-9)
        spread = (repeated.rupture_velocity - posterior.rupture_velocity_m_s).isel(event=5)
        self.assertLess(float(np.abs(spread).max()), 100 + 1e-9)
        self.assertGreater(float(np.abs(spread).max()), 98)


if __name__ == "__main__":
    unittest.main()
