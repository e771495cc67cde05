"""Behaviour that all commands share: help, version, a full disk."""

import subprocess
import unittest

from support import CommandLine, PROGRAM


class Common(CommandLine):
    def test_help_and_version(self):
        for arguments in (["--help"], ["relations", "--help"], ["event", "--help"], ["pulse", "--help"], ["chain", "--help"], ["--version"]):
            self.assertTrue(self.ok(*arguments).strip())

    def test_full_disk_is_an_error(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([PROGRAM, "relations", "--stress", "1:2:1000", "--csv"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("stdout", done.stderr)


if __name__ == "__main__":
    unittest.main()
