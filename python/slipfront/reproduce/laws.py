"""Figs. 4-6: the frictionless slip pulse, closed form."""

import numpy
import xarray
from matplotlib.figure import Figure

import slipfront

from ..plots.style import label, styled
from .picture import Picture, picture

#: The paper's two worked examples, marked in Figs. 5 and 6: (name, key of the computed numbers for stress, mark).
EXAMPLES = (("Parkfield 2004", "parkfield", "o"), ("ETS", "ets", "s"))


@styled
def draw_pulse(data, times) -> Figure:
    """Stress and slip velocity of the frictionless pulse at several times, and its edges."""
    figure = Figure(figsize=(7.2, 3.3))
    for axes, name in zip(figure.subplots(1, 2), ("Sigma", "W")):
        for i, (time, text) in enumerate(times.items()):
            axes.plot(data["x_over_t"] * time, data[name], color=f"C{i}", label=f"t = {text}")
            for edge in (data.attrs["left_edge"], data.attrs["right_edge"]):
                axes.axvline(edge * time, color=f"C{i}", linestyle=":", linewidth=0.8)
        axes.set(xlabel="position x, b/A", ylabel=label(data[name]), xlim=(-3, 1.5))
    figure.axes[0].legend()
    return figure


def pulse() -> Picture:
    """Fig. 4."""
    x_over_t = numpy.unique(numpy.concatenate((numpy.linspace(-2, 1, 1201), numpy.linspace(0.095, 0.105, 401))))
    data = slipfront.train.profile(0.855, x_over_t)
    return picture("fig-04", draw_pulse(data, {numpy.pi / 2: "π/2", numpy.pi: "π", 2 * numpy.pi: "2π"}), data, stress=data.attrs["stress"])


def laws():
    """The closed form over the stress of both figures."""
    return slipfront.relations(stress=xarray.DataArray(numpy.round(numpy.geomspace(0.1, 2.5, 241), 6), dims="stress_index"))


@styled
def draw_laws(data, names, values) -> Figure:
    """Quantities against the initial stress: linear left, logarithmic right, with the paper's examples."""
    figure = Figure(figsize=(7.2, 3.4))
    for axes, scale in zip(figure.subplots(1, 2), ("linear", "log")):
        for name, text in names.items():
            axes.plot(data["stress"], data[name], label=text)
        for example, key, mark in EXAMPLES:
            stress = values[f"{key}_stress"]
            point = float(slipfront.relations(stress=[stress])[next(iter(names))].values[0])
            axes.plot(stress, point, mark, color="black", markerfacecolor="white", markersize=6, linestyle="none", label=example)
        axes.set(xlabel=label(data["stress"]), yscale=scale, title="linear" if scale == "linear" else "logarithmic")
    unit = "cA/π" if "slip_velocity" in names else "c"
    figure.axes[0].set_ylabel(f"{'slip velocity W at x = 0' if unit != 'c' else 'velocity of an edge'}, {unit}")
    figure.axes[1].legend(loc="lower right")
    return figure


def rupture(values) -> Picture:
    """Fig. 5."""
    data = laws()[["stress", "rupture_velocity", "leading_velocity", "velocity_ratio"]]
    return picture("fig-05", draw_laws(data, {"rupture_velocity": "|V−|, trailing edge", "leading_velocity": "V+, leading edge"}, values), data)


def slip(values) -> Picture:
    """Fig. 6."""
    data = laws()[["stress", "slip_velocity", "stress_at_origin"]]
    stresses = [values[f"{key}_stress"] for key in ("parkfield", "ets")]
    parkfield, ets = slipfront.relations(stress=stresses)["slip_velocity"].values
    return picture("fig-06", draw_laws(data, {"slip_velocity": "W(0)"}, values), data, parkfield=parkfield, slip_ratio=parkfield / ets,
                   stress_ratio=stresses[0] / stresses[1])
