"""What the pictures of a pulse share: its title, the stretch to show, the lines of its fronts."""

import numpy
import matplotlib

from .style import plain

#: The fronts of a file, with the lines and names that they get.
FRONTS = {
    "trailing_front": ("-", "trailing edge"),
    "leading_front": ("--", "leading edge"),
    "trailing_front_observed": (":", "the same, as observed"),
    "leading_front_observed": (":", None),
}


def title_of(dataset) -> str:
    """Title of the scenario that a Dataset holds, and which closure, where the scenario says so."""
    return plain(dataset.attrs.get("title", ""))


def finite(dataset):
    """The Dataset with NaN for what is infinite: no axis reaches so far."""
    return dataset.map(lambda values: values.where(abs(values) < numpy.inf) if values.dtype.kind == "f" else values, keep_attrs=True)


def fronts_of(dataset) -> list:
    """(variable, line, name) of the fronts that are there at some time."""
    return [(dataset[front], line, name) for front, (line, name) in FRONTS.items() if front in dataset and bool(dataset[front].notnull().any())]


def window(dataset) -> tuple:
    """The stretch of x to show: what the fronts cross and a fifth more on either side, within the domain."""
    ends = dataset["x_bounds"].values if "x_bounds" in dataset else dataset["x"].values
    reached = [float(extreme) for front, _, _ in fronts_of(dataset) for extreme in (front.min(), front.max())]
    left, right = float(ends.min()), float(ends.max())
    if not reached or max(reached) <= min(reached):
        return left, right
    margin = (max(reached) - min(reached)) / 5
    return max(left, min(reached) - margin), min(right, max(reached) + margin)


def shades(count: int) -> list:
    """Colours of a sequence (times, scales) from light to dark; told apart in grey too."""
    return [matplotlib.colormaps["viridis_r"](share) for share in numpy.linspace(0.1, 1, count)]
