"""slipfront columns as a user meets it."""

import json
import os
import unittest

from support import SOURCE, CommandLine, run

TITLES = "place,Vr (km/s),err,fc (Hz),lat,Slip\n"


class Columns(CommandLine):
    def test_each_column_has_a_meaning_or_a_reason(self):
        table = self.file("t.csv", TITLES + "A,2.7,0.2,3,35,1\nB,2.8,0.2,3,35,2\n")
        out = json.loads(self.ok("columns", table, "--json"))
        self.assertEqual([c["meaning"] for c in out["columns"]], ["", "rupture_velocity", "error of rupture_velocity", "", "", "slip"])
        self.assertEqual([c["unit"] for c in out["columns"]], ["", "km/s", "", "", "", ""])
        self.assertEqual([bool(c["reason"]) for c in out["columns"]], [True, False, False, True, True, True])
        self.assertEqual([c["looks_like_quantity"] for c in out["columns"]], [False] * 3 + [True] + [False] * 2)
        self.assertEqual((out["header_line"], out["separator"], out["columns"][2]["standard_deviations"]), (1, ",", 1))
        printed = self.ok("columns", table)
        self.assertRegex(printed, r"Vr \(km/s\) +rupture_velocity in km/s\n")
        self.assertRegex(printed, r"fc \(Hz\) +not used: no name of a quantity\n")
        self.assertRegex(printed, r"Slip +slip; cannot be read: no unit in the title")
        self.assertIn(out["map"], printed)

    def test_the_edited_map_reads_the_table(self):
        table = self.file("t.csv", "kindA, 1998, 17.26, 175\nkindB, 2001, 17.27, 415\n")
        column_map = os.path.join(os.path.dirname(table), "map.toml")
        self.ok("columns", table, "-o", column_map)
        with open(column_map, encoding="utf-8") as file:
            text = file.read()
        self.assertIn("\n4 = 'ignore'", text)
        with open(column_map, "w", encoding="utf-8") as file:
            file.write(text.replace("1 = 'ignore'", "1 = 'name'").replace("4 = 'ignore'", "4 = 'duration days'"))
        events = json.loads(self.ok("event", table, "--columns", column_map, "--json"))["events"]
        self.assertEqual([event["name"] for event in events], ["kindA", "kindB"])
        again = self.ok("columns", table, "--columns", column_map)
        self.assertIn("column 4  duration in days\n", again)
        self.assertIn("\n1 = 'name'\n", again)

    def test_a_table_of_fronts(self):
        fronts = os.path.join(SOURCE, "cases", "synthetic-laboratory-fronts.csv")
        meanings = [c["meaning"] for c in json.loads(self.ok("columns", fronts, "--fronts", "--json"))["columns"]]
        self.assertEqual(meanings[:4], ["name", "shear_stress", "normal_stress", "rupture_velocity"])

    def test_refuses(self):
        table = self.file("t.csv", TITLES)
        self.refused(2, "columns", table, "-o", table, says=["a file other than those read"])
        self.refused(2, "columns", self.file("m.xlsx", "PK\x03\x04"), says=["this is an Excel workbook"])
        self.refused(2, "columns", self.file("e.csv", ""), says=["empty"])
        self.refused(2, "columns", os.path.join(SOURCE, "cases", "ets.toml"), says=["ets.toml: not a table; allowed: a table with columns (CSV)"])
        self.refused(3, "columns", "/nowhere.csv", says=["/nowhere.csv"])
        self.assertEqual(run("columns").returncode, 2)


if __name__ == "__main__":
    unittest.main()
