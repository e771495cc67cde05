"""Chooses the pictures that can be drawn of a Dataset."""

import importlib

from .loaded_parts import is_loaded

#: For each kind of picture: the function of this package, and the dimensions and variables that a
#: Dataset must have.
KINDS = {
    "plane": ("plane", {"time", "x", "y", "series_time", "rupture_time", "moment_rate"}),
    "fault": ("fault", {"along_strike", "down_dip", "slip", "rupture_time"}),
    "loading": ("loading", {"time", "x", "x_bounds", "slip"}),
    "event": ("slip_event", {"time", "x", "x_bounds", "slip", "event_onset"}),
    "catalogue": ("catalogue", {"event_onset"}),
    "comparison": ("comparison", {"level", "time", "x", "slip_at_origin", "name"}),
    "space-time": ("space_time", {"time", "x", "x_bounds"}),
    "profiles": ("profiles", {"time", "x"}),
    "paths": ("paths", {"time", "x", "dislocation_position"}),
    "events": ("events", {"rupture_velocity", "stress", "frictionless_slip_velocity"}),
    "relations": ("relations", {"rupture_velocity", "stress", "leading_velocity", "slip_velocity"}),
    "corner": ("corner", {"sample"}),
    "sweep": ("sweep", {"failure"}),
    "fronts": ("fronts", {"front", "front_velocity", "arrival"}),
    "laboratory": ("laboratory", {"front", "curve_front_velocity"}),
}


def kinds_of(dataset) -> list:
    """Returns the kinds of picture of a Dataset; only the first of a comparison or a plane."""
    there = set(dataset.variables) | set(dataset.dims)
    kinds = [kind for kind, (_, wanted) in KINDS.items() if wanted <= there]
    if {"draw", "draw_rupture_velocity"} <= there and dataset.sizes["event"] == 1:
        kinds.insert(0, "corner")
    if "time" in dataset.dims and dataset.sizes["time"] < 2:
        kinds = [kind for kind in kinds if kind not in ("space-time", "loading", "event", "paths")]
    unsuited = {"space-time"} if is_loaded(dataset) else {"loading", "event", "catalogue"}
    kinds = [kind for kind in kinds if kind not in unsuited]
    return kinds[:1] if "level" in dataset.dims or "plane" in kinds else kinds


def draw(dataset, kind: str, **options):
    """Returns the Figure of a kind in kinds_of(dataset), with the options of its function."""
    function = KINDS[kind][0]
    drawing = getattr(importlib.import_module(f".{function}", __package__), function)
    if kind == "events":
        return drawing(dataset, line_through(dataset))
    return drawing(dataset, **options)


def line_through(events):
    """Returns the closed form for the rupture velocities of the events."""
    import numpy

    from .. import relations

    velocity = events["rupture_velocity"].dropna(events["rupture_velocity"].dims[0])
    if velocity.size == 0:
        raise ValueError("no event has a rupture velocity; allowed: events that were read without "
                         "error")
    slowest, fastest = float(velocity.min()), float(velocity.max())
    return relations(rupture_velocity=numpy.geomspace(slowest / 10,
                                                      min(1.4 * fastest, (1 + fastest) / 2), 300))
