"""Behaviour that all commands share: help, version, a full disk."""

import json
import subprocess
import unittest

from support import CommandLine, PROGRAM


class Common(CommandLine):
    def test_help_and_version(self):
        for arguments in (["--help"], ["relations", "--help"], ["event", "--help"], ["pulse", "--help"], ["chain", "--help"], ["--version"]):
            self.assertTrue(self.ok(*arguments).strip())

    def test_mistyped_names_have_a_suggestion(self):
        self.refused(2, "pulze", says=["did you mean pulse?", "slipfront --help"])
        self.refused(2, "pulse", "a.toml", "--tolernce", "1", says=["did you mean --tolerance?", "slipfront pulse --help"])
        self.assertNotIn("mean", self.refused(2, "xyzzy").stderr)

    def test_versions_of_the_build(self):
        version = self.ok("--version").strip()
        facts = json.loads(self.ok("--version", "--json"))
        self.assertEqual(facts["slipfront"], version)
        for name in ("compiler", "boost", "cli11", "fmt", "nlohmann_json", "netcdf"):
            self.assertRegex(facts[name], r"\d+\.\d+")
        self.refused(2, "--json", says=["--version"])

    def test_doctor_names_what_works_and_the_remedy_for_the_rest(self):
        checks = {check["name"]: check for check in json.loads(self.ok("doctor", "--json"))["checks"]}
        self.assertTrue({"NetCDF", "MPI", "explorer", "Python", "matplotlib", "distributed"} <= set(checks))
        for check in checks.values():
            self.assertTrue(check["found"] if check["works"] else check["remedy"], check)
        self.assertEqual(len(self.ok("doctor", "--wide").splitlines()), len(checks) + 1)

    def test_full_disk_is_an_error(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([PROGRAM, "relations", "--stress", "1:2:1000", "--csv"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("stdout", done.stderr)


if __name__ == "__main__":
    unittest.main()
