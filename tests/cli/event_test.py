"""slipfront event as a user meets it."""

import csv
import io
import json
import os
import unittest

from support import CommandLine, run, SOURCE

EVENT = ["name", "c_m_s", "rupture_velocity", "stress", "frictionless_slip_velocity", "observed_slip_velocity",
         "contact_ratio", "stress_pa", "damping_number", "warnings"]


class Event(CommandLine):
    def test_json_has_the_contract_keys(self):
        out = json.loads(self.ok("event", os.path.join(SOURCE, "cases/ets.toml"), os.path.join(SOURCE, "cases/parkfield-2004.toml"), "--json"))
        self.assertEqual(list(out), ["events"])
        ets, parkfield = out["events"]
        for event in (ets, parkfield):
            for key in EVENT:
                self.assertIn(key, event)
        self.assertAlmostEqual(ets["rupture_velocity"], 2.135e-5, 8)
        self.assertAlmostEqual(ets["slip_velocity_ratio"], 0.199, 3)
        self.assertAlmostEqual(parkfield["c_m_s"], 5421.0, 0)
        self.assertIsNone(parkfield["observed_slip_velocity"])
        self.assertIsNone(parkfield["damping_number"])

    def test_bad_rows_keep_the_good_ones(self):
        path = self.file("c.csv", "name,rupture_velocity_km_s\ngood,2.8\nfast,9\nword,x\ngood too,3\n")
        done = run("event", path, "--json")
        self.assertEqual(done.returncode, 2)
        events = json.loads(done.stdout)["events"]
        self.assertEqual([e["error"] is None for e in events], [True, False, False, True])
        self.assertEqual(done.stderr.count("\n"), 2)
        self.assertIn("c.csv:3: rupture_velocity = '9000 m/s'", done.stderr)
        self.assertIn("c.csv:4: rupture_velocity_km_s = 'x'", done.stderr)
        rows = list(csv.DictReader(io.StringIO(run("event", path, "--csv").stdout)))
        self.assertEqual(len(rows), 4)
        self.assertIn("error", run("event", path).stdout)

    def test_friction_and_errors(self):
        path = self.file("f.csv", "name,rupture_velocity,slip_velocity,contact_ratio,slip_velocity_is\n"
                         "known,3.0 +- 0.2 km/s,0.5 */ 1.2 m/s,0.01 +- 0.002,mean\n"
                         "unknown,3.0 +- 0.2 km/s,0.5 m/s,,\n"
                         "impossible,3.0 km/s,0.5 m/s,0.001,\n"
                         "word,gauss(3; 1) km/s,0.5 m/s,,\n"
                         "zero,3 +- 0 km/s,0.5 m/s,,\n")
        done = run("event", path, "--json")
        self.assertEqual(done.returncode, 2)
        known, unknown, impossible, word, zero = json.loads(done.stdout)["events"]
        low, high = known["damping_number_interval"]
        self.assertTrue(0 < low < known["damping_number"] < high)
        self.assertTrue(known["posterior"]["friction_identified"])
        self.assertIsNone(unknown["damping_number"])
        self.assertGreater(len(unknown["posterior"]["trade_off"]), 3)
        for event, says in ((impossible, "above what any friction leaves"), (word, "unknown distribution"), (zero, "uncertainty is 0")):
            self.assertIn(says, event["error"])
        one, two = (run("event", path, "--json", "--threads", n).stdout for n in "12")
        self.assertEqual(one, two)
        paper = json.loads(run("event", path, "--json", "--closure", "paper").stdout)["events"][0]
        self.assertGreater(paper["damping_number"], known["damping_number"])
        rows = list(csv.DictReader(io.StringIO(run("event", path, "--csv").stdout)))
        self.assertAlmostEqual(float(rows[0]["posterior_damping_number"]), known["damping_number"])
        self.assertFalse(any(None in row or None in row.values() for row in rows))

    def test_refuses_files(self):
        self.refused(3, "event", "/nowhere/x.csv", says=["/nowhere/x.csv", "No such file"])
        self.refused(3, "event", "/", says=["directory"])
        self.refused(2, "event", self.file("empty.csv", ""), says=["empty"])
        self.refused(2, "event", self.file("nu.toml", '[event]\nrupture_velocity = "3 km/s"\n[medium]\npoisson_ratio = 0.5\n'),
                     says=["poisson_ratio = '0.5", "-1 < poisson_ratio < 0.5"])
        self.refused(2, "event", self.file("unit.toml", '[event]\nrupture_velocity = "3 km"\n'), says=["unit.toml:2", "'3 km'"])
        self.refused(2, "event", self.file("cut.fsp", "% FINITE-SOURCE RUPTURE MODEL\n% Event : X 01/01/2000 [Y]\n"), says=["cut.fsp"])
        self.refused(2, "event", "--poisson-ratio", "0.7", self.file("a.csv", "name,rupture_velocity_km_s\nA,3\n"), says=["0.7"])
        self.refused(2, "event", "--p-wave-speed", "6", says=["--p-wave-speed", "unit"])

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_file_that_may_not_be_read(self):
        path = self.file("secret.csv", "name,slip_m\nA,1\n")
        os.chmod(path, 0)
        self.refused(3, "event", path, says=["Permission denied"])

    def test_a_file_that_fails_does_not_lose_the_others(self):
        done = run("event", "/nowhere.csv", os.path.join(SOURCE, "cases/ets.toml"), "--json")
        self.assertEqual(done.returncode, 3)
        self.assertEqual([e["stress"] is None for e in json.loads(done.stdout)["events"]], [True, False])

    def test_from_stdin_with_a_million_rows(self):
        stdin = "name,rupture_velocity_km_s,slip_velocity_m_s\n" + "E,2.8,0.5\n" * 1000000
        out = self.ok("event", "-", "--csv", "--quiet", stdin=stdin)
        self.assertEqual(out.count("\n"), 1000001)

    def test_reads_the_fsp_dialects(self):
        for name in ("fsp_srcmod_single.fsp", "fsp_dirty.fsp", "fsp_usgs_single.fsp", "fsp_usgs_segments.fsp"):
            event, = json.loads(self.ok("event", os.path.join(SOURCE, "tests/data", name), "--json"))["events"]
            self.assertGreater(event["stress"], 0, name)

    def fault(self, slip):
        """A .fsp of 9 columns of two subfaults, that slip by slip(column), ruptured from the middle at 2.5 km/s."""
        with open(os.path.join(SOURCE, "tests/data/fsp_srcmod_single.fsp")) as file:
            head = [line for line in file.read().split("\n") if line.startswith("%")]
        text = "\n".join(head).replace("Nx  =    3", "Nx  =    9").replace("Nsbfs =      6", "Nsbfs =     18")
        self.assertIn("SLIP      RAKE\n", text)
        text = text.replace("SLIP      RAKE\n", "SLIP      RAKE     TRUP     RISE\n")
        rows = [f" 35.0 -120.0 {2 * (i - 4)} 0.0 {0.5 + 2 * j} {slip(i)} 180.0 {abs(i - 4) * 2 / 2.5} 1.5"
                for j in range(2) for i in range(9)]
        return self.file("fault.fsp", text + "\n" + "\n".join(rows) + "\n")

    def test_pulse_through_a_finite_fault_model(self):
        path = self.fault(lambda i: 1.0)
        event, = json.loads(self.ok("event", path, "--pulse", "--json"))["events"]
        pulse = event["pulse"]
        self.assertIsNone(pulse["reason"])
        for key in ("x_m", "stress", "model_rupture_time_s", "pulse_front_time_s", "model_slip_m", "pulse_slip_m"):
            self.assertEqual(len(pulse[key]), 9, key)
        self.assertAlmostEqual(pulse["front_velocity_ratio"], 1, 5)  # avVr is the velocity of the rupture times
        self.assertAlmostEqual(pulse["stress"][3], event["stress"], 9)
        self.assertEqual(pulse["pulse_slip_m"][4], max(pulse["pulse_slip_m"]))
        for x, model, front in zip(pulse["x_m"], pulse["model_rupture_time_s"], pulse["pulse_front_time_s"]):
            self.assertAlmostEqual(model, abs(x) / 2500, 6)
            self.assertAlmostEqual(front, abs(x) / 2500, 3)
        self.assertIn("pulse: front velocity over the model's 1; ", self.ok("event", path, "--pulse", "--quiet"))
        self.assertNotIn("pulse", self.ok("event", path, "--quiet"))
        uneven, = json.loads(self.ok("event", self.fault(lambda i: 0.2 if i == 6 else 1.0), "--pulse", "--json"))["events"]
        self.assertGreater(uneven["pulse"]["pulse_front_time_s"][8], 1.2 * uneven["pulse"]["pulse_front_time_s"][0])

    def test_pulse_in_csv(self):
        path = self.fault(lambda i: 1.0 + 0.1 * i)
        event, = json.loads(self.ok("event", path, "--pulse", "--json"))["events"]
        row, none = csv.DictReader(io.StringIO(self.ok("event", path, os.path.join(SOURCE, "cases/ets.toml"), "--pulse", "--csv")))
        for key in ("front_velocity_ratio", "correlation_of_slip", "columns_reached", "slip_error", "contact_ratio"):
            self.assertEqual(float(row["pulse_" + key]), event["pulse"][key], key)
        self.assertEqual((row["pulse_columns"], row["pulse_reason"]), ("9", ""))
        self.assertEqual(none["pulse_columns"], "")
        self.assertIn("finite-fault", none["pulse_reason"])
        self.assertNotIn("pulse", self.ok("event", path, "--csv").split("\n")[0])

    def test_pulse_says_what_is_missing(self):
        for name, reason in (("tests/data/fsp_srcmod_single.fsp", "rupture times"), ("tests/data/fsp_usgs_single.fsp", "2 columns"),
                             ("tests/data/fsp_srcmod_segments.fsp", "no rupture velocity"), ("cases/ets.toml", "finite-fault")):
            path = os.path.join(SOURCE, name)
            event, = json.loads(self.ok("event", path, "--pulse", "--json"))["events"]
            self.assertIn(reason, event["pulse"]["reason"])
            self.assertIn("no pulse: ", self.ok("event", path, "--pulse", "--quiet"))

    def test_default_is_the_shipped_catalogue(self):
        table = self.ok("event")
        self.assertIn("Parkfield 2004", table)
        events = json.loads(self.ok("event", "--json"))["events"]
        self.assertGreaterEqual(len(events), 25)
        self.assertTrue(all(e["citation"] for e in events))
        self.assertGreaterEqual(sum(e["stress"] is not None for e in events), 25)
        velocities = [e["rupture_velocity_m_s"] for e in events if e["rupture_velocity_m_s"]]
        self.assertGreater(max(velocities) / min(velocities), 1e5)  # from great earthquakes to long-term slow slip


if __name__ == "__main__":
    unittest.main()
