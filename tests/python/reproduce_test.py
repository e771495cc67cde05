"""slipfront reproduce, the command: files, page, what it prints; the folder is whole or not there."""

import csv
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import xarray as xr
from page import Page
from support import PATIENCE, PROGRAM, CommandLine, on_terminal

TABLES = ("numbers", "formulas", "statements", "inputs")


class Reproduce(CommandLine):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = os.path.join(cls.temporary.name, "reproduction")
        # Without arguments: this is the main job.
        done = subprocess.run([PROGRAM], capture_output=True, text=True, timeout=PATIENCE, cwd=cls.temporary.name)
        assert done.returncode == 0, done.stderr
        cls.printed, cls.errors = done.stdout, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def rows(self, name):
        with open(os.path.join(self.folder, f"{name}.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_prints_the_table_and_where_the_page_is(self):
        self.assertEqual(self.errors, "")
        lines = self.printed.splitlines()
        self.assertIn(os.path.join("reproduction", "report.html"), lines[-1])
        rows = self.rows("numbers")
        for row, line in zip(rows, lines[1:]):
            self.assertTrue(line.endswith(row["verdict"]), line)
            self.assertIn(f"{row['printed']:>11} {row['printed_digits']:>9}", line)
        self.assertIn(f"{sum(row['verdict'] == 'same' for row in rows)} same", self.printed)
        self.assertEqual(os.listdir(self.temporary.name), ["reproduction"])

    def test_the_table_fits_the_terminal(self):
        wide = self.printed.partition("\n\n")[0]
        code = ("import csv, sys; from slipfront.cmd_reproduce import table\n"
                "rows = [row | {'computed': float(row['computed'])} for row in csv.DictReader(open(sys.argv[1], encoding='utf-8', newline=''))]\n"
                "print(table(rows))")
        for width in (80, 100, 200):
            narrow, returned = on_terminal(width, sys.executable, "-c", code, os.path.join(self.folder, "numbers.csv"))
            self.assertEqual(returned, 0, narrow)
            self.assertLessEqual(max(map(len, narrow.splitlines())), width)
            if width == 200:
                self.assertEqual(narrow.strip(), wide)
            for row in self.rows("numbers"):
                self.assertIn(f"{row['printed']:>11} {row['printed_digits']:>9}", narrow)

    def test_every_figure_with_its_data(self):
        for name in [f"fig-{i:02d}" for i in range(1, 13)] + ["width"]:
            for ending in ("svg", "png", "csv", "nc"):
                self.assertGreater(os.path.getsize(os.path.join(self.folder, f"{name}.{ending}")), 500, (name, ending))
            with xr.open_dataset(os.path.join(self.folder, f"{name}.nc")) as data:
                self.assertGreater(len(data.data_vars), 0)
                for variable in data.data_vars.values():
                    self.assertIn("units", variable.attrs, (name, variable.name))

    def test_every_table(self):
        for name in TABLES:
            self.assertGreater(len(self.rows(name)), 5, name)

    def test_page_loads_nothing(self):
        with open(os.path.join(self.folder, "report.html"), encoding="utf-8") as file:
            page = file.read()
        found = Page(page)
        self.assertEqual((found.loads, found.errors), ([], []))
        self.assertEqual(len(found.figures), 13)
        for name, commands in found.figures.items():
            self.assertEqual(len(commands), 1, name)
            self.assertIn("slipfront", commands[0], name)

    def test_will_not_replace_what_is_not_its_own(self):
        mine = self.file("letter.txt", "dear")
        self.refused(2, "reproduce", "-o", os.path.dirname(mine), says=["not a reproduction"])
        self.refused(2, "reproduce", "-o", mine, says=["not a reproduction"])
        self.refused(2, "reproduce", "--nonsense", says=["--nonsense"])
        self.assertEqual(os.listdir(os.path.dirname(mine)), ["letter.txt"])

    def interrupted(self, site, when):
        """Ctrl-C of `reproduce` once when(folder, process) returns; `site` is code that Python runs as it starts."""
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as path:
            with open(os.path.join(path, "sitecustomize.py"), "w", encoding="ascii") as file:
                file.write(site)
            environment = {**os.environ, "PYTHONPATH": path + os.pathsep + os.environ.get("PYTHONPATH", ""), "PYTHONDONTWRITEBYTECODE": "1"}
            process = subprocess.Popen([PROGRAM, "reproduce", "-o", os.path.join(folder, "out")], env=environment,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            when(folder, process)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate()
            self.assertEqual((process.returncode, errors), (130, "slipfront: interrupted\n"))
            self.assertEqual(os.listdir(folder), [])

    def wait_for_folder(self, folder, process):
        while process.poll() is None and not os.listdir(folder):
            time.sleep(0.01)

    def test_interrupted_leaves_nothing(self):
        self.interrupted("", self.wait_for_folder)

    def test_interrupted_leaves_nothing_where_the_interpreter_ends_slowly(self):
        self.interrupted("import builtins, time\n"
                         "class Slow:\n"
                         "    def __del__(self, sleep=time.sleep):\n"
                         "        sleep(2)\n"
                         "builtins.slow = Slow()\n", self.wait_for_folder)

    def test_interrupted_leaves_nothing_where_a_library_loses_the_exception(self):
        for instead in ("raise ImportError('lost')", "time.sleep(1000)"):
            self.interrupted("import pathlib, time\n"
                             "mkdir = pathlib.Path.mkdir\n"
                             "def make(path, *arguments, **options):\n"
                             "    mkdir(path, *arguments, **options)\n"
                             "    if not options:\n"  # the folder that is written into
                             "        try:\n"
                             "            time.sleep(1000)\n"
                             "        except BaseException:\n"
                             f"            {instead}\n"
                             "pathlib.Path.mkdir = make\n", self.wait_for_folder)

    def test_interrupted_while_the_interpreter_starts(self):
        self.interrupted("import time\nprint(flush=True)\ntime.sleep(0.5)\n", lambda folder, process: process.stdout.readline())

    def test_an_interruption_at_the_very_end_does_not_change_the_exit_code(self):
        with tempfile.TemporaryDirectory() as path:
            with open(os.path.join(path, "sitecustomize.py"), "w", encoding="ascii") as file:
                file.write("import builtins, os, time\n"
                           "class Slow:\n"
                           "    def __del__(self, sleep=time.sleep, write=os.write):\n"
                           "        write(2, b'ending\\n')\n"
                           "        sleep(1)\n"
                           "builtins.slow = Slow()\n")
            environment = {**os.environ, "PYTHONPATH": path + os.pathsep + os.environ.get("PYTHONPATH", "")}
            process = subprocess.Popen([PROGRAM, "reproduce", "--help"], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            self.assertEqual(process.stderr.readline(), "ending\n")
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate()
            self.assertEqual((process.returncode, errors), (0, ""))


if __name__ == "__main__":
    unittest.main()
