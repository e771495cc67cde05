"""The command `slipfront chain` on several processes (ranks), which mpirun starts."""

import json
import os
import shutil
import subprocess
import unittest

from support import PATIENCE, CommandLine, PROGRAM, SOURCE


def mpirun(ranks, *arguments):
    """Runs the program on several ranks, which may be more than the machine has cores."""
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                       OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_mpi_yield_when_idle="1", ASAN_OPTIONS="detect_leaks=0")
    return subprocess.run(["mpirun", "-n", str(ranks), PROGRAM, *arguments], env=environment, capture_output=True, text=True, timeout=PATIENCE)


@unittest.skipUnless(shutil.which("mpirun"), "no mpirun")
class Ranks(CommandLine):
    def test_a_chain_writes_the_same_file(self):
        case = self.slow_case()
        same = self.under_mpirun(2, os.path.dirname(case), case, "--set", "chain.scale=500")
        self.assertEqual(same["ranks"], 2)
        refused = mpirun(2, "chain", case, "--set", "chain.scale=500", "--set", "chain.spacing=0.9")
        self.assertEqual(refused.returncode, 2)
        self.assertEqual(refused.stderr.count("slipfront: "), 1, refused.stderr)

    def test_a_loaded_chain_writes_the_same_file(self):
        folder = os.path.dirname(self.file("x", ""))
        ring = [os.path.join(SOURCE, "cases/stick-slip.toml"), "--set", "domain.left=-30", "--set", "domain.right=30", "--set", "chain.spacing=0.1",
                "--set", "output.every=5e3", "--set", "output.per_event=9", "--set", "output.fronts=12", "--set", "loading.velocity=3e-3", "--set", "chain.tolerance=0.1"]
        same = self.under_mpirun(3, folder, *ring, "--set", "time.end=2e4")
        self.assertGreaterEqual(same["event_count"], 2)
        # Three processes continue a finished run of one.
        longer = [*ring, "--set", "time.end=3e4"]
        self.ok("chain", *longer, "-o", os.path.join(folder, "alone.nc"))
        begun, shared = os.path.join(folder, "begun.nc"), os.path.join(folder, "shared.nc")
        self.ok("chain", *ring, "--set", "time.end=2e4", "-o", begun)
        done = mpirun(3, "chain", *longer, "--resume", begun, "-o", shared)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.same_files(os.path.join(folder, "alone.nc"), shared)

    def under_mpirun(self, ranks, folder, *arguments):
        """Runs a chain in one process and in several, compares their files, and returns the JSON of the latter."""
        alone, shared = os.path.join(folder, "alone.nc"), os.path.join(folder, "shared.nc")
        self.ok("chain", *arguments, "-o", alone)
        done = mpirun(ranks, "chain", *arguments, "--threads", "1", "-o", shared, "--json")
        if "not built with MPI" in done.stderr or "without MPI" in done.stderr:
            self.skipTest("built without MPI")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.same_files(alone, shared)
        return json.loads(done.stdout)

    def same_files(self, one, other):
        with open(one, "rb") as a, open(other, "rb") as b:
            self.assertEqual(a.read(), b.read())


if __name__ == "__main__":
    unittest.main()
