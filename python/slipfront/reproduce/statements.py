"""Tests the paper's statements: exactly, as an observer would, and with every dislocation.

Each function returns {key of statements.toml: (verdict, values that its texts quote)}."""

import math
import pathlib
import tomllib

import numpy

import slipfront

from . import numbers
from .derived import relation
from .numbers import FRICTION, orders
from .runs import CLOSURES, at_origin
from .schematics import static_chain

STATEMENTS = pathlib.Path(__file__).with_name("statements.toml")
CONFIRMED, REFUTED = "Confirmed", "Refuted"
EXACT, UNTESTED = "Exact by construction", "Cannot be tested here"

#: Settings of commands that texts quote.
VISCOUS = "--set friction.law=viscous --set friction.coefficient="
COMMANDS = {"step": f"slipfront pulse cases/step.toml {VISCOUS}2",
            "step_half": f"slipfront pulse cases/step.toml {VISCOUS}0.5",
            "step_chain": f"slipfront chain cases/step.toml --set chain.scale=1000 {VISCOUS}2"}

#: Scale of the chains of this module. Their fronts are single dislocations.
SCALE = 1000

#: Thresholds of observers, as shares of the peak slip velocity.
SHARES = (0.02, 0.2)


def judged(holds) -> str:
    """Returns the verdict on a statement that holds or does not."""
    return CONFIRMED if holds else REFUTED


def close(deviation, most) -> str:
    """Returns "Confirmed within" a deviation of at most `most`, otherwise "Refuted"."""
    return f"Confirmed within {100 * deviation:.2g} %" if deviation <= most else REFUTED


def step_runs(runs, share=SHARES[0]) -> dict:
    """Returns {"paper", "consistent", "chain": runs over C} of a step into the empty side."""
    changes = [{"friction.law": "viscous", "friction.coefficient": c, "pulse.threshold": share}
               for c in (0.0, *FRICTION)]
    found = {closure: runs.many("fronts", [("step.toml", change | {"friction.closure": closure})
                                           for change in changes]) for closure in CLOSURES}
    chains = [("step.toml", change | {"chain.scale": SCALE}) for change in changes]
    return found | {"chain": runs.chains("fronts", chains)}


def slowed(steps, front) -> dict:
    """Returns the percentage by which the largest C slows a front, for each kind of run."""
    return {name: 100 * (1 - at_origin(found[-1], front) / at_origin(found[0], front))
            for name, found in steps.items()}


def fixed_front(run, threshold) -> float:
    """Returns the leftmost x with W above a threshold at the last time, or NaN."""
    W, x = run["W"].isel(time=-1).values, run["x"].values
    above = numpy.flatnonzero(W > threshold)
    if not above.size or above[0] == 0:
        return numpy.nan
    i = above[0]
    return float(x[i - 1] + (threshold - W[i - 1]) / (W[i] - W[i - 1]) * (x[i] - x[i - 1]))


def trailing(runs, steps) -> dict:
    """Tests |V-| as the speed of a characteristic, and as an observer of slip velocity sees it."""
    speeds, feet = ([at_origin(run, name) / (2 * numpy.pi) for run in steps["consistent"]]
                    for name in ("trailing_characteristic", "trailing_front"))
    off = max(abs(foot / speed - 1) for foot, speed in zip(feet, speeds))
    found = {"characteristic": (EXACT, {"speed": -speeds[0], "off": 100 * off})}
    for share in SHARES:
        late = slowed(step_runs(runs, share), "trailing_front_observed")
        found[f"observed_{100 * share:.0f}"] = (close(abs(late["chain"]) / 100, 0.01), late)
    threshold = SHARES[0] * float(steps["consistent"][0]["peak_slip_velocity"][-1])
    ends = {name: [fixed_front(steps[name][i], threshold) for i in (0, -1)]
            for name in ("consistent", "chain")}
    fixed = {name: 100 * (1 - last / first) for name, (first, last) in ends.items()}
    verdict = close(abs(fixed["chain"]) / 100, 0.01)
    return found | {"observed_fixed": (verdict, fixed | {"threshold": threshold})}


def leading(runs, steps) -> dict:
    """Tests V+, the velocity of the foremost dislocation."""
    def at(stress):
        changes = [{"friction.law": "viscous", "friction.coefficient": c,
                    "initial.stress_left": stress} for c in (0.0, 2.0)]
        found = runs.many("fronts", [("step.toml", change) for change in changes])
        return slowed({"": found}, "leading_front")[""]

    late = slowed(steps, "leading_front")
    return {"leading": (close(late["chain"] / 100, 0.01), late | {"low": at(0.6), "high": at(1.3)})}


def into_stress() -> dict:
    """Tests V- and V+ against Sigma+ without friction, with the exact Riemann problem."""
    rights = (0.0, 0.01, 0.05, 0.179, 0.427, 0.6, 0.8, 0.85)
    exact = slipfront.relations(stress=[0.855] * len(rights), stress_right=rights)
    rupture, lead, ratio = (exact[name].values for name in ("rupture_velocity", "leading_velocity",
                                                            "velocity_ratio"))
    drops = [100 * (1 - right / 0.855) for right in rights]
    rise = lead[4] / lead[2]
    return {"right_rupture": (EXACT,
                              {"rupture": rupture[0], "off": abs(rupture / rupture[0] - 1).max()}),
            "right_leading": (judged((numpy.diff(lead) > 0).all()),
                              {"first": lead[0], "at_179": lead[3], "at_427": lead[4],
                               "last": lead[-1]}),
            "right_equal": (judged(abs(ratio[-1] - 1) < 0.02),
                            {"before": ratio[-2], "drop_before": drops[-2], "last": ratio[-1],
                             "drop": drops[-1]}),
            "right_shape": (judged(rise < 1.1), {"rise": 100 * (rise - 1)})}


def larger() -> dict:
    """Compares both edges without friction, for a pulse into the empty side."""
    ratio = slipfront.relations(stress=numpy.geomspace(0.05, 50, 200))["velocity_ratio"].values
    slow, fast = (relation("velocity_ratio", rupture_velocity=v) for v in (1e-7, 0.55))
    falls = bool((numpy.diff(ratio) < 0).all())
    return {"larger": (judged(ratio.min() > 1), {"most": ratio.max(), "least": ratio.min()}),
            "larger_slow": (judged(slow > 5 and falls), {"slow": slow, "fast": fast}),
            "larger_fall": (judged(falls), {"rupture": orders("rupture_velocity", 0.1),
                                            "leading": orders("leading_velocity", 0.1)})}


def dislocations() -> dict:
    x = numpy.linspace(-1, 1, 20001)
    data = slipfront.train.profile(1.03, x)
    U = data["U"].values[(x > data.attrs["left_edge"]) & (x < data.attrs["right_edge"])]
    lead = relation("leading_velocity", stress=1.03)
    return {"dislocations": (EXACT, {"least": U.min(), "most": U.max(), "lead": lead})}


def with_friction(steps) -> dict:
    """Tests how the slip velocity depends on friction."""
    left = {name: 100 * at_origin(found[-1]) / at_origin(found[0]) for name, found in steps.items()}
    tops = {name: [float(run["peak_slip_velocity"][-1]) for run in found]
            for name, found in steps.items()}
    least = min(float(numpy.diff(values).max()) for values in tops.values())
    words = ", ".join(f"{top:.4f}" for top in tops["chain"])
    return {"friction": (judged(max(left.values()) < 90), left),
            "friction_peak": (judged(least < 0), {"tops": words})}


def stress_dependence(found) -> dict:
    """Tests how the ratio of Fig. 10 depends on Sigma-."""
    at = found["curves"]["slip_velocity_ratio"].sel(friction_coefficient=0.5)
    low, high = ({closure: float(at.sel(closure=closure, stress=stress)) for closure in CLOSURES}
                 for stress in (0.419, 0.855))
    change = {closure: 100 * (max(high[closure] / low[closure], low[closure] / high[closure]) - 1)
              for closure in CLOSURES}
    free = relation("slip_velocity", stress=0.855) / relation("slip_velocity", stress=0.419)
    return {"stress_weakly": (judged(max(change.values()) < 30), change | {"free": free}),
            "stress_larger": (judged(high["consistent"] < low["consistent"]),
                              {"low": low, "high": high})}


def against_drop(found) -> dict:
    """Tests how W(0) depends on the stress drop (Fig. 12)."""
    W, free = (found["drops"][name].sel(stress=0.855)
               for name in ("slip_velocity_at_origin", "without_friction"))
    share, exact = W / W.sel(stress_drop=1.0), free / free.sel(stress_drop=1.0)
    at = {drop: {"exact": 100 * float(exact.sel(stress_drop=drop)),
                 **{closure: 100 * float(share.sel(stress_drop=drop, closure=closure))
                    for closure in CLOSURES}} for drop in (0.35, 0.4, 0.05)}
    none = float(abs(W.sel(stress_drop=0.0)).max())
    vanishes = none < 1e-12 and max(at[0.05].values()) < 25
    return {**{f"drop_{100 * drop:.0f}": (judged(min(at[drop].values()) > 95), at[drop])
               for drop in (0.35, 0.4)}, "drop_0": (judged(vanishes), at[0.05] | {"none": none}),
            "drop_none": (EXACT, {"none": none})}


def place_of_peak(steps) -> dict:
    """Tests W from edge to edge, and the position of its peak."""
    W = slipfront.train.profile(1.03, numpy.linspace(-0.6, 0.2, 8001))
    edges = [W.attrs["left_edge"] + 1e-9, W.attrs["right_edge"] - 1e-9]
    left, right = slipfront.train.profile(1.03, edges)["W"].values
    top = float(W["x_over_t"][int(W["W"].values.argmax())])
    weak, strong = (at_origin(run, "peak_position") for run in steps["chain"][2:])
    return {"peak": (EXACT, {"top": top, "left": left, "right": right, "weak": weak,
                             "strong": strong})}


def profile_width(runs) -> dict:
    """Compares W(0) for two widths of the initial profile, early and late."""
    changes = {"friction.closure": "consistent", "time.end": 40.0, "output.every": 2 * numpy.pi}
    narrow, wide = (run["slip_velocity_at_origin"] for run in runs.many(
        "widths", [("fig-07.toml", changes | {"initial.width": width}) for width in (0.1, 1.0)]))
    early, end = (abs(float(wide[i] / narrow[i]) - 1) for i in (1, -1))
    moved = 2 * numpy.pi * relation("leading_velocity", stress=0.855)
    return {"width": (close(end, 0.02), {"early": 100 * early, "end": 100 * end, "moved": moved})}


def smoothness(steepest) -> dict:
    """Tests the largest slope of the stress (Fig. 9)."""
    words = {closure: ", ".join(f"{float(value):.2f}" for value in steepest.sel(closure=closure))
             for closure in (*CLOSURES, "chain")}
    return {"smoothness": (judged((steepest.diff("friction_coefficient") < 0).all()), words)}


def stability(runs, steps) -> dict:
    """Tests the paper's reason for a smooth profile and Sigma+ > 0."""
    W = at_origin(runs.pulse("step.toml",
                             {"friction.law": "viscous", "friction.coefficient": 0.5,
                              "friction.closure": "consistent", "pulse.threshold": SHARES[0]}))
    off = W / at_origin(steps["chain"][2]) - 1
    return {"stability": (judged(abs(off) >= 0.01), {"W": W, "off": 100 * off})}


def averages(steps) -> dict:
    """Compares Whitham's averages with every dislocation."""
    slip = {name: [at_origin(run, "slip_at_origin") for run in found]
            for name, found in steps.items()}
    off = {closure: max(abs(theory / chain - 1) for theory,
                        chain in zip(slip[closure], slip["chain"])) for closure in CLOSURES}
    attrs = steps["chain"][2].attrs
    clock, percent = attrs["wall_seconds"], {name: 100 * value for name, value in off.items()}
    return {"practicable": (judged(clock > 3600),
                            {"dislocations": attrs["dislocations"], "seconds": clock}),
            "averages": (close(off["consistent"], 0.02), percent)}


def uniform() -> dict:
    phi, psi, step = math.atanh(0.3), float(slipfront.train.psi_at_rest(0.855)), 1e-3
    x = numpy.linspace(0, 10, 1001)
    u = {(i, j): slipfront.train.fields(phi, psi, x + i * step - 0.3 * j * step)["u"].values
         for i, j in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))}
    residual = ((u[0, 1] + u[0, -1] - u[1, 0] - u[-1, 0]) / step**2 + numpy.sin(u[0, 0]))
    spacing = float(slipfront.train.spacing(phi, psi))
    fields = slipfront.train.fields(phi, psi, numpy.linspace(0, spacing, 4001)[:-1])
    mean = float(fields["w"].mean() / (0.3 * fields["sigma"].mean())) - 1
    return {"uniform": (EXACT, {"residual": abs(residual).max()}),
            "average_w": (EXACT, {"off": abs(mean)})}


def peaks(stress) -> list:
    """Returns the largest stress 2 cosh(phi) cosh(psi) of a dislocation at an edge and at x = 0."""
    state = slipfront.relations(stress=[stress]).isel(state=0)
    velocity, psi = (float(state[name]) for name in ("dislocation_velocity_at_origin", "psi"))
    return [2 * math.cosh(psi),  # phi + psi = psi-, one of them 0
            2 / math.sqrt(1 - velocity**2) * math.cosh(float(state["psi_at_origin"]))]


def energy(contact_ratio, sites) -> float:
    """Returns the energy of one dislocation at rest; odd `sites` have it on a site."""
    u = static_chain(contact_ratio, sites)
    return float((numpy.diff(u) ** 2).sum() / (2 * contact_ratio**2) + (1 - numpy.cos(u)).sum())


def dislocation(given) -> dict:
    sizes = [2 * math.pi / given[key]
             for key in ("parkfield_contact_ratio_0", "parkfield_contact_ratio_2.0",
                         "ets_contact_ratio")]
    inside = all(given["width_least"] <= size <= given["width_most"] for size in sizes)
    share = 1 - 4 / math.pi * math.atan(math.exp(-math.pi))
    forces = [(energy(contact, 81) - energy(contact, 82)) / 2 for contact in (0.5, 0.4)]
    ets, parkfield = (max(peaks(stress)) / 2 - 1 for stress in (0.212, 1.03))
    return {"dislocation": (judged(share > 0.9), {"share": 100 * share, "half": 2 * math.acosh(2)}),
            "dislocation_size": (judged(inside), {"sizes": sizes}),
            "dislocation_stress": (close(parkfield, 0.05),
                                   {"parkfield": 100 * parkfield, "ets": 100 * ets}),
            "dislocation_force": (judged(max(forces) < 1e-3), {"forces": forces})}


def decades() -> dict:
    starts = (0.1, relation("stress", rupture_velocity=numbers.SLOWEST), 0.2117, 0.3)
    V, W = ([orders(key, stress) for stress in starts]
            for key in ("rupture_velocity", "slip_velocity"))
    words = {name: ", ".join(f"{value:.3g}" for value in values)
             for name, values in (("starts", starts), ("V", V), ("W", W))}
    return {"stress_ratio": (EXACT, {"times": 1 / math.sqrt((1 - 0.3) / 2)}),
            "decades": (judged(min(V) < 7 < max(V) and min(W) < 7 < max(W)), words)}


def covers() -> dict:
    c = numbers.event("parkfield-2004.toml", "c_m_s")
    slow = relation("slip_velocity", rupture_velocity=numbers.SLOWEST) * (c * 4e-5 / math.pi)
    fast = relation("rupture_velocity", slip_velocity=1 / (c * 0.0029 / math.pi))
    return {"covers": (judged(0.1 < slow / 1e-7 < 10),
                       {"fast": fast, "slow": slow, "needs": 4e-5 * 1e-7 / slow})}


def events(values) -> dict:
    """Tests Parkfield's 31 MPa, and friction in slow events."""
    stress, observed = values["parkfield_stress_mpa_0"], values["ets_observed_slip_velocity"]
    share = stress / 31

    def friction(closure):
        found = slipfront.damping_number(1.03, share, closure=closure)
        return float(found["damping_number"]) / (2 * math.pi)

    ratio = {closure: [float(slipfront.friction_ratio(stress, math.pi, closure=closure)["ratio"])
                       for stress in (0.2117, 1.03)] for closure in CLOSURES}
    needs, W = relation("stress", slip_velocity=observed), relation("slip_velocity", stress=0.212)
    return {"parkfield": (close(1 - share, 0.1), {"stress": stress, "less": 100 * (1 - share)}),
            "parkfield_friction": (UNTESTED, {"left": 100 * share, "share": share,
                                              **{name: friction(name) for name in CLOSURES}}),
            "slow": (judged(ratio["consistent"][0] < ratio["consistent"][1]), ratio),
            "slow_stress": (judged(needs >= 0.212), {"W": W, "observed": observed, "needs": needs}),
            "threshold": (UNTESTED, {})}


def table(runs, found, paper, stress) -> list:
    """Returns the rows. found: of pipeline.computed. stress: the data of Fig. 9."""
    steps = step_runs(runs)
    verdicts = {**trailing(runs, steps), **leading(runs, steps), **into_stress(), **larger(),
                **dislocations(), **with_friction(steps), **stress_dependence(found),
                **against_drop(found), **place_of_peak(steps), **profile_width(runs),
                **smoothness(stress["steepest"]), **stability(runs, steps), **decades(),
                **averages(steps), **uniform(), **dislocation(numbers.taken(paper)), **covers(),
                **events(found["values"])}
    rows = []
    for key, texts in tomllib.loads(STATEMENTS.read_text(encoding="utf-8")).items():
        verdict, facts = verdicts[key]
        texts = {name: text.format(**COMMANDS, **facts) for name, text in texts.items()}
        rows.append({**{name: texts[name] for name in ("statement", "where")}, "verdict": verdict,
                     **{name: texts[name] for name in ("found", "range", "command")}})
    return rows
