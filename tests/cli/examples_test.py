"""The examples in the help of each command run."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

from support import CommandLine, PATIENCE, PROGRAM, SOURCE, run

COMMANDS = ("relations", "event", "pulse", "chain", "compare", "keys", "doctor", "explore", "sweep", "fronts", "laboratory", "reproduce", "plot", "animate")
#: Examples that other tests run, because they serve a page or take long.
ELSEWHERE = ("slipfront explore", "slipfront reproduce", "slipfront animate")


class Examples(CommandLine):
    def test_every_help_has_examples_that_run(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(SOURCE, "cases"), os.path.join(folder, "cases"))
            os.symlink(PROGRAM, os.path.join(folder, "slipfront"))
            environment = os.environ | {"PATH": f"{folder}:{os.environ['PATH']}"}
            for command in COMMANDS:
                help_text = run(command, "--help").stdout.replace("\\\n", "")
                examples = re.findall(r"^  (slipfront .*)$", help_text.partition("Examples:")[2], re.MULTILINE)
                self.assertTrue(examples, command)
                for example in examples:
                    if not example.startswith(ELSEWHERE):
                        with self.subTest(example):
                            done = subprocess.run(["bash", "-c", example], cwd=folder, env=environment, capture_output=True, text=True, timeout=PATIENCE)
                            self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
