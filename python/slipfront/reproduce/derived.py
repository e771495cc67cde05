"""How the paper gets numbers from others: a formula takes printed or computed ones."""

import dataclasses
import math
from collections.abc import Callable
from typing import Any

from .. import relations


@dataclasses.dataclass(frozen=True)
class Rule:
    """A number as a function of others. names: keys of paper.toml, in order."""

    names: tuple
    value: Callable


def relation(wanted, **given) -> float:
    """One quantity of the closed form (Eqs. 8-10)."""
    arguments: dict[str, Any] = {key: [value] for key, value in given.items()}
    return float(relations(**arguments)[wanted].values[0])


def contact_ratio(slip_velocity_m_s, c, slip_velocity):
    """A from a slip velocity in m/s, c in km/s and W in c A / pi."""
    return math.pi * slip_velocity_m_s / (1000 * c * slip_velocity)


def stress_mpa(modulus_gpa, contact_ratio, stress):
    """Stress in MPa from mu in GPa, A and Sigma- in mu A / pi."""
    return 1000 * modulus_gpa * contact_ratio * stress / math.pi


def scaled(stress, slip_velocity_0, slip_velocity):
    """Stress with friction from that without: in proportion to 1 / W."""
    return stress * slip_velocity_0 / slip_velocity


def rules() -> dict:
    """Returns {key: rules}, the paper's formula first, then other ways to its number."""
    def free(stress):
        return relation("slip_velocity", stress=stress)

    def observed(slip, weeks, c, a):
        return math.pi * slip * 1e-6 / (weeks * 604800) / (c * a)

    found = {
        "parkfield_rupture_velocity": [Rule(("rupture_velocity_km_s", "c"), lambda v, c: v / c)],
        "ets_rupture_velocity": [Rule(("ets_rupture_km_day", "c"), lambda v, c: v / 86400 / c)],
        "ets_slip_velocity": [Rule(("ets_stress",), free), Rule(("ets_stress_caption",), free)],
        "ets_observed_slip_velocity": [
            Rule(("ets_slip_mm", "ets_weeks", "c", "ets_contact_ratio"), observed)],
        "ets_share": [
            Rule(("ets_observed_slip_velocity", "ets_slip_velocity"), lambda w, w0: w / w0)]}
    for c in ("0", "0.1", "0.5", "2.0"):
        W = "parkfield_slip_velocity" + (f"_{c}" if c != "0" else "")
        A, stress = f"parkfield_contact_ratio_{c}", f"parkfield_stress_mpa_{c}"
        found[A] = [Rule(("slip_velocity_m_s", "c", W), contact_ratio)]
        found[stress] = [Rule(("shear_modulus_gpa", A, "parkfield_stress_used"), stress_mpa)]
        if c != "0":
            names = "parkfield_stress_mpa_0", "parkfield_slip_velocity", W
            found[stress].append(Rule(names, scaled))
    return found


def apply(rule, values) -> float:
    return rule.value(*(values[name] for name in rule.names))


def quoted(rule, texts) -> str:
    return ", ".join(texts[name] for name in rule.names)
