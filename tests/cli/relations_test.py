"""slipfront relations as a user meets it."""

import csv
import io
import json
import math
import os
import unittest

from support import SOURCE, CommandLine

RELATIONS = ["stress", "rupture_velocity", "leading_velocity", "velocity_ratio", "slip_velocity", "stress_at_origin",
             "dislocation_velocity_at_origin", "psi", "psi_at_origin"]


class Relations(CommandLine):
    def test_json_has_the_nine_keys_in_input_order(self):
        out = json.loads(self.ok("relations", "--rupture-velocity", "0.5", "--stress", "1.03", "--rupture-velocity", "1e-300",
                                 "--slip-velocity", "0.1", "--json"))
        self.assertEqual(list(out), ["relations"])
        rows = out["relations"]
        self.assertEqual(len(rows), 4)
        for row in rows:
            self.assertEqual(list(row), RELATIONS)
            self.assertTrue(all(math.isfinite(x) and x > 0 for x in row.values()))
        self.assertEqual(rows[0]["rupture_velocity"], 0.5)
        self.assertEqual(rows[1]["stress"], 1.03)
        self.assertAlmostEqual(rows[1]["slip_velocity"], 0.1000039, 7)
        self.assertEqual(rows[2]["rupture_velocity"], 1e-300)
        self.assertEqual(rows[3]["slip_velocity"], 0.1)

    def test_ranges_and_csv(self):
        rows = list(csv.DictReader(io.StringIO(self.ok("relations", "--stress", "0.5:1.5:5", "--csv"))))
        self.assertEqual([float(r["stress"]) for r in rows], [0.5, 0.75, 1.0, 1.25, 1.5])
        rows = json.loads(self.ok("relations", "--rupture-velocity", "1e-300:1e-1:300:log", "--json"))["relations"]
        self.assertEqual(len(rows), 300)
        self.assertEqual((rows[0]["rupture_velocity"], rows[-1]["rupture_velocity"]), (1e-300, 0.1))

    def test_from_stdin(self):
        out = json.loads(self.ok("relations", "--stress", "-", "--json", stdin="1.03  # Parkfield\n\n 0.213\r\n"))
        self.assertEqual([r["stress"] for r in out["relations"]], [1.03, 0.213])

    def test_many_rows_and_any_number_of_threads(self):
        stdin = "".join(f"{0.05 + i * 1e-5:.8f}\n" for i in range(100000))
        one = self.ok("relations", "--stress", "-", "--csv", "--threads", "1", stdin=stdin)
        self.assertEqual(one.count("\n"), 100001)
        self.assertEqual(one, self.ok("relations", "--stress", "-", "--csv", "--threads", "3", stdin=stdin))

    def test_full_precision_for_one_state(self):
        self.assertIn("0.5439026079081", self.ok("relations", "--stress", "1.03"))

    def test_refuses(self):
        for option, value in [("--stress", "0"), ("--stress", "-1"), ("--stress", "nan"), ("--stress", "inf"), ("--stress", "1e400"),
                              ("--stress", "abc"), ("--stress", ""), ("--rupture-velocity", "1"), ("--rupture-velocity", "1.5"),
                              ("--slip-velocity", "0"), ("--slip-velocity", "1e308"), ("--stress", "1e-3"), ("--stress", "1:2"),
                              ("--stress", "1:2:0"), ("--stress", "1:2:1e30"), ("--stress", "0:2:5:log"), ("--stress", "0:1:3")]:
            with self.subTest(option=option, value=value):
                self.refused(2, "relations", option, value, says=["allowed: ", "command line: "])
        self.refused(2, "relations", says=["--stress"])
        self.refused(2, "relations", "--stress", says=["--help"])
        self.refused(2, "relations", "--strain", "1", says=["--strain"])
        self.refused(2, "relations", "--stress", "1", "--json", "--csv")
        self.refused(2, "relations", "--stress", "1", "--threads", "0")
        self.refused(2, "nonsense")
        self.refused(2, "relations", "--stress", "-", stdin="1\n2\nx\n", says=["stdin:3", "'x'"])
        self.refused(2, "relations", "--stress", "-", stdin="1\n-2\n", says=["stdin:2", "stress = '-2'"])
        self.refused(2, "relations", "--stress", "-", stdin="", says=["stdin"])
        self.refused(2, "relations", "--stress", "-", "--stress", "-", stdin="1\n")

    def test_stress_ahead_of_the_leading_front(self):
        """Numbers of docs/theory/9_trains.md."""
        row = json.loads(self.ok("relations", "--stress", "0.855", "--stress-right", "0.179", "--json"))["relations"][0]
        self.assertAlmostEqual(row["leading_velocity"], 0.1207373, 7)
        self.assertAlmostEqual(row["slip_velocity"], 0.0442333337, 10)
        self.assertEqual((row["slip"], row["trains_at_origin"]), (row["slip_velocity"], 2))
        closed = json.loads(self.ok("relations", "--stress", "0.855", "--json"))["relations"][0]
        empty = json.loads(self.ok("relations", "--stress", "0.855", "--stress-right", "0", "--json"))["relations"][0]
        for name in ("rupture_velocity", "leading_velocity", "slip_velocity", "stress_at_origin"):
            self.assertAlmostEqual(empty[name] / closed[name], 1, 12)
        self.assertEqual(row["rupture_velocity"], closed["rupture_velocity"])
        table = self.ok("relations", "--stress", "0.855", "--stress", "1.03", "--stress-right", "0.179")
        self.assertIn("ahead", table)
        self.assertIn("0.0442333", table)
        for arguments, says in [(("--stress", "0.1"), "larger"), (("--slip-velocity", "0.1"), "only --stress"),
                                (("--stress", "1", "--slip-velocity-ratio", "0.5"), "friction")]:
            self.refused(2, "relations", *arguments, "--stress-right", "0.179", says=[says])

    def test_numbers_with_units(self):
        speed = 5421.3  # c, from 6 km/s and a Poisson's ratio of 0.3
        row = json.loads(self.ok("relations", "--rupture-velocity", "2.7 km/s", "--json"))["relations"][0]
        self.assertAlmostEqual(row["rupture_velocity"] * speed / 2700, 1, 4)
        rock = ("--si", "--contact-ratio", "0.003")
        for option, text, key, value in (("--stress", "30 MPa", "stress", 30e6), ("--slip-velocity", "50 cm/s", "slip_velocity", 0.5),
                                         ("--rupture-velocity", "2.7 km/s", "rupture_velocity", 2700)):
            row = json.loads(self.ok("relations", option, text, *rock, "--json"))["relations"][0]
            self.assertAlmostEqual(row[key] / value, 1, 12)
        self.refused(2, "relations", "--stress", "30 MPa", says=["--stress = '30 MPa'", "--si --contact-ratio"])
        self.refused(2, "relations", "--rupture-velocity", "2.7 km", says=["the unit 'km' is not that of a velocity"])
        self.refused(2, "relations", "--rupture-velocity", "2.7", says=["= '2.7': too large"])
        self.refused(2, "relations", "--stress", "1", "--stress-right", "x", says=["--stress-right", "'x'"])

    def test_friction_coefficient_from_a_ratio_and_back(self):
        forward = json.loads(self.ok("relations", "--stress", "0.855", "--stress", "0.3", "--friction-coefficient", "0.5", "--json"))
        self.assertEqual([(row["stress"], row["closure"]) for row in forward["friction"]],
                         [(0.855, "consistent"), (0.855, "paper"), (0.3, "consistent"), (0.3, "paper")])
        for row in forward["friction"]:
            back = json.loads(self.ok("relations", "--stress", str(row["stress"]), "--slip-velocity-ratio", repr(row["slip_velocity_ratio"]), "--json"))
            found = next(other for other in back["friction"] if other["closure"] == row["closure"])
            self.assertAlmostEqual(found["friction_coefficient"], 0.5, 9)
            self.assertLess(found["friction_coefficient_error"], 0.02)
            self.assertAlmostEqual(found["slip_velocity"], row["slip_velocity"], 12)
            self.assertAlmostEqual(found["front_ratio"], row["front_ratio"], 9)
            self.assertAlmostEqual(found["stress_drop_share"], row["stress_drop_share"], 9)
            self.assertTrue(0.99 < row["front_ratio"] < 1)
            self.assertTrue(0.1 < row["stress_drop_share"] < 0.3)

    def test_friction_is_that_of_the_pulse_solver(self):
        rows = json.loads(self.ok("relations", "--stress", "0.855", "--friction-coefficient", "0.1", "--friction-coefficient", "0.5", "--json"))["friction"]
        for row in rows:
            run = self.pulse(os.path.join(SOURCE, "cases", "step.toml"), "--set", "friction.law=viscous", "--set", f"friction.coefficient={row['friction_coefficient']}",
                             "--set", f"friction.closure={row['closure']}")
            self.assertLess(abs(row["slip_velocity"] / run["slip_velocity_at_origin"] - 1), max(1e-4, row["slip_velocity_ratio_error"] / row["slip_velocity_ratio"]))

    def test_only_the_damping_number_counts(self):
        rows = [json.loads(self.ok("relations", "--rupture-velocity", "0.55", "--friction-coefficient", c, "--time", t, "--json"))["friction"] for c, t in (("0.5", "4"), ("2", "1"))]
        for one, other in zip(*rows):
            self.assertEqual(one["slip_velocity"], other["slip_velocity"])
        table = self.ok("relations", "--stress", "0.855", "--slip-velocity-ratio", "0.2", "--measure", "time-mean")
        self.assertIn("time-mean", table)
        self.assertEqual(len(list(csv.DictReader(io.StringIO(self.ok("relations", "--stress", "0.855", "--slip-velocity-ratio", "0.2", "--csv"))))), 2)

    def test_friction_refuses(self):
        for arguments, says in [(("--slip-velocity-ratio", "1.5"), "at most 1"), (("--slip-velocity-ratio", "0"), "above 0"), (("--slip-velocity-ratio", "nan"), "above 0"),
                                (("--friction-coefficient", "-1"), ">= 0"), (("--friction-coefficient", "inf"), "finite"), (("--friction-coefficient", "1", "--time", "0"), "--time"),
                                (("--friction-coefficient", "1", "--measure", "top"), "time-mean")]:
            self.refused(2, "relations", "--stress", "0.855", *arguments, says=["command line", says])
        self.refused(2, "relations", "--stress", "5", "--friction-coefficient", "1", says=["0.05 ... 3"])
        self.refused(2, "relations", "--friction-coefficient", "1", says=["--stress"])


if __name__ == "__main__":
    unittest.main()
