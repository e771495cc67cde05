"""Figs. 8 and 9: slip velocity and stress along the interface at t = 2 pi."""

import numpy
import xarray
from matplotlib.figure import Figure

import slipfront

from .._dataset import about
from ..plots.style import label, styled
from . import picture as look
from .numbers import FRICTION
from .picture import Picture, picture
from .runs import CLOSURES, SCALE

SPAN = (-7.0, 2.5)


def profiles(runs, case, width) -> xarray.Dataset:
    """Returns W and Sigma over closure or "chain", friction coefficient and x, at t = 2 pi."""
    changes = [{"friction.coefficient": c, "initial.width": width} for c in FRICTION]
    found = runs.many(case, [(case, {"friction.closure": closure} | change) for closure in CLOSURES
                             for change in changes])
    found += runs.chains(case, [(case, change) for change in changes])
    grid = found[0]["x"]
    ends = [run[["W", "Sigma"]].isel(time=-1).drop_vars("time").interp(x=grid) for run in found]
    coefficients = xarray.DataArray(list(FRICTION), dims="friction_coefficient",
                                    name="friction_coefficient", attrs=look.FRICTION)
    closures = xarray.DataArray([*CLOSURES, "chain"], dims="closure", name="closure")
    rows = [xarray.concat(ends[i:i + 3], coefficients) for i in (0, 3, 6)]
    data = xarray.concat(rows, closures)
    return data.assign_attrs(width=width, scale=SCALE)


def edges() -> tuple:
    """x of both edges at t = 2 pi without friction: V- t and V+ t of the exact Riemann problem."""
    exact = slipfront.relations(stress=[0.855], stress_right=[0.179])
    return (-2 * numpy.pi * float(exact["rupture_velocity"][0]),
            2 * numpy.pi * float(exact["leading_velocity"][0]))


def chain_points(axes, data, times, c, words, until=SPAN[1]):
    """Draws averages of the chain as dots. Ahead of the pulse they are waves, not slip."""
    one = data.sel(closure="chain", friction_coefficient=c, x=slice(SPAN[0], until))[::13]
    axes.plot(one["x"], times * one, **look.CHAIN, label=words)


def draw_column(upper, lower, data, closure, factor):
    """Draws a closure of Fig. 8: linear above, logarithmic below, times `factor`."""
    for (line, colour), c, printed in zip(look.CURVES, FRICTION, ("", "1.8", "5.2")):
        times = float(factor.sel(closure=closure, friction_coefficient=c))
        words = f"C = {c:g}" + (f", × {times:.2f}" + (f" (paper: {printed})" if closure == "paper"
                                                      else "") if printed else "")
        for axes in (upper, lower):
            axes.plot(data["x"], times * data["W"].sel(closure=closure, friction_coefficient=c),
                      color=colour, linestyle=line, label=words)
            if closure == "consistent":
                chain_points(axes, data["W"], times, c, f"chain, scale {data.attrs['scale']}"
                             if c == FRICTION[-1] else None, 1.0)
    top = float(data["W"].sel(closure=closure, friction_coefficient=FRICTION[0]).max())
    for axes, tip, tail in ((upper, 0.02 * top, 0.16 * top), (lower, 2.2e-7, 1.2e-6)):
        for edge in edges():
            axes.annotate("", (edge, tip), (edge, tail),
                          arrowprops={"arrowstyle": "-|>", "color": "#1f4fd8", "linewidth": 1.4})
    for edge, name in zip(edges(), ("V−t", "V+t")):
        upper.text(edge, 0.18 * top, name, color="#1f4fd8", ha="center", fontsize=8)
    upper.set(xlim=SPAN, ylim=(0, 1.7 * top), title=look.TITLES[closure])
    lower.set(xlim=SPAN, yscale="log", ylim=(2e-7, 0.1), xlabel=label(data["x"]))
    upper.legend(loc="upper left")


@styled
def draw_scaled(data, factor) -> Figure:
    figure = Figure(figsize=(7.2, 5.6))
    panels = figure.subplots(2, 2, sharex=True, sharey="row")
    for column, closure in enumerate(CLOSURES):
        draw_column(panels[0, column], panels[1, column], data, closure, factor)
    for axes in panels[:, 0]:
        axes.set_ylabel("W times factor, cA/π")
    return figure


def scaled(runs, width, ratio_width) -> Picture:
    data = profiles(runs, "fig-08.toml", width)[["W"]].assign_attrs(width=width, scale=SCALE)
    peak = data["W"].max("x")
    attrs = about("peak of W at C = 0.1 over the peak at C")
    data["factor"] = (peak.isel(friction_coefficient=0) / peak).assign_attrs(attrs)
    by_paper = data["factor"].sel(closure="paper").values
    printed = [("factor at C = 0.5", "1.8", float(by_paper[1])),
               ("factor at C = 2", "5.2", float(by_paper[2]))]
    consistent = data["factor"].sel(closure="consistent").values
    return picture("fig-08", draw_scaled(data, data["factor"]), data, printed, width=width,
                   ratio_width=ratio_width, weak=float(consistent[1]), strong=float(consistent[2]))


@styled
def draw_stress(data) -> Figure:
    figure = Figure(figsize=(7.2, 3.4))
    for axes, closure in zip(figure.subplots(1, 2, sharey=True), CLOSURES):
        axes.plot(SPAN, [0.855, 0.855], color="0.75", linestyle="-", linewidth=0.8, zorder=0)
        for (line, colour), c in zip(look.CURVES, FRICTION):
            axes.plot(data["x"], data["Sigma"].sel(closure=closure, friction_coefficient=c),
                      color=colour, linestyle=line, label=f"C = {c:g}")
            if closure == "consistent":
                chain_points(axes, data["Sigma"], 1, c,
                             f"chain, scale {data.attrs['scale']}" if c == FRICTION[-1] else None)
        axes.set(title=look.TITLES[closure], xlabel=label(data["x"]), xlim=SPAN, ylim=(0, 1))
        axes.legend(loc="lower left")
    figure.axes[0].set_ylabel("stress Σ, μA/π")
    return figure


def stress(runs) -> Picture:
    width = 1.0
    data = profiles(runs, "fig-09.toml", width)[["Sigma"]].assign_attrs(width=width, scale=SCALE)
    slope = abs(data["Sigma"].differentiate("x")).sel(x=slice(-6, 2)).max("x")
    attrs = about("greatest slope of the stress", "mu A^2 / (pi b)")
    data["steepest"] = slope.assign_attrs(attrs)
    return picture("fig-09", draw_stress(data), data, width=width, before=(0.855 - 0.179) / 2)
