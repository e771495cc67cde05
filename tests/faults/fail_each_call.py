"""Lets the n-th allocation or file operation of a run fail, for n = 1, 2, ... until a run succeeds, and checks each run. The output
must be the old file or the new one, and no other file may be left. The run must print one line and return the documented exit
code. HDF5 can crash if an allocation of its own fails: then the old output must be there. Usage: fail_each_call.py [--places [--one-of=K] | --all] [COMMAND...]

Without an option, only allocations of 16 kB or more fail. With --all, every allocation fails in turn, which takes hours. With
--places, the script chooses calls by call site (a stack of functions): the first, second, fourth ... and last call of each.
With --one-of=K in addition, it takes every K-th of those. Environment: SLIPFRONT (the program), SLIPFRONT_SOURCE, FAILING_CALLS
(the library of failing_calls.c)."""

import concurrent.futures
import itertools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM, SOURCE, SHIM = os.environ["SLIPFRONT"], pathlib.Path(os.environ["SLIPFRONT_SOURCE"]), os.environ["FAILING_CALLS"]
KINDS = ("open", "write", "fsync", "rename", "close", "malloc")
#: The law has no quotes. The program first tries such a word as TOML.
SMALL = ["--set", "pulse.cells=16", "--set", "chain.scale=20", "--set", "time.end=0.5", "--set", "friction.law=none"]
STEP = str(SOURCE / "cases/step.toml")
EVENT = "name,rupture_velocity,slip_velocity\na,3 km/s,0.5 m/s\n"
#: Command -> arguments. "OUT", "TABLE", "EVENTS" and "UNFINISHED" stand for files of the folder.
JOBS = {
    "pulse": ["pulse", STEP, *SMALL, "-o", "OUT"],
    "table": ["pulse", "TABLE", *SMALL, "-o", "OUT"],
    "resume": ["pulse", STEP, *SMALL, "--resume", "UNFINISHED", "-o", "OUT"],
    "chain": ["chain", STEP, *SMALL, "-o", "OUT"],
    "compare": ["compare", STEP, *SMALL, "--scale", "20", "-o", "OUT"],
    "event": ["event", "EVENTS", "--samples", "20", "-o", "OUT"],
    "relations": ["relations", "--stress", "1", "--csv"],
}


def by_places(trace):
    """The calls of a trace (FAIL_TRACE) that must fail: numbers 1, 2, 4, 8 ... and the last of each call site."""
    places = {}
    for line in trace.read_text().splitlines():
        n, place = line.split()
        places.setdefault(place, []).append(int(n))
    chosen = sorted({numbers[i] for numbers in places.values() for i in [*(2**k - 1 for k in range(len(numbers).bit_length())), -1]})
    return chosen if len(chosen) < 100 else chosen[:: one_of(sys.argv)]


def one_of(arguments):
    return next((int(word.partition("=")[2]) for word in arguments if word.startswith("--one-of=")), 1)


class Job:
    """A command that runs in its own folder."""

    def __init__(self, command):
        self.crashes = 0  #: of HDF5
        self.command, self.folder = command, pathlib.Path(tempfile.mkdtemp(prefix="slipfront-faults-"))
        places = {"OUT": "out.nc", "TABLE": "table.toml", "EVENTS": "events.csv", "UNFINISHED": "unfinished.nc"}
        self.arguments = [str(self.folder / places[word]) if word in places else word for word in JOBS[command]]
        (self.folder / "events.csv").write_text(EVENT)
        table = "[initial]\nprofile = 'table'\nfile = 'stress.nc'\n[domain]\nleft = -1\nright = 1\n"
        (self.folder / "table.toml").write_text(table)
        shutil.copy(SOURCE / "tests/data/stress.nc", self.folder / "stress.nc")
        self.out = self.folder / "out.nc"
        self.run({}, self.resumable(), check=True)
        assert self.run({}, check=True).returncode == 0
        self.new = self.bytes()
        self.rest = sorted(os.listdir(self.folder))

    def resumable(self):
        return ["pulse", STEP, *SMALL, "-o", str(self.folder / "unfinished.nc")] if self.command == "resume" else ["--version"]

    def bytes(self):
        return self.out.read_bytes() if self.out.exists() else b""

    def run(self, environment, arguments=None, check=False):
        done = subprocess.run([PROGRAM, *(arguments or self.arguments)], env={**os.environ, **environment}, capture_output=True, text=True, timeout=1200)
        assert not check or done.returncode == 0, done
        return done

    def places(self, kind):
        """The numbers of the calls that must fail. A run in which no call fails gives them."""
        trace = self.folder.with_suffix(".trace")
        self.run({"LD_PRELOAD": SHIM, "FAIL_CALL": kind, "FAIL_TRACE": str(trace)}, check=True)
        numbers = by_places(trace) if trace.exists() else []
        trace.unlink(missing_ok=True)
        return numbers

    def fail(self, kind, n, least):
        """Runs a command whose n-th call fails. Returns (whether there was such a call, a list of faults)."""
        report = self.folder.with_suffix(".report")
        report.unlink(missing_ok=True)
        old = b"an old result"
        if self.out.exists():
            self.out.write_bytes(old)
        done = self.run({"LD_PRELOAD": SHIM, "FAIL_CALL": kind, "FAIL_AT": str(n), "FAIL_LEAST": str(least), "FAIL_REPORT": str(report)})
        failed = "failed" in report.read_text()
        if "in HDF5" in report.read_text() and done.returncode != 0:
            return True, [f"{self.command}: {kind} {n}: {text}" for text in self.faults_after_hdf5(old, done.returncode)]
        wrong = []
        # Exit code 2 means that the input is wrong. That is false if only memory is short.
        if done.returncode not in ((0, 3, 4) if failed and kind == "malloc" else (0, 2, 3, 4) if failed else (0,)):
            wrong.append(f"exit code {done.returncode}")
        lines = [line for line in done.stderr.splitlines() if not line.startswith("slipfront: warning: ")]
        if done.returncode and (len(lines) != 1 or not lines[0].startswith("slipfront: ")):
            wrong.append(f"printed {done.stderr[-300:]!r}")
        # If a catalogue cannot be read, the output holds the reason instead of its events, and the exit code reports that.
        with_reason = self.command == "event" and done.returncode in (2, 3) and self.bytes()[:4] == b"\x89HDF"
        if self.new and self.bytes() not in (old, self.new) and not with_reason:
            wrong.append("the output is neither the old nor the new file")
        if self.new and done.returncode == 0 and self.bytes() != self.new:
            wrong.append("the output is not the new file")
        if self.command == "compare" and done.returncode:
            (self.folder / "out.unfinished.nc").unlink(missing_ok=True)  # it holds the completed levels
        if sorted(os.listdir(self.folder)) != self.rest:
            wrong.append(f"left {sorted(set(os.listdir(self.folder)) - set(self.rest))}")
            for name in set(os.listdir(self.folder)) - set(self.rest):
                (self.folder / name).unlink()
        return failed, [f"{self.command}: {kind} {n}: {text}" for text in wrong]

    def faults_after_hdf5(self, old, code):
        """HDF5 may have crashed. The old result must be there, and no other file but the one that was being written and the completed
        levels of a comparison."""
        self.crashes += code < 0 or code == 255
        wrong = [] if self.bytes() in (old, self.new) else ["the output is neither the old nor the new file"]
        left = sorted(set(os.listdir(self.folder)) - set(self.rest))
        allowed = r"out(\.unfinished)?\.nc\.part\d+-\d+" + r"|out\.unfinished\.nc" * (self.command == "compare")
        wrong += [f"left {name}" for name in left if not re.fullmatch(allowed, name)]
        for name in left:
            (self.folder / name).unlink()
        return wrong


def fail_all(command, kinds, least, by_place):
    job, count, wrong = Job(command), 0, []
    for kind in kinds:
        for n in job.places(kind) if by_place else itertools.count(1):
            failed, more = job.fail(kind, n, least)
            wrong += more
            if not failed and not by_place:  # threads make their calls in varying order, so some runs have fewer calls of a site
                break
            count += failed
    shutil.rmtree(job.folder)
    job.folder.with_suffix(".report").unlink(missing_ok=True)
    return count, job.crashes, wrong


def main(arguments):
    by_place = "--places" in arguments
    least = 0 if by_place or "--all" in arguments else 16384
    commands = [word for word in arguments if not word.startswith("--")] or list(JOBS)
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as workers:
        results = list(workers.map(lambda command: fail_all(command, KINDS, least, by_place), commands))
    for command, (count, crashes, wrong) in zip(commands, results):
        print(f"{command}: {count} calls failed, {crashes} crashes of HDF5, {len(wrong)} wrong")
        for text in wrong[:20]:
            print("  " + text)
    return 1 if any(wrong for *_, wrong in results) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
