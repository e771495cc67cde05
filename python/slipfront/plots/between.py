"""Fields of a pulse at places and times between those of its file."""

import numpy

#: The fronts that carry the field along; both have to be known at both ends of an interval.
CARRIERS = ("trailing_front", "leading_front")


def anchors(pulse, row) -> numpy.ndarray:
    """Places that move along between output `row` and the next: the domain's ends and the fronts, where these are known and outrun no strain
    wave (a measured front may jump).

    Returns an array of 2 (this output, the next) by places, ascending in x (b / A).
    """
    bounds = pulse["x_bounds"].values
    ends = numpy.array([[bounds.min()] * 2, [bounds.max()] * 2])
    if not all(name in pulse for name in CARRIERS):
        return ends.T
    fronts = numpy.array([pulse[name].values[row : row + 2] for name in CARRIERS])
    steady = numpy.all(numpy.abs(fronts[:, 1] - fronts[:, 0]) <= numpy.diff(pulse["time"].values[row : row + 2]))
    places = numpy.vstack((ends[:1], fronts, ends[1:])).T
    return places if steady and numpy.all(numpy.diff(places, axis=1) >= 0) else ends.T  # both are false for NaN


def between(pulse, name: str, times, places) -> numpy.ndarray:
    """Values of a field at any times and places within those of the file, as an array over time and place.

    Between two outputs the field moves with the fronts and changes evenly in time from the one to the other, so that a front stays a line and
    is no staircase. A cell that is not finite makes a gap as wide as itself and an interval between outputs, no more.

    pulse: Dataset over time and x with x_bounds. times, places: ascending.
    """
    field = pulse[name].transpose("time", "x").values
    x, outputs = pulse["x"].values, pulse["time"].values
    values = numpy.empty((len(times), len(places)))
    rows = numpy.clip(numpy.searchsorted(outputs, times, side="right") - 1, 0, len(outputs) - 2)
    for i, (time, row) in enumerate(zip(times, rows)):
        share = (time - outputs[row]) / (outputs[row + 1] - outputs[row])
        before, after = anchors(pulse, row)
        now = (1 - share) * before + share * after
        first, second = (numpy.interp(numpy.interp(places, now, then), x, field[row + side]) for side, then in enumerate((before, after)))
        if len(before) == 4 and before[1] == before[2]:  # both fronts start in one place: between them there is no earlier field
            first = numpy.where((places > now[1]) & (places < now[2]), second, first)
        mixed = (1 - share) * first + share * second
        values[i] = numpy.where(numpy.isfinite(mixed), mixed, first if share < 0.5 else second)
    return values
