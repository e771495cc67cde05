"""Writes the reference of results: output_variables.py PROGRAM CASES > output_variables.md.

It runs short cases and describes what the program writes: the variables of NetCDF files with their attributes, and the
lines of the text, whose names are the keys of JSON."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
from typing import Iterator

import xarray

SHORT_LOADED_CHAIN = ["--set", "domain.left=-30", "domain.right=30", "time.end=1e5", "output.every=5e4"]
LOADED_CHAIN_WITH_EVENTS = ["--set", "domain.left=-30", "domain.right=30", "time.end=1e6"]

#: Keys that only JSON has: those of tables and lists, and of diagnostics. Others have the name of a variable or a line.
JSON_ONLY = {
    "unit_system": "SI, if results are in SI units",
    "units": "SI unit of each key, if results are in SI units",
    "reasons": "why a number is null, for each key",
    "errors": "estimated error of each number of a `pulse` run",
    "friction": "results of `relations` with a friction coefficient or a ratio of slip velocities, one for each closure",
    "measure": "the slip velocity that a ratio is about: origin, mean, peak or time-mean",
    "slip_velocity_ratio_error": "error of the ratio, from the table",
    "front_ratio": "position of the observed front (threshold 1e-3) over |V-| T, from the table",
    "stress_drop_share": "stress drop at x = 0 over the stress before the rupture, from the table",
    "friction_coefficient_error": "error of the coefficient, from the table",
    "events": "list of events: observed ones of `event`, slip events of a loaded `chain`",
    "onset": "time at which a slip event begins, in b / (c A)",
    "duration": "duration of a slip event, in b / (c A)",
    "load": "mean force on a site before a slip event, in mu A^2 / (pi (1 - nu)), or the stress at a pulled end, in mu A / pi",
    "largest_slip": "slip of the part that slips most in a slip event, in b / (2 pi)",
    "peak_velocity": "largest mean slip velocity of a part in a slip event, in c A / pi",
    "origin": "x of the part that moves first in a slip event, in b / A",
    "length": "length of all parts that move in a slip event, in b / A",
    "complete": "0 if the run ended within the slip event",
    "merged": "number of other slip events that a slip event has met, which are part of it",
    "reference": "level with which `compare` compares the others",
    "levels": "list of the levels of `compare`",
    "level": "name of a level",
    "difference": "value of a level minus that of the reference",
    "trend": "how the differences of the chains change with their scale",
    "exponent": "p, if a difference falls as scale^-p",
    "extrapolated": "value of the chain extrapolated to infinite scale; null if the difference does not fall with the scale",
    "notes": "remarks in words",
    "posterior": "posterior distribution of an event",
    "prior_share": "width of an interval over that of the prior; near 1 the data say nothing",
    "trade_off": "contact ratio and stress at given damping numbers, if only velocities are known",
    "suffices": "whether the diagnostics of the samples pass",
    "seed": "seed of the samples",
    "slip_velocity_is": "the observed slip velocity is that at the origin, a mean, a peak or a time mean",
    "front_threshold": "slip velocity at the observed front over its peak",
    "bounds": "limits of observed quantities, such as <2.7 km/s",
    "moment_n_m": "seismic moment, if the file gives it",
    "contradicted": "true if the observations exclude each other",
    "predictive_check": "for each observation, the probability that a repeated one is below it",
    "observation": "key of an observation in tension",
    "sigmas": "its distance from the prediction of the others, in standard deviations",
    "without": "the posterior without this observation",
    "ignored_columns": "columns of tables without an observation",
    "ignored_quantities": "those of them that look like quantities",
    "tables": "the ignored columns of each file",
    "along_fault": "list of the subfaults of a finite-fault model",
    "segment": "number of the segment of a subfault",
    "faster_than_c": "subfaults of a finite-fault model whose rupture velocity is above c",
    "subfaults": "their number",
    "subfaults_with_velocity": "number of subfaults with a rupture velocity",
    "moment_share": "their fraction of the moment of the model",
    "along_strike_m": "position of a subfault along strike, in m",
    "down_dip_m": "position of a subfault down dip, in m",
    "depth_m": "depth of a subfault, in m",
    "slip_m": "slip of a subfault, in m",
    "x_m": "position of a column of subfaults, in m",
    "model_rupture_time_s": "rupture time of the model at that position, in s",
    "pulse_front_time_s": "time at which the front of the pulse passes, in s",
    "model_slip_m": "slip of the model at that position, in m",
    "pulse_slip_m": "slip of the pulse at that position, in m",
    "end_s": "time at which the pulse ends, in s",
    "columns_reached": "number of columns that the front of the pulse reaches",
    "front_velocity_ratio": "velocity of the front, pulse over model",
    "correlation_of_slip": "correlation of slip along strike, pulse and model",
    "slip_error": "largest slip ahead of the front, over the largest slip",
    "pulse": "pulse along a finite-fault model, with `--pulse`",
    "reason": "reason why there is no pulse",
    "population": "statistics by decade of rupture velocity",
    "rupture_velocity_from": "lower end of a decade, in c",
    "rupture_velocity_to": "upper end of a decade, in c",
    "closed_form": "values of the closed form in the middle of a decade",
}


class Program:
    def __init__(self, program: str, cases: pathlib.Path, folder: pathlib.Path):
        self.program, self.cases, self.folder = program, cases, folder

    def text(self, *arguments: str) -> str:
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"docs/site/output_variables.py: slipfront {' '.join(arguments)}: {done.stderr}")
        return done.stdout

    def case(self, name: str) -> str:
        return str(self.cases / name)

    def file(self, *arguments: str) -> xarray.Dataset:
        path = str(self.folder / "out.nc")
        self.text(*arguments, "--quiet", "-o", path)
        with xarray.open_dataset(path, decode_timedelta=False) as data:
            return data.load()


def cell(text: object) -> str:
    return str(text).replace("|", r"\|").replace("\n", " ")


def unit_of(variable: xarray.DataArray) -> str:
    unit = variable.attrs.get("units", "")
    return variable.attrs.get("dimensional_unit", "") if unit == "1" else unit


def keys_of(value: object) -> Iterator[str]:
    """All keys in an object of JSON and in what it contains."""
    if isinstance(value, dict):
        for key, inside in value.items():
            yield key
            if key != "reasons":  # its keys are those of the numbers
                yield from keys_of(inside)
    elif isinstance(value, list):
        for inside in value:
            yield from keys_of(inside)


def describe_json(run: Program, described: set[str]) -> None:
    """Describes the keys that only JSON has, and stops if a key is not among these and the described names."""
    print("## Further keys of JSON\n\nThese keys occur only in the output of `--json`. `<name>_interval` is the 90 % interval of a value, and")
    print("`<name>_events` in a population is the number of events in which the value is known.\n")
    print("| key | meaning |\n|---|---|")
    for key, meaning in JSON_ONLY.items():
        print(f"| `{key}` | {meaning} |")
    listed = described | set(JSON_ONLY)
    for command in [["relations", "--stress", "1", "--friction-coefficient", "0.1"],
                    ["pulse", run.case("step-viscous.toml")],
                    ["pulse", run.case("step-viscous.toml"), "--si", "--set", "medium.contact_ratio=0.01", "medium.asperity_spacing='1 mm'"],
                    ["chain", run.case("stick-slip.toml"), *LOADED_CHAIN_WITH_EVENTS],
                    ["compare", run.case("step-viscous.toml"), "--set", "chain.scale=30"],
                    ["event", run.case("parkfield-2004.toml"), run.case("synthetic-fault.fsp"), "--pulse"],
                    ["event", run.case("catalogue.csv"), "--samples", "0", "--population"]]:
        keys = {re.sub("_(interval|events)$", "", key) for key in keys_of(json.loads(run.text(*command, "--json", "--quiet")))}
        if missing := sorted(keys - listed):
            sys.exit(f"docs/site/output_variables.py: add the keys {', '.join(missing)} of slipfront {command[0]} to JSON_ONLY")


def describe_variables(title: str, command: str, datasets: list[xarray.Dataset]) -> set[str]:
    """Describes the variables of files, and returns their names."""
    print(f"## {title}\n\n`{command}` writes these variables.\n")
    print("| variable | meaning | unit | dimensions | source |\n|---|---|---|---|---|")
    seen: set[str] = set()
    for data in datasets:
        for name, variable in data.variables.items():
            if name in seen:
                continue
            seen.add(name)
            source = str(variable.attrs.get("references", "")).replace("Gershenzon, Bambakidis and Skinner (2015), ", "")
            print(f"| `{name}` | {cell(variable.attrs.get('long_name', ''))} | {cell(unit_of(variable))} | {', '.join(variable.dims)} | {cell(source)} |")
    print()
    return seen


def describe_lines(title: str, command: str, text: str) -> set[str]:
    """Describes the lines of a text, and returns the names in them."""
    print(f"## {title}\n\n`{command}` prints one value under each of these names. `--json` uses the names as keys.\n")
    print("| key | meaning |\n|---|---|")
    lines = [found for line in text.splitlines() if (found := re.match(r"([a-z_]+) +(\S+)(?: +\+- \S+)? *(.*)$", line))]
    for found in lines:
        print(f"| `{found[1]}` | {cell(found[3])} |")
    print()
    return {found[1] for found in lines}


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        run = Program(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(folder))
        print("# Output variables\n")
        print("This page lists every variable of the output files and every key of JSON. The texts and units are those that the")
        print("program writes: the page is made by running short cases. An empty unit means a pure number or a text.\n")
        described = describe_lines("Values of `relations`", "slipfront relations", run.text("relations", "--stress", "1", "--wide"))
        described |= describe_lines("Values of `pulse`", "slipfront pulse SCENARIO", run.text("pulse", run.case("step-viscous.toml"), "--quiet", "--wide"))
        described |= describe_lines("Values of `chain`", "slipfront chain SCENARIO", run.text("chain", run.case("step-viscous.toml"), "--quiet", "--wide", "--set", "chain.scale=30"))
        pulses = [run.file("pulse", run.case("step-viscous.toml")),
                  run.file("chain", run.case("step-viscous.toml"), "--set", "chain.scale=30", "output.displacement=true", "output.dislocations=true"), run.file("chain", run.case("stick-slip.toml"), *SHORT_LOADED_CHAIN),
                  run.file("chain", run.case("precursors.toml"), "--set", "time.end=0.5 s")]
        described |= describe_variables("Files of `pulse` and `chain`", "slipfront pulse SCENARIO -o OUT.nc", pulses)
        described |= describe_variables("Files of `compare`", "slipfront compare SCENARIO -o OUT.nc",
                                        [run.file("compare", run.case("step-viscous.toml"), "--set", "chain.scale=30")])
        described |= describe_variables("Files of `event`", "slipfront event FILE -o OUT.nc",
                                        [run.file("event", run.case("ets.toml"), "--draws", "10"), run.file("event", run.case("synthetic-fault.fsp"), "--pulse")])
        block = str(run.folder / "block.nc")
        run.text("chain", run.case("precursors.toml"), "--set", "time.end=0.5 s", "--quiet", "-o", block)
        describe_variables("Files of `fronts`", "slipfront fronts RUN.nc -o OUT.nc", [run.file("fronts", block)])
        describe_variables("Files of `laboratory`", "slipfront laboratory TABLE.csv -o OUT.nc",
                           [run.file("laboratory", run.case("synthetic-laboratory-fronts.csv"), "--poisson-ratio", "0.35", "--s-wave-speed", "1300 m/s",
                                     "--shear-modulus", "2 GPa")])
        described |= describe_variables("Fault grids of `event`", "slipfront event MODEL.fsp --fault-grid -o OUT.nc",
                                        [run.file("event", run.case("synthetic-fault.fsp"), "--fault-grid")])
        describe_json(run, described)


if __name__ == "__main__":
    main()
