"""Parts of the pictures of a pulse: title, range of x, lines of fronts."""

import numpy
import matplotlib
from matplotlib.patheffects import withStroke

from .loaded_parts import is_loaded
from .style import plain, rest_of

#: The fronts of a file, each with its line style, name and symbol.
FRONTS = {
    "trailing_front": ("-", "trailing edge, fast (V−)", "V−"),
    "leading_front": ("--", "leading edge, slow (V+)", "V+"),
    "trailing_front_observed": (":", "as an observer with a threshold sees them", None),
    "leading_front_observed": (":", None, None),
}

#: Fields that are zero at rest.
MOTIONS = ("W", "U", "slip")

#: A value that is more than this many times larger than any other is taken for a bad cell and
#: ignored in the limits of axes.
OUTLIER = 4


def title_of(dataset, most: int = 76) -> str:
    """Returns the title of a Dataset in at most `most` characters, with the settings that fit."""
    text = plain(" ".join(str(dataset.attrs.get("title", "")).split()))
    if len(text) <= most:
        return text
    head, with_settings, rest = text.partition(" (with ")
    settings = rest.split(", ")
    while settings and with_settings:
        settings.pop()
        shorter = f"{head} (with {', '.join([*settings, '…'])})" if settings else head
        if len(shorter) <= most:
            return shorter
    return text[:most - 1].rstrip() + "…"


def finite(dataset):
    """Returns the Dataset with NaN for each infinite value, because no axis can show it."""
    return dataset.map(lambda values: values.where(abs(values) < numpy.inf)
                       if values.dtype.kind == "f" else values, keep_attrs=True)


def fronts_of(dataset) -> list:
    """Returns (variable, line style, name, symbol) of each front that exists at some time."""
    return [(dataset[front], *look) for front, look in FRONTS.items()
            if front in dataset and bool(dataset[front].notnull().any())]


def is_constant(lowest, highest) -> bool:
    """Whether values in this range differ only by rounding."""
    return highest - lowest <= 1e-9 * max(abs(lowest), abs(highest))


def extent(values) -> tuple[float, float]:
    """Returns the smallest and largest finite value, without one outlier, or (0, 0)."""
    values = values[numpy.isfinite(values)]
    magnitudes = numpy.sort(numpy.abs(values))
    if magnitudes.size > 1 and magnitudes[-1] > OUTLIER * magnitudes[-2] > 0:
        values = values[numpy.abs(values) < magnitudes[-1]]
    return (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)


def say_rest(axes, field) -> None:
    """Writes in the panel of a field that is zero within rounding that it is at rest."""
    lowest, highest = extent(field.values)
    if max(-lowest, highest) < rest_of(field):
        text = "at rest" if field.name in MOTIONS else "zero"
        axes.text(0.5, 0.6, text, transform=axes.transAxes, ha="center", va="center", color="0.3")


def backward(dataset, name) -> str:
    """Returns a remark on slip below -2 % of its maximum, more than ripples of a chain, or ""."""
    lowest, highest = extent(dataset[name].values)
    is_backward = name in ("slip", "W") and lowest < min(-0.02 * highest, -rest_of(dataset[name]))
    return "below 0: slips backward, where stress rises with x" if is_backward else ""


def window(dataset) -> tuple:
    """Returns the range of x that fronts cross and a fifth more, or the domain with springs."""
    ends = dataset["x_bounds"].values if "x_bounds" in dataset else dataset["x"].values
    reached = [float(extreme) for front, *_ in fronts_of(dataset)
               for extreme in (front.min(), front.max())]
    left, right = float(ends.min()), float(ends.max())
    if is_loaded(dataset) or not reached or max(reached) <= min(reached):
        return left, right
    margin = (max(reached) - min(reached)) / 5
    return max(left, min(reached) - margin), min(right, max(reached) + margin)


def shades(count: int) -> list:
    """Returns the colours of a sequence, from light to dark, also in grey."""
    return [matplotlib.colormaps["viridis_r"](share) for share in numpy.linspace(0.1, 1, count)]


def mark_fronts(axes, pulse) -> None:
    """Marks the positions of the fronts at the last time, at the bottom of a panel."""
    for front, _, _, symbol in fronts_of(pulse):
        if symbol and numpy.isfinite(front[-1]):
            side = 1 if symbol == "V+" else -1
            axes.annotate(symbol, (float(front[-1]), 0), xytext=(15 * side, 12),
                          textcoords="offset points", ha="center", color="C0", fontweight="bold",
                          arrowprops={"arrowstyle": "->", "color": "C0"}, annotation_clip=True,
                          path_effects=[withStroke(linewidth=2.5, foreground="white")])
