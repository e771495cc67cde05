"""Maps of fields over space and time."""

import numpy
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from .pulse_parts import finite, fronts_of, title_of, window
from .style import label, styled


def colours(values) -> dict:
    """Colours of a map: white at zero where the field goes both ways, the style sheet's where it goes one."""
    if numpy.isnan(values).all():
        return {}
    highest = float(numpy.nanmax(numpy.abs(values)))
    return {"cmap": "PuOr_r", "vmin": -highest, "vmax": highest} if numpy.nanmin(values) < -0.05 * highest else {}


@styled
def space_time(pulse, fields=("W", "Sigma")) -> Figure:
    """Maps of fields over position (across) and time (upwards), with the lines of the fronts.

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
    bounds = pulse["x_bounds"].values
    for axes, name in zip(panels, fields):
        values = pulse[name].transpose("time", "x").values
        # A band of colour lies between two outputs and is their mean.
        image = axes.pcolormesh(numpy.append(bounds[:, 0], bounds[-1, 1]), pulse["time"].values, (values[1:] + values[:-1]) / 2, rasterized=True,
                                **colours(values))
        figure.colorbar(image, ax=axes, location="top", label=label(pulse[name]), aspect=30, ticks=MaxNLocator(6))
        for front, line, text in fronts_of(pulse):
            axes.plot(front, pulse["time"], color="C6", linestyle=line, label=text, linewidth=1.3)
        axes.set(xlabel=label(pulse["x"]), xlim=window(pulse), ylim=(float(pulse["time"][0]), float(pulse["time"][-1])))
        axes.grid(False)
    panels[0].set_ylabel(label(pulse["time"]))
    if fronts_of(pulse):
        figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=3)
        figure.get_layout_engine().set(rect=(0, 0.07, 1, 0.93))
    figure.suptitle(title_of(pulse))
    return figure
