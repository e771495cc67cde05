"""Statements on the model and on the paper's two events."""

import math

import numpy

import slipfront

from . import numbers
from .derived import relation
from .on_fronts import SCALE, SHARES, STEP_CHAIN, step_runs
from .rows import CONFIRMED, EXACT, REFUTED, UNTESTED, close, judged, row
from .runs import at_origin
from .schematics import static_chain


def slipped(run) -> float:
    """Slip at x = 0 at the last time."""
    return at_origin(run, "slip_at_origin")


def averages(runs) -> list:
    """Whitham's averages against every dislocation."""
    steps = step_runs(runs, SHARES[0])
    off = {closure: max(abs(slipped(theory) / slipped(chain) - 1) for theory, chain in zip(steps[closure], steps["chain"])) for closure in ("consistent", "paper")}
    chain = steps["chain"][2]
    return [row("Following a multitude of dislocations is too demanding to be practicable", "2.3", judged(chain.attrs["wall_seconds"] > 3600), f"{chain.attrs['dislocations']:.0f} dislocations to t = 2π take {chain.attrs['wall_seconds']:.1f} s on one core here.",
                f"scale {SCALE}, Σ− = 0.855, C = 0.5", STEP_CHAIN),
            row("The averaged equations hold beyond slow variation", "2.3", close(off["consistent"], 0.02), f"Slip at x = 0 from a true step, the least slow of all, is within {100 * off['consistent']:.2g} % of the chain with the consistent closure; with the paper's it is off by up to {100 * off['paper']:.0f} %, "
                "which is an error of the average, not of the method.", f"Σ− = 0.855, Σ+ = 0, C = 0 to 2, chain at scale {SCALE}", "slipfront compare cases/step.toml --set friction.law=viscous --set friction.coefficient=0.5")]


def uniform(runs) -> list:
    """The uniform train."""
    phi, psi, step = math.atanh(0.3), float(slipfront.train.psi_at_rest(0.855)), 1e-3
    x = numpy.linspace(0, 10, 1001)
    u = {(i, j): slipfront.train.fields(phi, psi, x + i * step - 0.3 * j * step)["u"].values for i, j in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))}
    residual = (u[0, 1] + u[0, -1] - u[1, 0] - u[-1, 0]) / step**2 + numpy.sin(u[0, 0])
    fields = slipfront.train.fields(phi, psi, numpy.linspace(0, float(slipfront.train.spacing(phi, psi)), 4001)[:-1])
    mean = float(fields["w"].mean() / (0.3 * fields["sigma"].mean())) - 1
    return [row("A uniform train with U > 0 keeps sliding uniformly", "3.1", EXACT, f"Eq. 4 solves Eq. 3 without friction: its residual is {abs(residual).max():.0e} by differences. With friction the momentum of a dislocation falls as exp(−C t) (consistent closure).", "U = 0.3 c, Σ = 0.855 in its frame",
                "python: slipfront.train.fields(phi, psi, x - 0.3 * t)"),
            row("W is the average of w over dislocations", "2.2, Fig. 2", EXACT, f"W = U Σ; by summing Eq. 4 over one spacing, to {abs(mean):.0e}. The printed W = U N/2π is a misprint (see formulas).", "U = 0.3 c", "python: slipfront.train.fields(phi, psi, x)")]


def peak(stress, place) -> float:
    """Greatest stress of a dislocation in the pulse of a step: 2 cosh(phi) cosh(psi), at an edge or at x = 0."""
    state = slipfront.relations(stress=[stress]).isel(state=0)
    psi = float(state["psi"])
    if place == "origin":
        return 2 / math.sqrt(1 - float(state["dislocation_velocity_at_origin"]) ** 2) * math.cosh(float(state["psi_at_origin"]))
    return 2 * math.cosh(psi)  # both edges: phi + psi = psi-, one of them 0


def energy(contact_ratio, sites) -> float:
    """Energy of a chain at rest with one dislocation in its middle, in the unit of 1 - cos u: odd numbers of sites have it on a site."""
    u = static_chain(contact_ratio, sites)
    return float((numpy.diff(u) ** 2).sum() / (2 * contact_ratio**2) + (1 - numpy.cos(u)).sum())


def dislocation(paper) -> list:
    """A single dislocation."""
    given = numbers.taken(paper)
    sizes = {name: 2 * math.pi / given[key] for name, key in (("Parkfield, C = 0", "parkfield_contact_ratio_0"), ("Parkfield, C = 2", "parkfield_contact_ratio_2.0"), ("ETS", "ets_contact_ratio"))}
    inside = all(given["width_least"] <= size <= given["width_most"] for size in sizes.values())
    share = 1 - 4 / math.pi * math.atan(math.exp(-math.pi))
    force = {contact: (energy(contact, 81) - energy(contact, 82)) / 2 for contact in (0.5, 0.4)}
    change = {stress: max(peak(stress, place) for place in ("edge", "origin")) / 2 - 1 for stress in (0.212, 1.03)}
    return [row("A dislocation is 2πb/A wide", "2.2", judged(share > 0.9), f"{100 * share:.1f} % of its slip is within 2π b/A (exact, neighbours far, U = 0); its stress is above half of the peak over {2 * math.acosh(2):.2f} b/A.", "ψ → 0, U = 0", "python: slipfront.train.fields(0.0, 1e-250, x)"),
            row("The width of a dislocation is 1e2 to 1e4 asperities", "2.2", judged(inside), "2π/A is " + ", ".join(f"{size:.0f} ({name})" for name, size in sizes.items()) + " for the paper's own A.", "A = 4e-5 to 0.0145", "python: 2 * 3.14159 / 4e-5"),
            row("Stress amplitude and width of a dislocation do not depend on density and slip rate", "2.2", close(change[1.03], 0.05), f"The peak stress is 2 cosh φ cosh ψ μA/π: in the pulse of Parkfield it varies by {100 * change[1.03]:.2g} %, in that of the ETS event by {100 * change[0.212]:.1g} %. It grows without "
                "bound as U → 1 or in dense trains.", "Σ− = 0.212 and 1.03, no friction", "slipfront relations --stress 1.03   # psi"),
            row("Moving dislocations takes much less stress than moving the surface as a whole", "1, 2.2, 5", judged(max(force.values()) < 1e-3), "As a whole it takes F = 1, the amplitude of sin u in Eq. 3. A dislocation takes "
                + " and ".join(f"{value:.0e} at A = {contact:g}" for contact, value in force.items()) + ", half the difference of its energies centred on an asperity and between two; less at any smaller A, and nothing in the continuum.",
                "chain at rest (Eq. 1), A = 0.4 and 0.5", "slipfront reproduce   # statements.csv")]


def stress_ratio() -> dict:
    """The abstract's other claim."""
    exact = math.sqrt((1 - 0.3) / 2)
    return row("|V−| is set by the ratio of shear to normal stress: Σ− = (πσ_p/μ)(Σ_dim/Σ_N)", "abstract, 5", EXACT, f"It follows from A = Σ_N/σ_p and the unit μA/π, since |V−| depends on Σ− alone. With the factor ((1 − ν)/2)^½ that the paper drops, Σ− is {1 / exact:.2f} times larger at ν = 0.3. V+ depends on Σ+ too.",
               "algebra", "slipfront relations --stress 1.03")


def decades() -> dict:
    """Seven orders for one."""
    starts = (0.1, relation("stress", rupture_velocity=numbers.SLOWEST), 0.2117, 0.3)
    V, W = ([numbers.orders(key, stress) for stress in starts] for key in ("rupture_velocity", "slip_velocity"))
    words = [", ".join(f"{value:.{digits}g}" for value in values) for values, digits in ((starts, 3), (V, 3), (W, 3))]
    return row("A change of stress by one order changes |V−| and W by seven orders", "3.1, 5, Figs. 5, 6", judged(min(V) < 7 < max(V) and min(W) < 7 < max(W)),
               f"It depends on where the decade begins: from Σ− = {words[0]} |V−| changes by {words[1]} orders and W(0) by {words[2]}; seven are within.", "decades of Σ− from 0.1 to 0.3", "slipfront relations --stress 0.1 --stress 1")


def covers() -> dict:
    """The range of velocities in the conclusions."""
    c, slowest = numbers.event("parkfield-2004.toml", "c_m_s"), numbers.SLOWEST
    unit = {"ets": c * 4e-5 / math.pi, "parkfield": c * 0.0029 / math.pi}
    slow = relation("slip_velocity", rupture_velocity=slowest) * unit["ets"]
    fast = relation("rupture_velocity", slip_velocity=1 / unit["parkfield"])
    return row("The model reaches from |V−|/c ≤ 1, W ≈ 1 m/s down to |V−|/c ≈ 1e-7, W ≈ 1e-7 m/s", "5", judged(0.1 < slow / 1e-7 < 10), f"The fast end holds: W = 1 m/s at |V−| = {fast:.2f} c with Parkfield's A = 0.0029. At |V−| = 1e-7 c, W(0) is {slow:.0e} m/s with the ETS event's A = 4e-5; "
               f"1e-7 m/s would need A = {4e-5 * 1e-7 / slow:.2g}.", "no friction", "slipfront relations --rupture-velocity 1e-7 --slip-velocity 0.2")


def parkfield(found) -> list:
    """31 MPa, and what friction may have done."""
    stress = found["values"]["parkfield_stress_mpa_0"]
    share = stress / 31
    C = {closure: float(slipfront.damping_number(1.03, share, closure=closure)["damping_number"]) / (2 * math.pi) for closure in ("consistent", "paper")}
    command = f"slipfront relations --stress 1.03 --slip-velocity-ratio {share:.3f}"
    return [row("Parkfield's stress without friction practically coincides with the 31 MPa of dynamic modelling", "4", close(1 - share, 0.1), f"{stress:.1f} MPa, {100 * (1 - share):.0f} % less than 31.", "μ = 30 GPa, Σ− = 1.03, W = 0.5 m/s", "slipfront event cases/parkfield-2004.toml"),
            row("At Parkfield friction may have had practically no effect on the slip velocity", "4, 5", UNTESTED, f"One stress cannot tell: A is known from W alone. If 31 MPa were exact, friction would have left {100 * share:.0f} % of the slip velocity, C = {C['consistent']:.3f} (consistent closure) or {C['paper']:.3f} (paper's) at t = 2π.",
                "Σ− = 1.03", command)]


def slow_events(found) -> list:
    """Friction in slow events."""
    ratio = {closure: [float(slipfront.friction_ratio(stress, math.pi, closure=closure)["ratio"]) for stress in (0.2117, 1.03)] for closure in ("consistent", "paper")}
    observed = found["values"]["ets_observed_slip_velocity"]
    needs = relation("stress", slip_velocity=observed)
    return [row("Friction reduces slip velocity more in slow slip events", "4, 5", judged(ratio["consistent"][0] < ratio["consistent"][1]),
                f"Slightly, at equal C t: C t = π leaves {ratio['consistent'][0]:.3f} of the ETS event's slip velocity and {ratio['consistent'][1]:.3f} of Parkfield's (consistent closure); with the paper's, {ratio['paper'][0]:.2f} and {ratio['paper'][1]:.2f}, the other way round. "
                "A slow event differs by its C t, which is not known.", "Σ− = 0.2117 and 1.03, C t = π", "slipfront relations --stress 0.2117 --stress 1.03 --friction-coefficient 0.5"),
            row("The ETS event's Σ− is 0.213 by slip velocity and 0.212 by rupture velocity because dissipation is left out", "Fig. 6", REFUTED if needs < 0.212 else CONFIRMED,
                f"Neither curve holds friction, and both readings are of the same pulse: W(0) at 0.212 is {relation('slip_velocity', stress=0.212):.3g}. The difference is one of reading. The observed W = {observed:.2g} would mean Σ− = {needs:.3f} without friction, less than 0.212.",
                "ETS event", "slipfront relations --stress 0.212 --slip-velocity 4.8e-8"),
            row("Σ− is a rupture threshold that is implicit in the model", "5", UNTESTED, "The model takes the stress at which an obstacle gives way as an input; it has no law for it.", "-", "-")]


def table(runs, found, paper) -> list:
    """The rows."""
    return [stress_ratio(), decades(), *averages(runs), *uniform(runs), *dislocation(paper), covers(), *parkfield(found), *slow_events(found)]
