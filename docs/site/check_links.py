"""Checks the links of a built site: check_links.py SITE. Every local link must lead to a file and an anchor in it, and
no page may load a script, style or picture from another host."""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"script": "src", "img": "src", "source": "src", "iframe": "src"}


class Page(HTMLParser):
    """Collects the anchors of a page, its links, and the addresses that it loads."""

    def __init__(self, path: Path):
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[tuple[int, str]] = []
        self.loaded: list[tuple[int, str]] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.anchors.update(found[key] for key in ("id", "name") if found.get(key))
        line = self.getpos()[0]
        if tag == "a" and found.get("href"):
            self.links.append((line, found["href"]))
        address = found.get(LOADED.get(tag, "")) or (found.get("href") if tag == "link" and found.get("rel") != "canonical" else None)
        if address:
            self.loaded.append((line, address))


def problems(site: Path):
    """Yields one sentence for each dead link or foreign resource."""
    pages = {path.resolve(): Page(path) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        where = path.relative_to(site)
        for line, address in page.links + page.loaded:
            parts = urlsplit(address)
            if parts.scheme in ("http", "https", "mailto") or parts.netloc:
                if (line, address) in page.loaded:
                    yield f"{where}:{line}: the page loads {address}; allowed: files of the site"
                continue
            if parts.scheme == "data":
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                yield f"{where}:{line}: {address} leads to no file"
            elif parts.fragment and not parts.fragment.startswith("/") and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                yield f"{where}:{line}: {address} leads to no anchor"


def main() -> int:
    found = list(problems(Path(sys.argv[1]).resolve()))
    for problem in found:
        print(problem, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
