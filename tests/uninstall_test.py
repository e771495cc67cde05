"""The target `uninstall` removes what an installation has created, and nothing else. Usage: uninstall_test.py BUILD"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

BUILD = sys.argv.pop()


def cmake(*arguments):
    done = subprocess.run(["cmake", *arguments], capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)


class Uninstall(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.prefix = pathlib.Path(folder.name) / "a prefix"
        self.prefix.mkdir()

    def install(self):
        cmake("--install", BUILD, "--prefix", self.prefix)
        self.assertTrue((self.prefix / "bin/slipfront").is_file())

    def uninstall(self):
        cmake("--build", BUILD, "--target", "uninstall")

    def test_leaves_an_empty_prefix(self):
        self.install()
        for package in self.prefix.glob("lib/python3/dist-packages/slipfront"):
            (package / "__pycache__").mkdir()
            (package / "__pycache__/medium.cpython-311.pyc").touch()
        self.uninstall()
        self.assertEqual(list(self.prefix.iterdir()), [])

    def test_leaves_files_of_others(self):
        self.install()
        own = [self.prefix / "share/slipfront/cases/own.toml", self.prefix / "bin/own", self.prefix / "include/.own"]
        for path in own:
            path.touch()
        self.uninstall()
        self.assertEqual(sorted(path for path in self.prefix.rglob("*") if path.is_file()), sorted(own))

    def test_can_be_repeated(self):
        self.install()
        self.uninstall()
        self.uninstall()


if __name__ == "__main__":
    unittest.main()
