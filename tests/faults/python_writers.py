"""fail_each_call.py for what Python writes: the n-th call fails, n = 1, 2, ... until it succeeds. Each attempt is a process
forked from this one, in which failing_calls.c counts from the start of the job. Usage, with that library preloaded and the
package on the path: python_writers.py [--places [--one-of=K] | --all] [JOB...], as there. With --places FAIL_TRACE has to name a file.

A crash inside NumPy, whose sums crash where memory ends (`np.array([False]).any()` with the first allocation failed), or inside HDF5
is counted and not held against the package: the output must be the old or the new one all the same."""

import ctypes
import faulthandler
import itertools
import os
import pathlib
import re
import shutil
import sys
import tempfile

import matplotlib.pyplot  # so that no attempt has to
import numpy as np
import pandas  # noqa: F401, so that no attempt has to
import xarray as xr

import slipfront
from fail_each_call import by_places
from slipfront import _files, plots
from slipfront.plots import movie
from slipfront.reproduce import outputs
from slipfront.reproduce.picture import Picture

SHIM = ctypes.CDLL(None)
KINDS = ("open", "write", "fsync", "rename", "close", "malloc")
PULSE = {"initial": {"stress_left": 0.8, "stress_right": 0}, "pulse": {"cells": 12}, "time": {"end": 0.3}}
DATA = xr.Dataset({"a": ("x", np.linspace(0, 1, 5000)), "text": ("x", np.array(["é"] * 5000, dtype=object))}, {"x": np.arange(5000)}, {"title": "t"})
FRAMES = [np.full((40, 60, 3), shade, dtype=np.uint8) for shade in (0, 120, 250)]


#: Made before any call fails: NumPy and matplotlib crash where memory ends, also where nothing is written.
FIGURE = matplotlib.figure.Figure()
FIGURE.subplots().plot([0, 1], [0, 1])


def reproduction(folder):
    with outputs.whole_folder(folder) as inside:
        outputs.write_picture(inside, Picture("fig", "t", "c", FIGURE, DATA.isel(x=slice(0, 100))))
        outputs.write_rows(inside / "rows.csv", [{"a": 1}])
        _files.write_text(inside / "report.html", "<html>")


#: Name -> (job, its output).
JOBS = {
    "dataset": (lambda path: _files.write_dataset(DATA, path), "a.nc"),
    "sweep": (lambda path: slipfront.sweep(PULSE, {"friction.coefficient": [0.1, 0.2]}, set={"friction.law": "viscous"}, output=path, threads=1), "s.nc"),
    "pulse": (lambda path: slipfront.pulse(PULSE, output=path), "p.nc"),
    "compare": (lambda path: slipfront.compare(PULSE, scales=[60], output=path, threads=1), "c.nc"),
    "figure": (lambda path: plots.save(FIGURE, path), "f.png"),
    "movie": (lambda path: movie.write(FRAMES, path), "m.gif"),
    "reproduction": (reproduction, "r"),
}


def content(path):
    if path.is_dir():
        return {name: content(path / name) for name in sorted(os.listdir(path))}
    return path.read_bytes() if path.exists() else None


def attempt(job, path, kind, n, least):
    """Runs the job in a fork with the n-th call failed. Returns (exit code, or -signal; whether one was failed; the reason)."""
    reader, writer = os.pipe()
    traceback = os.memfd_create("traceback")
    child = os.fork()
    if child == 0:
        run_and_tell(job, path, kind, n, least, writer, traceback)
    os.close(writer)
    said = b""
    while more := os.read(reader, 4096):
        said += more
    status = os.waitpid(child, 0)[1]
    SHIM.fail_calls(b"", 0)
    os.close(reader)
    place = re.search(rb'File "([^"]*)"', os.pread(traceback, 4096, 0))
    os.close(traceback)
    failed, _, reason = (said or b"1 crashed in " + (place[1] if place else b"no Python")).decode(errors="replace").partition(" ")
    return os.waitstatus_to_exitcode(status), failed != "0", reason


def run_and_tell(job, path, kind, n, least, writer, traceback):
    """The child: its report goes to `writer`, where it crashed to `traceback`."""
    code, reason = 0, ""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    faulthandler.enable(traceback)
    ctypes.c_size_t.in_dll(SHIM, "least").value = least
    SHIM.fail_calls(kind.encode(), n)
    try:
        job(str(path))
    except slipfront.FileError as error:
        code, reason = 3, str(error)
    except MemoryError:
        code = 4
    except BaseException as error:
        code, reason = 1, f"{type(error).__name__}: {error}"
    failed = SHIM.calls_failed()
    SHIM.fail_calls(b"", 0)
    os.write(writer, f"{failed} {reason}".encode()[:1000])
    os._exit(code)


def places(job, path, kind):
    """The numbers of calls to fail, from a run in which none fails."""
    trace = pathlib.Path(os.environ["FAIL_TRACE"])
    os.truncate(trace, 0)
    attempt(job, path, kind, 0, 0)
    return by_places(trace)


def fail_all(name, least, by_place):
    job, output = JOBS[name]
    folder = pathlib.Path(tempfile.mkdtemp(prefix="slipfront-faults-"))
    path, wrong, count, crashes = folder / output, [], 0, 0
    code, _, reason = attempt(job, path, "", 0, least)
    assert code == 0, reason
    old = new = content(path)
    wanted = slipfront.open(path) if name == "sweep" else None
    for kind in KINDS:
        for n in places(job, path, kind) if by_place else itertools.count(1):
            code, failed, reason = attempt(job, path, kind, n, least)
            there = content(path)
            crashed = code != 0 and (SHIM.failed_in_hdf5() or f"crashed in {os.path.dirname(np.__file__)}/" in reason)
            crashes += crashed
            problems = [f"exit {code} {reason}"] * (code not in ((0, 3, 4) if failed else (0,)) and not crashed)
            problems += ["two lines"] * ("\n" in reason)
            # A point of a sweep that ran out of memory is a gap with its reason; what was done stays for --resume.
            # If an allocation of its own fails, HDF5 may also place the same values at other positions in the file.
            gap = False
            if name == "sweep" and code == 0 and there != new:
                data = slipfront.open(path)
                gap = "out of memory" in data["failure"].values or data.identical(wanted)
            for kept in ("s.nc.part", "c.unfinished.nc"):  # the levels of a comparison that were done
                (folder / kept).unlink(missing_ok=True)
            # Without memory for a font, matplotlib draws with another.
            gap = gap or (name == "figure" and kind == "malloc" and code == 0 and there[:4] == b"\x89PNG")
            problems += ["neither the old nor the new"] * (not isinstance(there, dict) and there not in (old, new) and not gap)
            problems += ["not whole"] * (isinstance(there, dict) and set(there) != set(new))
            left = [name for name in os.listdir(folder) if name != output and not (crashed and ".part" in name)]
            problems += [f"left {left}"] * bool(left)
            old = there if code == 0 else old
            wrong += [f"{name}: {kind} {n}: {text}" for text in problems]
            for left in os.listdir(folder):
                if left != output:
                    shutil.rmtree(folder / left, ignore_errors=True) if (folder / left).is_dir() else (folder / left).unlink()
            if not failed and not by_place:
                break
            count += failed
    shutil.rmtree(folder)
    print(f"{name}: {count} calls failed, {crashes} crashes in NumPy or HDF5, {len(wrong)} wrong", *wrong[:20], sep="\n  ", flush=True)
    return wrong


if __name__ == "__main__":
    by_place = "--places" in sys.argv
    least = 0 if by_place or "--all" in sys.argv else 16384
    names = [word for word in sys.argv[1:] if not word.startswith("--")] or list(JOBS)
    sys.exit(1 if sum((fail_all(name, least, by_place) for name in names), []) else 0)
