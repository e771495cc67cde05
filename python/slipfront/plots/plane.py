"""Draws ruptures on a fault plane."""

import numpy
from matplotlib.ticker import MaxNLocator

from .pulse_parts import title_of
from .space_time import colours
from .style import Picture, label, styled

#: Variables of the amplitude spectrum of the moment rate.
SPECTRUM = ("frequency", "moment_rate_spectrum")

#: Largest number of lines of equal rupture time.
CONTOURS = 8


def _map(figure, axes, data, values, **options) -> None:
    image = axes.pcolormesh(data["x"], data["y"], numpy.ma.masked_invalid(values),
                            shading="nearest", rasterized=True, **options)
    figure.colorbar(image, ax=axes, location="top", label=label(values), aspect=30,
                    ticks=MaxNLocator(5))
    axes.set(xlabel=label(data["x"]), aspect="equal")
    axes.grid(False)


def draw_spectrum(axes, rupture) -> None:
    frequency, amplitude = (rupture[name] for name in SPECTRUM)
    shown = (frequency.values > 0) & (amplitude.values > 0)
    axes.plot(frequency.values[shown], amplitude.values[shown])
    axes.set(xscale="log", yscale="log", xlabel=label(frequency, "frequency"),
             ylabel=label(amplitude, "moment spectrum"))


@styled
def plane(rupture, time: int = -1) -> Picture:
    """Draws slip velocity and slip at one time, the time at which each point ruptured, the moment
    rate and, if it is known, its spectrum.

    Parameters
    ----------
    rupture : xarray.Dataset
        Content of a file of `slipfront plane`, with the dimensions time, y, x and series_time.
    time : int, optional
        Number of the output time that the maps show. By default they show the last one.

    Examples
    --------
    >>> import numpy, xarray
    >>> x = numpy.linspace(-1, 1, 20)
    >>> r = numpy.hypot(*numpy.meshgrid(x, x))
    >>> fields = {name: (("time", "y", "x"), [r * 0, 1 - r]) for name in ("slip", "slip_velocity")}
    >>> rate = {"moment_rate": ("series_time", [0.0, 1.0])}
    >>> axes = {"time": [0, 1], "x": x, "y": x, "series_time": [0, 1]}
    >>> rupture = xarray.Dataset({**fields, **rate, "rupture_time": (("y", "x"), r)}, axes)
    >>> len(slipfront.plots.plane(rupture).axes)
    7
    """
    figure = Picture(figsize=(8, 5.8))
    maps, curves = figure.subfigures(2, 1, height_ratios=(1.1, 1))
    panels = maps.subplots(1, 3, sharex=True, sharey=True)
    for axes, name, symbol in zip(panels, ("slip_velocity", "slip"), ("W", "slip")):
        values = rupture[name].isel(time=time).rename(symbol)
        _map(maps, axes, rupture, values, **colours(values.values))
    _map(maps, panels[2], rupture, rupture["rupture_time"], cmap="viridis_r")
    arrived = rupture["rupture_time"].values
    if numpy.isfinite(arrived).any() and numpy.nanmax(arrived) > numpy.nanmin(arrived):
        panels[2].contour(rupture["x"], rupture["y"], arrived, levels=CONTOURS, colors="white",
                          linewidths=0.6)
    panels[0].set_ylabel(label(rupture["y"]))
    has_spectrum = set(SPECTRUM) <= set(rupture.variables)
    rate, *spectrum = curves.subplots(1, 1 + has_spectrum, squeeze=False)[0]
    rate.plot(rupture["series_time"], rupture["moment_rate"])
    rate.axvline(float(rupture["time"][time]), color="0.5", linewidth=0.8, linestyle=":")
    rate.set(xlabel=label(rupture["series_time"]),
             ylabel=label(rupture["moment_rate"], "moment rate"))
    for axes in spectrum:
        draw_spectrum(axes, rupture)
    figure.suptitle(title_of(rupture))
    return figure
