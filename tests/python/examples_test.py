"""Each public function has an example in its docstring, and the examples print what they show."""

import doctest
import unittest
import warnings

import numpy

import slipfront
import slipfront.plots
from slipfront._accessor import SlipfrontAccessor

FUNCTIONS = {f"{module.__name__}.{name}": getattr(module, name) for module in (slipfront, slipfront.train, slipfront.medium, slipfront.plots) for name in module.__all__
             if callable(getattr(module, name)) and not isinstance(getattr(module, name), type)}
FUNCTIONS["Dataset.slipfront"] = SlipfrontAccessor
FUNCTIONS["Dataset.slipfront.si"] = SlipfrontAccessor.si


class Examples(unittest.TestCase):
    def test_each_function_has_an_example_that_is_right(self):
        for name, function in FUNCTIONS.items():
            with self.subTest(name), warnings.catch_warnings():
                warnings.simplefilter("ignore")  # a short chain warns of its error
                test = doctest.DocTestParser().get_doctest(function.__doc__, {"slipfront": slipfront, "np": numpy}, name, None, None)
                self.assertTrue(test.examples, "the docstring has no example")
                report: list[str] = []
                doctest.DocTestRunner(verbose=False).run(test, out=report.append)
                self.assertEqual("".join(report), "")


if __name__ == "__main__":
    unittest.main()
