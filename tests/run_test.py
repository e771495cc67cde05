"""./run where a checkout is read-only, copied, offline, or on a system without apt. The tools that it calls are stand-ins."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SLIPFRONT_SOURCE"])

CMAKE = """#!/bin/bash
echo "cmake $*" >>"$CALLS"
while [ $# -gt 1 ]; do [ "$1" = -B ] && build="$2"; [ "$1" = --build ] && build="$2"; shift; done
[ "$1" = -B ] || mkdir -p "$build/bin"
[ -f "$build/CMakeCache.txt" ] || printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\\nCMAKE_CACHEFILE_DIR:INTERNAL=%s\\n' "$PWD" "$build" >"$build/CMakeCache.txt"
touch "$build/build.ninja"
printf '#!/bin/bash\\necho "slipfront %s of %s"\\n' '$*' "$build" >"$build/bin/slipfront"
chmod +x "$build/bin/slipfront"
"""
ALL_INSTALLED = """#!/bin/bash
while [ $# -gt 0 ]; do case "$1" in -W) ;; -f) shift ;; *) echo "$1 installed" ;; esac; shift; done
"""


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tools, self.calls = self.folder / "tools", self.folder / "calls"
        self.tools.mkdir()
        for tool in ("bash", "env", "dirname", "flock", "grep", "cat", "cksum", "cut", "mkdir", "find", "rm", "id", "mktemp", "tail", "touch", "chmod", "readlink"):
            (self.tools / tool).symlink_to(shutil.which(tool))
        self.tool("cmake", CMAKE)
        self.checkout = self.copy(SOURCE, "checkout")

    def copy(self, source, name):
        checkout = self.folder / name
        checkout.mkdir()
        for part in ("run", ".ci", "apt-packages.txt"):
            (shutil.copytree if (source / part).is_dir() else shutil.copy)(source / part, checkout / part)
        return checkout

    def tool(self, name, text):
        (self.tools / name).write_text(text)
        (self.tools / name).chmod(0o755)

    def run_in(self, checkout, *arguments, **variables):
        environment = {"PATH": str(self.tools), "HOME": str(self.folder / "home"), "CALLS": str(self.calls), **variables}
        return subprocess.run([checkout / "run", *arguments], env=environment, capture_output=True, text=True, timeout=1200)

    def test_builds_and_runs(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        done = self.run_in(self.checkout, "pulse", "x.toml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, f"slipfront pulse x.toml of {self.checkout}/build/release\n")

    def test_through_a_link_and_with_a_search_path_of_cd(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        elsewhere = self.folder / "elsewhere"
        (elsewhere / "checkout").mkdir(parents=True)
        (elsewhere / "run").symlink_to("../checkout/run")
        for start in (elsewhere / "run", "checkout/run"):
            environment = {"PATH": str(self.tools), "HOME": str(self.folder / "home"), "CALLS": str(self.calls), "CDPATH": str(elsewhere)}
            done = subprocess.run([start], env=environment, cwd=self.folder, capture_output=True, text=True, timeout=1200)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout, f"slipfront  of {self.checkout}/build/release\n")
        self.assertEqual(sorted(os.listdir(elsewhere)), ["checkout", "run"])

    def test_tests_through_a_link_and_with_a_search_path_of_cd(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        self.tool("ctest", "#!/bin/bash\necho \"$2\"\n")
        self.tool("nproc", "#!/bin/bash\necho 1\n")
        shutil.copy(SOURCE / "test", self.checkout / "test")
        elsewhere = self.folder / "elsewhere"
        (elsewhere / "checkout").mkdir(parents=True)
        (elsewhere / "test").symlink_to("../checkout/test")
        for start in (elsewhere / "test", "checkout/test"):
            environment = {"PATH": str(self.tools), "CALLS": str(self.calls), "CDPATH": str(elsewhere)}
            done = subprocess.run([start], env=environment, cwd=self.folder, capture_output=True, text=True, timeout=1200)
            self.assertEqual((done.returncode, done.stdout.splitlines()[-1:], done.stderr), (0, ["build/dev"], ""))
            self.assertTrue((self.checkout / "build/dev/bin").is_dir())
        self.assertEqual(sorted(os.listdir(elsewhere)), ["checkout", "test"])

    def test_read_only_checkout_builds_elsewhere(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        (self.checkout / "build").write_text("in the way")  # root may write anywhere else
        done = self.run_in(self.checkout)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"of {self.folder}/home/.cache/slipfront/", done.stdout)

    def test_where_others_may_write_nothing_is_built(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        (self.checkout / "build").write_text("in the way")
        done = self.run_in(self.checkout, XDG_CACHE_HOME="relative")
        self.assertIn(f"of {self.folder}/home/.cache/slipfront/", done.stdout)
        folder = pathlib.Path(done.stdout.split(" of ")[1].strip())
        shutil.rmtree(self.folder / "home")
        (self.folder / "home").write_text("no folder")
        done = self.run_in(self.checkout)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertEqual(done.stderr, f"slipfront: neither {self.checkout}/build nor {folder} can be written\n")

    @unittest.skipUnless(os.geteuid() == 0, "only root can give a folder away")
    def test_a_folder_of_another_user_is_not_used(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        (self.checkout / "build").write_text("in the way")
        folder = pathlib.Path(self.run_in(self.checkout).stdout.split(" of ")[1].strip())
        os.chown(folder, 65534, 65534)
        done = self.run_in(self.checkout)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertEqual(done.stderr, f"slipfront: {folder} belongs to another user\n")

    def test_a_copy_builds_its_own_sources(self):
        self.tool("dpkg-query", ALL_INSTALLED)
        self.run_in(self.checkout)
        copy = self.copy(self.checkout, "copy")
        shutil.copytree(self.checkout / "build", copy / "build")
        stale = copy / "build/release/stale"
        stale.write_text("")
        done = self.run_in(copy)
        self.assertIn(f"of {copy}/build/release", done.stdout)
        self.assertFalse(stale.exists())
        self.assertEqual(self.calls.read_text().count("--preset"), 2)

    def test_without_apt_says_what_to_install(self):
        self.tool("dpkg-query", "#!/bin/bash\nexit 1\n")
        done = self.run_in(self.checkout)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertRegex(done.stderr, "apt-get install .*cmake")

    def test_offline_says_what_to_install(self):
        self.tool("dpkg-query", "#!/bin/bash\nexit 1\n")
        self.tool("sudo", "#!/bin/bash\nexec \"$@\"\n")
        self.tool("apt-get", "#!/bin/bash\necho 'Err: Temporary failure resolving' >&2\nexit 100\n")
        done = self.run_in(self.checkout)
        self.assertEqual(done.returncode, 3)
        first, *_, last = done.stderr.splitlines()
        self.assertRegex(first, "^slipfront: will install with apt-get: .*cmake")
        self.assertRegex(last, "^slipfront: .*network.*apt-get install .*cmake")

    def test_no_debian_tries_to_build(self):
        done = self.run_in(self.checkout)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("libnetcdf-dev", done.stderr)


if __name__ == "__main__":
    unittest.main()
