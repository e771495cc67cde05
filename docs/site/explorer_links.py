"""Links from the documentation to the explorer, which opens with a scenario or at a panel."""
import re
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


#: The addresses of the panels that pages of the gallery name at the end of a paragraph.
PANELS = {"Pulse": "pulse", "Dislocations": "dislocations", "Stick-slip": "loading", "Fault plane": "plane",
          "Riemann": "riemann", "Stress and velocity": "stress"}


def add_links(app, doctree):
    """Adds a link below each block with a scenario, below the picture of the explorer's page, and to each panel that is
    named. On the home page the explorer replaces the picture."""
    above = "../" * app.env.docname.count("/")
    for paragraph in list(doctree.findall(nodes.paragraph)):
        if named := re.search(r"in the explorer: panel ([\w -]+)\.$", paragraph.astext()):
            address = f"{above}explorer/index.html#/{PANELS[named[1]]}"
            paragraph += [nodes.Text(" "), nodes.reference("", "Open it", refuri=address)]
    if app.env.docname == "index":
        picture = next(iter(doctree.findall(nodes.image))).parent
        live = ('<iframe class="explorer" src="explorer/index.html#/" loading="lazy" '
                'title="The explorer: the theory live in your browser"></iframe>')
        picture.replace_self([nodes.raw("", live, format="html")])
    if app.env.docname == "docs/explorer":
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
