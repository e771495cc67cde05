"""Prints the tables of docs/plane.md: the averaged equations compared with every dislocation line.

Usage: plane_checks.py PROGRAM [rings] [shock] [shapes] [wave]

PROGRAM is build/release/bin/slipfront. All tables together take some minutes on two cores.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import xarray

PROGRAM = sys.argv[1]
HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests" / "reference"))
import rings  # noqa: E402


NONE: dict[str, object] = {"law": "none"}
#: name: rings, friction of the scenario and as a function, end, probes
SETS = {
    "J0 = 4 / r from 1 to 2, no friction": (rings.in_equilibrium(1, 2, 4), NONE, None, 1, [1.25, 1.65, 2.05]),
    "J0 = 9 / r from 2 to 3, f = 0.2 w": (rings.in_equilibrium(2, 3, 9), {"law": "viscous", "coefficient": 0.2}, lambda w: 0.2 * w, 1.5, [2.3, 2.8, 3.2]),
    "J0 = 4 / r from 1 to 2, f = 1.5 w^2": (rings.in_equilibrium(1, 2, 4), {"law": "power", "coefficient": 1.5, "exponent": 2}, lambda w: 1.5 * np.abs(w) * w, 2, [1.25, 1.65, 2.05]),
    "J0 = 4 / r from 1 to 2, f = 10 w": (rings.in_equilibrium(1, 2, 4), {"law": "viscous", "coefficient": 10}, lambda w: 10 * w, 5, [1.25, 1.65, 2.05]),
}
SHOCK = (rings.Rings(0.5, 1.5, lambda r: 1.6 - 0.4 * r), NONE, None, 1, [0.6, 0.8, 1., 1.2])


def toml(tables):
    """A scenario as text."""
    return "\n".join(f"[{table}]\n" + "\n".join(f"{key} = {json.dumps(value)}" for key, value in keys.items()) for table, keys in tables.items())


def run(command, tables, *words, files=()):
    """Runs a scenario, and returns its numbers and its file."""
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        (place / "scenario.toml").write_text(toml(tables))
        for name, text in files:
            (place / name).write_text(text)
        done = subprocess.run([PROGRAM, command, place / "scenario.toml", "--json", "--quiet", "-o", place / "out.nc", *words], check=True, capture_output=True, text=True)
        with xarray.open_dataset(place / "out.nc") as data:
            return json.loads(done.stdout), data.load()


def square(half):
    return {"left": -half, "right": half, "bottom": -half, "top": half}


def of_rings(name, ring, law, friction, end, probes, scale=2000, loops=240):
    """Rows of a comparison with every ring."""
    half = ring.r[-1] + end + 0.2
    numbers, _ = run("plane", {
        "plane": {**square(half), "fixed": f"x^2 + y^2 < {ring.r[0]**2}", "angles": 8, "cells": 20, "loops": loops},
        "initial": {"profile": "radial", "file": "rings.csv"}, "friction": law,
        "time": {"end": end}, "output": {"every": end, "probes": [[r, 0] for r in probes]}}, files=[("rings.csv", ring.table())])
    name = f"{name}, t = {end}"
    slip, front = rings.follow(ring, scale, end, probes, friction)
    for what, ours, theirs in [*((f"slip at r = {r}", *two) for r, two in zip(probes, zip(numbers["slip_at_probes"], slip))), ("front", numbers["front"], front)]:
        print(f"| {name} | {what} | {ours:.4f} | {theirs:.4f} | {100 * abs(ours / theirs - 1):.2f} % |")
        name = ""


ELLIPSE = "sqrt((x / 1.5)^2 + y^2)"
SHAPES = {
    "elliptic patch": {"plane": {**square(4.2), "fixed": f"{ELLIPSE} < 1"}, "initial": {"profile": "formula", "formula": f"3.2 * (2 - min(2, max(1, {ELLIPSE})))"},
                       "friction": {"law": "viscous", "coefficient": 0.5}, "time": {"end": 1.5}},
    "contact bump": {"plane": {**square(3.4), "fixed": "x^2 + y^2 < 1"}, "initial": {"profile": "radial", "file": str(HERE.parent / "cases/plane-rings.csv")},
                     "interface": {"contact": "1 + 0.3 * exp(-((x - 2)^2 + y^2) / 0.3)"}, "friction": {"law": "viscous", "coefficient": 0.5}, "time": {"end": 1}},
    "friction on one side": {"plane": {**square(3.2), "fixed": "x^2 + y^2 < 1"}, "initial": {"profile": "radial", "file": str(HERE.parent / "cases/plane-rings.csv")},
                             "friction": {"law": "viscous", "coefficient": "1 + tanh(y / 0.1)"}, "time": {"end": 1}},
}


def of_shape(name, tables, scale):
    """A row: slip of the averages and of every line, compared cell by cell."""
    tables = {**tables, "output": {"every": tables["time"]["end"]}}
    tables["plane"] = {**tables["plane"], "cells": 100}
    ours, averaged = run("plane", tables)
    theirs, direct = run("plane", tables, "--direct", "--set", f"chain.scale={scale}")
    difference = np.abs(averaged["slip"][-1] - direct["slip"][-1]).sum() / np.abs(direct["slip"][-1]).sum()
    print(f"| {name}, t = {tables['time']['end']}, scale {scale} | {100 * float(difference):.2f} % | {ours['potency']:.4f} | {theirs['potency']:.4f} | {ours['front']:.4f} | {theirs['front']:.4f} |")


def wave():
    """A plane wave: a strip of the plane, line by line, next to `chain`, and the edge of a very large ring next to `pulse`."""
    stress, end, scale, radius, width = 0.855, 2., 1000, 30000, 0.02
    line = {"initial": {"profile": "step", "stress_left": stress, "stress_right": 0.}, "friction": {"law": "viscous", "coefficient": 0.5}, "time": {"end": end}, "output": {"every": end}}
    pulse, _ = run("pulse", line)
    window = 4 * np.pi / stress / scale  # a probe of a direct run is a square of this width
    chain, _ = run("chain", line, "--set", f"chain.scale={scale}", "domain.left=-4", "domain.right=1.5", "chain.left=free", "chain.right=free", f"chain.window={window}")
    strip, _ = run("plane", {**line, "plane": {"left": -4., "right": 1.5, "bottom": -width / 2, "top": width / 2, "cells": 550},
                             "initial": {"profile": "formula", "formula": f"{stress} * max(0, -x)"},
                             "output": {"every": end, "probes": [[0, 0]]}}, "--direct", "--set", f"chain.scale={scale}")
    edge = rings.Rings(radius - 3, radius, lambda r: stress)
    large, _ = run("plane", {**line, "plane": {**square(radius + 2), "fixed": f"x^2 + y^2 < {radius - 3}^2", "angles": 8, "cells": 8, "loops": 240},
                             "initial": {"profile": "radial", "file": "rings.csv"}, "output": {"every": end, "probes": [[radius, 0]]}}, files=[("rings.csv", edge.table())])
    for what, ours, theirs in [("slip at x = 0, averaged and pulse", large["slip_at_probes"][0], pulse["slip_at_origin"]),
                               ("advance of the front, averaged and pulse", large["front"] - radius, pulse["leading_front"]),
                               (f"slip at x = 0, direct and chain, scale {scale}", strip["slip_at_probes"][0], chain["slip_at_origin"])]:
        print(f"| {what} | {ours:.4f} | {theirs:.4f} | {100 * abs(ours / theirs - 1):.2f} % |")


def main():
    wanted = sys.argv[2:] or ["rings", "shock", "shapes", "wave"]
    if "rings" in wanted:
        for name, case in SETS.items():
            of_rings(name, *case)
    if "shock" in wanted:
        of_rings("kappa = 1.6 - 0.4 r from 0.5 to 1.5, no friction", *SHOCK)
    if "shapes" in wanted:
        for name, tables in SHAPES.items():
            for scale in (50, 100):
                of_shape(name, tables, scale)
    if "wave" in wanted:
        wave()


if __name__ == "__main__":
    main()
