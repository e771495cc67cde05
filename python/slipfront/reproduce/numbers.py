"""Computes every number that the paper prints, and gives a verdict on each."""

import math
import pathlib
import tomllib


import slipfront

from . import derived, verdicts
from .derived import relation

PAPER = pathlib.Path(__file__).with_name("paper.toml")

#: Friction coefficients C of the paper's figures. The names of its numbers contain them.
FRICTION = (0.1, 0.5, 2.0)

#: Velocity of the slowest rupture in the paper, in c. The paper's range of velocities begins here.
SLOWEST = 1e-7


def printed() -> dict:
    """Returns the content of paper.toml: the paper's inputs, numbers and formulas as printed."""
    return tomllib.loads(PAPER.read_text(encoding="utf-8"))


def texts(paper) -> dict:
    """Returns {key: printed digits}. The Σ− of the stresses in MPa is that of Fig. 5."""
    found = {row["key"]: row["printed"] for row in paper["input"] + paper["number"] if "key" in row}
    return found | {"parkfield_stress_used": found["parkfield_stress"]}


def taken(paper) -> dict:
    """Returns {key: value} of those inputs and numbers that are plain numbers."""
    return {key: float(text)
            for key, text in texts(paper).items() if key not in ("range_of_forces", "time")}


def event(name, key) -> float:
    return float(slipfront.event(str(slipfront.cases / name))[key].values.ravel()[0])


def orders(key, stress) -> float:
    """Returns the orders of magnitude of a velocity over a decade of stress from `stress`."""
    return math.log10(relation(key, stress=10 * stress) / relation(key, stress=stress))


def peak_stress(stress=1e-1) -> float:
    """Returns the largest stress of a single dislocation at rest (Eq. 4)."""
    psi = float(slipfront.train.psi_at_rest(stress))
    return float(slipfront.train.fields(0.0, psi, [0.0])["sigma"].max())


def closed_forms(paper) -> dict:
    """Returns the numbers without friction; of readings, from the other axis as printed."""
    given = taken(paper)
    decade = relation("stress", rupture_velocity=SLOWEST)
    parkfield = event("parkfield-2004.toml", "rupture_velocity")
    velocity, slip_velocity = (orders(name, decade) for name in ("rupture_velocity",
                                                                 "slip_velocity"))
    read = given["parkfield_rupture_velocity"]
    return {"neighbours": 2.0**3, "dislocation_stress": peak_stress(),
            "orders_of_range": math.log10(parkfield / SLOWEST),
            "orders_of_events": math.log10(parkfield / event("ets.toml", "rupture_velocity")),
            "orders_of_velocity": velocity, "orders_of_velocity_caption": velocity,
            "orders_of_slip_velocity": slip_velocity, "decade_from": decade,
            "orders_low": orders("rupture_velocity", 0.1),
            "orders_high": orders("rupture_velocity", 0.3),
            "c": event("parkfield-2004.toml", "c_m_s") / 1000,
            "parkfield_stress": relation("stress", rupture_velocity=read),
            "velocity_at_printed_stress":
                relation("rupture_velocity", stress=given["parkfield_stress"]),
            "parkfield_slip_velocity": relation("slip_velocity", stress=given["parkfield_stress"]),
            "ets_stress": event("ets.toml", "stress"),
            "ets_slip_velocity": relation("slip_velocity", stress=given["ets_stress"]),
            "ets_slip_velocity_exact": event("ets.toml", "frictionless_slip_velocity"),
            "ets_stress_caption": relation("stress", slip_velocity=given["ets_slip_velocity"])}


def figure_8(factors, width) -> dict:
    """Returns the factors of Fig. 8 at the best width and at the ends of the widths."""
    by_width = factors["factor"].sel(closure="paper")
    strongest = by_width.sel(coefficient=FRICTION[-1])
    values = {f"fig_8_factor_{c}": float(by_width.sel(coefficient=c, width=width))
              for c in FRICTION[1:]}
    return values | {"fall_of_amplitude": values[f"fig_8_factor_{FRICTION[-1]}"], "width": width,
                     "factor_narrow": float(strongest[0]), "factor_wide": float(strongest[-1]),
                     "width_narrow": float(strongest["width"][0]),
                     "width_wide": float(strongest["width"][-1])}


def list_of(values) -> str:
    return ", ".join(f"{float(value):.3f}" for value in values)


def figure_10(ratio, curves, without) -> dict:
    """Returns the numbers that the paper reads off Fig. 10, with friction.

    ratio: from ratios.py. curves: from sweeps.ratios. without: W(0) of Parkfield at C = 0.
    """
    at = {"closure": "paper", "friction_coefficient": list(FRICTION)}
    smooth = ratio["smooth"].sel(at)
    values = {f"parkfield_slip_velocity_{c}": without * float(smooth.sel(friction_coefficient=c))
              for c in FRICTION}
    solid = curves["slip_velocity_ratio"].sel(closure="paper", stress=0.855)
    return values | {"ratio_width": float(ratio.attrs["width"]),
                     "ratios_at_parkfield": list_of(ratio["at_parkfield"].sel(at)),
                     "ratios_step": list_of(solid.sel(friction_coefficient=list(FRICTION))),
                     "ratios_step_stressed": list_of(ratio["step_stressed"].sel(at)),
                     "ratios_consistent":
                         list_of(ratio["smooth"].sel(at | {"closure": "consistent"})),
                     "ets_friction": read_friction(0.855, 0.2),
                     "ets_friction_nearest": read_friction(0.419, 0.2)}


def read_friction(stress, ratio, closure="paper") -> float:
    """Returns the C at which a curve of Fig. 10 has this ratio, for a true step."""
    return float(slipfront.damping_number(stress, ratio,
                                          closure=closure)["damping_number"]) / (2 * math.pi)


def friction_of_event(share) -> dict:
    """Returns C of the ETS event from its ratio `share` at t = 2π, for both closures."""
    return {f"ets_friction_{closure}": read_friction(event("ets.toml", "stress"), share, closure)
            for closure in ("paper", "consistent")}


def computed(paper, factors, width, ratio, curves) -> dict:
    """Returns {key of paper.toml: value}, and the values that its remarks quote."""
    values = taken(paper) | closed_forms(paper)
    values |= figure_8(factors, width)
    values |= figure_10(ratio, curves, values["parkfield_slip_velocity"])
    for key, rules in derived.rules().items():
        if key not in ("ets_slip_velocity",):  # closed_forms has computed it as a reading
            values[key] = derived.apply(rules[0], values)
    return values | friction_of_event(values["ets_share"])


def by_printed(key, paper) -> list:
    """Returns (value, remark) of each rule that gives this number from other printed numbers."""
    given, digits = taken(paper), texts(paper)
    found = []
    for rule in derived.rules().get(key, ()):
        value = derived.apply(rule, given)
        found.append((value, f"From the printed {derived.quoted(rule, digits)} it is {value:.4g}."))
    return found


def row_of(number, value, paper, facts) -> dict:
    """Returns a row of the table: what, where, unit, printed (text), computed, printed_digits (the
    computed value rounded like the printed one), difference (relative), verdict, remark."""
    how = verdicts.Printed(number["printed"], number.get("bound", ""),
                           tuple(number.get("axis", ())), number.get("log", False))
    ways = by_printed(number["key"], paper)
    verdict = verdicts.verdict(value, how, [other for other, _ in ways])
    words = [number.get("reason", ""), number.get("remark", "").format(**facts)]
    if verdict != verdicts.SAME:
        words[:0] = [text for _, text in ways]
    return {"what": number["what"], "where": number["where"], "unit": number["unit"],
            "printed": f"{how.bound} {how.text}".strip(), "computed": value,
            "printed_digits": verdicts.rounded(value, how.text),
            "difference": value / float(how.text) - 1, "verdict": verdict,
            "remark": " ".join(word for word in words if word)}


def table(paper, values) -> list:
    return [row_of(number, values[number["key"]], paper, values) for number in paper["number"]]


def counts(rows) -> dict:
    return {verdict: sum(row["verdict"] == verdict for row in rows)
            for verdict in (verdicts.SAME, verdicts.FOLLOWS, verdicts.READING, verdicts.WRONG)}
