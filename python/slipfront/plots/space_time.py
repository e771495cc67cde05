"""Maps of fields over space and time."""

import numpy
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from .between import between
from .pulse_parts import backward, extent, finite, fronts_of, title_of, window
from .style import label, styled

#: Points of a map across and upwards.
POINTS = (600, 400)


def colours(values) -> dict:
    """Colours of a map: white at zero where the field goes both ways, the style sheet's from its least value where it goes one."""
    lowest, highest = extent(values)
    largest = max(-lowest, highest)
    if lowest < -0.05 * largest:
        return {"cmap": "PuOr_r", "vmin": -largest, "vmax": largest}
    return {"vmin": lowest if lowest > highest / 2 else min(lowest, 0), "vmax": highest} if largest > 0 else {}


def name_fronts(axes, pulse) -> None:
    """Draws the fronts of a pulse as lines and writes their symbols beside those that have one, where the line is most often inside the window."""
    for front, line, text, symbol in fronts_of(pulse):
        axes.plot(front, pulse["time"], color="C6", linestyle=line, label=text, linewidth=1.3)
        inside = numpy.flatnonzero(front.notnull().values & (pulse["time"].values > 0))
        if symbol and inside.size:
            row = inside[int(0.6 * (inside.size - 1))]
            right = symbol == "V+"
            axes.annotate(symbol, (float(front[row]), float(pulse["time"][row])), xytext=(5 if right else -5, 0), textcoords="offset points",
                          ha="left" if right else "right", va="center", color="#005f8f", fontweight="bold", clip_on=True, annotation_clip=True,
                          path_effects=[withStroke(linewidth=2, foreground="white")])


@styled
def space_time(pulse, fields=("W", "Sigma")) -> Figure:
    """Maps of fields over position (across) and time (upwards), with the lines of the fronts. Cells that are not finite are grey.

    Parameters
    ----------
    pulse : xarray.Dataset
        Over time (two or more) and x, with x_bounds: what `slipfront.pulse` and `slipfront.chain` give.
    fields : sequence of str
        Variables over time and x; those that are not in it are left out.
    """
    pulse = finite(pulse)
    fields = [name for name in fields if name in pulse]
    figure = Figure(figsize=(3.7 * len(fields), 4.2))
    panels = figure.subplots(1, len(fields), sharey=True, squeeze=False)[0]
    (left, right), outputs = window(pulse), pulse["time"].values
    # Corners of the map's points; values belong to their middles.
    across, up = numpy.linspace(left, right, POINTS[0] + 1), numpy.linspace(outputs[0], outputs[-1], POINTS[1] + 1)
    for axes, name in zip(panels, fields):
        scale = colours(pulse[name].values)
        values = between(pulse, name, (up[1:] + up[:-1]) / 2, (across[1:] + across[:-1]) / 2)
        image = axes.pcolormesh(across, up, numpy.ma.masked_invalid(values), rasterized=True, **scale)
        axes.set_facecolor("0.75")
        over = bool(scale) and numpy.nanmax(numpy.abs(pulse[name].values)) > scale["vmax"]
        figure.colorbar(image, ax=axes, location="top", label="\n".join(filter(None, (label(pulse[name]), backward(pulse, name)))), aspect=30, ticks=MaxNLocator(6),
                        extend="max" if over else "neither")
        name_fronts(axes, pulse)
        axes.set(xlabel=label(pulse["x"]), xlim=(left, right), ylim=(float(outputs[0]), float(outputs[-1])))
        axes.grid(False)
    panels[0].set_ylabel(label(pulse["time"]))
    if fronts_of(pulse):
        figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=2)
        figure.get_layout_engine().set(rect=(0, 0.11, 1, 0.89))
    figure.suptitle(title_of(pulse))
    return figure
