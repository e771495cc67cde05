"""Observed events on the rupture relation."""

import numpy

from .style import Picture, plain, plain_numbers, styled

#: Marks and colours of the kinds of event. Their numbers have no common divisor, so that 72 kinds
#: differ in one or the other. Colour-blind readers can distinguish the colours: they are the scheme
#: "muted" of Tol (2021).
MARKS = "osD^vP*X"
COLOURS = ("#CC6677", "#332288", "#117733", "#88CCEE", "#882255", "#DDCC77", "#44AA99", "#999933",
           "#AA4499")

#: More events than this are drawn as a cloud.
MANY = 400

#: Pa, of the lines of equal contact ratio.
SHEAR_MODULUS = 30e9


def texts(variable) -> list:
    """Values of a variable as strings; empty where there is none."""
    return ["" if value is None or value != value else str(value) for value in variable.values]


def bars(events, name):
    """Returns distances to both ends of intervals, as errorbar takes them, or None."""
    if f"{name}_interval" in events:
        low, high = events[f"{name}_interval"].values.T
    elif f"{name}_low" in events:
        low, high = (events[f"{name}_{end}"].values.astype(float) for end in ("low", "high"))
    else:
        return None
    both = numpy.array([events[name].values - low, high - events[name].values])
    return None if numpy.isnan(both).all() else numpy.nan_to_num(both)


def panel(axes, events, name, kinds, scale=1.0):
    """Draws a quantity times `scale` against rupture velocity, by kind; many as a cloud."""
    kind_of = numpy.array(texts(events["kind"]) if "kind" in events
                          else [""] * events["stress"].size)
    across, up = bars(events, "rupture_velocity"), bars(events, name)
    up = None if up is None else scale * up
    velocity, values = (events[key].values.astype(float) for key in ("rupture_velocity", name))
    values = scale * values
    there = ~numpy.isnan(velocity * values)
    for i, kind in enumerate(kinds):
        chosen = (kind_of == kind) & there
        if not chosen.any():
            continue
        x, y = velocity[chosen], values[chosen]
        label, colour = plain(kind.replace("_", " ")) or "events", COLOURS[i % len(COLOURS)]
        if events["stress"].size > MANY:
            axes.plot(x, y, linestyle="none", marker=".", markersize=2, markeredgewidth=0,
                      color=colour, alpha=0.4, label=label, rasterized=True)
            continue
        lower = chosen if name.endswith("_bound") else chosen & known_of(events, f"{name}_bound")
        arrows(axes, velocity[lower], values[lower], colour)
        xerr, yerr = (None if both is None else both[:, chosen] for both in (across, up))
        axes.errorbar(x, y, fmt=MARKS[i % len(MARKS)], color=colour, xerr=xerr, yerr=yerr,
                      label=label, alpha=0.85, linewidth=0.8, linestyle="none", markeredgewidth=0.8)


def arrows(axes, x, y, colour) -> None:
    for place in zip(x, y):
        axes.annotate("", place, xytext=(0, 15), textcoords="offset points",
                      arrowprops={"arrowstyle": "<-", "color": colour, "linewidth": 0.7,
                                  "alpha": 0.7})


def decades(axes, events, name, scale=1.0):
    """Draws median and 5-95 % of each decade of a population, if the Dataset has one."""
    if f"population_{name}" not in events:
        return
    several = events[f"population_{name}_events"].values > 1
    if not several.any():
        return
    left, x, right = events["population_rupture_velocity"].values[several].T
    low, median, high = scale * events[f"population_{name}"].values[several].T
    axes.errorbar(x, median, xerr=[x - left, right - x], yerr=[median - low, high - median],
                  fmt="none", ecolor="k", elinewidth=1.2, capsize=2, zorder=4,
                  label="decade: median, 5-95 %")


def contact_lines(axes, line, low, high):
    """Draws the closed form for contact ratios of powers of ten between stresses in Pa."""
    rising = line["rupture_velocity"].values, line["stress"].values * SHEAR_MODULUS / numpy.pi
    least, most = (int(numpy.round(numpy.log10(stress / rising[1].min())))
                   for stress in (low, high))
    for i, exponent in enumerate(range(least, most + 1)):
        axes.plot(rising[0], rising[1] * 10.0**exponent / 1e6, color="0.55", linestyle=":",
                  linewidth=0.9, zorder=1,
                  label="closed form for A = 10$^n$, μ = 30 GPa" if i == 0 else None)
        axes.annotate(f"$10^{{{exponent}}}$", (rising[0][0], rising[1][0] * 10.0**exponent / 1e6),
                      color="0.45", fontsize=7, va="bottom")


def known_of(events, name):
    if name in events:
        return events[name].notnull().values
    return numpy.zeros(events["stress"].size, bool)


def known(events, name) -> bool:
    return name in events and bool(events[name].notnull().any())


@styled
def events(events, line) -> Picture:
    """Stress against rupture velocity, dimensionless and in MPa, and slip velocity where there is
    any, with the closed-form lines (Eqs. 8-10).

    Parameters
    ----------
    events : xarray.Dataset
        Over one dimension: rupture_velocity (c), stress (mu A / pi), stress_pa and stress_pa_bound
        (Pa), observed_slip_velocity (c A / pi; NaN where not known), kind, and intervals where
        there are any: what `slipfront.event` gives. A population, as the files of `slipfront event
        -o` have it, is drawn over the events.
    line : xarray.Dataset
        Of `slipfront.relations`, over the range to draw.

    Examples
    --------
    >>> found = slipfront.event(samples=0)
    >>> line = slipfront.relations(rupture_velocity=np.geomspace(1e-6, 0.9, 300))
    >>> figure = slipfront.plots.events(found, line)
    >>> figure.axes[0].get_xscale()
    'log'
    """
    kinds = sorted(set(texts(events["kind"]))) if "kind" in events else [""]
    shown = ["stress"] + [name for name in ("stress_pa", "stress_pa_bound",
                                            "observed_slip_velocity") if known(events, name)]
    figure = Picture(figsize=((5.0, 7.6, 10.8, 14.0)[len(shown) - 1], 4.2))
    panels = dict(zip(shown, figure.subplots(1, len(shown), squeeze=False)[0]))
    for name, axes in panels.items():
        scale = 1e-6 if name.startswith("stress_pa") else 1.0
        panel(axes, events, name, kinds, scale)
        decades(axes, events, name, scale)
        axes.set(xscale="log", xlabel="rupture velocity V, c")
    panels["stress"].plot(line["rupture_velocity"], line["stress"], color="0.35", linestyle="-",
                          label="closed form", zorder=3)
    panels["stress"].set(ylabel="initial stress Σ−, μA/π",
                         title="On or above the line by construction")
    for name, label, title in (("stress_pa", "initial stress, MPa",
                                "In MPa: A is from the slip velocity or given"),
                               ("stress_pa_bound", "least initial stress, MPa",
                                "Lower bounds (arrows): A without friction")):
        if name in panels:
            values = events[name].values
            panels[name].set(yscale="log", ylabel=label, title=title)
            plain_numbers(panels[name].yaxis)
            contact_lines(panels[name], line, numpy.nanmin(values), numpy.nanmax(values))
    if "observed_slip_velocity" in panels:
        axes = panels["observed_slip_velocity"]
        axes.plot(line["rupture_velocity"], line["slip_velocity"], color="0.35", linestyle="-",
                  label="closed form, no friction", zorder=3)
        axes.set(yscale="log", ylabel="slip velocity W, cA/π",
                 title="Slip velocity, and closed form")
    for name, axes in panels.items():
        if name == "stress":
            axes.legend(markerscale=4 if events["stress"].size > MANY else 1)
        else:  # the kinds are named once
            handles = [(handle, text) for handle, text in zip(*axes.get_legend_handles_labels())
                       if text.startswith(("closed", "decade"))]
            axes.legend(*zip(*handles)) if handles else None
    return figure
