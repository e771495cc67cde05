#!/usr/bin/python3
"""Makes docs/worked_examples.md: the paper's two worked examples, as printed and as computed with either closure.

Usage: worked_examples.py SLIPFRONT > docs/worked_examples.md     (in the repository's root)
"""

import json
import math
import subprocess
import sys
import tempfile

# Section 4 of the paper: C, W in c A / pi, A, stress in MPa.
PRINTED = [(0, 0.1, 0.0029, 29), (0.1, 0.083, 0.0035, 34), (0.5, 0.05, 0.0058, 58), (2, 0.02, 0.0145, 145)]
SIGMA, MU, SLIP_VELOCITY = 1.03, 30e9, 0.5


def run(*arguments):
    return json.loads(subprocess.run([sys.argv[1], *arguments, "--json"], capture_output=True, check=True, text=True).stdout)


def event(text, closure):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(text)
        file.flush()
        return run("event", file.name, "--closure", closure)["events"][0]


def pulse(C, closure, *sets):
    arguments = ["pulse", "cases/parkfield-2004.toml", "--set", f"friction.coefficient={C}", "--set", f"friction.closure={closure}"]
    for s in sets:
        arguments += ["--set", s]
    return run(*arguments)["slip_velocity_at_origin"]


def state(W, c):
    A = math.pi * SLIP_VELOCITY / (c * W)
    return A, MU * A * SIGMA / math.pi / 1e6


def percent(ours, printed):
    return f"{100 * (ours / printed - 1):+.0f} %"


def parkfield():
    c = run("event", "cases/parkfield-2004.toml")["events"][0]["c_m_s"]
    step = run("relations", "--stress", str(SIGMA))["relations"][0]["slip_velocity"]
    show = lambda W: "{:.4f}, {:.4f}, {:.0f}".format(W, *state(W, c))
    yield "| C | Gamma | paper: W, A, MPa | closure paper, ratio times 0.1 | differences | closure paper, run | closure consistent, run |"
    yield "|---|---|---|---|---|---|---|"
    frictionless = pulse(0, "paper")
    for C, *printed in PRINTED:
        W = pulse(C, "paper")
        ours = step * W / frictionless
        differences = ", ".join(percent(a, b) for a, b in zip((ours, *state(ours, c)), printed))
        yield (f"| {C} | {2 * math.pi * C:.2f} | {', '.join(map(str, printed))} | {show(ours)} | {differences} "
               f"| {show(W)} | {show(pulse(C, 'consistent'))} |")


def trade_off():
    yield "| Gamma | A, MPa, closure paper | A, MPa, closure consistent |"
    yield "|---|---|---|"
    by = {}
    for closure in ("paper", "consistent"):
        by[closure] = run("event", "cases/parkfield-2004.toml", "--samples", "1000", "--closure", closure)["events"][0]["posterior"]["trade_off"]
    for p, q in zip(by["paper"], by["consistent"]):
        yield (f"| {p['damping_number']:g} | {p['contact_ratio']:.4g}, {p['stress_pa'] / 1e6:.4g} "
               f"| {q['contact_ratio']:.4g}, {q['stress_pa'] / 1e6:.4g} |")


def ets():
    text = open("cases/ets.toml").read().split("[initial]")[0].rsplit("#", 1)[0]
    yield "| slip velocity is | closure paper: Gamma, C at T = 2 pi | closure consistent: Gamma, C at T = 2 pi |"
    yield "|---|---|---|"
    for measure in ("time-mean", "origin", "mean", "peak"):
        cells = []
        for closure in ("paper", "consistent"):
            found = event(text.replace("[medium]", f'slip_velocity_is = "{measure}"\n[medium]'), closure)
            if found["error"] or found["damping_number"] is None:
                cells.append("none")
                continue
            gamma = found["damping_number"]
            cells.append(f"{gamma:.3g}, {gamma / (2 * math.pi):.2g}")
        yield f"| {measure} | {cells[0]} | {cells[1]} |"
    found = event(text, "consistent")
    yield ""
    yield (f"For any friction, V- / c = {found['rupture_velocity']:.4g} and Sigma- = {found['stress']:.4f}. The slip velocity over the\n"
           f"frictionless one is {found['slip_velocity_ratio']:.3f}, and the stress is {found['stress_pa'] / 1e3:.0f} kPa.")


PAGE = """# Check the paper's worked examples

This page recomputes the two worked examples of the paper, an earthquake and a slow slip event. At
its end you will know which of the paper's results hold, and which do not. "The paper" is
Gershenzon, Bambakidis & Skinner (2015).

To make this page again, run this command in the root of the repository:

<!-- not run: it takes a minute, and the test docs_numbers repeats its numbers -->
```sh
python3 docs/worked_examples.py build/release/bin/slipfront > docs/worked_examples.md
```

The script computes the tables. The text around them was written for the numbers shown.

[NOTATION.md](NOTATION.md) has the symbols. The closures "paper" and "consistent" are two averages
of friction ([page 3](theory/3_modulation.md), 3.3), of which "paper" understates it.

## The verdict

- **Parkfield's stress holds.** Without friction it is 29 MPa, and it rises with C. With the paper's
  closure our stresses agree with the paper's to 2 %, except for 7 % at C = 0.5.
- **The closure matters.** With the consistent closure, C = 0.1, 0.5 and 2 mean 40, 87 and 193 MPa.
  The paper has 34, 58 and 145 MPa.
- **The slip velocity of Parkfield does not determine C.** Velocities fix only a curve of contact
  ratio and damping number. It starts at 28 MPa without friction and has no upper end. One more
  measurement would determine C: a contact ratio, a stress drop, or C with spacing and duration.
- **The stress of the slow slip event holds.** It is 81 kPa, and follows from A and V only.
- **"C is about 2" for that event does not hold.** Its slip velocity is a fifth of the frictionless
  one. With the paper's own closure, at the stress of that event, this means Gamma = 137 (C = 22 at
  t = 2 pi). With the consistent closure it means Gamma = 21 (C = 3.4).

## Parkfield 2004

The rupture velocity is 3.0 km/s, and the slip velocity 0.5 m/s. The paper takes Sigma- = 1.03,
Sigma+ = 0.179 and t = 2 pi, and reads W(0) from its Fig. 10. We run the pulse solver on
`cases/parkfield-2004.toml`. Its profile is a tanh of width 0.1, in b / A; the paper does not state
the width.

Each cell has W, A and the stress in MPa. "Ratio times 0.1" is explained below the table, and
"differences" compares that column with the paper.

{parkfield}

- **Why a ratio times 0.1?** The paper multiplies two numbers. One is W(0) = 0.1 of the true step
  into the empty side. The other is the share of it that friction leaves in Fig. 10. Our first
  column is the same product: at C = 0.1 our ratio is 0.833, and 0.083 is printed.
- **Why does the run have less?** At C = 0.1 the run has 0.0805. It starts 3 % lower, because it has
  a width and Sigma+ = 0.179. W falls with the width of the initial profile.
- **Why are there differences?** The paper reads Fig. 10 to one or two digits. At C = 0.5 its 0.05
  is 9 % above 0.0460, and at C = 2 its 0.02 is 3 % above 0.0195. It rounds c to 5.4 km/s and A to
  two digits, which is 1 %.
- **What does the closure change?** With the consistent closure friction reduces W more. The same
  slip velocity then needs a contact ratio and a stress that are larger by up to 35 %.

If friction is unknown, the two velocities leave the following curve. It is for the true step into
the empty side, with V / c = 0.5534 and Sigma- = 1.040.

{trade_off}

## Episodic tremor and slip

The front moves at 10 km/day, and the slip is 4 mm in two weeks. The paper takes A = 4e-5. It
concludes "C is about 2" at t = 2 pi, which is Gamma of about 12.6.

The result depends on what the observed slip velocity is. The keys in the first column are values of
`slip_velocity_is` ([events.md](events.md)).

{ets}

Slip over duration is a mean over the duration, so the row `time-mean` applies. If it were the slip
velocity at the end (`origin`), Gamma would be 36 (paper) or 5.7 (consistent). The paper reads the 2
from Fig. 10, but that figure is for stresses four to five times as high.

## Limits, and where to read on

Both examples have viscous friction only. [friction_ratio.md](friction_ratio.md) gives the share of
the slip velocity that friction leaves at other stresses. [events.md](events.md) shows how to
analyse your own event, with errors.
"""

if __name__ == "__main__":
    print(PAGE.format(parkfield="\n".join(parkfield()), trade_off="\n".join(trade_off()), ets="\n".join(ets())), end="")
