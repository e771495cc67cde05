"""Formulas that are printed with a slip, and what each form gives."""

import math

import numpy

from .. import medium
from .derived import relation
from .numbers import taken


def unit_of_force(paper) -> tuple:
    """Traction of F = 1 in MPa, at the contact ratio that the paper finds for Parkfield without friction."""
    given = taken(paper)
    contact_ratio, modulus, nu = given["parkfield_contact_ratio_0"], 1e9 * given["shear_modulus_gpa"], given["poisson_ratio"]
    return medium.printed_traction_unit(modulus, contact_ratio) / 1e6, medium.traction_unit(modulus, nu, contact_ratio) / 1e6


def table(paper) -> list:
    """Rows: where, printed, mended (formulas), check, by_printed, by_mended (numbers, or None where there is none to give)."""
    stress = taken(paper)["parkfield_stress"]
    velocity, density = (relation(key, stress=stress) for key in ("dislocation_velocity_at_origin", "stress_at_origin"))
    per_length = density / (2 * math.pi)  # N
    cn = numpy.array([1.0, -1.0])  # from one side of a dislocation to the other, half a period of cn
    across = -numpy.diff(numpy.arcsin(cn))[0] / (2 * math.pi)
    both = {
        "slip_of_one": (across, 2 * across),
        "slip_velocity": (velocity * per_length / (2 * math.pi), 2 * math.pi * velocity * per_length),
        "unit_of_force": unit_of_force(paper),
        "trailing_edge": (-1.0, -relation("rupture_velocity", stress=stress)),
    }
    rows = []
    for formula in paper["formula"]:
        by_printed, by_mended = both.get(formula.get("key"), (None, None))
        rows.append({name: formula[name] for name in ("where", "printed", "mended", "check")} | {"by_printed": by_printed, "by_mended": by_mended})
    return rows
