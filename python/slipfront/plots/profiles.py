"""Draws profiles of fields along the interface at several times."""

import numpy

from .pulse_parts import (backward, extent, finite, is_constant, mark_fronts, say_rest, shades,
                          title_of, window)
from .style import REST, Picture, is_si, label, prefixed, rest_of, styled, unit


def room(lowest, highest, below, rest=REST) -> tuple:
    """Returns the limits of an axis with a share `below` of space below, and 6 % above."""
    if max(abs(lowest), abs(highest)) < rest:
        return -1, 1
    if is_constant(lowest, highest):
        return tuple(sorted((0.9 * lowest, 1.1 * highest)))
    height = highest - lowest or abs(highest) or 1
    return lowest - below * height, highest + 0.06 * height


@styled
def profiles(pulse, fields=("W", "Sigma", "slip"), times: int = 5) -> Picture:
    """Draws profiles of fields along the interface at several times, with one panel for each field.

    Parameters
    ----------
    pulse : xarray.Dataset
        Result of `slipfront.pulse` or `slipfront.chain`, with the dimensions time and x.
    fields : sequence of str, optional
        Variables that depend on time and x. Those that the Dataset does not have are left out.
    times : int, optional
        Number of output times to draw. They are spread evenly and include the first and the last.

    Examples
    --------
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml")
    >>> figure = slipfront.plots.profiles(pulse)
    >>> figure.axes[-1].get_xlabel()
    'position x, b/A'
    """
    pulse = finite(pulse)
    fields = [name for name in fields if name in pulse]
    rows = numpy.unique(numpy.linspace(0, pulse.sizes["time"] - 1, times).round().astype(int))
    figure = Picture(figsize=(6.4, 0.7 + 1.9 * len(fields)))
    second, name_of_second = (prefixed(unit(pulse["time"]), float(pulse["time"][-1]))
                              if is_si(pulse) else (1.0, unit(pulse["time"])))
    panels = figure.subplots(len(fields), 1, sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(panels, fields):
        for colour, row in zip(shades(len(rows)), rows):
            now = pulse.isel(time=row)
            axes.plot(now["x"], now[name], color=colour, linestyle="-",
                      label=f"{float(now['time']) / second:.3g}")
        remark = backward(pulse, name)
        say_rest(axes, pulse[name][rows])
        axes.set(ylabel=label(pulse[name]), xlim=window(pulse),
                 ylim=room(*extent(pulse[name].values[rows]), 0.2 if remark else 0.06,
                           rest_of(pulse[name])))
        axes.text(0.01, 0.03, remark, transform=axes.transAxes, color="0.3", fontsize="small")
    mark_fronts(panels[0], pulse)
    panels[0].set_title(title_of(pulse))
    panels[0].legend(title=f"t, {name_of_second}", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    panels[-1].set_xlabel(label(pulse["x"]))
    return figure
