"""Draws the pictures of docs/plane.md, and prints their numbers.

Usage: plane.py PROGRAM [picture] [fault] [barrier] [grid] [nucleation] [motion]

PROGRAM is build/release/bin/slipfront. The script needs python3-matplotlib and python3-xarray, and runs for some minutes.
"""

import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.animation  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import xarray  # noqa: E402

PROGRAM = sys.argv[1]
HERE = pathlib.Path(__file__).parent
CASES = HERE.parent / "cases"
STYLE = HERE.parent / "python" / "slipfront" / "slipfront.mplstyle"
FRICTION, RINGS = CASES / "plane-friction.toml", CASES / "plane-rings.toml"
WIDE = {"plane.left": -3.8, "plane.right": 3.8, "plane.bottom": -3.8, "plane.top": 3.8}
FREE = {"friction.coefficient": 0, "time.end": 6, "output.every": 6, "plane.cells": 100} | WIDE
LINES = {"averaged": (), "every line, 17": ("--direct", "--set", "chain.scale=40"), "every line, 35": ("--direct", "--set", "chain.scale=80")}


def run(folder, case, settings, words=()):
    """Runs a case and returns its file."""
    path = pathlib.Path(folder) / "out.nc"
    subprocess.run([PROGRAM, "plane", case, "--quiet", "-o", path, *words, *(f"--set={key}={value}" for key, value in settings.items())],
                   check=True, capture_output=True)
    with xarray.open_dataset(path) as data:
        return data.load()


def picture(folder):
    """Draws plane.png: when the rupture arrives, the moment rate, and a front that line tension stops."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.5, 3.3))
    for name, words in LINES.items():
        data = run(folder, FRICTION, {"time.end": 2, "output.every": 2, "plane.cells": 150} | WIDE, words)
        middle.plot(data["series_time"], data["moment_rate"], label=name)
        print(f"friction on one side, {name}: potency at t = 2 {float(data['potency'][-1]):.3f}, front {float(data['front'][-1]):.3f}")
        if name == "averaged":
            seen = left.contourf(data["x"], data["y"], data["rupture_time"], levels=np.linspace(0, 2, 11), cmap="viridis_r")
        data = run(folder, RINGS, FREE, words)
        right.plot(data["series_time"], data["front"], label=name)
        last = int(np.argmax(data["front"].values))
        print(f"no friction, {name}: farthest front {float(data['front'][last]):.3f} at t = {float(data['series_time'][last]):.2f}")
    figure.colorbar(seen, ax=left, label="rupture time, b / (c A)")
    left.set(title="Friction on one side", xlabel="x, b / A", ylabel="y, b / A", aspect="equal", xlim=(-3, 3), ylim=(-3, 3))
    left.grid(False)
    middle.set(title="Its moment rate", xlabel="t, b / (c A)", ylabel="potency rate, $b^2 c / (2 \\pi A)$", ylim=(0, None))
    right.set(title="No friction: line tension stops it", xlabel="t, b / (c A)", ylabel="farthest front, b / A")
    middle.legend(title="lines")
    figure.savefig(HERE / "plane.png")


def fault(folder):
    """Draws plane-fault.png: a rupture from the slip of a finite-fault model."""
    data = run(folder, CASES / "synthetic-fault.fsp", {})
    figure, axes = plt.subplots(2, 2, figsize=(9.5, 5.2))
    x, y = data["x"] / 1e3, data["y"] / 1e3
    for axis, name, title, factor in [(axes[0, 0], "initial_stress", "stress at t = 0, MPa", 1e-6), (axes[0, 1], "rupture_time", "rupture time, s", 1),
                                      (axes[1, 0], "slip", "slip at the end, m", 1)]:
        values = data[name][-1] if name == "slip" else data[name]
        shown = axis.pcolormesh(x, y, factor * values, cmap="viridis", rasterized=True)
        figure.colorbar(shown, ax=axis)
        axis.plot(0, 0, "*", color="tab:red", markersize=12)
        axis.set(title=title, xlabel="along strike, km", ylabel="up dip, km", aspect="equal")
        axis.grid(False)
    axes[1, 1].plot(data["series_time"], data["moment_rate"])
    axes[1, 1].set(title="moment rate, N m / s", xlabel="t, s")
    figure.savefig(HERE / "plane-fault.png")


def barrier(folder):
    """Draws plane-barrier.png: lines that walk around a region that is held."""
    data = run(folder, CASES / "plane-barrier.toml", {}, ("--direct",))
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.4), sharey=True)
    for axis, time in zip(axes, (1, 2.25, 3.5)):
        axis.pcolormesh(data["x"], data["y"], data["slip_velocity"].sel(time=time, method="nearest"), vmin=0, vmax=1, cmap="magma", rasterized=True)
        axis.set(title=f"t = {time}", xlabel="x, b / A", aspect="equal")
        axis.grid(False)
    axes[0].set_ylabel("y, b / A")
    figure.savefig(HERE / "plane-barrier.png")


def grid(folder):
    """Draws plane-grid.png: mean slip around a barrier, by the averages and line by line."""
    runs = {"averages on a grid": run(folder, CASES / "plane-barrier.toml", {}),
            "every line": run(folder, CASES / "plane-barrier.toml", {}, ("--direct",))}
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), sharey=True)
    for axis, (name, data) in zip(axes, runs.items()):
        seen = axis.contourf(data["x"], data["y"], data["slip"][-1], levels=np.linspace(0.25, 4, 16))
        axis.set(title=name, xlabel="x, b / A", aspect="equal")
        axis.grid(False)
    axes[0].set_ylabel("y, b / A")
    figure.colorbar(seen, ax=axes, label="slip at t = 3.5, b / (2 $\\pi$)")
    figure.savefig(HERE / "plane-grid.png")
    averaged, direct = (data["slip"].values for data in runs.values())
    for i in (4, 8, 14):
        print(f"barrier, t = {float(runs['every line']['time'][i]):.2f}: slip, L1 {np.abs(averaged[i] - direct[i]).sum() / np.abs(direct[i]).sum():.3f}, "
              f"potency {float(runs['averages on a grid']['potency'].values[-1]):.3f} and {float(runs['every line']['potency'].values[-1]):.3f} at the end")


def nucleation(folder):
    """Draws plane-nucleation.png: a rupture from a patch, by the averages and line by line."""
    case, fine = CASES / "plane-nucleation.toml", {"plane.cells": 320}
    runs = {"averages on a grid": run(folder, case, fine), "every line": run(folder, case, fine | {"chain.scale": 160}, ("--direct",))}
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.5, 3.3))
    for axis, (name, data) in zip((left, middle), runs.items()):
        seen = axis.contourf(data["x"], data["y"], data["rupture_time"], levels=np.linspace(0, 1.5, 11), cmap="viridis_r")
        axis.set(title=name, xlabel="x, b / A", aspect="equal", xlim=(0, 2.4), ylim=(-1.3, 1.3))
        axis.grid(False)
        right.plot(data["series_time"], -data["moment_rate"], label=name)
        print(f"nucleation, {name}: potency {float(data['potency'][-1]):.4f}, farthest rupture {float(data['front'][-1]):.3f}")
    left.set_ylabel("y, b / A")
    figure.colorbar(seen, ax=middle, label="rupture time, b / (c A)")
    right.set(title="moment rate", xlabel="t, b / (c A)", ylabel="potency rate, $-b^2 c / (2 \\pi A)$", ylim=(0, None))
    right.legend()
    figure.savefig(HERE / "plane-nucleation.png")
    averaged, direct = (data["slip"][-1].values for data in runs.values())
    print(f"nucleation: slip, L1 {np.abs(averaged - direct).sum() / np.abs(direct).sum():.3f}")


def motion(folder):
    """Draws plane.gif: the slip velocity of the averages and of every line, side by side."""
    settings = {"time.end": 2, "output.every": 0.08, "plane.cells": 190} | WIDE
    runs = {"averaged": run(folder, FRICTION, settings), "every line (35)": run(folder, FRICTION, settings, ("--direct", "--set", "chain.scale=80"))}
    figure, axes = plt.subplots(1, 2, figsize=(6.4, 3.3))
    images = []
    for axis, (name, data) in zip(axes, runs.items()):
        images.append(axis.imshow(np.abs(data["slip_velocity"][0]), origin="lower", extent=(-3.8, 3.8, -3.8, 3.8), vmin=0, vmax=0.9, cmap="magma"))
        axis.set(title=name, xlabel="x, b / A", xlim=(-3, 3), ylim=(-3, 3))
        axis.grid(False)
    axes[0].set_ylabel("y, b / A")
    figure.colorbar(images[1], ax=axes, label="slip velocity, $c A / \\pi$", shrink=0.9)

    def frame(i):
        for image, data in zip(images, runs.values()):
            image.set_data(np.abs(data["slip_velocity"][i]))
        figure.suptitle(f"t = {float(runs['averaged']['time'][i]):.2f} b / (c A); friction is strong where y > 0")
    film = matplotlib.animation.FuncAnimation(figure, frame, frames=runs["averaged"].sizes["time"])
    film.save(HERE / "plane.gif", writer=matplotlib.animation.PillowWriter(fps=8), dpi=72)


if __name__ == "__main__":
    plt.style.use(STYLE)
    parts = {"picture": picture, "fault": fault, "barrier": barrier, "grid": grid, "nucleation": nucleation, "motion": motion}
    with tempfile.TemporaryDirectory() as scratch:
        for chosen in sys.argv[2:] or parts:
            parts[chosen](scratch)
