"""slipfront.sweep on a Dask cluster of two workers."""

import logging
import os
import pickle
import subprocess
import tempfile
import threading
import unittest
import warnings

import slipfront
from slipfront import _cluster
from sweep_test import MANY, SCENARIO, whole

try:
    from distributed import Client, LocalCluster
except ImportError:
    Client = None
STEP = os.path.join(os.environ["SLIPFRONT_SOURCE"], "cases/step-viscous.toml")
logging.getLogger("distributed").setLevel(logging.CRITICAL)  # it would log the errors that these tests provoke


@unittest.skipIf(Client is None, "needs the Debian package python3-distributed")
class Cluster(unittest.TestCase):
    """Two processes serve the tests that need real workers. The other tests have a cluster of threads."""

    @classmethod
    def setUpClass(cls):
        cls.processes = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
        cls.client = Client(cls.processes)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.processes.close()

    def cluster(self):
        cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, processes=False)
        self.addCleanup(cluster.close)
        client = Client(cluster)
        self.addCleanup(client.close)
        return cluster, client

    def test_a_cluster_gives_the_results_of_one_machine_even_if_a_worker_dies(self):
        here = whole()
        victim = next(iter(self.processes.workers.values())).pid
        killed = threading.Event()

        def kill(done, _):
            if not killed.is_set():
                killed.set()
                os.kill(victim, 9)

        self.assertTrue(slipfront.sweep(SCENARIO, MANY, client=self.client, progress=kill).identical(here))
        self.assertTrue(killed.is_set())

    def test_a_cluster_runs_loaded_chains(self):
        axes = {"loading.velocity": [1e-4, 3e-4], "friction.law": ["rate-and-state", "coulomb"]}
        short = {"domain.left": -20, "domain.right": 20, "time.end": 1e4, "output.every": 5e3}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Coulomb friction fails, because it jumps at rest
            here = slipfront.sweep(slipfront.cases / "stick-slip.toml", axes, command="chain", set=short)
            there = slipfront.sweep(slipfront.cases / "stick-slip.toml", axes, command="chain", set=short, client=self.client)
        self.assertTrue(there.identical(here))
        self.assertTrue((here.loading_force[:, 0] > 0).all())
        self.assertTrue((here.failure[:, 1] != "").all())

    def test_a_point_that_ends_every_worker_does_not_lose_other_points(self):
        _, client = self.cluster()
        real = _cluster._task

        def task(packed):
            if any(point == 7 for point, _ in pickle.loads(packed)[2]):
                raise Dies("worker is gone")
            return real(packed)

        class Dies(Exception):
            pass

        _cluster._task = task
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                data = slipfront.sweep(SCENARIO, MANY, client=client)
        finally:
            _cluster._task = real
        self.assertEqual(int((data.failure != "").sum()), 1)
        self.assertIn("worker is gone", data.failure.values.ravel()[7])
        expected = whole()
        self.assertTrue(data.slip_at_origin.where(data.failure == "").broadcast_equals(expected.slip_at_origin.where(data.failure == "")))

    def test_the_command_runs_on_a_cluster(self):
        with tempfile.TemporaryDirectory() as folder:
            output = os.path.join(folder, "sweep.nc")
            done = subprocess.run([os.environ["SLIPFRONT"], "sweep", STEP, "--vary", "friction.coefficient=0.5,1", "--cluster", self.processes.scheduler_address, "-o", output],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(slipfront.open(output).identical(slipfront.sweep(STEP, {"friction.coefficient": [0.5, 1.0]})))

    def test_a_closed_cluster_is_an_error(self):
        cluster, client = self.cluster()

        def leave(*_):
            cluster.close()

        with self.assertRaises(slipfront.NumericsError) as caught:
            slipfront.sweep(SCENARIO, {"friction.coefficient": [0.1 * i for i in range(1, 400)]}, client=client, progress=leave)
        self.assertIn("cluster is gone", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
