"""Checks that programs and libraries load their libraries only from fixed folders, and are hardened.

Usage: hardening_test.py BUILD_DIR HARDENED. The loader looks up an empty or relative path in the dynamic section in the current
folder of the user. A library that somebody has put there would run."""

import pathlib
import subprocess
import sys
import unittest

BUILD, HARDENED = pathlib.Path(sys.argv[1]), sys.argv[2] == "ON"


def programs_and_libraries():
    for path in sorted(BUILD.rglob("*")):
        if path.is_symlink() or not path.is_file() or "CMakeFiles" in path.parts or path.suffix in (".o", ".a"):
            continue
        if "consumer" in path.parts:  # another project, built by another test with its own flags
            continue
        if "node_modules" in path.parts:  # tools that build the explorer's page
            continue
        with path.open("rb") as file:
            if file.read(4) == b"\x7fELF":
                yield path


def readelf(option, path):
    return subprocess.run(["readelf", "-W", option, path], capture_output=True, text=True, check=True).stdout


class Hardening(unittest.TestCase):
    def test_library_paths_begin_at_the_root_or_at_the_file(self):
        found = 0
        for path in programs_and_libraries():
            found += 1
            for line in readelf("-d", path).splitlines():
                if "(RUNPATH)" not in line and "(RPATH)" not in line:
                    continue
                for entry in line.partition("[")[2].rpartition("]")[0].split(":"):
                    self.assertTrue(entry.startswith(("/", "$ORIGIN/")) or entry == "$ORIGIN", f"{path}: {line.strip()}")
                    self.assertNotIn(str(BUILD), entry, f"{path}: a build tree can be moved")
        self.assertGreater(found, 2)

    @unittest.skipUnless(HARDENED, "SLIPFRONT_HARDEN is off")
    def test_relocations_are_read_only_before_main(self):
        for path in programs_and_libraries():
            self.assertTrue("GNU_RELRO" in readelf("-l", path), path)
            self.assertTrue("NOW" in readelf("-d", path), path)

    @unittest.skipUnless(HARDENED, "SLIPFRONT_HARDEN is off")
    def test_stacks_are_protected(self):
        library = next(path for path in programs_and_libraries() if path.name.startswith("libslipfront.so"))
        self.assertTrue("__stack_chk_fail" in readelf("--dyn-syms", library), library)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
