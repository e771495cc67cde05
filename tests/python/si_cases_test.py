"""Each scenario of cases/, and scenarios with each kind of formula and file, in SI units and dimensionless: all outputs agree to 1e-9."""

import json
import math
import os
import re
import tempfile
import tomllib
import unittest

import numpy as np

import slipfront
from support import SOURCE, CommandLine

CASES = os.path.join(SOURCE, "cases")
MEDIUM = {"shear_modulus": "30 GPa", "density": "2700 kg/m3", "poisson_ratio": 0.25, "contact_ratio": 0.01, "asperity_spacing": "2 mm"}
#: The units of this medium, in the words of docs/theory/1_chain.md and by no code of slipfront. Slip is between the faces.
MU, NU, A, B = 30e9, 0.25, 0.01, 2e-3
C = math.sqrt(2 * MU / (2700 * (1 - NU)))
UNITS = {"m": B / A, "s": B / (C * A), "slip": B / math.pi, "stress": MU * A / math.pi, "m/s": C * A / math.pi, "force": MU * A**2 / (math.pi * (1 - NU))}
NAMES = {"slip": "m", "stress": "Pa", "force": "Pa", "stiffness": "Pa/m", "end stiffness": "Pa/m"}
UNITS["stiffness"], UNITS["end stiffness"] = UNITS["force"] / UNITS["slip"], UNITS["stress"] / UNITS["slip"]
#: The unit of each key with a dimension.
UNIT_OF = {
    **{f"initial.{key}": unit for key, unit in {"stress_left": "stress", "stress_right": "stress", "width": "m"}.items()},
    **{f"plane.{edge}": "m" for edge in ("left", "right", "bottom", "top")}, **{f"nucleation.{key}": "m" for key in ("x", "y", "radius")},
    "nucleation.time": "s", "domain.left": "m", "domain.right": "m", "time.end": "s", "output.every": "s", "output.times": "s", "output.probes": "m",
    "chain.spacing": "m", "chain.window": "m", "loading.stiffness": "stiffness", "loading.velocity": "m/s", "loading.event_velocity": "m/s",
    **{f"friction.{key}": "force" for key in ("strength", "weakened", "residual", "direct_effect", "evolution_effect")},
    "friction.velocity": "m/s", "friction.reference_velocity": "m/s", "friction.characteristic_slip": "slip", "friction.initial_state": "s",
}
#: The unit of the value of each formula; 1 is a pure number. Its variables are in m, s and m/s.
FORMULAS = {"initial.formula": "stress", "forcing.formula": "force", "interface.contact": 1, "plane.fixed": 1, "friction.formula": "force", "friction.coefficient": 1}
VARIABLES = {"x": "m", "y": "m", "t": "s", "w": "m/s"}
COLUMNS = {"x": "m", "y": "m", "r": "m", "w": "m/s", "f": "force", "b": "force", "stress": "stress", "slip": "slip"}
CLOCKS = {"wall_seconds", "solve_seconds", "site_updates_per_second"}

STEP = "[initial]\nstress_left = 0.855\nstress_right = 0.2\n[time]\nend = 1\n"
PLANE = "[plane]\nleft = -2\nright = 2\nbottom = -2\ntop = 2\nsolver = 'grid'\n[time]\nend = 0.1\n"
#: Scenarios with the formulas and files that cases/ lacks.
FURTHER = {
    "friction-formula": STEP + "[friction]\nlaw = 'formula'\nformula = '0.3 * (w / 0.1) / (1 + w / 0.2)'\n",
    "friction-table": STEP + "[friction]\nlaw = 'table'\nfile = 'f.csv'\ncoefficient = 2\n",
    "forcing": STEP + "[forcing]\nformula = '0.01 * cos(t) * exp(-x^2)'\n[domain]\nleft = -6.1\nright = 5.95\n",
    "initial-formula": "[initial]\nprofile = 'formula'\nformula = '1 + 0.5 * tanh(-x)'\n[domain]\nleft = -6.1\nright = 5.95\n[time]\nend = 1\n[interface]\ncontact = '1 + 0.01 * x^2'\n",
    "initial-table": "[initial]\nprofile = 'table'\nfile = 'stress.csv'\n[domain]\nleft = -5.1\nright = 4.95\n[time]\nend = 1\n",
    "friction-varies": STEP + "[friction]\nlaw = 'rate-and-state'\nstrength = 0.02\ndirect_effect = '0.004 + 0.001 * tanh(x)'\n"
                       "evolution_effect = { file = 'varies.csv', column = 'b' }\ncharacteristic_slip = '0.1 + 0.01 * x'\nreference_velocity = 0.1\n"
                       "[domain]\nleft = -6.1\nright = 5.95\n",
    "plane-grid": PLANE + "[initial]\nprofile = 'grid'\nfile = 'grid.csv'\n[forcing]\nformula = '0.1 * t + 0.01 * x * y'\n[interface]\ncontact = '1 + 0.01 * x * y'\n",
    "plane-coulomb": PLANE + "[initial]\nprofile = 'formula'\nformula = '3 * exp(-x^2 - y^2)'\n[friction]\nlaw = 'n-shaped'\ncoefficient = 0.3\nvelocity = 0.2\n",
}
FILES = {"varies.csv": "x,b\n-7,0.002\n0,0.003\n7,0.001\n", "f.csv": "w,f\n0,0\n0.1,0.05\n1,0.2\n100,1\n", "stress.csv": "x,stress\n-6,1\n-1,0.9\n1,0.5\n6,0.4\n",
         "grid.csv": "x,y,slip\n" + "".join(f"{x},{y},{3 * math.exp(-(x * x + y * y))}\n" for x in (-2, -1, 0, 1, 2) for y in (-2, -1, 0, 1, 2))}


def with_unit(value, unit):
    if isinstance(value, list):
        return [with_unit(item, unit) for item in value]
    return f"{value * UNITS[unit]!r} {NAMES.get(unit, unit)}"


def formula_in_si(text, unit):
    inside = re.sub(r"\b[xytw]\b", lambda name: f"({name[0]} / {UNITS[VARIABLES[name[0]]]!r})", str(text))
    return f"({inside})" if unit == 1 else f"{UNITS[unit]!r} * ({inside})"


def in_si(scenario, of_file):
    """The scenario with all numbers, formulas and files in SI units. `of_file` converts a file and returns its name."""
    si = {table: dict(keys) if isinstance(keys, dict) else keys for table, keys in scenario.items()}
    plane = "plane" in si
    for table, keys in si.items():
        for key, value in list(keys.items()) if isinstance(keys, dict) else []:
            name = f"{table}.{key}"
            unit = UNIT_OF.get(name)
            if name == "friction.coefficient" and keys["law"] in ("coulomb", "n-shaped"):
                unit = "force"
            if unit == "stiffness" and keys.get("where", "everywhere") != "everywhere":
                unit = "end stiffness"
            if table == "friction" and isinstance(value, dict):
                keys[key], keys["units"] = {**value, "file": of_file(value["file"])}, "SI"
            elif unit and isinstance(value, str):
                keys[key], keys["units"] = formula_in_si(value, unit), "SI"
            elif unit:
                keys[key] = with_unit(value, unit)
            elif key == "file":
                keys[key], keys["units"] = of_file(value), "SI"
            elif name in FORMULAS and (name != "friction.coefficient" or isinstance(value, str)) and not isinstance(value, int):
                keys[key], keys["units"] = formula_in_si(value, "slip" if plane and name == "initial.formula" else FORMULAS[name]), "SI"
            elif name == "forcing.formula":
                keys[key] = with_unit(value, "force")
    return si


def in_toml(value):
    return "{" + ", ".join(f"{key} = {in_toml(item)}" for key, item in value.items()) + "}" if isinstance(value, dict) else json.dumps(value)


def to_toml(scenario):
    lines = []
    for table, keys in scenario.items():
        if isinstance(keys, dict):
            lines += [f"[{table}]", *(f"{key} = {in_toml(value)}" for key, value in keys.items())]
    return "\n".join(lines) + "\n"


def shortened(scenario):
    """The scenario with few cells, and so short that it takes a tenth of a second."""
    scenario.pop("event", None)
    scenario.pop("medium", None)
    of = {name: scenario.setdefault(name, {}) for name in ("time", "output", "chain", "plane" if "plane" in scenario else "pulse")}
    of["time"]["end"] = min(of["time"].get("end", 1), 0.1 if "plane" in of else 1)
    of["output"].pop("times", None)
    of["output"]["every"] = of["time"]["end"] / 2
    if "loading" not in scenario:
        of["chain"]["scale"] = 60
    else:
        scenario["domain"] = {"left": -20.0, "right": 20.0}
    if "plane" in of:
        of["plane"].update(cells=60, loops=16, angles=16)
    else:
        of["pulse"]["cells"] = 24
    return scenario


class Outputs(CommandLine):
    """The outputs of a scenario, in both ways of writing it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, text in FILES.items():
            self.write(name, text)
        with open(os.path.join(CASES, "plane-rings.csv"), encoding="utf-8") as file:
            self.write("plane-rings.csv", file.read())

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def file_in_si(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            header, *rows = [line.split(",") for line in file.read().split()]
        scaled = [[repr(float(cell) * UNITS[COLUMNS[column]]) for column, cell in zip(header, row, strict=True)] for row in rows]
        self.write(f"si-{name}", "\n".join(",".join(row) for row in [header, *scaled]) + "\n")
        return f"si-{name}"

    def scenarios(self, name):
        """The paths of both scenarios. One is in the units of the model."""
        if name in FURTHER:
            plain = tomllib.loads(FURTHER[name])
        else:
            path = os.path.join(CASES, name + ".toml")
            with open(path, "rb") as file:
                plain = tomllib.load(file)
            for quantity in json.loads(self.ok("units", path, "--json"))["keys"] if isinstance(plain.get("domain", {}).get("left"), str) else []:
                table, key = quantity["key"].split(".")
                plain[table][key] = quantity["model"]
            plain.get("friction", {}).pop("normal_stress", None)
        plain = shortened(plain)
        texts = [to_toml({**scenario, "medium": MEDIUM}) for scenario in (plain, in_si(plain, self.file_in_si))]
        self.assertRegex(texts[1], r'"[^"]* (m|Pa|s)"')
        return [self.write(f"{system}.toml", text) for system, text in zip(("plain", "si"), texts, strict=True)]

    def compare_values(self, one, other, where, least=1e-15):
        if isinstance(one, dict):
            self.assertEqual(set(one), set(other), where)
            if where == "plane.energies":  # parts of one balance, as the variables energy_... of the file
                least = 1e-9 * max(abs(value) for value in one.values())
            for key in set(one) - CLOCKS - {"scenario", "title", "warnings", "command"}:
                self.compare_values(one[key], other[key], f"{where}.{key}", least)
        elif isinstance(one, list):
            self.assertEqual(len(one), len(other), where)
            for i, (a, b) in enumerate(zip(one, other, strict=True)):
                self.compare_values(a, b, f"{where}[{i}]")
        elif isinstance(one, float) or isinstance(other, float):
            self.assertEqual(one is None, other is None, where)
            small = 1e-3 if "errors" in where or "error" in where or "drift" in where else 1e-9  # errors have three digits, and those of rounding none
            self.assertTrue(small == 1e-3 or math.isclose(one, other, rel_tol=1e-9, abs_tol=least), f"{where}: {one} {other}")
        else:
            self.assertEqual(one, other, where)

    def compare_datasets(self, one, other):
        self.assertEqual(set(one.variables), set(other.variables))
        for name in one.variables:
            self.assertEqual(one[name].attrs, other[name].attrs, name)
            if one[name].dtype.kind == "f" and not name.endswith(("_error", "_drift")):
                a, b = one[name].values, other[name].values
                if name == "rise_time":  # slip squared over an integral: noise where there is no slip
                    there = np.abs(one.slip.values[-1]) > 1e-6 * np.abs(one.slip.values).max()
                    a, b = a[there], b[there]
                if name.endswith("_front_observed"):  # at t = 0, that of the velocity that the train at rest has by its error
                    a, b = a[1:], b[1:]
                of = np.concatenate([one[key].values.ravel() for key in one.variables if key.startswith("energy_")]) if name.startswith("energy_") else a
                size = np.nanmax(np.abs(of)) if of.size and np.isfinite(of).any() else 0
                np.testing.assert_allclose(b, a, rtol=1e-9, atol=1e-9 * size, err_msg=name)

    def check(self, command, name):
        plain, si = self.scenarios(name)
        files = [path.replace(".toml", ".nc") for path in (plain, si)]
        printed = [json.loads(self.ok(command, path, "--json", "--quiet", "--si", "-o", file)) for path, file in zip((plain, si), files, strict=True)]
        self.compare_values(*printed, command)
        self.compare_datasets(*(slipfront.open(file) for file in files))
        self.compare_texts(*(self.ok(command, path, "--quiet", "--si") for path in (plain, si)))
        run = getattr(slipfront, command)
        self.compare_datasets(*(run(path, si=True) for path in (plain, si)))
        if command != "plane":
            self.compare_datasets(*(slipfront.sweep(path, {"pulse.cells": [24]}, command=command, si=True) for path in (plain, si)))

    def compare_texts(self, *texts):
        lines = [[line for line in text.splitlines() if not any(clock in line for clock in CLOCKS)] for text in texts]
        number = r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?"
        for one, other in zip(*lines, strict=True):
            self.assertEqual(re.sub(number, "#", one).split(), re.sub(number, "#", other).split())
            if "error" not in one and "drift" not in one:
                for a, b in zip(re.findall(number, one), re.findall(number, other), strict=True):
                    self.assertTrue(math.isclose(float(a), float(b), rel_tol=2e-5, abs_tol=1e-12), (one, other))


def add_tests():
    names = [name[:-5] for name in sorted(os.listdir(CASES)) if name.endswith(".toml")]
    like_others = {"parkfield-2004", "fig-08", "fig-09", "fig-10", "fig-11",  # the keys of fig-07 and fig-12
                   "asperity", "two-asperities", "gouge-patch",  # the keys of laboratory-block, and formulas and tables of friction-varies
                   "plane-wave"}  # no rupture around the origin: for --direct only, whose energies are differences near their rounding
    # pulse places the points of a fold by comparisons that rounding decides (overtaking: 16 or 19 steps with few points)
    for name in [name for name in names if name not in like_others] + list(FURTHER):
        for command in ["plane"] if name.startswith("plane") else ["chain"] if name in ("stick-slip", "laboratory-block", "precursors", "overtaking") else ["pulse"] if name in ("ets", "overdamped") else ["pulse", "chain"]:
            def test(self, command=command, name=name):
                self.check(command, name)
            setattr(Outputs, f"test_{command}_{name.replace('-', '_')}", test)


add_tests()

if __name__ == "__main__":
    unittest.main()
