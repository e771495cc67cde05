"""./run, ./test and .ci/packages on machines of all kinds: the tools that they call are stand-ins. With SLIPFRONT_BUILD, also
which files a build reads."""

import fcntl
import os
import pathlib
import pty
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SLIPFRONT_SOURCE"])

CMAKE = r"""#!/bin/bash
echo "cmake $*" >>"$CALLS"
[ "$1" != --version ] || { echo "cmake version ${CMAKE_VERSION:-3.25.1}"; exit 0; }
arguments="$*"
while [ $# -gt 1 ]; do case "$1" in -B | --build) build="$2" ;; esac; shift; done
case "$arguments" in
  --preset*)
    if [ -n "$CMAKE_ERROR" ]; then echo "$CMAKE_ERROR"; exit 1; fi
    [ ! -f "$build/CMakeCache.txt" ] || was="$(<"$build/CMakeCache.txt")"
    printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nCMAKE_CACHEFILE_DIR:INTERNAL=%s\n' "$PWD" "$build" >"$build/CMakeCache.txt"
    [[ $arguments$was != *SLIPFRONT_TESTS*=ON* ]] || echo "SLIPFRONT_TESTS:BOOL=ON" >>"$build/CMakeCache.txt"
    touch "$build/build.ninja"
    ;;
  *)
    mkdir -p "$build/bin"
    [ -z "$BUILD_OUTPUT" ] || printf '%b\n' "$BUILD_OUTPUT"
    [ -z "$BUILD_FILLS" ] || { echo 1 >"$BUILD_FILLS"; exit 1; }
    [[ $BUILD_OUTPUT != *FAILED* ]] || exit 1
    [ -z "$EDITED_MEANWHILE" ] || { sleep 0.02; echo new >"$EDITED_MEANWHILE"; }  # file times advance in steps of milliseconds
    for program in slipfront unit_pulse; do
      printf '#!/bin/bash\necho "%s $* of %s"\n' $program "$build" >"$build/bin/$program"
      chmod +x "$build/bin/$program"
    done
    ;;
esac
"""
ALL_INSTALLED = """#!/bin/bash
echo "dpkg-query" >>"$CALLS"
while [ $# -gt 0 ]; do case "$1" in -W) ;; -f) shift ;; *) printf '%s:installed ' "$1" ;; esac; shift; done
"""
NONE_INSTALLED = "#!/bin/bash\nexit 1\n"
CONFIGURING = "slipfront: looking for the compiler and the libraries"
TOOLS = "bash env flock grep cksum cut mkdir find rm id mktemp touch chmod readlink df awk mv sleep"
READ_BY_BUILD = re.search(r'"\$root"/\{(.*)\}', (SOURCE / "run").read_text()).group(1).split(",")


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tools, self.calls, self.packages = self.folder / "tools", self.folder / "calls", self.folder / "dpkg"
        self.tools.mkdir()
        self.packages.mkdir()
        (self.packages / "status").write_text("")
        for tool in TOOLS.split():
            (self.tools / tool).symlink_to(shutil.which(tool))
        self.tool("cmake", CMAKE)
        self.tool("dpkg-query", ALL_INSTALLED)
        self.checkout = self.copy(SOURCE, "checkout")

    def copy(self, source, name):
        """A checkout with the scripts and, in place of the sources, empty folders."""
        checkout = self.folder / name
        checkout.mkdir()
        for part in READ_BY_BUILD + ["test"]:
            if part in ("run", "test", ".ci", "apt-packages.txt"):
                (shutil.copytree if (source / part).is_dir() else shutil.copy)(source / part, checkout / part)
            elif (SOURCE / part).is_dir():
                (checkout / part).mkdir(parents=True, exist_ok=True)
            else:
                (checkout / part).parent.mkdir(parents=True, exist_ok=True)
                (checkout / part).write_text("")
        (checkout / "tests/pulse").mkdir(parents=True)
        return checkout

    def tool(self, name, text):
        (self.tools / name).unlink(missing_ok=True)
        (self.tools / name).write_text(text)
        (self.tools / name).chmod(0o755)

    def environment(self, **variables):
        return {"PATH": str(self.tools), "HOME": str(self.folder / "home"), "CALLS": str(self.calls), "DPKG_ADMINDIR": str(self.packages), **variables}

    def script(self, name, *arguments, checkout=None, **variables):
        return subprocess.run([(checkout or self.checkout) / name, *arguments], env=self.environment(**variables), capture_output=True, text=True, timeout=1200)

    def run_in(self, checkout, *arguments, **variables):
        return self.script("run", *arguments, checkout=checkout, **variables)

    def on_terminal(self, name, *arguments, at_output=lambda: None, **variables):
        """Returns what the script writes to a terminal that is its stderr. Calls `at_output` when it has written something."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen([self.checkout / name, *arguments], env=self.environment(TERM="xterm", **variables), stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 4096):
                shown += part
                at_output()
        except OSError:  # nobody has the terminal any more
            pass
        os.close(ours)
        process.wait()
        return shown.decode()

    def made_calls(self):
        """The calls of cmake and dpkg-query since the last call of this method."""
        calls = self.calls.read_text().splitlines() if self.calls.exists() else []
        self.calls.write_text("")
        return calls

    def assert_one_line(self, done, pattern, code=3):
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (code, "", 1), done.stderr)
        self.assertRegex(done.stderr, f"^slipfront: {pattern}")


class Run(Scripts):
    def test_builds_and_runs(self):
        done = self.run_in(self.checkout, "pulse", "x.toml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, f"slipfront pulse x.toml of {self.checkout}/build/release\n")

    def test_a_second_call_asks_neither_dpkg_nor_cmake(self):
        self.run_in(self.checkout)
        self.made_calls()
        done = self.run_in(self.checkout, "--version")
        self.assertEqual((done.stdout, done.stderr), (f"slipfront --version of {self.checkout}/build/release\n", ""))
        self.assertEqual(self.made_calls(), [])

    def test_builds_again_when_something_has_changed(self):
        source = self.checkout / "src/a.cpp"
        source.write_text("old")
        self.run_in(self.checkout)

        def edit_without_a_new_time():
            times = source.stat()
            source.write_text("new")
            os.utime(source, ns=(times.st_atime_ns, times.st_mtime_ns))

        changes = {"an edit": lambda: source.write_text("new"),
                   "an edit that keeps the time": edit_without_a_new_time,
                   "an old file that takes the name of another": lambda: (self.checkout / "b").replace(source),
                   "a new file": lambda: (self.checkout / "src/c.cpp").write_text(""),
                   "a file that goes": lambda: (self.checkout / "src/c.cpp").unlink(),
                   "a file of another folder": lambda: (self.checkout / "docs/scenario.md").write_text("new"),
                   "a package of the system": lambda: (self.packages / "status").write_text("new"),
                   "a configuration": lambda: (self.checkout / "build/release/build.ninja").write_text("new"),
                   "a program that goes": lambda: (self.checkout / "build/release/bin/slipfront").unlink()}
        (self.checkout / "b").write_text("older")
        self.run_in(self.checkout)
        for name, change in changes.items():
            with self.subTest(name):
                self.made_calls()
                change()
                done = self.run_in(self.checkout)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(f"cmake --build {self.checkout}/build/release --target slipfront_run", self.made_calls())
                self.run_in(self.checkout)
                self.assertEqual(self.made_calls(), [])

    def test_builds_again_when_something_changes_during_the_build(self):
        self.run_in(self.checkout, EDITED_MEANWHILE=str(self.checkout / "src/a.cpp"))
        self.made_calls()
        self.run_in(self.checkout)
        self.assertEqual(len(self.made_calls()), 2)

    def test_files_that_python_stores_start_no_build(self):
        self.run_in(self.checkout)
        stored = self.checkout / "python/__pycache__"
        stored.mkdir()
        self.run_in(self.checkout)
        self.made_calls()
        (stored / "a.pyc").write_text("")
        self.run_in(self.checkout)
        self.assertEqual(self.made_calls(), [])

    def test_a_failed_build_is_tried_again(self):
        for _ in range(2):
            self.assertEqual(self.run_in(self.checkout, BUILD_OUTPUT="FAILED: a.o").returncode, 3)
        self.assertEqual(self.run_in(self.checkout).returncode, 0)

    def test_through_a_link_and_with_a_search_path_of_cd(self):
        elsewhere = self.folder / "elsewhere"
        (elsewhere / "checkout").mkdir(parents=True)
        (elsewhere / "run").symlink_to("../checkout/run")
        for start in (elsewhere / "run", "checkout/run"):
            done = subprocess.run([start], env=self.environment(CDPATH=str(elsewhere)), cwd=self.folder, capture_output=True, text=True, timeout=1200)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout, f"slipfront  of {self.checkout}/build/release\n")
        self.assertEqual(sorted(os.listdir(elsewhere)), ["checkout", "run"])

    def test_warnings_are_errors_in_continuous_integration(self):
        self.run_in(self.checkout, CI="true")
        self.assertIn(f"cmake --preset release -B {self.checkout}/build/release -DSLIPFRONT_WERROR=ON", self.made_calls())

    def test_read_only_checkout_builds_elsewhere(self):
        (self.checkout / "build").write_text("in the way")  # root may write anywhere else
        done = self.run_in(self.checkout)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"of {self.folder}/home/.cache/slipfront/", done.stdout)

    def test_where_others_may_write_nothing_is_built(self):
        (self.checkout / "build").write_text("in the way")
        done = self.run_in(self.checkout, XDG_CACHE_HOME="relative")
        self.assertIn(f"of {self.folder}/home/.cache/slipfront/", done.stdout)
        folder = pathlib.Path(done.stdout.split(" of ")[1].strip())
        shutil.rmtree(self.folder / "home")
        (self.folder / "home").write_text("no folder")
        self.assert_one_line(self.run_in(self.checkout), f"neither {self.checkout}/build nor {folder} can be written; set XDG_CACHE_HOME ")

    @unittest.skipUnless(os.geteuid() == 0, "only root can give a folder away")
    def test_a_folder_of_another_user_is_not_used(self):
        (self.checkout / "build").write_text("in the way")
        folder = pathlib.Path(self.run_in(self.checkout).stdout.split(" of ")[1].strip())
        os.chown(folder, 65534, 65534)
        self.assert_one_line(self.run_in(self.checkout), f"{folder} belongs to another user; ")

    def test_a_copy_builds_its_own_sources(self):
        self.run_in(self.checkout)
        copy = self.copy(self.checkout, "copy")
        shutil.copytree(self.checkout / "build", copy / "build")
        stale = copy / "build/release/stale"
        stale.write_text("")
        done = self.run_in(copy)
        self.assertIn(f"of {copy}/build/release", done.stdout)
        self.assertFalse(stale.exists())
        self.assertEqual(self.calls.read_text().count("--preset"), 2)


class Progress(Scripts):
    def test_a_terminal_shows_one_line_of_the_build(self):
        lines = r"[0/2 0.001] Re-checking\n[10/40 30.2] Building a\n[30/40 600.7] Building b\ncc1plus prints this\n[40/40 700.1] Linking c"
        shown = self.on_terminal("run", BUILD_OUTPUT=lines)
        self.assertEqual([line for line in shown.split("\r\x1b[K") if line],
                         [CONFIGURING, "slipfront: building, 10 of 40 files, about 90 s left", "slipfront: building, 30 of 40 files, about 3 min left",
                          "slipfront: building, 40 of 40 files, about 1 s left"])
        self.assertTrue(shown.endswith("\r\x1b[K"))
        self.assertIn("cc1plus prints this", (self.checkout / "build/release/build.log").read_text())

    def test_a_terminal_shows_one_line_of_the_packages(self):
        self.tool("dpkg-query", NONE_INSTALLED)
        self.tool("sudo", "#!/bin/bash\nexec \"$@\"\n")
        # apt-get closes this file descriptor for dpkg, whose scripts fail if it is their standard output.
        self.tool("apt-get", r"""#!/bin/bash
[[ $* =~ APT::Status-Fd=([3-9])" " ]] || exit 100
printf 'dlstatus:3:2.5:Retrieving file 3 of 266 (5s remaining)\npmstatus:dpkg-exec:0:Running dpkg\npmstatus:libc6:amd64:41.2:Unpacking libc6 (amd64)\n' >&"${BASH_REMATCH[1]}"
""")
        shown = self.on_terminal("run").split("\n", 1)[1]
        self.assertEqual([line for line in shown.split("\r\x1b[K") if line],
                         ["slipfront: downloading file 3 of 266", "slipfront: installing 266 packages, 0 % done, now dpkg-exec",
                          "slipfront: installing 266 packages, 41 % done, now libc6", CONFIGURING])

    def test_a_second_call_waits_on_a_terminal_with_a_reason(self):
        (self.checkout / "build/release").mkdir(parents=True)
        with open(self.checkout / "build/release/lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            shown = self.on_terminal("run", at_output=lambda: fcntl.flock(lock, fcntl.LOCK_UN))
        self.assertRegex(shown, "^slipfront: waiting for another call that builds in ")


class Elsewhere(Scripts):
    """Each obstacle ends in one line that states what to do."""

    def test_without_root(self):
        self.tool("dpkg-query", NONE_INSTALLED)
        self.tool("id", "#!/bin/bash\necho 1000\n")
        self.tool("apt-get", "#!/bin/bash\nexit 100\n")
        self.assert_one_line(self.run_in(self.checkout), "Debian packages are missing, and only root .*; run as root: apt-get install g\\+\\+ cmake ")
        self.tool("sudo", "#!/bin/bash\nexit 1\n")
        self.assert_one_line(self.run_in(self.checkout), "Debian packages are missing, and sudo .*; run as root: apt-get install g\\+\\+ cmake ")

    def test_without_apt(self):
        self.tool("dpkg-query", NONE_INSTALLED)
        self.assert_one_line(self.run_in(self.checkout), "Debian packages .* apt-get is not there .*; run as root: apt-get install g\\+\\+ cmake ")

    def test_only_missing_packages_are_named(self):
        self.tool("dpkg-query", ALL_INSTALLED + "exit 1\n")
        self.tool("dpkg-query", ALL_INSTALLED.replace("*)", "libfmt-dev) ;; python3) printf 'python3:config-files ' ;; *)"))
        self.assert_one_line(self.run_in(self.checkout), ".*apt-get install libfmt-dev python3$")

    def test_offline(self):
        self.tool("dpkg-query", NONE_INSTALLED)
        self.tool("sudo", "#!/bin/bash\nexec \"$@\"\n")
        self.tool("apt-get", "#!/bin/bash\necho 'Err: Temporary failure resolving'\necho 'E: Unable to locate package g++' >&2\nexit 100\n")
        done = self.run_in(self.checkout)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        first, second = done.stderr.splitlines()
        self.assertRegex(first, "^slipfront: installing with apt-get: .*cmake")
        self.assertRegex(second, "^slipfront: .*no network.*apt-get install .*cmake")

    def test_lists_of_packages_are_fetched_if_they_are_empty(self):
        self.tool("dpkg-query", NONE_INSTALLED)
        self.tool("sudo", "#!/bin/bash\nexec \"$@\"\n")
        self.tool("apt-get", """#!/bin/bash
echo "apt-get $*" >>"$CALLS"
case "$*" in *update*) : >"$CALLS.lists" ;; *) [ -f "$CALLS.lists" ] || { echo "E: Unable to locate package"; exit 100; } ;; esac
""")
        done = self.run_in(self.checkout)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (0, 1), done.stderr)
        self.assertEqual([re.search(" (install|update)", call).group(1) for call in self.made_calls() if call.startswith("apt-get")],
                         ["install", "update", "install"])

    def test_another_distribution(self):
        (self.tools / "dpkg-query").unlink()
        self.assertEqual(self.run_in(self.checkout).stderr, "")
        shutil.rmtree(self.checkout / "build")
        error = "-- Detecting\nCMake Error at CMakeLists.txt:76 (find_package):\n  Could not find fmt,\n  which is a library.\n\n  More.\n\n\n-- Configuring incomplete"
        self.assert_one_line(self.run_in(self.checkout, CMAKE_ERROR=error),
                             "Could not find fmt, which is a library. Install what corresponds to these Debian packages, and try again: .* libfmt-dev .* The log is in /")
        (self.tools / "cmake").unlink()
        self.assert_one_line(self.run_in(self.checkout), "cmake is missing. Install .* cmake .*")

    def test_old_tools(self):
        self.assert_one_line(self.run_in(self.checkout, CMAKE_VERSION="3.18.4"), "CMake 3.22 or later is needed, and .*/cmake is 3.18.4")
        self.assertEqual(self.run_in(self.checkout, CMAKE_VERSION="4.0.0-rc1").returncode, 0)
        self.assertIn("CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12", (SOURCE / "CMakeLists.txt").read_text())

    def test_full_disk(self):
        free = self.folder / "free"
        self.tool("df", f"#!/bin/bash\nread -r free <{free}\nprintf 'Filesystem 1048576-blocks Used Available Capacity Mounted on\\n/dev/a 999 9 %s 9%% /\\n' \"$free\"\n")
        free.write_text("150\n")
        self.assert_one_line(self.run_in(self.checkout), f"the disk is full: {self.checkout}/build/release has 150 MB left, and 200 MB are needed")
        free.write_text("900\n")
        self.assert_one_line(self.run_in(self.checkout, BUILD_FILLS=str(free)), "the disk is full: .* has 1 MB left, and 5 MB are needed")

    def test_a_failed_build_shows_the_error_and_not_the_command(self):
        output = r"[1/9 0.1] Building a\nFAILED: b.o\n/usr/bin/c++ -O2 b.cpp\nb.cpp:1: error: no\n[2/9 0.2] Building c"
        done = self.run_in(self.checkout, BUILD_OUTPUT=output)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertEqual(done.stderr.splitlines(), ["FAILED: b.o", "b.cpp:1: error: no", f"slipfront: the build failed; the log is in {self.checkout}/build/release/build.log"])
        done = self.run_in(self.checkout, BUILD_OUTPUT=r"FAILED: b.o\nc++ b.cpp\nc++: fatal error: Killed signal terminated program cc1plus")
        self.assertRegex(done.stderr.splitlines()[-1], "memory ran out; try CMAKE_BUILD_PARALLEL_LEVEL=1 .*/run$")


class Test(Scripts):
    def setUp(self):
        super().setUp()
        self.tool("ctest", "#!/bin/bash\necho \"ctest $*\"\n")
        self.tool("nproc", "#!/bin/bash\necho 1\n")

    def test_through_a_link_and_with_a_search_path_of_cd(self):
        elsewhere = self.folder / "elsewhere"
        (elsewhere / "checkout").mkdir(parents=True)
        (elsewhere / "test").symlink_to("../checkout/test")
        for start in (elsewhere / "test", "checkout/test"):
            done = subprocess.run([start], env=self.environment(CDPATH=str(elsewhere)), cwd=self.folder, capture_output=True, text=True, timeout=1200)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout, f"ctest --test-dir {self.checkout}/build/release --timeout 1500 --output-on-failure -j 1 -LE full\n")
        self.assertEqual(sorted(os.listdir(elsewhere)), ["checkout", "test"])

    def test_tests_are_added_to_what_run_has_built_and_stay(self):
        self.run_in(self.checkout)
        self.made_calls()
        self.script("test")
        build = f"{self.checkout}/build/release"
        self.assertEqual([call for call in self.made_calls() if "--preset" in call], [f"cmake --preset release -B {build} -DSLIPFRONT_TESTS=ON"])
        (self.checkout / "CMakePresets.json").write_text("new")
        self.run_in(self.checkout)
        calls = self.made_calls()
        self.assertIn(f"cmake --preset release -B {build}", calls)  # the folder stores that the tests are on
        self.assertIn(f"cmake --build {build} --target slipfront_run", calls)
        self.script("test")
        self.assertEqual([call for call in self.made_calls() if "--preset" in call], [])

    def test_tiers_presets_and_modules(self):
        self.assertRegex(self.script("test", "-R", "event").stdout, "-LE full -R event\n$")
        self.assertRegex(self.script("test", "full", "-R", "event").stdout, "release .* -j 1 -R event\n$")
        self.assertRegex(self.script("test", "clang").stdout, "ctest --test-dir .*/build/clang .* -j 1\n$")
        self.made_calls()
        done = self.script("test", "pulse", "--gtest_filter=A.*")
        self.assertEqual(done.stdout, f"unit_pulse --gtest_filter=A.* of {self.checkout}/build/release\n")
        self.assertIn(f"cmake --build {self.checkout}/build/release --target unit_pulse", self.made_calls())
        self.assert_one_line(self.script("test", "nonsense"), "tests/nonsense does not exist; allowed: ", code=2)


@unittest.skipUnless("SLIPFRONT_BUILD" in os.environ, "needs a build")
class Inputs(unittest.TestCase):
    def test_run_looks_at_every_file_that_the_build_reads(self):
        build = os.environ["SLIPFRONT_BUILD"]

        def ninja(*arguments):
            return subprocess.run(["ninja", "-C", build, "-t", *arguments], capture_output=True, text=True, check=True).stdout.splitlines()

        inputs = ninja("inputs", "slipfront_run")
        headers = [line.strip() for line in ninja("deps", *[name for name in inputs if name.endswith(".o")]) if line.startswith(" ")]
        files = {os.path.relpath(os.path.join(build, name), SOURCE) for name in inputs + headers}
        ours = {name for name in files if not name.startswith("..") and not name.startswith(os.path.relpath(build, SOURCE))}
        self.assertGreater(len(ours), 300)
        self.assertEqual([name for name in ours if not any(pathlib.PurePath(name).is_relative_to(part) for part in READ_BY_BUILD)], [])


if __name__ == "__main__":
    unittest.main()
