#!/usr/bin/env python3
"""Tests that --check refuses what a run refuses at its start, in the same words."""

import os
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

    def test_a_good_scenario_is_not_run(self):
        file = self.file("new.nc", "")
        os.remove(file)
        self.assertIn("OK", self.ok("pulse", STEP, "--check", "-o", file))
        self.assertFalse(os.path.exists(file))


if __name__ == "__main__":
    unittest.main()
