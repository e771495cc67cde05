"""Which pictures a Dataset affords."""

import importlib

#: Kind of picture -> (function of this package, dimensions and variables that a Dataset must have).
KINDS = {
    "comparison": ("comparison", {"level", "time", "x", "slip_at_origin", "name"}),
    "space-time": ("space_time", {"time", "x", "x_bounds"}),
    "profiles": ("profiles", {"time", "x"}),
    "events": ("events", {"rupture_velocity", "stress", "frictionless_slip_velocity"}),
    "relations": ("relations", {"rupture_velocity", "stress", "leading_velocity", "slip_velocity"}),
    "corner": ("corner", {"sample"}),
}


def kinds_of(dataset) -> list:
    """Kinds of picture that the Dataset has all variables for, the most telling first. A comparison is drawn as such alone."""
    there = set(dataset.variables) | set(dataset.dims)
    kinds = [kind for kind, (_, wanted) in KINDS.items() if wanted <= there]
    if {"draw", "draw_rupture_velocity"} <= there and dataset.sizes["event"] == 1:
        kinds.insert(0, "corner")
    if "space-time" in kinds and dataset.sizes["time"] < 2:
        kinds.remove("space-time")
    return kinds[:1] if "level" in dataset.dims else kinds


def draw(dataset, kind: str):
    """The picture of a kind in kinds_of(dataset), as a Figure."""
    function = KINDS[kind][0]
    drawing = getattr(importlib.import_module(f".{function}", __package__), function)
    return drawing(dataset, line_through(dataset)) if kind == "events" else drawing(dataset)


def line_through(events):
    """The closed form from a tenth of the slowest event to close above the fastest."""
    import numpy

    from .. import relations

    velocity = events["rupture_velocity"].dropna(events["rupture_velocity"].dims[0])
    if velocity.size == 0:
        raise ValueError("no event has a rupture velocity; allowed: events that were read without error")
    slowest, fastest = float(velocity.min()), float(velocity.max())
    return relations(rupture_velocity=numpy.geomspace(slowest / 10, min(1.4 * fastest, (1 + fastest) / 2), 300))
