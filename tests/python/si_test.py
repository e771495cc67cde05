"""Results in SI units: numbers, files, Datasets and pictures, against the dimensionless run times scales that are computed here."""

import json
import math
import os
import tempfile
import unittest

import netCDF4
import numpy as np
import xarray

from commands import PythonCommands
import slipfront
from slipfront import plots
from slipfront.plots.style import prefixed
from support import SOURCE

STEP = os.path.join(SOURCE, "cases/step-viscous.toml")
SHORT = ["--set", "pulse.cells=100", "output.every=2"]
ROCK = ["medium.shear_modulus='30 GPa'", "medium.density='2700 kg/m3'", "medium.poisson_ratio=0.25", "medium.contact_ratio=0.01", "medium.asperity_spacing='2 mm'"]

#: A short piece of the block of docs/loading.md, which sticks and slips as a whole.
BLOCK = """
title = "Block of PMMA"
[initial]
stress_left = 0
stress_right = 0
[interface]
contact = 0
[friction]
law = "rate-and-state"
normal_stress = "5 MPa"
strength = 0.4
direct_effect = 0.005
evolution_effect = 0.009
characteristic_slip = "0.5 um"
reference_velocity = "1 um/s"
[loading]
stiffness = "0.02 MPa/um"
velocity = "1 um/s"
[domain]
left = "-1 cm"
right = "1 cm"
[time]
end = "200 s"
[output]
every = "2 s"
[pulse]
cells = 8
[chain]
left = "free"
right = "free"
[medium]
shear_modulus = "3 GPa"
density = "1180 kg/m3"
poisson_ratio = 0.33
contact_ratio = 0.0041
asperity_spacing = "20 um"
"""


def scales(mu, rho, nu, A, b):
    """The SI values of the units, in the words of docs/theory/1_chain.md and by no code of slipfront."""
    c = math.sqrt(2 * mu / (rho * (1 - nu)))
    force = mu * A**2 / (math.pi * (1 - nu))
    length, time, slip = b / A, b / (c * A), b / math.pi  # slip between the faces
    return {"m": length, "s": time, "slip": slip, "stress": mu * A / math.pi, "velocity": c * A / math.pi, "force": force, "c": c,
            "energy": force * slip * length, "H": force * slip, "potency": slip * length, "k": 1 / length}


ROCK_SCALES, PMMA = scales(30e9, 2700, 0.25, 0.01, 2e-3), scales(3e9, 1180, 0.33, 0.0041, 20e-6)

#: The scale of each key of JSON and of each variable that has a dimension.
SCALE_OF = {
    "time": "s", "x": "m", "x_bounds": "m", "slip": "slip", "W": "velocity", "Sigma": "stress", "stress_drop": "stress", "k": "k", "U": "c", "H": "H", "potency": "potency",
    "slip_at_origin": "slip", "slip_velocity_at_origin": "velocity", "stress_at_origin": "stress", "peak_slip_velocity": "velocity", "peak_position": "m",
    "trailing_front": "m", "leading_front": "m", "trailing_characteristic": "m", "trailing_front_observed": "m", "leading_front_observed": "m",
    "first_crossing_time": "s", "first_crossing_position": "m", "window": "m", "smooth_window": "m", "loading_force": "force", "loading_stress": "stress",
    "event_recurrence_time": "s", "event_median_stress_drop": "force", "event_median_peak_velocity": "velocity",
    **{f"energy_{kind}": "energy" for kind in ("elastic", "kinetic", "dissipated", "supplied", "through_ends", "shocks", "residual", "phonons", "loading", "contacts")},
    **{f"event_{name}": unit for name, unit in {"onset": "s", "duration": "s", "slip": "slip", "largest_slip": "slip", "load": "force", "stress_drop": "force", "peak_velocity": "velocity",
                                                "origin": "m", "length": "m", "rupture_velocity": "c"}.items()},
}
CLOCKS = {"wall_seconds", "solve_seconds", "site_updates_per_second"}


def written(folder, text=BLOCK, name="block.toml"):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


class Results(PythonCommands):
    """Numbers that the program prints and writes."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.block = written(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def compare_keys(self, plain, si, scale, prefix=""):
        for key, value in plain.items():
            factor = scale[SCALE_OF[prefix + key]] if prefix + key in SCALE_OF else 1
            if key in CLOCKS or isinstance(value, (dict, list, str)) or value is None:
                continue
            self.assertAlmostEqual(si[key], value * factor, delta=1e-13 * abs(value * factor), msg=key)

    def test_a_pulse_is_the_dimensionless_one_times_the_scales(self):
        plain, si = (self.pulse(STEP, *SHORT, *ROCK, *options) for options in ((), ("--si",)))
        self.compare_keys(plain, si, ROCK_SCALES)
        for key, error in plain["errors"].items():
            in_si = error * ROCK_SCALES.get(SCALE_OF.get(key), 1)
            self.assertAlmostEqual(si["errors"][key], in_si, delta=2e-2 * in_si, msg=key)  # both have three digits
        self.assertEqual((si["unit_system"], si["units"]["time"], si["units"]["stress_at_origin"], si["units"]["slip_velocity_at_origin"]), ("SI", "s", "Pa", "m s-1"))
        self.assertNotIn("friction_coefficient", si["units"])
        self.assertLessEqual(set(si["units"]), set(SCALE_OF))
        self.assertNotIn("units", plain)
        self.assertRegex(self.ok("pulse", STEP, *SHORT, *ROCK, "--si", "--wide"), r"slip_at_origin .* slip at x = 0 since time 0, between the faces, in m\n")

    def test_the_medium_alone_changes_nothing(self):
        runs = [self.pulse(STEP, *SHORT, *medium) for medium in ([], ROCK)]
        for run in runs:
            for clock in ("wall_seconds", "solve_seconds"):
                del run[clock]
        self.assertEqual(*runs)

    def test_who_writes_si_reads_si(self):
        si, plain = self.chain(self.block), self.chain(self.block, "--dimensionless")
        self.assertEqual(si["unit_system"], "SI")
        self.assertAlmostEqual(si["time"], 200, places=9)
        self.compare_keys(plain, si, PMMA)
        self.assertGreaterEqual(len(si["events"]), 3)
        for of_model, event in zip(plain["events"], si["events"], strict=True):
            self.compare_keys(of_model, event, PMMA, "event_")
        self.assertEqual(si["units"]["events"]["stress_drop"], "Pa")
        event = si["events"][0]  # the springs of 0.02 MPa/um shorten by the slip, less the advance of their far ends
        self.assertAlmostEqual(event["stress_drop"] / 0.02e12, event["slip"] - 1e-6 * event["duration"], delta=1e-5 * event["slip"])
        text = self.ok("chain", self.block, "--wide")
        self.assertRegex(text, r"\n *s +s +m +m +Pa +Pa +m s-1 +m +m +m s-1 +1 +1\n")
        check = self.ok("pulse", STEP, "--check", "--wide", "--set", *ROCK, "domain.left='-50 m'", "domain.right='2e4 mm'", "initial.stress_left='80 MPa'")
        self.assertIn("x = -50 m ... 20 m to t = ", check)

    def test_the_stress_drop_at_a_pulled_end_is_a_stress(self):
        end = ["--set", "chain.model=lattice", "loading.where=left", "loading.stiffness='2 MPa/um'", "loading.event_velocity='1e-9 um/s'"]
        si, plain = self.chain(self.block, *end), self.chain(self.block, *end, "--dimensionless")
        self.assertGreater(len(si["events"]), 0)
        for of_model, event in zip(plain["events"], si["events"], strict=True):
            self.assertAlmostEqual(event["stress_drop"], of_model["stress_drop"] * PMMA["stress"], delta=1e-12 * abs(event["stress_drop"]))

    def test_missing_constants_are_named(self):
        self.refused(2, "pulse", STEP, "--si", says=["step-viscous.toml: results in SI units need medium.contact_ratio and medium.asperity_spacing; allowed: "])
        self.refused(2, "chain", STEP, "--si", "--set", "medium.contact_ratio=0.01", says=["need medium.asperity_spacing; allowed: medium.asperity_spacing, or results"])
        self.refused(2, "pulse", STEP, "--si", "--dimensionless", says=["--si", "--dimensionless"])
        rock = json.loads(self.ok("pulse", STEP, *SHORT, "medium.contact_ratio=0.01", "medium.asperity_spacing='1 mm'", "--si", "--json"))
        self.assertTrue(any("p_wave_speed 6000 m/s" in warning for warning in rock["warnings"]), rock["warnings"])
        without = json.loads(self.ok("pulse", STEP, "--set", "pulse.cells=100", "medium.contact_ratio=0.01", "medium.shear_modulus='30 GPa'", "medium.p_wave_speed='6 km/s'",
                                     "medium.poisson_ratio=0.25", "initial.stress_left='60 MPa'", "--json"))
        self.assertNotIn("units", without)
        self.assertIn("the results are in the units of the model: results in SI units need medium.asperity_spacing", without["warnings"])

    def test_a_comparison_is_in_si_units(self):
        arguments = ("compare", STEP, *SHORT, *ROCK, "--scale", "20", "--json")
        plain, si = (json.loads(self.ok(*arguments, *options)) for options in ((), ("--si", "-o", self.path("compare.nc"))))
        self.assertAlmostEqual(si["time"], plain["time"] * ROCK_SCALES["s"])
        for of_model, level in zip(plain["levels"], si["levels"], strict=True):
            self.compare_keys(of_model, level, ROCK_SCALES)
            for key, value in of_model["difference"].items():
                scale = ROCK_SCALES[SCALE_OF[key]]
                self.assertAlmostEqual(level["difference"][key], value * scale, delta=1e-12 * scale)
        stored = slipfront.open(self.path("compare.nc"))
        self.assertEqual((stored.slip.units, stored.scale.units), ("m", "1"))
        self.assertRegex(self.ok(*arguments[:-1], "--si"), r"\n +m +m s-1 +m s-1 +m +m +m\n")

    def test_a_file_holds_the_numbers_of_the_model_and_their_si_units(self):
        si, plain = self.path("si.nc"), self.path("plain.nc")
        self.ok("chain", self.block, "-o", si)
        self.ok("chain", self.block, "-o", plain, "--dimensionless")
        with netCDF4.Dataset(si) as in_si, netCDF4.Dataset(plain) as in_model:
            self.assertEqual(in_si.unit_system, "SI")
            self.assertEqual(set(in_si.variables), set(in_model.variables))
            for name, variable in in_model.variables.items():
                other = in_si[name]
                if name in SCALE_OF:
                    self.assertAlmostEqual(other.scale_factor / PMMA[SCALE_OF[name]], 1, places=13, msg=name)
                    np.testing.assert_allclose(other[:], variable[:] * PMMA[SCALE_OF[name]], rtol=1e-13, err_msg=name)
                    self.assertNotIn(other.units, ("", "1"))
                    self.assertNotIn("dimensional_unit", other.ncattrs())
                other.set_auto_maskandscale(False)
                variable.set_auto_maskandscale(False)
                np.testing.assert_array_equal(other[:], variable[:], err_msg=name)
            self.assertEqual({name for name in in_si.variables if in_si[name].units != "1"} - set(SCALE_OF), set())
        with xarray.open_dataset(si) as data:  # without the help of slipfront
            self.assertAlmostEqual(float(data.time[-1]), 200, places=9)
            self.assertEqual((data.x.units, data.time.units, data.W.units, data.loading_force.units, data.slip.long_name),
                             ("m", "s", "m s-1", "Pa", "slip since time 0, between the faces"))

    def test_a_file_in_si_units_continues_to_the_same_bytes(self):
        whole, cut = self.path("whole.nc"), self.path("cut.nc")
        self.ok("chain", self.block, "-o", whole)
        self.ok("chain", self.block, "--set", "time.end='130 s'", "-o", cut)
        self.ok("chain", self.block, "--resume", cut)
        with open(whole, "rb") as one, open(cut, "rb") as other:
            self.assertEqual(one.read(), other.read())


class Datasets(unittest.TestCase):
    """Datasets that Python returns."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_a_run_is_what_its_file_holds(self):
        path = os.path.join(self.folder, "block.nc")
        run = slipfront.chain(BLOCK, output=path)
        stored = slipfront.open(path)
        self.assertEqual(run.attrs["unit_system"], "SI")
        self.assertAlmostEqual(run.attrs["time"], 200, places=9)
        xarray.testing.assert_equal(stored, run)
        for name in run.variables:
            self.assertEqual(stored[name].attrs, run[name].attrs, name)
        self.assertEqual({key: stored.attrs[key] for key in ("time", "peak_slip_velocity", "medium")}, {key: run.attrs[key] for key in ("time", "peak_slip_velocity", "medium")})
        self.assertTrue(run.identical(run.slipfront.si()))  # nothing is left to convert
        xarray.testing.assert_equal(slipfront.open(path, si=True), run)

    def test_a_file_is_read_in_either_system(self):
        si, plain = (os.path.join(self.folder, name) for name in ("si.nc", "plain.nc"))
        run = slipfront.chain(BLOCK, output=si)
        of_model = slipfront.chain(BLOCK, output=plain, si=False)
        self.assertNotIn("unit_system", of_model.attrs)
        back = slipfront.open(si, si=False)
        xarray.testing.assert_equal(back, of_model)
        self.assertEqual(back.slip.attrs, of_model.slip.attrs)
        self.assertEqual(back.attrs["time"], of_model.attrs["time"])
        metric = slipfront.open(plain, si=True)
        for name in run.variables:
            np.testing.assert_allclose(metric[name], run[name], rtol=1e-13, err_msg=name)
            self.assertEqual(metric[name].units, run[name].units, name)
            self.assertEqual(metric[name].long_name, run[name].long_name, name)

    def test_a_pulse_and_a_comparison_have_si_units(self):
        medium = dict(setting.split("=") for setting in ROCK)
        medium = {key: value.strip("'") for key, value in medium.items()}
        settings = {**medium, "pulse.cells": 50}
        plain, si = (slipfront.pulse(STEP, set=settings, si=chosen) for chosen in (None, True))
        self.assertNotIn("unit_system", plain.attrs)
        for name in plain.variables:
            np.testing.assert_allclose(si[name], plain[name] * ROCK_SCALES[SCALE_OF[name]] if name in SCALE_OF else plain[name], rtol=1e-13, err_msg=name)
        self.assertEqual(si.attrs["damping_number"], plain.attrs["damping_number"])
        self.assertAlmostEqual(si.attrs["slip_at_origin_error"] / plain.attrs["slip_at_origin_error"] / ROCK_SCALES["slip"], 1)
        levels = slipfront.compare(STEP, scales=[20], set=settings, si=True)
        self.assertAlmostEqual(levels.attrs["time"], si.attrs["time"])
        last = levels.sel(name="pulse-consistent").slip_at_origin[-1]
        self.assertAlmostEqual(float(last), si.attrs["slip_at_origin"])
        self.assertEqual(levels.window.units, "m")

    def test_a_sweep_follows_its_scenario(self):
        data = slipfront.sweep(BLOCK, {"loading.velocity": ["1 um/s", "2 um/s"]}, command="chain", set={"time.end": "10 s"})
        run = slipfront.chain(BLOCK, set={"time.end": "10 s", "loading.velocity": "2 um/s"})
        self.assertEqual(data.attrs["unit_system"], "SI")
        self.assertEqual((data.loading_force.units, data.slip_at_origin.units), ("Pa", "m"))
        self.assertEqual(float(data.loading_force[1]), float(run.loading_force[-1]))
        self.assertEqual(data.event_median_stress_drop.units, "Pa")
        plain = slipfront.sweep(BLOCK, {"loading.velocity": ["1 um/s"]}, command="chain", set={"time.end": "10 s"}, si=False)
        self.assertAlmostEqual(float(data.loading_force[0]), float(plain.loading_force[0]) * PMMA["force"])
        self.assertNotIn("unit_system", plain.attrs)
        self.assertEqual(plain.event_median_stress_drop.dimensional_unit, "mu A^2 / (pi (1 - nu))")
        short = {"time.end": "1 s", "output.every": "1 s"}
        for axis, settings, unit in (({"loading.where": ["left"]}, {}, "mu A / pi"), ({"loading.where": ["left", "everywhere"]}, {}, ""), ({"pulse.cells": [8]}, {"loading.where": "right"}, "mu A / pi")):
            of_model = slipfront.sweep(BLOCK, axis, command="chain", set={**short, **settings}, si=False)
            self.assertEqual(of_model.event_median_stress_drop.dimensional_unit, unit)


class Pictures(unittest.TestCase):
    """Axes in SI units with prefixes."""

    @classmethod
    def setUpClass(cls):
        cls.run_of_block = slipfront.chain(BLOCK)

    def test_a_unit_has_a_prefix_of_its_size(self):
        for name, largest, factor, shown in [("m", 0.1, 1e-3, "mm"), ("m", 1, 1, "m"), ("m", 5e4, 1e3, "km"), ("m s⁻¹", 2.5e-6, 1e-6, "μm s⁻¹"), ("Pa", 2.1e6, 1e6, "MPa"),
                                             ("s", 0.02, 1e-3, "ms"), ("s", 300, 1, "s"), ("s", 7199, 1, "s"), ("s", 7200, 3600, "h"), ("s", 4e5, 86400, "days"),
                                             ("s", 1e9, 31557600, "years"), ("m⁻¹", 1e-5, 1, "m⁻¹"), ("m", 0, 1, "m"), ("1", 1e-5, 1, "1")]:
            self.assertEqual(prefixed(name, largest), (factor, shown), (name, largest))

    def test_a_loaded_run(self):
        figure = plots.loading(self.run_of_block)
        top, bottom = figure.axes[:2]
        self.assertEqual((top.get_ylabel(), bottom.get_xlabel(), bottom.get_ylabel()), ("force F, MPa", "time t, s", "position x, mm"))
        self.assertEqual([text.get_text() for text in bottom.get_yticklabels()][::2], [f"{tick * 1e3:.4g}".replace("-", "−") for tick in bottom.get_yticks()][::2])
        self.assertEqual(figure.axes[2].get_ylabel(), "mean slip velocity |W|, m s⁻¹")  # a logarithmic scale
        self.assertEqual(plots.slip_event(self.run_of_block).axes[1].get_xlabel(), "slip u, μm")
        axes = plots.catalogue(self.run_of_block.isel(event=[0, 2])).axes  # the other event is tiny, which makes the axes logarithmic
        self.assertEqual((axes[0].get_xlabel(), axes[0].get_ylabel(), axes[1].get_ylabel()), ("length, mm", "mean slip u, μm", "stress drop, kPa"))
        self.assertEqual(plots.profiles(self.run_of_block).axes[0].get_legend().get_title().get_text(), "t, s")

    def test_long_times_have_round_ticks(self):
        slow = self.run_of_block.assign_coords(time=(self.run_of_block.time * 86400 / 20).assign_attrs(self.run_of_block.time.attrs))
        axes = plots.loading(slow).axes[1]
        self.assertEqual(axes.get_xlabel(), "time t, days")
        ticks = axes.get_xticks() / 86400
        np.testing.assert_allclose(ticks, np.round(ticks), atol=1e-9)

    def test_a_pulse_moves_as_in_the_model(self):
        medium = {key: value.strip("'") for key, value in (setting.split("=") for setting in ROCK)}
        settings = {**medium, "pulse.cells": 50, "output.every": 1}
        plain, si = (slipfront.pulse(STEP, set=settings, si=chosen) for chosen in (False, True))
        pictures = [plots.space_time(pulse) for pulse in (plain, si)]
        maps = [picture.axes[0].collections[0].get_array().filled(np.nan) for picture in pictures]
        np.testing.assert_allclose(maps[1], maps[0] * ROCK_SCALES["velocity"], rtol=1e-6, atol=1e-9)
        self.assertEqual((pictures[1].axes[0].get_xlabel(), pictures[1].axes[0].get_ylabel()), ("position x, mm", "time t, μs"))
        self.assertEqual(pictures[0].axes[0].get_xlabel(), "position x, b/A")


if __name__ == "__main__":
    unittest.main()
