"""slipfront riemann as a user meets it."""

import csv
import io
import json
import unittest

from support import CommandLine


class Riemann(CommandLine):
    def test_a_step_of_stress_becomes_the_slip_pulse(self):
        """The second route is `relations`, which evaluates the closed form (Eqs. 8-10)."""
        out = json.loads(self.ok("riemann", "--left", "1.03", "--right", "0", "--json"))
        pulse = json.loads(self.ok("relations", "--stress", "1.03", "--json"))["relations"][0]
        self.assertAlmostEqual(-out["left_wave"]["outer"] / pulse["rupture_velocity"], 1, 12)
        self.assertAlmostEqual(out["right_edge"] / pulse["leading_velocity"], 1, 12)
        self.assertEqual((out["left_wave"]["kind"], out["right_wave"]["kind"]), ("fan", "none"))
        rows = list(csv.DictReader(io.StringIO(self.ok("riemann", "--left", "1.03", "--right", "0", "--csv", "--points", "2001"))))
        self.assertEqual(len(rows), 2001)
        near = min(rows, key=lambda row: abs(float(row["x_over_t"])))
        self.assertAlmostEqual(float(near["W"]) / pulse["slip_velocity"], 1, 2)

    def test_shocks_conserve_dislocations(self):
        """The speed s of a shock obeys s [Sigma] = [W]."""
        out = json.loads(self.ok("riemann", "--left", "1,0.3", "--right", "0.5,-0.2", "--solution", "shocks", "--json"))
        self.assertIn("depend on the frame", out["warnings"][0])
        self.assertIn("depend on the frame", self.ok("riemann", "--left", "1,0.3", "--right", "0.5,-0.2", "--solution", "shocks"))
        self.assertEqual(json.loads(self.ok("riemann", "--left", "1", "--right", "0", "--solution", "shocks", "--json"))["warnings"], [])
        self.assertNotIn("waves", out)
        for side in ("left", "right"):
            wave, state, star = out[side + "_wave"], out[side], out["star"]
            self.assertEqual(wave["kind"], "shock")
            self.assertAlmostEqual(wave["outer"] * (star["Sigma"] - state["Sigma"]), star["W"] - state["W"], 12)
        self.assertGreater(out["star"]["Sigma"], 1)

    def test_two_trains_where_dislocations_overtake_each_other(self):
        """Numbers of docs/theory/9_trains.md."""
        asked = ["riemann", "--left", "1,0.3", "--right", "0.5,-0.2"]
        out = json.loads(self.ok(*asked, "--json"))
        self.assertEqual([(wave["kind"], wave["trains"]) for wave in out["waves"]], [("two-trains", 2), ("constant", 2), ("two-trains", 2)])
        for wave, after in zip(out["waves"], out["waves"][1:]):
            self.assertEqual(wave["to"], after["from"])
        self.assertEqual((out["waves"][0]["from"], out["waves"][2]["to"]), (out["left_edge"], out["right_edge"]))
        self.assertAlmostEqual(out["at_origin"]["stress"], 1.163300692, 9)
        self.assertAlmostEqual(out["at_origin"]["slip_velocity"], 0.201413471, 9)
        self.assertEqual(out["at_origin"]["trains"], 2)
        self.assertAlmostEqual(sum(train["W"] for train in out["at_origin"]["each"]), out["at_origin"]["slip_velocity"], 15)
        self.assertIn("at x = 0: two trains", self.ok(*asked))
        rows = list(csv.DictReader(io.StringIO(self.ok(*asked, "--csv", "--points", "41"))))
        self.assertEqual({row["trains"] for row in rows}, {"1", "2"})
        for row in rows:
            self.assertEqual(row["W_2"] != "", row["trains"] == "2")
            self.assertAlmostEqual(sum(float(row[name] or 0) for name in ("Sigma_1", "Sigma_2")), float(row["Sigma"]), 12)

    def test_a_vacuum_between_trains_that_part(self):
        out = json.loads(self.ok("riemann", "--left", "1,-0.9", "--right", "1,0.9", "--json"))
        self.assertEqual([(wave["kind"], wave["trains"]) for wave in out["waves"]], [("fan", 1), ("vacuum", 0), ("fan", 1)])
        self.assertEqual(out["at_origin"], {"stress": 0, "slip_velocity": 0, "trains": 0, "each": []})

    def test_mirrored_trains_have_mirrored_waves(self):
        one = json.loads(self.ok("riemann", "--left", "1,-0.3", "--right", "0.5,0.1", "--json"))
        other = json.loads(self.ok("riemann", "--left", "0.5,-0.1", "--right", "1,0.3", "--json"))
        self.assertAlmostEqual(one["star"]["Sigma"], other["star"]["Sigma"], 12)
        self.assertAlmostEqual(one["left_wave"]["inner"], -other["right_wave"]["inner"], 12)

    def test_si_units(self):
        asked = ["riemann", "--left", "1", "--right", "0.5", "--json"]
        model, si = json.loads(self.ok(*asked)), json.loads(self.ok(*asked, "--si", "--contact-ratio", "0.003"))
        c = si["left_edge"] / model["left_edge"]
        self.assertAlmostEqual(c / 5421, 1, 2)  # sqrt(2 / (1 - nu)) of the S speed 3207 m/s
        self.assertEqual(si["units"], {"U": "m s-1", "Sigma": "Pa", "W": "m s-1", "edges": "m s-1"})
        self.assertAlmostEqual(si["star"]["Sigma"] / model["star"]["Sigma"] / (30e9 * 0.003 / 3.141592653589793), 1, 12)
        self.assertIn("Pa", self.ok(*asked[:-1], "--si", "--contact-ratio", "0.003"))

    def test_equal_trains_and_trains_that_part(self):
        self.assertIn("all", self.ok("riemann", "--left", "1,0.2", "--right", "1,0.2"))
        self.assertIn("between", self.ok("riemann", "--left", "1,-0.9", "--right", "1,0.9"))
        apart = json.loads(self.ok("riemann", "--left", "1,-0.9", "--right", "1,0.9", "--json"))
        self.assertEqual(apart["star"]["Sigma"], 0)

    def test_a_zero_has_no_sign(self):
        for left, right in (("1", "0"), ("0", "1"), ("1", "1")):
            for solution in ("trains", "shocks"):
                self.assertNotIn("-0.0,", self.ok("riemann", "--left", left, "--right", right, "--solution", solution, "--json").replace("}", ","))

    def test_refuses(self):
        for left, right, words in [("1,1", "0", ["--left", "velocity", "0.999999"]), ("0", "0", ["empty"]), ("1", "x", ["--right", "STRESS,U"]),
                                   ("1e-5", "1", ["--left", "0.0045"]), ("1", "1e7", ["--right", "1e6"]), ("1,", "1", ["STRESS,U"]), ("nan", "1", ["--left"])]:
            with self.subTest(left=left, right=right):
                self.refused(2, "riemann", "--left", left, "--right", right, says=["command line", *words])
        self.refused(2, "riemann", "--left", "1", "--right", "0", "--solution", "x", says=["--solution"])
        self.refused(2, "riemann", "--left", "1", says=["--right"])
        self.refused(2, "riemann", "--left", "1", "--right", "0", "--points", "1", says=["--points"])
        self.refused(2, "riemann", "--left", "1", "--right", "0", "--si", says=["--contact-ratio"])


if __name__ == "__main__":
    unittest.main()
