"""Completes Debian's Furo theme in a built site: furo.py SITE.

Debian's package expects a web server that has the style sheet normalize.css, and a bundler that joins two scripts. Its
style sheets lack the rules by which dark mode follows the setting of the system."""
import pathlib
import re
import sys

NORMALIZE = pathlib.Path("/usr/share/nodejs/normalize.css/normalize.css")
DARK = re.compile(r"^ *(?:html )?body\[data-theme=\"dark\"\](?! \.theme-toggle)[^{}]*\{[^{}]*\}", re.MULTILINE)


def follow_the_system(sheet: pathlib.Path) -> None:
    """Repeats the rules of dark mode for readers who have chosen none and whose system is dark."""
    text = sheet.read_text(encoding="utf-8")
    rules = [rule.replace('[data-theme="dark"]', '[data-theme="auto"]') for rule in DARK.findall(text)]
    if not rules:
        sys.exit(f"docs/site/furo.py: {sheet.name} has no rules of dark mode")
    sheet.write_text(text + "\n@media not print { @media (prefers-color-scheme: dark) {\n" + "\n".join(rules) + "\n} }\n", encoding="utf-8")


def main() -> None:
    static = pathlib.Path(sys.argv[1]) / "_static"
    furo = static / "styles/furo.css"
    (furo.parent / NORMALIZE.name).write_bytes(NORMALIZE.read_bytes())
    furo.write_text(furo.read_text(encoding="utf-8").replace("/javascript/normalize.css/normalize.css", "normalize.css"), encoding="utf-8")
    follow_the_system(furo)
    follow_the_system(static / "pygments.css")
    script = static / "scripts/furo.js"
    lines = [line for line in script.read_text(encoding="utf-8").splitlines() if not line.startswith("import Gumshoe")]
    spy = (static / "scripts/gumshoe-patched.js").read_text(encoding="utf-8")
    script.write_text(spy + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
