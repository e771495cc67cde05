"""What the paper says in words, and what is found: verdict first, then the number, the range tried, the command."""

CONFIRMED, REFUTED, EXACT, UNTESTED = "Confirmed", "Refuted", "Exact by construction", "Cannot be tested here"


def row(statement, where, verdict, found, range_, command) -> dict:
    """A row of the table of statements."""
    return {"statement": statement, "where": where, "verdict": verdict, "found": found, "range": range_, "command": command}


def judged(holds) -> str:
    """Confirmed or Refuted."""
    return CONFIRMED if holds else REFUTED


def flat(found) -> dict:
    """W(0) against the stress drop."""
    W = found["drops"]["slip_velocity_at_origin"].sel(stress=0.855)
    share = W.sel(stress_drop=0.35) / W.sel(stress_drop=1.0)
    return row("W(0) does not depend on Σ+ for stress drops of 35 to 100 %", "3.3, Fig. 12", judged(float(share.min()) > 0.95),
               f"at 35 % W(0) is {100 * float(share.sel(closure='paper')):.0f} % (closure “paper”) and {100 * float(share.sel(closure='consistent')):.0f} % (consistent) of that at 100 %",
               "Σ− = 0.855, C = 0.1", "slipfront pulse cases/fig-12.toml --set initial.stress_right=0.556 --json")


def table(runs, found, pictures) -> list:
    """The rows."""
    return [flat(found)]
