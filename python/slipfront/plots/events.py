"""Observed events on the rupture relation."""

import numpy
from matplotlib.figure import Figure

from .style import styled

#: Marks of the kinds of event in the shipped catalogue; any other gets the next.
MARKS = "osD^vP*X"


def texts(variable) -> list:
    """Values of a variable as strings; empty where there is none."""
    return ["" if value is None or value != value else str(value) for value in variable.values]


def bars(events, name):
    """Distances from the value to both ends of its interval (<name>_interval, or the columns <name>_low and <name>_high of a CSV file), as
    errorbar takes them; None where no event has one."""
    if f"{name}_interval" in events:
        low, high = events[f"{name}_interval"].values.T
    elif f"{name}_low" in events:
        low, high = (events[f"{name}_{end}"].values.astype(float) for end in ("low", "high"))
    else:
        return None
    both = numpy.array([events[name].values - low, high - events[name].values])
    return None if numpy.isnan(both).all() else numpy.nan_to_num(both)


def panel(axes, events, name, kinds):
    """Events of one quantity against the rupture velocity, marked by kind."""
    kind_of = numpy.array(texts(events["kind"]) if "kind" in events else [""] * events["stress"].size)
    across, up = bars(events, "rupture_velocity"), bars(events, name)
    for i, kind in enumerate(kinds):
        chosen = kind_of == kind
        axes.errorbar(events["rupture_velocity"].values[chosen], events[name].values[chosen], fmt=MARKS[i % len(MARKS)], color=f"C{i}",
                      xerr=None if across is None else across[:, chosen], yerr=None if up is None else up[:, chosen],
                      label=kind.replace("_", " ") or "events", alpha=0.85, linewidth=0.8, linestyle="none", markeredgewidth=0.8)


@styled
def events(events, line) -> Figure:
    """Stress, and observed slip velocity where there is any, against rupture velocity, with the closed-form lines (Eqs. 8-10).

    Parameters
    ----------
    events : xarray.Dataset
        Over one dimension: rupture_velocity (c), stress (mu A / pi), observed_slip_velocity (c A / pi; NaN where not known), kind, and
        intervals where there are any: what `slipfront.event` gives.
    line : xarray.Dataset
        Of `slipfront.relations`, over the range to draw.
    """
    kinds = sorted(set(texts(events["kind"]))) if "kind" in events else [""]
    observed = "observed_slip_velocity" in events and bool(events["observed_slip_velocity"].notnull().any())
    figure = Figure(figsize=(8.6 if observed else 5.4, 3.9))
    panels = figure.subplots(1, 2 if observed else 1, squeeze=False)[0]
    panels[0].plot(line["rupture_velocity"], line["stress"], color="0.35", linestyle="-", label="closed form")
    panel(panels[0], events, "stress", kinds)
    panels[0].set(ylabel="initial stress Σ−, μA/π", title="Stress that the rupture velocity means")
    if observed:
        panels[1].plot(line["rupture_velocity"], line["slip_velocity"], color="0.35", linestyle="-", label="closed form, no friction")
        panel(panels[1], events, "observed_slip_velocity", kinds)
        panels[1].set(yscale="log", ylabel="slip velocity W, cA/π", title="Slip velocity: observed, and without friction")
    for axes in panels:
        axes.set(xscale="log", xlabel="rupture velocity |V−|, c")
        axes.legend()
    return figure
