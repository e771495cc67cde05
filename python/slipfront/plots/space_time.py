"""Draws maps of fields over position and time."""

import re

import numpy
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from .pulse_parts import (backward, extent, finite, fronts_of, is_constant, say_rest, title_of,
                          window)
from .style import REST, Picture, label, rest_of, styled

#: Number of points of a map, along x and along time.
POINTS = (600, 400)


#: Fronts with which the field moves between two outputs. Both must be known at both outputs.
CARRIERS = ("trailing_front", "leading_front")


def speed_of(pulse) -> float:
    """Returns the speed c in the units of a pulse: 1 in those of the model, and else m/s."""
    found = re.search(r"\bc = (\S+) m/s", str(pulse.attrs.get("medium", "")))
    return float(found[1]) if found else 1.0


def anchors(pulse, row) -> numpy.ndarray:
    """Returns the positions that the interpolation follows from output `row` to the next: the ends
    of the domain and the fronts.

    The fronts are left out unless they are known and no faster than strain waves, because an
    observed front may jump. The result is an array of 2 (this output, the next) x number of
    positions, ascending in x (b / A).
    """
    bounds = pulse["x_bounds"].values
    ends = numpy.array([[bounds.min()] * 2, [bounds.max()] * 2])
    if not all(name in pulse for name in CARRIERS):
        return ends.T
    fronts = numpy.array([pulse[name].values[row : row + 2] for name in CARRIERS])
    steady = numpy.all(numpy.abs(fronts[:, 1] - fronts[:, 0]) <= speed_of(pulse)
                       * numpy.diff(pulse["time"].values[row : row + 2]))
    places = numpy.vstack((ends[:1], fronts, ends[1:])).T
    # Both are false for NaN
    return places if steady and numpy.all(numpy.diff(places, axis=1) >= 0) else ends.T


def between(pulse, name: str, times, places) -> numpy.ndarray:
    """Returns the values of a field at given times and positions within the range of the file, as
    an array over time and position.

    Between two outputs the field moves with the fronts and changes linearly in time. A front is
    therefore a line in the picture and not a staircase. A cell that is not finite makes a gap as
    wide as the cell and as long as the interval between two outputs.

    pulse: Dataset over time and x with x_bounds. times (b / (c A)) and `places` (positions x, b /
    A): ascending.
    """
    field = pulse[name].transpose("time", "x").values
    x, outputs = pulse["x"].values, pulse["time"].values
    values = numpy.empty((len(times), len(places)))
    rows = numpy.clip(numpy.searchsorted(outputs, times, side="right") - 1, 0, len(outputs) - 2)
    for i, (time, row) in enumerate(zip(times, rows)):
        share = (time - outputs[row]) / (outputs[row + 1] - outputs[row])
        before, after = anchors(pulse, row)
        now = (1 - share) * before + share * after
        first, second = (numpy.interp(numpy.interp(places, now, then), x, field[row + side])
                         for side, then in enumerate((before, after)))
        # Both fronts start at the same x, so there is no earlier field between them
        if len(before) == 4 and before[1] == before[2]:
            first = numpy.where((places > now[1]) & (places < now[2]), second, first)
        mixed = (1 - share) * first + share * second
        values[i] = numpy.where(numpy.isfinite(mixed), mixed, first if share < 0.5 else second)
    return values


def colours(values, rest=REST) -> dict:
    """Returns the colours of a map, with white at zero for both signs, never of rounding."""
    lowest, highest = extent(values)
    largest = max(-lowest, highest)
    if largest < rest:
        return {"vmin": 0, "vmax": 1}
    if is_constant(lowest, highest):
        return {"vmin": min(lowest, 0), "vmax": max(highest, 0)}
    if lowest < -0.05 * largest:
        return {"cmap": "PuOr_r", "vmin": -largest, "vmax": largest}
    return {"vmin": lowest if lowest > highest / 2 else min(lowest, 0),
            "vmax": highest} if largest > 0 else {}


def path_of(front, pulse):
    """Returns a front as a line; on a chain, whose phonons let it jump, how far it has come."""
    is_chain = str(pulse.attrs.get("history", "")).startswith("slipfront chain")
    if not is_chain or not str(front.name).endswith("_observed"):
        return front
    if front.name == "trailing_front_observed":
        return numpy.fmin.accumulate(front.values)
    return numpy.fmax.accumulate(front.values)


def name_fronts(axes, pulse) -> None:
    """Draws the fronts as lines, with symbols at late times, usually inside the window."""
    for front, line, text, symbol in fronts_of(pulse):
        axes.plot(path_of(front, pulse), pulse["time"], color="C6", linestyle=line, label=text,
                  linewidth=1.3)
        inside = numpy.flatnonzero(front.notnull().values & (pulse["time"].values > 0))
        if symbol and inside.size:
            row = inside[int(0.6 * (inside.size - 1))]
            ahead = float(pulse.get(f"{front.name}_observed", front)[row] - front[row])
            right = not ahead > 0 if symbol == "V+" else ahead < 0  # not on the dotted line
            axes.annotate(symbol, (float(front[row]), float(pulse["time"][row])),
                          xytext=(5 if right else -5, 0), textcoords="offset points",
                          ha="left" if right else "right", va="center", color="#005f8f",
                          fontweight="bold", clip_on=True, annotation_clip=True,
                          path_effects=[withStroke(linewidth=2, foreground="white")])


def outline_trains(axes, pulse) -> None:
    """Draws the edges of regions with two and three trains at one position."""
    if "trains" in pulse and float(pulse["trains"].max()) > 1 and min(pulse["trains"].shape) > 1:
        axes.contour(pulse["x"], pulse["time"], pulse["trains"], levels=[1.5, 2.5], colors="0.85",
                     linewidths=0.8, linestyles=["-", "--"])


@styled
def space_time(pulse, fields=("W", "Sigma")) -> Picture:
    """Draws maps of fields over position (horizontal) and time (vertical), with the lines of the
    fronts. Grey lines enclose two trains at one position, dashed ones three.

    Cells that are not finite are grey.

    Parameters
    ----------
    pulse : xarray.Dataset
        Result of `slipfront.pulse` or `slipfront.chain` with two or more output times. It has the
        dimensions time and x, and x_bounds.
    fields : sequence of str, optional
        Variables that depend on time and x. Those that the Dataset does not have are left out.

    Examples
    --------
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml")
    >>> figure = slipfront.plots.space_time(pulse)
    >>> figure.axes[0].get_ylabel()
    'time t, b/(cA)'
    """
    pulse = finite(pulse)
    fields = [name for name in fields if name in pulse]
    figure = Picture(figsize=(3.7 * len(fields), 4.2))
    panels = figure.subplots(1, len(fields), sharey=True, squeeze=False)[0]
    (left, right), outputs = window(pulse), pulse["time"].values
    # These are the edges of the map's points. The values are computed at their centres.
    across = numpy.linspace(left, right, POINTS[0] + 1)
    up = numpy.linspace(outputs[0], outputs[-1], POINTS[1] + 1)
    for axes, name in zip(panels, fields):
        scale = colours(pulse[name].values, rest_of(pulse[name]))
        values = between(pulse, name, (up[1:] + up[:-1]) / 2, (across[1:] + across[:-1]) / 2)
        image = axes.pcolormesh(across, up, numpy.ma.masked_invalid(values), rasterized=True,
                                **scale)
        axes.set_facecolor("0.75")
        say_rest(axes, pulse[name])
        over = bool(scale) and numpy.nanmax(numpy.abs(pulse[name].values)) > scale["vmax"]
        figure.colorbar(image, ax=axes, location="top",
                        label="\n".join(filter(None, (label(pulse[name]), backward(pulse, name)))),
                        aspect=30, ticks=MaxNLocator(6), extend="max" if over else "neither")
        name_fronts(axes, pulse)
        outline_trains(axes, pulse)
        axes.set(xlabel=label(pulse["x"]), xlim=(left, right),
                 ylim=(float(outputs[0]), float(outputs[-1])))
        axes.grid(False)
    panels[0].set_ylabel(label(pulse["time"]))
    if fronts_of(pulse):
        figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=2)
        figure.get_layout_engine().set(rect=(0, 0.11, 1, 0.89))
    figure.suptitle(title_of(pulse))
    return figure
