"""A slip pulse as a moving picture: the averaged fields, and the dislocations under them."""

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .dislocations import positions
from .pulse_parts import finite, title_of, window
from .style import label, styled

SHOWN = 40  #: dislocations in the picture at the first time, about


class Scene:
    """A figure whose lines are moved from time to time of a pulse."""

    @styled
    def __init__(self, pulse):
        pulse = self.pulse = finite(pulse)
        self.figure = Figure(figsize=(7.2, 4.2), dpi=100)
        FigureCanvasAgg(self.figure)
        self.panels = self.figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": (3, 3, 1)})
        left, right = window(pulse)
        seen = pulse.isel(time=0)["k"].where((pulse["x"] > left) & (pulse["x"] < right))
        count = float((seen * (pulse["x_bounds"][:, 1] - pulse["x_bounds"][:, 0])).sum()) / (2 * numpy.pi)
        self.scale = SHOWN / count if count > 0 else 1.0
        self.places = positions(pulse, self.scale)
        for axes, name in zip(self.panels, ("W", "Sigma")):
            values = pulse[name].values[numpy.isfinite(pulse[name].values)]
            low, high = min(0.0, values.min(initial=0.0)), values.max(initial=0.0)
            axes.set(ylabel=label(pulse[name]).replace(", ", ",\n"), ylim=(low, 1.08 * high if high > 0 else 1))
        self.panels[1].plot(pulse["x"], pulse["Sigma"][0], color="0.7", linestyle="-", linewidth=1)
        self.lines = [axes.plot(pulse["x"], pulse[name][0], color=colour, linestyle="-")[0]
                      for axes, name, colour in zip(self.panels, ("W", "Sigma"), ("C1", "C0"))]
        self.marks = self.panels[2].plot([], [], marker="$⊥$", color="black", markersize=6, linestyle="none")[0]
        self.panels[2].set(ylim=(-1, 1), yticks=[], ylabel="dislo-\ncations", xlabel=label(pulse["x"]), xlim=(left, right))
        self.panels[2].grid(False)
        self.clock = self.panels[0].set_title(" ")
        self.show(0)
        self.figure.canvas.draw()
        self.figure.set_layout_engine("none")  # else the axes would move with the clock's width

    @styled
    def show(self, row) -> numpy.ndarray:
        """Draws one time. Returns the picture, height by width by red, green, blue (0 to 255)."""
        now = self.pulse.isel(time=row)
        for line, name in zip(self.lines, ("W", "Sigma")):
            line.set_ydata(now[name])
        self.marks.set_data(self.places[row], numpy.zeros(self.places.shape[1]))
        self.clock.set_text(f"{title_of(self.pulse)}    t = {float(now['time']):.2f} b/(cA)")
        self.figure.canvas.draw()
        return numpy.asarray(self.figure.canvas.buffer_rgba())[..., :3].copy()
