"""`slipfront explore`: where the page is, what it writes, and what it opens."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

from support import PATIENCE, PROGRAM, CommandLine

PAGE = "<title>page</title>\n"


class Explore(CommandLine):
    """Runs a copy of the program with a page of a line, because the real one may not have been built."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        prefix = self.folder / "the prefix"
        (prefix / "bin").mkdir(parents=True)
        self.program = shutil.copy(PROGRAM, prefix / "bin")
        for library in pathlib.Path(PROGRAM).parents[1].glob("lib*"):
            os.symlink(library, prefix / library.name)
        self.page = prefix / "share/slipfront/explorer/index.html"
        self.page.parent.mkdir(parents=True)
        self.page.write_text(PAGE, encoding="utf-8")
        opener = self.folder / "xdg-open"
        opener.write_text(f'#!/bin/sh\nprintf %s "$*" >"{self.folder}/part" && mv "{self.folder}/part" "{self.folder}/opened"\necho loud\n', encoding="utf-8")
        opener.chmod(0o755)

    def explore(self, *arguments, code=0, desktop=False):
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment |= {"PATH": f"{self.folder}:{environment['PATH']}"} | ({"WAYLAND_DISPLAY": "wayland-0"} if desktop else {})
        done = subprocess.run([self.program, "explore", *arguments], env=environment, cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr if code else done.stdout

    def refused(self, code, *arguments, says=()):
        message = self.explore(*arguments, code=code)
        self.assertRegex(message, r"\Aslipfront: [^\n]*\n\Z")
        for text in says:
            self.assertIn(text, message)

    def test_opens_the_page_that_belongs_to_it(self):
        self.assertEqual(json.loads(self.explore("--json", desktop=True)), {"file": str(self.page)})
        opened, end = self.folder / "opened", time.monotonic() + PATIENCE
        while not opened.exists() and time.monotonic() < end:  # the program does not wait for the browser
            time.sleep(0.01)
        self.assertEqual(opened.read_text(encoding="utf-8"), str(self.page))

    def test_without_a_desktop_it_only_states_where_the_page_is(self):
        self.assertIn(str(self.page), self.explore())
        self.assertEqual(self.explore("--quiet"), "")
        self.assertFalse((self.folder / "opened").exists())

    def test_writes_the_page_and_opens_nothing(self):
        out = self.folder / "out.html"
        out.write_text("old", encoding="utf-8")
        self.assertIn("out.html", self.explore("-o", "out.html", desktop=True))
        self.assertEqual(out.read_text(encoding="utf-8"), PAGE)
        self.assertEqual(json.loads(self.explore("--json", "-o", str(out), desktop=True)), {"file": str(out)})
        self.assertFalse((self.folder / "opened").exists())

    def test_refuses_what_it_cannot_write(self):
        self.refused(3, "-o", ".", says=["directory"])
        self.refused(3, "-o", "none/out.html", says=["none/out.html"])
        self.refused(3, "-o", "/dev/full", says=["/dev/full"])
        self.refused(2, "-o", "", says=["empty"])
        self.refused(2, "--port", "8757", says=["--port"])

    def test_without_a_page_it_states_how_to_build_it(self):
        self.page.unlink()
        self.refused(3, says=["./run explore"])
        self.refused(3, "-o", "out.html", says=["./run explore"])
        self.assertFalse((self.folder / "out.html").exists())


if __name__ == "__main__":
    unittest.main()
