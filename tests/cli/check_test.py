#!/usr/bin/env python3
"""Tests that --check refuses what a run refuses at its start, in the same words."""

import json
import os
import re
import unittest

from support import SOURCE, CommandLine, run

STEP = os.path.join(SOURCE, "cases/step.toml")
STICK_SLIP = os.path.join(SOURCE, "cases/stick-slip.toml")
NARROW = "initial.profile=formula", "initial.formula=exp(-(x/1e-5)^2)", "domain.left=-1", "domain.right=1.0001"


class Check(CommandLine):
    def same(self, command, *arguments, code=2):
        run_without = run(command, *arguments)
        check = run(command, *arguments, "--check")
        self.assertEqual(run_without.returncode, code, run_without.stderr)
        self.assertEqual((check.returncode, check.stdout, check.stderr), (code, "", run_without.stderr))
        return check.stderr

    def test_a_grid_too_coarse_for_its_dislocations(self):
        self.assertIn("too coarse", self.same("chain", STEP, "--set", "chain.spacing=1.9", "initial.stress_left=3", "chain.scale=30"))

    def test_stress_narrower_than_the_search_for_it(self):
        self.same("pulse", STEP, "--set", *NARROW)

    def test_levels_of_a_comparison(self):
        self.same("compare", STEP, "--set", "chain.spacing=1.9", "initial.stress_left=3", "--scale", "30")

    def test_ends_that_implicit_steps_lack(self):
        self.assertIn("stick-slip.toml: chain.left", self.same("chain", STICK_SLIP, "--set", "chain.periodic=false", "chain.left=absorbing"))

    def test_an_output_that_cannot_be_written(self):
        for command in ("pulse", "chain", "compare"):
            self.same(command, STEP, "-o", "/nowhere/out.nc", code=3)

    def test_a_file_that_cannot_be_resumed(self):
        file = self.file("other.nc", "")
        self.ok("pulse", STEP, "--set", "pulse.cells=20", "-o", file)
        self.same("pulse", STEP, "--resume", file)

    def test_events_without_loading(self):
        self.assertIn("output.per_event", self.same("chain", STEP, "--set", "output.per_event=5"))

    def test_the_time_of_a_run(self):
        """No test knows how long a run takes, but 2.5e11 steps take days on every machine."""
        plane = os.path.join(SOURCE, "cases/plane-friction.toml")
        long = ["chain", STEP, "--set", "time.end=1e9", "domain.left=-10", "domain.right=10", "chain.scale=100"]
        for words in (["pulse", STEP], ["chain", STEP], long, ["plane", plane], ["plane", plane, "--direct"], ["compare", STEP, "--scale", "20"]):
            text = self.ok(*words, "--check", "--wide", "--threads", "1")
            _, number, unit, machine = re.search(r"\. It would take (less than 1 s|about (\S+) (s|min|h|days)) on this machine(.*)\.\n$", text).groups()
            self.assertGreater(float(number or 1), 0)
            self.assertEqual(unit == "days", words == long)
            self.assertEqual(machine, " with 1 thread" if words[0] in ("chain", "plane") else "")

    def test_the_time_of_slip_events(self):
        """The ring of the case has its first event long after half a second."""
        text = self.ok("chain", STICK_SLIP, "--check", "--wide")
        self.assertRegex(text, r"How long it takes depends on its slip events: 1000 steps take .* on this machine with \d+ threads?\.\n$")

    def test_a_run_after_its_check_is_the_same(self):
        settings = STEP, "--set", "output.every=0.5", "-o", self.file("same.nc", "")
        for command in ("pulse", "chain"):
            summaries = []
            for _ in range(2):
                summaries.append(json.loads(self.ok(command, *settings, "--json")))
                self.ok(command, *settings, "--check")
            for summary in summaries:
                for clock in ("solve_seconds", "wall_seconds", "site_updates_per_second"):
                    summary.pop(clock, None)
            self.assertEqual(*summaries)

    def test_a_good_scenario_is_not_run(self):
        file = self.file("new.nc", "")
        os.remove(file)
        self.assertIn("OK", self.ok("pulse", STEP, "--check", "-o", file))
        self.assertFalse(os.path.exists(file))


if __name__ == "__main__":
    unittest.main()
