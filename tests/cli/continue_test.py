#!/usr/bin/env python3
"""Tests that a run which continues to a later time.end writes the bytes of one run to that end."""

import json
import os
import signal
import subprocess
import unittest

from support import PATIENCE, PROGRAM, SOURCE, CommandLine

FRICTION = os.path.join(SOURCE, "cases/plane-friction.toml")
STEP = os.path.join(SOURCE, "cases/step.toml")
DOMAIN = ("domain.left=-8", "domain.right=8")
UNEQUAL = {"wall_seconds", "solve_seconds", "site_updates_per_second"}  # they depend on the machine
AGEING = ("friction.law=rate-and-state", "friction.strength=0.05", "friction.direct_effect=0.01", "friction.evolution_effect=0.04",
          "friction.reference_velocity=0.05", "friction.characteristic_slip=0.02")
SLIDER = """[initial]
stress_left = 0
stress_right = 0
[interface]
contact = "0"
[friction]
law = "rate-and-state"
strength = 0.05
direct_effect = 0.01
evolution_effect = 0.015
characteristic_slip = 1
reference_velocity = 0.01
[loading]
stiffness = 0.0025
velocity = 0.001
[domain]
left = -2
right = 2
[chain]
left = "free"
right = "free"
[pulse]
cells = 4
"""


def with_set(settings):
    return [word for setting in settings for word in ("--set", setting)]


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Continue(CommandLine):
    def setUp(self):
        self.folder = os.path.dirname(self.file("unused", ""))

    def path(self, name):
        return os.path.join(self.folder, name)

    def same_as_one_run(self, command, case, ends, settings=()):
        """Runs to the first end, continues to each of the others, and compares with one run to the last. Returns its JSON."""
        cut, whole = self.path("cut.nc"), self.path("whole.nc")

        def arguments(end):
            return (*command.split(), case, *with_set([*settings, f"time.end={end}"]), "--quiet", "--json")

        self.ok(*arguments(ends[0]), "-o", cut)
        for end in ends[1:]:
            continued = json.loads(self.ok(*arguments(end), "--resume", cut))
        expected = json.loads(self.ok(*arguments(ends[-1]), "-o", whole))
        self.assertEqual(content(cut), content(whole))
        self.assertEqual({key: value for key, value in continued.items() if key not in UNEQUAL},
                         {key: value for key, value in expected.items() if key not in UNEQUAL})
        os.remove(cut)
        os.remove(whole)
        return expected

    def test_a_finished_pulse_continues_to_the_same_bytes(self):
        laws = {"none": (), "viscous": ("friction.law=viscous", "friction.coefficient=0.5"), "Coulomb": ("friction.law=coulomb", "friction.coefficient=0.02"),
                "strong": ("friction.law=viscous", "friction.coefficient=1e4"), "ageing": AGEING, "flash": ("friction.law=flash-heating",)}
        for law, settings in laws.items():
            with self.subTest(law=law):
                self.same_as_one_run("pulse", STEP, (1.3, 2.4), (*DOMAIN, "pulse.cells=100", *settings))

    def test_the_old_end_is_an_output_time_only_if_the_scenario_asks_for_it(self):
        settings = (*DOMAIN, "pulse.cells=60")
        for output in ("output.every=0.5", "output.every=0.3", "output.every=0.1", "output.times=[0.2, 0.9]"):
            with self.subTest(output=output):
                self.same_as_one_run("pulse", STEP, (1, 1.1, 2.3), (*settings, output))
        for end in ("1.0000000001", "1000"):
            self.same_as_one_run("pulse", STEP, (1, end), (*settings, "friction.law=viscous", "friction.coefficient=20"))

    def test_a_finished_chain_continues_to_the_same_bytes(self):
        for scale, settings in ((300, ()), (30, ("friction.law=viscous", "friction.coefficient=0.5")), (100, (*AGEING, "output.displacement=true", "output.dislocations=true")),
                                (3000, ("friction.law=viscous", "friction.coefficient=0.5"))):
            with self.subTest(scale=scale):
                ends = (0.2, 0.45) if scale == 3000 else (1, 2.5)
                self.same_as_one_run("chain", STEP, ends, (*DOMAIN, f"chain.scale={scale}", "output.every=0.2", *settings))

    def test_a_chain_of_implicit_steps_continues_with_its_events(self):
        case = self.file("slider.toml", SLIDER)
        whole = self.same_as_one_run("chain", case, (60000, 120000, 200000), ("output.every=50000",))
        self.assertEqual(len(whole["events"]), 4)
        within = whole["events"][2]["onset"] + 0.5 * whole["events"][2]["duration"]
        self.same_as_one_run("chain", case, (60000, within, 160000), ("output.every=50000", "output.per_event=5", "output.dislocations=true"))
        self.same_as_one_run("chain", STEP, (1, 2), (*DOMAIN, "chain.scale=30", "chain.steps=implicit", *AGEING))
        contacts = ("friction.contact_ageing=0.05*(1.5 + tanh(x))", "friction.contact_time=1.5 + tanh(x)",
                    "friction.dilatancy=0.02*(1.5 + tanh(x))", "friction.drainage_time=1.5 + tanh(x)", "friction.direct_effect=0.01*(1.5 + tanh(x))")
        self.same_as_one_run("chain", STEP, (0.5, 1), ("domain.left=-2", "domain.right=2", "chain.scale=3", "chain.spacing=0.3", "chain.steps=implicit",
                                                       *AGEING, *contacts))

    def test_a_finished_plane_continues_to_the_same_bytes(self):
        for command, settings in (("plane", ("plane.loops=12", "plane.angles=16", "plane.cells=20")),
                                  ("plane", ("plane.solver=grid", "plane.cells=20")),
                                  ("plane --direct", ("chain.scale=8", "plane.cells=12", "output.lines=true"))):
            for ends in ((0.2, 0.4), (0.17, 0.29, 0.41)):
                with self.subTest(command=command, settings=settings, ends=ends):
                    self.same_as_one_run(command, FRICTION, ends, (*settings, "output.every=0.1"))

    def test_an_interrupted_plane_continues_to_a_later_end(self):
        cut, whole = self.path("cut.nc"), self.path("whole.nc")
        settings = ("plane.loops=100", "plane.angles=100", "plane.cells=12", "output.every=0.5")  # few rows, so most steps aim at an end
        first, later = (with_set([*settings, f"time.end={end}"]) for end in (0.61, 0.8))
        self.interrupted(cut, "plane", FRICTION, *first)
        self.ok("plane", FRICTION, *later, "--resume", cut)
        self.ok("plane", FRICTION, *later, "-o", whole)
        self.assertEqual(content(cut), content(whole))

    def test_an_interrupted_run_continues_to_a_later_end(self):
        case = self.slow_case()
        for command in ("pulse", "chain"):
            with self.subTest(command=command):
                settings = (*DOMAIN, "friction.coefficient=0.1") if command == "pulse" else ("domain.left=-2", "domain.right=1")
                first, later = (with_set([*settings, f"time.end={end}"]) for end in (2, 2.5))
                cut, whole = self.path(command + ".nc"), self.path(command + "-whole.nc")
                self.interrupted(cut, command, case, *first)
                self.ok(command, case, *later, "--resume", cut)
                self.ok(command, case, *later, "-o", whole)
                self.assertEqual(content(cut), content(whole))

    def test_an_interrupt_while_a_run_continues_keeps_the_finished_result(self):
        case = self.slow_case()
        out, whole, unfinished = self.path("out.nc"), self.path("whole.nc"), self.path("out.unfinished.nc")
        for command in ("pulse", "chain"):
            with self.subTest(command=command):
                settings = ("domain.left=-3", "domain.right=3", "pulse.cells=1500", "chain.scale=1500")
                first, later = (with_set([*settings, f"time.end={end}"]) for end in (0.1, 3))
                self.ok(command, case, *first, "-o", out)
                finished = content(out)
                process = subprocess.Popen([PROGRAM, command, case, *later, "--resume", out], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                           text=True)
                self.wait_for(unfinished, process)
                process.send_signal(signal.SIGINT)
                _, errors = process.communicate(timeout=PATIENCE)
                self.assertEqual(process.returncode, 130, errors)
                self.assertIn(f"--resume {unfinished} -o {out}", errors)
                self.assertEqual(content(out), finished)
                self.ok(command, case, *later, "--resume", unfinished, "-o", out)
                self.assertFalse(os.path.exists(unfinished))
                self.ok(command, case, *later, "-o", whole)
                self.assertEqual(content(out), content(whole))
                os.remove(out)
                os.remove(whole)

    def test_a_finished_run_resumed_to_its_own_end_keeps_its_bytes(self):
        for command in ("pulse", "chain"):
            out = self.path(command + ".nc")
            arguments = (command, STEP, *with_set((*DOMAIN, "pulse.cells=60", "chain.scale=100")))
            self.ok(*arguments, "-o", out)
            before = content(out)
            self.ok(*arguments, "--resume", out)
            self.assertEqual(content(out), before)

    def test_other_changes_are_refused(self):
        out = self.path("out.nc")
        settings = ("pulse.cells=60", "chain.scale=100", "output.every=0.3", "time.end=1")
        contacts = (*DOMAIN, *AGEING, "friction.contact_ageing=0.1", "friction.contact_time=1")
        forced = (*DOMAIN, "forcing.formula=0.001*t")
        for command, first, change, says in (
                ("pulse", DOMAIN, ("time.end=2", "pulse.cells=80"), ["another scenario", "pulse.cells differs"]),
                ("pulse", DOMAIN, ("time.end=2", "friction.law=viscous"), ["friction.law differs"]),
                ("pulse", DOMAIN, ("time.end=0.5",), ["time.end = 0.5", "the end of the file, 1;"]),
                ("chain", DOMAIN, ("time.end=0.5",), ["time.end = 0.5", "the end of the file, 1;"]),
                ("pulse", DOMAIN, ("output.every=0.4",), ["another scenario", "output.every differs", "a later time.end"]),
                ("pulse", DOMAIN, ("time.end=2", "output.every=0.4"), ["output times", "first at t = 0.3"]),
                ("pulse", DOMAIN, ("time.end=2", "output.every=0.15"), ["output times", "first at t = 0.15"]),
                ("pulse", (), ("time.end=2",), ["domain", "with end 1 of the file", "with end 2", "domain.left and domain.right"]),
                ("chain", (), ("time.end=2",), ["domain", "domain.left and domain.right"]),
                ("pulse", forced, ("time.end=2",), ["longest step under a forcing", "0.01 with end 1"]),
                ("chain", contacts, ("time.end=2",), ["spacing of sites", "chain.spacing"]),
                ("chain", (*contacts, "chain.spacing=0.3"), ("time.end=2",), ["the time step"])):
            with self.subTest(command=command, first=first, change=change):
                if os.path.exists(out):
                    os.remove(out)
                self.ok(command, STEP, *with_set((*settings, *first)), "-o", out, "--quiet")
                before = content(out)
                self.refused(2, command, STEP, *with_set((*settings, *first, *change)), "--resume", out, "--quiet", says=says)
                self.assertEqual(content(out), before)

    def test_other_changes_of_a_plane_are_refused(self):
        out = self.path("out.nc")
        settings = with_set(("plane.loops=8", "plane.angles=8", "plane.cells=12", "output.every=0.1", "time.end=0.2"))
        self.ok("plane", FRICTION, *settings, "-o", out, "--quiet")
        before = content(out)
        for change, says in ((("time.end=0.4", "plane.cells=13"), ["another scenario", "plane.cells differs"]),
                             (("time.end=0.1",), ["time.end = 0.1", "the end of the file, 0.2;"]),
                             (("time.end=0.4", "output.every=0.15"), ["output times", "first at t = 0.1"]),
                             (("time.end=1000",), ["the time between two rows of the series", "with end 0.2 of the file"])):
            with self.subTest(change=change):
                self.refused(2, "plane", FRICTION, *settings, *with_set(change), "--resume", out, "--quiet", says=says)
                self.assertEqual(content(out), before)

    def test_output_times_after_the_old_end_are_free(self):
        settings = (*DOMAIN, "pulse.cells=60")
        cut, whole = self.path("cut.nc"), self.path("whole.nc")
        later = with_set((*settings, "time.end=2", "output.times=[0.3, 1.4, 1.5]"))
        self.ok("pulse", STEP, *with_set((*settings, "time.end=1", "output.times=[0.3]")), "-o", cut)
        self.ok("pulse", STEP, *later, "--resume", cut)
        self.ok("pulse", STEP, *later, "-o", whole)
        self.assertEqual(content(cut), content(whole))


if __name__ == "__main__":
    unittest.main()
