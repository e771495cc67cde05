"""Draws docs/convergence.png: error of the pulse solver against cells, and schemes by error against cost.

Usage: convergence.py PROGRAM SCHEME_COMPARISON   (build/release/bin/slipfront build/release/bin/scheme_comparison).   Needs python3-matplotlib.
"""

import csv
import io
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

PROGRAM, SCHEMES = sys.argv[1], sys.argv[2]
STYLE = pathlib.Path(__file__).parent.parent / "python" / "slipfront" / "slipfront.mplstyle"
CASES = pathlib.Path(__file__).parent.parent / "cases"
CELLS = (25, 50, 100, 200, 400, 800)
# label, case, overrides, quantity, exact value (closed form, exact Riemann problem, or a run with 3200 cells)
CURVES = (
    ("step into empty: slip(0)", "step.toml", (), "slip_at_origin", 0.30290243),
    ("step into empty: leading edge", "step.toml", (), "leading_front", 0.63000386),
    ("shock: W(0)", "shock.toml", (), "slip_velocity_at_origin", 0.0458180779),
    ("tanh, C = 0.5, consistent: W(0)", "fig-08.toml", ("friction.closure=consistent",), "slip_velocity_at_origin", None),
    ("tanh, C = 0.5, paper: W(0)", "fig-08.toml", (), "slip_velocity_at_origin", None),
    ("overdamped, Gamma = 1e6: W(0)", "overdamped.toml", (), "slip_velocity_at_origin", None),
)


def pulse(case, overrides, cells):
    command = [PROGRAM, "pulse", str(CASES / case), "--json", "--set", f"pulse.cells={cells}"]
    for change in overrides:
        command += ["--set", change]
    return json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)


def main():
    with matplotlib.rc_context(fname=STYLE):
        figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 4.4))
        errors_by_cells(left)
        errors_by_cost(right)
        figure.savefig(pathlib.Path(__file__).with_name("convergence.png"))


def errors_by_cells(left):
    """The error of results of `slipfront pulse` against its cells."""
    for (label, case, overrides, key, exact), marker in zip(CURVES, "osD^vP"):
        reference = exact if exact is not None else pulse(case, overrides, 3200)[key]
        errors = [abs(pulse(case, overrides, n)[key] / reference - 1) for n in CELLS]
        left.loglog(CELLS, errors, marker=marker, label=label)
        print(f"{label:<34}" + "".join(f"{e:10.1e}" for e in errors))
    left.loglog(CELLS, [0.5 * (25 / n) for n in CELLS], color="0.4", linestyle=":", linewidth=1, label="1 / cells")
    left.loglog(CELLS, [0.05 * (25 / n) ** 4 for n in CELLS], color="0.4", linestyle="--", linewidth=1, label="1 / cells$^4$")
    left.set_xticks(CELLS, [str(cells) for cells in CELLS], minor=False)
    left.set_xticks([], minor=True)
    left.set(xlabel="cells", ylabel="relative error", title="slipfront pulse: error against cells")
    left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2))


def errors_by_cost(right):
    """The schemes that we compared, by error against time."""
    text = subprocess.run([SCHEMES, "--csv"], capture_output=True, check=True, text=True).stdout
    rows = list(csv.DictReader(io.StringIO(text)))
    for name, marker in zip(dict.fromkeys(r["scheme"] for r in rows), "osD^"):
        mine = [r for r in rows if r["scheme"] == name]
        right.loglog([float(r["ms"]) for r in mine], [float(r["error"]) for r in mine], marker=marker, label=name)
    right.set(xlabel="time of one run, ms (one core)", ylabel="relative error of the slip at x = 0", title="Schemes compared: step, C = 0.5")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2))


if __name__ == "__main__":
    main()
