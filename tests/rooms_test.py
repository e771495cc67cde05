#!/usr/bin/env python3
"""Checks that no module of the library includes another that it may not use (ARCHITECTURE.md).

A new module is one line in MODULES. With an argument, the test checks another checkout:
tests/rooms_test.py [FOLDER]."""

import os
import pathlib
import re
import sys
import unittest

# Each module, from the bottom up, with the modules that it may include: only modules above it in this table. All modules
# may include `foundation`.
MODULES = {
    "foundation": "",
    "elliptic": "",
    "medium": "",
    "output": "",
    "train": "elliptic",
    "friction": "train elliptic",
    "modulation": "train elliptic",
    "rupture": "modulation train elliptic",
    "chain": "output friction modulation train elliptic",
    "pulse": "output friction rupture modulation train elliptic",
    "plane": "output pulse friction modulation train elliptic",
    "friction_ratio": "friction",
    "scenario": "chain pulse plane output friction rupture train elliptic medium",
    "catalogue": "friction_ratio rupture medium",
    "inference": "catalogue friction_ratio rupture medium elliptic",
    "finite_fault": "inference catalogue friction_ratio friction pulse rupture modulation train medium",
    "results": "finite_fault inference catalogue friction_ratio rupture medium",
    "record": "results finite_fault friction catalogue plane output medium",
    "run": "record friction results finite_fault inference catalogue scenario chain pulse plane output rupture modulation train medium",
}

# The folders of a module, from the bottom up, with the folders of the same module that they may include. "." stands for the
# files at the root of the module, which may include all of its folders.
FOLDERS = {
    "catalogue": {"csv": ".", "fsp": ".", "json": ".", "toml": "."},
    "finite_fault": {"source": "."},
    "inference": {"sampling": ""},
    "record": {"files": "", "netcdf": "files", "runs": "netcdf files", "events": "runs netcdf files", "faults": "netcdf files"},
    "foundation": {"math": "text", "simd": "", "text": ""},
    "friction": {"state": "", "train_means": "", "laws": "state train_means"},
    "chain": {
        "model": "",
        "measure": "model",
        "events": "",
        "implicit": "model measure events",
        "explicit/levels": "model",
        "explicit": "explicit/levels model",
    },
    "plane": {"averaged": ".", "direct": ".", "grid": ". direct"},
    "pulse": {
        "grid": "",
        "space": "grid",
        "staggered": "space grid",
        "time": "grid",
        "friction": "space grid",
        "steps": "friction time staggered space grid",
        "view": "staggered space grid",
        "observe": ". view",
        "checks": ". observe view",
        "contours": ".",
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
            self.fail(f"unknown module {module}: add it to the table MODULES of tests/rooms_test.py, with the modules that it "
                      "may include, and to ARCHITECTURE.md")
        for module in sorted(set(MODULES) - self.modules):
            self.fail(f"module {module} has neither include/slipfront/{module} nor src/{module}: remove it from MODULES")
        with open(os.path.join(SOURCE, "ARCHITECTURE.md"), encoding="utf-8") as file:
            architecture = file.read()
        for module in sorted(self.modules):
            self.assertRegex(architecture, rf"\b{module}\b", f"ARCHITECTURE.md does not name the module {module}")

    def test_modules_use_only_modules_above_them_in_the_table(self):
        below = set()
        for module, uses in MODULES.items():
            for used in uses.split():
                self.assertIn(used, below, f"MODULES: {module} may not use {used}, which is not above it in the table")
            below.add(module)

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
            allowed = {"", "foundation", module, *MODULES.get(module, "").split()}
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
