"""The reference of the Python package on the site has an entry for each public name."""

import pathlib
import unittest

import slipfront
import slipfront.plots
from support import SOURCE

REFERENCE = pathlib.Path(SOURCE, "docs/site/python_reference.rst").read_text(encoding="utf-8")

#: Constants, which the text of the package describes.
CONSTANTS = ("__version__", "cases")


class Reference(unittest.TestCase):
    def test_has_an_entry_for_each_public_name(self):
        for module in (slipfront, slipfront.plots):
            for name in set(module.__all__) - set(CONSTANTS):
                with self.subTest(name):
                    self.assertRegex(REFERENCE, rf":: {module.__name__}\.{name}\n")

    def test_describes_constants_in_the_text_of_the_package(self):
        for name in CONSTANTS:
            self.assertIn(name, slipfront.__doc__)

    def test_each_public_name_has_a_docstring(self):
        for module in (slipfront, slipfront.plots, slipfront.train, slipfront.medium):
            for name in getattr(module, "__all__", [n for n in dir(module) if not n.startswith("_")]):
                if name not in CONSTANTS and callable(getattr(module, name)):
                    with self.subTest(name):
                        self.assertTrue((getattr(module, name).__doc__ or "").strip())


if __name__ == "__main__":
    unittest.main()
