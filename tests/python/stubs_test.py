"""The stubs say what the modules have: every public name, every parameter."""

import ast
import importlib
import inspect
import pathlib
import unittest

import slipfront


class Stubs(unittest.TestCase):
    def test_agree_with_the_modules(self):
        for name in ("slipfront", "slipfront.train", "slipfront.medium", "slipfront.plots"):
            module = importlib.import_module(name)
            self.assertTrue(module.__doc__)
            stub = ast.parse(pathlib.Path(module.__file__).with_suffix(".pyi").read_text())
            functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
            classes = {node.name for node in stub.body if isinstance(node, ast.ClassDef)}
            values = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
            modules = {alias.asname for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names if node.level}
            self.assertEqual(set(functions) | classes | values - {"__all__"} | modules, set(module.__all__), name)
            for key, node in functions.items():
                real = inspect.signature(getattr(module, key)).parameters.values()
                self.assertTrue(getattr(module, key).__doc__, key)
                arguments = node.args
                optional = len(arguments.args) - len(arguments.defaults)
                said = [(a.arg, False, i >= optional) for i, a in enumerate(arguments.args)]
                said += [(a.arg, True, d is not None) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]
                said += [(a.arg, False, False) for a in [arguments.kwarg] if a]
                self.assertEqual(said, [(p.name, p.kind is p.KEYWORD_ONLY, p.default is not p.empty) for p in real], key)

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((pathlib.Path(slipfront.__file__).parent / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
