"""Draws ruptures on a plane as moving pictures: slip velocity, lines, moment rate."""

import textwrap

import numpy
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .pulse_parts import title_of
from .style import is_si, label, prefix_axes, prefixed, styled, unit


def fastest(ruptures) -> float:
    """Returns the end of the colours: one cell in a thousand is faster, where lines meet."""
    return max(float(numpy.nanquantile(numpy.abs(rupture["slip_velocity"]), 0.999))
               for rupture in ruptures) or 1.0


class Map:
    """One rupture of a scene: the map of its slip velocity, and its moment rate."""

    def __init__(self, axes, curve, rupture, colour, most):
        self.rupture = rupture
        self.image = axes.pcolormesh(rupture["x"], rupture["y"], abs(rupture["slip_velocity"][0]),
                                     shading="nearest", rasterized=True, cmap="magma", vmin=0,
                                     vmax=most)
        self.lines = axes.plot([], [], color="white",
                               linewidth=0.5)[0] if "line_x" in rupture else None
        axes.set(xlabel=label(rupture["x"]), aspect="equal")
        axes.set_title(textwrap.fill(title_of(rupture), 40), fontsize="small")
        axes.grid(False)
        self.time, self.rate = rupture["series_time"].values, rupture["moment_rate"].values
        curve.plot(self.time, self.rate, color=colour, linewidth=1)
        self.mark = curve.plot([], [], marker="o", color=colour, linestyle="none")[0]

    def show(self, row) -> None:
        time = float(self.rupture["time"][row])
        self.image.set_array(abs(self.rupture["slip_velocity"][row].values))
        self.mark.set_data([time], [numpy.interp(time, self.time, self.rate)])
        if self.lines:
            now = self.rupture["line_time"] == self.rupture["time"][row]
            self.lines.set_data(self.rupture["line_x"][now], self.rupture["line_y"][now])


class PlaneScene:
    """A figure that shows one rupture on a plane, or several side by side, at one output time after
    another.

    ruptures: a list of Datasets with the same output times.
    """

    scale = None  #: all dislocation lines are shown, if the Datasets have them

    @styled
    def __init__(self, ruptures):
        self.times = ruptures[0]["time"].values
        if any(not xarray.DataArray(self.times).equals(xarray.DataArray(rupture["time"].values))
               for rupture in ruptures):
            raise ValueError("ruptures side by side have different output times; allowed: the same "
                             "[output] and [time] in each")
        self.figure = Figure(figsize=(1 + 3.7 * len(ruptures), 5.8), dpi=100)
        FigureCanvasAgg(self.figure)
        above, below = self.figure.subfigures(2, 1, height_ratios=(3, 1))
        panels, curve = above.subplots(1, len(ruptures), sharey=True,
                                       squeeze=False)[0], below.subplots()
        most = fastest(ruptures)
        self.maps = [Map(axes, curve, rupture, f"C{i}", most)
                     for i, (axes, rupture) in enumerate(zip(panels, ruptures))]
        speed = label(ruptures[0]["slip_velocity"].rename("W")).replace("slip velocity W",
                                                                        "size of the slip velocity")
        above.colorbar(self.maps[0].image, ax=list(panels), label=speed)
        panels[0].set_ylabel(label(ruptures[0]["y"]))
        curve.set(xlabel=label(ruptures[0]["series_time"]),
                  ylabel=label(ruptures[0]["moment_rate"]).replace(", ", ",\n"))
        if is_si(ruptures[0]):
            prefix_axes(self.figure)
        self.unit = prefixed(unit(ruptures[0]["time"]),
                             float(self.times[-1])) if is_si(ruptures[0]) else (1, "b / (c A)")
        self.clock = self.figure.suptitle(" ")
        self.show(0)
        self.figure.canvas.draw()
        # Otherwise the axes would move when the width of the clock changes
        self.figure.set_layout_engine("none")

    @styled
    def show(self, row) -> numpy.ndarray:
        for part in self.maps:
            part.show(row)
        self.clock.set_text(f"t = {float(self.times[row]) / self.unit[0]:.3g} {self.unit[1]}")
        self.figure.canvas.draw()
        return numpy.asarray(self.figure.canvas.buffer_rgba())[..., :3].copy()
