"""Figs. 10 and 12: sweeps over initial stress and friction."""

import numpy
import xarray
from matplotlib.figure import Figure

from ..plots.style import label, styled
from .picture import Picture, picture
from .runs import CLOSURES


def sweep(runs, what, case, stresses, coefficients, changes, quantities) -> xarray.Dataset:
    """Quantities at the last time over closure, coefficient and stress, by slipfront.sweep."""
    axes = {"friction.closure": list(CLOSURES), "friction.coefficient": list(coefficients), "initial.stress_left": list(stresses)}
    data = runs.sweep(what, case, axes, changes, quantities)
    data = data.rename(dict(zip(axes, ("closure", "coefficient", "stress"))))
    return data.assign_coords(stress=("stress", stresses, {"long_name": "initial stress Sigma-", "units": "1", "dimensional_unit": "mu A / pi"}))


@styled
def draw_slip(data, paper) -> Figure:
    """W(0) against stress (above), and its share of that without friction (below); one column a closure."""
    figure = Figure(figsize=(7.2, 5.4))
    panels = figure.subplots(2, 2, sharex=True, sharey="row")
    numbers = {n["key"]: n["printed"] for n in paper["number"]}
    for column, closure in enumerate(data["closure"].values):
        for i, c in enumerate(data["coefficient"].values):
            one = data["slip_velocity_at_origin"].sel(closure=closure, coefficient=c)
            panels[0, column].plot(data["stress"], one, color=f"C{i}", label=f"C = {c:g}")
            panels[1, column].plot(data["stress"], one / data["slip_velocity_at_origin"].sel(closure=closure, coefficient=0), color=f"C{i}")
            printed = numbers[f"parkfield_slip_velocity_{c}" if c else "parkfield_slip_velocity"]
            panels[0, column].plot(paper["inputs"]["stress"], float(printed), "o", color=f"C{i}", markerfacecolor="white", linestyle="none",
                                   label="printed" if c == data["coefficient"].values[-1] else None)
        panels[0, column].set(title=f"closure {closure}", yscale="log")
        panels[1, column].set(xlabel=label(data["stress"]), ylim=(0, 1.1))
    panels[0, 0].set_ylabel(label(data["slip_velocity_at_origin"]))
    panels[1, 0].set_ylabel("W(0) over that without friction")
    panels[0, 0].legend(loc="lower right")
    return figure


def slip(runs, paper) -> Picture:
    """Fig. 10."""
    stresses = numpy.unique(numpy.append(numpy.round(numpy.linspace(0.6, 1.6, 11), 6), paper["inputs"]["stress"]))
    data = sweep(runs, "Fig. 10", "fig-10.toml", stresses, [0, *paper["inputs"]["friction"]], {}, ["slip_velocity_at_origin"])
    return picture("fig-10", draw_slip(data, paper), data)


@styled
def draw_fronts(data, closed_form) -> Figure:
    """Mean velocities of both edges against stress; one column a closure."""
    figure = Figure(figsize=(7.2, 3.6))
    for axes, closure in zip(figure.subplots(1, 2, sharey=True), data["closure"].values):
        axes.plot(closed_form["stress"], closed_form["rupture_velocity"], color="0.75", linestyle="-", linewidth=4, label="|V−|, closed form")
        for i, c in enumerate(data["coefficient"].values):
            one = data.sel(closure=closure, coefficient=c)
            axes.plot(data["stress"], -one["trailing_velocity"], "o", color=f"C{i}", markersize=6 - 1.2 * i, markerfacecolor="none", linestyle="none")
            axes.plot(data["stress"], one["leading_velocity"], color=f"C{i}", label=f"leading edge, C = {c:g}")
        axes.plot([], [], "o", color="black", markerfacecolor="none", linestyle="none", label="trailing edge, all C")
        axes.set(title=f"closure {closure}", xlabel=label(data["stress"]), xlim=(0.2, 1.4), ylim=(0, 0.85))
    figure.axes[0].set_ylabel("mean velocity to t = 2π, c")
    figure.axes[0].legend(loc="upper left")
    return figure


def fronts(runs, paper, relations) -> Picture:
    """Fig. 12."""
    stresses = numpy.round(numpy.linspace(0.3, 1.3, 11), 6)
    changes = {"initial.stress_right": paper["inputs"]["stress_right"], "friction.law": "viscous"}
    data = sweep(runs, "Fig. 12", "step.toml", stresses, [0, *paper["inputs"]["friction"]], changes, ["trailing_front", "leading_front"])
    for name in ("trailing", "leading"):
        data[f"{name}_velocity"] = data[f"{name}_front"] / (2 * numpy.pi)
        data[f"{name}_velocity"].attrs = {"long_name": f"mean velocity of the {name} edge to t = 2 pi", "units": "1", "dimensional_unit": "c"}
    return picture("fig-12", draw_fronts(data, relations), data)
