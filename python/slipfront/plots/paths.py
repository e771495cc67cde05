"""Draws the paths of dislocations."""

import numpy

from .pulse_parts import title_of, window
from .style import Picture, label, styled

#: The largest number of paths in a picture. Of more, every second one is drawn, or every third, and
#: so on.
MOST_PATHS = 150

#: For each sign of a dislocation its colour and name.
SIGNS = {1: ("C0", "dislocations, u falls with x"), -1: ("C1", "antidislocations")}


def line_of(position, time) -> tuple:
    """Returns the paths as one line with gaps, and the paths that are a single point."""
    known = numpy.isfinite(position).T
    points = [numpy.column_stack((path[seen], time[seen])) for path, seen in zip(position.T, known)]
    gap = numpy.full((1, 2), numpy.nan)
    line = numpy.concatenate([part for path in points for part in (path, gap)])
    single = numpy.concatenate([path for path in points if len(path) == 1] or [gap])
    return (*line.T, *single.T)


@styled
def paths(chain) -> Picture:
    """Draws the path of each dislocation, time (vertical) over position (horizontal), with the
    colour of its sign.

    A picture has at most 150 paths. If there are more in its window, it has every second one, or
    every third, and so on.

    Parameters
    ----------
    chain : xarray.Dataset
        Result of `slipfront.chain` with output.dislocations = true and two or more output times.

    Examples
    --------
    >>> chain = slipfront.chain(slipfront.cases / "step.toml", set={
    ...     "chain.scale": 100, "output.every": 0.5, "output.dislocations": True})
    >>> figure = slipfront.plots.paths(chain)
    >>> figure.axes[0].get_xlabel()
    'position x, b/A'
    """
    left, right = window(chain)
    position = chain["dislocation_position"].transpose("time", "dislocation")
    inside = ((position >= left) & (position <= right)).any("time")
    chosen = numpy.flatnonzero(inside.values)
    every = max(1, -(-chosen.size // MOST_PATHS))
    position, sign = (chain[name].isel(dislocation=chosen[::every])
                      for name in (position.name, "dislocation_sign"))
    position = position.transpose("time", "dislocation")
    time = chain["time"].values
    figure = Picture(figsize=(5.2, 4.6))
    axes = figure.subplots()
    for value, (colour, name) in SIGNS.items():
        if not (sign == value).any():
            continue
        x, t, single_x, single_t = line_of(position.values[:, sign.values == value], time)
        axes.plot(x, t, color=colour, linewidth=0.6, label=name)
        axes.plot(single_x, single_t, color=colour, linestyle="none", marker=".", markersize=1.5)
    axes.set(xlabel=label(chain["x"]), ylabel=label(chain["time"]), xlim=(left, right),
             ylim=(float(time[0]), float(time[-1])))
    axes.grid(False)
    if (sign == -1).any():
        figure.legend(loc="lower center", ncol=2)
        figure.get_layout_engine().set(rect=(0, 0.07, 1, 0.93))
    drawn = "" if every == 1 else f"one of {every} dislocations"
    figure.suptitle("; ".join(filter(None, (title_of(chain, 60 if drawn else 66), drawn))))
    return figure
