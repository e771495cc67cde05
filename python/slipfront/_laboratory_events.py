"""The function slipfront.laboratory_events: stick-slip events in the raw record of an
experiment."""

import csv
import io
import math

from . import _slipfront
from ._dataset import dataset
from ._messages import shown
from ._number_table import Quantity, read_numbers
from ._numbers import np
from ._slipfront import InputError

QUANTITIES = {
    "time": Quantity("time", ("t",)),
    "displacement": Quantity(
        "length",
        (
            "slip",
            "d",
            "u",
            "fault slip",
            "load point displacement",
            "loadpoint displacement",
            "lp disp",
            "disp",
            "x",
        ),
    ),
    "shear stress": Quantity("pressure", ("tau", "shear", "stress", "shearstress")),
    "normal stress": Quantity(
        "pressure", ("sigma n", "sigma", "normal", "normalstress"), required=False
    ),
}

#: A drop that is no event: this multiple of the noise, or this share of the range of the shear
#: stress.
NOISE, SHARE = 8.0, 0.05

#: An event releases stress this many times faster than the load builds it up.
FASTER = 3.0

#: Shares of the drop at which an event begins and ends.
ENDS = 0.05, 0.95

#: Name, long name, unit in files, its factor from SI units and the title in tables.
VARIABLES = (
    ("time", "time at which the event begins", "s", 1.0, "time [s]"),
    ("shear_stress", "shear stress before the event", "Pa", 1e-6, "tau [MPa]"),
    ("normal_stress", "normal stress before the event", "Pa", 1e-6, "normal_stress [MPa]"),
    ("stress_drop", "shear stress before minus after", "Pa", 1e-6, "stress_drop [MPa]"),
    ("slip", "slip of the event", "m", 1e6, "slip [um]"),
    (
        "duration",
        "time in which the stress falls from 5 to 95 % of the drop",
        "s",
        1.0,
        "duration [s]",
    ),
    (
        "stiffness",
        "stiffness of the machine, stress over displacement",
        "Pa m-1",
        1e-12,
        "stiffness [MPa/um]",
    ),
)


def _turns(stress, least):
    """Yields pairs of indices (peak, trough) between which the stress falls by at least `least`
    without rising by as much."""
    values = stress.tolist()
    peak = trough = 0
    falling = False
    for i, value in enumerate(values):
        if falling:
            if value < values[trough]:
                trough = i
            elif value > values[trough] + least:
                yield peak, trough
                falling, peak = False, i
        elif value > values[peak]:
            peak = i
        elif value < values[peak] - least:
            falling, trough = True, i
    if falling:
        yield peak, trough


def _least_drop(stress):
    """Returns the smallest drop that is an event: above the noise, which second differences
    measure, and a share of the range."""
    noise = (
        np.median(np.abs(np.diff(stress, 2))) / (0.6745 * math.sqrt(6)) if len(stress) > 2 else 0.0
    )
    return max(NOISE * noise, SHARE * np.ptp(stress))


def _loading_stiffness(displacement, stress, begin, peak):
    """Returns the slope of the stress over the displacement of the load point, from 20 to 80 % of
    the rise; NaN without a rise."""
    low, high = stress[begin], stress[peak]
    inside = slice(begin, peak + 1)
    chosen = (stress[inside] > low + 0.2 * (high - low)) & (
        stress[inside] < low + 0.8 * (high - low)
    )
    x, y = displacement[inside][chosen], stress[inside][chosen]
    return abs(float(np.polyfit(x - x[0], y, 1)[0])) if len(x) > 2 and np.ptp(x) > 0 else math.nan


def _event(values, before, peak, trough, load_point):
    """Returns the quantities of one event, and how much faster it releases stress than the load
    builds it up."""
    time, displacement, stress = values["time"], values["displacement"], values["shear stress"]
    drop = stress[peak] - stress[trough]
    fall = stress[peak] - stress[peak : trough + 1]
    begin = peak + int(np.nonzero(fall <= ENDS[0] * drop)[0][-1])
    end = begin + int(np.argmax(fall[begin - peak :] >= ENDS[1] * drop))
    duration = time[end] - time[begin]
    slip = abs(displacement[trough] - displacement[peak])
    if load_point:
        stiffness = _loading_stiffness(displacement, stress, before, peak)
        slip += drop / stiffness
    else:
        stiffness = drop / slip if slip > 0 else math.nan
    rise = (stress[peak] - stress[before]) / max(time[peak] - time[before], 1e-300)
    normal = values["normal stress"][peak] if "normal stress" in values else math.nan
    return (
        [time[begin], stress[peak], normal, drop, slip, duration, stiffness],
        drop / max(duration, 1e-300) / max(rise, 1e-300),
        end - begin,
    )


def _constant(text, file):
    return (
        None
        if text is None
        else _slipfront.parse_measured(
            str(text), "pressure", "" if isinstance(text, str) else "Pa", "", 0, "normal_stress"
        ).middle
    )


def laboratory_events(
    record, *, columns=None, normal_stress=None, least_drop=None, load_point=False
):
    """Finds stick-slip events in the raw record of an experiment: drops of the shear stress that
    are faster than the load.

    Parameters
    ----------
    record : path, text, dict of columns or DataFrame
        CSV with the columns time, displacement, shear stress and, if known, normal stress, with
        units in the titles, such as `shear stress [MPa]`.
    columns : path or dict, optional
        What other titles mean, such as {"columns": {"LPDisp": "displacement um"}}.
    normal_stress : str or float, optional
        Normal stress, if the record has none, such as "2 MPa" or a number in Pa.
    least_drop : str or float, optional
        Smallest drop of the shear stress that is an event. By default it is 8 times the noise, and
        at least 5 % of the range.
    load_point : bool, optional
        Whether the displacement is that of the load point. By default it is the slip of the
        interface.

    Returns
    -------
    xarray.Dataset over `event` with time, shear_stress (before the event), normal_stress,
    stress_drop, slip, duration and stiffness. The duration is the time in which the stress falls
    from 5 to 95 % of the drop. The stiffness is the drop over the slip. With `load_point` it is the
    slope of the stress over the displacement while the load grows, and the slip is the drop over
    the stiffness, plus the displacement meanwhile.

    Raises
    ------
    InputError if the record cannot be read or has no event.

    Examples
    --------
    >>> t = [0, 1, 2, 3, 3.01, 4, 5, 6]
    >>> slip = [0, 0, 0, 0, 4, 4, 4, 4]
    >>> record = {"time [s]": t, "slip [um]": slip, "tau [MPa]": [1, 2, 3, 4, 1, 2, 3, 4]}
    >>> found = slipfront.laboratory_events(record)
    >>> [float(found[name][0]) for name in ("stress_drop", "slip")]
    [3000000.0, 4e-06]
    """
    found = read_numbers(record, QUANTITIES, columns)
    values = found.values
    if constant := _constant(normal_stress, found.file):
        values["normal stress"] = np.full(len(values["time"]), constant)
    if not (np.diff(values["time"]) > 0).all():
        row = int(np.argmax(np.diff(values["time"]) <= 0)) + 2
        raise InputError(
            f"{shown(found.file)}: time: row {row} is not later than the one before; allowed:"
            " increasing times"
        )
    least = (
        _least_drop(values["shear stress"])
        if least_drop is None
        else _constant(least_drop, found.file)
    )
    events, slow, short, before = [], 0, 0, 0
    for peak, trough in _turns(values["shear stress"], least):
        event, faster, samples = _event(values, before, peak, trough, load_point)
        begins_earlier, before = peak == 0, trough
        if faster < FASTER or begins_earlier:  # no load came before
            slow += 1
            continue
        short += samples < 3
        events.append(event)
    if not events:
        raise InputError(
            f"{shown(found.file)}: no event: the shear stress never falls by {least / 1e6:.3g} MPa"
            " faster than it rises; allowed: a smaller least drop, or a record of stick-slip"
        )
    notes = list(found.notes)
    if slow:
        notes.append(
            f"falls of the stress that are not {FASTER:g} times faster than its rise, left out:"
            f" {slow}"
        )
    if short:
        notes.append(
            "events that last less than three samples, whose duration the record does not resolve:"
            f" {short} of {len(events)}"
        )
    table = np.array(events).T
    return dataset(
        {
            name: (("event",), table[i], {"long_name": long_name, "units": unit})
            for i, (name, long_name, unit, _, _) in enumerate(VARIABLES)
        },
        {
            "event": (
                "event",
                np.arange(1, len(events) + 1),
                {"long_name": "number of the event", "units": "1"},
            )
        },
        {
            "record": found.file,
            "least_drop_pa": float(least),
            "displacement_is": "load point" if load_point else "slip",
            "warnings": "\n".join(notes),
        },
    )


def cells_of(events):
    """Returns the titles of the table and the cells of each event."""
    titles = [title for *_, title in VARIABLES]
    columns = [
        [
            f"{value * factor:.6g}" if value == value else ""
            for value in events[name].values.tolist()
        ]
        for name, _, _, factor, _ in VARIABLES
    ]
    return titles, list(zip(*columns))


def csv_of(events):
    """Returns the table as CSV text: that of slipfront laboratory, whose front velocities the
    record does not give, and of slipfront event."""
    titles, rows = cells_of(events)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["name", *titles, "front_velocity [m/s]"])
    for number, row in enumerate(rows, 1):
        writer.writerow([f"event {number}", *row, ""])
    return out.getvalue()
