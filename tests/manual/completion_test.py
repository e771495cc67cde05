"""Bash and zsh complete commands, options, files, words and keys of scenarios. The test of zsh is skipped where it is missing."""

import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import tempfile
import time
import unittest

MANUAL = pathlib.Path(os.environ["SLIPFRONT_MANUAL"])
BASH_COMPLETION = "/usr/share/bash-completion/bash_completion"
PATIENCE = 120  # seconds for a shell that hangs
FILES = ("a.toml", "b.csv", "c.nc", "d.fsp", "e.srf", "e.txt", "f.html", "two words.toml", "folder/inside.toml")

ASK_BASH = r"""
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_slipfront slipfront "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
"""
START_ZSH = r"""
fpath=({folder} $fpath)
autoload -U compinit
compinit -u -D
zstyle ':completion:*' menu no
unsetopt list_ambiguous auto_menu
LISTMAX=1000
PS1='ready> '
slipfront() {{ print -r -- "<${{(j:|:)@}}>" }}
"""


class Completion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in FILES:
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).touch()


class Bash(Completion):
    def completions(self, *words, before=""):
        done = subprocess.run(["bash", "--norc", "-c", before + ASK_BASH, "bash", MANUAL / "bash/slipfront", "slipfront", *words],
                              cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return set(done.stdout.splitlines())

    def test_completes_commands(self):
        self.assertEqual(self.completions("ev"), {"event"})
        self.assertTrue({"relations", "pulse", "chain", "keys"} <= self.completions(""))
        self.assertEqual(self.completions("--v"), {"--version"})

    def test_completes_options_of_the_command(self):
        self.assertEqual(self.completions("event", "--c"), {"--closure", "--columns", "--csv"})
        self.assertEqual(self.completions("pulse", "a.toml", "--tol"), {"--tolerance"})
        self.assertIn("-o", self.completions("chain", "-"))

    def test_completes_files_by_their_endings(self):
        self.assertEqual(self.completions("pulse", ""), {"a.toml", "two words.toml", "folder"})
        self.assertEqual(self.completions("event", ""), {"a.toml", "b.csv", "d.fsp", "e.srf", "two words.toml", "folder"})
        self.assertEqual(self.completions("event", "a.toml", "-o", ""), {"b.csv", "c.nc", "d.fsp", "e.srf", "folder"})
        self.assertEqual(self.completions("pulse", "folder/"), {"folder/inside.toml"})
        self.assertEqual(self.completions("explore", "-o", ""), {"f.html", "folder"})
        self.assertEqual(self.completions("reproduce", "-o", ""), {"folder"})

    def test_completes_words(self):
        self.assertEqual(self.completions("event", "--closure", ""), {"consistent", "paper"})
        self.assertEqual(self.completions("event", "--closure", "=", "c"), {"consistent"})
        self.assertEqual(self.completions("relations", "--measure", "="), {"origin", "mean", "peak", "time-mean"})
        self.assertTrue({"pulse", "chain", "friction"} <= self.completions("keys", ""))

    def test_completes_keys_and_their_words(self):
        self.assertEqual(self.completions("pulse", "--set", "friction.coef"), {"friction.coefficient="})
        self.assertEqual(self.completions("pulse", "--set", "friction.law", "=", "vi"), {"viscous"})
        self.assertEqual(self.completions("compare", "--set", "pulse.periodic", "="), {"true", "false"})
        self.assertEqual(self.completions("chain", "--set", "no.such"), set())

    def test_offers_nothing_for_a_number(self):
        self.assertEqual(self.completions("event", "--threads", ""), set())

    @unittest.skipUnless(os.path.exists(BASH_COMPLETION), "bash-completion is missing")
    def test_works_with_the_package_bash_completion(self):
        before = f"shopt -s progcomp extglob; source {BASH_COMPLETION}\n"
        self.assertEqual(self.completions("event", "--closure", "p", before=before), {"paper"})
        self.assertEqual(self.completions("pulse", "a", before=before), {"a.toml"})


@unittest.skipUnless(shutil.which("zsh"), "zsh is missing")
class Zsh(Completion):
    """Types into an interactive zsh. The program is replaced by a function that prints its arguments as <a|b>."""

    def setUp(self):
        super().setUp()
        process, self.terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], os.environ | {"TERM": "dumb", "PS1": "first> ", "HOME": str(self.folder), "COLUMNS": "300"})
        self.addCleanup(lambda: (os.close(self.terminal), os.waitpid(process, 0)))
        (self.folder / ".start").write_text(START_ZSH.format(folder=MANUAL / "zsh"), encoding="utf-8")
        self.read_until(r"first> ")
        self.type("stty columns 300; source ./.start\n")
        self.read_until(r"ready> ")

    def type(self, text):
        os.write(self.terminal, text.encode())

    def read_until(self, pattern):
        text, end = "", time.monotonic() + PATIENCE
        while not re.search(pattern, text):
            if not select.select([self.terminal], [], [], max(0.0, end - time.monotonic()))[0]:
                self.fail(f"zsh does not print {pattern}, but: {text}")
            text += os.read(self.terminal, 65536).decode(errors="replace")
        return text

    def completed(self, line):
        """The arguments of the completed line, in which a tab requests a completion."""
        self.type(line + "\n")
        text = self.read_until(r"<[^\n]*>\r?\n(.|\n)*ready> ")
        return re.findall(r"<([^\n]*)>", text)[-1].split("|")

    def test_completes_command_option_word_file_and_key(self):
        for line, arguments in [("slipfront eve\t", ["event"]),
                                ("slipfront event --clos\tpap\t", ["event", "--closure=paper"]),
                                ("slipfront event --closure con\t", ["event", "--closure", "consistent"]),
                                ("slipfront pulse a\t--tol\t1e-3", ["pulse", "a.toml", "--tolerance=1e-3"]),
                                ("slipfront event -o b\t", ["event", "-o", "b.csv"]),
                                ("slipfront pulse --set friction.coef\t2", ["pulse", "--set", "friction.coefficient=2"]),
                                ("slipfront chain --set friction.law=vis\t", ["chain", "--set", "friction.law=viscous"]),
                                ("slipfront keys fric\t--js\t", ["keys", "friction", "--json"]),
                                ("slipfront --vers\t", ["--version"])]:
            with self.subTest(line):
                self.assertEqual(self.completed(line), arguments)

    def test_lists_options_with_their_meaning(self):
        self.type("slipfront event --s\t\t")
        self.assertIn("Seed of the samples", self.read_until(r"--seed +-- [^\n]*\n"))


if __name__ == "__main__":
    unittest.main()
