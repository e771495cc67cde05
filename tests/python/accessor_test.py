"""dataset.slipfront.si: units of the model become SI units, with the constants of the scenario or of the user."""

import os
import tempfile
import unittest

import numpy as np
import xarray

import slipfront
from slipfront import _units
from support import SOURCE

STEP = os.path.join(SOURCE, "cases/step.toml")
ROCK = {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s", "poisson_ratio": 0.3}
SPEED = float(slipfront.medium.speed_from_p_wave(6000, 0.3))
UNITS = slipfront.medium.units(30e9, SPEED, 0.01, 1e-3)
VALUES = {"mu": 30e9, "nu": 0.3, "A": 0.01, "b": 1e-3, "c": SPEED}
LOADED = os.path.join(SOURCE, "cases/stick-slip.toml")
SHORT = {"time.end": 100, "output.every": 50, "domain.left": -31.41592653589793, "domain.right": 31.41592653589793}


def si(data, **constants):
    return data.slipfront.si(**{"contact_ratio": 0.01, "spacing": "1 mm", "medium": ROCK, **constants})


class Conversion(unittest.TestCase):
    def test_agrees_with_the_units_of_medium(self):
        pulse = slipfront.pulse(STEP)
        metric = si(pulse)
        for name, key, unit in [("x", "length", "m"), ("x_bounds", "length", "m"), ("time", "time", "s"), ("W", "slip_velocity", "m s-1"), ("Sigma", "stress", "Pa"),
                                ("slip", "slip", "m"), ("U", "velocity", "m s-1")]:
            faces = 2 if name == "slip" else 1  # slip is between the faces
            np.testing.assert_allclose(metric[name], pulse[name] * UNITS[key] * faces, rtol=1e-14, err_msg=name)
            self.assertEqual(metric[name].units, unit)
            self.assertNotIn("dimensional_unit", metric[name].attrs)
        self.assertEqual(metric.W.attrs["long_name"], pulse.W.attrs["long_name"])
        self.assertEqual(metric.slip.attrs["long_name"], pulse.slip.attrs["long_name"] + ", between the faces")
        self.assertTrue(metric.identical(si(metric)))  # nothing is left to convert
        self.assertIn("A = 0.01", metric.attrs["comment"])
        np.testing.assert_array_equal(pulse.x, slipfront.pulse(STEP).x)  # the argument is as before

    def test_converts_what_each_command_returns(self):
        runs = [slipfront.pulse(STEP), slipfront.chain(LOADED, set=SHORT), slipfront.compare(STEP, scales=[50]), slipfront.relations(stress=[1.0]), slipfront.event(samples=0),
                slipfront.friction_ratio(1.0, 1.0), slipfront.train.averages(0.1, 1.0)]
        for data in runs:
            metric = si(data)
            for name, variable in data.variables.items():
                with self.subTest(name):
                    self.assertEqual(metric[name].dims, variable.dims)
                    self.assertFalse(metric[name].attrs.get("dimensional_unit"))
                    if variable.attrs.get("dimensional_unit"):
                        self.assertNotIn(metric[name].units, ("", "1"))
                    else:
                        np.testing.assert_array_equal(metric[name].values, variable.values)
        compared = si(runs[2])
        self.assertEqual(float(compared.sel(name="chain-50").scale), 50)

    def test_can_be_written_and_read(self):
        metric = si(slipfront.pulse(STEP))
        with tempfile.TemporaryDirectory() as folder:
            metric.to_netcdf(folder + "/si.nc")
            with xarray.open_dataset(folder + "/si.nc") as stored:
                xarray.testing.assert_equal(stored.load(), metric)

    def test_takes_constants_of_the_scenario(self):
        medium = {f"medium.{key}": value for key, value in {**ROCK, "contact_ratio": 0.01, "asperity_spacing": "1 mm"}.items()}
        pulse = slipfront.pulse(STEP, set=medium)
        np.testing.assert_array_equal(pulse.slipfront.si().Sigma, si(pulse).Sigma)
        np.testing.assert_allclose(pulse.slipfront.si(contact_ratio=0.02).Sigma, 2 * si(pulse).Sigma)  # an argument counts more
        np.testing.assert_allclose(pulse.slipfront.si(medium={"shear_modulus": 15e9}).Sigma, si(pulse).Sigma / 2)

    def test_derives_constants_from_others(self):
        pulse = slipfront.pulse(STEP)
        rock = {"s_wave_speed": "3 km/s", "p_wave_speed": 5400, "density": "2.7 g/cm^3"}
        np.testing.assert_allclose(si(pulse, medium=rock).Sigma / pulse.Sigma, 2700 * 3000**2 * 0.01 / np.pi)
        rock = {"shear_modulus": 30e9, "density": 2700, "poisson_ratio": 0.25}
        np.testing.assert_allclose(si(pulse, medium=rock).x.values, pulse.x * 0.1)
        np.testing.assert_allclose(si(pulse, medium=rock).time * slipfront.medium.speed_from_shear_modulus(30e9, 2700, 0.25), pulse.time * 0.1)

    def test_needs_only_the_constants_of_the_units(self):
        states = slipfront.relations(stress=[1.0])[["stress"]]
        metric = states.slipfront.si(contact_ratio=0.01, medium={"shear_modulus": "30 GPa"})
        np.testing.assert_allclose(metric.stress, UNITS["stress"])
        with self.assertRaises(slipfront.InputError) as caught:
            states.slipfront.si()
        self.assertIn("missing constants: contact_ratio, shear_modulus;", str(caught.exception))

    def test_names_constants_that_are_missing_or_wrong(self):
        pulse = slipfront.pulse(STEP)
        for says, change in [("missing constants: spacing", {"spacing": None}), ("missing constants: shear_modulus, poisson_ratio, p_wave_speed", {"medium": None}),
                             ("p_wave_speed", {"medium": {"shear_modulus": 1, "poisson_ratio": 0}}), ("'modulus': unknown", {"medium": {"modulus": 1}}),
                             ("not a dict", {"medium": 3}), ("unknown unit", {"spacing": "1 parsnip"}), ("is not that of a", {"spacing": "1 s"}),
                             ("not a finite number", {"spacing": "wide"}), ("at most 1", {"contact_ratio": 1.5}), ("positive", {"spacing": -1}),
                             ("not one number", {"spacing": [1, 2]}), ("below 0.5", {"medium": {**ROCK, "poisson_ratio": 0.5}})]:
            with self.subTest(says), self.assertRaises(slipfront.InputError) as caught:
                si(pulse, **change)
            self.assertIn(says.replace("not a dict", "allowed: a dict"), str(caught.exception))


class Units(unittest.TestCase):
    def test_evaluates_products_and_powers(self):
        for text, value, name in [("b / A", 0.1, "m"), ("A / b", 10, "m-1"), ("b / (c A)", UNITS["time"], "s"), ("mu A / pi", UNITS["stress"], "Pa"),
                                  ("(mu A / pi)^2", UNITS["stress"] ** 2, "Pa2"), ("pi / (mu A)", 1 / UNITS["stress"], "Pa-1"), ("c", SPEED, "m s-1"),
                                  ("mu A^2 / (pi (1 - nu))", float(slipfront.medium.traction_unit(30e9, 0.3, 0.01)), "Pa"),
                                  ("mu b^2 A / (2 pi^2 (1 - nu))", 2 * 30e9 * 1e-6 * 0.01 / (2 * np.pi**2 * 0.7), "J m-1"), ("b^2 / (2 pi A)", 1e-4 / np.pi, "m2"), ("b / (2 pi)", 1e-3 / np.pi, "m")]:
            found, unit, between_faces = _units.in_si(text, VALUES)
            self.assertAlmostEqual(found / value, 1, places=13, msg=text)
            self.assertEqual((unit, between_faces), (name, text in ("b / (2 pi)", "b^2 / (2 pi A)")))

    def test_rejects_other_texts(self):
        for text in ("__import__('os')", "mu.real", "A^A", "A^99", "mu + b", "km", "mu(A)(", "", "'A'", "A if b else c", "True", "(mu + b)", "(" * 50 + "A", "A^", "1e9", "9999999999 A"):
            with self.subTest(text), self.assertRaises(slipfront.InputError):
                _units.in_si(text, VALUES)

    def test_reads_units_with_prefixes(self):
        for text, key, value in [("30 GPa", "shear_modulus", 30e9), ("300 kbar", "shear_modulus", 3e10), ("1 foot", "asperity_spacing", 0.3048), ("3-4 m", "asperity_spacing", None), ("6km/s", "p_wave_speed", 6000), ("6 km s-1", "p_wave_speed", 6000),
                                 ("10 km/day", "p_wave_speed", 10000 / 86400), ("2.7 g/cm^3", "density", 2700), ("2700 kg m-3", "density", 2700), ("20 um", "asperity_spacing", 2e-5),
                                 ("1e-3 m", "asperity_spacing", 1e-3), ("0.01", "contact_ratio", 0.01)]:
            if value is None:
                self.assertRaises(slipfront.InputError, _units.constant, key, text)
            else:
                self.assertAlmostEqual(_units.constant(key, text) / value, 1, places=13, msg=text)


if __name__ == "__main__":
    unittest.main()
