"""Figs. 7 and 11: slip velocity over x and t, a surface for each state."""

import numpy
import xarray
from matplotlib.figure import Figure

from ..plots.style import styled
from . import look
from .numbers import FRICTION
from .picture import Picture, picture
from .runs import CLOSURES

#: Where the surfaces are drawn, in b / A.
PLACES = numpy.linspace(-5, 3, 161)

#: Sigma+ of Fig. 11; the last one is close to Sigma- = 0.855.
RIGHT = (0.05, 0.179, 0.427, 0.8)


def surface(pulse) -> xarray.DataArray:
    """W of a run over time and PLACES."""
    W = pulse["W"].interp(x=PLACES)
    return W.assign_coords(x=("x", PLACES, pulse["x"].attrs))


def surfaces(runs, what, case, key, values, changes, dimension) -> xarray.Dataset:
    """W over closure, `dimension`, time and x: a run for each value of the scenario's `key`."""
    wanted = [(case, {"friction.closure": closure, key: value} | changes) for closure in CLOSURES for value in values]
    found = [surface(run) for run in runs.many(what, wanted)]
    rows = [xarray.concat(found[i:i + len(values)], xarray.DataArray(list(values), dims=dimension.dims, name=dimension.name, attrs=dimension.attrs))
            for i in range(0, len(found), len(values))]
    return xarray.Dataset({"W": xarray.concat(rows, xarray.DataArray(list(CLOSURES), dims="closure", name="closure"))})


def draw_one(axes, W, top, title):
    """One surface."""
    x, t = numpy.meshgrid(W["x"].values, W["time"].values)
    axes.plot_surface(x, t, W.values, cmap="viridis", vmin=0, vmax=top, rcount=W.sizes["time"], ccount=W.sizes["x"], linewidth=0.1, edgecolor=(0, 0, 0, 0.25), rasterized=True)
    axes.set(zlim=(0, top), xlim=(PLACES[0], PLACES[-1]), ylim=(0, 2 * numpy.pi), xticks=[-4, -2, 0, 2], yticks=[0, numpy.pi, 2 * numpy.pi])
    axes.set_yticklabels(["0", "π", "2π"])
    axes.set_title(title, fontsize=9, loc="center", y=0.98)
    axes.tick_params(labelsize=7, pad=-2)
    axes.set_xlabel("x, b/A", fontsize=8, labelpad=-6)
    axes.set_ylabel("t, b/(cA)", fontsize=8, labelpad=-6)
    axes.view_init(elev=32, azim=-62)
    axes.set_box_aspect((1.35, 1, 0.75), zoom=1.02)


@styled
def draw(data, dimension, words, one_scale) -> Figure:
    """Surfaces: a row a closure, a column a value of `dimension`. words: formats a value. one_scale: whether all share the vertical axis."""
    values = data[dimension].values
    figure = Figure(figsize=(7.2, 4.9), layout="none")
    for row, closure in enumerate(CLOSURES):
        for column, value in enumerate(values):
            W = data["W"].sel(closure=closure).isel({dimension: column})
            axes = figure.add_subplot(2, len(values), row * len(values) + column + 1, projection="3d")
            top = float((data["W"] if one_scale else data["W"].isel({dimension: column})).max())
            draw_one(axes, W, top, words(value))
            axes.zaxis.set_major_locator(matplotlib_ticks(3))
        figure.text(0.012, 0.73 - 0.47 * row, look.TITLES[closure], rotation=90, va="center", fontsize=9)
    figure.text(0.5, 0.97, "slip velocity W, cA/π (vertical), over position and time", ha="center", fontsize=9)
    figure.subplots_adjust(left=0.03, right=0.97, bottom=0.04, top=0.93, wspace=0.02, hspace=0.06)
    return figure


def matplotlib_ticks(count):
    """A few round ticks."""
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(count)


def with_friction(runs) -> Picture:
    """Fig. 7."""
    axis = xarray.DataArray([0.0], dims="friction_coefficient", name="friction_coefficient", attrs=look.FRICTION)
    data = surfaces(runs, "Fig. 7", "fig-07.toml", "friction.coefficient", FRICTION, {}, axis)
    top = data["W"].isel(time=-1).max("x")
    fall = {closure: float(top.sel(closure=closure)[0] / top.sel(closure=closure)[-1]) for closure in CLOSURES}
    return picture("fig-07", draw(data, "friction_coefficient", lambda c: f"C = {c:g}", True), data, fall=fall["paper"], fall_consistent=fall["consistent"])


def with_right_stress(runs) -> Picture:
    """Fig. 11."""
    axis = xarray.DataArray([0.0], dims="stress_right", name="stress_right", attrs=look.STRESS_RIGHT)
    data = surfaces(runs, "Fig. 11", "fig-11.toml", "initial.stress_right", RIGHT, {}, axis)
    words = {right: f"Σ+ = {right:g}, drop {100 * (1 - right / 0.855):.0f} %" for right in RIGHT}
    return picture("fig-11", draw(data, "stress_right", lambda right: words[float(right)], False), data)
