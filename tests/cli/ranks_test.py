"""The commands `slipfront chain` and `slipfront plane --direct` on several processes (ranks), which mpirun starts."""

import json
import os
import shutil
import signal
import subprocess
import time
import unittest

from support import PATIENCE, CommandLine, PROGRAM, SOURCE


# The ranks may be more than the machine has cores.
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                   OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_mpi_yield_when_idle="1", ASAN_OPTIONS="detect_leaks=0")


def mpirun(ranks, *arguments):
    """Runs the program on several ranks."""
    return subprocess.run(["mpirun", "-n", str(ranks), PROGRAM, *arguments], env=ENVIRONMENT, capture_output=True, text=True, timeout=PATIENCE)


# A static load holds the lines around a held disc, until a patch is released. Friction has a state on each site.
HELD = """
[plane]
left = -3
right = 3
bottom = -2.5
top = 3
cells = 40
fixed = "sqrt(x^2 + y^2) < 1"
edges = "absorbing"
[initial]
profile = "formula"
formula = "3 * max(0, 1.8 - max(1, sqrt(x^2 + y^2)))"
hold = true
[nucleation]
x = 1.4
radius = 0.5
time = 0.2
[friction]
law = "slip-weakening"
strength = 3
residual = 0.5
characteristic_slip = 0.5
[interface]
contact = "1 + 0.1 * tanh(y)"
[forcing]
formula = "0.2 * sin(x + t)"
[time]
end = 1
[chain]
scale = 12
[output]
every = 0.25
lines = true
probes = [[1.6, 0], [0, 1.6]]
"""


@unittest.skipUnless(shutil.which("mpirun"), "no mpirun")
class Ranks(CommandLine):
    def test_a_chain_writes_the_same_file(self):
        case = self.slow_case()
        same = self.under_mpirun(2, os.path.dirname(case), "chain", case, "--set", "chain.scale=500", "output.displacement=true", "output.dislocations=true")
        self.assertEqual(same["ranks"], 2)
        refused = mpirun(2, "chain", case, "--set", "chain.scale=500", "--set", "chain.spacing=0.9")
        self.assertEqual(refused.returncode, 2)
        self.assertEqual(refused.stderr.count("slipfront: "), 1, refused.stderr)

    def test_a_loaded_chain_writes_the_same_file(self):
        folder = os.path.dirname(self.file("x", ""))
        ring = [os.path.join(SOURCE, "cases/stick-slip.toml"), "--set", "domain.left=-30", "--set", "domain.right=30", "--set", "chain.spacing=0.1",
                "--set", "output.every=5e3", "--set", "output.per_event=9", "--set", "output.fronts=12", "--set", "loading.velocity=3e-3", "--set", "chain.tolerance=0.1",
                "--set", "output.displacement=true", "output.dislocations=true"]
        same = self.under_mpirun(3, folder, "chain", *ring, "--set", "time.end=2e4")
        self.assertGreaterEqual(same["event_count"], 2)
        # Three processes continue a finished run of one.
        longer = [*ring, "--set", "time.end=3e4"]
        self.ok("chain", *longer, "-o", os.path.join(folder, "alone.nc"))
        begun, shared = os.path.join(folder, "begun.nc"), os.path.join(folder, "shared.nc")
        self.ok("chain", *ring, "--set", "time.end=2e4", "-o", begun)
        done = mpirun(3, "chain", *longer, "--resume", begun, "-o", shared)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.same_files(os.path.join(folder, "alone.nc"), shared)

    def test_a_plane_writes_the_same_file(self):
        case = self.file("held.toml", HELD)
        folder = os.path.dirname(case)
        for ranks in (2, 3):
            self.under_mpirun(ranks, folder, "plane", "--direct", case)
        self.under_mpirun(3, folder, "plane", "--direct", os.path.join(SOURCE, "cases/plane-friction.toml"), "--set", "chain.scale=15", "time.end=0.5", "plane.edges=fixed")
        self.under_mpirun(2, folder, "plane", os.path.join(SOURCE, "cases/plane-friction.toml"), "--set", "plane.cells=30", "plane.loops=30", "plane.angles=32")
        for ranks, settings in ((2, ["chain.spacing=0.5", "initial.formula=20 * x^2"]), (3, ["chain.scale=0.6"])):
            refused = mpirun(ranks, "plane", "--direct", case, "--set", *settings)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertEqual(refused.stderr.count("slipfront: "), 1, refused.stderr)

    def test_a_check_states_the_time_of_all_processes(self):
        done = mpirun(2, "chain", os.path.join(SOURCE, "cases/step.toml"), "--set", "chain.scale=100", "--check", "--wide", "--threads", "1")
        self.assertRegex(done.stdout, r"It would take .* on this machine with 2 processes of 1 thread\.\n$")

    def test_only_the_first_rank_ends_with_a_code(self):
        # mpirun kills all ranks when one ends with a code, and the first one would report that.
        refused = self.file("refused.toml", HELD + "[medium]\nspeed = -1\n")
        script = "trap '' TERM; \"$0\" \"$@\"; echo $OMPI_COMM_WORLD_RANK $? > $OMPI_COMM_WORLD_RANK.txt"
        for arguments in (["plane", "--direct", refused], ["chain", "--no-such-option"]):
            folder = os.path.dirname(self.file("x", ""))
            subprocess.run(["mpirun", "-n", "3", "sh", "-c", script, PROGRAM, *arguments], env=ENVIRONMENT, cwd=folder, capture_output=True, timeout=PATIENCE)
            codes = []
            for rank in range(3):
                with open(os.path.join(folder, f"{rank}.txt"), encoding="utf-8") as file:
                    codes.append(file.read().split())
            self.assertEqual(codes, [["0", "2"], ["1", "0"], ["2", "0"]])

    def test_a_plane_resumes_on_any_number_of_ranks(self):
        case = self.file("held.toml", HELD)
        alone, begun, shared = (os.path.join(os.path.dirname(case), name) for name in ("alone.nc", "begun.nc", "shared.nc"))
        self.ok("plane", "--direct", case, "-o", alone)
        process = subprocess.Popen(["mpirun", "-n", "2", PROGRAM, "plane", "--direct", case, "-o", begun], env=ENVIRONMENT,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for(begun, process)
        empty = os.stat(begun).st_size
        while process.poll() is None and os.stat(begun).st_size == empty:
            time.sleep(1e-3)
        process.send_signal(signal.SIGINT)
        process.wait(timeout=PATIENCE)
        shutil.copy(begun, shared)
        done = mpirun(3, "plane", "--direct", case, "--resume", shared)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.same_files(alone, shared)
        self.ok("plane", "--direct", case, "--resume", begun)
        self.same_files(alone, begun)

    def under_mpirun(self, ranks, folder, *arguments):
        """Runs a command in one process and in several, compares their files, and returns the JSON of the latter."""
        alone, shared = os.path.join(folder, "alone.nc"), os.path.join(folder, "shared.nc")
        self.ok(*arguments, "-o", alone)
        done = mpirun(ranks, *arguments, "--threads", "1", "-o", shared, "--json")
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
