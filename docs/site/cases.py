"""Writes a page that shows the scenarios which come with slipfront: cases.py CASES > scenarios.md."""
import pathlib
import sys
import tomllib


def main() -> None:
    print("# Scenarios that come with slipfront\n")
    print("This page shows each scenario file of `cases/`. Each is an example, a test and the source of a figure.\n")
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.toml")):
        text = path.read_text(encoding="utf-8")
        title = tomllib.loads(text).get("title", "")
        print(f"## {path.name}\n\n{title}\n\n```toml\n{text.strip()}\n```\n")


if __name__ == "__main__":
    main()
