"""Each pattern of tools/prose finds a bad example and passes a good one; only finished files have to be clean."""

import importlib.machinery
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[1]
loader = importlib.machinery.SourceFileLoader("prose", str(ROOT / "tools/prose"))
prose = importlib.util.module_from_spec(importlib.util.spec_from_loader("prose", loader))
sys.modules["prose"] = prose
loader.exec_module(prose)

TYPO = "het"[::-1]  # codespell reads this file too
# Bad and good, in the order of the patterns.
OPENINGS = [
    ("What the solver supports.", "What does the solver support?"),
    ("Of the segment.", "Of course the segment is finite."),
    ("Where a link points to.", "The target of a link."),
    ("Likewise for the rows.", "Sorts the rows."),
    ("The same as text.", "The sum as text."),
    ("Counted from the left end.", "Speed in m/s. Returned as a fraction of c."),
    ("Keeping the last cell.", "Loading of a fault. During the step nothing changes."),
]
WORDS = [
    ("A room of the library.", "A module. There is room for two."),
    ("Every place of the fault slips.", "We place the cell, and it takes place in its place."),
    ("The value beside it.", "Besides, the value is positive."),
    ("Values beyond the end.", "Values outside the domain."),
    ("The run goes on.", "The run continues on the next core."),
    ("The file says so.", "The file states so. We can tell apart two files."),
    ("The front stands at 0.", "K stands for stiffness. A stand-alone program."),
    ("The cells are laid anew.", "The page is laid out in columns."),
    ("Friction remembers the slip.", "What should you remember?"),
    ("Friction with a memory.", "The memory of the machine."),
    ("Both are alike.", "Both are equal."),
    ("Known from velocities alone.", "Each dislocation is alone, let alone two."),
    ("The chain bears it.", "Bear in mind that it breaks."),
    ("The cell is thrown far.", "An InputError is thrown."),
    ("A cell is squeezed.", "A cell is compressed."),
    ("Run it by hand.", "Hand it over."),
    ("It stops by itself.", "The value itself."),
    ("A killed pulse resumes.", "A killed `pulse` run resumes."),
    ("The number of cells that are at rest.", "The number of cells at rest."),
    ("The misprint is mended.", "The misprint is corrected."),
]


def findings(path, text, allowed=()):
    return [(finding.line, finding.kind, finding.text) for finding in prose.prose_findings(path, text, list(allowed))]


class Prose(unittest.TestCase):
    def assert_patterns(self, patterns, examples):
        self.assertEqual(len(patterns), len(examples))
        for (pattern, advice), (bad, good) in zip(patterns, examples):
            with self.subTest(pattern=pattern):
                self.assertIn(advice, [finding.suggestion for finding in prose.prose_findings("a.cpp", f"// {bad}\n", [])])
                self.assertEqual(findings("a.cpp", f"// {good}\n"), [])
                self.assertEqual([p for p, _ in patterns if prose.re.search(p, bad, prose.re.I)], [pattern])

    def test_each_opening_finds_a_bad_example_and_passes_a_good_one(self):
        self.assert_patterns(prose.OPENINGS, OPENINGS)

    def test_each_word_to_replace_finds_a_bad_example_and_passes_a_good_one(self):
        self.assert_patterns(prose.WORDS, WORDS)

    def test_finds_comments_of_each_language(self):
        self.assertEqual(findings("a.cpp", 'f("// beside", \'"\', 1\'000);  // a\n/// Two lines: go\n/// on.\nauto s = R"(beside)";\n'),
                         [(2, "word", "go on")])
        self.assertEqual(findings("a.ts", "const s = '// beside', t = `beside`;\n/**\n * It is\n * beside it.\n */\n"),
                         [(4, "word", "beside")])
        self.assertEqual(findings("a.py", '"""A title.\n\nOf arrays, beside it."""\ns = "beside"  # of beside\n'),
                         [(4, "fragment", "of"), (4, "word", "beside"), (3, "opening", "Of"), (3, "word", "beside")])

    def test_finds_long_sentences_of_pages(self):
        word = "word "
        for text in ("A " + 30 * word + "end.", "- A " + 30 * word + "end.", "- x\n    - A " + 30 * word + "end.", "See Fig. 8 of " + 29 * word + "it."):
            with self.subTest(text=text):
                self.assertEqual([kind for _, kind, _ in findings("a.md", text.replace("word ", "word\n"))], ["sentence"])
        for text in (28 * word + "end.", "`" + 40 * word + "`", "# " + 40 * word, "| " + 40 * word + "|", "    " + 40 * word + "\n",
                     "```\n" + 40 * word + "\n```", 20 * word + "ends. It " + 20 * word, 20 * word + "is A. It " + 20 * word,
                     "[a](" + "b/" * 60 + "c) " + 20 * word, "<!-- " + 40 * word + "-->", "- a\n\n      " + 40 * word):
            with self.subTest(text=text):
                self.assertNotIn("sentence", [kind for _, kind, _ in findings("a.md", text)])

    def test_reads_a_formula_as_one_word(self):
        formula = " ".join(["x"] * 20) + ". A room"
        self.assertEqual(findings("a.md", f"The sum ${formula}$ is zero.\n\n$$\n{formula}\n$$\n"), [])
        self.assertEqual(findings("a.md", "It costs 5 $ in a room, or 6 $."), [(1, "word", "room")])

    def test_finds_long_lines_of_pages(self):
        self.assertEqual(findings("a.md", "a\n" + 25 * "abcd " + "\n"), [(2, "line", "abcd abcd abcd abcd abcd abcd abcd abcd ...")])
        for text in ("- [a page](" + 110 * "b" + ").", "https://" + 110 * "b", "|" + 60 * " a" + "|", "text\n\n    " + 60 * " a", "# " + 60 * "a "):
            with self.subTest(text=text):
                self.assertEqual(findings("a.md", text), [])

    def test_allows_a_phrase_and_no_other(self):
        self.assertEqual(findings("a.md", "One beside it. **Two** beside `it`.\n", ["Two** beside `it`"]), [(1, "word", "beside")])

    @unittest.skipUnless(shutil.which("git"), "needs git")
    def test_reports_and_counts_the_findings_of_all_files(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder)
            (copy / "tools").mkdir()
            shutil.copy(ROOT / "tools/prose", copy / "tools/prose")
            for name, text in {"tools/prose.allow": "", "tools/prose.words": "", "a.md": "Beside.\n", "b.md": TYPO + "\n"}.items():
                (copy / name).write_text(text)
            subprocess.run(["git", "init", "-q"], cwd=copy, check=True)
            subprocess.run(["git", "add", "."], cwd=copy, check=True)

            def run(*arguments):
                done = subprocess.run([sys.executable, copy / "tools/prose", *arguments], capture_output=True, text=True)
                return done.returncode, done.stdout

            self.assertEqual(run(copy / "a.md"), (1, "a.md:1: Beside: next to; compared with; in addition to\n"))
            code, out = run("--count")
            self.assertEqual(code, 1)
            self.assertIn("     1 a.md\n", out)
            code, out = run()
            self.assertEqual(code, 1)
            self.assertIn("a.md:1: Beside: ", out)
            if shutil.which("codespell"):
                self.assertIn(f"b.md:1: {TYPO}: the\n", out)
            (copy / "tools/prose.allow").write_text("a.* | Beside | a name\n")
            self.assertEqual(run(copy / "a.md"), (0, ""))


if __name__ == "__main__":
    unittest.main(verbosity=0)
