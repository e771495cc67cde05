#!/usr/bin/env python3
"""Prints the tables of docs/performance.md, in less than ten minutes on an idle machine.

    ./run bench [--long]                         builds the programs, and runs this script
    bench/table.py [SLIPFRONT] [RUNS] [--long]   RUNS of each kind, by default 3

The runs of all kinds take turns, and the least time of each counts: processor time on one thread,
and the time on the clock with one thread and with two. Growth and the comparison with other
programs follow (growth.py, peers/ratios.py). Rows are left out where a program is missing. --long
adds a chain of 1e8 sites."""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import tempfile
import time

from growth import print_growth
from peers.ratios import print_ratios

ROOT = pathlib.Path(__file__).resolve().parents[1]
STEP = """[initial]
profile = "step"
stress_left = 0.855
stress_right = 0
[domain]
left = -6
right = 6
[time]
end = 6.283185307179586
"""
STATE = ["friction.law=rate-and-state", "friction.strength=0.05", "friction.direct_effect=0.01",
         "friction.evolution_effect=0.005", "friction.reference_velocity=0.1"]
FORCES = {
    "no friction": [],
    "no friction, single precision": ["chain.precision=single"],
    "viscous friction": ["friction.law=viscous", "friction.coefficient=0.5"],
    "viscous friction, single precision": ["friction.law=viscous", "friction.coefficient=0.5", "chain.precision=single"],
    "Coulomb friction": ["friction.law=coulomb", "friction.coefficient=0.05"],
    "power law, n = 2": ["friction.law=power", "friction.coefficient=0.1", "friction.exponent=2"],
    "rate-and-state friction": STATE,
    "force 0.01 sin x": ['forcing.formula="0.01*sin(x)"'],
    "force 0.01 sin(x - t)": ['forcing.formula="0.01*sin(x-t)"'],
    "contact 1 + 0.2 tanh x": ['interface.contact="1+0.2*tanh(x)"'],
}
PLANE = {
    "barrier, grid": ["plane-barrier.toml"],
    "nucleation, grid": ["plane-nucleation.toml"],
    "barrier, every line": ["plane-barrier.toml", "--direct"],
}
LOADED = {
    "block of 11 sites, 300 s": ["laboratory-block.toml"],
    "block of 21 sites, 10,001 outputs": ["laboratory-block.toml", "--set", 'chain.spacing="1 cm"',
                                          'output.every="0.03 s"'],
    "ring of 300 dislocations, one event": ["stick-slip.toml", "--set", "domain.left=-470",
                                            "domain.right=470", "time.end=5e5",
                                            "output.every=1e5"],
}


def measure(command, threads):
    """Processor time and time on the clock of a command, and what it prints."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    words = [*command[:3], "--quiet", "--json", "--threads", str(threads), *command[3:]]
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime, clock, json.loads(done.stdout)


def least_times(commands, runs):
    """By name: least processor time and clock time of one thread, and clock time of two."""
    times = {name: ([], [], []) for name in commands}
    for _ in range(runs):
        for name, command in commands.items():
            processor, clock, _ = measure(command, 1)
            for column, value in zip(times[name], (processor, clock, measure(command, 2)[1])):
                column.append(value)
    return {name: [min(column) for column in columns] for name, columns in times.items()}


def print_rows(title, times):
    print(f"\nWhole runs, least of several; shares of the first row\n\n| {title} | processor time, s | first row over it | two threads over one |")
    print("|---|---|---|---|")
    first = next(iter(times.values()))[0]
    for name, (processor, one, two) in times.items():
        print(f"| {name} | {processor:.2f} | {first / processor:.2f} | {one / two:.2f} |", flush=True)


def print_limits(folder):
    bench = folder / "slipfront_bench"
    if bench.exists():
        print("\nLimits and kernels, one core:", flush=True)
        subprocess.run([bench, "--benchmark_filter=limit|chain_sites/1000000/1|plane_sites",
                        "--benchmark_min_time=0.2"], check=True)
    else:
        print("\nLimits of the machine are left out: slipfront_bench was not built (Debian package libbenchmark-dev)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=str(ROOT / "build/release/bin/slipfront"))
    parser.add_argument("runs", nargs="?", type=int, default=3)
    parser.add_argument("--long", action="store_true")
    given = parser.parse_args()
    program, runs = str(pathlib.Path(given.program).resolve()), given.runs
    model = [line for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
             if line.startswith("model name")]
    print(f"{model[0].partition(': ')[2] if model else 'unknown processor'}, {os.cpu_count()} "
          f"cores, load {os.getloadavg()[0]:.1f}")
    with tempfile.TemporaryDirectory() as folder:
        scenario = str(pathlib.Path(folder, "step.toml"))
        pathlib.Path(scenario).write_text(STEP, encoding="utf-8")
        forces = {name: [program, "chain", scenario, "--set", "chain.scale=1000", *keys]
                  for name, keys in FORCES.items()}
        print_rows("chain, scale 1000", least_times(forces, runs))
        print_growth(program, scenario, runs, given.long)
    for title, command, kinds in (("plane", "plane", PLANE), ("implicit steps", "chain", LOADED)):
        cases = {name: [program, command, str(ROOT / "cases" / words[0]), *words[1:]]
                 for name, words in kinds.items()}
        print_rows(title, least_times(cases, runs))
    print_limits(pathlib.Path(program).parent)
    print_ratios(program)


if __name__ == "__main__":
    main()
