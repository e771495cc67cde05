"""Rows and verdicts of the table of statements."""

CONFIRMED, REFUTED, EXACT, UNTESTED = "Confirmed", "Refuted", "Exact by construction", "Cannot be tested here"


def row(statement, where, verdict, found, tried, command) -> dict:
    """Returns a row: the paper's statement, its section, the verdict, the finding, the range of parameters tried, the command that shows it."""
    return {"statement": statement, "where": where, "verdict": verdict, "found": found, "range": tried, "command": command}


def judged(holds) -> str:
    """Returns the verdict on a statement that holds or does not."""
    return CONFIRMED if holds else REFUTED


def within(deviation) -> str:
    """Returns the verdict "Confirmed" with the deviation from exact, given as a fraction."""
    return f"Confirmed within {100 * deviation:.2g} %"


def close(deviation, most) -> str:
    """Returns the verdict "Confirmed within" `deviation` if that is at most `most`, otherwise "Refuted". Both are fractions."""
    return within(deviation) if deviation <= most else REFUTED
