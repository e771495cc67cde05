"""Each file of this checkout has a license, and the check finds files that have none."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]


def check(folder):
    """Return code and errors of the check."""
    done = subprocess.run([sys.executable, ROOT / "tools/package/check_reuse", folder], capture_output=True, text=True)
    return done.returncode, done.stderr


@unittest.skipUnless(shutil.which("git"), "git is missing, which lists the files")
class Reuse(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.copy = pathlib.Path(folder.name)
        shutil.copy(ROOT / "REUSE.toml", self.copy)
        shutil.copytree(ROOT / "LICENSES", self.copy / "LICENSES")
        for name in ("src/text/unit_names.cpp", "cases/step.toml"):
            self.add(name, (ROOT / name).read_text(encoding="utf-8"))

    def add(self, name, text):
        (self.copy / name).parent.mkdir(parents=True, exist_ok=True)
        (self.copy / name).write_text(text, encoding="utf-8")

    def assert_check(self, code, errors):
        for command in (["init", "-q"], ["add", "."]):
            subprocess.run(["git", *command], cwd=self.copy, check=True, capture_output=True)
        self.assertEqual(check(self.copy), (code, errors))

    def test_accepts_this_checkout(self):
        code, errors = check(ROOT)
        if code == 77:
            self.skipTest(errors)
        self.assertEqual((code, errors), (0, ""))

    def test_accepts_files_with_a_license(self):
        self.assert_check(0, "")

    def test_refuses_a_file_in_an_unknown_folder(self):
        self.add("vendor/a/b.c", "int i;\n")
        self.assert_check(1, "vendor/a/b.c: REUSE.toml states no copyright or no license; add the path to an annotation\n")

    def test_refuses_a_notice_of_another_holder(self):
        self.add("src/a.cpp", "// Copy" "right (c) 1999 Somebody Else\n")
        self.assert_check(1, "src/a.cpp: REUSE.toml does not name the copyright holder of '1999 Somebody Else'\n")

    def test_refuses_a_license_without_text(self):
        (self.copy / "LICENSES/LicenseRef-UDUNITS-2.txt").unlink()
        self.assert_check(1, "REUSE.toml: there is no file LICENSES/LicenseRef-UDUNITS-2.txt\n")

    def test_refuses_a_text_that_no_file_needs(self):
        self.add("LICENSES/MIT.txt", "MIT\n")
        self.assert_check(1, "LICENSES/MIT.txt: no file has this license\n")


if __name__ == "__main__":
    unittest.main()
