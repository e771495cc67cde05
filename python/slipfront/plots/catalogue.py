"""Draws slip events: slip against length, stress drop against the time between events."""

import numpy

from .loaded_parts import event_of, say
from .pulse_parts import title_of
from .relations import spans_decades
from .style import Picture, label, plain_numbers, scaled, styled


@styled
def catalogue(run) -> Picture:
    """Draws the slip of each event against its length, and its stress drop against the time since
    the event before.

    An axis whose values span more than a decade is logarithmic, not counting events that the end of
    the run cuts. These have open symbols.

    Parameters
    ----------
    run : xarray.Dataset
        Result of `slipfront.chain` with a table [loading], with slip events.

    Raises
    ------
    ValueError if the run has no slip event.

    Examples
    --------
    >>> chain = slipfront.chain(slipfront.cases / "stick-slip.toml", set={
    ...     "domain.left": -12, "domain.right": 12, "time.end": 4e5, "output.every": 1e5,
    ...     "pulse.cells": 4})
    >>> figure = slipfront.plots.catalogue(chain)
    >>> figure.axes[0].get_xlabel()
    'length, b/A'
    """
    event_of(run)
    figure = Picture(figsize=(7.0, 3.3))
    left, right = figure.subplots(1, 2)
    complete = run["event_complete"].values > 0
    scatter(left, run["event_length"], run["event_slip"], run["event_length"].values,
            run["event_slip"].values, complete)
    since = numpy.diff(run["event_onset"].values)
    drop = run["event_stress_drop"]
    scatter(right, run["event_onset"], drop, since, drop.values[1:], complete[1:],
            "time since the event before")
    if since.size == 0:
        right.set(xlim=(0, 1), ylim=(0, 1), xticks=[], yticks=[],
                  xlabel=label(run["time"], "time since the event before"), ylabel=label(drop))
        say(right, "one event only")
    if not complete.all():
        left.legend(loc="upper left", bbox_to_anchor=(0.0, -0.2), ncol=2, borderaxespad=0)
    figure.suptitle(title_of(run))
    return figure


def scatter(axes, across, up, x, y, complete, name="") -> None:
    """Draws y against x, and chooses the scales and labels of the axes."""
    for chosen, fill, text in ((complete, "C0", "event"),
                               (~complete, "white", "event that the end of the run cuts")):
        if chosen.any():
            axes.plot(x[chosen], y[chosen], linestyle="none", marker="o", color="C0",
                      markerfacecolor=fill, label=text, alpha=0.8)
    if x.size == 0:
        return
    for axis, variable, values, text in ((axes.xaxis, across, x, label(across, name)),
                                         (axes.yaxis, up, y, label(up))):
        whole = values[complete] if complete.any() else values
        if values.min() > 0 and spans_decades(whole):
            (axes.set_xscale if axis is axes.xaxis else axes.set_yscale)("log")
            plain_numbers(axis)
            axis.set_label_text(text)
        else:
            from_zero(axes, axis, values)
            scaled(axis, variable, text, values)


def from_zero(axes, axis, values) -> None:
    """Lets a linear axis begin at zero unless values are negative: equal ones look equal."""
    if values.min() >= 0 and values.max() > 0:
        (axes.set_xlim if axis is axes.xaxis else axes.set_ylim)(0, 1.1 * values.max())
