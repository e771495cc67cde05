"""Tables fit the terminal, or 80 columns in files and pipes. With --wide they have their full width."""

import collections
import os
import re
import subprocess
import unittest

from support import PATIENCE, PROGRAM, SOURCE, CommandLine, on_terminal, run

CASES = os.path.join(SOURCE, "cases")
WIDTHS = (80, 100, 200)
TITLES = ("difference from pulse-consistent", "trend of the chain with scale")

#: Arguments, and the width of the first column, which each block repeats.
TABLES = {
    "events": (("event", "--quiet"), 32),
    "intervals": (("event", os.path.join(CASES, "catalogue.csv"), "--samples", "200", "--quiet"), 32),
    "population": (("event", "--population", "--quiet"), 13),
    "relations": (("relations", "--stress", "1:2:3"), 12),
    "one relation": (("relations", "--stress", "1"), 31),
    "friction": (("relations", "--stress", "1:2:3", "--friction-coefficient", "0.1"), 12),
    "keys": (("keys",), 0),
    "doctor": (("doctor",), 12),
    "slip events": (("chain", os.path.join(CASES, "stick-slip.toml"), "--quiet", "--set", "domain.left=-30", "domain.right=30", "time.end=3e5"), 17),
}
SLOW = ("doctor",)  # it is shown once
WHOLE = 1000  # on a terminal of this width, each table has its full width
CHANGES = re.compile(r"\w*(seconds|per_second)")  # lines that no two runs have in common


def words(text, labels):
    """How often each word occurs after the first column, whose texts are `labels`."""
    count = collections.Counter()
    for line in re.sub(r"\n {40,}(?=\S)", " ", text).splitlines():  # with the rest of a broken line
        if CHANGES.match(line) or line in TITLES:
            continue
        label = max((one for one in labels if re.match(rf"\s*{re.escape(one)}(\s|$)", line)), key=len, default="")
        count.update(line.replace(label, "", 1).split())
    return count


class Terminal(CommandLine):
    def shown(self, width, *arguments, code=0, columns=None):
        text, returned = on_terminal(width, PROGRAM, *arguments, columns=columns)
        self.assertEqual(returned, code, text)
        return text

    def assert_fits(self, text, width):
        for line in text.splitlines():
            if len(line.split()) > 1:  # one word stays whole: the path of an installation may be longer
                self.assertLessEqual(len(line), width, line)

    def test_every_table_fits_and_has_each_number_once(self):
        for name, (arguments, label_width) in TABLES.items():
            wide = self.shown(WHOLE, *arguments)
            labels = {line[:label_width].strip() for line in wide.splitlines()} if label_width else set()
            for width in WIDTHS[:1] if name in SLOW else WIDTHS:
                with self.subTest(name, width=width):
                    text = self.shown(width, *arguments)
                    self.assert_fits(text, width)
                    self.assertEqual(words(text, labels), words(wide, labels))

    def test_a_comparison_repeats_the_names_of_its_parts(self):
        arguments = ("compare", os.path.join(CASES, "step-viscous.toml"), "--scale", "20", "--scale", "40")
        wide = self.ok(*arguments, "--wide")
        self.assertTrue(all(wide.count(title) == 1 for title in TITLES))
        labels = {line[:18].strip() for line in wide.splitlines()}
        for width in WIDTHS:
            text = self.shown(width, *arguments)
            self.assert_fits(text, width)
            blocks = text.count("at the end")
            self.assertEqual([text.count(title) for title in TITLES], [blocks, blocks], text)
            self.assertEqual(blocks > 1, width == 80)
            apart = words(wide, labels)
            apart.subtract(words(text, labels))
            self.assertLessEqual(sum(abs(count) for count in apart.values()), 2 * 4)  # the seconds of four levels

    def test_a_table_that_fits_has_the_layout_of_a_file(self):
        for arguments, _ in (TABLES["events"], TABLES["relations"]):
            self.assertEqual(self.shown(200, *arguments), self.ok(*arguments, "--wide"))

    def test_a_pipe_has_80_columns(self):
        environment = os.environ | {"COLUMNS": "40"}
        done = subprocess.run([PROGRAM, "event"], env=environment, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.stdout, self.shown(80, "event"))
        self.assertEqual(max(map(len, self.ok("event", "--quiet", "--wide").splitlines())), 129)

    def test_columns_has_precedence_unless_it_is_no_width(self):
        wide = self.ok("event", "--quiet", "--wide")
        self.assertEqual(self.shown(80, "event", "--quiet", columns="150"), wide)
        self.assert_fits(self.shown(200, "event", "--quiet", columns="60"), 60)
        narrow = self.shown(80, "event", "--quiet")
        for no_width in ("", "0", "-5", "wide", "1e9"):
            self.assertEqual(self.shown(80, "event", "--quiet", columns=no_width), narrow, no_width)
        self.assertEqual(self.shown(0, "event", "--quiet"), narrow)  # a terminal that does not know its width

    def test_names_are_shortened_only_if_one_column_does_not_fit_next_to_them(self):
        path = self.file("n.csv", "name,rupture_velocity\nZürich ± a name of more than 32 characters,2 km/s\nB,3 km/s\n")
        self.assertIn("Zürich ± a name of more than 32  ", self.shown(60, "event", path, "--quiet"))
        narrow = self.shown(40, "event", path, "--quiet")
        self.assert_fits(narrow, 40)
        self.assertRegex(narrow, r"(?m)^Zürich ± [a-z ]+… +2 km/s$")

    def test_messages_fit_a_terminal_and_stay_one_line_in_a_pipe(self):
        table = self.file("t.csv", "name,rupture_velocity\nA,2 units of a very long name\n")
        for arguments in (("event", table), ("laboratory", table, "--poisson-ratio", "0.35", "--s-wave-speed", "1300 m/s", "--columns", "no.toml")):
            done = run(*arguments)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            text, _ = on_terminal(60, PROGRAM, *arguments, errors=subprocess.STDOUT)
            self.assertIn(" ".join(done.stderr.split()), " ".join(text.split()))
            self.assert_fits(text, 60)

    def test_the_terminal_does_not_change_json_and_csv(self):
        for arguments in (("event", "--json"), ("event", "--csv"), ("relations", "--stress", "1:2:3", "--csv")):
            self.assertEqual(self.shown(80, *arguments), self.ok(*arguments))


if __name__ == "__main__":
    unittest.main()
