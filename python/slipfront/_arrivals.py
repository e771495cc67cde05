"""The function slipfront.arrivals: the velocity of a front from its arrival times at gauges."""

import csv
import io
import math

from ._dataset import BOUND, dataset, texts
from ._messages import shown
from ._number_table import Quantity, read_numbers
from ._numbers import np
from ._slipfront import InputError

QUANTITIES = {
    "event": Quantity("", ("name", "front", "event name"), required=False),
    "error of position": Quantity(
        "length", ("position error", "x error", "x err", "dx"), required=False
    ),
    "error of time": Quantity(
        "time",
        ("time error", "t error", "t err", "dt", "arrival error", "error of t"),
        required=False,
    ),
    "position": Quantity("length", ("x", "gauge position", "distance")),
    "time": Quantity("time", ("t", "arrival", "arrival time", "t arrival")),
}

#: The 95 % quantile of the standard normal distribution: an interval holds 90 %.
SIGMAS = 1.6448536269514722


def _velocity(distance, time, distance_error, time_error):
    """Returns a velocity and its 5 and 95 %. The quotient of two normal variables has the bounds of
    Fieller; inf where the time may be 0. If it is 0, there is no velocity but only a lower bound,
    or nothing if the errors are 0, too."""
    if not time and not time_error:
        return math.nan, math.nan, math.nan
    velocity = distance / time if time else math.nan
    z = SIGMAS**2
    a, b, c = (
        time**2 - z * time_error**2,
        distance * time,
        distance**2 - z * distance_error**2,
    )
    root = math.sqrt(max(b * b - a * c, 0.0))
    if a <= 0:  # the time may be 0
        least = c / (b + root) if c > 0 else 0.0  # b > 0: distance and time are positive
        return velocity, least, math.inf
    low, high = sorted((abs((b - root) / a), abs((b + root) / a)))
    return velocity, 0.0 if c <= 0 else low, high


def _line(x, t, x_error, t_error):
    """Returns (position, velocity, low, high) of all gauges of a front: the slope of the time over
    the position, by weighted least squares."""
    slowness = np.polyfit(x, t, 1)[0]
    for _ in range(3):  # errors of the position count as errors of the time
        variance = t_error**2 + (slowness * x_error) ** 2
        weight = 1 / variance if (variance > 0).all() else np.ones_like(x)
        middle = (weight * x).sum() / weight.sum()
        slowness = (weight * (x - middle) * t).sum() / (weight * (x - middle) ** 2).sum()
    error = 1 / math.sqrt((weight * (x - middle) ** 2).sum()) if (variance > 0).all() else 0.0
    return (middle, *_velocity(1.0, abs(slowness), 0.0, error))


def _fronts_of(event, x, t, x_error, t_error):
    """Yields (event, begin, end, position, velocity, low, high) between neighbouring gauges, and
    for all of them."""
    order = np.argsort(x)
    x, t, x_error, t_error = x[order], t[order], x_error[order], t_error[order]
    for i in range(len(x) - 1):
        found = _velocity(
            x[i + 1] - x[i],
            abs(t[i + 1] - t[i]),
            math.hypot(*x_error[i : i + 2]),
            math.hypot(*t_error[i : i + 2]),
        )
        yield event, x[i], x[i + 1], (x[i] + x[i + 1]) / 2, *found
    if len(x) > 2 and len(set(np.sign(np.diff(t)))) == 1:  # a front that runs in one direction
        yield event, x[0], x[-1], *_line(x, t, x_error, t_error)


def arrivals(table, *, columns=None):
    """Computes the velocity of a front from its arrival times at gauges.

    Parameters
    ----------
    table : path, text, dict of columns or DataFrame
        One arrival a row: position and time and, if known, error of position, error of time (one
        standard deviation) and event, with units in the titles, such as `x [mm]`. Rows of one event
        are one front.
    columns : path or dict, optional
        What other titles mean, such as {"columns": {"gauge": "position mm", "T1": "time us"}}.

    Returns
    -------
    xarray.Dataset over `front` with event, front_begin, front_end and position (m), and velocity
    (m/s) with velocity_interval, which holds 90 %. The fronts of an event are those between
    neighbouring gauges and, last, that along all gauges, if it runs in one direction. The end of an
    interval is infinite if the gauges do not exclude that the front arrives at both at once. The
    velocity is NaN if it does; the attribute warnings states the reason.

    Raises
    ------
    InputError if the table cannot be read, or no event has two gauges.

    Examples
    --------
    >>> table = {"x [mm]": [0, 10, 20], "t [us]": [0, 50, 100], "error of time [us]": [2, 2, 2]}
    >>> found = slipfront.arrivals(table)
    >>> found.velocity.round(3).values.tolist()
    [200.0, 200.0, 200.0]
    """
    found = read_numbers(table, QUANTITIES, columns)
    x, t = found.values["position"], found.values["time"]
    errors = [
        np.nan_to_num(found.values.get(name, np.zeros_like(x)))
        for name in ("error of position", "error of time")
    ]
    events = np.array(
        [str(event) for event in found.values.get("event", ["1"] * len(x))], dtype=object
    )
    rows, notes = [], list(found.notes)
    for event in dict.fromkeys(events):
        of_event = events == event
        if of_event.sum() < 2 or len(set(x[of_event])) < of_event.sum():
            notes.append(
                f"event {shown(event)}:"
                f" {'one gauge' if of_event.sum() < 2 else 'two arrivals at one position'}:"
                " left out"
            )
        else:
            rows += _fronts_of(
                event, x[of_event], t[of_event], *(error[of_event] for error in errors)
            )
    if not rows:
        raise InputError(
            f"{shown(found.file)}: no event has arrivals at two gauges; allowed: two rows or more"
            " of one event, at different positions"
        )
    if not any(error.any() for error in errors):
        notes.append("the arrivals have no errors: the intervals are empty")
    notes += [
        f"event {shown(event)}, {begin:.6g} to {end:.6g} m: equal arrival times, but no front is"
        f" infinitely fast: no velocity{', only a lower bound' if low == low else ''}"
        for event, begin, end, _, velocity, low, _ in rows
        if math.isnan(velocity)
    ]
    event, begin, end, position, velocity, low, high = zip(*rows)

    def number(values, long_name, unit="m", dims="front"):
        return dims, np.array(values), {"long_name": long_name, "units": unit}

    bounds = np.array([low, high]).T
    return dataset(
        {
            "event": texts("front", event, "name of the event"),
            "front_begin": number(begin, "position of the first gauge"),
            "front_end": number(end, "position of the last gauge"),
            "position": number(position, "position of the velocity"),
            "velocity": number(velocity, "velocity of the front", "m s-1"),
            "velocity_interval": number(
                bounds, "5 and 95 % of: velocity of the front", "m s-1", ("front", "bound")
            ),
        },
        BOUND,
        {"table": found.file, "warnings": "\n".join(notes)},
    )


def csv_of_arrivals(fronts):
    """Returns the fronts as CSV text. The error of a velocity is a factor, as slipfront laboratory
    reads it."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["name", "x [m]", "front_velocity [m/s]"])
    for event, begin, end, position, velocity, (low, high) in zip(
        *(
            fronts[name].values.tolist()
            for name in (
                "event",
                "front_begin",
                "front_end",
                "position",
                "velocity",
                "velocity_interval",
            )
        )
    ):
        cell = f"{velocity:.6g}" if velocity == velocity else ""
        if low < high:
            cell = (
                f"{cell} */ {math.sqrt(high / low) ** (1 / SIGMAS):.4g}"
                if 0 < low and high < math.inf
                else f">{low:.6g}" if low else ""
            )
        writer.writerow([f"{event}, {begin:.6g} to {end:.6g} m", f"{position:.6g}", cell])
    return out.getvalue()
