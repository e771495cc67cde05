"""Figs. 4-6: velocities without friction in closed form, with the paper's readings."""

import numpy
import xarray
from matplotlib.figure import Figure

import slipfront

from ..plots.style import label, styled
from . import picture as look
from .derived import relation
from .picture import Picture, picture

#: Panels of Figs. 5 and 6: name, (least, greatest) stress, scale of the vertical axis, key of the
#: event, colour of its read-off.
PANELS = (("earthquakes", (0.3, 2.0), "linear", "parkfield", look.RED),
          ("slow events", (0.15, 0.3), "log", "ets", look.GREEN))
EVENTS = {"parkfield": "Parkfield 2004", "ets": "ETS event"}


@styled
def draw_ratio(data, events) -> Figure:
    """|V- / V+| against |V-|, with the paper's two events."""
    figure = Figure(figsize=(7.2, 3.6))
    axes = figure.subplots()
    axes.plot(data["rupture_velocity"], data["velocity_ratio"], label="|V−| / V+ = K(m−) / E(m−)")
    for (key, name), colour in zip(EVENTS.items(), (look.RED, look.GREEN)):
        velocity = events[key]
        ratio = relation("velocity_ratio", rupture_velocity=velocity)
        axes.plot([velocity, velocity, 1e-9], [0, ratio, ratio], color=colour, linestyle="--",
                  linewidth=1, label=f"{name}: {ratio:.3g}")
    axes.set(xscale="log", xlim=(1e-9, 1), ylim=(0, 26),
             xlabel="rupture velocity of the trailing edge |V−|, c", ylabel="|V−| / V+")
    axes.legend()
    return figure


def ratio(values) -> Picture:
    velocity = xarray.DataArray(numpy.append(numpy.geomspace(1e-9, 0.9, 181), [0.95, 0.99, 0.999]),
                                dims="rupture_velocity")
    found = slipfront.relations(rupture_velocity=velocity.values)
    attrs = {key: found[key].attrs
             for key in ("rupture_velocity", "velocity_ratio", "leading_velocity", "stress")}
    data = xarray.Dataset({key: ("rupture_velocity", found[key].values, attrs[key])
                           for key in ("velocity_ratio", "leading_velocity", "stress")},
                          {"rupture_velocity": ("rupture_velocity", velocity.values,
                                                attrs["rupture_velocity"])})
    events = {key: values[f"{key}_rupture_velocity"] for key in EVENTS}
    least, most = float(data["velocity_ratio"].min()), float(data["velocity_ratio"].max())
    return picture("fig-04", draw_ratio(data, events), data, least=least, most=most)


def short(value, digits=3) -> str:
    """A number for a legend: 2.14e-5, not 2.14e-05."""
    return f"{value:.{digits}g}".replace("e-0", "e-")


@styled
def draw_against_stress(data, name, text, read_offs) -> Figure:
    """A velocity against stress: earthquakes above, slow events below, with dashed read-offs.

    read_offs: event -> [(stress, velocity, words, line style)], what is read off at which stress.
    """
    figure = Figure(figsize=(7.2, 6))
    for axes, (title, ends, scale, key, colour) in zip(figure.subplots(2, 1), PANELS):
        part = data.sel(stress=slice(*ends))
        axes.plot(part["stress"], part[name], color="C0")
        low = 0 if scale == "linear" else float(part[name].min())
        for stress, velocity, words, line in read_offs[key]:
            axes.plot([ends[0], stress, stress], [velocity, velocity, low], color=colour,
                      linestyle=line, linewidth=1.1, label=words)
        axes.set(xlim=ends, yscale=scale, title=title, ylabel=text,
                 xlabel=label(data["stress"], "initial stress Σ−"))
        axes.set_ylim(low, None if scale == "log" else 1.05 * float(part[name].max()))
        axes.legend(loc="upper left" if scale == "linear" else "lower right", title=EVENTS[key])
    return figure


def over_stress(names):
    stresses = numpy.unique(numpy.round(numpy.concatenate((numpy.linspace(0.3, 2, 171),
                                                           numpy.linspace(0.15, 0.3, 151))), 6))
    found = slipfront.relations(stress=stresses)
    return xarray.Dataset({name: ("stress", found[name].values, found[name].attrs)
                           for name in names},
                          {"stress": ("stress", stresses, found["stress"].attrs)})


def rupture(values, given) -> Picture:
    data = over_stress(["rupture_velocity", "leading_velocity", "velocity_ratio"])
    read_offs, printed = {}, []
    for key, name in EVENTS.items():
        velocity, paper = given[f"{key}_rupture_velocity"], given[f"{key}_stress"]
        found = relation("stress", rupture_velocity=velocity)
        read_offs[key] = [(paper, velocity, f"read by the paper: Σ− = {paper:g} at |V−| = "
                           f"{short(velocity)} c", "--"),
                          (found, velocity, f"computed: Σ− = {found:.4g} there", ":")]
        printed.append((f"Σ− at |V−| = {velocity:g} c ({name}), μA/π", f"{paper:g}", found))
    figure = draw_against_stress(data, "rupture_velocity", "rupture velocity |V−|, c", read_offs)
    return picture("fig-05", figure, data, printed, orders=values["orders_of_velocity"],
                   decade=values["decade_from"])


def slip(values, given) -> Picture:
    data = over_stress(["slip_velocity", "stress_at_origin"])
    read_offs, printed = {}, []
    for key, name in EVENTS.items():
        stress, paper = given[f"{key}_stress"], given[f"{key}_slip_velocity"]
        found = relation("slip_velocity", stress=stress)
        read_offs[key] = [(stress, found, f"computed: W = {short(found)} at Σ− = {stress:g}", ":"),
                          (relation("stress", slip_velocity=paper), paper,
                           f"printed: W = {short(paper)}, which has Σ− = "
                           f"{relation('stress', slip_velocity=paper):.4g}", "--")]
        printed.append((f"W(0) at Σ− = {stress:g} ({name}), cA/π", f"{paper:g}", found))
    caption = given["ets_stress_caption"]
    printed.append((f"Σ− at W(0) = {given['ets_slip_velocity']:g} (ETS event, caption), μA/π",
                    f"{caption:g}", values["ets_stress_caption"]))
    figure = draw_against_stress(data, "slip_velocity", "slip velocity W at x = 0, cA/π", read_offs)
    return picture("fig-06", figure, data, printed, orders=values["orders_of_slip_velocity"],
                   decade=values["decade_from"])
