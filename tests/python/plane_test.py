"""Compares slipfront.plane with the command line and its files, and open with both."""

import json
import os
import tempfile
import unittest

import numpy as np
import xarray as xr

import slipfront
from support import CommandLine, SOURCE

RINGS = os.path.join(SOURCE, "cases/plane-rings.toml")
SMALL = {"plane.loops": 40, "plane.cells": 40, "time.end": 1, "output.every": 0.5}
SETTINGS = [f"{key}={value}" for key, value in SMALL.items()]


class Plane(CommandLine):
    def test_summary_and_errors_are_the_json_of_the_command_line(self):
        asked = json.loads(self.ok("plane", RINGS, "--set", *SETTINGS, "--json"))
        got = slipfront.plane(RINGS, set=SMALL).attrs
        energies, errors, reasons = asked.pop("energies"), asked.pop("errors"), asked.pop("reasons")
        self.assertEqual({key: got[f"{key}_reason"] for key in reasons}, reasons)
        of_energies = errors.pop("energies")
        for part, known in [(asked, errors), ({f"energy_{k}": v for k, v in energies.items()}, {f"energy_{k}": v for k, v in of_energies.items()})]:
            for key, value in part.items():
                if key not in ("warnings", "wall_seconds"):
                    np.testing.assert_array_equal(got[key], np.nan if value is None else value, key)
            for key, error in known.items():
                np.testing.assert_allclose(got[f"{key}_error"], error, rtol=6e-3)  # the program rounds to three digits
        self.assertGreaterEqual(len(errors), 5)

    def test_file_and_dataset_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            for options, direct, si in [([], False, None), (["--direct"], True, None), (["--si"], False, True)]:
                setting = {**SMALL, "chain.scale": 10, "output.lines": True, "medium.contact_ratio": 0.01, "medium.asperity_spacing": "1 mm"}
                theirs, ours = os.path.join(folder, "theirs.nc"), os.path.join(folder, "ours.nc")
                self.ok("plane", RINGS, *options, "--set", *[f"{key}={'true' if value is True else value}" for key, value in setting.items()], "-o", theirs)
                data = slipfront.plane(RINGS, direct=direct, set=setting, output=ours, si=si)
                with open(theirs, "rb") as a, open(ours, "rb") as b:
                    self.assertEqual(a.read(), b.read())
                with xr.open_dataset(ours) as stored:
                    for name in set(stored.variables) - {"checkpoint", "scenario_text"}:
                        self.assertEqual(data[name].dims, stored[name].dims)
                        self.assertEqual(data[name].attrs, stored[name].attrs)
                        np.testing.assert_array_equal(data[name].values, stored[name].values)
                    for name in stored.attrs:
                        self.assertEqual(data.attrs[name], stored.attrs[name], name)
                again = slipfront.open(ours)
                xr.testing.assert_identical(again, _with_attributes(data, again))

    def test_a_stopped_run_resumes(self):
        with tempfile.TemporaryDirectory() as folder:
            part, whole = os.path.join(folder, "part.nc"), os.path.join(folder, "whole.nc")

            def stop(time, end, steps, level):
                if time > 0.3:
                    raise KeyboardInterrupt

            setting = {**SMALL, "plane.loops": 160}
            with self.assertRaises(KeyboardInterrupt):
                slipfront.plane(RINGS, set=setting, output=part, progress=stop)
            self.assertEqual(slipfront.open(part).attrs["finished"], 0)
            resumed = slipfront.plane(RINGS, set=setting, resume=part, errors=False)
            expected = slipfront.plane(RINGS, set=setting, output=whole, errors=False)
            for name in expected.variables:
                np.testing.assert_array_equal(resumed[name].values, expected[name].values, name)

    def test_a_finite_fault_model_is_compared(self):
        model = os.path.join(SOURCE, "cases/synthetic-fault.fsp")
        setting = {"chain.scale": 0.5, "time.end": "1 s", "output.every": "0.5 s"}
        asked = json.loads(self.ok("plane", model, "--set", *[f"{key}={value}" for key, value in setting.items()], "--json"))
        got = slipfront.plane(model, set=setting)
        self.assertEqual(got.attrs["unit_system"], "SI")
        for key, value in asked["model"].items():
            self.assertEqual(got.attrs[f"model_{key}"], value)

    def test_errors_name_the_key(self):
        with self.assertRaisesRegex(slipfront.InputError, "plane.loops"):
            slipfront.plane(RINGS, set={"plane.loops": 1})
        with self.assertRaisesRegex(slipfront.InputError, "chain.scale"):
            slipfront.plane(RINGS, direct=True, set={"chain.scale": -1})
        with self.assertRaisesRegex(slipfront.InputError, "plane"):
            slipfront.plane(os.path.join(SOURCE, "cases/step.toml"))
        self.assertEqual(slipfront.check(RINGS, set=SMALL, command="plane")["loops"], 40)


def _with_attributes(data, other):
    """Returns `data` with the attributes of another Dataset."""
    copy = data.copy()
    copy.attrs = other.attrs
    return copy


if __name__ == "__main__":
    unittest.main()
