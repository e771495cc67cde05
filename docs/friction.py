"""Prints the table of docs/friction.md: slip at x = 0 by the average (pulse) and by every dislocation (chain), law by law.

Usage: friction.py PROGRAM [LAW...]   (build/release/bin/slipfront). Takes some fifty minutes on two cores.
"""

import json
import pathlib
import subprocess
import sys

PROGRAM = sys.argv[1]
CASE = str(pathlib.Path(__file__).parent.parent / "cases" / "step.toml")  # 0.855 into the empty side, to t = 2 pi
SCALES = (1000, 4000)
STATE = {"strength": 0.05, "characteristic_slip": 0.05, "reference_velocity": 0.05}
SETS = {
    "viscous": [{"coefficient": c} for c in (0.1, 0.5, 2)],
    "coulomb": [{"coefficient": c} for c in (0.01, 0.03, 0.06)],
    "power": [{"coefficient": 0.1, "exponent": 0.5}, {"coefficient": 0.5, "exponent": 1.5}, {"coefficient": 2, "exponent": 2}],
    "formula": [{"formula": f} for f in ("0.2*w+0.3*w^2", "0.1*sqrt(w)", "0.5*w/(1+w)")],
    "n-shaped": [{"coefficient": c, "velocity": v} for c, v in ((0.1, 0.05), (0.3, 0.2), (0.05, 0.02))],
    "flash-heating": [{"strength": a, "weakened": b, "velocity": v} for a, b, v in ((0.05, 0.01, 0.1), (0.08, 0.02, 0.3), (0.03, 0.003, 0.05))],
    "slip-weakening": [{"strength": a, "residual": b, "characteristic_slip": d} for a, b, d in ((0.08, 0.02, 0.1), (0.05, 0.03, 0.3), (0.04, 0.0, 0.05))],
    "rate-and-state": [STATE | {"direct_effect": 0.01, "evolution_effect": 0.015}, STATE | {"direct_effect": 0.015, "evolution_effect": 0.01},
                       STATE | {"direct_effect": 0.01, "evolution_effect": 0.015, "state": "slip"}],
}


def slip(command, law, values, *settings):
    """Slip at x = 0 at the end of a run."""
    friction = [f"friction.law={law}", *(f"friction.{key}={value}" for key, value in values.items())]
    done = subprocess.run([PROGRAM, command, CASE, "--json", "--set", *friction, *settings], capture_output=True, check=True, text=True)
    return json.loads(done.stdout)["slip_at_origin"]


def slips(law, values):
    """Of the pulse, and of the chain at each scale."""
    return [slip("pulse", law, values, "pulse.cells=400"), *(slip("chain", law, values, f"chain.scale={scale}") for scale in SCALES)]


print("| law | parameters | pulse | " + " | ".join(f"chain, scale {scale}" for scale in SCALES) + " | difference |")
print("|---|---|---|" + "---|" * len(SCALES) + "---|")
for name in sys.argv[2:] or SETS:
    for parameters in SETS[name]:
        average, *chains = slips(name, parameters)
        text = ", ".join(f"{key} {value}" for key, value in parameters.items())
        print(f"| {name} | {text} | {average:.5f} | " + " | ".join(f"{c:.5f}" for c in chains) + f" | {100 * (average / chains[-1] - 1):+.1f} % |", flush=True)
