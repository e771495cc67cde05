"""slipfront pulse with several trains at one position, as a user meets it."""

import json
import math
import os
import unittest

from support import SOURCE, CommandLine, run

CASE = os.path.join(SOURCE, "cases/overtaking.toml")
SHORT = ("--set", "pulse.cells=100", "--set", "output.every=1.25", "--set", "time.end=3.75")


class Trains(CommandLine):
    def test_reports_what_a_pulse_reports(self):
        out = json.loads(self.ok("pulse", CASE, *SHORT, "--json"))
        self.assertEqual(out["warnings"], [])
        self.assertIsNone(out["first_crossing_time"])
        self.assertGreater(out["slip_at_origin"], 0.1)
        self.assertLess(out["conservation_error"], 1e-3)
        for key in ("slip_at_origin", "slip_velocity_at_origin", "trailing_characteristic", "leading_front", "energy_kinetic"):
            self.assertTrue(0 < out["errors"][key] < 0.05 * abs(out[key]), key)
        one = json.loads(self.ok("pulse", CASE, *SHORT, "--set", "pulse.trains=one", "--json"))
        self.assertEqual(set(one) | {"reasons"}, set(out))  # it lacks no number
        self.assertIsNotNone(one["first_crossing_time"])
        self.assertTrue(2e-3 < abs(out["slip_at_origin"] / one["slip_at_origin"] - 1) < 0.1)

    def test_a_step_is_the_exact_riemann_problem(self):
        exact = json.loads(self.ok("relations", "--stress", "0.855", "--stress-right", "0.179", "--json"))["relations"][0]
        out = json.loads(self.ok("pulse", os.path.join(SOURCE, "cases/shock.toml"), "--set", "pulse.trains=many", "--json"))
        end = 2 * math.pi
        self.assertAlmostEqual(out["leading_front"] / end, exact["leading_velocity"], 9)
        self.assertAlmostEqual(out["trailing_front"] / end, -exact["rupture_velocity"], 9)
        self.assertAlmostEqual(out["slip_at_origin"] / end, exact["slip"], 7)

    def test_tolerance_chooses_cells(self):
        out = json.loads(self.ok("pulse", CASE, "--set", "pulse.cells=50", "--set", "time.end=1", "--tolerance", "0.01", "--json"))
        self.assertGreaterEqual(out["cells"], 50)

    def test_resumes_to_a_later_end(self):
        whole, part = (os.path.join(os.path.dirname(self.file("x", "")), name) for name in ("whole.nc", "part.nc"))
        self.ok("pulse", CASE, *SHORT, "-o", whole)
        self.ok("pulse", CASE, *SHORT, "--set", "time.end=2.5", "-o", part)
        self.ok("pulse", CASE, *SHORT, "--resume", part)
        with open(whole, "rb") as a, open(part, "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_refuses_what_its_averages_do_not_know(self):
        for change, says in (("friction.law=coulomb", "friction is not viscous"), ("interface.contact=1+0.1*x^2", "contact"),
                             ("pulse.left=fixed", "wall"), ("pulse.periodic=true", "ring")):
            changes = ["--set", change] + (["--set", "friction.coefficient=1"] if "friction" in change else [])
            self.refused(2, "pulse", CASE, *changes, says=["pulse.trains = 'many'", says, 'trains = "one"'])
        self.refused(2, "pulse", CASE, "--set", "pulse.trains=two", says=["pulse.trains", "one", "many"])
        self.refused(2, "pulse", CASE, "--set", "pulse.trains=one", "--set", 'output.variables=["trains"]', says=["output.variables", "many"])

    def test_warns_where_friction_acts_on_three_trains(self):
        done = run("pulse", CASE, "--set", "friction.law=viscous", "friction.coefficient=0.2", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertIn("three trains are at x = ", done.stderr)
        self.assertIn("three trains are at x = ", " ".join(result["warnings"]))
        self.assertAlmostEqual(result["first_crossing_time"], 2.964, delta=0.01)

    def test_check_says_what_would_run(self):
        self.assertIn("100 cells", self.ok("pulse", CASE, *SHORT, "--check"))

    def test_a_chain_runs_the_same_scenario(self):
        out = json.loads(self.ok("chain", CASE, "--set", "chain.scale=20", "--set", "time.end=1", "--json"))
        self.assertGreater(out["dislocations"], 0)


if __name__ == "__main__":
    unittest.main()
