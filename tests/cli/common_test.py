"""Behaviour that all commands share: help, version, a full disk."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from support import CommandLine, PATIENCE, PROGRAM, SANITIZED, SOURCE, run

COMMANDS = ("relations", "event", "pulse", "chain", "compare", "keys", "doctor", "explore")
#: Commands of the Python package, which a build with sanitizers does not have.
PYTHON_COMMANDS = () if SANITIZED else ("sweep", "fronts", "laboratory", "reproduce", "plot", "animate")
#: Examples that other tests run, because they need a page that is not always built or take long.
ELSEWHERE = ("slipfront explore", "slipfront reproduce", "slipfront animate")


class Common(CommandLine):
    def test_help_and_version(self):
        for arguments in (["--help"], ["relations", "--help"], ["event", "--help"], ["pulse", "--help"], ["chain", "--help"], ["--version"]):
            self.assertTrue(self.ok(*arguments).strip())

    def test_every_help_has_examples_that_run(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(SOURCE, "cases"), os.path.join(folder, "cases"))
            os.symlink(PROGRAM, os.path.join(folder, "slipfront"))
            environment = os.environ | {"PATH": f"{folder}:{os.environ['PATH']}"}
            for command in (*COMMANDS, *PYTHON_COMMANDS):
                help_text = run(command, "--help").stdout
                examples = re.findall(r"^  (slipfront .*)$", help_text.partition("Examples:")[2], re.MULTILINE)
                self.assertTrue(examples, command)
                for example in examples:
                    if not example.startswith(ELSEWHERE):
                        with self.subTest(example):
                            done = subprocess.run(["bash", "-c", example], cwd=folder, env=environment, capture_output=True, text=True, timeout=PATIENCE)
                            self.assertEqual(done.returncode, 0, done.stderr)

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
        self.assertEqual(len(self.ok("doctor").splitlines()), len(checks) + 1)

    def test_full_disk_is_an_error(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([PROGRAM, "relations", "--stress", "1:2:1000", "--csv"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("stdout", done.stderr)


if __name__ == "__main__":
    unittest.main()
