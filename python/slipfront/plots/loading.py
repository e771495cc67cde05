"""Draws a run that springs load: force and slip velocity over time."""

import numpy

from .loaded_parts import (count_of, direction, draw_rates, edges_of, event_of, force_of,
                           force_with_events, rate_label, say, slip_rates, spans)
from .pulse_parts import finite, title_of
from .style import REST, Picture, label, scaled, styled

#: More events than this are marked by points without outlines.
MANY = 80


def before_failure(run, event) -> slice:
    """Returns the outputs from the end of the event before to the onset of `event`."""
    onsets, ends = spans(run)
    start = ends[event - 1] if event else -numpy.inf
    rows = numpy.flatnonzero((run["time"].values >= start) & (run["time"].values < onsets[event]))
    if rows.size < 3:
        raise ValueError(f"event {event + 1}: the file has {rows.size} output times between the "
                         "event before and its onset; allowed: 3 or more, as with a smaller "
                         "output.every")
    return slice(rows[0], rows[-1] + 1)


@styled
def loading(run, until_failure: bool = False, event: int | None = None) -> Picture:
    """Draws the force of the springs over time with the slip events, and below it the slip velocity
    over time and position.

    The slip velocity is the mean between one output and the next, on a logarithmic colour scale. So
    no event is lost between two outputs.

    Parameters
    ----------
    run : xarray.Dataset
        Result of `slipfront.chain` with a table [loading], with two or more output times.
    until_failure : bool, optional
        Whether the axis is the logarithm of the time until the onset of an event. It begins at the
        end of the event before.
    event : int, optional
        Number of that event, from 1. By default it is the event with the largest slip.

    Raises
    ------
    ValueError if the run has no such event, or too few outputs before it.

    Examples
    --------
    >>> chain = slipfront.chain(slipfront.cases / "stick-slip.toml", set={
    ...     "domain.left": -12, "domain.right": 12, "time.end": 1e4, "output.every": 1e3,
    ...     "pulse.cells": 4})
    >>> figure = slipfront.plots.loading(chain)
    >>> figure.axes[0].get_ylabel()
    'force F, 10⁻⁶ μA²/(π(1-ν))'
    """
    run = finite(run)
    chosen = event_of(run, event) if until_failure else None
    figure = Picture(figsize=(6.4, 5.2))
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=(2, 3))
    figure.suptitle(title_of(run))
    times = run["time"]
    rows = slice(None) if chosen is None else before_failure(run, chosen)
    shift = 0.0 if chosen is None else float(run["event_onset"][chosen])
    sign = 1 if chosen is None else -1
    draw_force(top, run, rows, chosen)
    draw_rates(figure, bottom, sign * (times.values[rows] - shift), edges_of(run),
               slip_rates(run.isel(time=rows)), rate_label(run))
    bottom.set_ylabel(label(run["x"]))
    if chosen is None:
        scaled(bottom.xaxis, times, label(times), times.values)
        bottom.set_xlim(times.values[0], times.values[-1])
    else:
        failure_axis(bottom, run, rows, chosen)
    return figure


def failure_axis(axes, run, rows, event) -> None:
    """Makes the axis the logarithm of the time until an event, which is on the right."""
    remaining = float(run["event_onset"][event]) - run["time"].values[rows]
    axes.set(xscale="log", xlim=(remaining.max(), remaining.min()),
             xlabel=label(run["time"], f"time until event {event + 1}"))


def draw_force(axes, run, rows, event) -> None:
    """Draws force over time, or over the time until an event, with the onsets of events."""
    force = force_of(run)
    if force is None:
        axes.set_ylabel("force")
        say(axes, "this file has no force of the springs")
        return
    times, values, at_onsets = force_with_events(run)
    if event is not None:
        outputs = run["time"].values[rows]
        onset = float(run["event_onset"][event])
        inside = (times >= outputs[0]) & (times <= outputs[-1])
        axes.plot(onset - times[inside], values[inside], color="C0")
        values = values[inside]
    else:
        axes.plot(times, values, color="C0", label="force")
        mark_events(axes, run, at_onsets)
    if numpy.nanmax(numpy.abs(values)) < REST:
        axes.set_ylim(-1, 1)
        axes.set_yticks([0])
        say(axes, "no force")
        axes.set_ylabel(label(force))
        return
    scaled(axes.yaxis, force, label(force), values)


def mark_events(axes, run, at_onsets) -> None:
    """Marks the onsets of the events just outside the line of the force."""
    if not count_of(run):
        axes.text(0.99, 0.05, "no events", transform=axes.transAxes, ha="right", color="0.3",
                  fontsize="small")
        return
    complete = run["event_complete"].values > 0
    few = complete.size <= MANY
    marker = "v" if direction(run) > 0 else "^"
    for chosen, fill, text in ((complete, "C1", "onset of an event"),
                               (~complete, "white",
                                "onset of an event that the end of the run cuts")):
        if chosen.any():
            axes.plot(run["event_onset"].values[chosen], at_onsets[chosen], linestyle="none",
                      marker=marker if few else ".", markersize=5 if few else 3, color="C1",
                      markerfacecolor=fill, label=text, zorder=3)
    axes.margins(y=0.12)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=3, borderaxespad=0.2)
