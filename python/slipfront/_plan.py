"""The result of slipfront.check."""

import html


class Plan(dict):
    """The plan of a run as a dict. A notebook shows it as a table."""

    def _repr_html_(self):
        rows = "".join(
            f"<tr><th>{html.escape(str(key))}</th><td>{html.escape(_text(key, value))}</td></tr>"
            for key, value in self.items())
        return f"<table>{rows}</table>"


def _text(key, value):
    if key.endswith("_bytes"):
        size, unit = next(((value / 10**power, unit)
                           for power, unit in ((9, "GB"), (6, "MB"), (3, "kB"))
                           if value >= 10**power), (value, "bytes"))
        return f"{size:.3g} {unit}"
    if isinstance(value, dict):
        return ", ".join(f"{name} = {_text(name, one)}" for name, one in value.items()) or "none"
    if isinstance(value, float):
        return f"{value:.6g}"
    return "none" if value is None else str(value)
