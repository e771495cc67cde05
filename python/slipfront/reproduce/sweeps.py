"""Figs. 10 and 12: slip velocity at x = 0 against friction, and against the stress drop."""

import numpy
import xarray
from matplotlib.figure import Figure

import slipfront

from .._dataset import about
from ..plots.style import styled
from . import picture as look
from .numbers import FRICTION
from .picture import Picture, picture
from .runs import CLOSURES, SCALE, at_origin

#: C of Fig. 10, among them those at which the paper reads it.
COEFFICIENTS = numpy.round(numpy.linspace(0, 2.5, 51), 6)
#: Sigma- of its three curves: solid, dashed, dotted.
STRESSES = (0.855, 0.606, 0.419)
#: Ratios that the paper reads off it, at C = 0.1, 0.5 and 2.
READ = (0.83, 0.5, 0.2)
#: (Sigma- - Sigma+) / Sigma- of Fig. 12, and its two Sigma-, which the paper does not print.
DROPS = numpy.round([0.02, 0.05, *numpy.linspace(0.1, 0.75, 14), 0.8, 0.85, 0.9, 0.95, 0.98, 1.0],
                    6)
LEFT = (0.855, 0.606)


def ratios(runs) -> xarray.Dataset:
    """W(0) over that without friction, over closure, stress and friction coefficient: a true step
    into the empty side, t = 2 pi.

    From the table of `slipfront.friction_ratio`, to its `uncertainty`: single runs with the paper's
    closure are unstable from C = 0.5 on. `chain` has every dislocation, at the C of the paper,
    where it has enough of them (Sigma- = 0.855); NaN elsewhere.
    """
    damping = 2 * numpy.pi * COEFFICIENTS
    tables = [[slipfront.friction_ratio(stress, damping, closure=closure) for stress in STRESSES]
              for closure in CLOSURES]
    found = {name: [[table[name].values for table in row] for row in tables]
             for name in ("ratio", "uncertainty")}
    chains = [at_origin(run) for run in runs.chains(
        "Fig. 10", [("step.toml", {"friction.law": "viscous", "friction.coefficient": c,
                                   "initial.stress_left": STRESSES[0]}) for c in (0.0, *FRICTION)])]
    chain = numpy.full((len(STRESSES), len(COEFFICIENTS)), numpy.nan)
    for c, value in zip((0.0, *FRICTION), chains):
        chain[0, int(numpy.flatnonzero(COEFFICIENTS == c)[0])] = value / chains[0]
    axes, attrs = (("closure", "stress", "friction_coefficient"),
                   about("slip velocity at x = 0 over that without friction, t = 2 pi"))
    return xarray.Dataset(
        {"slip_velocity_ratio": (axes, found["ratio"], attrs),
         "uncertainty": (axes, found["uncertainty"], about("largest relative error of the ratio")),
         "chain": (axes[1:], chain, about("the ratio on the chain, which knows no closure"))},
        {"closure": list(CLOSURES), "stress": ("stress", list(STRESSES), look.STRESS),
         "friction_coefficient": ("friction_coefficient", COEFFICIENTS, look.FRICTION)},
        {"stress_right": 0.0, "scale": SCALE})


@styled
def draw_ratios(data, smooth) -> Figure:
    """Fig. 10: a column a closure."""
    figure = Figure(figsize=(7.2, 3.8))
    for axes, closure in zip(figure.subplots(1, 2, sharey=True), CLOSURES):
        for (line, colour), stress in zip(look.CURVES, STRESSES):
            axes.plot(data["friction_coefficient"],
                      data["slip_velocity_ratio"].sel(closure=closure, stress=stress), color=colour,
                      linestyle=line, label=f"Σ− = {stress:g}")
        axes.plot(FRICTION, smooth.sel(closure=closure, friction_coefficient=list(FRICTION)), "D",
                  color="C0", markersize=4, linestyle="none",
                  label=f"Σ− = 0.855, smooth ({smooth.attrs['width']:.2g} b/A) into 0.179")
        if closure == "consistent":
            axes.plot(data["friction_coefficient"], data["chain"].sel(stress=STRESSES[0]),
                      **look.CHAIN, label=f"chain, Σ− = 0.855, scale {data.attrs['scale']}")
        axes.plot(FRICTION, READ, **look.PRINTED, label="read by the paper")
        axes.set(title=look.TITLES[closure], xlabel="friction coefficient C", xlim=(0, 2.5),
                 ylim=(0, 1))
        axes.legend(loc="upper right")
    figure.axes[0].set_ylabel("W(C) / W(C = 0) at x = 0, t = 2π")
    return figure


def friction(data, ratio) -> Picture:
    values = data["slip_velocity_ratio"].sel(closure="paper", stress=0.855)
    printed = [(f"ratio at C = {c:g}, Σ− = 0.855", f"{read:g}",
                float(values.sel(friction_coefficient=c))) for c, read in zip(FRICTION, READ)]
    width = ratio.attrs["width"]
    smooth = ratio["smooth"].assign_attrs(width=width)
    kept = data.assign(slip_velocity_ratio_smooth=smooth.assign_attrs(
        stress=0.855, stress_right=0.179))
    at = data["slip_velocity_ratio"].sel(friction_coefficient=0.5)
    low, high = ({closure: float(at.sel(closure=closure, stress=stress)) for closure in CLOSURES}
                 for stress in (0.419, 0.855))
    return picture("fig-10", draw_ratios(data, smooth), kept, printed, width=width,
                   paper_low=low["paper"], paper_high=high["paper"],
                   consistent_low=low["consistent"], consistent_high=high["consistent"])


def drops(runs, coefficient=0.1) -> xarray.Dataset:
    """W(0) at t = 2 pi after a true step, over stress drop, stress and closure; the exact Riemann
    problem without friction.

    Without a drop nothing moves: W is 0 to rounding there.
    """
    all_drops = numpy.append(0.0, DROPS)
    wanted = [("step.toml", {"friction.law": "viscous", "friction.closure": closure,
                             "friction.coefficient": coefficient, "initial.stress_left": stress,
                             "initial.stress_right": float(round(stress * (1 - drop), 9))})
              for drop in all_drops for stress in LEFT for closure in CLOSURES]
    W = numpy.reshape([at_origin(run) for run in runs.many("Fig. 12", wanted)],
                      (len(all_drops), len(LEFT), len(CLOSURES)))
    stress, drop = numpy.meshgrid(LEFT, all_drops)
    exact = slipfront.relations(stress=stress, stress_right=numpy.round(stress * (1 - drop), 9))
    return xarray.Dataset(
        {"slip_velocity_at_origin": (("stress_drop", "stress", "closure"), W, look.SLIP_VELOCITY),
         "without_friction": (("stress_drop", "stress"), exact["slip_velocity"].values,
                              about("the same without friction, exact", "c A / pi")),
         "leading_velocity": (("stress_drop", "stress"), exact["leading_velocity"].values,
                              about("V+ of the leading edge without friction, exact", "c"))},
        {"stress_drop": ("stress_drop", all_drops, about("stress drop (Sigma- - Sigma+) / Sigma-")),
         "stress": ("stress", list(LEFT), look.STRESS), "closure": list(CLOSURES)},
        {"friction_coefficient": coefficient})


@styled
def draw_drops(data) -> Figure:
    """Fig. 12: a panel for each of two stresses."""
    figure = Figure(figsize=(7.2, 3.6))
    for axes, stress in zip(figure.subplots(1, 2), LEFT):
        one = data.sel(stress=stress)
        axes.axvspan(0.35, 1, color="0.93", linewidth=0, zorder=0)
        axes.plot(one["stress_drop"], one["without_friction"], color="0.55", linestyle="-",
                  linewidth=3, label="no friction, exact")
        for (line, colour), closure in zip(look.CURVES, CLOSURES):
            axes.plot(one["stress_drop"], one["slip_velocity_at_origin"].sel(closure=closure),
                      color=colour, linestyle=line, label=f"C = 0.1, {look.TITLES[closure]}")
        axes.set(title=f"Σ− = {stress:g}", xlabel="stress drop (Σ− − Σ+) / Σ−", xlim=(0, 1),
                 ylim=(0, None))
    figure.axes[0].set_ylabel("slip velocity W at x = 0, cA/π")
    figure.axes[0].text(0.97, 0.03, "grey: said to be flat", transform=figure.axes[0].transAxes,
                        ha="right", fontsize=8, color="0.35")
    figure.axes[1].legend(loc="lower right")
    return figure


def against_drop(data) -> Picture:
    free = data["without_friction"].sel(stress=0.855)
    W = data["slip_velocity_at_origin"].sel(stress=0.855)
    share = W / W.sel(stress_drop=1.0)
    at = {closure: 100 * float(share.sel(stress_drop=0.35, closure=closure))
          for closure in CLOSURES}
    printed = [("W(0) at a drop of 35 % over that at 100 %, Σ− = 0.855", "1", at["paper"] / 100)]
    return picture("fig-12", draw_drops(data), data, printed, c=data.attrs["friction_coefficient"],
                   paper=at["paper"], consistent=at["consistent"],
                   exact=100 * float(free.sel(stress_drop=0.35) / free.sel(stress_drop=1.0)))
