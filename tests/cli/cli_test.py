"""The command line as a user meets it: exit codes, texts, JSON. Runs the program named by $SLIPFRONT."""

import csv
import io
import json
import math
import os
import random
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["SLIPFRONT"]
SOURCE = os.environ["SLIPFRONT_SOURCE"]
RELATIONS = ["stress", "rupture_velocity", "leading_velocity", "velocity_ratio", "slip_velocity", "stress_at_origin",
             "dislocation_velocity_at_origin", "psi", "psi_at_origin"]
EVENT = ["name", "c_m_s", "rupture_velocity", "stress", "frictionless_slip_velocity", "observed_slip_velocity",
         "contact_ratio", "stress_pa", "damping_number", "warnings"]

PULSE = ["closure", "friction_coefficient", "damping_number", "time", "slip_velocity_at_origin", "stress_at_origin",
         "slip_at_origin", "peak_slip_velocity", "peak_position", "trailing_front", "leading_front", "conservation_error", "cells",
         "steps", "solve_seconds", "wall_seconds"]
CHAIN = ["time", "scale", "slip_at_origin", "dislocations", "sites", "steps", "site_updates_per_second", "energy_drift", "charge_error",
         "wall_seconds"]


def run(*arguments, stdin=""):
    return subprocess.run([PROGRAM, *arguments], input=stdin, capture_output=True, text=True, timeout=120)


class CommandLine(unittest.TestCase):
    def ok(self, *arguments, stdin=""):
        done = run(*arguments, stdin=stdin)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def refused(self, code, *arguments, stdin="", says=()):
        done = run(*arguments, stdin=stdin)
        self.assertEqual(done.returncode, code, (arguments, done.stdout[:300], done.stderr))
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("slipfront: "), done.stderr)
        for text in says:
            self.assertIn(text, done.stderr)
        return done

    def file(self, name, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = os.path.join(folder.name, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path

    # relations

    def test_relations_json_has_the_nine_keys_in_input_order(self):
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

    def test_relations_ranges_and_csv(self):
        rows = list(csv.DictReader(io.StringIO(self.ok("relations", "--stress", "0.5:1.5:5", "--csv"))))
        self.assertEqual([float(r["stress"]) for r in rows], [0.5, 0.75, 1.0, 1.25, 1.5])
        rows = json.loads(self.ok("relations", "--rupture-velocity", "1e-300:1e-1:300:log", "--json"))["relations"]
        self.assertEqual(len(rows), 300)
        self.assertEqual((rows[0]["rupture_velocity"], rows[-1]["rupture_velocity"]), (1e-300, 0.1))

    def test_relations_from_stdin(self):
        out = json.loads(self.ok("relations", "--stress", "-", "--json", stdin="1.03  # Parkfield\n\n 0.213\r\n"))
        self.assertEqual([r["stress"] for r in out["relations"]], [1.03, 0.213])

    def test_relations_a_million_rows_and_any_number_of_threads(self):
        stdin = "".join(f"{0.05 + i * 1e-6:.8f}\n" for i in range(1000000))
        one = self.ok("relations", "--stress", "-", "--csv", "--threads", "1", stdin=stdin)
        self.assertEqual(one.count("\n"), 1000001)
        self.assertEqual(one, self.ok("relations", "--stress", "-", "--csv", "--threads", "3", stdin=stdin))

    def test_relations_full_precision_for_one_state(self):
        self.assertIn("0.5439026079081", self.ok("relations", "--stress", "1.03"))

    def test_relations_refuses(self):
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

    # event

    def test_event_json_has_the_contract_keys(self):
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

    def test_event_bad_rows_keep_the_good_ones(self):
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

    def test_event_refuses_files(self):
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
    def test_event_file_that_may_not_be_read(self):
        path = self.file("secret.csv", "name,slip_m\nA,1\n")
        os.chmod(path, 0)
        self.refused(3, "event", path, says=["Permission denied"])

    def test_event_a_file_that_fails_does_not_lose_the_others(self):
        done = run("event", "/nowhere.csv", os.path.join(SOURCE, "cases/ets.toml"), "--json")
        self.assertEqual(done.returncode, 3)
        self.assertEqual([e["stress"] is None for e in json.loads(done.stdout)["events"]], [True, False])

    def test_event_from_stdin_with_a_million_rows(self):
        stdin = "name,rupture_velocity_km_s,slip_velocity_m_s\n" + "E,2.8,0.5\n" * 1000000
        out = self.ok("event", "-", "--csv", "--quiet", stdin=stdin)
        self.assertEqual(out.count("\n"), 1000001)

    def test_event_reads_the_fsp_dialects(self):
        for name in ("fsp_srcmod_single.fsp", "fsp_dirty.fsp", "fsp_usgs_single.fsp", "fsp_usgs_segments.fsp"):
            event, = json.loads(self.ok("event", os.path.join(SOURCE, "tests/data", name), "--json"))["events"]
            self.assertGreater(event["stress"], 0, name)

    def test_default_is_the_shipped_catalogue(self):
        table = self.ok()
        self.assertIn("Parkfield 2004", table)
        events = json.loads(self.ok("event", "--json"))["events"]
        self.assertGreaterEqual(len(events), 25)
        self.assertTrue(all(e["citation"] for e in events))
        self.assertGreaterEqual(sum(e["stress"] is not None for e in events), 25)
        velocities = [e["rupture_velocity_m_s"] for e in events if e["rupture_velocity_m_s"]]
        self.assertGreater(max(velocities) / min(velocities), 1e5)  # from great earthquakes to long-term slow slip

    # pulse

    def pulse(self, *arguments):
        return json.loads(self.ok("pulse", *arguments, "--json"))

    def test_pulse_json_has_the_contract_keys(self):
        out = self.pulse(os.path.join(SOURCE, "cases/step.toml"))
        for key in PULSE:
            self.assertIn(key, out)
        self.assertLess(abs(out["slip_velocity_at_origin"] / 0.0482084 - 1), 1e-5)
        self.assertLess(abs(out["trailing_front"] + 0.36443433 * 2 * math.pi), 1e-6)
        self.assertLess(out["conservation_error"], 1e-13)

    def test_pulse_every_case_runs(self):
        folder = os.path.join(SOURCE, "cases")
        for name in sorted(os.listdir(folder)):
            if name.endswith(".toml"):
                with self.subTest(case=name):
                    self.assertIn("fine", self.ok("pulse", os.path.join(folder, name), "--check"))
                    self.assertGreater(self.pulse(os.path.join(folder, name), "--set", "pulse.cells=50")["steps"], 0)

    def test_pulse_closures_are_both_there_and_named(self):
        case = os.path.join(SOURCE, "cases/fig-08.toml")
        paper = self.pulse(case)
        right = self.pulse(case, "--set", "friction.closure=consistent")
        self.assertEqual((paper["closure"], right["closure"]), ("paper", "consistent"))
        self.assertLess(abs(paper["slip_velocity_at_origin"] - 0.015248), 3e-6)
        self.assertLess(abs(right["slip_velocity_at_origin"] - 0.009337), 3e-6)
        self.assertAlmostEqual(right["damping_number"], math.pi)

    def test_pulse_refuses(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        self.refused(2, "pulse", says=["SCENARIO"])
        barrier = os.path.join(SOURCE, "cases/barrier.toml")
        self.refused(2, "pulse", barrier, "--set", "interface.contact=x>0.3 ? 2 : 1", says=["jumps", "x = 0.3"])
        self.refused(2, "pulse", barrier, "--set", "interface.contact=1e4", says=["interface.contact", "0.0045"])
        self.refused(2, "pulse", case, "--set", "interface.contact=1+x^2", says=["domain", "left and right"])
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

    def slow_case(self):
        return self.file("slow.toml", "[initial]\nstress_left = 0.855\n[friction]\nlaw = 'viscous'\ncoefficient = 0.5\n"
                                      "[pulse]\ncells = 700\n[chain]\nscale = 1500\n[output]\nevery = 0.3\n".replace("stress_left", "stress_right = 0\nstress_left"))

    def killed_and_resumed(self, command, trials, longest):
        """Kills a run at random moments and resumes it: the file must be that of a run left alone."""
        case = self.slow_case()
        folder = os.path.dirname(case)
        cut, reference = os.path.join(folder, "cut.nc"), os.path.join(folder, "reference.nc")
        self.ok(command, case, "-o", reference)
        chance = random.Random(7)
        resumed = 0
        for trial in range(trials):
            if os.path.exists(cut):
                os.remove(cut)
            process = subprocess.Popen([PROGRAM, command, case, "-o", cut], stdout=subprocess.DEVNULL)
            try:
                process.wait(chance.uniform(0.02, longest))
            except subprocess.TimeoutExpired:
                process.kill()
            process.wait()
            if not os.path.exists(cut):
                continue  # killed before the first checkpoint: nothing was written, and nothing half-written either
            resumed += 1
            self.ok(command, case, "--resume", cut, "--threads", str(1 + trial % 2))
            with open(cut, "rb") as a, open(reference, "rb") as b:
                self.assertEqual(a.read(), b.read(), trial)
        self.assertGreater(resumed, trials / 4)  # most were killed after their first checkpoint

    def test_pulse_killed_and_resumed_is_the_same_file(self):
        self.killed_and_resumed("pulse", 20, 0.2)

    def test_chain_killed_and_resumed_is_the_same_file(self):
        self.killed_and_resumed("chain", 6, 0.2)

    def test_pulse_interrupted_leaves_a_checkpoint(self):
        case = self.slow_case()
        folder = os.path.dirname(case)
        cut = os.path.join(folder, "cut.nc")
        process = subprocess.Popen([PROGRAM, "pulse", case, "-o", cut, "--set", "pulse.cells=2000"], stderr=subprocess.PIPE, text=True)
        while not os.path.exists(cut):
            pass
        process.send_signal(2)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("--resume", errors)
        self.refused(2, "pulse", case, "--resume", cut, says=["another scenario"])

    # chain

    def chain(self, *arguments):
        return json.loads(self.ok("chain", *arguments, "--json"))

    def test_chain_json_has_the_contract_keys(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        out = self.chain(case, "--set", "chain.scale=300")
        for key in CHAIN:
            self.assertIn(key, out)
        self.assertEqual(out["scale"], 300)
        self.assertLess(abs(out["slip_at_origin"] / (2 * math.pi * 0.0482084) - 1), 0.01)
        self.assertLess(out["energy_drift"], 1e-4)
        self.assertEqual(out["charge_error"], 0)
        self.assertIn("fine", self.ok("chain", case, "--check"))

    def test_chain_tends_to_the_consistent_pulse(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        friction = ["--set", "friction.law=viscous", "--set", "friction.coefficient=0.5"]
        pulse = self.pulse(case, *friction)["slip_at_origin"]
        paper = self.pulse(case, *friction, "--set", "friction.closure=paper")["slip_at_origin"]
        error = [abs(self.chain(case, *friction, "--set", f"chain.scale={scale}")["slip_at_origin"] / pulse - 1) for scale in (100, 1000)]
        self.assertLess(error[1], 0.005)
        self.assertLess(error[1], error[0] / 3)
        self.assertGreater(abs(paper / pulse - 1), 0.2)

    def test_chain_lattice_and_ring(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        lattice = self.chain(case, "--set", "chain.scale=100", "--set", "chain.model=lattice", "--set", "medium.contact_ratio=0.1")
        self.assertEqual(lattice["spacing"], 0.1)
        self.assertLess(abs(lattice["slip_at_origin"] / 0.3029 - 1), 0.02)
        ring = self.chain(self.file("ring.toml", "[initial]\nprofile = 'formula'\nformula = '0.8'\n[domain]\nleft = -1\nright = 1\n"
                                    "[chain]\nscale = 50\nperiodic = 'yes'\n[forcing]\nformula = '0.5'\n"))
        self.assertEqual(ring["dislocations"], 13)
        self.assertGreater(ring["slip_at_origin"], 0)

    @unittest.skipUnless(shutil.which("mpirun"), "no mpirun")
    def test_chain_under_mpirun_writes_the_same_file(self):
        case = self.slow_case()
        folder = os.path.dirname(case)
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                           OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_mpi_yield_when_idle="1", ASAN_OPTIONS="detect_leaks=0")

        def mpirun(ranks, *arguments):
            return subprocess.run(["mpirun", "-n", str(ranks), PROGRAM, "chain", case, "--set", "chain.scale=500", *arguments],
                                  env=environment, capture_output=True, text=True, timeout=120)

        alone, shared = os.path.join(folder, "alone.nc"), os.path.join(folder, "shared.nc")
        self.ok("chain", case, "--set", "chain.scale=500", "-o", alone)
        done = mpirun(2, "--threads", "1", "-o", shared, "--json")
        if "not built with MPI" in done.stderr or "without MPI" in done.stderr:
            self.skipTest("built without MPI")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["ranks"], 2)
        with open(alone, "rb") as a, open(shared, "rb") as b:
            self.assertEqual(a.read(), b.read())
        refused = mpirun(2, "--set", "chain.spacing=0.9")
        self.assertEqual(refused.returncode, 2)
        self.assertEqual(refused.stderr.count("slipfront: "), 1, refused.stderr)

    def test_chain_refuses(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        for change, words in [("chain.spacing=0.9", ["spacing", "1.5"]), ("chain.scale=1e13", ["GB"]), ("chain.scale=0", ["scale"]),
                              ("chain.model=lattice", ["chain.spacing"]), ("chain.left=open", ["absorbing"])]:
            with self.subTest(change=change):
                self.refused(2, "chain", case, "--set", "chain.model=sine-gordon", "--set", "time.end=60", "--set", change, says=words)
        made = os.path.join(os.path.dirname(self.file("x", "")), "pulse.nc")
        self.ok("pulse", case, "-o", made)
        self.refused(2, "chain", case, "--resume", made, says=["resume"])

    # compare

    def compare(self, *arguments):
        return json.loads(self.ok("compare", os.path.join(SOURCE, "cases/step.toml"), *arguments, "--json"))

    def test_compare_shows_every_level_and_that_the_chain_follows_the_consistent_closure(self):
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

    def test_compare_has_the_closed_form_where_there_is_one(self):
        for right in ("0", "0.179"):
            out = self.compare("--scale", "100", "--set", f"initial.stress_right={right}", "--set", "pulse.threshold=0.01")
            exact = out["levels"][0]
            self.assertEqual(exact["level"], "closed-form")
            for key in ("slip_at_origin", "slip_velocity_at_origin", "leading_front", "trailing_front_observed"):
                self.assertLess(abs(exact["difference"][key]), (0.01 if "observed" in key else 2e-3) * abs(exact[key]), key)
            self.assertEqual("phonons" in out["notes"][0] and "shock" in out["notes"][0], right != "0")
            self.assertIsNone(out["trend"]["slip_at_origin"]["exponent"])  # one scale has no trend
        for change in ("initial.profile=tanh", "domain.right=0.3", "forcing.formula=0.001"):
            self.assertEqual(self.compare("--scale", "100", "--set", change)["levels"][0]["level"], "pulse-consistent", change)

    def test_compare_scales_are_the_scenarios_or_the_users(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        self.assertIn("scale 1000 (", self.ok("compare", case, "--check"))
        table = self.ok("compare", case, "--set", "chain.scale=50", "--quiet")
        self.assertIn("chain-50", table)
        self.assertNotIn("chain-100", table)

    def test_compare_writes_a_file_and_heeds_an_interrupt(self):
        case = self.slow_case()
        path = os.path.join(os.path.dirname(case), "out.nc")
        self.assertIn(path, self.ok("compare", case, "--scale", "50", "-o", path))
        with open(path, "rb") as file:
            self.assertEqual(file.read(8), b"\x89HDF\r\n\x1a\n")
        os.remove(path)
        process = subprocess.Popen([PROGRAM, "compare", case, "--scale", "30000", "--threads", "1", "-o", path], stderr=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, text=True)
        while not os.path.exists(path):
            pass
        process.send_signal(2)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("interrupted", errors)

    def test_compare_refuses(self):
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

    # common

    def test_help_and_version(self):
        for arguments in (["--help"], ["relations", "--help"], ["event", "--help"], ["pulse", "--help"], ["chain", "--help"], ["--version"]):
            self.assertTrue(self.ok(*arguments).strip())

    def test_full_disk_is_an_error(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([PROGRAM, "relations", "--stress", "1:2:1000", "--csv"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("stdout", done.stderr)


if __name__ == "__main__":
    unittest.main()
