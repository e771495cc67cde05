"""Kills runs at random moments. No result may be lost, no other file may be left after the next run, and a resumed run must have
the bits of an uninterrupted one. Usage: kills.py [COUNT [COMMAND[:SCENARIO]...]], for COUNT kills of each (default: 200, which
takes many hours). A COMMAND without a SCENARIO is one case of pulse, chain, event, compare, sweep, reproduce, plot or animate.
`laws` is pulse and chain with every law of friction, contacts that age, pores, loading, forcing and implicit steps. `all` is
everything. Environment: SLIPFRONT (the program), SLIPFRONT_SOURCE; PYTHONPATH with the package and its interpreter for sweep;
SLIPFRONT_SEED.
"""

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
STATE = "law = 'rate-and-state'\nstrength = 0.05\ndirect_effect = 0.01\nevolution_effect = 0.015\nreference_velocity = 0.05\ncharacteristic_slip = 0.05\n"
RING = ("[initial]\nstress_left = 2\nstress_right = 2\n[interface]\ncontact = '1 + 0.05*cos(0.02*x)'\n[domain]\nleft = -157.07963267948966\nright = 157.07963267948966\n"
        "[friction]\nlaw = 'rate-and-state'\nstrength = 5e-4\ndirect_effect = 1e-4\nevolution_effect = 1.5e-4\nreference_velocity = 1e-3\ncharacteristic_slip = 1\n"
        "[pulse]\ncells = 50\n[chain]\nspacing = 0.5\n")
#: Name of a scenario -> keys of [friction].
LAWS = {
    "none": "law = 'none'\n", "viscous": "law = 'viscous'\ncoefficient = 0.5\n", "coulomb": "law = 'coulomb'\ncoefficient = 0.03\n",
    "paper": "law = 'power'\ncoefficient = 0.5\nexponent = 2\nclosure = 'paper'\n", "power": "law = 'power'\ncoefficient = 0.5\nexponent = 1.5\n",
    "power-steep": "law = 'power'\ncoefficient = 0.1\nexponent = 0.5\n", "formula": "law = 'formula'\nformula = '0.5*w/(1+w)'\n",
    "table": "law = 'table'\nfile = 'curve.csv'\n", "n-shaped": "law = 'n-shaped'\ncoefficient = 0.1\nvelocity = 0.05\n",
    "flash-heating": "law = 'flash-heating'\nstrength = 0.05\nweakened = 0.01\nvelocity = 0.1\n",
    "slip-weakening": "law = 'slip-weakening'\nstrength = 0.05\nresidual = 0.03\ncharacteristic_slip = 0.3\n",
    "rate-and-state": STATE, "slip-law": STATE + "state = 'slip'\n",
}
#: Like LAWS, but for chains only.
CHAINS = {"contact-ageing": STATE + "contact_ageing = 0.003\ncontact_time = 1\n", "dilatancy": STATE + "dilatancy = 0.01\ndrainage_time = 1\npore_pressure = 0.3\n"}
LOADED = {
    "loading": RING.replace("[chain]\n", "[chain]\nperiodic = true\n") + "[loading]\nstiffness = 4e-5\nvelocity = 1e-4\n[time]\nend = 4e5\n[output]\nevery = 1e4\n",
    "loading-left": RING.replace("157.07963267948966", "15.707963267948966").replace("[chain]\n", "[chain]\nleft = 'free'\n") + "[loading]\nstiffness = 4e-3\nvelocity = 1e-4\nwhere = 'left'\n[time]\nend = 500\n[output]\nevery = 50\n",
    "implicit": "[initial]\nstress_left = 0.855\nstress_right = 0\n[friction]\nlaw = 'viscous'\ncoefficient = 0.5\n[chain]\nscale = 40\nsteps = 'implicit'\n[output]\nevery = 0.3\n",
}
STEP = "[initial]\nstress_left = 0.855\nstress_right = 0\n[domain]\nleft = -7\nright = 3\n[output]\nevery = 0.3\n"


def scenario(command, name):
    """The TOML of a named scenario. Its size is such that the command takes about one second."""
    if name in LOADED:
        return LOADED[name]
    size = "[pulse]\ncells = 800\n" if command == "pulse" else "[chain]\nscale = 200\n"
    if name == "forcing":
        return STEP + size + "[forcing]\nformula = '0.02*cos(3*t)'\n[interface]\ncontact = '1 + 0.1*tanh(x)'\n"
    return STEP + size + "[friction]\n" + (LAWS | CHAINS)[name]


def scenarios():
    """The names COMMAND:SCENARIO for all laws."""
    return [f"pulse:{name}" for name in (*LAWS, "forcing")] + [f"chain:{name}" for name in (*LAWS, *CHAINS, "forcing", *LOADED)]


SWEEP = """import sys, os, slipfront
case, out = sys.argv[1:]
axes = {"friction.coefficient": [0.01 * i for i in range(1, 80)]}
there = os.path.exists(out + ".part")
slipfront.sweep(case, axes, set={"pulse.cells": 60}, threads=2, **({"resume": out} if there else {"output": out}))
"""


class Work:
    """A command that this script kills and starts again in one folder."""

    def __init__(self, name):
        self.name, _, variant = name.partition(":")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="slipfront-kills-"))
        self.case, self.events, self.script = (self.folder / file for file in ("case.toml", "events.csv", "sweep.py"))
        self.case.write_text(scenario(self.name, variant) if variant else SLOW)
        (self.folder / "curve.csv").write_text("w,f\n0,0\n0.1,0.03\n1,0.1\n30,1\n")
        self.script.write_text(SWEEP)
        self.events.write_text("name,rupture_velocity,slip_velocity\n" + "".join(f"e{i},{1 + i % 20 / 10} +- 0.1 km/s,0.5 m/s\n" for i in range(60)))
        self.out = self.folder / {"reproduce": "out", "plot": "out.png", "animate": "out.gif"}.get(self.name, "out.nc")
        self.unfinished, self.source = self.folder / "out.unfinished.nc", self.folder / "source.nc"
        if self.name in ("plot", "animate"):
            self.run([PROGRAM, "pulse", str(self.case), "--set", "pulse.cells=60", "-o", str(self.source)])

    def begin(self, fresh):
        if self.name == "sweep":
            return [sys.executable, str(self.script), str(self.case), str(self.out)]
        if self.name == "reproduce":
            return [PROGRAM, "reproduce", "-o", str(self.out)]
        if self.name in ("plot", "animate"):
            return [PROGRAM, self.name, str(self.source), "-o", str(self.out)]
        if self.name == "compare":
            return [PROGRAM, "compare", str(self.case), "--scale", "100", "-o", str(self.out)]
        source = str(self.events if self.name == "event" else self.case)
        command = [PROGRAM, self.name, source] + (["--samples", "1000"] if self.name == "event" else [])
        if fresh or not (self.unfinished.exists() or self.out.exists()):
            return [*command, "-o", str(self.out)]
        if self.unfinished.exists():
            return [*command, "--resume", str(self.unfinished), "-o", str(self.out)]
        return [*command, "--resume", str(self.out)]

    def content(self):
        """The content that must not change. A reproduction contains times, so here we compare only the names of its files."""
        if self.name == "reproduce":
            return sorted(os.listdir(self.out)) if self.out.exists() else None
        return self.out.read_bytes() if self.out.exists() else None

    def run(self, arguments, seconds=None, until=None):
        """Runs to the end, or kills the process after some seconds or when until(process) returns. Returns the exit code."""
        process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.folder)
        if until:
            until(process)
            process.kill()
        try:
            _, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            _, errors = process.communicate()
        if process.returncode not in (0, -signal.SIGKILL):
            raise SystemExit(f"{self.name}: {arguments}: exit {process.returncode}: {errors}")
        return process.returncode


def until_a_checkpoint(work, process, chance):
    """Waits until the first checkpoint exists, and a little longer."""
    while process.poll() is None and not (work.unfinished.exists() or work.out.exists()):
        time.sleep(1e-4)
    time.sleep(chance.choice([0, 0, 1e-3, 1e-2]))


def kill(name, count):
    work, chance = Work(name), random.Random(f"{os.environ.get('SLIPFRONT_SEED', 5)} {name}")
    resumable = work.name in ("pulse", "chain", "event")
    begun = time.monotonic()
    work.run(work.begin(True))
    whole, new = time.monotonic() - begun, work.content()
    rest = sorted(os.listdir(work.folder))
    kills = resumed = 0
    while kills < count:
        if chance.random() < 0.3 and work.out.exists() and work.name != "reproduce":
            work.out.unlink()  # otherwise there is a finished result, which the kill must not destroy
        old = work.content()
        arguments = work.begin(resumable)
        early = resumable and chance.random() < 0.3
        code = work.run(arguments, chance.uniform(0, whole), (lambda process: until_a_checkpoint(work, process, chance)) if early else None)
        kills += code != 0
        if old == new and work.content() != new:
            raise SystemExit(f"{name}: kill {kills}: the finished result is lost")
        if work.name == "sweep" and code == 0:
            continue
        if chance.random() < (0.03 if work.name == "reproduce" else 0.6):  # the next run, to its end
            unfinished = work.unfinished.exists() or (work.out.exists() and work.content() != new)
            if resumable and not unfinished:
                continue
            work.run(work.begin(not resumable and work.name != "sweep"))
            resumed += resumable
            if work.content() != new:
                raise SystemExit(f"{name}: kill {kills}: the {'resumed' if resumable else 'repeated'} run has another result")
    work.unfinished.unlink(missing_ok=True)
    work.run(work.begin(True))
    if sorted(os.listdir(work.folder)) != rest:
        raise SystemExit(f"{name}: unexpected or missing files: {sorted(set(os.listdir(work.folder)) ^ set(rest))}")
    shutil.rmtree(work.folder)
    print(f"{name}: {kills} kills, {resumed} runs resumed to the same bits, no result lost, no file left over", flush=True)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    commands = ["pulse", "chain", "event", "compare", "sweep", "reproduce", "plot", "animate"]
    groups = {"laws": scenarios(), "all": commands + scenarios()}
    failures = []
    for asked in sys.argv[2:] or ["all"]:
        for name in groups.get(asked, [asked]):
            try:
                kill(name, count)
            except SystemExit as failure:
                print(failure, flush=True)
                failures.append(name)
    if failures:
        raise SystemExit(f"failed: {', '.join(failures)}")
