"""Reads the events of a catalogue for a hierarchical model."""

import dataclasses

from .._numbers import np
from .._slipfront import InputError
from . import forward


@dataclasses.dataclass
class Events:
    """One value per event. Logarithms are natural, and units are those of SI."""

    name: list[str]
    study: np.ndarray  # number of the study that published the event, from 0
    speed: np.ndarray  # c
    log_duration: np.ndarray  # ln T
    log_front: np.ndarray  # ln(V / c)
    front_error: np.ndarray
    threshold: np.ndarray  # the observer of the front has this threshold; 0 means |V-|
    kind: np.ndarray  # forward.SLIP or forward.MOMENT
    log_size: np.ndarray  # ln of the size, as forward.size has it
    size_error: np.ndarray
    # Covariance of the errors of log_front and log_size, from a duration that is in both
    shared: np.ndarray
    # The log_size that an event needs to enter the catalogue; -inf if any size does
    smallest: np.ndarray

    def __len__(self):
        return len(self.log_size)

    def take(self, chosen):
        """Returns the events of these indices, with studies renumbered."""
        parts = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        parts = {name: [value[i] for i in chosen] if isinstance(value, list) else value[chosen]
                 for name, value in parts.items()}
        parts["study"] = np.unique(parts["study"], return_inverse=True)[1]
        return Events(**parts)


def log_size(kind, *, speed, log_duration, log_slip=None, log_slip_time=None, log_potency=None):
    """Returns ln of the size of an event, from slip and its time, or from potency."""
    if kind == forward.SLIP:
        return np.log(np.pi / speed) + log_slip - log_slip_time
    return np.log(np.pi) + log_potency - 2 * (np.log(speed) + log_duration)


def moment_of(row):
    """Returns ln of the moment in N m and its deviation."""
    if np.isfinite(row["moment"][0]):
        return row["moment"]
    median, deviation = row["moment_magnitude"]
    magnitude = np.exp(median)
    return np.log(10) * (1.5 * magnitude + 9.05), np.log(10) * 1.5 * deviation * magnitude


def _duration(row):
    return row["duration"] if np.isfinite(row["duration"][0]) else row["rise_time"]


def _front(row):
    """Returns ln(V) in m/s, its deviation, and that of the duration in it."""
    if np.isfinite(row["rupture_velocity"][0]):
        return (*row["rupture_velocity"], 0.0)
    length, duration = row["length"], row["duration"]
    return length[0] - duration[0], np.hypot(length[1], duration[1]), duration[1]


def read_row(row, errors):
    """Returns an event as a dict, or why not. `errors`: deviations for exact numbers."""
    if row["error"]:
        return row["error"]
    duration = _duration(row)
    if not np.isfinite(duration[0]):
        return "no duration or rise time"
    front, front_error, in_front = _front(row)
    if not np.isfinite(front):
        return "no rupture velocity, and no length with a duration"
    log_front = front - np.log(row["speed"])
    if log_front >= 0:
        return "the rupture velocity is above c"
    speed, moment, width, slip = row["speed"], moment_of(row), row["width"], row["slip"]
    if np.isfinite(moment[0] + width[0]):
        kind, powers, reported, own = forward.MOMENT, 2, moment[0], np.hypot(moment[1], width[1])
        potency = moment[0] - width[0] - np.log(row["shear_modulus"])
        size = log_size(kind, speed=speed, log_duration=duration[0], log_potency=potency)
    elif np.isfinite(slip[0]):
        kind, powers, (reported, own) = forward.SLIP, 1, slip
        time = row["rise_time"] if np.isfinite(row["rise_time"][0]) else duration
        size = log_size(kind, speed=speed, log_duration=duration[0], log_slip=slip[0],
                        log_slip_time=time[0])
    else:
        return "no slip, and no moment with a width"
    seen = row["rupture_velocity_is"] == "front"
    return {"name": row["name"], "study": row["study"] or row["citation"] or f"line {row['line']}",
            "speed": speed, "log_duration": duration[0], "log_front": log_front,
            "front_error": front_error or errors["velocity"],
            "threshold": row["front_threshold"] if seen else 0.0, "kind": kind, "log_size": size,
            "size_error": np.hypot(own or errors["size"], powers * duration[1]),
            "shared": powers * in_front**2, "unit": size - reported}


def arrays(found, smallest):
    """Returns Events. `smallest`: {kind: ln of the detection limit in SI}. Raises InputError."""
    kinds = {entry["kind"] for entry in found}
    if smallest and kinds != set(smallest):
        names = {forward.SLIP: "slip", forward.MOMENT: "moment"}
        wrong = next(entry["name"] for entry in found if entry["kind"] not in smallest)
        raise InputError(f"smallest_{names[next(iter(smallest))]}: '{wrong}' has no such size; "
                         "allowed: a limit for catalogues in which each event has it")
    columns = {key: np.array([entry[key] for entry in found])
               for key in found[0] if key not in ("name", "study", "unit")}
    limits = np.array([smallest[entry["kind"]] + entry["unit"] if smallest else -np.inf
                       for entry in found])
    below = np.flatnonzero(columns["log_size"] < limits)
    if len(below):
        raise InputError(f"'{found[below[0]]['name']}' is below the detection limit; allowed: a "
                         "limit that each event of the catalogue reaches")
    studies = np.unique([entry["study"] for entry in found], return_inverse=True)[1]
    return Events(name=[entry["name"] for entry in found], study=studies, smallest=limits,
                  **columns)
