"""Runs the program and reads its results."""

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
PROGRAM = os.environ.get("SLIPFRONT", str(ROOT / "build/release/bin/slipfront"))
RESUME_CHECK = pathlib.Path(PROGRAM).with_name("resume_check")
CPU_LIMIT = int(os.environ.get("SLIPFRONT_CPU_LIMIT", "20"))  # seconds of processor time for one run


class Failed(Exception):
    """The program ended with an exit code other than 0, or did not end."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def limit_time():
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_LIMIT, CPU_LIMIT + 1))


def number(value):
    return math.nan if value is None else value


def run(s, command="pulse", profiles=False, arguments=()):
    """The results of a run of the scenario: `summary`, a dict; `errors` of its numbers; `warnings`, a list. With `profiles` also
    `fields`, a dict of arrays over time and x, or over time."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scenario.toml")
        pathlib.Path(path).write_text(scenarios.text(s), encoding="utf-8")
        output = os.path.join(folder, "out.nc")
        words = [PROGRAM, command, path, "--json", "--threads", "1", *arguments]
        done = subprocess.run(words + (["-o", output] if profiles else []), capture_output=True, text=True,
                              preexec_fn=limit_time, check=False)
        if done.returncode == -signal.SIGXCPU:
            raise Failed("too slow", f"not finished after {CPU_LIMIT} s of processor time")
        if done.returncode != 0:
            raise Failed(done.returncode, done.stderr.strip().split("\n")[-1].replace(path, "scenario.toml"))
        printed = json.loads(done.stdout)
        errors = {key: number(value) for key, value in printed.pop("errors", {}).items()}
        warnings = printed.pop("warnings", [])
        summary = {key: number(value) for key, value in printed.items()}
        fields = read_fields(output) if profiles else {}
        return SimpleNamespace(summary=summary, errors=errors, fields=fields, warnings=warnings)


def resumes_to_the_same_bits(s):
    """Whether a run in pieces ends like a run in one piece. A run that exceeds the time limit counts as equal."""
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
    """None if a run of the scenario ends well, and otherwise a text that describes the fault. A run ends well if it finishes, is
    refused (exit code 2) or stops with a reason (4). It must do so within the time limit, and its message must have no nan."""
    with tempfile.TemporaryDirectory() as folder:
        path = scenarios.write(s, pathlib.Path(folder))
        done = subprocess.run([PROGRAM, command, path, "--json", "--threads", "1"], capture_output=True, text=True,
                              preexec_fn=limit_time, check=False)
    message = done.stderr.strip().split("\n")[-1]
    if done.returncode == -signal.SIGXCPU:
        return f"not finished after {CPU_LIMIT} s of processor time"
    if done.returncode not in (0, 2, 4):
        return f"exit {done.returncode}: " + " ".join(line for line in done.stderr.split("\n") if "ERROR" in line or "SUMMARY" in line)
    if re.search(r"\bnan\b", message):
        return f"exit {done.returncode}: {message}"
    return None
