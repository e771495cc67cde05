"""Checks that the files, classes and functions that the pages on the structure name exist. Usage: documents_test.py [FOLDER]

Names are the texts between backticks in ARCHITECTURE.md, docs/design.md and docs/NOTATION.md. Each must be a path below one
of the source folders, with or without its ending, or consist of words that occur in a source file. It also checks that the
links of all Markdown pages lead to files.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
ROOT = ROOT if ROOT.is_dir() else ROOT.parents[1]
DOCUMENTS = ["ARCHITECTURE.md", "docs/design.md", "docs/NOTATION.md"]
FOLDERS = ["", "src", "include/slipfront", "apps", "apps/slipfront", "python", "python/slipfront", "tests", "docs", "tools", "fuzz"]
SOURCES = (".cpp", ".hpp", ".py", ".ts", ".tsx", ".toml", ".txt", ".sh", ".cmake", ".in", ".csv", "")
PATTERNS = {"<name>", "<kind>", "<module>", "..."}  # stand for any name


def files():
    skipped = {"build", "node_modules", "__pycache__"}
    names = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return {str(name) for name in names if not any(part in skipped or part.startswith(".git") for part in name.parts)}


def is_path(name, known):
    """Whether it is a file or a folder, with or without its ending."""
    for folder in FOLDERS:
        path = "/".join(part for part in (folder, name.strip("/")) if part)
        if any(path + ending in known for ending in SOURCES) or any(file.startswith(path + "/") for file in known):
            return True
    return False


def words_of(known):
    words = set()
    for name in known:
        if name.endswith((".cpp", ".hpp", ".py", ".ts", ".tsx", ".toml", ".txt", ".json", ".in")) or "." not in name:
            if not name.endswith(".md"):
                words |= set(re.findall(r"[A-Za-z_][A-Za-z_0-9]*", (ROOT / name).read_text(encoding="utf-8", errors="ignore")))
    return words


def missing(document, known, words):
    for number, line in enumerate((ROOT / document).read_text(encoding="utf-8").split("\n"), 1):
        for name in re.findall(r"`([^`]+)`", line):
            if any(pattern in name for pattern in PATTERNS) or is_path(name.split()[0].split(":")[0], known):
                continue
            unknown = [word for word, star in re.findall(r"([A-Za-z_][A-Za-z_0-9]*)([*]?)", name)
                       if not (any(w.startswith(word) for w in words) if star else word in words)]
            if unknown:
                yield f"{document}:{number}: `{name}`: there is no {', '.join(unknown)}"


def dead_links(known):
    for page in sorted(name for name in known if name.endswith(".md") and not name.startswith("docs/site/")):  # docs/site has another root
        for number, line in enumerate((ROOT / page).read_text(encoding="utf-8").split("\n"), 1):
            for link in re.findall(r"\]\(([^)#\s]+)", line):
                if not link.startswith(("https://", "mailto:")) and not (ROOT / page).parent.joinpath(link).exists():
                    yield f"{page}:{number}: {link} leads to no file"


def main():
    known = files()
    words = words_of(known)
    found = [fault for document in DOCUMENTS for fault in missing(document, known, words)] + list(dead_links(known))
    print("\n".join(found))
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
