#!/usr/bin/env python3
"""Checks that no room of the library includes another that it may not use (ARCHITECTURE.md).

A new room is one line in ROOMS. With arguments, the test looks at another checkout:
tests/rooms_test.py [FOLDER]."""

import os
import re
import sys
import unittest

# Each room with the rooms that it may include, from the bottom up: only rooms above it in this table. All may include
# `foundation`.
ROOMS = {
    "foundation": "",
    "elliptic": "",
    "medium": "",
    "output": "",
    "train": "elliptic",
    "friction": "train elliptic",
    "modulation": "train elliptic",
    "rupture": "modulation train elliptic",
    "chain": "output friction modulation train elliptic",
    "pulse": "output friction modulation train elliptic",
    "friction_ratio": "pulse rupture friction",
    "scenario": "chain pulse friction train medium",
    "catalogue": "friction_ratio rupture medium",
    "inference": "catalogue friction_ratio rupture medium",
    "finite_fault": "inference catalogue pulse rupture modulation train medium",
    "results": "finite_fault inference catalogue friction_ratio medium",
    "setup": "scenario chain pulse output friction rupture modulation train elliptic",
    "record": "results friction catalogue output medium",
    "run": "record friction setup results finite_fault inference catalogue scenario chain pulse output medium",
}

# The folders of a module, from the bottom up, with the folders next to them that they may include; "." are the files at
# the root of the module, which may include all of its folders.
FOLDERS = {
    "catalogue": {"csv": ".", "fsp": ".", "toml": "."},
    "record": {"files": "", "netcdf": "files", "pulses": "netcdf files", "events": "pulses netcdf files"},
    "scenario": {"text": "", "formula": "text", "profile": "formula text", "friction": ". profile formula text"},
    "foundation": {"math": "text", "simd": "", "text": ""},
    "friction": {"state": "", "train_means": "", "laws": "state train_means"},
    "chain": {
        "model": "",
        "measure": "model",
        "implicit": "model measure",
        "explicit/levels": "model",
        "explicit": "explicit/levels model",
    },
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
    },
}

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def folders(top):
    return {name for name in os.listdir(top) if os.path.isdir(os.path.join(top, name))}


def sources_in(folder):
    for where, _, names in os.walk(folder):
        yield from (os.path.join(where, name) for name in sorted(names) if name.endswith((".cpp", ".hpp")))


class Rooms(unittest.TestCase):
    def setUp(self):
        self.include, self.src = os.path.join(SOURCE, "include", "slipfront"), os.path.join(SOURCE, "src")
        self.rooms = folders(self.include) | folders(self.src)

    def room_of(self, path):
        """The room of a file of the library; "" for what belongs to all rooms."""
        top = self.include if path.startswith(self.include) else self.src
        return os.path.relpath(path, top).rpartition("/")[0].partition("/")[0]

    def included_rooms(self, path):
        """Pairs of a line and the room that it includes ("" for what belongs to all rooms)."""
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for name in INCLUDE.findall(text):
            if name.startswith("slipfront/"):
                yield name, self.room_of(os.path.join(self.include, name.removeprefix("slipfront/")))
            else:  # by its path below src
                yield name, self.room_of(os.path.join(self.src, name))

    def folder_of(self, path):
        """The folder of a file within its module; "" at the module's root, and for public headers."""
        return "" if path.startswith(self.include) else os.path.relpath(path, self.src).partition("/")[2].rpartition("/")[0]

    def test_no_folder_of_a_module_includes_one_that_it_may_not_use(self):
        wrong = []
        for path in sources_in(self.src):
            room, folder = self.room_of(path), self.folder_of(path)
            if not folder:
                continue
            if folder not in FOLDERS.get(room, {}):
                wrong.append(f"unknown folder {room}/{folder}: add it to FOLDERS of tests/rooms_test.py")
                continue
            allowed = {folder, *("" if used == "." else used for used in FOLDERS[room][folder].split())}
            with open(path, encoding="utf-8") as file:
                names = INCLUDE.findall(file.read())
            for name in names:
                used = os.path.join(self.src, name)
                if not name.startswith("slipfront/") and self.room_of(used) == room and self.folder_of(used) not in allowed:
                    wrong.append(f"{os.path.relpath(path, SOURCE)} includes {name}")
        self.assertEqual(sorted(set(wrong)), [], "\n" + "\n".join(wrong))

    def test_every_room_is_in_the_table_and_in_the_architecture(self):
        for room in sorted(self.rooms - set(ROOMS)):
            self.fail(f"unknown room {room}: add it to the table ROOMS of tests/rooms_test.py, with the rooms that it "
                      "may include, and to ARCHITECTURE.md")
        for room in sorted(set(ROOMS) - self.rooms):
            self.fail(f"room {room} has neither include/slipfront/{room} nor src/{room}: take it out of ROOMS")
        with open(os.path.join(SOURCE, "ARCHITECTURE.md"), encoding="utf-8") as file:
            architecture = file.read()
        for room in sorted(self.rooms):
            self.assertRegex(architecture, rf"\b{room}\b", f"ARCHITECTURE.md does not name the room {room}")

    def test_the_table_points_down(self):
        below = set()
        for room, uses in ROOMS.items():
            for used in uses.split():
                self.assertIn(used, below, f"ROOMS: {room} may not use {used}, which is not above it in the table")
            below.add(room)

    def test_public_headers_include_only_public_ones(self):
        wrong = []
        for path in sources_in(self.include):
            with open(path, encoding="utf-8") as file:
                wrong += [f"{os.path.relpath(path, SOURCE)} includes {name}, which is internal"
                          for name in INCLUDE.findall(file.read()) if not name.startswith("slipfront/")]
        self.assertFalse(wrong, "\n" + "\n".join(wrong))

    def test_no_room_includes_one_that_it_may_not_use(self):
        wrong = []
        for path in [*sources_in(self.include), *sources_in(self.src)]:
            room = self.room_of(path)
            allowed = {"", "foundation", room, *ROOMS.get(room, "").split()}
            for name, used in self.included_rooms(path):
                if used in allowed:
                    continue
                where = f"room {room}" if room else "which belongs to all rooms"
                wrong.append(f"{os.path.relpath(path, SOURCE)} ({where}) includes {name} of room {used}")
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))


if __name__ == "__main__":
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        SOURCE = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=0)
