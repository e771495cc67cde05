"""Writes the reference of the C++ library: cpp_reference.py INCLUDE STAGE.

Doxygen reads the public headers in INCLUDE, and breathe shows the result. A page STAGE/cpp/NAME.rst describes each
namespace, and STAGE/cpp/index.rst lists them."""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

SETTINGS = """INPUT={headers}
STRIP_FROM_PATH={headers}
OUTPUT_DIRECTORY={output}
RECURSIVE=YES
FILE_PATTERNS=*.hpp
GENERATE_HTML=NO
GENERATE_LATEX=NO
GENERATE_XML=YES
XML_PROGRAMLISTING=NO
EXTRACT_ALL=YES
JAVADOC_AUTOBRIEF=YES
QUIET=YES
WARN_IF_UNDOCUMENTED=NO
WARN_AS_ERROR=FAIL_ON_WARNINGS
"""
COMMENT = re.compile(r"(///<?)(.*)")
#: A base class with template arguments, which breathe cannot parse if they are nested.
BASE = re.compile(r"(<basecompoundref[^>]*>[^<&]*)&lt;[^<]*(</basecompoundref>)")
HEAD = """C++ library
===========

These pages describe what a program that uses the C++ library can include: each namespace with its types and functions.


.. toctree::

"""


def escaped(line: str) -> str:
    """Averages such as <w sigma> in comments are not HTML."""
    return COMMENT.sub(lambda found: found[1] + found[2].replace("<", "&lt;"), line)


def main() -> None:
    include, stage = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    headers, output, pages = stage / "doxygen/include", stage / "doxygen", stage / "cpp"
    for header in include.rglob("*.hpp"):
        copy = headers / header.relative_to(include)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text("".join(map(escaped, header.read_text(encoding="utf-8").splitlines(keepends=True))), encoding="utf-8")
    (output / "Doxyfile").write_text(SETTINGS.format(headers=headers.resolve(), output=output.resolve()), encoding="utf-8")
    done = subprocess.run(["doxygen", str(output / "Doxyfile")], capture_output=True, text=True)
    if done.returncode != 0 or done.stderr.strip():
        sys.exit(f"docs/site/cpp_reference.py: doxygen: {done.stderr.strip()}")
    for path in (output / "xml").glob("*.xml"):
        path.write_text(BASE.sub(r"\1\2", path.read_text(encoding="utf-8")), encoding="utf-8")
    index = xml.etree.ElementTree.parse(output / "xml/index.xml").getroot()
    names = [compound.findtext("name", "") for compound in index if compound.get("kind") == "namespace"]
    spaces = sorted(name for name in names if name.split("::")[0] == "slipfront" and "@" not in name)
    pages.mkdir(exist_ok=True)
    for name in spaces:
        title = f"Namespace {name}"
        page = f"{title}\n{'=' * len(title)}\n\n.. doxygennamespace:: {name}\n   :content-only:\n"
        (pages / f"{name.replace('::', '-')}.rst").write_text(page, encoding="utf-8")
    (pages / "index.rst").write_text(HEAD + "".join(f"   {name.replace('::', '-')}\n" for name in spaces), encoding="utf-8")


if __name__ == "__main__":
    main()
