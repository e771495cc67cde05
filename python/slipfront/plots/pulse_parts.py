"""What the pictures of a pulse share: its title, the stretch to show, the lines of its fronts."""

import numpy
import matplotlib
from matplotlib.patheffects import withStroke

from .style import plain

#: The fronts of a file, with the lines, names and symbols that they get.
FRONTS = {
    "trailing_front": ("-", "trailing edge, fast (V−)", "V−"),
    "leading_front": ("--", "leading edge, slow (V+)", "V+"),
    "trailing_front_observed": (":", "as an observer with a threshold sees them", None),
    "leading_front_observed": (":", None, None),
}

#: A value this many times larger than any other is taken for a bad cell, which sets no scale.
OUTLIER = 4


def title_of(dataset) -> str:
    """Title of the scenario that a Dataset holds, and which closure, where the scenario says so."""
    return plain(dataset.attrs.get("title", ""))


def finite(dataset):
    """The Dataset with NaN for what is infinite: no axis reaches so far."""
    return dataset.map(lambda values: values.where(abs(values) < numpy.inf) if values.dtype.kind == "f" else values, keep_attrs=True)


def fronts_of(dataset) -> list:
    """(variable, line, name, symbol) of the fronts that are there at some time."""
    return [(dataset[front], *look) for front, look in FRONTS.items() if front in dataset and bool(dataset[front].notnull().any())]


def extent(values) -> tuple[float, float]:
    """The least and the largest finite value, without a single bad cell: one that is OUTLIER times larger than every other. (0, 0) of none."""
    values = values[numpy.isfinite(values)]
    magnitudes = numpy.sort(numpy.abs(values))
    if magnitudes.size > 1 and magnitudes[-1] > OUTLIER * magnitudes[-2] > 0:
        values = values[numpy.abs(values) < magnitudes[-1]]
    return (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)


def backward(dataset, name) -> str:
    """What a picture says of a slip or slip velocity that goes below zero by more than the ripples of a chain; else empty."""
    lowest, highest = extent(dataset[name].values)
    return "below 0: slips backward, where stress rises with x" if name in ("slip", "W") and lowest < -0.02 * highest else ""


def window(dataset) -> tuple:
    """The stretch of x to show: what the fronts cross and a fifth more on either side, within the domain."""
    ends = dataset["x_bounds"].values if "x_bounds" in dataset else dataset["x"].values
    reached = [float(extreme) for front, *_ in fronts_of(dataset) for extreme in (front.min(), front.max())]
    left, right = float(ends.min()), float(ends.max())
    if not reached or max(reached) <= min(reached):
        return left, right
    margin = (max(reached) - min(reached)) / 5
    return max(left, min(reached) - margin), min(right, max(reached) + margin)


def shades(count: int) -> list:
    """Colours of a sequence (times, scales) from light to dark; told apart in grey too."""
    return [matplotlib.colormaps["viridis_r"](share) for share in numpy.linspace(0.1, 1, count)]


def mark_fronts(axes, pulse) -> None:
    """Marks where the fronts are at the last time, at the foot of a panel."""
    for front, _, _, symbol in fronts_of(pulse):
        if symbol and numpy.isfinite(front[-1]):
            side = 1 if symbol == "V+" else -1
            axes.annotate(symbol, (float(front[-1]), 0), xytext=(15 * side, 12), textcoords="offset points", ha="center", color="C0", fontweight="bold",
                          arrowprops={"arrowstyle": "->", "color": "C0"}, annotation_clip=True, path_effects=[withStroke(linewidth=2.5, foreground="white")])
