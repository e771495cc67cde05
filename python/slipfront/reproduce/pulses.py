"""Figs. 7, 8, 9 and 11: pulses with friction, with the paper's closure and with the consistent one."""

import numpy
import xarray
from matplotlib.figure import Figure

from ..plots.pulse_parts import shades
from ..plots.style import label, styled
from .picture import Picture, picture
from .runs import CLOSURES, at_origin


def kept(pulse):
    """The fields of a pulse that its figure shows."""
    return pulse[["W", "Sigma", "slip", "trailing_front", "leading_front"]]


def both(runs, case, changes=None) -> xarray.Dataset:
    """Runs of a case with both closures, over `closure`; they share time and cells."""
    found = runs.many("", [(case, {"friction.closure": closure} | (changes or {})) for closure in CLOSURES])
    return xarray.concat([kept(run) for run in found], xarray.DataArray(list(CLOSURES), dims="closure", name="closure"), join="exact")


@styled
def draw_fields(data) -> Figure:
    """Slip velocity and stress at five times, one column a closure."""
    figure = Figure(figsize=(7.2, 5))
    panels = figure.subplots(2, 2, sharex=True, sharey="row")
    rows = numpy.linspace(0, data.sizes["time"] - 1, 5).astype(int)
    for column, closure in enumerate(data["closure"].values):
        for colour, row, text in zip(shades(5), rows, ("0", "π/2", "π", "3π/2", "2π")):
            now = data.sel(closure=closure).isel(time=row)
            for axes, name in zip(panels[:, column], ("W", "Sigma")):
                axes.plot(data["x"], now[name], color=colour, linestyle="-", label=f"t = {text}")
        panels[0, column].set_title(f"closure {closure}")
        panels[1, column].set(xlabel=label(data["x"]), xlim=(-6, 2.5))
    for axes, name in zip(panels[:, 0], ("W", "Sigma")):
        axes.set_ylabel(label(data[name]))
    panels[0, 0].legend(loc="upper left")
    return figure


def fields(data, number, c, **facts) -> Picture:
    """Fig. 7 or 9: one state at several times."""
    return picture(f"fig-{number:02d}", draw_fields(data), data, c=c, damping_number=2 * numpy.pi * c, **facts)


def peak(data) -> float:
    """Greatest slip velocity at the last time, with the paper's closure."""
    return float(data["W"].sel(closure="paper").isel(time=-1).max())


def weak_and_strong(runs, weak, strong) -> tuple:
    """Figs. 7 and 9."""
    seventh, ninth = both(runs, "fig-07.toml"), both(runs, "fig-09.toml")
    return fields(seventh, 7, weak), fields(ninth, 9, strong, times=peak(seventh) / peak(ninth))


@styled
def draw_scaled(data, factor) -> Figure:
    """Slip velocity at the end for each friction coefficient: as it is, and brought to the peak of the first."""
    figure = Figure(figsize=(7.2, 5))
    panels = figure.subplots(2, 2, sharex=True)
    for row, closure in enumerate(data["closure"].values):
        for i, c in enumerate(data["coefficient"].values):
            one = data["W"].sel(closure=closure, coefficient=c)
            times = float(factor.sel(closure=closure, coefficient=c))
            panels[row, 0].plot(data["x"], one, color=f"C{i}", label=f"C = {c:g}")
            panels[row, 1].plot(data["x"], times * one, color=f"C{i}", label=f"C = {c:g}, × {times:.2f}")
        panels[row, 0].set(title=f"closure {closure}", ylabel=label(data["W"]))
        panels[row, 1].set(title="brought to one peak")
        for axes in panels[row]:
            axes.set(xlim=(-7, 2.5))
            axes.legend(loc="upper left")
    for axes in panels[1]:
        axes.set_xlabel(label(data["x"]))
    return figure


def scaled(runs, coefficients, width) -> Picture:
    """Fig. 8."""
    cases = [both(runs, "fig-08.toml", {"friction.coefficient": c, "initial.width": width}).isel(time=-1)[["W", "Sigma", "slip"]] for c in coefficients]
    data = xarray.concat(cases, xarray.DataArray(coefficients, dims="coefficient", name="coefficient"), join="exact")
    peak = data["W"].max("x")
    data["factor"] = peak.isel(coefficient=0) / peak
    return picture("fig-08", draw_scaled(data, data["factor"]), data, width=width)


def drops(runs, stress, coefficient) -> xarray.Dataset:
    """Slip velocity at x = 0 at t = 2 pi after a step of stress, against the stress drop, with each closure and without friction."""
    right = numpy.round(stress * (1 - numpy.linspace(0.35, 1, 14)), 6)
    states = {"paper": ("paper", coefficient), "consistent": ("consistent", coefficient), "no friction": ("consistent", 0)}
    wanted = [("step.toml", {"friction.law": "viscous", "friction.closure": closure, "friction.coefficient": c, "initial.stress_right": float(r)})
              for closure, c in states.values() for r in right]
    values = numpy.reshape([at_origin(pulse) for pulse in runs.many("Fig. 11", wanted)], (len(states), len(right)))
    attrs = {"units": "1", "dimensional_unit": "c A / pi", "long_name": "slip velocity at x = 0, t = 2 pi"}
    return xarray.Dataset(
        {"slip_velocity_at_origin": (("state", "relative_drop"), values, attrs)},
        {"state": list(states), "relative_drop": ("relative_drop", 1 - right / stress, {"long_name": "stress drop over Sigma-", "units": "1"}),
         "stress_right": ("relative_drop", right, {"units": "1", "dimensional_unit": "mu A / pi"})})


@styled
def draw_drops(profiles, sweep) -> Figure:
    """Profiles for a small and a large drop, and the slip velocity at x = 0 against it."""
    figure = Figure(figsize=(7.2, 3.5))
    left, right = figure.subplots(1, 2)
    for i, stress in enumerate(profiles["stress_right"].values):
        for closure, line in zip(profiles["closure"].values, ("-", "--")):
            one = profiles["W"].sel(stress_right=stress, closure=closure)
            left.plot(profiles["x"], one, color=f"C{i}", linestyle=line, label=f"Σ+ = {stress:g}, {closure}")
    left.set(xlabel=label(profiles["x"]), ylabel=label(profiles["W"]), xlim=(-6, 4), ylim=(0, 1.4 * float(profiles["W"].max())))
    left.legend(loc="upper left", fontsize="x-small")
    for state in sweep["state"].values:
        one = sweep["slip_velocity_at_origin"].sel(state=state)
        right.plot(100 * sweep["relative_drop"], one / float(one.sel(relative_drop=1.0, method="nearest")), label=state)
    right.set(xlabel="stress drop (Σ− − Σ+)/Σ−, %", ylabel="W(0) over that of a drop of 100 %", ylim=(0, 1.1))
    right.legend(loc="lower right")
    return figure


def small_drop(runs) -> tuple:
    """Fig. 11, and the sweep in it."""
    stress, coefficient, pair = 0.855, 0.5, (0.179, 0.547)
    ends = [both(runs, "fig-11.toml", {"initial.stress_right": r}).isel(time=-1)[["W", "Sigma"]] for r in pair]
    grid = ends[0]["x"]  # each run has its own cells
    profiles = xarray.concat([end.interp(x=grid) for end in ends], xarray.DataArray(list(pair), dims="stress_right", name="stress_right"))
    sweep = drops(runs, stress, coefficient)
    return picture("fig-11", draw_drops(profiles, sweep), sweep), sweep
