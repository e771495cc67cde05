"""slipfront compare as a user meets it."""

import json
import math
import os
import unittest

from support import CommandLine, SOURCE


class Compare(CommandLine):
    def compare(self, *arguments):
        return json.loads(self.ok("compare", os.path.join(SOURCE, "cases/step.toml"), *arguments, "--json"))

    def test_shows_every_level_and_that_the_chain_follows_the_consistent_closure(self):
        out = self.compare("--scale", "100", "--scale", "1000", "--set", "friction.law=viscous", "--set", "friction.coefficient=0.5")
        levels = {level["level"]: level for level in out["levels"]}
        self.assertEqual(list(levels), ["pulse-consistent", "pulse-paper", "chain-100", "chain-1000"])
        quantities = ["slip_at_origin", "slip_velocity_at_origin", "peak_slip_velocity", "leading_front", "trailing_front_observed",
                      "leading_front_observed"]
        for level in levels.values():
            self.assertEqual(list(level["difference"]), quantities)
            for key in quantities:
                self.assertAlmostEqual(level[key] - levels["pulse-consistent"][key], level["difference"][key])
        self.assertEqual(list(out["trend"]), quantities)
        for key in ("slip_at_origin", "leading_front"):
            far, near = abs(levels["chain-100"]["difference"][key]), abs(levels["chain-1000"]["difference"][key])
            self.assertLess(near, far / 3, key)
            self.assertLess(near, abs(levels["pulse-paper"]["difference"][key]) / 10, key)
            self.assertLess(abs(out["trend"][key]["difference"]), far / 3, key)
            self.assertGreater(out["trend"][key]["exponent"], 0.5, key)
        self.assertEqual(levels["chain-1000"]["scale"], 1000)
        self.assertAlmostEqual(out["damping_number"], math.pi)

    def test_a_difference_that_grows_with_scale_has_no_limit(self):
        case = os.path.join(SOURCE, "cases/step-viscous.toml")
        out = json.loads(self.ok("compare", case, "--scale", "30", "--scale", "60", "--json"))
        slip, leading = out["trend"]["slip_at_origin"], out["trend"]["leading_front"]
        self.assertLess(slip["exponent"], 0)
        self.assertEqual((slip["extrapolated"], slip["difference"]), (None, None))
        self.assertGreater(leading["exponent"], 0)
        self.assertIsNotNone(leading["extrapolated"])
        reason = [note for note in out["notes"] if "infinite scale" in note]
        self.assertEqual(len(reason), 1)
        self.assertIn("slip_at_origin", reason[0])
        self.assertNotIn("leading_front,", reason[0])
        table = self.ok("compare", case, "--scale", "30", "--scale", "60", "--wide")
        self.assertRegex(table, r"at infinite scale +- +0\.\d+ ")
        self.assertIn(reason[0], table)
        self.assertNotIn("infinite scale for", self.ok("compare", case, "--scale", "60"))  # one scale has no trend

    def test_only_viscous_friction_has_a_damping_number(self):
        strength = ("--scale", "20", "--set", "pulse.cells=20", "friction.law=rate-and-state", "friction.strength=0.05")
        out = self.compare(*strength)
        self.assertEqual((out["friction_coefficient"], out["damping_number"]), (None, None))
        table = self.ok("compare", os.path.join(SOURCE, "cases/step.toml"), *strength)
        self.assertIn("rate-and-state friction with strength = 0.05", table)
        self.assertNotIn("Gamma", table)

    def test_has_the_closed_form_where_there_is_one(self):
        for right in ("0", "0.179"):
            many = ("--set", "pulse.trains=many") if right != "0" else ()
            out = self.compare("--scale", "100", "--set", f"initial.stress_right={right}", "--set", "pulse.threshold=0.01", *many)
            exact = out["levels"][0]
            self.assertEqual(exact["level"], "closed-form")
            for key in ("slip_at_origin", "slip_velocity_at_origin", "leading_front", "trailing_front_observed"):
                self.assertLess(abs(exact["difference"][key]), (0.01 if "observed" in key else 2e-3) * abs(exact[key]), key)
            if many:  # one train differs from the closed form by the energy of the second train, and notes that
                one = self.compare("--scale", "100", "--set", f"initial.stress_right={right}")
                self.assertGreater(one["levels"][1]["slip_at_origin"] / one["levels"][0]["slip_at_origin"], 1.03)
                self.assertIn('pulse.trains = "many"', one["notes"][0])
            self.assertNotIn("shock", out["notes"][0])
            self.assertIsNone(out["trend"]["slip_at_origin"]["exponent"])  # one scale has no trend
        for change in ("initial.profile=tanh", "domain.right=0.3", "forcing.formula=0.001"):
            self.assertEqual(self.compare("--scale", "100", "--set", change)["levels"][0]["level"], "pulse-consistent", change)

    def test_scales_are_the_scenarios_or_the_users(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        self.assertIn("scale 1000 (", self.ok("compare", case, "--check", "--wide"))
        table = self.ok("compare", case, "--set", "chain.scale=50", "--quiet")
        self.assertIn("chain-50", table)
        self.assertNotIn("chain-100", table)

    def test_writes_a_file_and_heeds_an_interrupt(self):
        case = self.slow_case()
        path = os.path.join(os.path.dirname(case), "out.nc")
        self.assertIn(path, self.ok("compare", case, "--scale", "50", "-o", path))
        with open(path, "rb") as file:
            self.assertEqual(file.read(8), b"\x89HDF\r\n\x1a\n")
        os.remove(path)
        errors = self.interrupted(path, "compare", case, "--scale", "30000", "--threads", "1")
        self.assertIn("interrupted", errors)

    def test_refuses(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        self.refused(2, "compare", says=["SCENARIO"])
        self.refused(2, "compare", case, "--scale", "0", says=["--scale"])
        self.refused(2, "compare", case, "--scale", "-3", says=["--scale"])
        self.refused(2, "compare", case, "--scale", "nan", says=["--scale"])
        self.refused(2, "compare", case, "--scale", "x", says=["--scale"])
        self.refused(2, "compare", case, "--scale", "7", "--scale", "7", says=["'7'", "twice"])
        self.refused(2, "compare", case, "--scale", "1e11", says=["GB"])  # before any level has run
        self.refused(2, "compare", case, "--set", "chain.spacing=0.9", says=["spacing"])
        self.refused(2, "compare", case, "--resume", "x.nc", says=["--resume"])
        self.refused(3, "compare", case, "-o", "/nowhere/o.nc", says=["/nowhere/o.nc"])


if __name__ == "__main__":
    unittest.main()
