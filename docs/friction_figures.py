"""Draws docs/friction-plane.png, -pulse.png, -fronts.png and -contacts.png, and prints their numbers (docs/friction.md).

Usage: PYTHONPATH=build/release/python friction_figures.py [plane] [pulse] [fronts] [contacts]

The script needs python3-matplotlib and runs for some minutes.
"""

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
CASE = HERE.parent / "cases" / "rate-and-state.toml"
END = 2 * math.pi
A = 0.01  # direct effect a of the scenario CASE
AT_END = {"output.every": END}
KEPT = ["slip_velocity_at_origin", "peak_slip_velocity", "trailing_front_observed", "slip_at_origin"]
HEALED = 0.1  # fraction of the largest slip velocity. If x = 0 slips more slowly, it has healed and the rupture is a pulse.
STOPPED = 0.01  # fraction of the frictionless slip velocity at x = 0. If every cell slips more slowly, the rupture has stopped.


def swept(axes, **settings):
    """Runs a sweep. Returns the results at the end of each run, and the slip velocity without friction for comparison."""
    data = slipfront.sweep(CASE, axes, variables=KEPT, set=AT_END | settings)
    if (data["failure"] != "").any():
        print("failed:", sorted(set(data["failure"].values.ravel()) - {""}))
    free = slipfront.relations(stress=data["initial_stress_left"].values)["slip_velocity"]
    data["free"] = "initial_stress_left", free.values
    data["stopped"] = np.abs(data["peak_slip_velocity"]) / data["free"]
    data["share"] = np.abs(data["slip_velocity_at_origin"] / data["peak_slip_velocity"])
    return data.transpose("initial_stress_left", ...)


def plane():
    """Draws friction-plane.png: crack or pulse against a - b and stress, slow or fast against strength and stress."""
    stress = np.linspace(0.7, 1.6, 37)
    by_b = swept({"initial.stress_left": stress, "friction.evolution_effect": np.linspace(0, 0.06, 31)})
    by_strength = swept({"initial.stress_left": stress, "friction.strength": np.linspace(0, 0.15, 31)}, **{"friction.evolution_effect": 0.015})
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
    healing = A - by_b["friction_evolution_effect"].values
    moving = by_b["stopped"].values > STOPPED
    share = np.where(moving, by_b["share"].values, np.nan)
    left.set_facecolor("0.85")
    seen = left.pcolormesh(healing, stress, np.log10(np.clip(share, 1e-4, 1)), vmin=-4, vmax=0, shading="nearest", cmap="viridis", rasterized=True)
    left.contour(healing, stress, np.where(moving, by_b["share"].values, np.nan), levels=[HEALED], colors="white", linewidths=1.5)
    left.axvline(0, color="0.4", linewidth=0.8, linestyle=":")
    left.set(xlabel="a − b, unit of F", ylabel="initial stress $\\Sigma_-$", title="Crack or pulse")
    figure.colorbar(seen, ax=left, label="$\\log_{10}$ of W at x = 0 over the largest W, $t = 2\\pi$")
    for text, x, y, color in (("crack", -0.02, 1.4, "0.2"), ("pulse", -0.025, 1.075, "white"), ("at rest again", -0.025, 0.85, "0.2")):
        left.text(x, y, text, color=color, ha="center", va="center", weight="bold")
    strength = by_strength["friction_strength"].values
    speed = np.log10(np.clip(np.abs(by_strength["peak_slip_velocity"].values), 1e-6, None))
    seen = right.pcolormesh(strength, stress, speed, shading="nearest", cmap="magma", rasterized=True)
    lines = right.contour(strength, stress, -by_strength["trailing_front_observed"].values / END, levels=[0.05, 0.1, 0.2, 0.3, 0.4], colors="white", linewidths=1)
    right.clabel(lines, fmt="%g c")
    right.set(xlabel="strength $f_0$, unit of F", title="Slow or fast")
    figure.colorbar(seen, ax=right, label="$\\log_{10}$ of the largest W at $t = 2\\pi$")
    figure.savefig(HERE / "friction-plane.png")
    for b in (0.0, 0.015, 0.03, 0.06):
        row = by_b.sel(friction_evolution_effect=b, method="nearest")
        moves = row["stopped"].values > STOPPED
        crack = moves & (row["share"].values > HEALED)
        pulses = stress[moves & ~crack]
        told = f"a pulse from {pulses.min():.3f} to {pulses.max():.3f}" if pulses.size else "no pulse"
        print(f"a - b = {A - b:+.3f}: moves until the end if Sigma is at least {stress[moves].min():.3f}; {told}")


def pulse():
    """Draws friction-pulse.png: the slip velocity along the interface at several times, of a crack and of a pulse."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), sharey=True, layout="constrained")
    for axis, b, name in zip(axes, (0.005, 0.04), ("crack", "pulse")):
        data = slipfront.pulse(CASE, set={"friction.evolution_effect": b, "pulse.cells": 200}, errors=False)
        for i, share in zip((2, 5, 10, 20), (0.9, 0.65, 0.4, 0.0)):
            axis.plot(data["x"], data["W"].isel(time=i), color=plt.cm.viridis(share), label=f"t = {float(data['time'][i]):.2g}")
        axis.set(xlabel="x, b / A", title=f"{name}: a − b = {A - b:g}", xlim=(-3, 0.8))
        axis.axvline(0, color="0.6", linewidth=0.8)
        print(f"{name}: W(0) {float(data['slip_velocity_at_origin'][-1]):.2e}, largest {float(data['W'].isel(time=-1).max()):.2e}")
    axes[0].set(ylabel="slip velocity W, c A / π")
    axes[0].legend()
    figure.savefig(HERE / "friction-pulse.png")


def fronts():
    """Draws friction-fronts.png: the position of the fast front over the frictionless |V-| t, for three laws of friction of increasing
    strength."""
    laws = {
        "viscous": ("friction.coefficient", np.geomspace(0.02, 3, 14), {}),
        "coulomb": ("friction.coefficient", np.geomspace(0.001, 0.1, 14), {}),
        "rate-and-state": ("friction.strength", np.geomspace(0.001, 0.1, 14), {"friction.evolution_effect": 0.015}),
    }
    figure, axis = plt.subplots(figsize=(6.2, 4), layout="constrained")
    for (law, (key, values, more)), marker in zip(laws.items(), "osD"):
        settings = {"friction.law": law} | more if law == "rate-and-state" else {"friction.law": law}
        points = []
        for value in values:
            base = CASE if law == "rate-and-state" else {"initial": {"stress_left": 0.855, "stress_right": 0}}
            scalars = slipfront.pulse(base, set={"initial.stress_left": 0.855, "time.end": END, "pulse.cells": 400, key: value} | settings | AT_END, errors=False)
            ratio = float(scalars["slip_at_origin"][-1]) / 0.302900775
            points.append((ratio, *(float(scalars[name][-1]) for name in ("trailing_front", "trailing_front_observed"))))
        free = float(slipfront.relations(stress=0.855)["rupture_velocity"]) * END
        slip, foot, seen = np.array(points).T
        line, = axis.plot(slip, -foot / free, marker=marker, label=f"{law}: first felt")
        axis.plot(slip, -seen / free, marker=marker, color=line.get_color(), linestyle="--", markerfacecolor="white", label=f"{law}: seen at 0.001 of the largest W")
        for s, f, o in points[::4]:
            print(f"{law}: slip {s:.3f} of the frictionless slip, front first felt at {-f / free:.3f} |V-| t, seen at {-o / free:.3f} |V-| t")
    axis.set(xlabel="slip at x = 0 over that without friction", ylabel="position of the fast front over $|V_-| t$", ylim=(0, 1.05))
    axis.legend(fontsize="small")
    figure.savefig(HERE / "friction-fronts.png")


BLOCK = {
    "initial": {"stress_left": 0, "stress_right": 0},
    "interface": {"contact": 0},
    "friction": {"law": "rate-and-state", "strength": 0.05, "direct_effect": 0.01, "evolution_effect": 0.015, "characteristic_slip": 1, "reference_velocity": 0.01},
    "loading": {"stiffness": 0.0025, "velocity": 0.001, "event_velocity": 0.0012},
    "domain": {"left": -2, "right": 2},
    "chain": {"left": "free", "right": "free", "spacing": 0.5},
    "time": {"end": 2e5},
    "output": {"every": 25},
    "pulse": {"cells": 4},
}
STEP = {"initial.stress_left": 1.1, "friction.evolution_effect": 0.015, "friction.characteristic_slip": 0.05, "domain.left": -7, "domain.right": 3, "chain.scale": 200, "pulse.cells": 200}


def contacts():
    """Draws friction-contacts.png: a block with dilating pores, whose slip changes from earthquakes to slow slip to creep; and ruptures with
    ageing contacts or dilating pores."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
    for E, colour in zip((0, 0.04, 0.08), ("0.2", "tab:blue", "tab:red")):
        data = slipfront.chain(BLOCK, set={"friction.dilatancy": E, "friction.drainage_time": 3000} if E else {})
        speed = np.abs(data["slip_velocity_at_origin"].values)
        left.semilogy(data["time"] / 1e3, np.clip(speed, 1e-8, None), color=colour, label=f"$\\epsilon / b_p$ = {E:g}", linewidth=1.2)
        peaks = data["event_peak_velocity"].values
        print(f"dilatancy {E}: {peaks.size} events, peak velocities " + ", ".join(f"{p:.3g}" for p in peaks[-4:]) + "; durations " + ", ".join(f"{d:.0f}" for d in data["event_duration"].values[-4:]))
    left.set(xlabel="time, 1000 b / (c A)", ylabel="slip velocity, c A / π", title="A block whose pores dilate", ylim=(3e-11, 3))
    left.legend(fontsize="small", loc="lower right", ncol=3)
    kinds = [("neither", {}, "0.2")]
    kinds += [(f"$\\beta$ = {beta:g}", {"friction.contact_ageing": beta, "friction.contact_time": 1}, colour) for beta, colour in ((0.003, "tab:blue"), (0.01, "tab:cyan"))]
    kinds += [(f"$\\epsilon / b_p$ = {E:g}", {"friction.dilatancy": E, "friction.drainage_time": 3}, colour) for E, colour in ((0.001, "tab:orange"), (0.003, "tab:red"))]
    for name, keys, colour in kinds:
        data = slipfront.chain(CASE, set=STEP | AT_END | keys)
        right.plot(data["x"], data["slip"].isel(time=-1), color=colour, label=name)
        scalars = {key: float(data[key][-1]) for key in ("slip_at_origin", "peak_slip_velocity", "leading_front", "energy_contacts")}
        print(f"{name}: " + ", ".join(f"{key} {value:.4g}" for key, value in scalars.items()) + f", budget {data.attrs.get('energy_drift', float('nan'))}")
    right.set(xlabel="x, b / A", ylabel="slip at $t = 2\\pi$, b / (2π)", title="A step of stress that is released", xlim=(-3.5, 2.5))
    right.legend(fontsize="small")
    figure.savefig(HERE / "friction-contacts.png")


with matplotlib.rc_context(fname=STYLE):
    for name in sys.argv[1:] or ("plane", "pulse", "fronts", "contacts"):
        {"plane": plane, "pulse": pulse, "fronts": fronts, "contacts": contacts}[name]()
