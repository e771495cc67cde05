"""An output that is one of the files which a command reads is refused, in any spelling and through links, and the file stays as it was."""

import os
import shutil
import tempfile
import unittest

import netCDF4
import numpy as np

from support import SOURCE, CommandLine

CASES = os.path.join(SOURCE, "cases")
TABLE = "[initial]\nprofile = 'table'\nfile = 'stress.nc'\n[domain]\nleft = -1\nright = 1\n[pulse]\ncells = 16\n[time]\nend = 0.1\n"
SHORT = ["--set", "pulse.cells=16", "time.end=0.2", "output.every=0.1"]


class InputsKept(CommandLine):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name in ("step.toml", "plane-rings.csv", "synthetic-laboratory-fronts.csv", "catalogue.csv", "synthetic-fault.fsp"):
            shutil.copy(os.path.join(CASES, name), self.folder)

    def copy(self, name, ending):
        """The path of a copy with another ending."""
        path = os.path.join(self.folder, os.path.splitext(name)[0] + "-copy" + ending)
        shutil.copy(os.path.join(CASES, name), path)
        return path

    def spellings(self, path):
        """The file under its own name, another spelling, and links."""
        folder, name = os.path.split(path)
        stem, ending = os.path.splitext(name)
        soft, hard = (os.path.join(folder, f"{stem}-{kind}{ending}") for kind in ("soft", "hard"))
        os.symlink(path, soft)
        os.link(path, hard)
        return [path, os.path.join(folder, ".", name), soft, hard]

    def is_refused(self, path, *arguments, only=None):
        """Tries all spellings, or the first few: Python takes half a second to start."""
        with open(path, "rb") as file:
            before = file.read()
        for spelling in self.spellings(path)[:only]:
            self.refused(2, *arguments, "-o", spelling, says=[f"-o = '{spelling}'", "allowed: a file other than those read"])
        with open(path, "rb") as file:
            self.assertEqual(file.read(), before)

    def test_a_scenario_is_kept(self):
        for command in ("pulse", "chain", "compare"):
            path = self.copy("step.toml", f"-{command}.nc")
            self.is_refused(path, command, path, *SHORT)
        path = self.copy("plane-rings.toml", ".nc")
        self.is_refused(path, "plane", path)

    def test_the_table_of_a_scenario_is_kept(self):
        table, scenario = os.path.join(self.folder, "stress.nc"), os.path.join(self.folder, "table.toml")
        with open(scenario, "w", encoding="utf-8") as file:
            file.write(TABLE)
        with netCDF4.Dataset(table, "w") as data:
            data.createDimension("x", 3)
            for name, values in (("x", [-2, 0, 2]), ("stress", [0.8, 0.5, 0.1])):
                data.createVariable(name, "f8", ("x",))[:] = np.array(values)
        self.is_refused(table, "pulse", scenario)

    def test_a_catalogue_and_a_model_are_kept(self):
        path = self.copy("catalogue.csv", "-events.csv")
        self.is_refused(path, "event", path)
        path = self.copy("synthetic-fault.fsp", ".srf")
        self.is_refused(path, "event", path)

    def test_commands_in_python_keep_their_input(self):
        run = os.path.join(self.folder, "run.nc")
        self.ok("pulse", os.path.join(self.folder, "step.toml"), *SHORT, "-o", run)
        self.is_refused(run, "fronts", run, only=3)
        picture = os.path.join(self.folder, "run.png")
        shutil.copy(run, picture)
        self.is_refused(picture, "plot", picture, only=1)
        self.refused(2, "plot", picture, "--kind", "profiles", says=["a file other than those read"])  # the default output is FILE.png

    def test_tables_and_scenarios_of_commands_in_python_are_kept(self):
        path = self.copy("synthetic-laboratory-fronts.csv", ".nc")
        self.is_refused(path, "laboratory", path, "--poisson-ratio", "0.35", "--s-wave-speed", "1300 m/s", only=1)
        path = self.copy("step.toml", "-sweep.nc")
        self.is_refused(path, "sweep", path, "--vary", "initial.stress_left=0.8:0.9:2", only=1)
        path = self.copy("step.toml", ".gif")
        self.is_refused(path, "animate", path, only=1)
        path = self.copy("catalogue.csv", "-population.nc")
        self.is_refused(path, "population", path, only=1)

    def test_a_run_may_write_to_the_file_from_which_it_resumes(self):
        run = os.path.join(self.folder, "run.nc")
        scenario = os.path.join(self.folder, "step.toml")
        self.ok("pulse", scenario, *SHORT, "-o", run)
        self.ok("pulse", scenario, *SHORT, "--resume", run, "-o", run)
        self.ok("pulse", scenario, *SHORT, "-o", run)  # an earlier result is replaced


if __name__ == "__main__":
    unittest.main()
