"""Draws the fronts of a run: paths, velocity against stress, length against load."""

import numpy
from matplotlib.colors import LinearSegmentedColormap

from .. import relations
from .pulse_parts import title_of
from .style import Picture, label, plain_numbers, scaled, styled

#: Colour and name of an event that stops inside the block, and of one that crosses it.
INSIDE, CROSSES = ("C0", "stops inside"), ("#D55E00", "crosses the block")


def chosen_events(data, number):
    """Returns the rows of the events to draw. Raises ValueError if there is no such event."""
    numbers = data["event_number"].values
    if number is None:
        return numpy.arange(numbers.size)
    rows = numpy.flatnonzero(numbers == number)
    if not rows.size:
        allowed = (f"{numbers.min()} to {numbers.max()}" if numbers.size
                   else "none, because the run has no event")
        raise ValueError(f"event {number}: not in the file; allowed: {allowed}")
    return rows


def colours_of(data):
    """Returns the colour of each event: from light to dark, orange if it crosses the block."""
    crosses = data["event_crosses"].values > 0
    shades = LinearSegmentedColormap.from_list("events", ["#88CCEE", "#332288"])(
        numpy.linspace(0, 1, crosses.size))
    return [CROSSES[0] if crossing else tuple(shade) for crossing, shade in zip(crosses, shades)]


def paths(axes, data, rows, colours) -> None:
    x, arrival = data["position"].values, data["arrival"].values
    largest = 0.0
    for row in rows:
        fronts = numpy.flatnonzero(data["front_event"].values == data["event_number"].values[row])
        if not fronts.size:
            continue
        begin = numpy.nanmin(arrival[fronts])
        for front in fronts:
            reached = numpy.isfinite(arrival[front])
            order = numpy.argsort(arrival[front][reached], kind="stable")
            times = arrival[front][reached][order] - begin
            axes.plot(times, x[reached][order], color=colours[row], linestyle="-",
                      marker="." if times.size < 3 else "", linewidth=1.1)
            largest = max(largest, float(times[-1]))
    axes.set(ylabel=label(data["position"], "position x"), ylim=(x[0], x[-1]), title="Paths")
    scaled(axes.xaxis, data["front_onset"], label(data["front_onset"], "time since slip begins"),
           numpy.array([largest]))


def velocities(axes, data, rows) -> None:
    """Draws velocity against tau / sigma_N ahead, or else the stress, and the theory."""
    of_rows = numpy.isin(data["front_event"].values, data["event_number"].values[rows])
    velocity = data["velocity"].values[of_rows]
    by_ratio = bool(numpy.isfinite(data["stress_ratio"].values).any())
    stress = data["front_stress"].values[of_rows, None] + numpy.zeros_like(velocity)
    across = data["stress_ratio"].values[of_rows] if by_ratio else stress
    good = numpy.isfinite(velocity) & (velocity > 0) & (across > 0)
    crosses = numpy.isin(data["front_event"].values[of_rows],
                         data["event_number"].values[data["event_crosses"].values > 0])
    crossing = crosses[:, None] & good
    for chosen, (colour, name) in ((good & ~crossing, INSIDE), (crossing, CROSSES)):
        if chosen.any():
            axes.plot(across[chosen], velocity[chosen], marker=".", markersize=3, linestyle="none",
                      color=colour, alpha=0.6, label=f"event {name}", rasterized=True)
    speed = 1.0 if data["velocity"].attrs.get("dimensional_unit") else data.attrs["c_m_s"]
    axes.axhline(data.attrs["rayleigh_speed"] * speed, color="0.5", linewidth=0.8, linestyle="--",
                 label="Rayleigh waves")
    axes.axhline(speed, color="0.5", linewidth=0.8, linestyle=":", label="c")
    if data.attrs["tau"] == "stress" and good.any():
        theory(axes, data, across[good], by_ratio, speed)
    text = "τ / σ$_N$ ahead of the front" if by_ratio else label(data["front_stress"],
                                                                 "stress Σ ahead of the front")
    axes.set(yscale="log", xlabel=text, ylabel=label(data["velocity"], "front velocity V"),
             title="Velocity")
    plain_numbers(axes.yaxis)
    if good.any():
        axes.set_ylim(max(velocity[good].min() / 2, 1e-6 * speed),
                      2 * max(speed, float(velocity[good].max())))
    axes.legend(fontsize="x-small", loc="best")


def theory(axes, data, across, by_ratio, speed) -> None:
    at = numpy.linspace(0.9 * across.min(), 1.1 * across.max(), 100)
    unit = data.attrs["normal_stress_pa"] / data.attrs["tau_unit_pa"] if by_ratio else 1.0
    states = relations(stress=numpy.clip(at * unit, 0.005, None))
    for name, style, text in (("rupture_velocity", "-", "theory, |V−|"),
                              ("leading_velocity", "--", "theory, V+")):
        axes.plot(at, states[name].values.ravel() * speed, color="k", linestyle=style,
                  linewidth=0.9, label=text)


def lengths(axes, data, rows) -> None:
    load, length, crosses = (data["event_load"].values[rows], data["event_length"].values[rows],
                             data["event_crosses"].values[rows] > 0)
    for chosen, (colour, name) in ((~crosses, INSIDE), (crosses, CROSSES)):
        if chosen.any():
            axes.plot(load[chosen], length[chosen], marker="o", markersize=4, linestyle="none",
                      color=colour, label=name)
    axes.set(title="Precursors", ylim=(0, None))
    scaled(axes.yaxis, data["event_length"], label(data["event_length"], "length of slip"), length)
    scaled(axes.xaxis, data["event_load"], label(data["event_load"], "load before the event"), load)
    axes.legend(fontsize="x-small", loc="upper left")


@styled
def fronts(data, event: int | None = None) -> Picture:
    """Draws the paths of fronts, their velocity against tau / sigma_N ahead of them, and the length
    of each slip event against the load before it.

    The last panel needs slip events. The curves of the theory are drawn where tau is the stress of
    the theory, on a chain with a substrate or a pulse.

    Parameters
    ----------
    data : xarray.Dataset
        Result of `slipfront.fronts`, in units of the model or in SI units.
    event : int, optional
        Number of the only slip event to draw, from 1. By default all are drawn.

    Raises
    ------
    ValueError if there is no such event.

    Examples
    --------
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml", set={"output.every": 0.2})
    >>> figure = slipfront.plots.fronts(slipfront.fronts(pulse))
    >>> figure.axes[1].get_ylabel()
    'front velocity V, c'
    """
    rows = chosen_events(data, event)
    loaded = bool(numpy.isfinite(data["event_load"].values).any()) and event is None
    figure = Picture(figsize=(10.5 if loaded else 7.4, 3.6))
    panels = figure.subplots(1, 3 if loaded else 2)
    paths(panels[0], data, rows, colours_of(data))
    velocities(panels[1], data, rows)
    if loaded:
        lengths(panels[2], data, rows)
    text = title_of(data)
    figure.suptitle(f"{text}: event {event}".lstrip(": ") if event is not None else text)
    return figure
