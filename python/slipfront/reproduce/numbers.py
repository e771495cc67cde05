"""Every number that the paper prints, computed."""

import decimal
import math
import pathlib
import tomllib

import slipfront

from .runs import CASES, at_origin

PAPER = pathlib.Path(__file__).with_name("paper.toml")


def printed() -> dict:
    """paper.toml: the paper's inputs, numbers and formulas as printed."""
    return tomllib.loads(PAPER.read_text(encoding="utf-8"))


def event(name, key) -> float:
    """A quantity of the one event in a case file."""
    return float(slipfront.event(str(CASES / name))[key].values.ravel()[0])


def relation(wanted, **given) -> float:
    """One quantity of the closed form."""
    return float(slipfront.relations(**{key: [value] for key, value in given.items()})[wanted].values[0])


def computed(runs, paper, factors, width) -> dict:
    """key of paper.toml -> value, and the facts that its remarks quote.

    factors, width: of widths.py.
    """
    inputs = paper["inputs"]
    c = event("parkfield-2004.toml", "c_m_s")
    values = {"c": c / 1000, "parkfield_rupture_velocity": event("parkfield-2004.toml", "rupture_velocity"),
              "parkfield_stress": relation("stress", rupture_velocity=inputs["rupture_velocity"]),
              "velocity_at_printed_stress": relation("rupture_velocity", stress=inputs["stress"])}
    slip_velocities = {"0": relation("slip_velocity", stress=inputs["stress"])}
    values["parkfield_slip_velocity"] = slip_velocities["0"]
    for coefficient in inputs["friction"]:
        run = runs.pulse("fig-10.toml", {"friction.coefficient": coefficient})
        slip_velocities[str(coefficient)] = values[f"parkfield_slip_velocity_{coefficient}"] = at_origin(run)
    without = at_origin(runs.pulse("fig-10.toml", {"friction.coefficient": 0}))
    values["scaled"] = ", ".join(f"{slip_velocities[str(coefficient)] / without * slip_velocities['0']:.4f}" for coefficient in inputs["friction"])
    for key, slip_velocity in slip_velocities.items():
        contact_ratio = math.pi * inputs["slip_velocity_m_s"] / (c * slip_velocity)  # the unit of W is c A / pi
        values[f"parkfield_contact_ratio_{key}"] = contact_ratio
        values[f"parkfield_stress_pa_{key}"] = inputs["shear_modulus_pa"] * contact_ratio * inputs["stress"] / math.pi / 1e6
    values |= {"ets_rupture_velocity": event("ets.toml", "rupture_velocity"), "ets_stress": event("ets.toml", "stress"),
               "ets_velocity_rounded": event("ets.toml", "rupture_velocity") * c / (1000 * inputs["c_km_s"]),
               "ets_slip_velocity": relation("slip_velocity", stress=inputs["ets_stress"]),
               "ets_slip_velocity_exact": event("ets.toml", "frictionless_slip_velocity"),
               "ets_observed_slip_velocity": event("ets.toml", "observed_slip_velocity")}
    by_width = factors["factor"].sel(closure="paper")
    for coefficient in inputs["friction"][1:]:
        values[f"fig_8_factor_{coefficient}"] = float(by_width.sel(coefficient=coefficient, width=width))
    strongest = by_width.sel(coefficient=inputs["friction"][-1])
    return values | {"width": width, "factor_narrow": float(strongest[0]), "factor_wide": float(strongest[-1]),
                     "width_narrow": float(strongest["width"][0]), "width_wide": float(strongest["width"][-1])}


def table(paper, values) -> list:
    """Rows of the table: what, unit, printed (as text), computed, difference (relative), agrees to the printed digits, remark."""
    rows = []
    for number in paper["number"]:
        value, text = values[number["key"]], number["printed"]
        last_digit = decimal.Decimal(text).as_tuple().exponent
        agrees = abs(value - float(text)) <= 0.5 * 10.0**last_digit * (1 + 1e-9)
        rows.append({"what": number["what"], "unit": number["unit"], "printed": text, "computed": value, "difference": value / float(text) - 1,
                     "agrees": agrees, "remark": number.get("remark", "").format(**values)})
    return rows
