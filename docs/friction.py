"""Prints the table of docs/friction.md: slip at x = 0 by the average (pulse) and by every dislocation (chain), law by law.

Usage: friction.py PROGRAM [LAW...]   (build/release/bin/slipfront). Takes some fifty minutes on two cores.
docs/check_numbers.py compares the page with runs of the same laws.
"""

import json
import pathlib
import subprocess
import sys

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


SYMBOLS = {"coefficient": "C", "exponent": "n", "formula": "f =", "weakened": "f_w", "residual": "f_d", "characteristic_slip": "D_c",
           "reference_velocity": "w_0", "direct_effect": "a", "evolution_effect": "b", "state": "state"}


def symbol(law, key):
    """The symbol of a parameter in the table."""
    if key == "velocity":
        return "w_p" if law == "n-shaped" else "w_w"
    if key == "strength":
        return "f_s" if law == "slip-weakening" else "f_0"
    return SYMBOLS[key]


def in_words(law, values):
    """The cell "parameters" of a row."""
    return ", ".join(f"{symbol(law, key)} {value}" for key, value in values.items())


def settings(law, values):
    """The law as overrides of a scenario."""
    return [f"friction.law={law}", *(f"friction.{key}={value}" for key, value in values.items())]


def slip(program, command, law, values, *more):
    """Slip at x = 0 at the end of a run."""
    done = subprocess.run([program, command, CASE, "--json", "--set", *settings(law, values), *more], capture_output=True, check=True, text=True)
    return json.loads(done.stdout)["slip_at_origin"]


def main(program, laws):
    print("| law | parameters | pulse | " + " | ".join(f"scale {scale}" for scale in SCALES) + " | difference |")
    print("|---|---|---|" + "---|" * len(SCALES) + "---|")
    for law in laws or SETS:
        for values in SETS[law]:
            average = slip(program, "pulse", law, values, "pulse.cells=400")
            chains = [slip(program, "chain", law, values, f"chain.scale={scale}") for scale in SCALES]
            print(f"| {law} | {in_words(law, values)} | {average:.5f} | " + " | ".join(f"{c:.5f}" for c in chains) + f" | {100 * (average / chains[-1] - 1):+.1f} % |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
