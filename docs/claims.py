"""Writes docs/claims.md and docs/claims.png: the paper's statements, one by one, against runs of `slipfront`.

Usage: claims.py PROGRAM   (build/release/bin/slipfront).   Needs python3-matplotlib and python3-xarray; takes about a minute.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import xarray  # noqa: E402

PROGRAM = sys.argv[1]
HERE = pathlib.Path(__file__).parent
STYLE = HERE.parent / "python" / "slipfront" / "slipfront.mplstyle"
STEP = str(HERE.parent / "cases" / "step.toml")  # a step of stress into an empty interface, to t = 2 pi
COEFFICIENTS = (0, 0.1, 0.5, 2)
SCALES = (100, 300, 1000, 4000)
FINEST = f"chain-{SCALES[-1]}"
SWEEP = 1000  # scale of the chains in sweeps over stress
NUMERICS = 4  # exit code of a run whose equations have no solution
lines = []


def say(text=""):
    """Adds a paragraph, heading or row of a table to the page."""
    wrapped = text if text.startswith("|") else "\n".join(textwrap.wrap(text, 100, break_long_words=False, break_on_hyphens=False))
    lines.append(wrapped)
    print(wrapped)


def table(heading, rows):
    say("| " + " | ".join(heading) + " |")
    say("|" + "---|" * len(heading))
    for row in rows:
        say("| " + " | ".join(row) + " |")
    say()


def run(command, changes, *arguments):
    sets = [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run([PROGRAM, command, STEP, "--json", *sets, *arguments], capture_output=True, check=True, text=True)
    return json.loads(done.stdout)


def slip_or_none(changes):
    """Slip at x = 0 of a pulse; none where its time steps fail."""
    try:
        return run("pulse", changes)["slip_at_origin"]
    except subprocess.CalledProcessError as failure:
        if failure.returncode != NUMERICS:
            raise
        return None


def friction(coefficient, **changes):
    return {"friction.law": "viscous", "friction.coefficient": coefficient} | {k.replace("__", "."): v for k, v in changes.items()}


def compare(changes, scales=(SCALES[-1],), *arguments):
    out = run("compare", changes, *(w for s in scales for w in ("--scale", str(s))), "--threads", "1", *arguments)
    return {level["level"]: level for level in out["levels"]} | {"trend": out["trend"], "time": out["time"]}


def stressed(right, scale):
    """A stressed right side that ends whole spacings from x = 0: the initial train, counted from its right end, then has no dislocation cut in two
    where the stress jumps."""
    spacings = math.ceil(2.5 * right * scale / (2 * math.pi))
    return {"initial.stress_right": right, "domain.right": 2 * math.pi * spacings / (right * scale)}


def relations(*arguments):
    return json.loads(subprocess.run([PROGRAM, "relations", "--json", *arguments], capture_output=True, check=True, text=True).stdout)["relations"]


def percent(value, reference):
    return f"{100 * (value / reference - 1):+.2f} %"


def verdict(statement, holds, range_):
    say(f"**{'Confirmed' if holds else 'Refuted'}**: {statement}. Range: {range_}.")
    say()


def closure(axes_slip, axes_trend):
    runs = {c: compare(friction(c), SCALES) for c in COEFFICIENTS}
    say("## The consistent closure, not the paper's, is what the dislocations do")
    say()
    say(f"The table gives the slip at x = 0 by t = 2 pi, in b / (2 pi), for a step of stress 0.855 into an empty interface. The chain follows every dislocation and "
        f"needs no closure. In brackets: the difference from the chain at scale {SCALES[-1]}.")
    say()
    rows, worst, paper_off = [], 0, {}
    for c, r in runs.items():
        chain, right, paper = (r[k]["slip_at_origin"] for k in (FINEST, "pulse-consistent", "pulse-paper"))
        worst = max(worst, abs(right / chain - 1))
        paper_off[c] = paper / chain - 1
        rows.append([f"{c:g}"] + [f"{r[f'chain-{s}']['slip_at_origin']:.5f}" for s in SCALES] +
                    [f"{right:.5f} ({percent(right, chain)})", f"{paper:.5f} ({percent(paper, chain)})"])
    table(["C"] + [f"chain, scale {s}" for s in SCALES] + ["consistent", "paper"], rows)
    verdict(f"The pulse with the consistent closure is within {100 * worst:.2f} % of the chain in every row. The pulse with the paper's closure is up to "
            f"{100 * max(paper_off.values()):.0f} % above the chain", worst < 0.01, f"C = {COEFFICIENTS[0]:g} to {COEFFICIENTS[-1]:g} (Gamma = C t to "
            f"{COEFFICIENTS[-1] * runs[0]['time']:.1f}), scale {SCALES[-1]}")
    say("The chain's difference from the consistent closure falls with scale. We fit the exponent p of scale^-p to all four scales, and extrapolate the difference to "
        "infinite scale from the two largest (Richardson):")
    say()
    table(["C", "p of the slip", "difference at infinite scale", "p of the leading front", "difference, in b / A"],
          [[f"{c:g}", f"{r['trend']['slip_at_origin']['exponent']:.2f}",
            percent(r["trend"]["slip_at_origin"]["extrapolated"], r["pulse-consistent"]["slip_at_origin"]),
            f"{r['trend']['leading_front']['exponent']:.2f}", f"{r['trend']['leading_front']['difference']:+.5f}"] for c, r in runs.items()])
    say("The difference of the front, a single dislocation, falls steadily. The slip is a mean over one spacing of the initial train. The last dislocation that passed "
        "adds up to half a dislocation to this mean, of either sign, depending on its position in the spacing. That is as much as the difference itself.")
    say()
    many = [0.02 * i * i for i in range(11)]
    for name, style in (("consistent", "-"), ("paper", "--")):
        slips = {c: slip_or_none(friction(c, friction__closure=name)) for c in many}
        axes_slip.plot(*zip(*((c, slip) for c, slip in slips.items() if slip is not None)), color="black", linestyle=style, label=f"pulse, {name}")
        failed = [f"{c:g}" for c, slip in slips.items() if slip is None]
        if failed:
            say(f"The figure lacks C = {', '.join(failed)} with closure {name}, because the `pulse` run ended with an error.")
            say()
    axes_slip.plot(COEFFICIENTS, [runs[c][FINEST]["slip_at_origin"] for c in COEFFICIENTS], "o", color="C1", label=f"chain, scale {SCALES[-1]}")
    axes_slip.set(xlabel="friction coefficient C", ylabel="slip u at x = 0, b/(2π)", title="Slip by t = 2π", ylim=(0, None))
    for i, (c, r) in enumerate(runs.items()):
        axes_trend.loglog(SCALES, [abs(r[f"chain-{s}"]["difference"]["leading_front"]) for s in SCALES], marker="osD^"[i], color=f"C{i}", linestyle="-",
                          label=f"C = {c:g}")
        if c:
            axes_trend.axhline(r["pulse-paper"]["difference"]["leading_front"], color=f"C{i}", linestyle="--", linewidth=1)
    axes_trend.loglog(SCALES, [3 / s for s in SCALES], color="black", linestyle=":", linewidth=1, label="1 / scale")
    axes_trend.set(xlabel="scale of the chain", ylabel="|V+ edge − that of the pulse|, b/A",
                   title="Leading edge: chain to consistent pulse\n(dashed: the paper's closure to it)")
    return runs


def rupture_velocity(runs, axes):
    say("## Rupture velocity is independent of friction")
    say()
    exact = relations("--stress", "0.855")[0]
    time = runs[0]["time"]
    say("The table gives mean velocities over t = 2 pi, in c, for a step of 0.855 into an empty interface. *Trailing* is the fast front, measured as the foot of the slip "
        "velocity. It starts on a characteristic that runs into a state at rest, where friction has nothing to act on. Observers see the outermost x at which the slip "
        "velocity is above 2 % or 20 % of its peak.")
    say()
    observed = {share: {c: compare(friction(c, pulse__threshold=share)) for c in COEFFICIENTS} for share in (0.02, 0.2)}
    rows = []
    for c, r in runs.items():
        row = [f"{c:g}", f"{-r['pulse-consistent']['trailing_front'] / time:.4f}"]
        for share in observed:
            row += [f"{-observed[share][c][k]['trailing_front_observed'] / time:.4f}" for k in ("pulse-consistent", FINEST)]
        rows.append(row + [f"{r[k]['leading_front'] / time:.4f}" for k in ("pulse-consistent", FINEST, "pulse-paper")])
    table(["C", "trailing, foot", "observed at 2 %: pulse", "chain", "at 20 %: pulse", "chain", "leading: consistent", "chain", "paper"], rows)
    spread = max(abs(-r["pulse-consistent"]["trailing_front"] / time / exact["rupture_velocity"] - 1) for r in runs.values())
    seen = [-observed[0.2][c][FINEST]["trailing_front_observed"] for c in (COEFFICIENTS[0], COEFFICIENTS[-1])]
    lead = [runs[c][FINEST]["leading_front"] for c in (COEFFICIENTS[0], COEFFICIENTS[-1])]
    range_ = f"C = 0 to {COEFFICIENTS[-1]:g}"
    verdict(f"Trailing edge, foot of the slip velocity: |V-| = {exact['rupture_velocity']:.4f} for every C, to {100 * spread:.1f} %", spread < 0.02, range_)
    verdict(f"Trailing edge, as an observer at 20 % of the peak sees it: {100 * (1 - seen[1] / seen[0]):.0f} % slower on the chain", seen[1] > 0.99 * seen[0], range_)
    verdict(f"Leading edge: {100 * (1 - lead[1] / lead[0]):.0f} % slower on the chain", lead[1] > 0.99 * lead[0], range_)
    say("With the paper's closure the leading edge is hardly slowed in the limit of many cells (docs/pulse.md): its number depends on the resolution.")
    say()
    many = [0.02 * i * i for i in range(11)]
    sweep = [run("pulse", friction(c, pulse__threshold=0.2)) for c in many]
    axes.plot(many, [-p["trailing_front"] / time for p in sweep], color="black", linestyle="-", label="trailing, foot")
    axes.plot(many, [-p["trailing_front_observed"] / time for p in sweep], color="C0", linestyle="--", label="trailing, observed at 20 %")
    axes.plot(many, [p["leading_front"] / time for p in sweep], color="C1", linestyle="-.", label="leading")
    axes.plot(COEFFICIENTS, [-observed[0.2][c][FINEST]["trailing_front_observed"] / time for c in COEFFICIENTS], "s", color="C0", label="chain, trailing, observed")
    axes.plot(COEFFICIENTS, [runs[c][FINEST]["leading_front"] / time for c in COEFFICIENTS], "o", color="C1", label="chain, leading")
    axes.set(xlabel="friction coefficient C", ylabel="mean velocity of a front, c", title="Fronts, mean over t = 0 to 2π", ylim=(0, 0.65))


def slip_velocity(runs, axes):
    say("## Slip velocity depends on friction")
    say()
    say("The table gives W at x = 0 and t = 2 pi, in c A / pi, for the same step. In brackets: its ratio to W without friction.")
    say()
    names = {"pulse-consistent": "consistent", FINEST: f"chain, scale {SCALES[-1]}", "pulse-paper": "paper"}
    share = {(c, k): runs[c][k]["slip_velocity_at_origin"] / runs[0][k]["slip_velocity_at_origin"] for c in COEFFICIENTS for k in names}
    table(["C"] + list(names.values()),
          [[f"{c:g}"] + [f"{runs[c][k]['slip_velocity_at_origin']:.6f} ({share[c, k]:.3f})" for k in names] for c in COEFFICIENTS])
    last = share[COEFFICIENTS[-1], FINEST]
    verdict(f"Friction lowers the slip velocity at x = 0, on the chain {1 / last:.1f} times at C = {COEFFICIENTS[-1]:g}", last < 0.9, "C = 0 to 2, t = 2 pi")
    with tempfile.TemporaryDirectory() as folder:
        path = str(pathlib.Path(folder) / "c.nc")
        compare(friction(0.5), (SCALES[-1],), "-o", path)
        with xarray.open_dataset(path) as data:
            for i, (name, style) in enumerate((("pulse, consistent", "-"), ("pulse, paper", "--"), (f"chain, scale {SCALES[-1]}", "-"))):
                axes.plot(data.x, data.W.values[i, -1], linestyle=style, color="C1" if i == 2 else "black", label=name, linewidth=4 if i == 2 else 1.2,
                          alpha=0.5 if i == 2 else 1)
    axes.set(xlabel="position x, b/A", ylabel="slip velocity W, cA/π", title="C = 0.5, t = 2π", ylim=(None, 0.034))


def stress_left(axes):
    say("## Weak dependence on Sigma-")
    say()
    say("We read this statement as follows: the factor by which friction lowers the slip velocity hardly depends on the initial stress. The factor is W(0) at t = 2 pi "
        f"with C = 0.5, divided by W(0) without friction, into an empty interface. The chain has scale {SWEEP}. With less stress a chain needs a larger scale, so that "
        "enough dislocations move for an average.")
    say()
    stresses = (0.6, 0.7, 0.855, 1.03, 1.3, 1.6)
    factors, rows = {}, []
    for stress in stresses:
        free = relations("--stress", str(stress))[0]
        out = compare(friction(0.5, initial__stress_left=stress), (SWEEP,))
        factors[stress] = [out[k]["slip_velocity_at_origin"] / free["slip_velocity"] for k in ("pulse-consistent", f"chain-{SWEEP}", "pulse-paper")]
        rows.append([f"{stress:g}", f"{free['rupture_velocity']:.4f}", f"{free['slip_velocity']:.6f}"] + [f"{f:.4f}" for f in factors[stress]])
    table(["Sigma-", "rupture velocity, c", "W(0) without friction", "factor: consistent", "chain", "paper"], rows)

    def span(i, low=0.0):
        return max(f[i] for s, f in factors.items() if s >= low) / min(f[i] for s, f in factors.items() if s >= low)

    free = relations("--stress", str(stresses[0]), "--stress", str(stresses[-1]))
    velocity = free[1]["slip_velocity"] / free[0]["slip_velocity"]
    verdict(f"The factor changes {span(1):.2f} times on the chain ({span(0):.2f} consistent, {span(2):.2f} paper), while W(0) changes {velocity:.0f} times",
            span(1) < 1.25, f"Sigma- = {stresses[0]:g} to {stresses[-1]:g}, C = 0.5. We call a change of less than a quarter weak")
    near = [factors[s] for s in (0.855, 1.03)]
    say(f"Between the paper's two states, Sigma- = 0.855 and 1.03, the factor changes by {100 * abs(near[1][1] / near[0][1] - 1):.0f} % on the chain and by "
        f"{100 * abs(near[1][2] / near[0][2] - 1):.0f} % with the paper's closure.")
    say()
    looks = (("pulse, consistent", {"color": "black", "linestyle": "-"}), (f"chain, scale {SWEEP}", {"color": "C1", "marker": "o", "linestyle": "none"}),
             ("pulse, paper", {"color": "black", "linestyle": "--"}))
    for i, (name, look) in enumerate(looks):
        axes.plot(stresses, [f[i] for f in factors.values()], label=name, **look)
    axes.set(xlabel="initial stress Σ−, μA/π", ylabel="W(0) at C = 0.5 over that at C = 0", title="What friction leaves, against Σ−", ylim=(0, 0.8))


def stress_right(axes):
    say("## No dependence on Sigma+ for stress drops of 35 to 100 %")
    say()
    say("The table gives W(0) at t = 2 pi in c A / pi, and the slip by then in b / (2 pi), for Sigma- = 0.855. The stress drop is (Sigma- - Sigma+) / Sigma-. In brackets: "
        "the ratio to the value at a drop of 100 %. Values without friction come from the closed form (exact Riemann problem), and those with C = 0.5 from pulse "
        "(consistent closure) and chain.")
    say()
    drops = (100, 90, 79, 60, 50, 42, 35)
    values, rows = {}, []
    for drop in drops:
        right = 0.855 * (1 - drop / 100)
        exact = compare(stressed(right, SCALES[0]) if drop < 100 else {}, (SCALES[0],))["closed-form"]
        damped = compare(friction(0.5) | (stressed(right, SWEEP) if drop < 100 else {}), (SWEEP,))
        values[drop] = [exact["slip_velocity_at_origin"]] + [damped[k]["slip_velocity_at_origin"] for k in ("pulse-consistent", f"chain-{SWEEP}")]
        values[drop] += [damped[k]["slip_at_origin"] for k in ("pulse-consistent", f"chain-{SWEEP}")]
        rows.append([f"{drop} %", f"{right:.3f}"] + [f"{v:.5f} ({v / values[100][i]:.3f})" for i, v in enumerate(values[drop])])
    table(["drop", "Sigma+", "closed form, C = 0", "consistent, C = 0.5", f"chain, scale {SWEEP}", "slip(0): consistent", "chain"], rows)
    say("Friction with C = 0.5 has not yet damped the phonons behind the shock. They change W(0) of the chain, a value at one time. They change its slip less, because "
        "that is an integral.")
    say()
    share = [[values[d][i] / values[100][i] for d in drops] for i in range(5)]
    verdict(f"Without friction, W(0) at a drop of 35 % is {share[0][-1]:.2f} of that at 100 %. With C = 0.5, the slip on the chain is {share[4][-1]:.2f} of that at 100 %. "
            f"Without friction, W(0) is {100 * (1 - share[0][drops.index(42)]):.0f} % lower at a drop of 42 % than at 100 %", min(share[0]) > 0.95, "drops of 35 to 100 %, Sigma- = 0.855")
    looks = (("W(0), closed form, C = 0", {"color": "black", "linestyle": "-"}), ("slip(0), pulse, C = 0.5", {"color": "black", "linestyle": "--"}),
             (f"slip(0), chain at {SWEEP}, C = 0.5", {"color": "C1", "marker": "o", "linestyle": "none"}))
    for i, (label, look) in enumerate(looks):
        axes.plot(drops, share[(0, 3, 4)[i]], label=label, **look)
    axes.set(xlabel="stress drop, % of Σ−", ylabel="share of that at 100 %", title="Slip and slip velocity, against Σ+", ylim=(0, 1.05))


def stressed_side():
    say("## A stressed right side: shocks and phonons")
    say()
    gains = {}
    for c in (0, 0.5):
        with tempfile.TemporaryDirectory() as folder:
            path = str(pathlib.Path(folder) / "c.nc")
            compare(friction(c, output__times=f"[{math.pi / 2}]") | stressed(0.179, 1000), (1000, 4000), "-o", path)
            with xarray.open_dataset(path) as data:
                names = list(data.name.values)
                slip = data.slip_at_origin.values
                gains[c] = {name: (slip[i, 2] - slip[i, 1], data.slip_velocity_at_origin.values[i, 2]) for i, name in enumerate(names)}
    say("The table gives the slip at x = 0 between t = pi / 2 and 2 pi, in b / (2 pi), for Sigma- = 0.855 and Sigma+ = 0.179.")
    say()
    names = list(gains[0])
    table(["C"] + names, [[f"{c:g}"] + [f"{gains[c][n][0]:.4f}" if n in gains[c] else "-" for n in names] for c in gains])
    damped, free = gains[0.5], gains[0]
    off = damped["pulse-consistent"][0] / damped[FINEST][0] - 1
    verdict(f"With C = 0.5 the pair (k, P) of the consistent closure is within {100 * abs(off):.2f} % of the chain, and the paper's closure is "
            f"{100 * (damped['pulse-paper'][0] / damped[FINEST][0] - 1):.0f} % above it", abs(off) < 0.01, f"scale {SCALES[-1]}")
    mean = free[FINEST][0] / (1.5 * math.pi)
    say(f"Without friction, dislocations overtake each other, and one train with a shock lacks the energy of the second train. The closed form has two trains there. The mean "
        f"slip velocity is {mean:.4f} on the chain and {free['closed-form'][1]:.4f} in the closed form ({percent(mean, free['closed-form'][1])} at scale {SCALES[-1]}, "
        f"{percent(free['chain-1000'][0] / (1.5 * math.pi), free['closed-form'][1])} at 1000); with one train it is {free['pulse-consistent'][1]:.4f}.")
    say()


def main():
    with matplotlib.rc_context(fname=STYLE):
        figure, axes = plt.subplots(3, 2, figsize=(7.6, 9.2))
        page(axes)
        for one in axes.flat:
            one.legend()
        figure.savefig(HERE / "claims.png")
    (HERE / "claims.md").write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


def page(axes):
    """Writes the page's lines and draws its six panels."""
    say("# The paper's statements, tested")
    say()
    say("This page tests the paper's statements one by one and gives a verdict on each. `docs/claims.py` writes it: every number comes from a run of `slipfront "
        "compare`, `pulse` or `relations`. All quantities are dimensionless (docs/NOTATION.md). \"Chain\" means that every dislocation is computed directly. A chain of "
        "scale S has S times as many dislocations. docs/theory/3_modulation.md 3.3 defines the closures.")
    say()
    say("![Slip, convergence of the leading edge, fronts, profile, and slip velocity against stress](claims.png)")
    say()
    runs = closure(axes[0, 0], axes[0, 1])
    rupture_velocity(runs, axes[1, 0])
    slip_velocity(runs, axes[1, 1])
    stress_left(axes[2, 0])
    stress_right(axes[2, 1])
    stressed_side()


if __name__ == "__main__":
    main()
