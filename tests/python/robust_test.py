"""Unusual conditions around the package: locales, missing numbers, titles with mathematical markup, leftovers, damaged files."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

import numpy as np
import xarray as xr

import slipfront
from slipfront import _files, plots
from slipfront.plots.animation import Scene
from slipfront.reproduce import outputs
from support import PATIENCE, SOURCE, CommandLine

STEP = os.path.join(SOURCE, "cases/step.toml")
SMALL = {"pulse.cells": 16, "time.end": 0.5}


class Numbers(unittest.TestCase):
    def test_nan_gives_nan_and_affects_no_other_value(self):
        whole = slipfront.relations(stress=[0.5, 1.0, 2.0])
        holed = slipfront.relations(stress=[0.5, np.nan, 2.0])
        for name in whole.data_vars:
            np.testing.assert_array_equal(holed[name], np.where([True, False, True], whole[name], np.nan))
        self.assertTrue(np.isnan(slipfront.relations(rupture_velocity=np.nan).stress))
        ratio = slipfront.friction_ratio([1.0, np.nan, 1.0], [0.5, 0.5, np.nan]).ratio
        np.testing.assert_array_equal(np.isnan(ratio), [False, True, True])


@unittest.skipUnless(shutil.which("localedef"), "no localedef")
class Locale(CommandLine):
    def test_units_are_read_in_every_locale(self):
        folder = os.path.dirname(self.file("x", ""))
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(folder, "de_DE.UTF-8")], capture_output=True)
        if made.returncode > 1:
            self.skipTest("no source of the locale de_DE")
        code = """import locale
locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
assert locale.localeconv()["decimal_point"] == ","
import slipfront
event = slipfront.event({"name": "a", "rupture_velocity": "2.5 km/s", "slip_velocity": "0.5 m/s"})
print(repr(float(event.stress[0])))
case = {"initial": {"profile": "formula", "formula": "x<0.5?0.75:0.1"}, "domain": {"left": -1.5, "right": 1.5}, "pulse": {"cells": 16}, "time": {"end": 0.5},
        "medium": {"shear_modulus": "30.5 GPa"}}
print(repr(slipfront.pulse(case).attrs["slip_at_origin"]))
for refused in (lambda: slipfront.train.fields(0.5, -1.5, 0.5), lambda: slipfront.train.averages(0.5, 0.5, -1.5), lambda: slipfront.relations(stress=-2.5),
                lambda: slipfront.pulse(case, set={"pulse.tolerance": 1.5}), lambda: slipfront.pulse(case, set={"interface.contact": "x<0.25?1.5:0.5"}),
                lambda: slipfront.chain(case, set={"chain.spacing": 30.5}), lambda: slipfront.chain(case, set={"chain.window": -0.5}),
                lambda: slipfront.event({"name": "a", "rupture_velocity": "2.5 km/s", "poisson_ratio": 0.75})):
    try:
        refused()
        print("not refused")
    except ValueError as error:
        print(error)
"""

        def printed_by(text):
            done = subprocess.run([sys.executable, "-c", text], env={**os.environ, "LOCPATH": folder}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout
        plain = printed_by("\n".join(code.splitlines()[3:]))
        self.assertEqual(printed_by(code), plain)
        self.assertNotIn("not refused", plain)


class Pictures(CommandLine):
    TITLE = "costs $5 or $\\frac{1$ \x1b[31m\u202e"

    def test_titles_are_not_read_as_mathematics(self):
        pulse = slipfront.pulse(STEP, set=SMALL).assign_attrs(title=self.TITLE)
        folder = os.path.dirname(self.file("x", ""))
        for name, figure in (("a", plots.space_time(pulse)), ("b", plots.profiles(pulse))):
            plots.save(figure, os.path.join(folder, f"{name}.png"))
        Scene(pulse)
        levels = slipfront.compare(STEP, set={**SMALL, "chain.scale": 20}).assign_attrs(title=self.TITLE)
        plots.save(plots.comparison(levels), os.path.join(folder, "c.svg"))
        self.assertIn("costs $5", (pathlib.Path(folder) / "c.svg").read_text())

    def test_a_bad_cell_does_not_prevent_a_picture(self):
        pulse = slipfront.pulse(STEP, set={**SMALL, "output.every": 0.1})
        for bad in (np.nan, np.inf, -np.inf):
            damaged = pulse.copy(deep=True)
            for name in ("W", "Sigma", "k", "slip"):
                damaged[name][1, 3] = bad
            scene = Scene(damaged)
            for row in range(damaged.sizes["time"]):
                scene.show(row)
            for figure in (plots.space_time(damaged), plots.profiles(damaged)):
                figure.canvas.draw()

    def test_output_has_the_given_name(self):
        folder = os.path.dirname(self.file("x", ""))
        source, picture = os.path.join(folder, "p.nc"), os.path.join(folder, "name.png")
        slipfront.pulse(STEP, set={**SMALL, "output.every": 0.1}, output=source)
        self.ok("plot", source, "-o", picture)
        self.assertEqual(sorted(os.listdir(folder)), ["name.png", "p.nc", "x"])
        self.refused(2, "plot", source, "-o", "", says=["is empty"])


class Files(CommandLine):
    def setUp(self):
        self.folder = pathlib.Path(self.file("unused", "")).parent

    def test_a_written_dataset_reads_back_equal(self):
        data = xr.Dataset({"a": (("x", "y"), np.arange(6.0).reshape(2, 3)), "flag": ("x", [True, False]), "text": ("x", np.array(["", "é=1"], dtype=object)),
                           "scalar": 3.5}, {"x": ["u", "v"], "y": [1, 2, 3], "z": ("x", [0.5, np.nan])}, {"title": "t", "long": "é" * 100000, "n": 3, "f": 0.1})
        path = self.folder / "d.nc"
        _files.write_dataset(data, path)
        self.assertTrue(xr.open_dataset(path).load().identical(data))
        _files.write_dataset(data.isel(x=slice(0, 0)), path)
        self.assertEqual(xr.open_dataset(path).sizes["x"], 0)

    def test_damaged_files_are_refused(self):
        path = self.folder / "p.nc"
        slipfront.pulse(STEP, set=SMALL, output=path)
        whole = path.read_bytes()
        for at in range(0, len(whole), len(whole) // 40):
            path.write_bytes(whole[:at] + bytes([whole[at] ^ 0xff]) + whole[at + 1:])
            with self.assertRaises(slipfront.FileError):
                slipfront.open(path)
        path.write_bytes(whole[:len(whole) // 2])
        with self.assertRaises(slipfront.FileError):
            slipfront.open(path)

    def test_threads_write_and_read_at_once(self):
        """Forks that write must start while no thread uses the NetCDF library. Otherwise each would wait forever for that thread's lock."""
        code = ("import pathlib, sys, threading, warnings, slipfront\n"
                "warnings.simplefilter('ignore')\n"
                "folder, table = map(pathlib.Path, sys.argv[1:])\n"
                "step = {'initial': {'profile': 'step', 'stress_left': .855, 'stress_right': 0}}\n"
                "curve = {'initial': {'profile': 'table', 'file': str(table)}, 'domain': {'left': -1, 'right': 1}}\n"
                "done = []\n"
                "def work(i):\n"
                "    for _ in range(4):\n"
                "        short = {'pulse': {'cells': 30}, 'time': {'end': .2}}\n"
                "        slipfront.pulse({**(step, curve)[i % 2], **short}, output=folder / f'{i}.nc', errors=False)\n"
                "        done.append(slipfront.open(folder / f'{i}.nc').attrs['finished'])\n"
                "threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]\n"
                "[thread.start() for thread in threads]\n"
                "[thread.join() for thread in threads]\n"
                "print(done.count(1), len(done))\n")
        done = subprocess.run([sys.executable, "-c", code, self.folder, os.path.join(SOURCE, "tests/data/stress.nc")], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.stdout, "16 16\n", done.stderr[-2000:])

    def test_a_full_disk_is_a_file_error(self):
        """No file may become larger than 4 kB. This imitates a full disk."""
        for name, output in (("sweep", "s.nc"), ("pulse", "p.nc"), ("plots.save", "f.png")):
            call = {"sweep": f"slipfront.sweep({STEP!r}, {{'friction.coefficient': [0.1]}}, set={SMALL | {'friction.law': 'viscous'}!r}, output='s.nc')",
                    "pulse": f"slipfront.pulse({STEP!r}, set={SMALL!r}, output='p.nc')",
                    "plots.save": f"from slipfront import plots; plots.save(plots.profiles(slipfront.pulse({STEP!r}, set={SMALL!r})), 'f.png')"}[name]
            code = f"import resource, signal\nsignal.signal(signal.SIGXFSZ, signal.SIG_IGN)\nimport slipfront\nresource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))\ntry:\n    {call}\nexcept slipfront.FileError as error:\n    print(error)"
            done = subprocess.run([sys.executable, "-c", code], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (0, f"{output}: cannot be written: File too large\n"), done.stderr)
            self.assertEqual(set(os.listdir(self.folder)) - {"unused", "s.nc.part"}, set())

    def test_an_incomplete_result_of_a_fork_is_a_file_error(self):
        def half():
            def send(descriptor, mode):
                os.write(descriptor, b"dhalf")
                os.kill(os.getpid(), signal.SIGKILL)

            os.fdopen = send  # in the fork
            return b"half of it"

        def crash():
            os.kill(os.getpid(), signal.SIGSEGV)

        self.assertEqual(_files.isolated("name", lambda: b"all"), b"all")
        for make, says in ((half, "crashed"), (crash, "crashed"), (lambda: 1 / 0, "division by zero")):
            with self.assertRaisesRegex(slipfront.FileError, f"^name: cannot be written: .*{says}"):
                _files.isolated("name", make)

    def test_an_interruption_does_not_wait_for_a_fork(self):
        def interrupt(*_):
            raise KeyboardInterrupt

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, interrupt))
        signal.setitimer(signal.ITIMER_REAL, 0.3)  # only in this process
        begun = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            _files.isolated("name", lambda: time.sleep(1000))
        self.assertLess(time.monotonic() - begun, 900)
        with self.assertRaises(ChildProcessError):  # no child process is left
            os.waitpid(-1, os.WNOHANG)

    def test_unknown_formats_of_pictures_are_refused(self):
        figure = plots.relations(slipfront.relations(stress=[1.0, 2.0]))
        for name in ("a.nc", "a"):
            with self.assertRaisesRegex(ValueError, f"^{name}: .*allowed: .*png"):
                plots.save(figure, name)

    def test_leftovers_of_a_killed_reproduction_are_removed(self):
        for name in (".r.new-17", ".r.old-17", ".r.new-18", ".r.new-x", ".other.new-17"):
            (self.folder / name).mkdir()
            (self.folder / name / "report.html").write_text(name)
        with outputs.locked(self.folder / ".r.new-18"):  # this process still runs
            outputs.tidy(self.folder / "r")
        self.assertEqual((self.folder / "r" / "report.html").read_text(), ".r.old-17")
        self.assertEqual(sorted(os.listdir(self.folder)), [".other.new-17", ".r.new-18", ".r.new-x", "r", "unused"])

    def test_more_threads_than_cores_are_accepted(self):
        self.assertEqual(float(slipfront.relations(stress=[1.0] * 1000, threads=4096).stress[0]), 1.0)


if __name__ == "__main__":
    unittest.main()
