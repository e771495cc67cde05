"""Figs. 1-3: schematics, drawn from computed states."""

import numpy
import xarray
from matplotlib.figure import Figure

import slipfront

from ..plots.style import styled
from .picture import Picture, picture


def in_units(dimensional_unit) -> dict:
    """Attributes of a dimensionless variable."""
    return {"units": "1", "dimensional_unit": dimensional_unit}


def static_chain(contact_ratio: float, sites: int) -> numpy.ndarray:
    """Displacements, in b / 2 pi, of a chain at rest with one dislocation in its middle and fixed ends: Eq. 1 without forces, by Newton's method.

    contact_ratio: A, 0.05 to 0.5. sites: 10 / A or more. Order: from one spacing of slip on the left to none on the right.
    Raises RuntimeError if the forces do not vanish.
    """
    x = contact_ratio * (numpy.arange(sites) - (sites - 1) / 2)
    u = 4 * numpy.arctan(numpy.exp(-x))  # the kink of Eq. 3, to start from
    u[0], u[-1] = 2 * numpy.pi, 0
    for _ in range(50):
        force = u[2:] - 2 * u[1:-1] + u[:-2] - contact_ratio**2 * numpy.sin(u[1:-1])
        if numpy.abs(force).max() < 1e-13:
            return u
        stiffness = (numpy.diag(-2 - contact_ratio**2 * numpy.cos(u[1:-1])) + numpy.diag(numpy.ones(sites - 3), 1) +
                     numpy.diag(numpy.ones(sites - 3), -1))
        u[1:-1] -= numpy.linalg.solve(stiffness, force)
    raise RuntimeError("static chain: the forces do not vanish in 50 steps")


def alone(x, velocity=0.0):
    """Slip (b / 2 pi) and stress (mu A / pi) of one dislocation at x = 0, falling from 2 pi to 0: Eq. 4 with its neighbours out of sight."""
    fields = slipfront.train.fields(numpy.arctanh(velocity), 1e-250, x)  # the next one is 1150 away
    return fields["u"].values, fields["sigma"].values


@styled
def draw_contact(chain) -> Figure:
    """Asperities on the substrate, with springs between them."""
    place, u = chain["place"].values, chain["slip"].values
    now = place + u / (2 * numpy.pi)
    figure = Figure(figsize=(7.2, 3.6))
    upper, lower = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": (2, 1.6)})
    ground = numpy.linspace(-9.6, 9.6, 1200)
    upper.fill_between(ground, -0.5 * numpy.cos(2 * numpy.pi * ground) - 0.5, -1.6, color="0.85", linewidth=0)
    upper.plot(ground, -0.5 * numpy.cos(2 * numpy.pi * ground) - 0.5, color="0.5", linestyle="-", linewidth=1)
    height = -0.5 * numpy.cos(2 * numpy.pi * now) - 0.5 + 0.28
    for i in range(len(now) - 1):
        along = numpy.linspace(0, 1, 25)
        zigzag = 0.09 * numpy.where((numpy.arange(25) > 3) & (numpy.arange(25) < 21), (-1.0) ** numpy.arange(25), 0)
        across, up = now[i] + along * (now[i + 1] - now[i]), height[i] + along * (height[i + 1] - height[i])
        upper.plot(across, up + zigzag, color="0.45", linestyle="-", linewidth=0.6)
    upper.plot(now, height, "o", color="C0", markersize=8, linestyle="none")
    upper.set(ylim=(-1.6, 0.9), ylabel="potential of\nthe substrate", yticks=[])
    upper.set_title("asperities (dots), joined by springs, on the rigid substrate: one more than there are valleys")
    upper.grid(False)
    lower.plot(place, u / (2 * numpy.pi), "o-", color="C0")
    lower.set(xlabel="position along the interface, b", ylabel="slip, b", xlim=(-9.6, 9.6))
    return figure


def contact() -> Picture:
    """Fig. 1."""
    contact_ratio, sites = 0.4, 41
    u = static_chain(contact_ratio, sites)
    place = numpy.arange(sites) - (sites - 1) / 2
    data = xarray.Dataset({"slip": ("site", u, {"long_name": "displacement of an asperity", **in_units("b / (2 pi)")}),
                           "place": ("site", place, {"long_name": "its place without slip", **in_units("b")})}, attrs={"contact_ratio": contact_ratio})
    return picture("fig-01", draw_contact(data), data, contact_ratio=contact_ratio)


@styled
def draw_dislocation(data) -> Figure:
    """Slip and stress of one dislocation, at rest and moving."""
    figure = Figure(figsize=(7.2, 3.2))
    left, right = figure.subplots(1, 2, sharex=True)
    for i, velocity in enumerate(data["velocity"].values):
        one = data.sel(velocity=velocity)
        left.plot(data["x"], one["slip"], color=f"C{i}", label=f"U = {velocity:g} c")
        right.plot(data["x"], one["stress"], color=f"C{i}", label=f"U = {velocity:g} c")
    sites = f"asperities, A = {data.attrs['contact_ratio']}"
    left.plot(data["site"], data["slip_of_site"], "o", color="C2", markersize=3, linestyle="none", label=sites)
    left.set(xlabel="position x, b/A", ylabel="slip u, b/2π", title="slip", yticks=[0, numpy.pi, 2 * numpy.pi], yticklabels=["0", "π", "2π"])
    right.set(xlabel="position x, b/A", ylabel="stress σ = −∂u/∂x, μA/π", title="stress", xlim=(-6, 6))
    left.legend()
    right.legend()
    return figure


def dislocation() -> Picture:
    """Fig. 2."""
    contact_ratio, sites = 0.3, 41
    x, velocities = numpy.linspace(-6, 6, 481), [0.0, 0.8]
    fields = [alone(x, velocity) for velocity in velocities]
    site = contact_ratio * (numpy.arange(sites) - (sites - 1) / 2)
    data = xarray.Dataset({"slip": (("velocity", "x"), [f[0] for f in fields], in_units("b / (2 pi)")),
                           "stress": (("velocity", "x"), [f[1] for f in fields], in_units("mu A / pi")),
                           "slip_of_site": ("site", static_chain(contact_ratio, sites), in_units("b / (2 pi)"))},
                          {"x": x, "velocity": velocities, "site": site}, {"contact_ratio": contact_ratio})
    return picture("fig-02", draw_dislocation(data), data, contact_ratio=contact_ratio)


@styled
def draw_initial(data) -> Figure:
    """Averaged stress, and the dislocations that carry it."""
    figure = Figure(figsize=(7.2, 4.4))
    upper, lower = figure.subplots(2, 1, sharex=True)
    upper.plot(data["x"], data["stress"], color="C0", linestyle="-", linewidth=0.8, label="of each dislocation, −∂u/∂x")
    upper.plot(data["x"], data["Sigma"], color="C1", linestyle="-", linewidth=2, label="averaged, Σ")
    upper.set(ylabel="stress, μA/π", ylim=(0, 2.9))
    upper.legend(loc="upper right", ncol=2)
    lower.plot(data["x"], data["slip"], color="C0", linestyle="-")
    lower.set(xlabel="position x, b/A", ylabel="slip u over 2π\n= dislocations to the right",
              xlim=(float(data["x"][0]), float(data["x"][-1])))
    return figure


def initial(runs) -> Picture:
    """Fig. 3."""
    scale, half = 20, 4.0
    start = runs.pulse("fig-08.toml").isel(time=0)
    x = numpy.linspace(-half, half, 2001)
    stress = numpy.interp(x, start["x"], start["Sigma"])
    between = (stress[1:] + stress[:-1]) / 2 * numpy.diff(x)
    count = numpy.concatenate(([0], numpy.cumsum(between))) * scale / (2 * numpy.pi)  # dislocations from the left
    places = numpy.interp(numpy.arange(0.5, count[-1]), count, x)
    # Far apart or in a train, stresses of dislocations add up: dn is a sum of sech.
    slip, sharp = sum(numpy.array(alone(scale * (x - place))) for place in places)
    data = xarray.Dataset({"Sigma": ("x", stress, in_units("mu A / pi")), "stress": ("x", sharp, in_units("mu A / pi")),
                           "slip": ("x", slip / (2 * numpy.pi), in_units("b"))}, {"x": ("x", x, in_units("b / A"))},
                          {"scale": scale, "dislocations": len(places)})
    return picture("fig-03", draw_initial(data), data, scale=scale, count=len(places))
