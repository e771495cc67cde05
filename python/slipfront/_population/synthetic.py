"""Synthetic populations for calibration: parameters and events drawn from the model itself."""

from .._numbers import np
from . import forward, priors
from .likelihood import LEAST_IN_TABLE, share_in_table
from .rows import Events
from .selection import Selection

TRIES = 4000  # candidates for each event of a round


def design(generator, events, studies, *, kind=forward.MOMENT, speed=5421.0, duration=(1e4, 3e5),
           front_error=0.2, size_error=0.3, smallest=-np.inf, threshold=0.0):
    """Returns Events with drawn durations and studies, and without fronts and sizes."""
    log_duration = generator.uniform(*np.log(duration), events)
    nothing = np.full(events, np.nan)
    return Events(name=[f"event {i}" for i in range(events)], study=np.arange(events) % studies,
                  speed=np.full(events, speed), log_duration=log_duration, log_front=nothing.copy(),
                  front_error=np.full(events, front_error), threshold=np.full(events, threshold),
                  kind=np.full(events, kind), log_size=nothing.copy(),
                  size_error=np.full(events, size_error), shared=np.zeros(events),
                  smallest=np.full(events, smallest))


def parameters(generator, events, log_hardness):
    """Returns parameters from the prior of which enough events enter the catalogue."""
    selection = Selection(events) if np.isfinite(events.smallest).any() else None
    while True:
        x = generator.standard_normal(len(priors.NAMES))
        values = priors.Prior().values(x)
        inside = np.all(np.abs(x) < 5) and share_in_table(values) >= LEAST_IN_TABLE
        if inside and (selection is None or selection.prepare(values, log_hardness)):
            return values


def states(generator, values, count, log_hardness):
    """Returns ln(Sigma-), ln(A) and ln(C / b) of events of a population."""
    stress, stress_spread, normal, normal_spread, friction, friction_spread, _ = values
    least, most = forward.LOG_STRESS[[0, -1]]
    log_stress = np.log(stress) + stress_spread * generator.standard_normal(count)
    while (outside := (log_stress < least) | (log_stress > most)).any():
        scatter = stress_spread * generator.standard_normal(outside.sum())
        log_stress[outside] = np.log(stress) + scatter
    return (log_stress,
            np.log(normal) - log_hardness + normal_spread * generator.standard_normal(count),
            np.log(friction) + friction_spread * generator.standard_normal(count))


def observe(generator, events, values, log_hardness):
    """Fills in fronts and sizes as observed and detected. Returns the states of events."""
    offsets = values[-1] * generator.standard_normal(events.study.max() + 1)
    truth = np.empty((len(events), 3))
    for i in range(len(events)):
        while True:
            state = states(generator, values, TRIES if np.isfinite(events.smallest[i]) else 1,
                           log_hardness)
            log_damping = state[1] + state[2] + np.log(events.speed[i]) + events.log_duration[i]
            size = state[1] + forward.at(forward.size(events.kind[i]), state[0],
                                         log_damping) + offsets[events.study[i]]
            size = size + events.size_error[i] * generator.standard_normal(len(size))
            detected = np.flatnonzero(size > events.smallest[i])
            if len(detected):
                break
        first = detected[0]
        truth[i] = [part[first] for part in state]
        events.log_size[i] = size[first]
        front = forward.at(forward.front(events.threshold[i]), state[0], log_damping)[first]
        events.log_front[i] = front + events.front_error[i] * generator.standard_normal()
    return truth
