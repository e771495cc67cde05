"""slipfront sweep: its results are those of slipfront.sweep, and its output fits a terminal."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import time
import unittest

from commands import PythonCommands
import slipfront
from slipfront._grid import values_of
from support import PATIENCE, PROGRAM, SOURCE

STEP = os.path.join(SOURCE, "cases/step-viscous.toml")
SMALL = ("--set", "pulse.cells=60")
SLOW = ("--vary", "friction.coefficient=0.05:2:200", "--vary", "pulse.cells=200", "--threads", "1")


class Values(unittest.TestCase):
    def test_reads_lists_and_ranges(self):
        for text, kind, values in [("0.1,0.5,2", "number", [0.1, 0.5, 2.0]), ("0:1:5", "number", [0, 0.25, 0.5, 0.75, 1]), ("1:100:3:log", "number", [1, 10, 100]),
                                   ("0,1:3:3", "number", [0, 1, 2, 3]), ("2:1:2", "number", [2, 1]), ("7:9:1", "number", [7]), ("100:400:3:log", "whole number", [100, 200, 400]),
                                   ("paper, consistent", "word", ["paper", "consistent"]), ("true,false", "truth value", [True, False]),
                                   ("max(x,1),2*x", "formula", ["max(x,1)", "2*x"]), ("x<0?1:2", "formula", ["x<0?1:2"]), ("1:3:2 MPa", "number", ["1.0 MPa", "3.0 MPa"]), ("0,3 MPa", "number", [0.0, "3 MPa"]),
                                   ("30 GPa,4e10", "quantity", ["30 GPa", 4e10]), ("wide", "number", ["wide"])]:
            with self.subTest(text):
                found = values_of(text, kind)
                self.assertEqual([type(value) for value in found], [type(value) if kind != "number" or isinstance(value, str) else float for value in values])
                for one, other in zip(found, values, strict=True):
                    self.assertEqual(one, other) if isinstance(other, str) else self.assertAlmostEqual(one, other, 12)

    def test_ranges_are_those_of_relations(self):
        for text in ("0.1:2:7", "0.1:2:7:log"):
            stress = [state["stress"] for state in json.loads(subprocess.run([PROGRAM, "relations", "--stress", text, "--json"], capture_output=True).stdout)["relations"]]
            self.assertEqual(values_of(text, "number"), stress)

    def test_refuses(self):
        for text, says in [("", "empty"), ("1,,2", "empty"), ("0:1", "not a range"), ("0:1:2:lin", "not a range"), ("0:1:0", "1 to"), ("0:1:99999999", "1 to"),
                           ("1,3 MPa", "1.0 has no unit, but 3 MPa has one"), ("0:1:3:log", "positive"), ("0:1e999:3", "finite"),
                           ("0:2:1e13", "a range of 10000000000000 values"), ("0:2:2.5", "a range of 2.5 values")]:
            with self.subTest(text), self.assertRaisesRegex(ValueError, says):
                values_of(text, "number")


class Command(PythonCommands):
    def setUp(self):
        self.folder = os.path.dirname(self.file("unused", ""))
        self.output = os.path.join(self.folder, "sweep.nc")

    def finished_rows(self):
        """Number of lines of the unfinished sweep after the first, which describes it."""
        try:
            with open(self.output + ".part", "rb") as file:
                return max(0, len(file.readlines()) - 1)
        except FileNotFoundError:
            return 0

    def test_equals_the_python_function(self):
        axes = {"friction.coefficient": [0.0, 0.5, 1.0], "friction.closure": ["paper", "consistent"]}
        self.ok("sweep", STEP, *SMALL, "time.end=6", "--vary", "friction.coefficient=0:1:3", "--vary", "friction.closure=paper,consistent", "-o", self.output)
        self.assertTrue(slipfront.open(self.output).identical(slipfront.sweep(STEP, axes, set={"pulse.cells": "60", "time.end": "6"})))
        self.ok("sweep", STEP, "--command", "chain", "--vary", "chain.scale=50,100", "--variables", "slip_at_origin", "-o", self.output, "--threads", "1")
        self.assertTrue(slipfront.open(self.output).identical(slipfront.sweep(STEP, {"chain.scale": [50.0, 100.0]}, command="chain", variables=["slip_at_origin"])))

    def test_forms_of_output(self):
        data = slipfront.sweep(STEP, {"friction.coefficient": [0.5, 2.0]}, set={"pulse.cells": 60})
        arguments = ("sweep", STEP, *SMALL, "--vary", "friction.coefficient=0.5,2")
        points = json.loads(self.ok(*arguments, "--json"))["points"]
        self.assertEqual([point["slip_at_origin"] for point in points], data.slip_at_origin.values.tolist())
        self.assertEqual([(point["first_crossing_time"], point["failure"]) for point in points], [(None, None)] * 2)
        rows = list(csv.DictReader(io.StringIO(self.ok(*arguments, "--csv"))))
        self.assertEqual([float(row["slip_at_origin"]) for row in rows], data.slip_at_origin.values.tolist())
        self.assertEqual([float(row["friction.coefficient"]) for row in rows], [0.5, 2])
        lines = self.ok(*arguments).splitlines()
        self.assertEqual(len(lines), 4)
        self.assertLessEqual(max(map(len, lines)), 80)
        self.assertRegex(lines[0], "^friction.coefficient +slip_at_origin +slip_velocity_at_origin")
        self.assertIn("c A / pi", lines[1])
        many = self.ok(*arguments, "--vary", "time.end=1:2:30").splitlines()
        self.assertEqual((len(many), many[-1]), (43, "... and 20 more points; --csv prints all of them"))

    def test_a_failed_point_has_a_reason_and_an_exit_code(self):
        arguments = ("sweep", STEP, *SMALL, "--vary", "friction.coefficient=-1,0.5")
        done = self.refused(4, *arguments, says=["1 of 2 points failed", "friction.coefficient = '-1.0'"])
        self.assertIn("failed", done.stdout)
        points = json.loads(self.refused(4, *arguments, "--json").stdout)["points"]
        self.assertIn("friction.coefficient = '-1.0'", points[0]["failure"])
        self.assertEqual((points[0]["slip_at_origin"], points[1]["failure"]), (None, None))

    def test_refuses(self):
        axis = ("--vary", "friction.coefficient=1,2")
        for code, arguments, says in [(2, (), ["--vary"]), (2, ("--vary", "friction.coefficient"), ["KEY=VALUE"]), (2, ("--vary", "=1"), ["KEY=VALUE"]),
                                      (2, ("--vary", "friction.coefficien=1"), ["--vary: friction.coefficien", "'coefficient'"]), (2, (*axis, *axis), ["twice"]),
                                      (2, ("--vary", "friction.coefficient=1,1"), ["--vary: friction.coefficient", "twice"]),
                                      (2, ("--vary", "friction.coefficient=-1,-2"), ["--vary: friction.coefficient", ">= 0"]),
                                      (2, ("--vary", "friction.coefficient=0:1"), ["--vary friction.coefficient=0:1", "first:last:count"]),
                                      (2, (*axis, "--variables", "slip"), ["--variables: 'slip'", "slip_at_origin"]), (2, (*axis, "--set", "x"), ["--set x"]),
                                      (2, (*axis, "-o", "a.csv"), ["a.csv", ".nc"]), (2, (*axis, "--json", "--csv"), ["one of them"]), (2, (*axis, "--command", "compare"), ["pulse"]),
                                      (3, (*axis, "-o", "/nowhere/a.nc"), ["/nowhere"]), (3, (*axis, "--resume", os.path.join(self.folder, "a.nc")), ["a.nc"])]:
            with self.subTest(arguments):
                self.refused(code, "sweep", STEP, *arguments, says=says)
        self.refused(3, "sweep", "/nowhere.toml", *axis, says=["/nowhere.toml"])
        self.assertEqual(os.listdir(self.folder), ["unused"])

    def test_an_interrupted_sweep_is_resumed(self):
        process = subprocess.Popen([PROGRAM, "sweep", STEP, *SLOW, "-o", self.output], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and self.finished_rows() == 0:
            time.sleep(0.001)
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual((process.returncode, errors.count("\n")), (130, 1), errors)
        self.assertIn("continue with --resume", errors)
        resume = re.search("continue with (--resume .*)\n", errors)[1].split()
        self.assertEqual(sorted(os.listdir(self.folder)), ["sweep.nc.part", "unused"])
        self.refused(2, "sweep", STEP, *SLOW, "-o", self.output, says=["unfinished"])
        self.ok("sweep", STEP, *SLOW, *resume)
        self.assertEqual(sorted(os.listdir(self.folder)), ["sweep.nc", "unused"])
        self.assertEqual(int((slipfront.open(self.output).failure == "").sum()), 200)


if __name__ == "__main__":
    unittest.main()
