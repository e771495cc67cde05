"""slipfront relations as a user meets it."""

import csv
import io
import json
import math
import unittest

from support import CommandLine

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

    def test_a_million_rows_and_any_number_of_threads(self):
        stdin = "".join(f"{0.05 + i * 1e-6:.8f}\n" for i in range(1000000))
        one = self.ok("relations", "--stress", "-", "--csv", "--threads", "1", stdin=stdin)
        self.assertEqual(one.count("\n"), 1000001)
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


if __name__ == "__main__":
    unittest.main()
