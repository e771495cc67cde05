"""Draws a finite-fault model: slip, rupture time, rise time and static stress drop."""

import numpy
from matplotlib.ticker import MaxNLocator

from .pulse_parts import title_of
from .space_time import colours
from .style import Picture, label, prefix_axes, styled

#: The fields of the panels, and the names on their colour bars.
FIELDS = {"slip": "slip", "rupture_time": "rupture time", "rise_time": "rise time",
          "stress_drop": "static stress drop"}

#: Largest number of lines of equal rupture time.
CONTOURS = 8


def subfault_edges(grid) -> tuple:
    """Returns the edges of the subfaults of a segment in m: along strike, and down dip."""
    return tuple(numpy.arange(grid.sizes[dimension] + 1) * float(grid[size]) for dimension,
                 size in (("along_strike", "cell_length"), ("down_dip", "cell_width")))


def draw_segment(axes, grid, name, begin, scale) -> tuple:
    """Draws a field of one segment, from the position `begin` on. Returns the map and the end."""
    along, down = subfault_edges(grid)
    values = numpy.ma.masked_invalid(grid[name].transpose("down_dip", "along_strike").values)
    image = axes.pcolormesh(begin + along, down, values, rasterized=True, **scale)
    arrived = grid["rupture_time"].transpose("down_dip", "along_strike").values
    if name == "slip" and min(arrived.shape) > 1 and numpy.nanmax(arrived) > numpy.nanmin(arrived):
        axes.contour(begin + (along[1:] + along[:-1]) / 2, (down[1:] + down[:-1]) / 2, arrived,
                     levels=CONTOURS, colors="0.4", linewidths=0.6)
    return image, begin + along[-1]


@styled
def fault(grid) -> Picture:
    """Draws slip, rupture time, rise time and static stress drop of a finite-fault model.

    The segments are side by side, in the order of the file. Lines on the slip have equal rupture
    times.

    Parameters
    ----------
    grid : xarray.Dataset
        Content of a file of `slipfront event FILE.fsp --fault-grid -o OUT.nc`.

    Examples
    --------
    >>> import numpy, xarray
    >>> dimensions = ("segment", "down_dip", "along_strike")
    >>> values = numpy.ones((1, 4, 6)) * numpy.arange(6)
    >>> sizes = {name: ("segment", [1000.0]) for name in ("cell_length", "cell_width")}
    >>> fields = {name: (dimensions, values, {"units": "m"}) for name in ("slip", "rupture_time")}
    >>> grid = xarray.Dataset({**sizes, **fields})
    >>> slipfront.plots.fault(grid).axes[0].get_xlabel()
    'position along strike, km'
    """
    names = [name for name in FIELDS if name in grid]
    figure = Picture(figsize=(8, 0.8 + 2.4 * ((len(names) + 1) // 2)))
    panels = figure.subplots((len(names) + 1) // 2, 2, sharex=True, sharey=True, squeeze=False)
    for axes in panels.flat[len(names):]:
        axes.set_axis_off()
    for axes, name in zip(panels.flat, names):
        scale, begin = colours(grid[name].values), 0.0
        for i in range(grid.sizes["segment"]):
            segment = grid.isel(segment=i)
            image, end = draw_segment(axes, segment, name, begin, scale)
            begin = end + float(segment["cell_length"]) / 2  # a gap between segments
        figure.colorbar(image, ax=axes, location="top", label=label(grid[name], FIELDS[name]),
                        aspect=30, ticks=MaxNLocator(5))
        axes.set_aspect("equal")
        axes.set_facecolor("0.9")
        axes.grid(False)
        axes.set(xlabel="position along strike, m", ylabel="position down dip, m")
        axes.label_outer()
    panels[0, 0].invert_yaxis()
    prefix_axes(figure)
    figure.suptitle(title_of(grid))
    return figure
