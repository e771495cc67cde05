#!/usr/bin/env python3
"""Checks that no module of the library includes another that it may not use (ARCHITECTURE.md).

With an argument, the test checks another checkout:
tests/rooms_test.py [FOLDER]."""

import os
import pathlib
import re
import sys
import unittest

# The modules from the bottom up. Each may include those above it in this list.
MODULES = "math system text theory friction lattice averages events scenario runs".split()

# The folders of a module, from the bottom up, with the folders of the same module that they may include. "." stands for
# the files at the root of the module.
FOLDERS = {
    "math": {"simd": ""},
    "system": {"files": "."},
    "text": {"output": "."},
    "theory": {"medium": ".", "modulation": ".", "rupture": "modulation ."},
    "friction": {"state": "", "train_means": "", "laws": "state train_means", "ratio": "."},
    "lattice": {
        "chain/model": "chain",
        "chain/observe": "chain chain/model",
        "chain/events": "chain",
        "chain/explicit/levels": "chain chain/model",
        "chain/explicit": "chain chain/explicit/levels chain/model",
        "chain/implicit": "chain chain/model chain/observe chain/events",
        "chain": "chain/explicit chain/implicit chain/observe chain/events chain/model",
        "plane": "plane/direct",
        "plane/direct": "plane",
    },
    "averages": {
        "pulse/grid": "",
        "pulse/space": "pulse/grid",
        "pulse/staggered": "pulse/space pulse/grid",
        "pulse/time": "pulse/grid",
        "pulse/friction": "pulse/space pulse/grid",
        "pulse/steps": "pulse/friction pulse/time pulse/staggered pulse/space pulse/grid",
        "pulse/view": "pulse/staggered pulse/space pulse/grid",
        "pulse/observe": "pulse pulse/view",
        "pulse/checks": "pulse pulse/observe pulse/view",
        "pulse/contours": "pulse",
        "pulse": "pulse/checks pulse/contours pulse/observe pulse/view pulse/steps pulse/grid",
        "loops": "",
        "grid": "pulse/friction",
    },
    "events": {
        "catalogue": "catalogue/csv catalogue/fsp catalogue/json catalogue/subfaults catalogue/toml",
        "catalogue/csv": "catalogue",
        "catalogue/fsp": "catalogue",
        "catalogue/json": "catalogue",
        "catalogue/subfaults": "catalogue catalogue/fsp",
        "catalogue/toml": "catalogue",
        "inference/sampling": "",
        "inference": "inference/sampling",
        "finite_fault/source": "finite_fault catalogue inference",
        "finite_fault": "finite_fault/source catalogue inference",
        "results": "finite_fault finite_fault/source inference inference/sampling catalogue",
    },
    "runs": {
        "record/netcdf": "",
        "record": "record/netcdf",
        "record/events": "record record/netcdf",
        "record/faults": "record/netcdf",
    },
}

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def folders(top):
    return {name for name in os.listdir(top) if os.path.isdir(os.path.join(top, name))}


def sources_in(folder):
    for where, _, names in os.walk(folder):
        yield from (os.path.join(where, name) for name in sorted(names) if name.endswith((".cpp", ".hpp")))


class Modules(unittest.TestCase):
    def setUp(self):
        self.include, self.src = os.path.join(SOURCE, "include", "slipfront"), os.path.join(SOURCE, "src")
        self.modules = folders(self.include) | folders(self.src)

    def module_of(self, path):
        """The module of a file of the library; "" for a file that belongs to no module."""
        top = self.include if path.startswith(self.include) else self.src
        return os.path.relpath(path, top).rpartition("/")[0].partition("/")[0]

    def included_modules(self, path):
        """Pairs of an included name and its module ("" for a file that belongs to no module)."""
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for name in INCLUDE.findall(text):
            if name.startswith("slipfront/"):
                yield name, self.module_of(os.path.join(self.include, name.removeprefix("slipfront/")))
            else:  # by its path below src
                yield name, self.module_of(os.path.join(self.src, name))

    def folder_of(self, path):
        """The folder of a file within its module; "" at the module's root, and for public headers."""
        return "" if path.startswith(self.include) else os.path.relpath(path, self.src).partition("/")[2].rpartition("/")[0]

    def test_no_folder_of_a_module_includes_one_that_it_may_not_use(self):
        wrong = []
        for path in sources_in(self.src):
            module, folder = self.module_of(path), self.folder_of(path)
            if not folder:
                continue
            if folder not in FOLDERS.get(module, {}):
                wrong.append(f"unknown folder {module}/{folder}: add it to FOLDERS of tests/rooms_test.py")
                continue
            allowed = {folder, *("" if used == "." else used for used in FOLDERS[module][folder].split())}
            with open(path, encoding="utf-8") as file:
                names = INCLUDE.findall(file.read())
            for name in names:
                used = os.path.join(self.src, name)
                if not name.startswith("slipfront/") and self.module_of(used) == module and self.folder_of(used) not in allowed:
                    wrong.append(f"{os.path.relpath(path, SOURCE)} includes {name}")
        self.assertEqual(sorted(set(wrong)), [], "\n" + "\n".join(wrong))

    def test_every_module_is_in_the_table_and_in_the_architecture(self):
        for module in sorted(self.modules - set(MODULES)):
            self.fail(f"unknown module {module}: add it to MODULES of tests/rooms_test.py, and to ARCHITECTURE.md")
        for module in sorted(set(MODULES) - self.modules):
            self.fail(f"module {module} has neither include/slipfront/{module} nor src/{module}: remove it from MODULES")
        with open(os.path.join(SOURCE, "ARCHITECTURE.md"), encoding="utf-8") as file:
            architecture = file.read()
        for module in sorted(self.modules):
            self.assertRegex(architecture, rf"\b{module}\b", f"ARCHITECTURE.md does not name the module {module}")

    def test_public_headers_include_only_public_ones(self):
        wrong = []
        for path in sources_in(self.include):
            with open(path, encoding="utf-8") as file:
                wrong += [f"{os.path.relpath(path, SOURCE)} includes {name}, which is internal"
                          for name in INCLUDE.findall(file.read()) if not name.startswith("slipfront/")]
        self.assertFalse(wrong, "\n" + "\n".join(wrong))

    def test_each_equation_is_implemented_on_one_line_that_says_so(self):
        text = "\n".join(pathlib.Path(path).read_text(encoding="utf-8") for path in [*sources_in(self.include), *sources_in(self.src)])
        for equation in (*range(1, 11), 8.4, 8.7, 8.8):
            self.assertEqual(text.count(f"Eq. ({equation})"), 1, f"Eq. ({equation})")

    def test_no_module_includes_one_that_it_may_not_use(self):
        wrong = []
        for path in [*sources_in(self.include), *sources_in(self.src)]:
            module = self.module_of(path)
            allowed = {"", *(MODULES[: MODULES.index(module) + 1] if module in MODULES else [])}
            for name, used in self.included_modules(path):
                if used in allowed:
                    continue
                where = f"module {module}" if module else "which belongs to no module"
                wrong.append(f"{os.path.relpath(path, SOURCE)} ({where}) includes {name} of module {used}")
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))


if __name__ == "__main__":
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        SOURCE = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=0)
