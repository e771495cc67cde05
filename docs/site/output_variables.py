"""Writes the reference of results: output_variables.py PROGRAM CASES > output_variables.md.

It runs short cases and describes what the program writes: the variables of NetCDF files with their attributes, and the
lines of the text, whose names are the keys of JSON."""
import pathlib
import re
import subprocess
import sys
import tempfile

import xarray

SHORT_LOADED_CHAIN = ["--set", "domain.left=-30", "domain.right=30", "time.end=1e5", "output.every=5e4"]


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


def describe_variables(title: str, command: str, datasets: list[xarray.Dataset]) -> None:
    print(f"## {title}\n\n`{command}` writes these variables.\n")
    print("| variable | meaning | unit | dimensions | source |\n|---|---|---|---|---|")
    seen = set()
    for data in datasets:
        for name, variable in data.variables.items():
            if name in seen:
                continue
            seen.add(name)
            source = str(variable.attrs.get("references", "")).replace("Gershenzon, Bambakidis and Skinner (2015), ", "")
            print(f"| `{name}` | {cell(variable.attrs.get('long_name', ''))} | {cell(unit_of(variable))} | {', '.join(variable.dims)} | {cell(source)} |")
    print()


def describe_lines(title: str, command: str, text: str) -> None:
    print(f"## {title}\n\n`{command}` prints one value under each of these names. `--json` uses the names as keys.\n")
    print("| key | meaning |\n|---|---|")
    for line in text.splitlines():
        found = re.match(r"([a-z_]+) +(\S+)(?: +\+- \S+)? *(.*)$", line)
        if found:
            print(f"| `{found[1]}` | {cell(found[3])} |")
    print()


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        run = Program(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(folder))
        print("# Output variables\n")
        print("This page lists every variable of the output files and every key of JSON. The texts and units are those that the")
        print("program writes: the page is made by running short cases. An empty unit means a pure number or a text.\n")
        describe_lines("Values of `relations`", "slipfront relations", run.text("relations", "--stress", "1"))
        describe_lines("Values of `pulse`", "slipfront pulse SCENARIO", run.text("pulse", run.case("step-viscous.toml"), "--quiet"))
        describe_lines("Values of `chain`", "slipfront chain SCENARIO", run.text("chain", run.case("step-viscous.toml"), "--quiet", "--set", "chain.scale=30"))
        pulses = [run.file("pulse", run.case("step-viscous.toml")), run.file("chain", run.case("stick-slip.toml"), *SHORT_LOADED_CHAIN)]
        describe_variables("Files of `pulse` and `chain`", "slipfront pulse SCENARIO -o OUT.nc", pulses)
        describe_variables("Files of `compare`", "slipfront compare SCENARIO -o OUT.nc",
                           [run.file("compare", run.case("step-viscous.toml"), "--set", "chain.scale=30")])
        describe_variables("Files of `event`", "slipfront event FILE -o OUT.nc",
                           [run.file("event", run.case("ets.toml"), "--draws", "10"), run.file("event", run.case("synthetic-fault.fsp"), "--pulse")])


if __name__ == "__main__":
    main()
