"""Draws Figs. 7 and 11: slip velocity over x and t, with a surface for each state."""

import numpy
import xarray
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..plots.style import styled
from . import picture as look
from .numbers import FRICTION
from .picture import Picture, picture
from .runs import CLOSURES

#: Positions x of the surfaces of Figs. 7 and 11, in b / A.
PLACES = numpy.linspace(-4.5, 2.5, 141)
WIDER = numpy.linspace(-5.5, 4.5, 141)

#: Sigma+ of Fig. 11. The last value is close to Sigma- = 0.855.
RIGHT = (0.05, 0.427, 0.8)


def surface(pulse, places) -> xarray.DataArray:
    """Returns W of a run over time and x. `places`: the positions x."""
    return pulse["W"].interp(x=places).assign_coords(x=("x", places, pulse["x"].attrs))


def surfaces(runs, what, case, key, values, places, dimension) -> xarray.Dataset:
    """Returns W over closure, `dimension`, time and x, for values of a key of the scenario."""
    wanted = [(case, {"friction.closure": closure, key: value}) for closure in CLOSURES
              for value in values]
    found = [surface(run, places) for run in runs.many(what, wanted)]
    axis = xarray.DataArray(list(values), dims=dimension.dims, name=dimension.name,
                            attrs=dimension.attrs)
    rows = [xarray.concat(found[i:i + len(values)], axis)
            for i in range(0, len(found), len(values))]
    closures = xarray.DataArray(list(CLOSURES), dims="closure", name="closure")
    return xarray.Dataset({"W": xarray.concat(rows, closures)})


def draw_one(axes, W, top, title):
    x, t = numpy.meshgrid(W["x"].values, W["time"].values)
    axes.plot_surface(x, t, W.values, cmap="viridis", vmin=-0.25 * top, vmax=top,
                      rcount=W.sizes["time"], ccount=W.sizes["x"] // 2, linewidth=0.15,
                      edgecolor=(0, 0, 0, 0.35), rasterized=True)
    axes.set(zlim=(0, top), xlim=(x.min(), x.max()), ylim=(0, 2 * numpy.pi), xticks=[-4, -2, 0, 2],
             yticks=[0, numpy.pi, 2 * numpy.pi])
    axes.set_yticklabels(["0", "π", "2π"])
    axes.set_title(title, fontsize=9, loc="center", y=0.97)
    axes.tick_params(labelsize=7, pad=-3)
    axes.tick_params(axis="z", pad=0)
    axes.set_xlabel("x, b/A", fontsize=8, labelpad=-7)
    axes.set_ylabel("t, b/(cA)", fontsize=8, labelpad=-7)
    axes.zaxis.set_major_locator(MaxNLocator(3, prune="lower"))
    axes.view_init(elev=28, azim=-60)
    axes.set_box_aspect((1.3, 1, 0.9), zoom=0.98)
    axes.patch.set_visible(False)  # it would cover the numbers of the axes on its left


@styled
def draw(rows, dimension, words, one_scale) -> Figure:
    """Draws the surfaces. rows: title -> W, a row of the figure each. There is a column for each
    value of `dimension`.

    words: function that formats a value. one_scale: whether all surfaces share the vertical axis.
    """
    top = numpy.max([W.max(["time", "x"]) for W in rows.values()], axis=0)
    values = next(iter(rows.values()))[dimension].values
    figure = Figure(figsize=(7.2, 2.8 * len(rows)), layout="none")
    for row, (title, W) in enumerate(rows.items()):
        for column, value in enumerate(values):
            axes = figure.add_subplot(len(rows), len(values), row * len(values) + column + 1,
                                      projection="3d")
            draw_one(axes, W.isel({dimension: column}),
                     float(top.max() if one_scale else top[column]), words(value))
        figure.text(0.005, 1 - 0.09 / len(rows) - 0.98 * row / len(rows),
                    title + (": slip velocity W, cA/π (vertical)" if row == 0 else ""), fontsize=9,
                    va="bottom")
    figure.subplots_adjust(left=0.0, right=0.94, bottom=0.02 / len(rows), top=1 - 0.08 / len(rows),
                           wspace=0.1, hspace=0.04)
    return figure


def of_closures(data) -> dict:
    return {look.TITLES[closure]: data["W"].sel(closure=closure) for closure in CLOSURES}


def with_friction(runs) -> Picture:
    axis = xarray.DataArray([0.0], dims="friction_coefficient", name="friction_coefficient",
                            attrs=look.FRICTION)
    data = surfaces(runs, "Fig. 7", "fig-07.toml", "friction.coefficient", FRICTION, PLACES, axis)
    top = data["W"].isel(time=-1).max("x")
    fall = {closure: float(top.sel(closure=closure)[0] / top.sel(closure=closure)[-1])
            for closure in CLOSURES}
    return picture("fig-07",
                   draw(of_closures(data), "friction_coefficient", lambda c: f"C = {c:g}", True),
                   data, fall=fall["paper"], fall_consistent=fall["consistent"])


def without_friction(runs, W) -> xarray.DataArray:
    """Returns W without friction, the limit of Fig. 11, at the coordinates of `W`."""
    free = {"friction.coefficient": 0, "pulse.trains": "many"}
    found = runs.many("Fig. 11", [("fig-11.toml", free | {"initial.stress_right": float(right)})
                                  for right in W["stress_right"]])
    return xarray.DataArray([surface(run, W["x"].values).values for run in found],
                            W.isel(closure=0, drop=True).coords, ("stress_right", "time", "x"),
                            attrs=W.attrs)


def with_right_stress(runs) -> Picture:
    axis = xarray.DataArray([0.0], dims="stress_right", name="stress_right",
                            attrs=look.STRESS_RIGHT)
    data = surfaces(runs, "Fig. 11", "fig-11.toml", "initial.stress_right", RIGHT, WIDER, axis)
    data["without_friction"] = without_friction(runs, data["W"])
    words = {right: f"Σ+ = {right:g}, drop {100 * (1 - right / 0.855):.0f} %" for right in RIGHT}
    rows = of_closures(data) | {"no friction, exact": data["without_friction"]}
    return picture("fig-11", draw(rows, "stress_right", lambda right: words[float(right)], False),
                   data)
