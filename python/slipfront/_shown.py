"""Values as error messages show them."""


def shown(value, most=80):
    """The value as text, cut to some characters. One that is nested too deeply to be printed is shown as its type."""
    try:
        text = str(value)
    except (RecursionError, ValueError):  # the second: an int of more digits than Python prints
        return f"a {type(value).__name__} that is nested too deeply or too long"
    return text if len(text) <= most else text[:most - 3] + "..."


def shortened(text, most=2000, part=800):
    """The text with lines of at most `most` characters. A longer one loses its middle: a message begins with the name of a file, which may
    be long, and ends with the reason."""
    return "\n".join(line if len(line) <= most else f"{line[:part]}...{line[-part:]}" for line in text.split("\n"))
