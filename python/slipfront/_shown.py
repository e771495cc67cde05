"""Values as error messages show them."""


def shown(value, most=80):
    """The value as text of at most `most` characters, or its type if it is nested too deeply."""
    try:
        text = str(value)
    except (RecursionError, ValueError):  # the second: an int of more digits than Python prints
        return f"a {type(value).__name__} that is nested too deeply or too long"
    return text if len(text) <= most else text[:most - 3] + "..."


def shortened(text, most=2000, part=800):
    """The text without the middle of lines longer than `most`: the ends have name and reason."""
    return "\n".join(line if len(line) <= most else f"{line[:part]}...{line[-part:]}"
                     for line in text.split("\n"))
