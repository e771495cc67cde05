#!/usr/bin/env python3
"""Times whole runs of a step with each kind of force, friction and contact, as a table for docs/chain.md.

    bench/chain_forces.py [SLIPFRONT] [SCALE]

Each number is the median of five runs, which take turns."""

import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

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
KINDS = {
    "none": [],
    "viscous friction": ["friction.law=viscous", "friction.coefficient=0.5"],
    "Coulomb friction": ["friction.law=coulomb", "friction.coefficient=0.05"],
    "power law, n = 2": ["friction.law=power", "friction.coefficient=0.1", "friction.exponent=2"],
    "rate-and-state friction": STATE,
    "force 0.01 sin x": ['forcing.formula="0.01*sin(x)"'],
    "force 0.01 sin(x - t)": ['forcing.formula="0.01*sin(x-t)"'],
    "contact 1 + 0.2 tanh x": ['interface.contact="1+0.2*tanh(x)"'],
}


def seconds(command):
    """Processor time of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/slipfront")
    scale = sys.argv[2] if len(sys.argv) > 2 else "1000"
    with tempfile.TemporaryDirectory() as folder:
        scenario = pathlib.Path(folder, "step.toml")
        scenario.write_text(STEP, encoding="utf-8")
        times = {kind: [] for kind in KINDS}
        for _ in range(5):
            for kind, runs in times.items():
                runs.append(seconds([program, "chain", str(scenario), "--quiet", "--json", "--threads", "1", "--set",
                                     f"chain.scale={scale}", *KINDS[kind]]))
    print("| force, friction or contact | processor time, s | over that without |\n|---|---|---|")
    for kind, runs in times.items():
        median = statistics.median(runs)
        print(f"| {kind} | {median:.2f} | {median / statistics.median(times['none']):.1f} |")


if __name__ == "__main__":
    main()
