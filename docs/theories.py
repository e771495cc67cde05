"""Draws docs/theories.png, and prints its numbers (docs/theories.md).

Usage: PYTHONPATH=build/release/python theories.py [numbers]

Observed numbers come from the catalogue and from the table of laboratory fronts in cases/, and curves from formulas.
With `numbers` it only prints the numbers, as JSON. It needs python3-matplotlib and runs for some seconds.
"""

import csv
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import slipfront  # noqa: E402

HERE = pathlib.Path(__file__).parent
STYLE = HERE.parent / "python" / "slipfront" / "slipfront.mplstyle"
FRONTS = HERE.parent / "cases" / "synthetic-laboratory-fronts.csv"
MU = 30e9  # Pa, the shear modulus that slipfront event assumes
NU = 0.3
C = math.sqrt(2 / (1 - NU)) * 3464.0  # m/s, of the curves: P waves of 6 km/s
LABORATORY = {"sigma_n": 5.0, "hardness": 0.20, "c": 2280.0, "nu": 0.35}  # MPa, sigma_p / mu, m/s and 1: FRONTS was made with these numbers
SLOW, FAST = "#0072B2", "#D55E00"
DAY = 86400.0
SLOWEST = 0.01  # V / c at which the curve of panel (c) is 1
numbers = {}


def static_drop(velocity):
    """Stress before minus stress after at x = 0 without friction, in mu A / pi (Eqs. 8-10). `velocity` is V / c."""
    state = slipfront.relations(rupture_velocity=velocity)
    return (state.stress - state.stress_at_origin).values


def events():
    """The numbers of the events: three readings of the stress drop in Pa, and what they are made of."""
    data = slipfront.event()
    found = {name: data[name].values for name in ("name", "kind", "rupture_velocity_m_s", "slip_velocity_m_s")}
    found["slip"], found["Mw"], found["duration"] = table_columns()
    found["slow"] = found["rupture_velocity_m_s"] < 100
    c_s = data.c_m_s.values * math.sqrt((1 - NU) / 2)
    found["damping"] = MU * found["slip_velocity_m_s"] / (2 * c_s)
    free = slipfront.relations(rupture_velocity=data.rupture_velocity_m_s.values / data.c_m_s.values)
    # w = W c A / pi without friction, so drop = mu A (Sigma- - Sigma(0)) / pi has no A
    found["free"] = MU * found["slip_velocity_m_s"] / data.c_m_s.values * ((free.stress - free.stress_at_origin) / free.slip_velocity).values
    found["moment"] = 10 ** (1.5 * found["Mw"] + 9.1)
    # 7 M0 / (16 R^3) with pi R^2 = M0 / (mu slip): a circle with this moment and mean slip
    found["circle"] = 7 * math.pi**1.5 / 16 * (MU * found["slip"]) ** 1.5 / np.sqrt(found["moment"])
    found["drop"], found["interval"] = data.static_drop_pa.values, data.static_drop_pa_interval.values
    found["contact_ratio"], found["gamma"] = data.contact_ratio.values, data.damping_number_interval.values
    return found


def table_columns():
    """Slip in m, magnitude and duration in s, which the results of slipfront event lack."""
    units = {"m": 1, "cm": 0.01, "mm": 0.001, "s": 1, "day": DAY, "min": 60}
    columns = {"slip": [], "Mw": [], "duration": []}
    with open(slipfront.cases / "catalogue.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            for name, values in columns.items():
                number, _, unit = row[name].partition(" ")
                values.append(float(number) * units.get(unit, 1) if number and "-" not in number else math.nan)
    return (np.array(values) for values in columns.values())


def speeds(axes, found, slow):
    """Panels (a) and (b): rupture speed against stress drop, by three readings of each event."""
    there = ~np.isnan(found["drop"])
    low, middle, high = np.quantile(found["contact_ratio"][there], (0.05, 0.5, 0.95))
    velocity = np.concatenate([np.geomspace(1e-12, 0.1, 200), np.linspace(0.1, 0.9, 100), 1 - np.geomspace(0.1, 1e-6, 400)])
    unit, colour = MU / math.pi, SLOW if slow else FAST
    scale = 1 if slow else 1e-3
    axes.plot(middle * unit * static_drop(velocity), velocity * C * scale, color="black", label=f"slipfront without friction, A = {middle:.2g}")
    axes.fill_betweenx(velocity * C * scale, low * unit * static_drop(velocity), high * unit * static_drop(velocity), color="0.9", linewidth=0, label="the same, A from 5 to 95 % of the events", zorder=0)
    chosen = there & (found["slow"] == slow)
    y, drop = scale * found["rupture_velocity_m_s"][chosen], found["drop"][chosen]
    axes.hlines(y, found["damping"][chosen], drop, color=colour, linewidth=0.4, alpha=0.4)
    axes.errorbar(drop, y, xerr=np.abs(found["interval"][chosen].T - drop), fmt="o", color=colour, markersize=3.5, linewidth=0.6, label="event by slipfront, with 90 % interval")
    axes.plot(found["circle"][chosen], y, "s", color=colour, markerfacecolor="white", markersize=4, label="by moment and slip, circular fault")
    axes.plot(found["damping"][chosen], y, "|", color=colour, markersize=7, markeredgewidth=1.4, label="by radiation damping, μw / 2c$_s$")
    only = scale * found["rupture_velocity_m_s"][~there & (found["slow"] == slow)]
    axes.plot(np.full(only.shape, 0.985), only, "<", color="0.4", markersize=4, transform=axes.get_yaxis_transform(), label="speed only")
    axes.set(xscale="log", xlabel="stress drop, Pa")
    energy = axes.secondary_xaxis("top", functions=(lambda drop: math.pi / 8 * drop**2 / MU * 1e3, lambda g: np.sqrt(8 * MU * np.abs(g) / (math.pi * 1e3))))
    energy.set_xlabel("G$_0$ / W of a long fault, J/m² per km")
    both = chosen & ~np.isnan(found["circle"])
    medians = [np.nanmedian(found[reading][chosen]) for reading in ("drop", "circle", "damping")]
    ratios = [np.median((found[reading] / found["circle"])[both]) for reading in ("drop", "damping", "free")]
    inside = (found["interval"][:, 0] <= found["circle"]) & (found["circle"] <= found["interval"][:, 1])
    numbers["slow" if slow else "fast"] = [chosen.sum(), both.sum(), *medians, *ratios, (inside & both).sum()]


def elongated(ratio, distance):
    """Speed over its limit where a rupture with this stress drop over the least one has run `distance`, in units of the length W' of its inertia."""
    lorentz = 1 + distance * (1 - ratio**-2.0)
    return np.sqrt(1 - lorentz**-2)


def shapes(axes):
    """Panel (c): how steeply the speed grows with the stress drop."""
    velocity = np.geomspace(1e-5, 0.999, 300)
    least = float(static_drop(SLOWEST))
    axes.plot(static_drop(velocity) / least, velocity, color="black", label=f"slipfront; 1 is V = {SLOWEST:g} c")
    ratio = np.geomspace(1 + 1e-9, 4, 2000)
    for distance, line in ((1, ":"), (10, "--"), (100, "-.")):
        axes.plot(ratio, elongated(ratio, distance), color="#009E73", linestyle=line, label=f"elongated fault, after {distance} W′")
    unit = math.sqrt((1 - LABORATORY["nu"]) / 2) * LABORATORY["sigma_n"] / (math.pi * LABORATORY["hardness"])
    with open(FRONTS, encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(line for line in file if line[0] != "#") if row["stress_drop [MPa]"]]
    number = {key: [float(row[key].split()[0]) for row in rows] for key in ("stress_drop [MPa]", "front_velocity [m/s]")}
    axes.plot(np.array(number["stress_drop [MPa]"]) / (unit * least), np.array(number["front_velocity [m/s]"]) / LABORATORY["c"], "kx", label="laboratory fronts (synthetic)")
    axes.set(xscale="log", yscale="log", xlim=(0.4, 4), ylim=(1e-4, 1.5), xlabel="stress drop over the least one", ylabel="V over its limit, c or c$_s$", title="(c) How steeply the speed grows")
    axes.set_xticks([0.5, 1, 2, 4], ["0.5", "1", "2", "4"])
    axes.minorticks_off()
    axes.legend(loc="lower right", fontsize="x-small")
    slow, fast = static_drop(np.array([0.001, 0.1]))
    share = (0.99**-0.5 - 1) / 10  # 1 - G_c / G_0 for V = 0.1 after 10 W'
    numbers["shapes"] = [fast / slow, 100 * ((1 - share) ** -0.5 - 1)]


def moments(axes, found):
    """Panel (d): moment against duration."""
    chosen = ~np.isnan(found["moment"] * found["duration"])
    time, moment = found["duration"][chosen], found["moment"][chosen]
    span = np.geomspace(1, 1e8, 200)
    axes.fill_between(span, 1e12 * span, 1e13 * span, color=SLOW, alpha=0.2, linewidth=0, label="slow: $10^{12}$ to $10^{13}\\,T$")
    axes.fill_between(span, 1e15 * span**3, 1e16 * span**3, color=FAST, alpha=0.2, linewidth=0, label="earthquakes: $10^{15}$ to $10^{16}\\,T^3$")
    axes.plot(time, moment, "o", color=SLOW, markersize=4, label="slow events of the catalogue")
    middle, rate = np.exp(np.log(time).mean()), np.exp(np.log(moment / time).mean())
    index = list(found["name"]).index("Typical ETS event (worked example)")
    for gamma, line in zip(found["gamma"][index], ("--", "-")):
        damping = np.maximum(gamma * span / (14 * DAY), 1e-12)
        potency = slipfront.moment_duration(0.27, damping).potency.values * span**2
        at_middle = float(slipfront.moment_duration(0.27, gamma * middle / (14 * DAY)).potency) * middle**2
        axes.plot(span, potency / at_middle * rate * middle, color="black", linestyle=line, label=f"slipfront, Γ = {gamma:.2g} in 14 days")
        numbers[line] = slipfront.moment_duration(0.27, np.array([1 / 24, 365]) * gamma / 14).exponent.values
    axes.set(xscale="log", yscale="log", xlim=(1, 1e9), ylim=(1e9, 1e23), xlabel="duration T, s", ylabel="moment $M_0$, N m", title="(d) Moment against duration")
    axes.legend(loc="lower right", fontsize="x-small")
    numbers["moments"] = [chosen.sum(), rate]


def main():
    found = events()
    with matplotlib.rc_context(fname=STYLE):
        figure = plt.figure(figsize=(8.2, 8.6), layout="constrained")
        (fast, slow), (left, right) = figure.subplots(2, 2)
        speeds(fast, found, False)
        fast.set(xlim=(3e4, 1e9), ylim=(0, 6.5), ylabel="rupture speed V, km/s", title="(a) Earthquakes")
        speeds(slow, found, True)
        slow.set(xlim=(1e-3, 1e8), yscale="log", ylim=(1e-3, 1e8), ylabel="rupture speed V, m/s", title="(b) Slow slip, creep and tremor")
        slow.legend(loc="upper left", fontsize="x-small")
        shapes(left)
        moments(right, found)
        if sys.argv[1:] != ["numbers"]:
            figure.savefig(HERE / "theories.png")
    print(json.dumps({name: [float(f"{value:.4g}") for value in values] for name, values in numbers.items()}))


if __name__ == "__main__":
    main()
