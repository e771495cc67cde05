"""Links from scenarios in the documentation to the explorer, which opens with the scenario."""
import tomllib
from urllib.parse import quote

from docutils import nodes


def route_of(text: str) -> str | None:
    """The address within the explorer that shows a scenario; None if it has no scenario that the explorer can show."""
    try:
        scenario = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return None
    if "initial" not in scenario or "loading" in scenario or "plane" in scenario or "file" in scenario["initial"]:
        return None
    values = {"title": scenario.get("title", "")}
    for table, entries in scenario.items():
        if table in ("title", "event"):
            continue
        for key, value in entries.items():
            values[f"{table}.{key}"] = str(value).lower() if isinstance(value, bool) else str(value)
    return "#/pulse?" + "&".join(f"{quote(key)}={quote(value)}" for key, value in values.items() if value)


def add_links(app, doctree):
    """Adds a link below each block with a scenario, and below the picture of the home page and of the explorer's page."""
    above = "../" * app.env.docname.count("/")
    if app.env.docname in ("index", "docs/explorer"):
        picture = next(iter(doctree.findall(nodes.image))).parent
        link = nodes.reference("", "Open the explorer: the theory live in your browser", refuri=f"{above}explorer/index.html")
        picture.parent.insert(picture.parent.index(picture) + 1, nodes.paragraph("", "", link))
    for block in list(doctree.findall(nodes.literal_block)):
        route = route_of(block.astext()) if block.get("language") == "toml" else None
        if route is None:
            continue
        link = nodes.reference("", "Open this scenario in the explorer", refuri=f"{above}explorer/index.html{route}")
        block.parent.insert(block.parent.index(block) + 1, nodes.paragraph("", "", link))


def setup(app):
    app.connect("doctree-read", add_links)
