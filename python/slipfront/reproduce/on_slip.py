"""Tests the paper's statements on slip velocity and stress."""

import numpy

import slipfront

from .derived import relation
from .on_fronts import SHARES, STEP, STEP_CHAIN, step_runs
from .rows import EXACT, REFUTED, close, judged, row
from .runs import CLOSURES, at_origin

FIG_12 = "slipfront pulse cases/fig-12.toml --set initial.stress_right=0.556 --json"


def falls(runs) -> list:
    """Tests how the slip velocity depends on friction."""
    steps = step_runs(runs, SHARES[0])
    share = {name: at_origin(found[-1]) / at_origin(found[0]) for name, found in steps.items()}
    tops = {name: [float(run["peak_slip_velocity"][-1]) for run in found] for name, found in steps.items()}
    least = min(float(numpy.diff(values).max()) for values in tops.values())
    return [row("Slip velocity depends on friction", "abstract, 3.2", judged(max(share.values()) < 0.9), f"W(0) at C = 2 is {100 * share['chain']:.0f} % of that without friction on the chain, "
                f"{100 * share['consistent']:.0f} % with the consistent closure, {100 * share['paper']:.0f} % with the paper's.", "Σ− = 0.855, Σ+ = 0, C = 0 to 2, t = 2π", STEP_CHAIN + " --json"),
            row("The amplitude of the slip velocity falls as C grows", "3.2, Fig. 7", judged(least < 0), "At each step of C = 0, 0.1, 0.5, 2 the peak falls, with both closures and on the chain. It is "
                + ", ".join(f"{top:.4f}" for top in tops["chain"]) + " cA/π on the chain.", "Σ− = 0.855, Σ+ = 0, t = 2π", STEP + " --json   # peak_slip_velocity")]


def stress_dependence(found) -> list:
    """Tests how the ratio of Fig. 10 depends on Sigma-."""
    at = found["curves"]["slip_velocity_ratio"].sel(friction_coefficient=0.5)
    low, high = ({closure: float(at.sel(closure=closure, stress=stress)) for closure in CLOSURES} for stress in (0.419, 0.855))
    change = {closure: max(high[closure] / low[closure], low[closure] / high[closure]) - 1 for closure in CLOSURES}
    free = relation("slip_velocity", stress=0.855) / relation("slip_velocity", stress=0.419)
    command = "slipfront relations --stress 0.419 --stress 0.855 --friction-coefficient 0.5"
    return [row("The reduction of slip velocity depends weakly on Σ−", "3.2, Fig. 10", judged(max(change.values()) < 0.3),
                f"At C = 0.5 the ratio changes by {100 * change['consistent']:.0f} % (consistent closure) and {100 * change['paper']:.0f} % (paper's), while W(0) itself changes by a factor of {free:.0f}.", "Σ− = 0.419 to 0.855, C = 0.5, t = 2π; a change of less than 30 % is weak", command),
            row("The effect of friction is slightly larger at larger Σ−", "5, Fig. 10", judged(high["consistent"] < low["consistent"]),
                f"The ratio at C = 0.5 rises from {low['consistent']:.3f} to {high['consistent']:.3f} with the consistent closure, with which the chain agrees: friction has less effect. With the paper's closure it falls from {low['paper']:.2f} to {high['paper']:.2f}, as the paper states.",
                "Σ− = 0.419 to 0.855, C = 0.5, t = 2π", command)]


def against_drop(found) -> list:
    """Tests how W(0) depends on the stress drop (Fig. 12)."""
    W, free = found["drops"]["slip_velocity_at_origin"].sel(stress=0.855), found["drops"]["without_friction"].sel(stress=0.855)
    share, exact = (W / W.sel(stress_drop=1.0)), free / free.sel(stress_drop=1.0)
    at = {drop: [100 * float(one) for one in (exact.sel(stress_drop=drop), share.sel(stress_drop=drop, closure="paper"), share.sel(stress_drop=drop, closure="consistent"))] for drop in (0.35, 0.4, 0.05)}
    none = float(abs(W.sel(stress_drop=0.0)).max())
    return [row(f"W(0) does not depend on Σ+ for stress drops of {text}", where, judged(min(at[drop]) > 95), f"At {100 * drop:.0f} % W(0) is {at[drop][0]:.0f} % of that at 100 % without friction (exact), {at[drop][1]:.0f} % at C = 0.1 with "
                f"the paper's closure, {at[drop][2]:.0f} % with the consistent one.", "Σ− = 0.855, true step, t = 2π; a change of less than 5 % counts as none", FIG_12)
            for drop, text, where in ((0.35, "35 to 100 %", "3.3, Fig. 12"), (0.4, "more than 40 %", "5"))] + [
        row("As the stress drop goes to 0, so does W(0)", "3.3, 5, Fig. 12", judged(none < 1e-12 and max(at[0.05]) < 25), f"At a drop of 5 % W(0) is {at[0.05][0]:.0f} % of that at 100 % without friction; without a drop it is {none:.0e} cA/π.",
            "Σ− = 0.855, drops of 0 to 100 %", FIG_12),
        row("Where Σ− = Σ+ there is no slip and no rupture", "3.1", EXACT, f"No gradient of stress moves a train at rest: W(0) stays at {none:.0e} cA/π in a run.", "Σ− = Σ+ = 0.855 and 0.606, C = 0.1", FIG_12.replace("0.556", "0.855"))]


def place_of_peak(runs) -> list:
    """Tests W from edge to edge, and the position of its peak."""
    x = numpy.linspace(-0.6, 0.2, 8001)
    W = slipfront.train.profile(1.03, x)
    edges = slipfront.train.profile(1.03, [W.attrs["left_edge"] + 1e-9, W.attrs["right_edge"] - 1e-9])["W"].values
    top = float(W["x_over_t"][int(W["W"].values.argmax())])
    places = [at_origin(run, "peak_position") for run in step_runs(runs, SHARES[0])["chain"]]
    return [row("W is 0 at both edges and has its maximum at x = 0", "3.1", EXACT, f"Without friction (U k)_x = (x/t) k_x, which changes its sign at x = 0. The peak of the profile is at x/t = {top:.4f}. W is {edges[0]:.0e} cA/π at 1e-9 from the trailing edge. At the leading edge it falls to 0 like 1 / ln(distance), and is {edges[1]:.0e} cA/π at the same distance. "
                f"With friction the peak moves back: on the chain to x = {places[2]:.2f} b/A at C = 0.5 and {places[3]:.2f} at C = 2, t = 2π.", "Σ− = 1.03 without friction, 0.855 with friction", STEP_CHAIN + " --json   # peak_position")]


def profile_width(runs) -> dict:
    """Compares W(0) for two widths of the initial profile, early and late."""
    widths, late = (0.1, 1.0), 40.0
    wanted = [("fig-07.toml", {"friction.closure": "consistent", "initial.width": width, "time.end": late, "output.every": 2 * numpy.pi}) for width in widths]
    narrow, wide = (run["slip_velocity_at_origin"] for run in runs.many("widths", wanted))
    early, end = abs(float(wide[1] / narrow[1]) - 1), abs(float(wide[-1] / narrow[-1]) - 1)
    return row("The width of the initial profile matters only until both fronts have left it", "3.2, Fig. 7", close(end, 0.02),
               f"W(0) from widths of 0.1 and 1 b/A differs by {100 * early:.0f} % at t = 2π and by {100 * end:.1f} % at t = {late:g}. At t = 2π, the time of Figs. 8 to 10, the leading edge has moved only {2 * numpy.pi * relation('leading_velocity', stress=0.855):.2f} b/A: "
               "the width matters then.", "Σ− = 0.855, Σ+ = 0.179, C = 0.1, consistent closure", "slipfront pulse cases/fig-07.toml --set friction.closure=consistent --set initial.width=0.1 --set time.end=40 --json")


def smoothness(stress) -> dict:
    """Tests the largest slope of the stress (Fig. 9)."""
    steepest = stress["steepest"]
    falls = bool((steepest.diff("friction_coefficient") < 0).all())
    words = "; ".join(f"{name}: " + ", ".join(f"{float(value):.2f}" for value in steepest.sel(closure=closure)) for closure, name in (("paper", "paper's closure"), ("consistent", "consistent"), ("chain", "chain")))
    return row("The larger the friction, the smoother the transition of stress", "3.2, Fig. 9", judged(falls), f"Largest slope of the stress at C = 0.1, 0.5, 2, in μA²/(πb), {words}.", "Σ− = 0.855, Σ+ = 0.179, tanh of width 1, t = 2π",
               "slipfront pulse cases/fig-09.toml --set friction.coefficient=0.5 -o fig-09.nc   # Sigma")


def stability(runs) -> dict:
    """Tests the paper's reason for a smooth profile and Sigma+ > 0."""
    W = at_origin(runs.pulse("step.toml", {"friction.law": "viscous", "friction.coefficient": 0.5, "friction.closure": "consistent", "pulse.threshold": SHARES[0]}))
    chain = at_origin(step_runs(runs, SHARES[0])["chain"][2])
    return row("A smooth profile with Σ+ > 0 is necessary for a numerically stable solution", "3.2", REFUTED if abs(W / chain - 1) < 0.01 else "Confirmed", f"A run of a true step into the empty side completes: W(0) = {W:.5f} cA/π at t = 2π, {100 * (W / chain - 1):+.2f} % from the chain.",
               "Σ− = 0.855, Σ+ = 0, C = 0.5, consistent closure; the paper's own closure is unstable from C t = 3 on (docs/friction_ratio.md)", STEP.replace("=2", "=0.5") + " --json")


def table(runs, found, stress) -> list:
    """Returns the rows of the table. stress: the data of Fig. 9."""
    return [*falls(runs), *stress_dependence(found), *against_drop(found), *place_of_peak(runs), profile_width(runs), smoothness(stress), stability(runs)]
