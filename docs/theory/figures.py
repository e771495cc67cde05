"""Draws the pictures of docs/theory: train.png, fan.png, fold.png, friction.png and births.png.

Usage: PYTHONPATH=build/release/python figures.py [FOLDER]. Needs python3-matplotlib; takes half a minute.
"""

import io
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

import slipfront  # noqa: E402

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "reference"))
import births as rule  # noqa: E402

STYLE = HERE.parents[1] / "python" / "slipfront" / "slipfront.mplstyle"
STRESS = 0.855  # before the rupture, as in the paper's figures


def train():
    """Slip, stress and slip velocity of a dilute and of a dense train that move at the same velocity."""
    velocity = 0.5
    phi = np.arctanh(velocity)
    figure, panels = plt.subplots(3, 2, figsize=(8, 5.2), sharex=True, layout="constrained")
    for column, stress in zip(panels.T, (0.5, 2)):
        at_rest = stress / np.cosh(phi)  # motion contracts the train
        psi = float(slipfront.train.psi_at_rest(at_rest))
        spacing = float(slipfront.train.spacing(phi, psi))
        xi = np.linspace(-16, 16, 1601)
        fields = slipfront.train.fields(phi, psi, xi)
        turns = fields["u"].values / (2 * np.pi)
        column[0].plot(xi, turns)
        column[0].plot(xi, 0.5 - xi / spacing, "--", color="0.5")
        column[1].plot(xi, fields["sigma"])
        column[1].axhline(stress, linestyle="--", color="0.5")
        column[2].plot(xi, fields["w"])
        column[2].axhline(velocity * stress, linestyle="--", color="0.5")
        column[0].set(title=f"k = {stress}", xlim=(-16, 16))
        column[2].set(xlabel="x − U t, b / A")
    for row, label in zip(panels[:, 0], ("slip u, turns", "stress $\\sigma$, $\\mu A/\\pi$", "slip velocity w, $cA/\\pi$")):
        row.set(ylabel=label)
    for row, top in ((panels[1], 3), (panels[2], 1.5)):
        for panel in row:
            panel.set_ylim(0, top)
    return figure


def fan():
    """The closed form of a step of stress over x / t, and its characteristics in x and t."""
    pulse = slipfront.relations(stress=STRESS)
    back, front = -float(pulse["rupture_velocity"]), float(pulse["leading_velocity"])
    x_over_t = np.linspace(-0.6, 0.25, 1701)
    profile = slipfront.train.profile(STRESS, x_over_t)
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.6), layout="constrained")
    left.plot(x_over_t, profile["Sigma"], label="stress $\\Sigma$")
    left.plot(x_over_t, 10 * profile["W"], label="slip velocity W, times 10")
    left.plot(x_over_t, profile["U"].where(x_over_t < front), label="velocity U of dislocations")
    for edge, name in ((back, "$V_-$"), (front, "$V_+$")):
        left.axvline(edge, linestyle=":", color="0.4")
        left.annotate(name, (edge, 0.97), ha="right" if edge < 0 else "left", color="0.3", xytext=(-4 if edge < 0 else 4, 0), textcoords="offset points")
    left.set(xlabel="x / t, c", xlim=(-0.6, 0.25), ylim=(0, 1.35), title="The fan")
    left.legend(loc="upper left", fontsize="small")
    time = np.array([0, 1])
    for speed in np.linspace(back, front, 11):
        right.plot(speed * time, time, color="C0", linestyle="-", linewidth=0.9)
    for start in np.arange(-0.55, 0, 0.05):  # the characteristic of the train at rest, until it would leave the picture
        right.plot(start + back * time, time, color="0.75", linestyle="-", linewidth=0.9)
    for start in (-0.25, -0.1, -0.02):
        path_x, path_t = [start], [start / back]  # a dislocation rests until the trailing edge reaches it, and then moves at U
        while path_t[-1] < 1:
            step = 0.002
            velocity = float(np.interp(path_x[-1] / path_t[-1], x_over_t, profile["U"]))
            path_x.append(path_x[-1] + velocity * step)
            path_t.append(path_t[-1] + step)
        right.plot([start, *path_x], [0, *path_t], color="C1", linestyle="-", linewidth=2, label="dislocations" if start == -0.25 else None)
    right.set(xlabel="x, b / A", ylabel="t, b / (c A)", xlim=(-0.6, 0.25), ylim=(0, 1), title="Characteristics")
    right.text(-0.58, 0.06, "train at rest", color="0.4", ha="left", backgroundcolor="white", fontsize="small")
    right.text(0.235, 0.3, "empty", color="0.4", ha="right", fontsize="small")
    right.legend(loc="upper right", fontsize="small", frameon=True, edgecolor="white", framealpha=1)
    return figure


def fold():
    """The filled region of a step into a stressed side over x / t, and its slip velocity."""
    right_stress = 0.6
    below, above = slipfront.train.psi_at_rest([right_stress, STRESS])
    share = np.linspace(0, 1, 200)
    lower, upper = -above + (above - below) * share, below + (above - below) * share
    lower_at = [slipfront.train.edge_speeds([r, above])[0] for r in lower]
    upper_at = [slipfront.train.edge_speeds([-below, below, r, above])[2] for r in upper]
    left_end, right_end = -0.6, 0.3
    figure, (plane, profile) = plt.subplots(1, 2, figsize=(8.6, 3.4), layout="constrained")
    x = [left_end, *lower_at, right_end, right_end, *upper_at, left_end]
    r = [-above, *lower, -below, below, *upper, above]
    plane.fill(x, r, color="C0", alpha=0.2, linewidth=0)
    plane.plot(x, r, color="C0", linestyle="-")
    plane.text(-0.5, 0, "one train", fontsize="small")
    plane.text(0.1, 0.04, "fold", fontsize="small", color="C1")
    plane.set(xlabel="x / t, c", ylabel="rapidity r", xlim=(left_end, right_end), title="The filled region")
    x_over_t = np.linspace(left_end, right_end, 901)
    profile.plot(x_over_t, slipfront.riemann(STRESS, right_stress, x_over_t).W, label="two trains, exact")
    profile.plot(x_over_t, slipfront.riemann(STRESS, right_stress, x_over_t, solution="shocks").W, "--", color="0.5", label="one train, shock")
    profile.set(xlabel="x / t, c", ylabel="slip velocity W, $cA/\\pi$", xlim=(left_end, right_end), ylim=(0, 0.04), title="Slip velocity")
    profile.legend(loc="upper left", fontsize="small")
    return figure


def mean(strength, psi, weight):
    """Mean of a law over slip (weight 1) or over length (weight 1 / sigma) in a train with sinh(phi) = 1.
    Equal steps in s, with u = 4 arctan(e^s), resolve the slow part of the train near u = 0."""
    s = np.linspace(-40, 40, 8001)
    half = 1 / np.cosh(s)  # sin(u / 2), and du = 2 half ds
    sigma_over_cosh = 2 * np.sqrt(np.sinh(psi)[:, None] ** 2 + half**2)
    weights = half / (sigma_over_cosh if weight == "length" else np.ones_like(sigma_over_cosh))
    return (strength(sigma_over_cosh) * weights).sum(axis=1) / weights.sum(axis=1)


def friction():
    """Slip velocity within a train over its slip, and by how much the two averages of friction differ."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4), layout="constrained")
    u = np.linspace(0, 2 * np.pi, 801)
    for stress in (0.3, 0.855, 2):
        psi = float(slipfront.train.psi_at_rest(stress))
        line, = left.plot(u / (2 * np.pi), 2 * np.sqrt(np.sinh(psi) ** 2 + np.sin(u / 2) ** 2), label=f"Σ = {stress}")
        left.axhline(np.exp(psi), linestyle="--", linewidth=0.9, color=line.get_color())
    left.set(xlabel="slip u, turns", ylabel="w / sinh φ", xlim=(0, 1), ylim=(0), title="Slip velocity within a train")
    left.legend(loc="lower center", fontsize="small")
    stress = np.geomspace(0.2, 3, 60)
    psi = slipfront.train.psi_at_rest(stress)
    laws = {"$w^2$": np.square, "w, viscous": lambda w: w, "$w^{1/2}$": np.sqrt, "constant": np.ones_like}
    for name, law in laws.items():
        right.plot(stress, mean(law, psi, "slip") / mean(law, psi, "length"), label=name)
    right.set(xlabel="stress Σ of a train at rest, $\\mu A/\\pi$", ylabel="consistent / paper", xlim=(0.2, 3), title="Friction by the two closures")
    right.set_xscale("log")
    right.set_xticks([0.2, 0.5, 1, 2, 3], ["0.2", "0.5", "1", "2", "3"])
    right.minorticks_off()
    right.set_yscale("log")
    right.set_yticks([1, 2, 5, 10], ["1", "2", "5", "10"])
    right.legend(title="law f(w)", fontsize="small")
    return figure


def births():
    """Frequency of births into an empty interface, and births under viscous friction against time, on chain and in averages."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
    stresses = np.linspace(2, 6, 100)
    left.plot(stresses, rule.birth_frequency(stresses), label="(7.9)")
    measured = [2.02, 2.1, 2.3, 2.6, 3, 3.5, 4, 5, 6]
    left.plot(measured, [rule.state_at_end(s, np.zeros(3300))[0] for s in measured], "o", label="chain")
    left.set(xlabel="stress at the end (mu A / pi)", ylabel="frequency of births (c A / b)")
    left.legend()
    times = np.arange(0.25, 4.01, 0.25)
    for stress, colour in zip((2.1, 2.6, 4), ("C0", "C1", "C2")):
        def load(time, number, stress=stress):
            return stress
        chain = rule.births(load, lambda w: w, 200, 2.2, times)
        averages = rule.Gas(0.01).run(load, lambda momentum, dt: momentum * np.exp(-dt), times)
        right.plot(times, [row[1] for row in averages], colour, label=f"stress {stress:g}")
        right.plot(times, chain[:, 0], "o", color=colour, markersize=3)
    right.set(xlabel="C t", ylabel="C times number of births")
    right.legend()
    return figure


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else HERE)
    plt.style.use(STYLE)
    for draw in (train, fan, fold, friction, births):
        picture = io.BytesIO()
        draw().savefig(picture, dpi=110)
        Image.open(picture).convert("P", palette=Image.Palette.ADAPTIVE, colors=64).save(folder / f"{draw.__name__}.png", optimize=True)


if __name__ == "__main__":
    main()
