"""Kills runs at random moments: nothing is lost, and nothing is left over once the next run is done. Usage:
kills.py [COUNT [COMMAND...]], COUNT kills of each of pulse, chain, event, sweep and reproduce (default: 200; two hours).
Environment: SLIPFRONT (the program), SLIPFRONT_SOURCE; PYTHONPATH with the package and its interpreter for sweep."""

import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM, SOURCE = os.environ["SLIPFRONT"], pathlib.Path(os.environ["SLIPFRONT_SOURCE"])
SLOW = "[initial]\nstress_left = 0.855\nstress_right = 0\n[friction]\nlaw = 'viscous'\ncoefficient = 0.5\n[pulse]\ncells = 300\n[chain]\nscale = 500\n[output]\nevery = 0.3\n"
SWEEP = """import sys, os, slipfront
case, out = sys.argv[1:]
axes = {"friction.coefficient": [0.01 * i for i in range(1, 80)]}
there = os.path.exists(out + ".part")
slipfront.sweep(case, axes, set={"pulse.cells": 60}, threads=2, **({"resume": out} if there else {"output": out}))
"""


class Work:
    """A command that is killed and begun again in one folder."""

    def __init__(self, name):
        self.name, self.folder = name, pathlib.Path(tempfile.mkdtemp(prefix="slipfront-kills-"))
        self.case, self.events, self.script = (self.folder / file for file in ("case.toml", "events.csv", "sweep.py"))
        self.case.write_text(SLOW)
        self.script.write_text(SWEEP)
        self.events.write_text("name,rupture_velocity,slip_velocity\n" + "".join(f"e{i},{1 + i % 20 / 10} +- 0.1 km/s,0.5 m/s\n" for i in range(60)))
        self.out = self.folder / ("out" if name == "reproduce" else "out.nc")
        self.unfinished = self.folder / "out.unfinished.nc"

    def begin(self, fresh):
        if self.name == "sweep":
            return [sys.executable, str(self.script), str(self.case), str(self.out)]
        if self.name == "reproduce":
            return [PROGRAM, "reproduce", "-o", str(self.out)]
        source = str(self.events if self.name == "event" else self.case)
        command = [PROGRAM, self.name, source] + (["--samples", "1000"] if self.name == "event" else [])
        if fresh or not (self.unfinished.exists() or self.out.exists()):
            return [*command, "-o", str(self.out)]
        if self.unfinished.exists():
            return [*command, "--resume", str(self.unfinished), "-o", str(self.out)]
        return [*command, "--resume", str(self.out)]

    def content(self):
        """What must not change: of a reproduction the files that hold no time, but only their presence is asked for here."""
        if self.name == "reproduce":
            return sorted(os.listdir(self.out)) if self.out.exists() else None
        return self.out.read_bytes() if self.out.exists() else None

    def run(self, arguments, seconds=None):
        """Runs to the end, or is killed after some seconds. Returns the exit code."""
        process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            _, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            _, errors = process.communicate()
        if process.returncode not in (0, -signal.SIGKILL):
            raise SystemExit(f"{self.name}: {arguments}: exit {process.returncode}: {errors}")
        return process.returncode


def kill(name, count):
    work, chance = Work(name), random.Random(5)
    begun = time.monotonic()
    work.run(work.begin(True))
    whole, new = time.monotonic() - begun, work.content()
    rest = sorted(os.listdir(work.folder))
    kills = 0
    while kills < count:
        if chance.random() < 0.3 and work.out.exists() and name != "reproduce":
            work.out.unlink()  # else a finished result stands there, which must outlive the kill
        old = work.content()
        arguments = work.begin(True) if name in ("pulse", "chain", "event") else work.begin(False)
        code = work.run(arguments, chance.uniform(0, whole))
        kills += code != 0
        if old == new and work.content() != new:
            raise SystemExit(f"{name}: kill {kills}: the finished result is lost")
        if name == "sweep" and code == 0:
            continue
        if chance.random() < (0.03 if name == "reproduce" else 0.3):  # the next run, to its end
            if work.unfinished.exists() or (work.out.exists() and work.content() != new) or name in ("sweep", "reproduce"):
                work.run(work.begin(False))
                if work.content() != new:
                    raise SystemExit(f"{name}: kill {kills}: what was resumed is another result")
    work.unfinished.unlink(missing_ok=True)
    work.run(work.begin(True))
    if sorted(os.listdir(work.folder)) != rest:
        raise SystemExit(f"{name}: left {sorted(set(os.listdir(work.folder)) ^ set(rest))}")
    shutil.rmtree(work.folder)
    print(f"{name}: {kills} kills, nothing lost, nothing left over", flush=True)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    for name in sys.argv[2:] or ("pulse", "chain", "event", "sweep", "reproduce"):
        kill(name, count)
