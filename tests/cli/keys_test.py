"""slipfront keys as a user meets it."""

import json
import unittest

from support import CommandLine


class Keys(CommandLine):
    def test_json_describes_each_key(self):
        rows = json.loads(self.ok("keys", "--json"))["keys"]
        self.assertGreater(len(rows), 60)
        for row in rows:
            self.assertEqual(list(row), ["table", "key", "type", "unit", "allowed", "default", "meaning", "laws"])
        cells = [row for row in rows if (row["table"], row["key"]) == ("pulse", "cells")]
        self.assertEqual([(c["type"], c["allowed"], c["default"]) for c in cells], [("whole number", ">= 4 and <= 1e+07", "400")])

    def test_one_table(self):
        out = self.ok("keys", "time")
        self.assertIn("[time]", out)
        self.assertIn("end", out)
        self.assertNotIn("cells", out)

    def test_unknown_table_names_the_nearest(self):
        self.refused(2, "keys", "pulze", says=["TABLE", "'pulze'", "'pulse'"])


if __name__ == "__main__":
    unittest.main()
