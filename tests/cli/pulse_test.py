"""The command `slipfront pulse` as a user runs it."""

import json
import math
import os
import re
import unittest

import netCDF4
import numpy as np

from support import CommandLine, SOURCE, run

PULSE = ["closure", "friction_coefficient", "damping_number", "time", "slip_velocity_at_origin", "stress_at_origin",
         "slip_at_origin", "peak_slip_velocity", "peak_position", "trailing_front", "trailing_characteristic", "leading_front", "energy_shocks",
         "energy_through_ends", "first_crossing_time", "first_crossing_position", "warnings", "conservation_error", "cells",
         "steps", "solve_seconds", "wall_seconds"]

#: Settings of each loaded case with which it has one event.
TO_FIRST_EVENT = {"laboratory-block.toml": ["time.end=120 s"], "precursors.toml": ["time.end=0.4 s"], "gouge-patch.toml": ["time.end=100 s"],
                  "asperity.toml": ["time.end=2e9 s"], "two-asperities.toml": ["time.end=2e9 s"],
                  "stick-slip.toml": ["domain.left=-13", "domain.right=13", "time.end=3e5"]}


class Pulse(CommandLine):
    def test_json_has_the_contract_keys(self):
        out = self.pulse(os.path.join(SOURCE, "cases/step.toml"))
        for key in PULSE:
            self.assertIn(key, out)
        self.assertLess(abs(out["slip_velocity_at_origin"] / 0.0482084 - 1), 1e-5)
        self.assertLess(abs(out["trailing_characteristic"] + 0.36443433 * 2 * math.pi), 1e-6)
        self.assertLess(abs(out["trailing_front"] / out["trailing_characteristic"] - 1), 0.005)
        self.assertLess(out["conservation_error"], 1e-5)
        self.assertIsNone(out["energy_shocks"])  # no trains meet: the rest of the balance is an error
        self.assertIn("no trains have run into each other", out["reasons"]["energy_shocks"])
        self.assertGreater(self.pulse(os.path.join(SOURCE, "cases/shock.toml"))["energy_shocks"], 3e-4)
        self.assertIsNone(out["first_crossing_time"])
        self.assertIsNone(out["first_crossing_position"])
        self.assertEqual(out["warnings"], [])

    def test_check_estimates_the_steps(self):
        text = self.ok("pulse", os.path.join(SOURCE, "cases/step.toml"), "--check", "--wide")
        steps = float(re.search(r"about (\S+) steps\.", text).group(1))
        self.assertLess(abs(math.log(steps / 400)), math.log(3))

    def test_tolerance_stops_with_the_error_that_it_reached(self):
        """No number of cells resolves a corner to 1e-9."""
        case = self.file("slow.toml", "[initial]\nprofile = 'step'\nstress_left = 0.8\nstress_right = 0.2\n"
                                      "[friction]\nlaw = 'viscous'\ncoefficient = 0.5\n[pulse]\ncells = 25600\n"
                                      "[time]\nend = 1e-3\n[domain]\nleft = -1\nright = 1\n")
        self.refused(4, "pulse", case, "--tolerance", "1e-9", says=("is not reached with ", "pulse.cells = "))

    def test_warns_if_dislocations_overtake_each_other(self):
        """Dislocations at rest on a slope of a(x) move down and overtake each other. Values stay physical, and the run warns."""
        case = self.file("bump.toml", """[initial]
stress_left = 0.5
stress_right = 0.2
[interface]
contact = "1+0.5*exp(-((x-1.4)/0.4)^2)"
[friction]
law = "viscous"
coefficient = 0.3
[domain]
left = -10
right = 8
[time]
end = 3
[output]
every = 0.5
[pulse]
cells = 200
""")
        path = os.path.join(os.path.dirname(case), "bump.nc")
        done = run("pulse", case, "-o", path, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, "warning: pulse: dislocations overtake each other from t = [0-9.]+ at x = ")
        out = json.loads(done.stdout)
        self.assertTrue(0.3 < out["first_crossing_time"] < 1.5)
        self.assertTrue(0.4 < out["first_crossing_position"] < 2.4)
        self.assertEqual(len([w for w in out["warnings"] if "overtake" in w]), 1)
        with netCDF4.Dataset(path) as file:
            self.assertIn("overtake", file.getncattr("warnings"))
            W, k, U = (file[name][:] for name in ("W", "k", "U"))
            self.assertTrue(np.isfinite(W).all() and (abs(W) <= k).all() and (abs(U) < 1).all())

    def test_stated_errors_hold_against_four_times_the_cells(self):
        """The stress has two smooth steps. Before a correction, the front was -1.499 +- 0.009 with 200 cells and -1.588 with 800."""
        case = self.file("two.toml", """[initial]
profile = "formula"
formula = "0.7522+1.599*0.5*(1-tanh((x+0.09676)/0.08963))-0.7522*0.5*(1-tanh((x-0.09676)/0.08963))"
[friction]
law = "n-shaped"
coefficient = 0.1667
velocity = 0.09302
[domain]
left = -2.666
right = 2.666
[time]
end = 1.461
[pulse]
cells = 200
""")
        coarse, fine = (self.pulse(case, "--quiet", "--set", f"pulse.cells={cells}") for cells in (200, 800))
        self.assertGreater(coarse["errors"]["peak_position"], 0)
        for key, error in coarse["errors"].items():
            if None not in (error, coarse[key], fine[key]):
                self.assertLessEqual(abs(coarse[key] - fine[key]), error, key)

    def test_every_case_runs(self):
        folder = os.path.join(SOURCE, "cases")
        for name in sorted(os.listdir(folder)):
            if not name.endswith(".toml"):
                continue
            case = os.path.join(folder, name)
            with self.subTest(case=name), open(case, encoding="utf-8") as file:
                text = file.read()
                if "[plane]" in text:
                    self.refused(2, "pulse", case, says=["plane", "slipfront plane"])
                    lines = ["--direct"] if "--direct" in text else []  # the header of a case names this if it needs it
                    self.assertIn("OK. This scenario would follow", self.ok("plane", case, *lines, "--check", "--wide"))
                    continue  # plane_test.py runs these
                if "[loading]" in text:  # only chains support loading
                    self.refused(2, "pulse", case, says=["loading.stiffness", "slipfront chain"])
                    self.assertIn("OK. This scenario would run", self.ok("chain", case, "--check", "--wide"))
                    self.assertEqual(len(self.chain(case, "--set", *TO_FIRST_EVENT[name])["events"]), 1)
                    continue
                self.assertIn("OK. This scenario would run", self.ok("pulse", case, "--check", "--wide"))
                self.assertGreater(self.pulse(case, "--set", "pulse.cells=50")["steps"], 0)

    def test_a_number_that_the_cells_do_not_resolve_has_a_warning_instead_of_an_error(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        narrow = ("--set", "initial.stress_left=0.373", "initial.stress_right=0.0066", "friction.law=power",
                  "friction.coefficient=5.74", "friction.exponent=0.5", "domain.left=-4.25", "domain.right=5.07", "time.end=2.83")
        out = self.pulse(case, *narrow, "pulse.cells=200")
        self.assertEqual(len([w for w in out["warnings"] if "slip_at_origin grows with the cells" in w]), 1)
        self.assertNotIn("slip_at_origin", out["errors"])
        out = self.pulse(case, *narrow, "initial.stress_left=0.855", "initial.stress_right=0", "pulse.cells=200")
        self.assertEqual(out["warnings"], [])
        self.assertLess(out["errors"]["slip_at_origin"], 0.02 * out["slip_at_origin"])

    def test_both_closures_run_and_are_named(self):
        case = os.path.join(SOURCE, "cases/fig-08.toml")
        paper = self.pulse(case)
        right = self.pulse(case, "--set", "friction.closure=consistent")
        self.assertEqual((paper["closure"], right["closure"]), ("paper", "consistent"))
        self.assertLess(abs(paper["slip_velocity_at_origin"] - 0.015248), 3e-6)
        self.assertLess(abs(right["slip_velocity_at_origin"] - 0.009337), 3e-6)
        self.assertAlmostEqual(right["damping_number"], math.pi)

    def test_only_viscous_friction_has_a_coefficient_and_a_damping_number(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        for law in (["coulomb", "coefficient=0.03"], ["power", "coefficient=0.1", "exponent=1.5"], ["n-shaped", "coefficient=0.1"],
                    ["slip-weakening", "strength=0.05"], ["flash-heating", "strength=0.05"], ["formula", "formula=0.1*w"],
                    ["rate-and-state", "strength=0.05"]):
            settings = ("--set", "pulse.cells=20", f"friction.law={law[0]}", *(f"friction.{value}" for value in law[1:]))
            out = self.pulse(case, *settings)
            self.assertEqual((out["friction_coefficient"], out["damping_number"]), (None, None), law)
            self.assertRegex(self.ok("pulse", case, *settings, "--wide"), r"friction_coefficient +null .*\ndamping_number +null ")
            self.assertIn(f"{law[0]} friction with " if law[0] != "formula" else "drawn friction with ", self.ok("pulse", case, "--check", "--wide", *settings))
        for C in (0, 0.5):
            out = self.pulse(case, "--set", "pulse.cells=20", "friction.law=viscous", f"friction.coefficient={C}")
            self.assertEqual(out["friction_coefficient"], C)
            self.assertAlmostEqual(out["damping_number"], 2 * math.pi * C)
        self.assertEqual(self.pulse(case, "--set", "pulse.cells=20")["damping_number"], 0)

    def test_a_strength_above_that_of_the_substrate_is_a_warning(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        path = os.path.join(os.path.dirname(self.file("unused", "")), "out.nc")
        for command in ("pulse", "chain"):
            done = run(command, case, "-o", path, "--json", "--set", "pulse.cells=20", "chain.scale=20", "initial.profile=tanh",
                       "friction.law=coulomb", "friction.coefficient=2")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count("warning: friction holds a force of 2 "), 1)
            self.assertEqual(len([w for w in json.loads(done.stdout)["warnings"] if "friction holds" in w]), 1)
            with netCDF4.Dataset(path) as file:
                self.assertIn("friction holds", file.getncattr("warnings"))

    def test_refuses(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        self.refused(2, "pulse", says=["SCENARIO"])
        barrier = os.path.join(SOURCE, "cases/barrier.toml")
        self.refused(2, "pulse", barrier, "--set", "interface.contact=x>0.3 ? 2 : 1", says=["jumps", "x = 0.3"])
        self.refused(2, "pulse", barrier, "--set", "interface.contact=1e4", says=["interface.contact", "0.0045"])
        self.refused(2, "pulse", case, "--set", "interface.contact=1+x^2", says=["domain", "left and right"])
        self.refused(2, "pulse", case, "--set", "initial.stress_left=0.1", "forcing.formula=0.5", says=["domain", "with a forcing"])
        self.refused(3, "pulse", "/nowhere.toml", says=["No such file"])
        self.refused(3, "pulse", case, "-o", "/nowhere/o.nc", says=["/nowhere/o.nc"])
        self.refused(3, "pulse", case, "--resume", "/nowhere.nc", says=["/nowhere.nc"])
        self.refused(3, "pulse", case, "--resume", case, says=["step.toml"])
        for change, word in [("pulse.cells=3", "cells"), ("time.end=0", "end"), ("initial.stress_left=-1", "stress_left"),
                             ("initial.strss_left=1", "stress_left"), ("domain.left=9", "left"), ("friction.law=sticky", "viscous"),
                             ("nonsense", "--set"), ("initial.profile=formula", "formula")]:
            with self.subTest(change=change):
                self.refused(2, "pulse", case, "--set", change, says=[word])
        self.refused(2, "pulse", self.file("f.toml", "[initial]\nprofile = 'formula'\nformula = 'x'\n[domain]\nleft = -1\nright = 1\n"),
                     says=["f.toml:3", "x"])
        self.refused(2, "pulse", self.file("g.toml", "[initial]\nprofile = 'formula'\nformula = 'foo(x)'\n"), says=["g.toml:3", "foo"])

    def test_title_and_history_name_what_was_overridden(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        output = os.path.join(os.path.dirname(self.file("unused", "")), "out.nc")
        change = ("--set", "friction.law=viscous", "--set", "friction.coefficient=0.5", "--set", "forcing.formula=0 * x")
        text = self.ok("pulse", case, "-o", output, "--wide", *change)
        title = "Frictionless step (with forcing.formula=0 * x, friction.coefficient=0.5, friction.law=viscous)"
        self.assertEqual(text.split("\n")[0], title)
        with netCDF4.Dataset(output) as data:
            self.assertEqual(data.title, title)
            self.assertEqual(data.history, f"slipfront pulse {case} --set friction.law=viscous --set friction.coefficient=0.5 "
                                           "--set 'forcing.formula=0 * x'")

    def test_a_killed_and_resumed_run_writes_the_same_file(self):
        self.killed_and_resumed("pulse", 20)

    def test_interrupted_leaves_a_checkpoint(self):
        case = self.slow_case()
        folder = os.path.dirname(case)
        cut = os.path.join(folder, "cut.nc")
        errors = self.interrupted(cut, "pulse", case, "--set", "pulse.cells=2000")
        self.assertIn("--resume", errors)
        self.refused(2, "pulse", case, "--resume", cut, says=["another scenario"])


if __name__ == "__main__":
    unittest.main()
