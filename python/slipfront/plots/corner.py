"""Corner plots of samples: every quantity alone, and every pair."""

import numpy
from matplotlib.figure import Figure

from .style import label, styled


def levels_of(counts, shares=(0.9, 0.5)) -> list:
    """Counts of a histogram above which lie these shares of all samples (largest share first), strictly increasing."""
    ordered = numpy.sort(counts.ravel())[::-1]
    held = numpy.cumsum(ordered) / ordered.sum()
    return sorted({float(ordered[min(numpy.searchsorted(held, share), ordered.size - 1)]) for share in shares})


def scale_of(values) -> str:
    """Axis of a quantity: logarithmic where it is positive and spreads over a factor of 30 or more."""
    return "log" if values.min() > 0 and values.max() > 30 * values.min() else "linear"


def bins_of(values, count):
    """Edges of the bins of a quantity, even on its axis."""
    spread = numpy.geomspace if scale_of(values) == "log" else numpy.linspace
    return spread(values.min(), values.max(), count + 1)


@styled
def corner(samples, names=None, bins: int = 30) -> Figure:
    """Histograms of each quantity with median and the interval from 5 % to 95 %, and of each pair with the regions that hold 50 % and 90 %.

    Parameters
    ----------
    samples : xarray.Dataset
        Variables over one common dimension (more are taken as one), 20 samples or more. Those not finite in all variables chosen are left out.
    names : sequence of str, optional
        Which variables, in which order; default all that are numbers.
    bins : int
        Of each histogram.

    Raises
    ------
    ValueError where too few samples are left or a quantity has but one value.
    """
    names = list(names or (name for name in samples.data_vars if samples[name].dtype.kind in "fiu"))
    table = numpy.array([samples[name].values.astype(float).ravel() for name in names])
    table = table[:, numpy.isfinite(table).all(axis=0)] if names else table
    if table.size == 0 or table.shape[1] < 20:
        raise ValueError(f"samples = {table.shape[-1]}: too few for a corner plot; allowed: 20 or more that are finite")
    for name, values in zip(names, table):
        if values.min() == values.max():
            raise ValueError(f"{name} = {values[0]:g} in every sample; allowed: quantities that vary")
    n = len(names)
    edges = [bins_of(values, bins) for values in table]
    figure = Figure(figsize=(1.2 + 1.9 * n, 1.0 + 1.8 * n))
    panels = figure.subplots(n, n, squeeze=False)
    for row in range(n):
        for column in range(n):
            axes = panels[row, column]
            if column > row:
                axes.set_axis_off()
                continue
            axes.grid(False)
            if row == column:
                axes.hist(table[row], edges[row], color="C0", alpha=0.6)
                low, middle, high = numpy.percentile(table[row], (5, 50, 95))
                for value, line in ((low, ":"), (middle, "-"), (high, ":")):
                    axes.axvline(value, color="black", linestyle=line, linewidth=0.9)
                axes.set_yticks([])
                axes.set_title(f"{middle:.3g}  [{low:.3g}, {high:.3g}]", fontsize="small")
            else:
                counts, across, up = numpy.histogram2d(table[column], table[row], (edges[column], edges[row]))
                axes.pcolormesh(across, up, counts.T, cmap="Blues", rasterized=True)
                axes.contour(*((e[1:] + e[:-1]) / 2 for e in (across, up)), counts.T, levels_of(counts), colors="black", linewidths=0.8)
                axes.set(yscale=scale_of(table[row]), ylim=(up[0], up[-1]))
            axes.set(xscale=scale_of(table[column]), xlim=(edges[column][0], edges[column][-1]))
            if row == n - 1:
                axes.set_xlabel(label(samples[names[column]]))
                axes.tick_params(axis="x", rotation=30)
            else:
                axes.tick_params(axis="x", which="both", labelbottom=False)
            if column == 0 and row > 0:
                axes.set_ylabel(label(samples[names[row]]))
            elif column > 0 and row != column:
                axes.tick_params(axis="y", which="both", labelleft=False)
    return figure
