"""Errors of the package: invalid input that it refuses, and their messages."""

import math
import os
import shutil
import subprocess
import sys
import unittest
import warnings

import numpy as np

import slipfront
from support import PATIENCE, CommandLine, PROGRAM, SOURCE

STEP = os.path.join(SOURCE, "cases/step.toml")


def python(code, **environment):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=PATIENCE, env={**os.environ, **environment})


class Errors(CommandLine):
    def test_messages_are_those_of_the_command_line(self):
        for key, value in [("pulse.cells", 3), ("time.end", 0), ("time.end", math.nan), ("initial.stress_left", -1), ("initial.strss_left", 1),
                           ("domain.left", 9), ("friction.law", "sticky"), ("initial.profile", "formula"), ("pulse.cells", 1.5),
                           ("friction.coefficient", -1), ("nonsense", 1), ("no.such", 1), ("title", 3)]:
            with self.subTest(key=key, value=value), self.assertRaises(slipfront.InputError) as caught:
                slipfront.pulse(STEP, set={key: value})
            self.assertEqual(self.refused(2, "pulse", STEP, "--set", f"{key}={value}").stderr, f"slipfront: {caught.exception}\n")
        for arguments in (("/nowhere.toml",), (SOURCE,)):
            with self.assertRaises(slipfront.FileError) as caught:
                slipfront.pulse(*arguments)
            self.assertEqual(self.refused(3, "pulse", *arguments).stderr, f"slipfront: {caught.exception}\n")
        for key, value in (("output", "/nowhere/o.nc"), ("resume", "/nowhere.nc"), ("resume", STEP)):
            with self.assertRaises(OSError) as caught:
                slipfront.pulse(STEP, **{key: value})
            self.assertEqual(self.refused(3, "pulse", STEP, "--" + key, value).stderr, f"slipfront: {caught.exception}\n")

    def test_messages_shorten_long_names(self):
        """Calls each function with a text of 1 MB, also as the key of a dict and as the item of a list."""
        text = "x" * 1000000
        functions = [getattr(slipfront, name) for name in slipfront.__all__ if callable(getattr(slipfront, name)) and not isinstance(getattr(slipfront, name), type)]
        self.assertGreater(len(functions), 12)
        calls = [(function, (value,), {}) for function in functions for value in (text, text + ".nc", text + ".csv", [text], {text: text}, {text: {text: text}})]
        calls += [(slipfront.pulse, (STEP,), {key: value}) for key in ("set", "output", "resume") for value in (text, text + ".nc", {text: 1}, {"pulse.cells": text})]
        calls += [(slipfront.riemann, (1, 0.5), {"solution": text}), (slipfront.sweep, (STEP,), {"axes": {text: [1]}}), (slipfront.sweep, (STEP,), {"axes": {"time.end": [text]}}),
                  (slipfront.population, (), {"prior": text}), (slipfront.population, (), {"prior": {text: (1, 2)}}), (slipfront.population, (), {"progress": text})]
        raised = 0
        for function, arguments, options in calls:
            with self.subTest(function=function.__name__):
                try:
                    function(*arguments, **options)
                except (slipfront.InputError, slipfront.FileError) as error:
                    self.assertLess(len(str(error)), 5000)
                    raised += 1
                except TypeError as error:  # the function has no positional arguments
                    self.assertIn("positional", str(error))
        self.assertGreater(raised, 70)

    def test_a_thread_prints_no_errors_of_libraries(self):
        code = f"""
import fcntl, os, tempfile, threading, slipfront
name = os.path.join(tempfile.mkdtemp(), "a.nc")
slipfront.pulse({STEP!r}, set={{"pulse.cells": 8, "time.end": 0.1}}, output=name)
slipfront.open(name)
file = open(name, "rb+")
fcntl.flock(file, fcntl.LOCK_EX)
def read():
    try:
        slipfront.open(name)
    except slipfront.FileError:
        print("refused")
for _ in range(2):
    thread = threading.Thread(target=read)
    thread.start()
    thread.join()
"""
        done = python(code)
        self.assertEqual((done.stdout, done.stderr), ("refused\nrefused\n", ""))

    def test_refuses(self):
        good = {"initial": {"stress_left": 1.0, "stress_right": 0}}
        slipfront.check(good)  # so that the only fault is the one in the table

        def initial(**change):
            return {"initial": {**good["initial"], **change}}

        event = {"name": "a", "rupture_velocity": "3 km/s"}
        table = [
            ("scenario", slipfront.pulse, 3), ("scenario", slipfront.pulse, None), ("initial", slipfront.pulse, {}), ("initial", slipfront.pulse, {"initial": 3}),
            ("stress_left = 'nan'", slipfront.pulse, initial(stress_left=math.nan)), ("stress_left = '-1'", slipfront.pulse, initial(stress_left=-1)),
            ("stress_left", slipfront.pulse, initial(stress_left=np.ones((2, 2)))), ("initial.stress_left", slipfront.pulse, initial(stress_left=object())),
            ("NoneType", slipfront.pulse, initial(stress_left=None)), ("stress_left = '1'", slipfront.pulse, initial(stress_left="1")),
            ("initial", slipfront.pulse, {"inital": {}}), ("'3'", slipfront.pulse, {3: 4}), ("'3'", slipfront.pulse, {"initial": {3: 4}}),
            ("surrogate", slipfront.pulse, {**good, "title": "\ud800"}), ("scenario", slipfront.pulse, {**good, "friction": {"law": "viscous", "coefficient": 10**400}}),
            ("shear_modulus", slipfront.pulse, {**good, "medium": {"shear_modulus": "30 km"}}), ("set", slipfront.pulse, good, {"set": ["pulse.cells=3"]}),
            ("'3=4'", slipfront.pulse, good, {"set": {3: 4}}), ("pulse.cells", slipfront.pulse, good, {"set": {"pulse.cells": object()}}),
            ("one line", slipfront.pulse, good, {"set": {"title": "two\nlines"}}), ("progress", slipfront.pulse, good, {"progress": 3}),
            ("threads", slipfront.pulse, good, {"threads": -1}), ("output", slipfront.pulse, good, {"output": 3}), ("output", slipfront.pulse, good, {"output": ""}),
            ("output", slipfront.pulse, good, {"output": "a\0b"}), ("scenario", slipfront.pulse, "a\0b"), ("scenario", slipfront.pulse, ""),
            ("scenario:1", slipfront.pulse, "[initial\n"), ("initial", slipfront.pulse, "\n"), ("walk", slipfront.check, good, {"command": "walk"}),
            ("spacing", slipfront.chain, good, {"set": {"chain.spacing": 0.9, "chain.scale": 100}}), ("contact_ratio", slipfront.chain, good, {"set": {"chain.model": "lattice"}}),
            ("twice", slipfront.compare, good, {"scales": [7, 7]}), ("'nan'", slipfront.compare, good, {"scales": [math.nan]}),
            ("scales", slipfront.compare, good, {"scales": ["x"]}), ("'-1'", slipfront.compare, good, {"scales": [-1]}),
            ("GB", slipfront.compare, good, {"scales": [1e11]}), ("file", slipfront.open, 3), ("events", slipfront.event, 3), ("events", slipfront.event, []),
            ("events[0]", slipfront.event, [3]), ("events", slipfront.event, {}), ("-3 km/s", slipfront.event, {**event, "rupture_velocity": "-3 km/s"}),
            ("3 kg", slipfront.event, {**event, "rupture_velocity": "3 kg"}), ("30", slipfront.event, {**event, "rupture_velocity": "30 km/s"}),
            ("rupture_velocity", slipfront.event, {"event": {"rupture_velocty": "3 km/s"}}), ("p-wave-speed", slipfront.event, event, {"p_wave_speed": "6"}),
            ("run: a int", slipfront.fronts, 5), ("run: a dict", slipfront.fronts, {}), ("client: a str", slipfront.sweep, good, {"axes": {"time.end": [1]}, "client": "x"}),
            ("seed = 'None'", slipfront.event, event, {"seed": None}), ("draws = 'None'", slipfront.event, event, {"draws": None}),
            ("poisson", slipfront.event, event, {"poisson_ratio": 0.7}), ("p-wave-speed", slipfront.event, event, {"p_wave_speed": math.nan})]
        for says, call, argument, *rest in table:
            with self.subTest(says=says, argument=str(argument)[:60]), self.assertRaises(slipfront.InputError) as caught:
                call(argument, **(rest[0] if rest else {}))
            self.assertNotIn("\n", str(caught.exception))
            self.assertIn(says, str(caught.exception))
        for call in [lambda: slipfront.open("/nowhere.nc"), lambda: slipfront.open(STEP), lambda: slipfront.open(SOURCE), lambda: slipfront.event("/nowhere.csv")]:
            with self.assertRaises(slipfront.FileError):
                call()

    def test_hierarchy(self):
        self.assertTrue(issubclass(slipfront.InputError, ValueError))
        self.assertTrue(issubclass(slipfront.FileError, OSError))
        self.assertTrue(issubclass(slipfront.NumericsError, RuntimeError))

    def test_a_run_that_fails_leaves_its_results(self):
        """A force pushes dislocations against each other until no state exists. The output has the results up to then."""
        case = {"initial": {"stress_left": 0.855, "stress_right": 0.855}, "domain": {"left": -2, "right": 2}, "forcing": {"formula": "1e300*x"},
                "time": {"end": 50}, "pulse": {"cells": 40}}
        output = os.path.join(os.path.dirname(self.file("x", "")), "o.nc")
        with self.assertRaises(slipfront.NumericsError) as caught:
            slipfront.pulse(case, output=output)
        self.assertIn("what was computed is in " + output, str(caught.exception))
        self.assertEqual(slipfront.open(output).attrs["finished"], 0)

    def test_another_scenario_is_not_resumed(self):
        output = os.path.join(os.path.dirname(self.file("x", "")), "o.nc")
        slipfront.pulse(STEP, output=output)
        with self.assertRaises(slipfront.InputError) as caught:
            slipfront.pulse(STEP, resume=output, set={"pulse.cells": 50})
        self.assertIn("another scenario", str(caught.exception))

    def test_missing_library_names_the_package(self):
        for library, code, package in [("xarray", "slipfront.relations(stress=1)", "python3-xarray"), ("numpy", "", "python3-numpy"),
                                       ("netCDF4", f"slipfront.open({STEP!r})", "python3-netcdf4"), ("matplotlib", "import slipfront.plots", "python3-matplotlib"),
                                       ("pandas", "slipfront.relations(stress=1)", "python3-pandas"), ("pandas", "slipfront.event(samples=0)", "python3-pandas"),
                                       ("distributed", f"slipfront.sweep({STEP!r}, {{'time.end': [1]}}, client=1)", "python3-distributed")]:
            done = python(f"import sys; sys.modules[{library!r}] = None\nimport slipfront\n{code}")
            self.assertIn(f"ImportError: {library} is missing; install the Debian package {package}, or `pip install {library}`", done.stderr)

    def test_an_unloadable_module_is_one_sentence(self):
        done = python("import sys; sys.modules['slipfront._slipfront'] = None\nimport slipfront")
        self.assertRegex(done.stderr.splitlines()[-1], r"^ImportError: slipfront cannot load its compiled module, which was built for cpython-.*, with Python 3\..* on .* Linux \(.*\); use .*`pip install \.`$")

    def test_an_import_of_the_folder_of_cases_keeps_its_path(self):
        done = python("import slipfront, slipfront.cases\nimport slipfront.cases as folder\nprint((slipfront.cases / 'step.toml').exists(), folder == slipfront.cases)")
        self.assertEqual(done.stdout, "True True\n", done.stderr)

    def test_an_interrupted_run_leaves_a_checkpoint(self):
        case = self.slow_case()
        folder = os.path.dirname(case)
        for command, change in [("pulse", "pulse.cells=800"), ("chain", "chain.scale=1500")]:
            cut, whole = os.path.join(folder, command + ".nc"), os.path.join(folder, command + "-whole.nc")
            key, value = change.split("=")
            code = f"import slipfront\nslipfront.{command}({case!r}, set={{{key!r}: {value}}}, output={cut!r}, threads=1)"
            process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)
            self.wait_for(cut, process)
            process.send_signal(2)
            _, errors = process.communicate(timeout=PATIENCE)
            self.assertIn("KeyboardInterrupt", errors)
            self.assertEqual(slipfront.open(cut).attrs["finished"], 0)
            getattr(slipfront, command)(case, set={key: int(value)}, resume=cut, threads=1)
            self.ok(command, case, "--set", change, "--threads", "1", "-o", whole)
            with open(cut, "rb") as a, open(whole, "rb") as b:
                self.assertEqual(a.read(), b.read())

    def test_warnings_of_a_scenario_are_warnings(self):
        with warnings.catch_warnings(record=True) as seen:
            warnings.simplefilter("always")
            slipfront.pulse(STEP)
        self.assertEqual([str(w.message) for w in seen], [])
        sticks = {"friction.law": "coulomb", "friction.coefficient": 2, "pulse.cells": 20, "chain.scale": 20, "initial.profile": "tanh"}
        for run, more in ((slipfront.pulse, {}), (slipfront.chain, {}), (slipfront.compare, {"scales": [20]})):
            with warnings.catch_warnings(record=True) as seen:
                warnings.simplefilter("always")
                data = run(STEP, set=sticks, **more)
            self.assertEqual(len([w for w in seen if "friction holds a force of 2" in str(w.message)]), 1, run)
            self.assertIn("friction holds", data.attrs["notes" if run is slipfront.compare else "warnings"])


def nested(kind, depth):
    value = 1.0
    for _ in range(depth):
        value = {"a": value} if kind is dict else [value]
    return value


class Nested(unittest.TestCase):
    """Values that are nested more deeply than Python can follow are refused like other invalid input."""

    def test_are_refused_everywhere(self):
        endless = {}
        endless["a"] = endless
        step = {"initial": {"profile": "step", "stress_left": 0.855, "stress_right": 0}}
        for value in (nested(dict, 5000), nested(list, 5000), nested(dict, 150), endless):
            for call in (lambda v: slipfront.pulse(v), lambda v: slipfront.pulse({**step, "time": v}), lambda v: slipfront.pulse({**step, "time": {"end": v}}),
                         lambda v: slipfront.pulse(step, set=v), lambda v: slipfront.pulse(step, set={"time.end": v}), lambda v: slipfront.pulse(step, output=v),
                         lambda v: slipfront.pulse(step, progress=v), lambda v: slipfront.chain(step, threads=v), lambda v: slipfront.compare(step, scales=v),
                         lambda v: slipfront.sweep(step, v), lambda v: slipfront.sweep(step, {"time.end": v}), lambda v: slipfront.sweep(step, {"time.end": [1.0]}, variables=v),
                         lambda v: slipfront.event(v), lambda v: slipfront.event({"name": "a", "rupture_velocity": v}), lambda v: slipfront.relations(stress=v),
                         lambda v: slipfront.open(v), lambda v: slipfront.check(step, command=v)):
                with self.assertRaises(slipfront.InputError) as caught:
                    call(value)
                self.assertLess(len(str(caught.exception)), 1000)


class Commands(CommandLine):
    def test_the_program_runs_subcommands_written_in_python(self):
        help = self.ok("--help")
        for name in ("sweep", "laboratory", "plot", "reproduce", "animate"):
            self.assertIn("\n  " + name, help)
        self.refused(3, "plot", "/nowhere.nc")

    def test_the_program_reports_a_missing_package(self):
        folder = os.path.dirname(self.file("x", ""))
        os.makedirs(os.path.join(folder, "bin"))
        alone = shutil.copy(PROGRAM, os.path.join(folder, "bin"))
        build = os.path.dirname(os.path.dirname(PROGRAM))
        os.symlink(os.path.join(build, "lib"), os.path.join(folder, "lib"))  # the library, without the package
        done = subprocess.run([alone, "plot", "x.nc"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1))
        self.assertIn("pybind11-dev", done.stderr)

    def test_a_module_of_another_machine_is_one_sentence(self):
        """The module is empty here. One of another architecture gives another reason."""
        folder = os.path.dirname(self.file("x", ""))
        build = os.path.dirname(os.path.dirname(PROGRAM))
        package = os.path.join(folder, "python", "slipfront")
        os.makedirs(package)
        os.makedirs(os.path.join(folder, "bin"))
        os.symlink(os.path.join(build, "lib"), os.path.join(folder, "lib"))
        for name in os.listdir(os.path.join(build, "python", "slipfront")):
            if name.startswith("_slipfront."):
                open(os.path.join(package, name), "w").close()
            else:
                os.symlink(os.path.join(build, "python", "slipfront", name), os.path.join(package, name))
        done = subprocess.run([shutil.copy(PROGRAM, os.path.join(folder, "bin")), "plot", "x.nc"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"^slipfront: slipfront cannot load its compiled module, which was built for cpython-.*too short.*\n$")
        module = subprocess.run([sys.executable, "-c", "import slipfront"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": os.path.join(folder, "python")})
        self.assertIn("too short", module.stderr.splitlines()[-1])
        os.remove(next(os.path.join(package, name) for name in os.listdir(package) if name.startswith("_slipfront.")))
        none = subprocess.run([sys.executable, "-c", "import slipfront"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": os.path.join(folder, "python")})
        self.assertIn("cannot load a compiled module, because none was built", none.stderr.splitlines()[-1])

    def test_a_folder_of_that_name_is_not_the_package(self):
        folder = os.path.dirname(self.file("x", ""))
        os.makedirs(os.path.join(folder, "slipfront"))
        with open(os.path.join(folder, "slipfront", "__init__.py"), "w") as out:
            out.write("raise SystemExit(77)\n")
        done = subprocess.run([PROGRAM, "plot", "/nowhere.nc"], capture_output=True, text=True, cwd=folder)
        self.assertEqual(done.returncode, 3)

    def test_the_module_hands_other_commands_to_the_program(self):
        module, command = [sys.executable, "-m", "slipfront"], ["relations", "--stress", "1.03"]
        answer = subprocess.run([PROGRAM, *command], capture_output=True, text=True).stdout
        self.assertIn("0.5439026", answer)
        self.assertEqual(subprocess.run([*module, *command], capture_output=True, text=True).stdout, answer)
        self.assertEqual(subprocess.run([*module, "walk"], capture_output=True, text=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()
