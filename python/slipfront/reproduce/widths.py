"""The width of the initial profile, of which the paper prints only factors of Fig. 8."""

import numpy
import xarray
from matplotlib.figure import Figure

from .._dataset import about
from ..plots.style import styled
from .numbers import FRICTION
from .picture import Picture, picture
from .runs import CLOSURES

WIDTHS = numpy.round(numpy.concatenate((numpy.arange(0.2, 1.0, 0.1), numpy.arange(1.0, 3.05, 0.1))),
                     3)


def factors(runs) -> xarray.Dataset:
    """Returns the peak of W at C = 0.1 over that at C, over closure, C and width."""
    coefficients = list(FRICTION)
    wanted = [("fig-08.toml", {"friction.closure": closure, "friction.coefficient": c,
                               "initial.width": float(width)}) for closure in CLOSURES
              for c in coefficients for width in WIDTHS]
    peaks = numpy.array([float(pulse["peak_slip_velocity"][-1])
                         for pulse in runs.many("Fig. 8, widths", wanted)])
    peaks = peaks.reshape(len(CLOSURES), len(coefficients), len(WIDTHS))
    attrs = about("peak of W at C = 0.1 over the peak at C, at t = 2 pi")
    return xarray.Dataset(
        {"factor": (("closure", "coefficient", "width"), peaks[:, :1] / peaks, attrs)},
        {"closure": list(CLOSURES), "coefficient": coefficients,
         "width": ("width", WIDTHS, about("width of the initial tanh profile", "b / A"))})


def nearest(table, printed) -> float:
    """The width whose factors with closure "paper" come nearest to the printed ones: least sum of
    squared logarithms.

    printed: {coefficient: factor}.
    """
    misfit = sum(numpy.log(table["factor"].sel(closure="paper", coefficient=c) / factor) ** 2
                 for c, factor in printed.items())
    return float(table["width"][int(misfit.argmin())])


@styled
def draw(table, printed, width) -> Figure:
    """Factors against the width, one panel a closure, with the printed ones."""
    figure = Figure(figsize=(7.2, 3.4))
    for axes, closure in zip(figure.subplots(1, 2, sharey=True), CLOSURES):
        for i, (c, factor) in enumerate(printed.items()):
            axes.plot(table["width"], table["factor"].sel(closure=closure, coefficient=c),
                      color=f"C{i}", label=f"C = {c:g}")
            axes.axhline(factor, color=f"C{i}", linestyle=":", linewidth=1,
                         label=f"printed: {factor:g}")
        axes.axvline(width, color="0.6", linestyle="-", linewidth=0.8)
        axes.set(title=f"closure {closure}", xlabel="width of the initial profile, b/A",
                 xlim=(0, float(table["width"][-1])))
    figure.axes[0].set(ylabel="peak W at C = 0.1 over peak W at C", yscale="log", ylim=(1, 10),
                       yticks=[1, 2, 5, 10])
    figure.axes[0].set_yticks([], minor=True)
    figure.axes[0].set_yticklabels(["1", "2", "5", "10"])
    figure.axes[0].legend(loc="upper left", ncol=2)
    return figure


def pictured(table, printed, width) -> Picture:
    least = float(table["factor"].sel(closure="consistent", coefficient=min(printed)).min())
    return picture("width", draw(table, printed, width), table, width=width, least=least)
