"""slipfront.sweep: each point equals the pulse with its parameters, and a killed sweep loses no completed point."""

import functools
import os
import signal
import subprocess
import sys
import time
import unittest
import warnings

import numpy as np

import slipfront
from support import PATIENCE, CommandLine

SCENARIO = {"initial": {"profile": "tanh", "stress_left": 0.855, "stress_right": 0.179, "width": 1}, "friction": {"law": "viscous", "coefficient": 0.5},
            "pulse": {"cells": 60}}
AXES = {"friction.coefficient": [0.1, 0.5, 2.0], "friction.closure": ["paper", "consistent"]}
MANY = {"friction.coefficient": np.linspace(0.05, 2, 150).tolist(), "initial.stress_left": [0.7, 0.855]}


@functools.cache
def whole():
    """The sweep MANY, uninterrupted."""
    return slipfront.sweep(SCENARIO, MANY)


class Sweep(CommandLine):
    def setUp(self):
        self.output = os.path.join(os.path.dirname(self.file("unused", "")), "sweep.nc")

    def test_each_point_equals_the_pulse_with_its_parameters(self):
        data = slipfront.sweep(SCENARIO, AXES, set={"friction.law": "viscous"})
        self.assertEqual(data.sizes, {"friction_coefficient": 3, "friction_closure": 2})
        self.assertEqual([data[name].attrs["key"] for name in data.dims], list(AXES))
        self.assertNotIn("wall_seconds", data)
        for coefficient in AXES["friction.coefficient"]:
            for closure in AXES["friction.closure"]:
                at = {"friction.coefficient": coefficient, "friction.closure": closure}
                alone = slipfront.pulse(SCENARIO, set=at).attrs
                for name, value in data.sel(friction_coefficient=coefficient, friction_closure=closure).data_vars.items():
                    np.testing.assert_equal(value.item(), alone.get(name, ""), name)
        self.assertTrue(all(data[name].attrs["long_name"] for name in data.data_vars))

    def test_chain(self):
        axes = {"chain.scale": [50, 100]}
        data = slipfront.sweep(SCENARIO, axes, command="chain", variables=["slip_at_origin", "dislocations"])
        for scale in axes["chain.scale"]:
            alone = slipfront.chain(SCENARIO, set={"chain.scale": scale}).attrs
            self.assertEqual(float(data.slip_at_origin.sel(chain_scale=scale)), alone["slip_at_origin"])
            self.assertEqual(float(data.dislocations.sel(chain_scale=scale)), alone["dislocations"])

    def test_dimensions_are_identifiers(self):
        data = slipfront.sweep(SCENARIO, AXES, variables=["friction_coefficient", "slip_at_origin"])
        self.assertTrue(all(name.isidentifier() for name in data.dims))
        np.testing.assert_array_equal(data.friction_coefficient, AXES["friction.coefficient"])  # the axis replaces the variable of its name
        self.assertEqual(list(data.data_vars), ["slip_at_origin", "failure"])

    def test_opens_a_file_with_dots_in_its_dimensions(self):
        data = slipfront.sweep(SCENARIO, AXES, output=self.output)
        old = data.rename(friction_coefficient="friction.coefficient", friction_closure="friction.closure").assign_attrs(slipfront_format="sweep 1")
        old["friction_coefficient"] = ("friction.coefficient", AXES["friction.coefficient"])
        slipfront._files.write_dataset(old, self.output)
        opened = slipfront.open(self.output)
        self.assertEqual(set(opened.dims), {"friction_coefficient", "friction_closure"})
        np.testing.assert_array_equal(opened.slip_at_origin.sel(friction_closure="paper"), data.slip_at_origin.sel(friction_closure="paper"))

    def test_numbers_have_their_units(self):
        pulse, data = slipfront.pulse(SCENARIO), slipfront.sweep(SCENARIO, {"initial.stress_left": [0.8, 0.9]})
        for name in data.data_vars:
            if name in pulse:
                self.assertEqual(data[name].attrs["dimensional_unit"], pulse[name].attrs["dimensional_unit"], name)
        rock = {"contact_ratio": 0.01, "spacing": "1 mm", "medium": {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s", "poisson_ratio": 0.3}}
        metric = data.slipfront.si(**rock)
        self.assertEqual((metric.initial_stress_left.units, metric.slip_at_origin.units, metric.first_crossing_time.units), ("Pa", "m", "s"))
        np.testing.assert_allclose(metric.sel(initial_stress_left=metric.initial_stress_left[1]).slip_at_origin, data.slip_at_origin[1] * 1e-3 / np.pi)  # between the faces
        chain = slipfront.sweep(SCENARIO, {"chain.scale": [50]}, command="chain")
        fields = slipfront.chain(SCENARIO, set={"chain.scale": 50})
        for name in chain.data_vars:
            if name in fields and name != "scale":
                self.assertEqual(chain[name].attrs["dimensional_unit"], fields[name].attrs["dimensional_unit"], name)

    def test_axes_have_the_units_of_their_keys(self):
        for key, values, unit in [("initial.stress_left", [0.8], "mu A / pi"), ("domain.left", [-9.0], "b / A"), ("time.end", [1.0], "b / (c A)"), ("pulse.cells", [50], None),
                                  ("friction.coefficient", [1.0], None), ("friction.closure", ["paper"], None)]:
            data = slipfront.sweep(SCENARIO, {key: values}, set={"domain.right": 9.0})
            self.assertEqual(data[key.replace(".", "_")].attrs.get("dimensional_unit"), unit, key)

    def test_an_axis_in_si_units_has_numbers_and_a_unit(self):
        rock = {"medium.shear_modulus": "30 GPa", "medium.p_wave_speed": "6 km/s", "medium.poisson_ratio": 0.3, "medium.asperity_spacing": "1 mm",
                "medium.contact_ratio": 0.01}
        data = slipfront.sweep(SCENARIO, {"initial.stress_left": ["60 MPa", "70 MPa"], "time.end": ["3 us", "0.004 ms"]},
                               set={**rock, "domain.left": "-0.9 m", "domain.right": "0.9 m", "initial.stress_right": "17 MPa", "initial.width": "10 cm"})
        self.assertEqual((data.initial_stress_left.values.tolist(), data.initial_stress_left.units), ([60, 70], "MPa"))
        self.assertEqual(data.time_end.values.tolist(), ["3 us", "0.004 ms"])

    def test_constants_that_vary_must_be_selected(self):
        rock = {"medium.shear_modulus": "30 GPa", "medium.p_wave_speed": "6 km/s", "medium.poisson_ratio": 0.3, "medium.asperity_spacing": "1 mm"}
        data = slipfront.sweep(SCENARIO, {"medium.contact_ratio": [0.01, 0.02]}, set=rock)
        with self.assertRaises(slipfront.InputError) as caught:
            data.slipfront.si()
        self.assertIn("contact_ratio varies along the dimension medium_contact_ratio", str(caught.exception))
        first, second = (data.sel(medium_contact_ratio=ratio).slipfront.si() for ratio in (0.01, 0.02))
        np.testing.assert_allclose(second.stress_at_origin, 2 * first.stress_at_origin)

    def test_threads_change_nothing_and_progress_is_reported(self):
        reports = []
        one = slipfront.sweep(SCENARIO, MANY, threads=1, progress=lambda *at: reports.append(at))
        self.assertTrue(one.identical(slipfront.sweep(SCENARIO, MANY, threads=3)))
        self.assertEqual(reports[-1], (300, 300))
        self.assertTrue(all(a[0] < b[0] for a, b in zip(reports, reports[1:])))

    def test_a_failed_point_is_a_nan_with_a_reason(self):
        axes = {"friction.coefficient": [-1, 0.5]}
        with warnings.catch_warnings(record=True) as seen:
            warnings.simplefilter("always")
            data = slipfront.sweep(SCENARIO, axes, output=self.output)
        self.assertIn("1 of 2 points failed", str(seen[-1].message))
        self.assertTrue(np.isnan(data.slip_at_origin[0]) and not np.isnan(data.slip_at_origin[1]))
        self.assertIn("friction.coefficient = '-1.0'", data.failure.values[0])
        self.assertEqual(data.failure.values[1], "")
        self.assertTrue(slipfront.open(self.output).identical(data))

    def test_refuses(self):
        for says, change in [("not a dict", {"axes": []}), ("not a dict", {"axes": {}}), ("'3'", {"axes": {3: [1]}}), ("shape", {"axes": {"pulse.cells": []}}),
                             ("shape", {"axes": {"pulse.cells": 50}}), ("shape", {"axes": {"pulse.cells": [[50]]}}), ("twice", {"axes": {"pulse.cells": [50, 50]}}),
                             ("not finite", {"axes": {"friction.coefficient": [np.nan]}}), ("'coefficient'", {"axes": {"friction.coeficient": [1, 2]}}),
                             ("out of range", {"axes": {"friction.coefficient": [-1, -2]}}), ("slip_at_origin", {"variables": ["slip"]}),
                             ("closure", {"variables": "closure"}), ("pulse, chain", {"command": "compare"}), ("threads", {"threads": 0}),
                             ("progress", {"progress": 1}), ("scenario", {"scenario": 3})]:
            with self.subTest(change=change), self.assertRaises(slipfront.InputError) as caught:
                slipfront.sweep(**{"scenario": SCENARIO, "axes": AXES, **change})
            self.assertIn(says, str(caught.exception))
        for change in ({"output": "/nowhere/s.nc"}, {"resume": "/nowhere/s.nc"}, {"scenario": "/nowhere.toml"}):
            with self.assertRaises(slipfront.FileError):
                slipfront.sweep(**{"scenario": SCENARIO, "axes": AXES, **change})
        with self.assertRaises(slipfront.InputError):
            slipfront.sweep(SCENARIO, {"friction.coefficient": [-1, -2]}, output=self.output)
        self.assertEqual(os.listdir(os.path.dirname(self.output)), ["unused"])  # a sweep that never began leaves no file

    def begin(self):
        code = f"import slipfront\nslipfront.sweep({SCENARIO!r}, {MANY!r}, output={self.output!r}, threads=1)"
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        return process

    def wait_for_rows(self, process, rows):
        def count():
            with open(self.output + ".part", "rb") as store:
                return store.read().count(b"\n")
        while process.poll() is None and not (os.path.exists(self.output + ".part") and count() > rows):
            time.sleep(0.001)

    def test_killed_and_resumed_without_loss(self):
        for trial in range(3):
            process = self.begin()
            self.wait_for_rows(process, 1 + trial)
            process.kill()
            process.wait()
            self.assertFalse(os.path.exists(self.output))
            with open(self.output + ".part", "rb") as store:
                kept = sum(len(slipfront._store._content(line) or []) for line in store.readlines()[1:])
            self.assertTrue(0 < kept < 300, kept)
            with open(self.output + ".part", "ab") as store:  # imitates a kill during a write
                store.write([b"", b"0a1b2c3d [[17", b"0a1b2c3d [[17, [1.0], \"\"]]\n"][trial])
            reports = []
            resumed = slipfront.sweep(SCENARIO, MANY, resume=self.output, progress=lambda *at: reports.append(at))
            self.assertGreater(reports[0][0], kept)  # completed points do not run again
            self.assertTrue(resumed.identical(whole()))
            self.assertTrue(slipfront.open(self.output).identical(whole()))
            self.assertFalse(os.path.exists(self.output + ".part"))
            self.assertTrue(slipfront.sweep(SCENARIO, MANY, resume=self.output).identical(whole()))  # a finished sweep can be resumed too
            with self.assertRaises(slipfront.InputError):
                slipfront.sweep(SCENARIO, AXES, resume=self.output)
            os.remove(self.output)

    def test_an_interrupted_sweep_can_be_resumed(self):
        process = self.begin()
        self.wait_for_rows(process, 1)
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=PATIENCE)[1]
        self.assertIn("KeyboardInterrupt", errors)
        with self.assertRaises(slipfront.InputError) as caught:  # an unfinished sweep is not overwritten
            slipfront.sweep(SCENARIO, MANY, output=self.output)
        self.assertIn("unfinished", str(caught.exception))
        with self.assertRaises(slipfront.InputError) as caught:
            slipfront.sweep(SCENARIO, AXES, resume=self.output)
        self.assertIn("another sweep", str(caught.exception))
        self.assertTrue(slipfront.sweep(SCENARIO, MANY, resume=self.output).identical(whole()))

    def test_progress_may_stop_it(self):
        def stop(*_):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            slipfront.sweep(SCENARIO, MANY, output=self.output, progress=stop)
        self.assertTrue(slipfront.sweep(SCENARIO, MANY, resume=self.output).identical(whole()))

    def test_two_processes_do_not_write_the_same_store(self):
        process = self.begin()
        self.wait_for_rows(process, 1)
        process.send_signal(signal.SIGSTOP)
        try:
            with self.assertRaises(slipfront.FileError) as caught:
                slipfront.sweep(SCENARIO, MANY, resume=self.output)
            self.assertIn("another process", str(caught.exception))
        finally:
            process.kill()
            process.wait()


if __name__ == "__main__":
    unittest.main()
