"""slipfront reproduce: all numbers and figures are there, computed, and near what the mathematics says; the folder is whole or not there."""

import csv
import json
import math
import os
import signal
import subprocess
import tempfile
import time
import tomllib
import unittest

import slipfront
import xarray as xr
from page import Page
from support import CommandLine, PROGRAM, SOURCE

PAPER = os.path.join(SOURCE, "python/slipfront/reproduce/paper.toml")


#: Relative differences of the numbers that do not agree with the paper to the digits that it prints.
DIFFERENCES = {
    "parkfield_stress": 0.0063,  # read off a figure
    "parkfield_slip_velocity_0.1": -0.0300,  # the paper does not state the width of its profile
    "parkfield_slip_velocity_0.5": -0.1114,  # the same, and one digit
    "parkfield_contact_ratio_0.1": 0.0283,  # A and the stress follow W
    "parkfield_contact_ratio_0.5": 0.1244,
    "parkfield_contact_ratio_2.0": 0.0608,
    "parkfield_stress_pa_0": -0.0173,  # of rounded A and c
    "parkfield_stress_pa_0.1": 0.0412,
    "parkfield_stress_pa_0.5": 0.1059,
    "parkfield_stress_pa_2.0": 0.0434,
}


class Reproduce(CommandLine):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = os.path.join(cls.temporary.name, "reproduction")
        # Without arguments, in a folder of its own: this is the main job.
        done = subprocess.run([PROGRAM], capture_output=True, text=True, timeout=280, cwd=cls.temporary.name)
        assert done.returncode == 0, done.stderr
        cls.printed, cls.errors = done.stdout, done.stderr
        done = subprocess.run([PROGRAM, "reproduce", "-o", cls.folder, "--json", "--threads", "1"], capture_output=True, text=True, timeout=280)
        assert done.returncode == 0, done.stderr
        cls.out = json.loads(done.stdout)
        with open(PAPER, "rb") as file:
            cls.paper = tomllib.load(file)
        cls.numbers = {number["key"]: row for number, row in zip(cls.paper["number"], cls.out["numbers"], strict=True)}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_prints_the_table_and_where_the_page_is(self):
        self.assertEqual(self.errors, "")
        self.assertIn(os.path.join("reproduction", "report.html"), self.printed.splitlines()[-1])
        for row in self.out["numbers"]:  # of another run, on one thread
            self.assertIn(f"{row['printed']:>9} {row['computed']:>10.4g}", self.printed)
        self.assertEqual(os.listdir(self.temporary.name), ["reproduction"])

    def test_every_figure_with_its_data(self):
        for name in [f"fig-{i:02d}" for i in range(1, 13)] + ["width"]:
            for ending in ("svg", "png", "csv", "nc"):
                self.assertGreater(os.path.getsize(os.path.join(self.folder, f"{name}.{ending}")), 500, (name, ending))
            with xr.open_dataset(os.path.join(self.folder, f"{name}.nc")) as data:
                self.assertGreater(len(data.data_vars), 0)

    def test_every_number_is_computed(self):
        for number in self.paper["number"]:
            key, row = number["key"], self.numbers[number["key"]]
            self.assertEqual(row["printed"], number["printed"])
            self.assertTrue(math.isfinite(row["computed"]))
            self.assertNotEqual(row["computed"], float(row["printed"]), key)  # none is a copy
            self.assertEqual(row["agrees"], key not in DIFFERENCES, key)
            if not row["agrees"]:  # a remark says why, and the difference is the one that it explains
                self.assertTrue(row["remark"], key)
                self.assertAlmostEqual(row["difference"], DIFFERENCES[key], delta=1e-3, msg=key)
        self.assertLessEqual(set(DIFFERENCES), set(self.numbers))

    def test_numbers_are_what_the_mathematics_gives(self):
        """Values that an independent derivation gives (docs/theory.md; quadrature, other schemes), not those of this code."""
        expected = {"c": (5.4210, 1e-5), "parkfield_rupture_velocity": (0.5534, 1e-4), "parkfield_stress": (1.03653, 1e-5), "parkfield_slip_velocity": (0.1000039, 1e-6),
                    "ets_rupture_velocity": (2.135e-5, 1e-4), "ets_stress": (0.21176, 3e-4), "ets_slip_velocity": (2.645e-7, 1e-3), "ets_observed_slip_velocity": (4.79e-8, 1e-3)}
        for key, (value, tolerance) in expected.items():
            self.assertLess(abs(self.numbers[key]["computed"] / value - 1), tolerance, key)

    def test_friction_lowers_slip(self):
        with xr.open_dataset(os.path.join(self.folder, "fig-10.nc")) as data:
            w = data["slip_velocity_at_origin"]
            self.assertTrue(bool((w.diff("coefficient") < 0).all()))
            self.assertTrue(bool((w.diff("stress") > 0).all()))
            moving = w.isel(coefficient=slice(1, None))
            self.assertTrue(bool((moving.sel(closure="consistent") < moving.sel(closure="paper")).all()))
            shares = [float((w.sel(closure="paper", coefficient=c) / w.sel(closure="paper", coefficient=0)).sel(stress=1.03)) for c in (0.1, 0.5, 2.0)]
        for share, independent in zip(shares, (0.833, 0.459, 0.195)):
            self.assertLess(abs(share - independent), 0.004)

    def test_trailing_edge_knows_no_friction(self):
        with xr.open_dataset(os.path.join(self.folder, "fig-12.nc")) as data:
            exact = slipfront.relations(stress=data["stress"].values)["rupture_velocity"].values
            self.assertLess(float(abs(-data["trailing_velocity"] / exact - 1).max()), 0.03)
            self.assertTrue(bool((data["leading_velocity"].diff("coefficient") < 0).all()))

    def test_page_needs_nothing_else(self):
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            page = file.read()
        found = Page(page)
        self.assertEqual((found.loads, found.errors), ([], []))
        self.assertEqual(len(found.figures), 13)
        for name, commands in found.figures.items():
            self.assertEqual(len(commands), 1, name)
            self.assertIn("slipfront", commands[0], name)
        with open(os.path.join(self.folder, "numbers.csv"), encoding="utf-8", newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), len(self.paper["number"]))

    def test_will_not_replace_what_is_not_its_own(self):
        mine = self.file("letter.txt", "dear")
        self.refused(2, "reproduce", "-o", os.path.dirname(mine), says=["something else is there"])
        self.refused(2, "reproduce", "-o", mine, says=["something else is there"])
        self.refused(2, "reproduce", "--nonsense", says=["--nonsense"])
        self.assertEqual(os.listdir(os.path.dirname(mine)), ["letter.txt"])

    def test_interrupted_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen([PROGRAM, "reproduce", "-o", os.path.join(folder, "out")], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            while process.poll() is None and not os.listdir(folder):
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130, errors)
            self.assertEqual(os.listdir(folder), [])
            self.assertEqual(errors.count("\n"), 1, errors)


if __name__ == "__main__":
    unittest.main()
