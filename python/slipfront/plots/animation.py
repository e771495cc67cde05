"""Draws slip pulses as moving pictures: averaged fields, fronts and dislocations."""

import numpy
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .pulse_parts import extent, finite, fronts_of, title_of, window
from .style import is_si, label, prefix_axes, prefixed, styled, unit

SHOWN = 30  #: approximate number of dislocations in the picture at the first time
FIELDS = (("W", "C1"), ("Sigma", "C0"))


def metres(value: float) -> str:
    """Returns a length or time up to its unit: '3.3 ' or '610 μ'."""
    for power, prefix in ((0, ""), (-3, "m"), (-6, "μ"), (-9, "n")):
        if abs(value) >= 10.0**power:
            return f"{value / 10.0**power:.3g} {prefix}"
    return f"{value:.3g} "


def positions(pulse, scale: float) -> numpy.ndarray:
    """Returns the position x (b / A) of each dislocation at each time of a pulse.

    pulse: Dataset with k over time and x (cell averages) and with x_bounds. Its left end must be at
    rest, because dislocations are counted from there. scale > 0: factor by which the density of the
    dislocations is multiplied.

    The result is an array over time and dislocation, ascending in x. Dislocation j is at the x that
    has j + 1/2 dislocations on its left. The number of dislocations is that at the first time. A
    dislocation that has left the domain is NaN.
    """
    bounds = pulse["x_bounds"].values
    edges = numpy.append(bounds[:, 0], bounds[-1, 1])
    # A cell that is NaN or negative has no dislocations
    density = numpy.fmax(pulse["k"].transpose("time", "x").values, 0)
    held = numpy.cumsum(density * numpy.diff(edges), axis=1) * scale / (2 * numpy.pi)
    held = numpy.concatenate((numpy.zeros((len(held), 1)), held), axis=1)
    wanted = numpy.arange(0.5, held[0, -1])
    # The count is constant across cells without dislocations: interp takes their last edge.
    return numpy.array([numpy.interp(wanted, row, edges, right=numpy.nan) for row in held])


def scale_of(pulse, left, right) -> float:
    """Returns the factor for the density at which about SHOWN dislocations are shown."""
    seen = pulse.isel(time=0)["k"].where((pulse["x"] > left) & (pulse["x"] < right))
    widths = pulse["x_bounds"][:, 1] - pulse["x_bounds"][:, 0]
    count = float((seen * widths).sum()) / (2 * numpy.pi)
    return SHOWN / count if count > 0 else 1.0


class Column:
    """One pulse of a scene, with three panels: slip velocity W, stress and dislocations."""

    def __init__(self, panels, pulse, scale):
        self.pulse, self.places = pulse, positions(pulse, scale)
        panels[0].set_title(title_of(pulse), fontsize="small")
        panels[1].plot(pulse["x"], pulse["Sigma"][0], color="0.7", linestyle="-", linewidth=1)
        self.lines = [axes.plot(pulse["x"], pulse[name][0], color=colour, linestyle="-")[0]
                      for axes, (name, colour) in zip(panels, FIELDS)]
        self.marks = panels[2].plot([], [], marker="$⊥$", color="black", markersize=5,
                                    linestyle="none")[0]
        self.fronts = []
        for front, line, _, symbol in fronts_of(pulse):
            if symbol:
                lines = [axes.axvline(0, color="0.35", linestyle=line, linewidth=0.8)
                         for axes in panels[:2]]
                text = panels[0].text(0, 0.97, f" {symbol} ",
                                      transform=panels[0].get_xaxis_transform(), va="top",
                                      fontweight="bold", clip_on=True)
                self.fronts.append((front.values, lines, symbol, text))

    def show(self, row) -> None:
        """Moves the lines to one output time. A front that does not exist then is hidden."""
        now = self.pulse.isel(time=row)
        for line, (name, _) in zip(self.lines, FIELDS):
            line.set_ydata(now[name])
        self.marks.set_data(self.places[row], numpy.zeros(self.places.shape[1]))
        for places, lines, symbol, text in self.fronts:
            there = bool(numpy.isfinite(places[row]))
            for artist in (*lines, text):
                artist.set_visible(there)
            if there:
                text.set_x(places[row])
                left, right = text.axes.get_xlim()
                near_end = places[row] >= right - (right - left) / 10
                text.set_horizontalalignment("left" if symbol == "V+" and not near_end else "right")
                for line in lines:
                    line.set_xdata([places[row]] * 2)


class Scene:
    """A figure that shows one pulse, or several side by side, at one output time after another.

    pulses: a Dataset, or a list of Datasets with the same output times. si: SI values of the units
    of length, time, stress and slip_velocity (`slipfront.medium.units`), for a second scale; None
    for no second scale.
    """

    @styled
    def __init__(self, pulses, si=None):
        pulses = [finite(pulse)
                  for pulse in ([pulses] if isinstance(pulses, xarray.Dataset) else pulses)]
        self.times, self.si = pulses[0]["time"].values, si
        if any(pulse.sizes["time"] != self.times.size
               or not numpy.allclose(pulse["time"], self.times) for pulse in pulses):
            raise ValueError("pulses side by side have different output times; allowed: the same "
                             "[output] and [time] in each")
        self.figure = Figure(figsize=(7.2, 4.4 if si is None else 4.8), dpi=100)
        FigureCanvasAgg(self.figure)
        self.panels = self.figure.subplots(3, len(pulses), sharex=True, sharey="row", squeeze=False,
                                           gridspec_kw={"height_ratios": (3, 3, 1)})
        windows = [window(pulse) for pulse in pulses]
        left, right = min(ends[0] for ends in windows), max(ends[1] for ends in windows)
        self.scale = scale_of(pulses[0], left, right)
        self.columns = [Column(self.panels[:, i], pulse, self.scale)
                        for i, pulse in enumerate(pulses)]
        for axes, (name, _) in zip(self.panels, FIELDS):
            ends = [end for pulse in pulses for end in extent(pulse[name].values)]
            axes[0].set(ylabel=label(pulses[0][name]).replace(", ", ",\n"),
                        ylim=(min(0.0, *ends), 1.2 * max(ends) if max(ends) > 0 else 1))
        for axes in self.panels[2]:
            axes.set(ylim=(-1, 1), yticks=[], xlabel=label(pulses[0]["x"]), xlim=(left, right))
            axes.grid(False)
        self.panels[2, 0].set_ylabel("dislo-\ncations")
        if si:
            self.add_si()
        if is_si(pulses[0]):
            prefix_axes(self.figure)
        self.second = prefixed(unit(pulses[0]["time"]),
                               float(self.times[-1])) if is_si(pulses[0]) else None
        self.clock = self.figure.suptitle(" ")
        self.show(0)
        self.figure.canvas.draw()
        # Otherwise the axes would move when the width of the clock changes
        self.figure.set_layout_engine("none")

    def add_si(self) -> None:
        """Adds scales in SI units: slip velocity and stress on the right, position at the top."""
        for axes, factor, text in ((self.panels[0, -1], self.si["slip_velocity"], "m/s"),
                                   (self.panels[1, -1], self.si["stress"] / 1e6, "MPa")):
            axes.secondary_yaxis("right", functions=(lambda y, factor=factor: y * factor, lambda y,
                                                     factor=factor: y / factor)).set_ylabel(text)
        for axes in self.panels[0]:
            above = axes.secondary_xaxis("top", functions=(lambda x: x * self.si["length"],
                                                           lambda x: x / self.si["length"]))
            above.set_xlabel("m", fontsize="small", labelpad=2)
            above.tick_params(labelsize="small")

    @styled
    def show(self, row) -> numpy.ndarray:
        """Draws one output time. Returns the picture as height x width x 3 bytes."""
        time = float(self.times[row])
        for column in self.columns:
            column.show(row)
        if self.second:
            self.clock.set_text(f"t = {time / self.second[0]:.4g} {self.second[1]}")
        else:
            self.clock.set_text(f"t = {time:.2f} b/(cA)"
                                + (f" = {metres(time * self.si['time'])}s" if self.si else ""))
        self.figure.canvas.draw()
        return numpy.asarray(self.figure.canvas.buffer_rgba())[..., :3].copy()
