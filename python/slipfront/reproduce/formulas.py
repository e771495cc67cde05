"""Table of the misprinted formulas, with numbers by the printed and corrected forms."""

import math

import numpy

from .. import medium
from .derived import relation
from .numbers import taken


def unit_of_force(paper) -> tuple:
    """Returns F = 1 in MPa by the printed and corrected formula, at Parkfield's A."""
    given = taken(paper)
    contact_ratio, modulus, nu = (given["parkfield_contact_ratio_0"],
                                  1e9 * given["shear_modulus_gpa"], given["poisson_ratio"])
    return (medium.printed_traction_unit(modulus, contact_ratio) / 1e6,
            medium.traction_unit(modulus, nu, contact_ratio) / 1e6)


def table(paper) -> list:
    """Returns the rows of the table: where, printed and `mended` (the corrected formula), check,
    by_printed and by_mended (the numbers that the two give, or None if there is none)."""
    stress = taken(paper)["parkfield_stress"]
    velocity, density = (relation(key, stress=stress)
                         for key in ("dislocation_velocity_at_origin", "stress_at_origin"))
    per_length = density / (2 * math.pi)  # N
    cn = numpy.array([1.0, -1.0])  # cn on the two sides of a dislocation, half a period apart
    across = -numpy.diff(numpy.arcsin(cn))[0] / (2 * math.pi)
    both = {"slip_of_one": (across, 2 * across),
            "slip_velocity": (velocity * per_length / (2 * math.pi),
                              2 * math.pi * velocity * per_length),
            "unit_of_force": unit_of_force(paper),
            "trailing_edge": (-1.0, -relation("rupture_velocity", stress=stress))}
    rows = []
    for formula in paper["formula"]:
        by_printed, by_mended = both.get(formula.get("key"), (None, None))
        rows.append({name: formula[name] for name in ("where", "printed", "mended", "check")}
                    | {"by_printed": by_printed, "by_mended": by_mended})
    return rows
