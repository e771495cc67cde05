"""Checks that every command of README.md runs as written, and prints the output that README.md shows.

The commands run in a folder like that of a fresh clone with a build."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from support import PATIENCE, PROGRAM, SOURCE

README = pathlib.Path(SOURCE, "README.md")

#: Commands that other tests run: reproduce_test, ctest itself, and tests/explorer.
ELSEWHERE = ("./run", "./test", "./run explore")

#: A line of the README may be this wide.
WIDEST = 100


def blocks(text) -> list:
    """(kind, text) of each block of code: "commands" for an indented one, the language or "" for a fenced one."""
    found, inside, kind = [], [], None
    for line in [*text.splitlines(), ""]:
        fence = re.match(r"```(\w*)$", line)
        if kind in (None, "commands") and fence:
            if inside:
                found.append(("commands", inside))
            inside, kind = [], fence.group(1)
        elif fence:
            found.append((kind, inside))
            inside, kind = [], None
        elif kind not in (None, "commands"):
            inside.append(line)
        elif line.startswith("    "):
            inside, kind = inside + [line[4:]], "commands"
        elif inside:
            found.append(("commands", inside))
            inside, kind = [], None
    return [(kind, "\n".join(lines)) for kind, lines in found]


def commands(text) -> list:
    """The commands of a block, without comments. A backslash at the end of a line continues the command."""
    lines = text.replace("\\\n", " ").splitlines()
    return [command for command in (re.sub(r"\s+#.*", "", line).strip() for line in lines) if command]


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = README.read_text(encoding="utf-8")
        cls.temporary = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.temporary.name)
        (root / "docs").mkdir()
        (root / "build").mkdir()
        (root / "home").mkdir()
        os.symlink(os.path.join(SOURCE, "cases"), root / "cases")
        os.symlink(os.path.join(SOURCE, "docs/tutorials"), root / "docs/tutorials")
        os.symlink(pathlib.Path(PROGRAM).resolve().parent.parent, root / "build/release")
        (root / "run").write_text(f'#!/bin/sh\nexec "{PROGRAM}" "$@"\n', encoding="utf-8")
        (root / "run").chmod(0o755)
        cls.root = root

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def done(self, *command, **how):
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {"HOME": str(self.root / "home")}
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True, timeout=PATIENCE, env=environment | how.pop("env", {}), **how)
        self.assertEqual(done.returncode, 0, (command, done.stderr[-2000:]))
        return done.stdout

    def test_every_command_runs_and_prints_what_is_shown(self):
        output, ran, shown = "", 0, 0
        for kind, text in blocks(self.text):
            if kind == "commands":
                for command in commands(text):
                    if command in ELSEWHERE:
                        continue
                    with self.subTest(command):
                        output = self.done("bash", "-c", command)
                        ran += 1
            elif kind == "":
                printed = [line.rstrip() for line in output.splitlines()]
                for line in text.splitlines():
                    if line != "...":
                        with self.subTest(line):
                            self.assertTrue(any(whole.startswith(line.rstrip()) for whole in printed))
                            shown += 1
            elif kind == "python":
                with self.subTest(kind):
                    self.done(sys.executable, "-c", text, env={"PYTHONPATH": str(self.root / "build/release/python")})
                    ran += 1
        self.assertGreater(ran, 15)
        self.assertGreater(shown, 5)
        for picture in ("map.png", "pulse.gif", "docs/events.png", "docs/slip-pulse.gif"):
            self.assertGreater((self.root / picture).stat().st_size, 5000, picture)

    def test_lines_have_at_most_100_columns(self):
        wide = [line for line in self.text.splitlines() if len(line) > WIDEST]
        self.assertEqual(wide, [])

    def test_links_lead_to_files(self):
        links = [link for link in re.findall(r"\]\(([^)#]+)\)", self.text) if not link.startswith("https://doi.org/")]
        self.assertGreater(len(links), 10)
        for link in links:
            self.assertTrue(pathlib.Path(SOURCE, link).exists(), link)


if __name__ == "__main__":
    unittest.main()
