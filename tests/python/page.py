"""Reads a page of HTML like a browser, and lists what it loads, the targets of its links, and errors of its form."""

from html.parser import HTMLParser

#: Elements without an end tag.
VOID = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}

#: The only address outside the page to which a link may lead.
DOI = "https://doi.org/10.3390/lubricants3020311"


class Page(HTMLParser):
    """loads: (tag, attribute, value) of resources outside the page. errors: faults of its form. figures: id -> texts of its <pre>."""

    def __init__(self, text):
        super().__init__()
        self.loads, self.errors, self.links, self.names, self.figures = [], [], [], [], {}
        self._open, self._figure = [], None
        self.feed(text)
        self.close()
        self.errors += [f"<{tag}> is not closed" for tag in self._open]
        self.errors += [f"id {name} occurs {self.names.count(name)} times" for name in set(self.names) if self.names.count(name) > 1]
        self.errors += [f"no id for link {link}" for link in self.links if link.startswith("#") and link[1:] not in self.names]

    def handle_startendtag(self, tag, attrs):
        self.look(tag, dict(attrs))

    def handle_starttag(self, tag, attrs):
        self.look(tag, dict(attrs))
        if tag not in VOID:
            self._open.append(tag)
        if tag == "figure":
            self._figure = self.figures.setdefault(dict(attrs)["id"], [])
        elif tag == "pre" and self._figure is not None:
            self._figure.append("")

    def handle_endtag(self, tag):
        if not self._open or self._open[-1] != tag:
            # HTML allows <p> and <li> without an end tag, but this page has all end tags.
            self.errors.append(f"</{tag}> closes {self._open[-1:]} at {self.getpos()}")
        else:
            self._open.pop()
        if tag == "figure":
            self._figure = None

    def handle_data(self, data):
        if self._open and self._open[-1] == "pre" and self._figure:
            self._figure[-1] += data

    def look(self, tag, attrs):
        """Records the id of an element, its links, and the resources that it loads."""
        if "id" in attrs:
            self.names.append(attrs["id"])
        for name in ("src", "srcset", "href", "xlink:href", "data", "action"):
            value = attrs.get(name)
            if value is None:
                continue
            if name.endswith("href") and (value.startswith("#") or value == DOI and tag == "a"):
                self.links.append(value)
            elif not value.startswith("data:"):
                self.loads.append((tag, name, value))
        self.loads += [(tag, "", "")] if tag in ("iframe", "object", "embed") else []
