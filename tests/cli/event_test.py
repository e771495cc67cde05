"""The command `slipfront event` as a user runs it."""

import csv
import io
import json
import os
import signal
import subprocess
import tempfile
import unittest

from support import PATIENCE, PROGRAM, SANITIZED, SOURCE, CommandLine, run, until_it_answers, until_it_has_worked

EVENT = ["name", "c_m_s", "rupture_velocity", "stress", "frictionless_slip_velocity", "observed_slip_velocity",
         "contact_ratio", "stress_pa", "damping_number", "warnings"]


class Event(CommandLine):
    def test_json_has_the_contract_keys(self):
        out = json.loads(self.ok("event", os.path.join(SOURCE, "cases/ets.toml"), os.path.join(SOURCE, "cases/parkfield-2004.toml"), "--json"))
        self.assertEqual(list(out), ["events", "ignored_columns", "ignored_quantities", "tables"])
        ets, parkfield = out["events"]
        for event in (ets, parkfield):
            for key in EVENT:
                self.assertIn(key, event)
        self.assertAlmostEqual(ets["rupture_velocity"], 2.135e-5, 8)
        self.assertAlmostEqual(ets["slip_velocity_ratio"], 0.199, 3)
        self.assertAlmostEqual(parkfield["c_m_s"], 5421.0, 0)
        self.assertIsNone(parkfield["observed_slip_velocity"])
        self.assertIsNone(parkfield["damping_number"])

    def test_bad_rows_do_not_lose_the_good_ones(self):
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

    def test_columns_that_are_not_understood_are_named_in_every_output(self):
        path = self.file("k.csv", "name,Vr (km/s),Er (J),fc,Mw,remark\nA,2.7,1e12,0.3,7,good\n")
        done = run("event", path, "--json")
        self.assertEqual(done.returncode, 0)
        out = json.loads(done.stdout)
        self.assertEqual(out["ignored_columns"], ["Er (J)", "fc", "remark"])
        self.assertEqual(out["ignored_quantities"], ["Er (J)", "fc"])
        self.assertEqual(out["tables"][0]["file"], path)
        for options in ([], ["--csv"]):
            done = run("event", path, *options)
            self.assertIn("k.csv: columns that look like quantities and are not understood: Er (J), fc", done.stderr)
            self.assertIn("ignored: remark", done.stderr)
        self.assertIn("Er (J), fc", run("event", path).stdout)
        self.assertEqual(run("event", path, "--csv", "--quiet").stderr, "")

    def test_strict_refuses_the_whole_file(self):
        unknown = self.file("u.csv", "name,Vr (km/s),Er (J)\nA,2.7,1e12\n")
        done = run("event", unknown, "--strict")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("u.csv: Er (J): a column that looks like a quantity and is not understood", done.stderr)
        for row, says in (("B,x", "b.csv:3: Vr (km/s) = 'x': not a finite number"), ("B,9", "not below the speed c")):
            bad = self.file("b.csv", f"name,Vr (km/s)\nA,2.7\n{row}\n")
            done = run("event", bad, "--strict", "--json")
            self.assertEqual(done.returncode, 2)
            self.assertEqual(len(json.loads(done.stdout)["events"]), 1)
            self.assertIn(says, done.stderr)
        self.ok("event", self.file("g.csv", "name,Vr (km/s)\nA,2.7\n"), "--strict")

    def test_a_map_names_columns(self):
        table = self.file("m.csv", "Ort;A1;A2\nX;2,7;0,2\n")
        mapped = self.file("map.toml", 'decimal = ","\n[columns]\n"Ort" = "name"\n"A1" = "rupture_velocity km/s"\n'
                           '"A2" = "error of rupture_velocity"\n')
        event = json.loads(self.ok("event", table, "--columns", mapped, "--json", "--samples", "0"))["events"][0]
        self.assertEqual((event["name"], event["rupture_velocity_m_s"]), ("X", 2700))
        self.assertIsNotNone(event["rupture_velocity_interval"])
        wrong = self.file("wrong.toml", '[columns]\n"A1" = "rupture_velocty km/s"\n')
        done = run("event", table, "--columns", wrong)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("wrong.toml:2: columns.A1 = 'rupture_velocty': unknown quantity; allowed: 'rupture_velocity'", done.stderr)
        self.assertEqual(run("event", table, "--columns", "none.toml").returncode, 3)

    def test_files_of_other_kinds_are_named(self):
        fsp = os.path.join(SOURCE, "cases", "synthetic-fault.fsp")
        source = os.path.join(os.path.dirname(self.file("x", "")), "s.srf")
        self.ok("event", fsp, "-o", source)
        for arguments, kind in ((("chain", source), "a kinematic source (SRF): slipfront reads no such file as a scenario; allowed: slipfront event"),
                                (("event", os.path.join(SOURCE, "cases", "step.toml")), "a scenario: slipfront reads no such file as events; allowed: slipfront pulse"),
                                (("chain", fsp), "a finite-fault model: slipfront reads no such file as a scenario; allowed: slipfront event"),
                                (("pulse", fsp), "a finite-fault model")):
            with self.subTest(arguments):
                done = run(*arguments)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
                self.assertIn(f"{arguments[1]}: this is {kind}", done.stderr)

    def test_a_missing_unit_is_named_once(self):
        done = run("event", self.file("u.csv", "name,Duration,slip_cm\n" + "".join(f"e{i},{i + 3},3\n" for i in range(30))))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("u.csv:1: Duration: no unit in the title, below it or in its cells; allowed: a title with the unit, such as 'Duration (s)'", done.stderr)

    def test_a_bound_is_no_value(self):
        path = self.file("bound.csv", "name,Vr (km/s),slip velocity (m/s)\nA,<2.7,0.5\n")
        event = json.loads(self.ok("event", path, "--json"))["events"][0]
        self.assertIsNone(event["rupture_velocity_m_s"])
        self.assertEqual(event["bounds"], [{"quantity": "rupture_velocity", "below": 2700}])
        self.assertIn("rupture_velocity is only bounded (<2.7): not used as a value", event["warnings"])

    def test_friction_and_errors(self):
        path = self.file("f.csv", "name,rupture_velocity,slip_velocity,contact_ratio,slip_velocity_is,rupture_velocity_is\n"
                         "known,3.0 +- 0.2 km/s,0.5 */ 1.2 m/s,0.01 +- 0.002,mean,\n"
                         "unknown,3.0 +- 0.2 km/s,0.5 m/s,,,characteristic\n"
                         "impossible,3.0 km/s,0.5 m/s,0.001,,\n"
                         "word,gauss(3; 1) km/s,0.5 m/s,,,\n"
                         "zero,3 +- 0 km/s,0.5 m/s,,,\n")
        done = run("event", path, "--json")
        self.assertEqual(done.returncode, 2)
        known, unknown, impossible, word, zero = json.loads(done.stdout)["events"]
        low, high = known["damping_number_interval"]
        self.assertTrue(0 < low < known["damping_number"] < high)
        self.assertTrue(known["posterior"]["friction_identified"])
        self.assertIsNone(unknown["damping_number"])
        self.assertGreater(len(unknown["posterior"]["trade_off"]), 3)
        for event, says in ((impossible, "above that without friction"), (word, "unknown distribution"), (zero, "uncertainty is 0")):
            self.assertIn(says, event["error"])
        one, two = (run("event", path, "--json", "--threads", n).stdout for n in "12")
        self.assertEqual(one, two)
        paper = json.loads(run("event", path, "--json", "--closure", "paper").stdout)["events"][0]
        self.assertGreater(paper["damping_number"], known["damping_number"])
        rows = list(csv.DictReader(io.StringIO(run("event", path, "--csv").stdout)))
        self.assertAlmostEqual(float(rows[0]["posterior_damping_number"]), known["damping_number"])
        self.assertFalse(any(None in row or None in row.values() for row in rows))

    def test_one_answer_everywhere(self):
        """If a quantity has only a bound, table, JSON, CSV and file all give the bound. Its interval includes every error."""
        path = self.file("t.toml", '[event]\nname = "Tohoku 2011"\nrupture_velocity = "2.0 +- 0.4 km/s"\nslip = "12 */ 1.5 m"\nrise_time = "40 */ 1.4 s"\n'
                         'rupture_velocity_is = "characteristic"\n'
                         '[medium]\nshear_modulus = "40 GPa"\n')
        event, = json.loads(self.ok("event", path, "--json"))["events"]
        self.assertIsNone(event["stress_pa"])
        self.assertIsNone(event["posterior"]["stress_pa"])
        low, high = event["stress_pa_bound_interval"]
        self.assertTrue(15e6 < low < 20e6 and 36e6 < event["stress_pa_bound"] < 44e6 and 100e6 < high < 130e6, event["stress_pa_bound_interval"])
        self.assertEqual(event["posterior"]["slip_velocity_is"], "time-mean")
        self.assertTrue(event["posterior"]["suffices"])
        self.assertLess(event["posterior"]["pareto_k"], 0.7)
        row, = csv.DictReader(io.StringIO(self.ok("event", path, "--csv")))
        self.assertEqual([float(row["stress_pa_bound" + end]) for end in ("", "_low", "_high")], [event["stress_pa_bound"], low, high])
        self.assertEqual(row["stress_pa"], "")
        self.assertIn(f">={event['stress_pa_bound'] / 1e6:.4g}", self.ok("event", path, "--wide"))
        self.assertIn(f"is at least {event['stress_pa_bound'] / 1e6:.4g} MPa", self.ok("event", path))
        folder = os.path.dirname(path)
        self.refused(2, "event", path, "--draws", "9", says=["--draws", "-o OUT.nc"])
        self.refused(2, "event", path, "--draws", "9", "-o", os.path.join(folder, "a.csv"), says=["OUT.nc, with --draws"])
        self.ok("event", path, "--draws", "9", "-o", os.path.join(folder, "a.nc"))
        self.ok("event", path, "--draws", "9", "--resume", os.path.join(folder, "a.nc"))
        self.refused(2, "event", path, "--draws", "8", "--resume", os.path.join(folder, "a.nc"), says=["another posterior_draws"])

    def test_a_front_that_was_seen(self):
        """The two velocities of an observed front bound A on both sides. Equal rows have equal answers, whatever their names."""
        path = self.file("s.csv", "name,rupture_velocity,slip,duration,rupture_velocity_is\na,10 km/day,4 mm,14 days,\n"
                         "b,10 km/day,4 mm,14 days,front\nc,10 km/day,4 mm,14 days,characteristic\n")
        a, b, c = json.loads(self.ok("event", path, "--json"))["events"]
        self.assertEqual(a["rupture_velocity_is"], "front")
        self.assertEqual(a["contact_ratio_interval"], b["contact_ratio_interval"])
        low, high = a["contact_ratio_interval"]
        self.assertTrue(8e-6 < low < 2e-5 < high < 4e-5)
        self.assertIsNone(a["contact_ratio_bound"])
        self.assertIsNone(c["stress_pa"])
        self.assertAlmostEqual(c["contact_ratio_bound"] / 7.96e-6, 1, 3)

    def test_observations_that_exclude_each_other(self):
        path = self.file("x.csv", "name,rupture_velocity,slip_velocity,contact_ratio\nx,3 */ 1.1 km/s,0.5 */ 1.1 m/s,0.0005 */ 1.1\n")
        event, = json.loads(self.ok("event", path, "--json"))["events"]
        self.assertIsNone(event["contact_ratio"])
        self.assertIsNone(event["stress_pa"])
        self.assertTrue(event["posterior"]["contradicted"])
        self.assertEqual({t["observation"] for t in event["tension"]}, {"rupture_velocity", "slip_velocity", "contact_ratio"})
        for tension in event["tension"]:
            self.assertTrue(tension["sigmas"] is None or abs(tension["sigmas"]) >= 2)
            self.assertIsNotNone(tension["without"]["stress_interval"])
        self.assertIn("standard deviations", self.ok("event", path))

    def test_sources_that_disagree(self):
        table = self.ok("event", os.path.join(SOURCE, "cases/catalogue.csv"), os.path.join(SOURCE, "cases/parkfield-2004.toml"))
        self.assertIn("sources of loma, 1989-10-18, disagree: stress from 81.1 MPa", table)
        self.assertIn("sources of parkfield, 2004-09-28, disagree: stress from 4.74 MPa", table)

    def folder_of(self, texts):
        """Returns a new folder with these texts by their names."""
        folder = tempfile.mkdtemp(dir=os.path.dirname(self.file("x", "")))
        for name, text in texts.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        return folder

    def test_a_folder_is_one_event_with_several_sources(self):
        detail = {"type": "Feature", "id": "x", "properties": {"title": "M 7.0 - Nowhere", "time": 1700000000000, "products": {
            "finite-fault": [{"properties": {"average-rupture-velocity": "3.1", "average-rise-time": "5"}}]}}}
        texts = {"detail.json": json.dumps(detail), "readme.txt": "hello", "picture.png": "\0\1\2\3"}
        for name in ("subfaults.geojson", "subfaults.param"):
            with open(os.path.join(SOURCE, "tests/data", name), encoding="utf-8") as file:
                texts["FFM" + os.path.splitext(name)[1]] = file.read()
        with open(os.path.join(SOURCE, "cases/synthetic-fault.fsp"), encoding="utf-8") as file:
            texts["model.fsp"] = file.read()
        folder = self.folder_of(texts)
        os.mkdir(os.path.join(folder, "maps"))
        events = json.loads(self.ok("event", folder, "--json", "--samples", "0"))["events"]
        self.assertEqual([e["name"] for e in events], [f"{name}: M 7.0 - Nowhere" for name in ("FFM.geojson", "FFM.param", "detail.json", "model.fsp")])
        for event in events:
            self.assertTrue(any(w.startswith(f"sources of {folder} disagree: stress from") for w in event["warnings"]))
            self.assertIn(f"sources of one event in {folder}: 4; not read: maps, picture.png, readme.txt", event["warnings"])
        strict = run("event", folder, "--strict", "--samples", "0")
        self.assertEqual((strict.returncode, strict.stderr.count("\n")), (2, 3), strict.stderr)

    def test_refuses_files(self):
        self.refused(3, "event", "/nowhere/x.csv", says=["/nowhere/x.csv", "No such file"])
        self.refused(3, "event", os.path.join(self.folder_of({}), ""), says=["a folder without files"])
        self.refused(2, "event", self.folder_of({"a.txt": "hello"}), says=["a.txt", "no line has the titles"])
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

    def test_reads_tens_of_thousands_of_rows_from_stdin(self):
        rows = 2000 if SANITIZED else 12000
        stdin = "name,rupture_velocity_km_s,slip_velocity_m_s\n" + "E,2.8,0.5\n" * rows
        out = self.ok("event", "-", "--csv", "--quiet", stdin=stdin)
        self.assertEqual(out.count("\n"), rows + 1)

    def test_reads_the_fsp_dialects(self):
        for name in ("fsp_srcmod_single.fsp", "fsp_dirty.fsp", "fsp_usgs_single.fsp", "fsp_usgs_segments.fsp"):
            event, = json.loads(self.ok("event", os.path.join(SOURCE, "tests/data", name), "--json"))["events"]
            self.assertGreater(event["stress"], 0, name)

    def fault(self, slip):
        """A .fsp file with 9 columns of two subfaults, which slip by slip(column). Rupture starts in the middle and runs at 2.5 km/s."""
        with open(os.path.join(SOURCE, "tests/data/fsp_srcmod_single.fsp")) as file:
            head = [line for line in file.read().split("\n") if line.startswith("%")]
        text = "\n".join(head).replace("Nx  =    3", "Nx  =    9").replace("Nsbfs =      6", "Nsbfs =     18")
        self.assertIn("SLIP      RAKE\n", text)
        text = text.replace("SLIP      RAKE\n", "SLIP      RAKE     TRUP     RISE\n")
        rows = [f" 35.0 -120.0 {2 * (i - 4)} 0.0 {0.5 + 2 * j} {slip(i)} 180.0 {abs(i - 4) * 2 / 2.5} 1.5"
                for j in range(2) for i in range(9)]
        return self.file("fault.fsp", text + "\n" + "\n".join(rows) + "\n")

    @unittest.skipIf(SANITIZED, "test_pulse_in_csv runs the same")
    def test_pulse_through_a_finite_fault_model(self):
        path = self.fault(lambda i: 1.0)
        event, = json.loads(self.ok("event", path, "--pulse", "--json"))["events"]
        pulse = event["pulse"]
        self.assertIsNone(pulse["reason"])
        for key in ("x_m", "stress", "model_rupture_time_s", "pulse_front_time_s", "model_slip_m", "pulse_slip_m"):
            self.assertEqual(len(pulse[key]), 9, key)
        self.assertAlmostEqual(pulse["front_velocity_ratio"], 1, 5)  # avVr is the velocity of the rupture times
        at_front, = json.loads(self.ok("relations", "--rupture-velocity", repr(event["rupture_velocity"]), "--json"))["relations"]
        self.assertAlmostEqual(pulse["stress"][3], at_front["stress"], 9)  # a pulse without friction
        self.assertEqual(pulse["pulse_slip_m"][4], max(pulse["pulse_slip_m"]))
        for x, model, front in zip(pulse["x_m"], pulse["model_rupture_time_s"], pulse["pulse_front_time_s"]):
            self.assertAlmostEqual(model, abs(x) / 2500, 6)
            self.assertAlmostEqual(front, abs(x) / 2500, 3)
        self.assertIn("pulse: front velocity over the model's 1; ", self.ok("event", path, "--pulse", "--quiet", "--wide"))
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

    def test_the_reason_for_no_pulse_is_given(self):
        for name, reason in (("tests/data/fsp_srcmod_single.fsp", "rupture times"), ("tests/data/fsp_usgs_single.fsp", "2 columns"),
                             ("tests/data/fsp_srcmod_segments.fsp", "no rupture velocity"), ("cases/ets.toml", "finite-fault")):
            path = os.path.join(SOURCE, name)
            event, = json.loads(self.ok("event", path, "--pulse", "--json"))["events"]
            self.assertIn(reason, event["pulse"]["reason"])
            self.assertIn("no pulse: ", self.ok("event", path, "--pulse", "--quiet"))

    def catalogue(self, rows):
        """A catalogue whose rows need samples, with rupture velocities over seven decades. Every tenth row is bad."""
        kinds = ["{0:.6g} +- {1:.3g} m/s,{2:.3g} */ 1.5 m/s,", "{0:.6g} +- {1:.3g} m/s,,1e-3 */ 2"]
        lines = ["9 km/s,,0.01 +- 0.001" if i % 10 == 9 else kinds[i % 2].format(v, v / 10, v * 1e-4)
                 for i in range(rows) for v in [10 ** (-3.5 + 7 * i / rows)]]
        return self.file("catalogue.csv", "name,rupture_velocity,slip_velocity,contact_ratio\n" + "".join(f"E{i},{line}\n" for i, line in enumerate(lines)))

    def test_output_files_have_the_results_that_are_printed(self):
        case = self.catalogue(100)
        beside = lambda name: os.path.join(os.path.dirname(case), name)
        whole = run("event", case, "-o", beside("a.nc"))
        self.assertEqual(whole.returncode, 2)  # because of the bad rows
        self.assertIn(f"100 events, 10 of them with errors, written to {beside('a.nc')}", whole.stdout)
        self.assertNotIn("E3", whole.stdout)
        for arguments in (["--threads", "1", "-o"], ["--threads", "2", "--json", "-o"], ["--population", "-o"]):
            run("event", case, *arguments, beside("b.nc"))
            self.same(beside("a.nc"), beside("b.nc"))
        run("event", case, "-o", beside("rows.csv"))
        with open(beside("rows.csv"), encoding="utf-8", newline="") as rows:
            self.assertEqual(rows.read(), run("event", case, "--csv").stdout)
        self.assertEqual(run("event", case, "--json", "-o", beside("b.nc")).stdout, run("event", case, "--json").stdout)
        self.assertEqual(sorted(os.listdir(os.path.dirname(case))), ["a.nc", "b.nc", "catalogue.csv", "rows.csv"])

    def same(self, one, other):
        with open(one, "rb") as a, open(other, "rb") as b:
            self.assertTrue(a.read() == b.read(), (one, other))

    def test_unusable_file_names_are_refused(self):
        case = os.path.join(SOURCE, "cases/ets.toml")
        self.refused(2, "event", case, "-o", "out.txt", says=["-o = 'out.txt'", "OUT.nc, OUT.csv, OUT.srf or OUT.fsp"])
        self.refused(2, "event", case, "--resume", "out.csv", says=["--resume = 'out.csv'", "OUT.nc"])
        self.refused(2, "event", case, "--resume", "a.nc", "-o", "out.csv", says=["-o = 'out.csv'"])
        rows = self.file("rows.csv", "name,rupture_velocity\nA,3 km/s\n")
        self.refused(2, "event", case, rows, "-o", rows, says=["-o", "a file other than those read"])
        self.refused(3, "event", case, "-o", "/nowhere/a.nc", says=["/nowhere/a.nc", "does not exist"])
        self.refused(3, "event", case, "-o", "/nowhere/a.csv", says=["/nowhere/a.csv", "does not exist"])
        self.refused(3, "event", case, "--resume", "/nowhere/a.nc", says=["/nowhere/a.nc"])
        self.refused(3, "event", case, "--resume", self.file("a.nc", "text"), says=["not a NetCDF-4 file"])

    def test_only_the_same_catalogue_can_be_resumed(self):
        case = self.file("a.csv", "name,rupture_velocity\nA,3 +- 0.1 km/s\nB,2 km/s\n")
        path = os.path.join(os.path.dirname(case), "a.nc")
        self.ok("event", case, "-o", path)
        with open(path, "rb") as file:
            before = file.read()
        for changed, says in ((["--seed", "2"], "another seed"), (["--samples", "50"], "another samples"), (["--samples", "1000"], "another sampled_events"),
                              (["--closure", "paper"], "another closure"), (["--pulse"], "another pulse"),
                              (["--poisson-ratio", "0.25"], "another poisson_ratio"), ([case], "other files or contents")):
            self.refused(2, "event", case, *changed, "--resume", path, says=[path, "resume", says])
        with open(case, "a", encoding="utf-8") as file:
            file.write("C,1 km/s\n")
        self.refused(2, "event", case, "--resume", path, says=["other files or contents"])
        with open(path, "rb") as file:
            self.assertEqual(file.read(), before)

    def test_killed_and_resumed(self):
        events = 100 if SANITIZED else 500
        case = self.catalogue(events)
        slowly = ["--samples", "3000"]  # so many that the run does not end between two signals
        folder = os.path.dirname(case)
        cut, reference = os.path.join(folder, "cut.nc"), os.path.join(folder, "reference.nc")
        run("event", case, *slowly, "-o", reference)

        def stopped(number, work, *output):
            """Sends a signal to the run when it has used the processor for some seconds."""
            process = subprocess.Popen([PROGRAM, "event", case, *slowly, *output, "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            until_it_answers(process, signal.SIGINT)
            until_it_has_worked(process, work)
            process.send_signal(number)
            out, errors = process.communicate(timeout=PATIENCE)
            return process.returncode, out, errors

        # Ctrl-C leaves the completed events in the file. The resumed run ends with the bits of an uninterrupted one.
        work, sizes, errors = 0.1, set(), ""
        while len(sizes) < 2:
            code, out, errors = stopped(signal.SIGINT, work, "--resume" if sizes else "-o", cut)
            self.assertEqual((code, out), (130, ""), errors)
            if os.path.exists(cut):  # else it has ended before it began
                sizes.add(os.stat(cut).st_size)
            work *= 1.5  # until it has completed an event
        self.assertRegex(errors, f"interrupted after [0-9]+ of {events} events; continue with --resume ")
        self.assertLess(max(sizes), os.stat(reference).st_size)
        # A kill leaves the last checkpoint, or the file that was there.
        stopped(signal.SIGKILL, 2 * work, "--resume", cut)
        self.assertGreaterEqual(os.stat(cut).st_size, max(sizes))
        self.assertEqual(run("event", case, *slowly, "--resume", cut).returncode, 2)
        self.same(cut, reference)
        os.remove(cut)
        self.assertIn("nothing was written", self.interrupted_csv(case, os.path.join(folder, "cut.csv")))
        self.assertFalse(os.path.exists(os.path.join(folder, "cut.csv")))

    def interrupted_csv(self, case, path):
        process = subprocess.Popen([PROGRAM, "event", case, "--samples", "100000", "-o", path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        until_it_has_worked(process, 1)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130, errors)
        return errors

    def test_population(self):
        path = self.file("p.csv", "name,rupture_velocity,slip_velocity\na,1.2 m/s,\nb,1.1 m/s,1 mm/s\nc,1.3 m/s,3 mm/s\nfast,3 km/s,0.5 m/s\nnone,,1 m/s\nbad,x,\n")
        done = run("event", path, "--json", "--population")
        self.assertEqual(done.returncode, 2)
        out = json.loads(done.stdout)
        self.assertEqual(list(out), ["events", "ignored_columns", "ignored_quantities", "tables", "population"])
        self.assertEqual(len(out["events"]), 6)
        decades = out["population"]
        self.assertEqual([d["events"] for d in decades], [3, 0, 0, 1])
        first = decades[0]
        self.assertEqual((first["rupture_velocity_from"], first["rupture_velocity_to"]), (1e-4, 1e-3))
        relation, = json.loads(self.ok("relations", "--rupture-velocity", repr(first["closed_form"]["rupture_velocity"]), "--json"))["relations"]
        self.assertEqual(first["closed_form"]["stress"], relation["stress"])
        self.assertAlmostEqual(first["rupture_velocity_m_s"], 1.2)
        self.assertAlmostEqual(first["rupture_velocity_m_s_interval"][0], 1.11)
        self.assertEqual((first["slip_velocity_m_s"], first["slip_velocity_m_s_events"]), (2e-3, 2))
        self.assertIsNone(decades[1]["stress"])
        table = run("event", path, "--population", "--wide").stdout
        self.assertIn("4 of 6 events have a rupture velocity (1 refused)", table)
        self.assertIn("1e-4 ... 1e-3       3", table)
        self.assertNotIn("fast", table)
        rows = list(csv.DictReader(io.StringIO(run("event", path, "--csv", "--population").stdout)))
        self.assertEqual([row["events"] for row in rows], ["3", "0", "0", "1"])
        self.assertEqual(float(rows[0]["stress_high"]), first["stress_interval"][1])
        self.assertEqual(rows[1]["stress"], "")
        nobody = self.file("n.csv", "name,slip_velocity\na,1 m/s\n")
        self.assertEqual(json.loads(self.ok("event", nobody, "--json", "--population"))["population"], [])
        self.assertIn("0 of 1 events", self.ok("event", nobody, "--population"))

    def test_draws_of_bounds_are_named(self):
        velocities = 'rupture_velocity = "2.8 +- 0.2 km/s"\nslip_velocity = "0.5 +- 0.1 m/s"\nrupture_velocity_is = "characteristic"\n'
        bounds = self.file("bounds.toml", f'[event]\nname = "E"\n{velocities}')
        exact = os.path.join(SOURCE, "cases/parkfield-2004.toml")
        output = os.path.join(os.path.dirname(bounds), "draws.nc")
        for path, says in ((bounds, "the draws are of these: draw_contact_ratio_bound, draw_stress_pa_bound"), (exact, "no draws: the event is not sampled")):
            self.assertIn(says, self.ok("event", path, "--draws", "9", "-o", output, "--wide"))
            self.assertNotIn("draws", self.ok("event", path, "--wide"))

    def test_one_event_is_a_report(self):
        path = self.file("e.toml", '[event]\nname = "E"\nrupture_velocity = "3.0 +- 0.2 km/s"\nslip_velocity = "0.5 */ 1.3 m/s"\n')
        event, = json.loads(self.ok("event", path, "--json"))["events"]
        closed, = json.loads(self.ok("event", path, "--samples", "0", "--json"))["events"]
        report = " ".join(self.ok("event", path).split())
        low, high = event["stress_pa_interval"]
        self.assertIn(f"stress before the rupture is {event['stress_pa'] / 1e6:.4g} MPa ({low / 1e6:.4g} MPa to {high / 1e6:.4g} MPa).", report)
        self.assertIn(f"The closed form, which has no friction, gives {closed['stress_pa_bound'] / 1e6:.4g} MPa.", report)
        self.assertIn(f"gives {closed['contact_ratio_bound']:.4g}.", report)
        self.assertGreater(event["stress_pa"], 2 * closed["stress_pa_bound"])
        self.assertIn(f"median of {event['posterior']['samples']} states", report)
        self.assertNotIn("(1 event)", report)
        self.assertNotIn("closed form", self.ok("event", path, path))  # two events are a table

    def test_the_table_shows_intervals(self):
        path = self.file("e.toml", '[event]\nname = "E"\nrupture_velocity = "3.0 +- 0.2 km/s"\nslip_velocity = "0.5 */ 1.3 m/s"\n'
                                   'stress_drop = "30 +- 10 MPa"\n')
        event = json.loads(self.ok("event", path, "--json"))["events"][0]
        head, row, low, high = self.ok("event", path, "--wide").splitlines()[2:6]
        for line, label, end in ((low, "5 %", 0), (high, "95 %", 1)):
            self.assertTrue(line.strip().startswith(label))
            for title, key, unit, digits in (("V / c", "rupture_velocity", 1, 4), ("MPa", "stress_pa", 1e6, 4), ("C T", "damping_number", 1, 3)):
                stop = head.index(title) + len(title)  # right-aligned below its title
                self.assertTrue(line[:stop].endswith(f" {event[key + '_interval'][end] / unit:.{digits}g}"), (line, key))
        self.assertNotIn(" 5 %", self.ok("event", self.file("f.csv", "name,rupture_velocity\na,3 km/s\n")))

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
