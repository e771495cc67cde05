"""Parts of the pictures of a run with springs: force, slip velocity, slip events."""

import math

import numpy
from matplotlib.colors import LogNorm

from .style import REST, label

#: Number of decades of slip velocity that a colour scale shows at most.
DECADES = 9

#: Forces of a loaded run, of which a file has one: on a chain that is pulled everywhere, and at a
#: pulled end.
FORCES = ("loading_force", "loading_stress")


def force_of(run):
    """Returns the force of the springs over time, or None if no springs load the run."""
    return next((run[name] for name in FORCES
                 if name in run and run[name].ndim == 1 and bool(run[name].notnull().any())), None)


def is_loaded(run) -> bool:
    return force_of(run) is not None or "event_onset" in run


def count_of(run) -> int:
    return run.sizes["event"] if "event_onset" in run else 0


def event_of(run, number=None) -> int:
    """Returns the index of an event by its number, or of the largest. Raises ValueError."""
    events = count_of(run)
    if events == 0:
        raise ValueError("the run has no slip event; allowed: a run with [loading] in which events "
                         "occur")
    if number is None:
        return int(numpy.argmax(numpy.abs(run["event_slip"].values)))
    if not 1 <= number <= events:
        raise ValueError(f"event {number}: the run has {events} event{'s' if events > 1 else ''}; "
                         f"allowed: 1 to {events}")
    return number - 1


def spans(run) -> tuple:
    """Returns the onsets and the ends of the slip events."""
    if not count_of(run):
        return numpy.empty(0), numpy.empty(0)
    onsets = run["event_onset"].values
    return onsets, onsets + run["event_duration"].values


def force_with_events(run) -> tuple:
    """Returns times and forces for a line, and the force at the onset of each event.

    The force at the output times is that of the file. Short events, with at most one output during
    them, are added: there the force falls by the stress drop of the event. Between events the force
    changes linearly in time, before an output during an event as it did before.
    """
    force, times = force_of(run), run["time"].values
    values, (onsets, ends) = force.values, spans(run)
    drops = run["event_stress_drop"].values * _sign_of(force, run) if onsets.size else onsets
    first, last = (numpy.searchsorted(times, numbers) for numbers in (onsets, ends))
    corners, rate = [(times[0], values[0])], 0.0
    for row in range(1, times.size):
        inside = numpy.flatnonzero((first == row) & (last == row))
        crossing = numpy.flatnonzero((first == row) & (last == row + 1))
        quiet = times[row] - times[row - 1] - (ends - onsets)[inside].sum()
        if quiet > 0 and not crossing.size:
            rate = (values[row] - values[row - 1] + drops[inside].sum()) / quiet
        for event in (*inside, *crossing):
            before = corners[-1][1] + rate * (onsets[event] - corners[-1][0])
            corners.append((onsets[event], before))
            if event in inside:
                corners.append((ends[event], before - drops[event]))
        corners.append((times[row], values[row]))
    line = numpy.array(corners).T
    return (*line, numpy.interp(onsets, *line))


def _sign_of(force, run) -> int:
    """Returns the sign of the force that holds slip: -1 for a pushed right end."""
    if force.name == "loading_force":
        return direction(run)
    return -1 if float(force.mean()) < 0 else 1


def direction(run) -> int:
    """Returns 1 if the run slips forward on the whole, and -1 if it slips backward."""
    return -1 if "slip" in run and float(run["slip"][-1].mean()) < 0 else 1


def slip_rates(run) -> numpy.ndarray:
    """Returns the size of the mean slip velocity between outputs, over interval and x."""
    slip = run["slip"].transpose("time", "x")
    change = numpy.diff(slip.values, axis=0)
    noise = 8 * numpy.finfo(float).eps * numpy.nanmax(numpy.abs(slip.values), initial=0)
    change[numpy.abs(change) <= noise] = 0
    return numpy.abs(change) / numpy.diff(run["time"].values)[:, None]


def rate_label(run) -> str:
    return label(run["W"], "mean slip velocity |W|") if "W" in run else "mean slip velocity"


def rate_scale(rates) -> dict:
    """Returns the options of a map of slip velocities: decades, or 0 to 1 at rest."""
    moving = rates[numpy.isfinite(rates) & (rates > REST)]
    if moving.size == 0:
        return {"vmin": 0, "vmax": 1}
    top = math.ceil(math.log10(moving.max()) - 1e-9)
    bottom = max(math.floor(math.log10(moving.min())), top - DECADES)
    return {"norm": LogNorm(10.0 ** min(bottom, top - 2), 10.0**top, clip=True)}


def draw_rates(figure, axes, across, up, rates, text, **bar_options) -> None:
    """Draws a map of slip velocities (interval, x) between edges; not finite ones are grey."""
    scale = rate_scale(rates)
    image = axes.pcolormesh(across, up, numpy.ma.masked_invalid(rates).T, rasterized=True, **scale)
    axes.set_facecolor("0.75")
    axes.grid(False)
    slower = "norm" in scale and bool((rates < scale["norm"].vmin).any())
    bar = figure.colorbar(image, ax=axes, label=text, extend="min" if slower else "neither",
                          pad=0.02, **bar_options)
    if "norm" not in scale:
        bar.set_ticks([0])
        say(axes, "at rest")


def say(axes, text) -> None:
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", color="0.3")


def edges_of(run) -> numpy.ndarray:
    bounds = run["x_bounds"].values
    return numpy.append(bounds[:, 0], bounds[-1, 1])
