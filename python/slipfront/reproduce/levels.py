"""The three levels of the theory side by side: closed form, pulse and chain."""

from typing import Any

import slipfront

from .runs import CASES

SCALE = 1000  #: of the chain: so many times the dislocations
COEFFICIENTS = (0, 0.1, 0.5, 2)


def table(threads) -> dict:
    """Slip at x = 0 by t = 2 pi of a step of 0.855 that meets an empty interface, on each level.

    Returns {"rows", "scale", "worst", "paper", "command"}: rows of friction_coefficient,
    damping_number, closed_form (None with friction), consistent, chain, paper (b / (2 pi)), and
    consistent_off and paper_off, relative to the chain; the largest of each.
    """
    rows: list[dict[str, Any]] = []
    for coefficient in COEFFICIENTS:
        changes = {"friction.law": "viscous", "friction.coefficient": coefficient}
        levels = slipfront.compare(CASES / "step.toml", scales=[SCALE], set=changes,
                                   threads=threads)
        end = levels["slip_at_origin"].isel(time=-1)
        slip = {name: float(value) for name, value in zip(levels["name"].values, end.values)}
        chain, consistent, paper = (slip[name] for name in (
            f"chain-{SCALE}", "pulse-consistent", "pulse-paper"))
        rows.append({"friction_coefficient": coefficient, "chain": chain, "consistent": consistent,
                     "paper": paper, "damping_number": coefficient * float(levels["time"][-1]),
                     "closed_form": slip.get("closed-form"),
                     "consistent_off": consistent / chain - 1, "paper_off": paper / chain - 1})
    return {"rows": rows, "scale": SCALE, "worst": max(abs(row["consistent_off"]) for row in rows),
            "paper": max(row["paper_off"] for row in rows),
            "command": "slipfront compare cases/step.toml --set friction.law=viscous --set "
            f"friction.coefficient={COEFFICIENTS[2]} --scale {SCALE}"}
