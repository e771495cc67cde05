"""Draws one slip event: its front over time and position, and its slip."""

import numpy

from .loaded_parts import draw_rates, edges_of, event_of, rate_label, slip_rates, spans
from .pulse_parts import finite, title_of
from .style import REST, Picture, label, quantity, scaled, styled

#: With fewer outputs than this during an event, the file does not show where its front was.
FEWEST = 5


@styled
def slip_event(run, event: int | None = None) -> Picture:
    """Draws one slip event: slip velocity over time and position with its front and the fitted
    velocity, and slip along the interface.

    The front is where the slip velocity first exceeds that of the origin at the onset of the event.
    It is drawn if there are five outputs or more during the event and it has an origin. The lines
    of the fitted velocity begin at the origin of the event at its onset.

    Parameters
    ----------
    run : xarray.Dataset
        Result of `slipfront.chain` with a table [loading], with slip events.
    event : int, optional
        Number of the event, from 1. By default it is the event with the largest slip.

    Raises
    ------
    ValueError if the run has no such event.

    Examples
    --------
    >>> chain = slipfront.chain(slipfront.cases / "stick-slip.toml", set={
    ...     "domain.left": -12, "domain.right": 12, "time.end": 4e5, "output.every": 1e4,
    ...     "pulse.cells": 4})
    >>> figure = slipfront.plots.slip_event(chain)
    >>> figure.axes[1].get_xlabel()
    'slip u, b/(2π)'
    """
    run = finite(run)
    chosen = event_of(run, event)
    onset, end = (float(values[chosen]) for values in spans(run))
    rows = outputs_around(run["time"].values, onset, end)
    near = run.isel(time=rows)
    since, during = (near["time"].values - onset,
                     int(((run["time"] >= onset) & (run["time"] <= end)).sum()))
    figure = Picture(figsize=(7.0, 4.2))
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=(2.4, 1))
    rates = slip_rates(near)
    draw_rates(figure, left, since, edges_of(run), rates, rate_label(run), location="top",
               aspect=30)
    if during >= FEWEST and numpy.isfinite(run["event_origin"][chosen]):
        draw_front(left, near, since, rates, float(run["event_origin"][chosen]))
    draw_fit(left, run, chosen, float(since[-1]))
    shown = (since[0], since[-1])
    if during >= FEWEST:  # the outputs next to the event may be far away
        shown = max(since[0], onset - end), min(since[-1], 2 * (end - onset))
    left.set(xlim=shown, ylim=edges_of(run)[[0, -1]], ylabel=label(run["x"]))
    scaled(left.xaxis, run["time"], label(run["time"], "time since onset"), numpy.array(shown))
    draw_slip(right, run, onset, end)
    outputs = (f"{during} output{'' if during == 1 else 's'} during it" if during
               else "no output during it")
    figure.suptitle(": ".join(filter(None, (title_of(run, 40), f"event {chosen + 1} of "
                                            f"{run.sizes['event']}, {outputs}"))))
    figure.legend(*left.get_legend_handles_labels(), loc="lower center", ncol=2)
    figure.get_layout_engine().set(rect=(0, 0.12, 1, 0.88))
    return figure


def outputs_around(times, onset, end) -> slice:
    """Returns the outputs of an event and of a third of it around; if few, three more."""
    margin = (end - onset) / 3
    first = max(int(numpy.searchsorted(times, onset - margin, side="right")) - 1, 0)
    last = min(int(numpy.searchsorted(times, end + margin)), times.size - 1)
    more = 3 if last - first < FEWEST + 2 else 0
    return slice(max(first - more, 0), min(last + more, times.size - 1) + 1)


def draw_front(axes, near, since, rates, origin) -> None:
    """Draws when each position exceeds the slip velocity of the origin at onset."""
    middles = (since[1:] + since[:-1]) / 2
    cell = int(numpy.argmin(numpy.abs(near["x"].values - origin)))
    logarithms = numpy.log(numpy.maximum(rates, REST))
    threshold = float(numpy.interp(0.0, middles, logarithms[:, cell]))
    during = middles >= min(0.0, middles[-1])
    arrivals = numpy.array([crossing(middles, column, threshold, during)
                            for column in logarithms.T])
    # The interval before the onset may be long
    arrivals = numpy.maximum(arrivals, min(0.0, middles[-1]))
    axes.plot(arrivals, near["x"].values, color="C6", linestyle="-",
              label="front: |W| first above that of the origin at onset")


def crossing(times, values, threshold, during) -> float:
    """Returns the first time in `during` at which values reach a threshold, or NaN."""
    above = numpy.flatnonzero((values >= threshold) & during)
    if not above.size:
        return numpy.nan
    row = above[0]
    if row == 0 or values[row - 1] >= threshold:
        return float(times[row])
    share = (threshold - values[row - 1]) / (values[row] - values[row - 1])
    return float(times[row - 1] + share * (times[row] - times[row - 1]))


def draw_fit(axes, run, event, last) -> None:
    """Draws the origin of the event, and lines of the fitted velocity from it if there is one."""
    origin, velocity = float(run["event_origin"][event]), run["event_rupture_velocity"][event]
    if not numpy.isfinite(origin):
        axes.plot([], [], linestyle="none", label="no origin: all parts move at once")
        return
    axes.plot([0], [origin], marker="*", markersize=9, color="C2", markeredgecolor="white",
              linestyle="none", label="origin", zorder=4, clip_on=False)
    if not numpy.isfinite(velocity):
        axes.plot([], [], linestyle="none",
                  label="no fitted velocity: fewer than three parts, or all at once")
        return
    times = numpy.array([0.0, max(last, 0.0)])
    for sign, text in ((1, f"fitted velocity {quantity(velocity, float(velocity), 3)}"),
                       (-1, None)):
        axes.plot(times, origin + sign * float(velocity) * times, color="C2", linestyle="--",
                  label=text, zorder=3)


def draw_slip(axes, run, onset, end) -> None:
    """Draws the slip between the last output before an event and the first after it."""
    times = run["time"].values
    before = max(int(numpy.searchsorted(times, onset, side="right")) - 1, 0)
    after = min(int(numpy.searchsorted(times, end)), times.size - 1)
    slip = run["slip"][after] - run["slip"][before]
    axes.plot(slip.values, run["x"].values, color="C0")
    scaled(axes.xaxis, run["slip"], label(run["slip"]), slip.values)
    axes.set_title("around the event", fontsize="small")
    low, high = min(float(slip.min()), 0.0), max(float(slip.max()), 0.0)
    axes.set_xlim(low * 1.08, high * 1.08 if high > 0 else 1)
