"""Draws corner plots of samples: a histogram of every quantity, and one of every pair."""

import numpy
import xarray
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from .style import Picture, label, plain, styled, unit

#: Quantities that describe the state of the fault, in the order of the plot.
STATES = ("stress", "contact_ratio", "stress_pa", "damping_number", "friction_coefficient")


def levels_of(counts, shares=(0.9, 0.5)) -> list:
    """Returns rising levels of a histogram at or above which the bins hold `shares` of all."""
    ordered = numpy.sort(counts.ravel())[::-1]
    held = numpy.cumsum(ordered) / ordered.sum()
    return sorted({float(ordered[min(numpy.searchsorted(held, share), ordered.size - 1)])
                   for share in shares})


def scale_of(values) -> str:
    """Returns "log" if the values are positive and span a factor of more than 30."""
    return "log" if values.min() > 0 and values.max() > 30 * values.min() else "linear"


def bins_of(values, count):
    """Returns the edges of a quantity's bins. The bins are equally wide on its axis."""
    ends = values.min(), values.max()
    if scale_of(values) == "log":
        return numpy.geomspace(*ends, count + 1)
    return numpy.linspace(*ends, count + 1)


def drawn(dataset):
    """Returns as samples the draws of an event, from a file that `slipfront event --draws` wrote or
    from its group "posterior" or "prior".

    The samples have those quantities of STATES that vary. Raises ValueError unless the file holds
    draws of exactly one event.
    """
    start = "draw_" if "draw_rupture_velocity" in dataset else ""
    dataset = dataset.transpose("event", ...)
    with_draws = [i for i in range(dataset.sizes["event"])
                  if bool(dataset[f"{start}rupture_velocity"][i].notnull().any())]
    if len(with_draws) != 1:
        raise ValueError(f"draws of {len(with_draws)} events: a corner plot shows one; allowed: a "
                         "file of one event, or .isel(event=[row])")
    chosen = {name: dataset[f"{start}{name}"][with_draws[0]].rename(name)
              for name in STATES if f"{start}{name}" in dataset}
    varied = {name: values for name, values in chosen.items() if bool(values.notnull().all())
              and float(values.max()) > float(values.min()) * (1 + 1e-9)}
    return xarray.Dataset({name: values.assign_attrs(long_name="")
                           for name, values in varied.items()})


def in_megapascal(variable):
    """Converts a stress from Pa to MPa. Returns any other quantity unchanged."""
    return ((variable / 1e6).assign_attrs(units="MPa").rename(variable.name)
            if unit(variable) == "Pa" else variable)


def smoothed(counts):
    """Returns counts averaged with their neighbours (1, 2, 1) for smooth contour lines."""
    for axis in (0, 1):
        padded = numpy.pad(counts, [(1, 1) if a == axis else (0, 0) for a in (0, 1)], mode="edge")
        n = counts.shape[axis]
        counts = sum(weight * numpy.take(padded, range(start, start + n), axis)
                     for start, weight in ((0, 0.25), (1, 0.5), (2, 0.25)))
    return counts


def alone(axes, values, edges, name) -> None:
    """Draws the histogram of one quantity, with its median, 5 % and 95 %."""
    axes.hist(values, edges, color="C0", alpha=0.6)
    low, middle, high = numpy.percentile(values, (5, 50, 95))
    for value, line in ((low, ":"), (middle, "-"), (high, ":")):
        axes.axvline(value, color="black", linestyle=line, linewidth=0.9)
    axes.set_yticks([])
    axes.set_title(f"{name}\n{middle:.3g}  [{low:.3g}, {high:.3g}]", fontsize="small")


def pair(axes, across, up) -> None:
    """Draws the density of a pair of quantities and the contours that enclose 50 % and 90 % of the
    samples.

    across, up: (values, edges of the bins) of the quantity on the horizontal and on the vertical
    axis.
    """
    counts, *edges = numpy.histogram2d(across[0], up[0], (across[1], up[1]))
    axes.pcolormesh(*edges, counts.T, cmap="Blues", rasterized=True)
    counts = smoothed(counts)
    axes.contour(*((e[1:] + e[:-1]) / 2 for e in edges), counts.T, levels_of(counts),
                 colors="black", linewidths=0.8)
    axes.set(yscale=scale_of(up[0]), ylim=(up[1][0], up[1][-1]))


def ticks(axis, scale) -> None:
    """Reduces the number of labels on an axis, so that they do not overlap."""
    if scale == "linear":
        axis.set_major_locator(MaxNLocator(4))
    else:
        axis.set_major_locator(LogLocator(numticks=5))
        axis.set_minor_formatter(NullFormatter())


@styled
def corner(samples, names=None, bins: int = 30) -> Picture:
    """Draws a corner plot of samples.

    The histogram of each quantity shows its median and the interval from 5 % to 95 %. That of each
    pair of quantities shows the regions that hold 50 % and 90 % of the samples.

    Parameters
    ----------
    samples : xarray.Dataset
        Variables that have their dimensions in common, with 20 samples or more; or the draws of one
        event, which `slipfront event --draws` wrote, or their group "posterior" or "prior" as
        `slipfront.open` reads it. Samples in which one of the variables is not finite are left out.
    names : sequence of str, optional
        The variables to draw, in this order. By default all that are numbers.
    bins : int, optional
        Number of bins of each histogram.

    Raises
    ------
    ValueError if there are fewer than 20 finite samples, or if a quantity has the same value in all
    of them.

    Examples
    --------
    >>> import xarray
    >>> random = np.random.default_rng(1)
    >>> samples = xarray.Dataset({name: ("sample", random.normal(size=500)) for name in "ab"})
    >>> figure = slipfront.plots.corner(samples)
    >>> len(figure.axes) >= 3
    True
    """
    name = next((name for name in ("name", "event_name")
                 if "draw" in samples.dims and name in samples.variables), None)
    title = (f"{plain(samples[name].values.ravel()[0])}, "
             f"{'posterior' if name == 'name' else 'draws'}: " if name else "")
    samples = drawn(samples) if "draw" in samples.dims else samples
    names = list(names or (name for name in samples.data_vars if samples[name].dtype.kind in "fiu"))
    variables = [in_megapascal(samples[name]) for name in names]
    table = numpy.array([variable.values.astype(float).ravel() for variable in variables])
    table = table[:, numpy.isfinite(table).all(axis=0)] if names else table
    if table.size == 0 or table.shape[1] < 20:
        raise ValueError(f"samples = {table.shape[-1]}: too few for a corner plot; allowed: 20 or "
                         "more that are finite")
    for name, values in zip(names, table):
        if values.min() == values.max():
            raise ValueError(f"{name} = {values[0]:g} in every sample; allowed: quantities that "
                             "vary")
    labels = [label(variable) for variable in variables]
    figure = Picture(figsize=(1.4 + 2.0 * len(names), 1.2 + 1.9 * len(names)))
    fill(figure.subplots(len(names), len(names), squeeze=False), table, labels, bins)
    figure.suptitle(title + "median [5 %, 95 %], lines at 50 and 90 %",
                    fontsize="small" if len(names) < 3 else "medium")
    return figure


def fill(panels, table, labels, bins) -> None:
    """Draws all panels. table: quantities x samples. labels: name and unit of each quantity."""
    edges = [bins_of(values, bins) for values in table]
    for (row, column), axes in numpy.ndenumerate(panels):
        if column > row:
            axes.set_axis_off()
            continue
        axes.grid(False)
        if row == column:
            alone(axes, table[row], edges[row], labels[row])
        else:
            pair(axes, (table[column], edges[column]), (table[row], edges[row]))
            ticks(axes.yaxis, scale_of(table[row]))
        axes.set(xscale=scale_of(table[column]), xlim=(edges[column][0], edges[column][-1]))
        ticks(axes.xaxis, scale_of(table[column]))
        if row == len(table) - 1:
            axes.set_xlabel(labels[column])
            axes.tick_params(axis="x", rotation=30)
        else:
            axes.tick_params(axis="x", which="both", labelbottom=False)
        if column == 0 and row > 0:
            axes.set_ylabel(labels[row])
        elif column > 0 and row != column:
            axes.tick_params(axis="y", which="both", labelleft=False)
