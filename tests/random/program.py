"""Runs of the program, and what they give."""

import json
import math
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
from types import SimpleNamespace

import netCDF4
import numpy as np

import scenarios

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SLIPFRONT", str(ROOT / "build/dev/bin/slipfront"))
RESUME_CHECK = pathlib.Path(PROGRAM).with_name("resume_check")
CPU_LIMIT = int(os.environ.get("SLIPFRONT_CPU_LIMIT", "20"))  # seconds of the processor, for one run


class Failed(Exception):
    """The program ended with another code than 0, or did not end."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def limit_time():
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_LIMIT, CPU_LIMIT + 1))


def number(value):
    return math.nan if value is None else value


def run(s, command="pulse", profiles=False, arguments=()):
    """What a run of the scenario says: `summary`, a dict; `errors` of its numbers; `warnings`, a list; with `profiles` also
    `fields`, a dict of arrays over time and x, or over time."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scenario.toml")
        pathlib.Path(path).write_text(scenarios.text(s), encoding="utf-8")
        output = os.path.join(folder, "out.nc")
        words = [PROGRAM, command, path, "--json", "--threads", "1", *arguments]
        done = subprocess.run(words + (["-o", output] if profiles else []), capture_output=True, text=True,
                              preexec_fn=limit_time, check=False)
        if done.returncode == -signal.SIGXCPU:
            raise Failed("too slow", f"not done after {CPU_LIMIT} s of the processor")
        if done.returncode != 0:
            raise Failed(done.returncode, done.stderr.strip().split("\n")[-1].replace(path, "scenario.toml"))
        told = json.loads(done.stdout)
        errors = {key: number(value) for key, value in told.pop("errors", {}).items()}
        warnings = told.pop("warnings", [])
        summary = {key: number(value) for key, value in told.items()}
        fields = read_fields(output) if profiles else {}
        return SimpleNamespace(summary=summary, errors=errors, fields=fields, warnings=warnings)


def resumes_to_the_same_bits(s):
    """Whether a run in pieces ends like a run at once; so does one that takes too long to tell."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "scenario.toml")
        path.write_text(scenarios.text(s), encoding="utf-8")
        done = subprocess.run([RESUME_CHECK, path], capture_output=True, preexec_fn=limit_time, check=False)
        return done.returncode in (0, -signal.SIGXCPU)


def read_fields(path):
    with netCDF4.Dataset(path) as data:
        data.set_auto_mask(False)
        return {name: np.array(data[name][:]) for name in data.variables if name != "checkpoint"}


def ends_well(s, command):
    """What is wrong with how a run of the scenario ends, or None: it finishes, is refused (2), or gives up with a reason (4);
    no number that it prints is infinite or none where it should be one, and it does not run into the limit of time."""
    with tempfile.TemporaryDirectory() as folder:
        path = scenarios.write(s, pathlib.Path(folder))
        done = subprocess.run([PROGRAM, command, path, "--json", "--threads", "1"], capture_output=True, text=True,
                              preexec_fn=limit_time, check=False)
    said = done.stderr.strip().split("\n")[-1]
    if done.returncode == -signal.SIGXCPU:
        return f"not done after {CPU_LIMIT} s of the processor"
    if done.returncode not in (0, 2, 4):
        return f"exit {done.returncode}: " + " ".join(line for line in done.stderr.split("\n") if "ERROR" in line or "SUMMARY" in line)
    if re.search(r"\bnan\b", said):
        return f"exit {done.returncode}: {said}"
    return None
