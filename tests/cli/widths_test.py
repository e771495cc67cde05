"""The output of every command fits 80 columns in a pipe.

`widths_test.py --print` prints the widest line of each.
"""

import os
import re
import shlex
import sys
import tempfile
import unittest

from support import SOURCE, CommandLine, run

MOST = 80
NOT_BUILT = 3  # exit code of a command in Python whose package is missing

#: Commands that run in a folder with cases/, in this order: the next ones read what one writes.
COMMANDS = """
relations --stress 1.2
relations --stress 1:2:3
relations --stress 1.2 --contact-ratio 1e-3 --si
relations --stress 1:2:3 --friction-coefficient 0.1
riemann --left 1,0.3 --right 0.5,-0.2
riemann --left 1,0.3 --right 0.5,-0.2 --solution shocks
event
event cases/parkfield-2004.toml
event cases/ets.toml
event cases/catalogue.csv --samples 100
event cases/synthetic-fault.fsp
event cases/synthetic-fault.fsp --pulse
event cases/synthetic-fault.fsp cases/ets.toml --pulse
event cases/synthetic-fault.fsp --fault-grid -o grid.nc
event cases/synthetic-fault.fsp -o source.srf
event cases/catalogue.csv -o events.nc
event --population
columns cases/catalogue.csv
pulse cases/fig-08.toml -o pulse.nc
pulse cases/fig-08.toml --check
pulse cases/step.toml --set output.every=0.5 -o step.nc
chain cases/step-viscous.toml --set chain.scale=20 -o chain.nc
chain cases/stick-slip.toml --set domain.left=-30 domain.right=30 time.end=3e5
chain cases/laboratory-block.toml --check
chain cases/step-viscous.toml --check
compare cases/step-viscous.toml --scale 20 --scale 40
compare cases/step-viscous.toml --check
plane cases/plane-rings.toml --set plane.loops=20 plane.angles=16 time.end=0.2
plane cases/plane-friction.toml --check
plane cases/synthetic-fault.fsp --check
keys
keys friction
units cases/laboratory-block.toml
units cases/plane-friction.toml
doctor
explore
sweep cases/fig-08.toml --vary friction.coefficient=0.1,1 -o sweep.nc
sweep cases/fig-08.toml --vary friction.coefficient=0.1,1 --vary friction.closure=paper,consistent
fronts step.nc
laboratory cases/synthetic-laboratory-fronts.csv --poisson-ratio 0.35 --s-wave-speed '1300 m/s'
population few.csv --steps 20
plot pulse.nc
"""
#: Commands that take long, or whose output is the same as that of others.
ELSEWHERE = ("reproduce", "animate")


def fill(folder):
    """Makes the folder the working folder of the commands, with the files that they read."""
    os.chdir(folder)
    os.symlink(os.path.join(SOURCE, "cases"), "cases")
    with open("cases/catalogue.csv", encoding="utf-8") as catalogue:
        lines = catalogue.readlines()
    with open("few.csv", "w", encoding="utf-8") as few:
        few.writelines(lines[:6])


def names_in(commands):
    """Names of all commands."""
    return {command.split()[0] for command in commands} | set(ELSEWHERE)


def lines_of(command):
    """The lines of stdout of a command. None if it is not built."""
    words = shlex.split(command)
    done = run(*words)
    if done.returncode == NOT_BUILT:
        return None
    if done.returncode not in (0, 2) or not done.stdout:
        raise AssertionError(f"{command}: exit code {done.returncode}, {done.stderr}")
    return done.stdout.splitlines()


class Widths(CommandLine):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        fill(folder.name)
        listed = self.ok("--help").partition("Subcommands:")[2]
        self.names = re.findall(r"^  (\w+)", listed, re.MULTILINE)

    def assert_fits(self, command):
        lines = lines_of(command)
        for line in lines or []:
            # A path stays whole, so that it can be copied.
            self.assertLessEqual(len(re.sub(r"/\S{20,}", "", line)), MOST, f"{command}: {line}")

    def test_every_help_fits(self):
        self.assertGreater(len(self.names), 15)
        for name in ("", *self.names):
            with self.subTest(name):
                self.assert_fits(f"{name} --help")

    def test_every_output_fits(self):
        commands = COMMANDS.strip().splitlines()
        self.assertEqual(names_in(commands), set(self.names))
        for command in commands:
            with self.subTest(command):
                self.assert_fits(command)

    def test_wide_has_all_columns(self):
        for command in ("event", "relations --stress 1:2:3", "pulse cases/fig-08.toml", "keys"):
            with self.subTest(command):
                self.assertGreater(max(map(len, lines_of(command + " --wide"))), MOST)


def print_widths():
    """Prints the widest line of each command, and the number of lines."""
    with tempfile.TemporaryDirectory() as folder:
        fill(folder)
        commands = COMMANDS.strip().splitlines()
        for command in [f"{name} --help" for name in sorted(names_in(commands))] + commands:
            lines = lines_of(command) or [""]
            print(f"{max(map(len, lines)):4} {len(lines):4}  {command}", flush=True)
        os.chdir(SOURCE)


if __name__ == "__main__":
    if sys.argv[1:] == ["--print"]:
        print_widths()
    else:
        unittest.main()
