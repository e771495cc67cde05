"""Closed form, pulse and chain side by side."""

from typing import Any

from .pulse_parts import mark_fronts, shades, title_of, window
from .style import Picture, label, plain, quantity, styled

#: Lines of the levels that are no chains; chains are shaded by their scale.
LEVELS: dict[str, dict[str, Any]] = {
    "closed-form": {"color": "0.65", "linestyle": "-", "linewidth": 3.5},
    "pulse-consistent": {"color": "black", "linestyle": "-"},
    "pulse-paper": {"color": "C1", "linestyle": "--"},
}


@styled
def comparison(levels, fields=("W", "Sigma", "slip")) -> Picture:
    """Profiles of the levels at the last time, and slip at x = 0 on each: over time, or at the end
    where there are few times.

    Parameters
    ----------
    levels : xarray.Dataset
        Over level, time and x with the levels' names in `name`: what `slipfront.compare` gives.
    fields : sequence of str
        Three variables over level, time and x.

    Examples
    --------
    >>> levels = slipfront.compare(slipfront.cases / "step.toml", scales=[100])
    >>> figure = slipfront.plots.comparison(levels)
    >>> len(figure.axes)
    4
    """
    figure = Picture(figsize=(7.6, 5.6))
    panels = figure.subplots(2, 2)
    grows = levels.sizes["time"] > 4  # else there is no course of time to draw
    names = [plain(name) for name in levels["name"].values]
    chains = [name for name in names if name not in LEVELS]
    lines = dict(zip(chains, shades(len(chains))))
    for row, name in enumerate(names):
        level = levels.isel(level=row)
        look = LEVELS.get(name, {"color": lines.get(name), "linestyle": "-", "linewidth": 0.9})
        last = level.isel(time=-1)
        for axes, field in zip(panels.flat, fields):
            axes.plot(last["x"], last[field], label=name, **look)
        if grows:
            panels[1, 1].plot(level["time"], level["slip_at_origin"], label=name, **look)
        else:
            panels[1, 1].barh(name, float(last["slip_at_origin"]), color=look["color"], height=0.6)
    for axes, field in zip(panels.flat, fields):
        axes.set(xlabel=label(levels["x"]), ylabel=label(levels[field]), xlim=window(levels))
    if grows:
        panels[1, 1].set(xlabel=label(levels["time"]), ylabel=label(levels["slip_at_origin"]))
    else:
        panels[1, 1].set(xlabel=label(levels["slip_at_origin"]))
        panels[1, 1].invert_yaxis()
    panels[0, 1].legend()
    if "pulse-consistent" in names:
        mark_fronts(panels[0, 0], levels.isel(level=names.index("pulse-consistent")))
    figure.suptitle(f"{title_of(levels, 60)}, t = "
                    f"{quantity(levels['time'], float(levels['time'][-1]))}")
    return figure
