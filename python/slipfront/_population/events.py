"""Observations of a population as arrays."""

import dataclasses

from .._numbers import np
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
