"""The check of a release passes on this checkout, and fails on copies in which version or changelog do not agree."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
FILES = ["CMakeLists.txt", "CITATION.cff", "codemeta.json", "CHANGELOG.md", "pyproject.toml", "setup.py", "apps/explorer/package.json", "README.md",
         "debian/changelog"]


def check(folder):
    """Return code and errors of the check."""
    done = subprocess.run([sys.executable, ROOT / "tools/release", folder], capture_output=True, text=True)
    return done.returncode, done.stderr


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.copy = pathlib.Path(folder.name)
        for name in FILES:
            (self.copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.copy / name)

    def replace(self, name, old, new):
        text = (self.copy / name).read_text(encoding="utf-8")
        self.assertIn(old, text)
        (self.copy / name).write_text(text.replace(old, new, 1), encoding="utf-8")

    def assert_refused(self, *words):
        code, errors = check(self.copy)
        self.assertEqual(code, 1, errors)
        for word in words:
            self.assertIn(word, errors)

    def test_accepts_this_checkout(self):
        self.assertEqual(check(ROOT), (0, ""))

    def test_refuses_another_version_in_any_file(self):
        self.replace("CITATION.cff", "\nversion: ", "\nversion: 9")
        self.replace("apps/explorer/package.json", '"version": "', '"version": "8')
        self.assert_refused("CITATION.cff has version 9", "package.json has version 8")

    def test_refuses_another_version_of_the_debian_packages(self):
        self.replace("debian/changelog", "slipfront (", "slipfront (4")
        self.assert_refused("debian/changelog has version 4")

    def test_refuses_another_version_in_codemeta(self):
        self.replace("codemeta.json", '"version": "', '"version": "7')
        self.assert_refused("codemeta.json has version 7")

    def test_codemeta_agrees_with_the_citation(self):
        meta = json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))
        citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
        own, paper = citation.split("references:")

        def one(key, text):
            return re.search(rf"^[ -]*{key}: \"?([^\"\n]*)\"?$", text, re.MULTILINE)[1]

        self.assertEqual(meta["name"], one("title", own))
        self.assertEqual(meta["datePublished"], one("date-released", own))
        self.assertEqual(meta["license"], "https://spdx.org/licenses/" + one("license", own))
        self.assertEqual([author["name"] for author in meta["author"]], re.findall(r'^  - name: "(.*)"$', own, re.MULTILINE))
        self.assertEqual(meta["referencePublication"]["@id"], "https://doi.org/" + one("doi", paper))
        self.assertEqual(meta["referencePublication"]["name"], one("title", paper))

    def test_refuses_a_version_that_the_changelog_lacks(self):
        self.replace("CMakeLists.txt", "project(slipfront VERSION ", "project(slipfront VERSION 7")
        self.assert_refused("CHANGELOG.md has no section '## 7")

    def test_refuses_other_kinds_of_changes(self):
        self.replace("CHANGELOG.md", "### Fixed", "### Mended")
        self.assert_refused("'Mended' is none of Added, Changed, Fixed")


if __name__ == "__main__":
    unittest.main()
