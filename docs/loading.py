"""Draws docs/loading-run.png, loading-cycles.png, loading-recurrence.png and loading-fronts.png, and prints their numbers (docs/loading.md).

Usage: loading.py PROGRAM [run_picture] [cycles] [recurrence] [fronts]

PROGRAM is build/release/bin/slipfront. The script needs python3-matplotlib and python3-xarray, and runs for some six minutes on one core.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import xarray  # noqa: E402

PROGRAM = sys.argv[1]
HERE = pathlib.Path(__file__).parent
STYLE = HERE.parent / "python" / "slipfront" / "slipfront.mplstyle"
CASE = str(HERE.parent / "cases" / "stick-slip.toml")
SMALL = {"domain.left": -4 * math.pi, "domain.right": 4 * math.pi, "interface.contact": 1, "chain.tolerance": 1e-4}  # a ring of eight dislocations, which all move at once
RING = {"domain.left": -100 * math.pi, "domain.right": 100 * math.pi, "interface.contact": "1 + 0.05*cos(x/100)"}  # a ring of 200 dislocations
STIFFNESS, VELOCITY = 4e-5, 1e-4
TAKE_PART = 8  # number of dislocations in each part of the chain that is observed for events


def run(case, settings, output=None):
    words = [f"{key}={value}" for key, value in settings.items()]
    done = subprocess.run([PROGRAM, "chain", case, "--json", "--quiet", "--threads", "1", *(["-o", output] if output else []), *(["--set", *words] if words else [])],
                          capture_output=True, check=True, text=True)
    return json.loads(done.stdout)


def run_picture(folder):
    """Draws loading-run.png, the picture that `slipfront plot` draws of a ring of 300 dislocations."""
    file = str(folder / "run.nc")
    run(CASE, {"domain.left": -470, "domain.right": 470, "time.end": 1e6, "output.every": 5e3}, file)
    subprocess.run([PROGRAM, "plot", file, "--kind", "loading", "--quiet", "-o", HERE / "loading-run.png"], check=True)


def cycles(folder):
    """Draws loading-cycles.png: load and slip velocity over time, and one event over position and time."""
    end, file = 6e5, str(folder / "cycles.nc")
    events = run(CASE, RING | {"time.end": end, "output.every": end})["events"]
    for e in events:
        print("cycles:", " ".join(f"{key} {e[key]:.4g}" for key in ("onset", "duration", "slip", "stress_drop", "peak_velocity", "length")), e["rupture_velocity"], flush=True)
    event = next((e for e in events[1:] if e["rupture_velocity"]), events[0])
    near = np.linspace(event["onset"] - event["duration"] / 2, event["onset"] + 2 * event["duration"], 250)
    even = np.linspace(0, end, 301)[1:-1]
    text = pathlib.Path(CASE).read_text(encoding="utf-8").replace("every = 2.56e5", f"times = {sorted({*near.tolist(), *even.tolist()})}")
    case = folder / "near.toml"
    case.write_text(text, encoding="utf-8")
    event = min(run(str(case), RING | {"time.end": end}, file)["events"], key=lambda e: abs(e["onset"] - event["onset"]))  # output times change the steps, and so the onset
    everything = xarray.open_dataset(file)
    whole, close = everything.sel(time=even), everything.sel(time=near)
    times, slip = whole["time"].values, whole["slip"].mean("x").values

    figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(6.5, 7.5))
    top.plot(times / 1e6, 1e3 * STIFFNESS * (VELOCITY * times - slip))
    top.set(ylabel="load, $10^{-3}$ F", title="Load: force of the springs, mean over the ring")
    rate = np.diff(whole["slip"].values, axis=0) / np.diff(times)[:, None]
    middle.semilogy(times[1:] / 1e6, np.maximum(rate.max(axis=1), 1e-9) / VELOCITY, label="fastest position")
    middle.semilogy(times[1:] / 1e6, np.maximum(rate.mean(axis=1), 1e-9) / VELOCITY, label="mean")
    middle.set(ylabel="slip velocity / velocity of springs", xlabel="time, $10^6$ b / (c A)", title="Slip velocity, mean over 2000 b / (c A)", ylim=(1e-4, None))
    middle.legend()
    moved, seconds = close["slip"].values, close["time"].values
    rate = np.log10(np.maximum(np.diff(moved, axis=0) / np.diff(seconds)[:, None], 1e-7) / VELOCITY)
    picture = bottom.pcolormesh((seconds[1:] + seconds[:-1]) / 2 - event["onset"], close["x"].values, rate.T, vmin=0, vmax=rate.max(), shading="nearest", rasterized=True)
    bottom.set(xlabel=f"time since onset at {event['onset']:.0f}, b / (c A)", ylabel="x, b / A", title=f"One event: its front runs at {event['rupture_velocity']:.2g} c")
    bottom.grid(False)
    figure.colorbar(picture, ax=bottom, label="$log_{10}$ slip velocity / that of springs")
    figure.savefig(HERE / "loading-cycles.png")


def recurrence(folder):
    """Draws loading-recurrence.png: time between events and stress drop against the velocity of the springs."""
    rows = []
    for velocity in (1e-5, 3e-5, 1e-4, 3e-4, 1e-3):
        once = 30 / velocity  # longer than the time between two events
        settings = SMALL | {"loading.velocity": velocity,
                            "loading.event_velocity": max(10 * velocity, 2e-3), "time.end": 6 * once, "output.every": 3 * once}
        events = run(CASE, settings)["events"][2:]
        events = [e for e in events if e["complete"]]
        gaps = np.diff([e["onset"] for e in events])
        rows.append((velocity, gaps.mean(), np.mean([e["stress_drop"] for e in events]), np.mean([e["peak_velocity"] for e in events]), len(events)))
        print("recurrence:", " ".join(f"{value:.5g}" for value in rows[-1]))
    velocity, gap, drop, peak, _ = np.array(rows).T
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.5, 3.2))
    left.loglog(velocity, gap, "o-")
    left.loglog(velocity, gap[2] * velocity[2] / velocity, color="0.5", linestyle=":", label="1 / velocity")
    left.set(xlabel="velocity of the springs, c A / π", ylabel="time between events, b / (c A)")
    left.legend()
    right.semilogx(velocity, 1e4 * drop, "o-")
    slope, level = np.polyfit(np.log(velocity[:3]), drop[:3], 1)  # inertia and the threshold have no effect at these velocities
    legend = f"{-slope / 5e-5:.2f} (b - a) a factor e, of the slow three"
    right.semilogx(velocity, 1e4 * (slope * np.log(velocity) + level), color="0.5", linestyle=":", label=legend)
    right.set(xlabel="velocity of the springs, c A / π", ylabel="stress drop, $10^{-4}$ F")
    right.legend()
    figure.savefig(HERE / "loading-recurrence.png", metadata={"Description": legend})  # docs/check_numbers.py compares it with the page


FRONT = """
[initial]
stress_left = 1
stress_right = 1
[domain]
left = -100
right = 0
[chain]
right = "free"
tolerance = 1e-3
[loading]
stiffness = 1e-9
velocity = 1e-3
[pulse]
cells = 20
"""
PULLED = """
[initial]
stress_left = 0
stress_right = 0
[friction]
law = "rate-and-state"
strength = 0.01
direct_effect = 1e-3
evolution_effect = 1.5e-3
reference_velocity = 1e-3
characteristic_slip = 6.283185307179586
[loading]
where = "left"
stiffness = 0.02
velocity = 0.01
event_velocity = 0.02
[domain]
left = 0
right = 300
[chain]
left = "free"
tolerance = 3e-3
[time]
end = 18000
[output]
every = 100
[pulse]
cells = 100
"""
SHARE = 0.3  # threshold at which a front is seen, as a fraction of the largest slip velocity


def fan(stress):
    """Returns the closed form (docs/theory/4_pulse.md): the velocity of the front and of the position where the slip velocity is SHARE times that at
    the origin, both in c, and the slip velocity at the origin in c A / pi."""
    from scipy.special import ellipkm1, ellipe

    def K(psi):
        return ellipkm1(np.tanh(psi) ** 2)

    def velocity(psi, psi0):
        phi = psi0 - psi
        c0 = np.tanh(psi) * K(psi) / ellipe(1 - np.tanh(psi) ** 2)
        return np.tanh(phi) * math.pi * np.cosh(phi) * np.cosh(psi) / K(psi), np.tanh(np.arctanh(c0) - phi)

    psi = np.logspace(-6, 1, 200000)
    psi0 = np.interp(stress, math.pi * np.cosh(psi) / K(psi), psi)
    inside = np.linspace(psi0, 1e-6 * psi0, 200000)
    W, speed = velocity(inside, psi0)
    origin = np.interp(0, -speed, W)
    return speed[0], speed[np.argmax(W > SHARE * origin)], origin


def fronts(folder):
    """Draws loading-fronts.png: the precursors of a pulled chain, and the velocity of a front that runs from a free end into a chain under
    stress, against the stress."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6))
    pulled, file = folder / "pulled.toml", str(folder / "pulled.nc")
    pulled.write_text(PULLED, encoding="utf-8")
    events = run(str(pulled), {}, file)["events"]
    data = xarray.open_dataset(file)
    picture = left.pcolormesh(data["time"].values / 1e3, data["x"].values, data["k"].values.T, vmin=0, shading="nearest", rasterized=True)
    left.plot([e["onset"] / 1e3 for e in events], [e["length"] for e in events], ".", color="C6", label="length of each event")
    left.set(xlabel="time, $10^3$ b / (c A)", ylabel="x, b / A", ylim=(0, 200), title="Precursors of a chain pulled at x = 0")
    left.legend()
    left.grid(False)
    figure.colorbar(picture, ax=left, label="stress, μ A / π")
    print(f"fronts: pulled: {len(events)} precursors; first and last length {events[0]['length']:.4g}, {events[-1]['length']:.4g}; dislocations on the chain {float(data['k'][-1].mean()) * 300 / 2 / math.pi:.3g}")

    case = folder / "front.toml"
    case.write_text(FRONT, encoding="utf-8")
    axis = np.linspace(0.5, 2.3, 60)
    curve = np.array([fan(stress) for stress in axis])
    right.plot(axis, curve[:, 0], color="black", label="closed form: front, |V−|(Σ−)")
    right.plot(axis, curve[:, 1], color="0.5", linestyle="--", label=f"closed form: {SHARE} of largest W")
    points = []
    for stress in (0.8, 1.0, 1.3, 1.6, 2.0):
        front, seen, W = fan(stress)
        length = 2 * math.pi * 12 * TAKE_PART / stress
        words = {"initial.stress_left": stress, "initial.stress_right": stress, "domain.left": -length, "time.end": 0.8 * length / seen,
                 "loading.event_velocity": SHARE * W}
        longest = max(run(str(case), words)["events"], key=lambda e: e["length"])
        points.append((stress, longest["rupture_velocity"]))
        print(f"fronts: stress {stress}: {points[-1][1]:.4g}, closed form {seen:.4g}, front {front:.4g}", flush=True)
    right.plot(*zip(*points), "o", linestyle="none", color="C0", label="every dislocation, no friction")
    right.set(xlabel="Σ− = (π σ$_p$ / μ)(τ / σ$_N$), μ A / π", ylabel="front velocity, c", ylim=(0, 1.05), title="Front into a chain under stress")
    right.legend()
    figure.savefig(HERE / "loading-fronts.png")


plt.style.use(STYLE)
with tempfile.TemporaryDirectory() as name:
    for figure in sys.argv[2:] or ("run_picture", "cycles", "recurrence", "fronts"):
        globals()[figure](pathlib.Path(name))
