"""Interpolates the fields of a pulse between the positions and times of its file."""

import re

import numpy

#: Fronts with which the field moves between two outputs. Both must be known at both outputs.
CARRIERS = ("trailing_front", "leading_front")


def speed_of(pulse) -> float:
    """Returns the speed c in the units of a pulse: 1 in those of the model, and else m/s."""
    found = re.search(r"\bc = (\S+) m/s", str(pulse.attrs.get("medium", "")))
    return float(found[1]) if found else 1.0


def anchors(pulse, row) -> numpy.ndarray:
    """Returns the positions that the interpolation follows from output `row` to the next: the ends
    of the domain and the fronts.

    The fronts are left out unless they are known and no faster than strain waves, because an
    observed front may jump. The result is an array of 2 (this output, the next) x number of
    positions, ascending in x (b / A).
    """
    bounds = pulse["x_bounds"].values
    ends = numpy.array([[bounds.min()] * 2, [bounds.max()] * 2])
    if not all(name in pulse for name in CARRIERS):
        return ends.T
    fronts = numpy.array([pulse[name].values[row : row + 2] for name in CARRIERS])
    steady = numpy.all(numpy.abs(fronts[:, 1] - fronts[:, 0]) <= speed_of(pulse)
                       * numpy.diff(pulse["time"].values[row : row + 2]))
    places = numpy.vstack((ends[:1], fronts, ends[1:])).T
    # Both are false for NaN
    return places if steady and numpy.all(numpy.diff(places, axis=1) >= 0) else ends.T


def between(pulse, name: str, times, places) -> numpy.ndarray:
    """Returns the values of a field at given times and positions within the range of the file, as
    an array over time and position.

    Between two outputs the field moves with the fronts and changes linearly in time. A front is
    therefore a line in the picture and not a staircase. A cell that is not finite makes a gap as
    wide as the cell and as long as the interval between two outputs.

    pulse: Dataset over time and x with x_bounds. times (b / (c A)) and `places` (positions x, b /
    A): ascending.
    """
    field = pulse[name].transpose("time", "x").values
    x, outputs = pulse["x"].values, pulse["time"].values
    values = numpy.empty((len(times), len(places)))
    rows = numpy.clip(numpy.searchsorted(outputs, times, side="right") - 1, 0, len(outputs) - 2)
    for i, (time, row) in enumerate(zip(times, rows)):
        share = (time - outputs[row]) / (outputs[row + 1] - outputs[row])
        before, after = anchors(pulse, row)
        now = (1 - share) * before + share * after
        first, second = (numpy.interp(numpy.interp(places, now, then), x, field[row + side])
                         for side, then in enumerate((before, after)))
        # Both fronts start at the same x, so there is no earlier field between them
        if len(before) == 4 and before[1] == before[2]:
            first = numpy.where((places > now[1]) & (places < now[2]), second, first)
        mixed = (1 - share) * first + share * second
        values[i] = numpy.where(numpy.isfinite(mixed), mixed, first if share < 0.5 else second)
    return values
