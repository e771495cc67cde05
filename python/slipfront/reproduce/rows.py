"""A row of the table of statements."""

CONFIRMED, REFUTED, EXACT, UNTESTED = "Confirmed", "Refuted", "Exact by construction", "Cannot be tested here"


def row(statement, where, verdict, found, tried, command) -> dict:
    """A row: the paper's statement, its place there, the verdict, what was found, the range tried, the command that shows it."""
    return {"statement": statement, "where": where, "verdict": verdict, "found": found, "range": tried, "command": command}


def judged(holds) -> str:
    """Confirmed or Refuted."""
    return CONFIRMED if holds else REFUTED


def within(deviation) -> str:
    """A verdict with how far from exact."""
    return f"Confirmed within {100 * deviation:.2g} %"


def close(deviation, most) -> str:
    """Confirmed within `deviation` (a share of 1) if that is at most `most`, else refuted."""
    return within(deviation) if deviation <= most else REFUTED
