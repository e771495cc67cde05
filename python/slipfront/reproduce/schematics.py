"""Figs. 1-3: schematics, drawn from computed states."""

import numpy
import xarray
from matplotlib.figure import Figure

import slipfront

from .._dataset import about
from ..plots.style import styled
from . import picture as look
from .picture import Picture, picture


def static_chain(contact_ratio: float, sites: int) -> numpy.ndarray:
    """Displacements, in b / 2 pi, of a chain at rest with one dislocation in its middle and fixed
    ends: Eq. 1 without forces, by Newton's method.

    contact_ratio: A, 0.05 to 0.5. sites: 10 / A or more. Order: from one spacing of slip on the
    left to none on the right. Raises RuntimeError if the forces do not vanish.
    """
    x = contact_ratio * (numpy.arange(sites) - (sites - 1) / 2)
    u = 4 * numpy.arctan(numpy.exp(-x))  # the kink of Eq. 3, to start from
    u[0], u[-1] = 2 * numpy.pi, 0
    for _ in range(50):
        force = u[2:] - 2 * u[1:-1] + u[:-2] - contact_ratio**2 * numpy.sin(u[1:-1])
        if numpy.abs(force).max() < 1e-13:
            return u
        stiffness = (numpy.diag(-2 - contact_ratio**2 * numpy.cos(u[1:-1]))
                     + numpy.diag(numpy.ones(sites - 3), 1) + numpy.diag(numpy.ones(sites - 3), -1))
        u[1:-1] -= numpy.linalg.solve(stiffness, force)
    raise RuntimeError("static chain: the forces do not vanish in 50 steps")


def springs(axes, x, y):
    """Zigzag lines between neighbouring balls."""
    steps = numpy.arange(25)
    zigzag = 0.1 * numpy.where((steps > 3) & (steps < 21), (-1.0) ** steps, 0)
    for i in range(len(x) - 1):
        across, up = x[i] + steps / 24 * (x[i + 1] - x[i]), y[i] + steps / 24 * (y[i + 1] - y[i])
        axes.plot(across, up + zigzag, color="0.35", linestyle="-", linewidth=0.7)


def draw_surfaces(axes, ground):
    """(a): two surfaces with sinusoidal asperities in contact, the upper one displaced."""
    lower, upper = (0.3 * numpy.cos(2 * numpy.pi * ground),
                    0.42 - 0.3 * numpy.cos(2 * numpy.pi * (ground - 0.22)))
    axes.fill_between(ground, lower, -1.1, color="0.82", linewidth=0)
    axes.fill_between(ground, numpy.maximum(lower, upper), 1.6, color="#9fc5e0", linewidth=0)
    axes.fill_between(ground, upper, lower, where=lower > upper, color=look.RED, linewidth=0)
    axes.text(0, 1.15, "upper plate", ha="center")
    axes.text(0, -0.9, "lower plate", ha="center")
    axes.annotate("actual contact: share A of the area", (0.61, 0.2), (2.4, -0.92),
                  arrowprops={"arrowstyle": "->", "color": look.RED}, color=look.RED)
    axes.annotate("", (-1.6, 1.3), (-3.4, 1.3), arrowprops={"arrowstyle": "-|>", "linewidth": 1.4})
    axes.text(-3.5, 1.24, "slip", ha="right")
    axes.annotate("", (-4, -0.55), (-5, -0.55), arrowprops={"arrowstyle": "<->"})
    axes.text(-4.5, -0.82, "b", ha="center")
    axes.set(ylim=(-1.1, 1.6), title="(a) asperities in contact")


@styled
def draw_contact(chain) -> Figure:
    """Asperity contact above; below, the chain of balls and springs on the substrate."""
    now = chain["place"].values + chain["slip"].values / (2 * numpy.pi)
    figure = Figure(figsize=(7.2, 3.8))
    upper, lower = figure.subplots(2, 1, sharex=True)
    ground = numpy.linspace(-7.6, 7.6, 1500)
    draw_surfaces(upper, ground)
    lower.fill_between(ground, -0.5 * numpy.cos(2 * numpy.pi * ground) - 0.5, -1.7, color="0.82",
                       linewidth=0)
    lower.plot(ground, -0.5 * numpy.cos(2 * numpy.pi * ground) - 0.5, color="0.5", linestyle="-",
               linewidth=1)
    height = -0.5 * numpy.cos(2 * numpy.pi * now) - 0.5 + 0.3
    springs(lower, now, height)
    lower.plot(now, height, "o", color="C0", markersize=9, linestyle="none")
    lower.set(ylim=(-1.7, 1), xlim=(-7.6, 7.6), xlabel="position along the interface, b",
              title="(b) balls (asperities of the upper plate), springs, and the sine-shaped "
              "substrate (lower plate)")
    lower.text(0.02, 0.06, "slipped by b", transform=lower.transAxes, fontsize=8)
    lower.text(0.5, 0.06, "dislocation", transform=lower.transAxes, ha="center", fontsize=8)
    lower.text(0.98, 0.06, "not slipped", transform=lower.transAxes, ha="right", fontsize=8)
    for axes in (upper, lower):
        axes.set_yticks([])
        axes.grid(False)
        axes.spines["left"].set_visible(False)
    return figure


def contact() -> Picture:
    contact_ratio, sites = 0.4, 41
    u = static_chain(contact_ratio, sites)
    place = numpy.arange(sites) - (sites - 1) / 2
    data = xarray.Dataset({"slip": ("site", u, about("displacement of an asperity", "b / (2 pi)")),
                           "place": ("site", place, about("its place without slip", "b"))},
                          attrs={"contact_ratio": contact_ratio})
    return picture("fig-01", draw_contact(data), data, contact_ratio=contact_ratio)


def arrows(axes, x, w, W):
    """Draws slip velocity as arrows; W is 0.3 of their distance in each panel."""
    for height in (1.0, 1.6):
        axes.quiver(x, numpy.full_like(x, height), w / W, numpy.zeros_like(w), angles="xy",
                    scale_units="xy", scale=1 / (0.3 * (x[1] - x[0])), color="C0", width=0.009,
                    headwidth=3.2, headlength=3.6, headaxislength=3.4, minlength=0.1)


@styled
def draw_sliding(data) -> Figure:
    """Four scales of the same train."""
    figure = Figure(figsize=(7.2, 5))
    panels = figure.subplots(2, 2).ravel()
    W, spacing, a = data.attrs["mean"], data.attrs["spacing"], data.attrs["contact_ratio"]
    x, w = data["x"].values, data["w"].values
    far = numpy.linspace(-8, 8, 5)
    arrows(panels[0], far, numpy.full(5, W), W)
    panels[0].set(title="(a) large scale: uniform, W", xlim=(-10.4, 12), xticks=[-8, -4, 0, 4, 8],
                  xlabel="position x, 100 spacings of dislocations")
    panels[1].plot(x, w / W, color="C0")
    panels[1].axhline(1, color="0.5", linestyle="--", linewidth=0.9)
    panels[1].text(0.52 * spacing, 1.06, "W", color="0.35", ha="center")
    panels[1].set(title="(b) scale of dislocations: w(x)", xlabel="position x, b/A",
                  xlim=(x[0], x[-1]))
    for axes, place, title in ((panels[2], 0.0, "(c) asperities at a dislocation's centre"),
                               (panels[3], spacing / 2, "(d) asperities between two")):
        sites = numpy.arange(-2, 3)
        arrows(axes, sites.astype(float), numpy.interp(place + a * sites, x, w), W)
        axes.plot(sites, numpy.full(5, 0.55), "o", color="0.35", markersize=6, linestyle="none")
        axes.set(title=title, xlabel="position, asperities", xlim=(-2.6, 3))
        speed = float(numpy.interp(place, x, w)) / W
        axes.text(0.02, 0.9, f"w = {speed:.2g} W" + (": arrows a tenth of those in (a)" if speed
                                                     < 0.15 else ""), transform=axes.transAxes)
    for axes in (panels[0], panels[2], panels[3]):
        axes.set(ylim=(0.2, 2.2), yticks=[])
        axes.grid(False)
    panels[1].set_ylabel("slip velocity w / W")
    panels[1].set_ylim(0, None)
    return figure


def sliding() -> Picture:
    """Fig. 2: the train at x = 0 of the paper's Parkfield pulse."""
    contact_ratio = 0.0029
    state = slipfront.relations(stress=[1.03]).isel(state=0)
    phi, psi = (float(numpy.arctanh(state["dislocation_velocity_at_origin"])),
                float(state["psi_at_origin"]))
    spacing = float(slipfront.train.spacing(phi, psi))
    x = numpy.linspace(-1.5, 1.5, 1801) * spacing
    w = slipfront.train.fields(phi, psi, x)["w"].values
    mean = float(numpy.trapezoid(w, x) if hasattr(numpy, "trapezoid")
                 else numpy.trapz(w, x)) / (3 * spacing)
    data = xarray.Dataset({"w": ("x", w, about("slip velocity w", "c A / pi"))},
                          {"x": ("x", x, about("position x", "b / A"))},
                          {"contact_ratio": contact_ratio, "spacing": spacing, "mean": mean})
    return picture("fig-02", draw_sliding(data), data, contact_ratio=contact_ratio,
                   average=float(state["slip_velocity"]), mean=mean, most=w.max() / mean,
                   least=w.min() / mean, velocity=float(state["dislocation_velocity_at_origin"]),
                   stress=float(state["stress_at_origin"]))


@styled
def draw_initial(data) -> Figure:
    figure = Figure(figsize=(7.2, 2.8))
    axes = figure.subplots()
    axes.plot(data["x"], data["step"], color="C0", linestyle="-", drawstyle="steps-mid",
              label="step, section 3.1 (closed form)")
    axes.plot(data["x"], data["smooth"], color="C1", linestyle=":", linewidth=2,
              label="smooth profile, section 3.2 (computed)")
    axes.set(xlabel="position x, b/A", ylabel="initial stress Σ, μA/π", xlim=(-5, 5),
             ylim=(-0.03, 1.1))
    axes.text(-4.8, 0.9, "Σ−")
    axes.text(4.8, 0.22, "Σ+ (smooth)", ha="right")
    axes.text(4.8, 0.03, "Σ+ = 0 (step)", ha="right")
    axes.legend(loc="upper right")
    return figure


def initial(runs) -> Picture:
    start = runs.pulse("fig-08.toml").isel(time=0)
    x = numpy.linspace(-5, 5, 1001)
    smooth = numpy.interp(x, start["x"], start["Sigma"])
    attrs = about("initial stress", "mu A / pi")
    data = xarray.Dataset({"step": ("x", numpy.where(x < 0, 0.855, 0.0), attrs),
                           "smooth": ("x", smooth, attrs)},
                          {"x": ("x", x, about("position x", "b / A"))})
    return picture("fig-03", draw_initial(data), data)
