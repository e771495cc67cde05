"""Each command has a man page with every option of its help. The pages have no mistakes that `man` reports."""

import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["SLIPFRONT"]
MANUAL = pathlib.Path(os.environ["SLIPFRONT_MANUAL"])
MAKE = pathlib.Path(__file__).resolve().parents[2] / "tools/manual/make.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(MAKE.parent))

from command_help import command_of

PYTHON_PACKAGE_MISSING = 3  # exit code of a Python command


@functools.cache
def helps():
    """The help of the program and of each command that this build has, by the name of its page."""
    text = subprocess.run([PROGRAM, "--help"], check=True, capture_output=True, text=True).stdout
    found = {"slipfront": text}
    for name in re.findall(r"^  ([a-z]+) ", text.split("Subcommands:")[1], re.MULTILINE):
        done = subprocess.run([PROGRAM, name, "--help"], capture_output=True, text=True)
        if done.returncode != PYTHON_PACKAGE_MISSING:
            found[f"slipfront-{name}"] = done.stdout
    return found


def make(folder, **environment):
    subprocess.run([sys.executable, MAKE, PROGRAM, folder], check=True, env=os.environ | environment)


def plain(page):
    """The page without commands of roff."""
    return re.sub(r"\\f[BIR]|\\%", "", page).replace("\\-", "-").replace("\\(aq", "'").replace("\\(rs", "\\")


#: The date in the first line of a page.
DATE = re.compile(r"(?<= )\d{4}\\-\d\d\\-\d\d(?= )")

#: A help as CLI11 2.7 prints it. It indents long options, divides long lines, and has no word before the usage.
NEW_HELP = """The modulation equations with friction, Eqs. (7), on a
scenario


slipfront pulse [OPTIONS] SCENARIO


POSITIONALS:
  SCENARIO REQUIRED           Scenario file, TOML

OPTIONS:
  -h,     --help              Print this help message and exit
  -o,     --output OUT.nc     NetCDF file to write; an existing file is replaced at the end of
                              the run
          --set KEY=VALUE ... table.key=value, which replaces that of the scenario;
                              repeatable
          --json Excludes: --csv\x20
                              One JSON object

Examples:
slipfront pulse --check
"""


class Help(unittest.TestCase):
    def test_newer_help_is_read(self):
        command = command_of("pulse", "", NEW_HELP)
        self.assertEqual(command.usage, "slipfront pulse [OPTIONS] SCENARIO")
        self.assertEqual(command.description, "The modulation equations with friction, Eqs. (7), on a scenario")
        self.assertEqual([(argument.names, argument.value, argument.meaning) for argument in command.arguments],
                         [((), "SCENARIO", "Scenario file, TOML"),
                          (("-h", "--help"), "", "Print this help message and exit"),
                          (("-o", "--output"), "OUT.nc", "NetCDF file to write; an existing file is replaced at the end of the run"),
                          (("--set",), "KEY=VALUE", "table.key=value, which replaces that of the scenario; repeatable"),
                          (("--json",), "", "One JSON object; excludes --csv")])
        self.assertEqual(command.examples, ("slipfront pulse --check",))


class Manual(unittest.TestCase):
    def pages(self):
        return {path.stem: path.read_text(encoding="utf-8") for path in (MANUAL / "man").iterdir()}

    def test_every_command_has_a_page(self):
        self.assertEqual(set(self.pages()), set(helps()))
        self.assertGreaterEqual(len(helps()), 9)

    def test_every_option_is_on_the_page(self):
        pages = self.pages()
        for name, text in helps().items():
            options = re.findall(r"^  .*?(?<![\w-])(--[a-z][a-z-]*)", text.split("xamples:")[0], re.MULTILINE)
            self.assertIn("--help", options)
            headers = plain("\n".join(re.findall(r"^\.TP\n(.*)", pages[name], re.MULTILINE)))
            for option in options:
                with self.subTest(page=name, option=option):
                    self.assertRegex(headers, rf"(?m)(^|, ){option}( |$)")

    def test_every_example_is_on_the_page(self):
        pages = self.pages()
        for name, text in helps().items():
            for example in re.findall(r"^  (slipfront .*)", re.sub(r"\\\n +", "", text).partition("Examples:")[2], re.MULTILINE):
                self.assertIn(example, plain(pages[name]))

    def test_pages_name_values_limits_and_exit_codes(self):
        event = plain(self.pages()["slipfront-event"])
        for text in ("--threads N\n", "allowed: 1 to 4096.", "--closure NAME\n", "allowed: consistent, paper.", "FILE ...\n", "\n130\n"):
            self.assertIn(text, event)
        self.assertRegex(plain(self.pages()["slipfront-relations"]), r"--slip-velocity-ratio VALUE\nRatio of the")

    def test_another_build_has_the_same_bits_except_for_its_date(self):
        """The date is that of the release, or that of the environment."""
        self.assertRegex(plain(self.pages()["slipfront"]), r"^\.TH SLIPFRONT 1 20\d\d-\d\d-\d\d ")
        with tempfile.TemporaryDirectory() as folder:
            make(folder, COLUMNS="40", LC_ALL="C", SOURCE_DATE_EPOCH="86400")
            built = {path.relative_to(folder): path.read_text(encoding="utf-8") for path in pathlib.Path(folder).rglob("*") if path.is_file()}
        self.assertEqual(DATE.findall(built[pathlib.Path("man/slipfront.1")]), [r"1970\-01\-02"])
        shipped = {path.relative_to(MANUAL): path.read_text(encoding="utf-8") for part in ("man", "bash", "zsh") for path in (MANUAL / part).iterdir()}
        self.assertEqual({name: DATE.sub("", text) for name, text in built.items()}, {name: DATE.sub("", text) for name, text in shipped.items()})

    @unittest.skipUnless(shutil.which("man") and shutil.which("groff"), "man or groff is missing")
    def test_man_has_no_warnings(self):
        for path in (MANUAL / "man").iterdir():
            done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  text=True, env=os.environ | {"LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80"})
            self.assertEqual((done.returncode, done.stderr), (0, ""), path)

    @unittest.skipUnless(shutil.which("lexgrog"), "lexgrog is missing")
    def test_whatis_finds_name_and_summary(self):
        for path in (MANUAL / "man").iterdir():
            done = subprocess.run(["lexgrog", path], capture_output=True, text=True)
            self.assertIn(f'"{path.stem} - ', done.stdout)


if __name__ == "__main__":
    unittest.main()
