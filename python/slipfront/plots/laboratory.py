"""Draws fronts in the laboratory next to the theory."""

import numpy

from .relations import spans_decades
from .style import Picture, plain_numbers, styled


COLOUR_OF_FRONTS = "#332288"


def bars(data, name, chosen):
    """Returns the distances of chosen fronts to both ends of intervals, for errorbar."""
    middle, (low, high) = data[name].values[chosen], data[f"{name}_interval"].values[chosen].T
    return numpy.maximum(numpy.nan_to_num([middle - low, high - middle]), 0)


def velocities(axes, data) -> None:
    """Draws front velocity against stress ratio: fronts, curve and its intervals."""
    at = data["curve_stress_ratio"].values
    low, median, high = data["curve_front_velocity"].values.T
    further = data["curve_further_front_velocity"].values.T
    axes.fill_between(at, further[0], further[2], color=COLOUR_OF_FRONTS, alpha=0.15, linewidth=0,
                      label="90 % of further fronts")
    axes.fill_between(at, low, high, color=COLOUR_OF_FRONTS, alpha=0.4, linewidth=0,
                      label="90 % of the curve")
    axes.plot(at, median, color=COLOUR_OF_FRONTS, linestyle="-", marker="", label="theory, median")
    included = data["included"].values == 1
    for chosen, colour, label in ((included, "k", "fronts"), (~included, "0.6", "left out")):
        if chosen.any():
            axes.errorbar(
                data["stress_ratio"].values[chosen], data["front_velocity"].values[chosen],
                xerr=bars(data, "stress_ratio", chosen), yerr=bars(data, "front_velocity", chosen),
                fmt="o", color=colour, markersize=4, elinewidth=0.9, linestyle="none", label=label)
    measured = data["front_velocity"].values
    axes.axhline(1, color="0.5", linewidth=0.8, linestyle=":")
    wide = spans_decades(data["stress_ratio"].values)
    axes.set(xscale="log" if wide else "linear", yscale="log",
             xlabel="shear stress over normal stress τ / σ$_N$", ylabel="front velocity V / c",
             ylim=(measured.min() / 4, 2 * max(1, measured.max())))
    for axis in (axes.xaxis, axes.yaxis)[not wide:]:
        plain_numbers(axis)
    axes.legend(loc="lower right")


def hardness(axes, data) -> None:
    """Draws the posterior of the hardness over modulus, and above it the value of each front."""
    draws = data["draw_hardness_over_modulus"].values
    heights, edges = numpy.histogram(draws, bins=40, density=True)
    axes.stairs(heights / heights.max(), edges, fill=True, color=COLOUR_OF_FRONTS, alpha=0.4)
    axes.axvline(float(data["hardness_over_modulus"]), color=COLOUR_OF_FRONTS, linestyle="-")
    chosen = numpy.flatnonzero(data["included"].values == 1)
    order = chosen[numpy.argsort(data["stress_ratio"].values[chosen])]
    axes.errorbar(data["hardness_over_modulus_of_front"].values[order],
                  1.1 + 0.9 * numpy.arange(order.size) / max(1, order.size - 1),
                  xerr=bars(data, "hardness_over_modulus_of_front", order), fmt="o", color="k",
                  markersize=3, elinewidth=0.8, linestyle="none")
    axes.set(title="posterior, and single fronts (90 %)", xlabel="hardness over modulus σ$_p$ / μ",
             yticks=[], ylim=(0, 2.1))


@styled
def laboratory(data) -> Picture:
    """Front velocity against shear stress over normal stress with the curve of the theory, and the
    posterior of the hardness over modulus.

    The dark band holds the curve with 90 % probability, and the light band holds a further front.
    Fronts that were left out are grey.

    Parameters
    ----------
    data : xarray.Dataset
        Result of `slipfront.laboratory`.

    Examples
    --------
    >>> table = slipfront.cases / "synthetic-laboratory-fronts.csv"
    >>> found = slipfront.laboratory(table, poisson_ratio=0.35, s_wave_speed="1300 m/s")
    >>> figure = slipfront.plots.laboratory(found)
    >>> figure.axes[0].get_ylabel()
    'front velocity V / c'
    """
    figure = Picture(figsize=(8.6, 4.2))
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    velocities(left, data)
    hardness(right, data)
    return figure
