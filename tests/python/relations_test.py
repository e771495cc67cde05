"""slipfront.relations and slipfront.train: shapes, numbers, what they refuse."""

import json
import math
import unittest

import numpy as np
import xarray as xr

import slipfront
from support import CommandLine

KEYS = ["stress", "rupture_velocity", "leading_velocity", "velocity_ratio", "slip_velocity", "stress_at_origin",
        "dislocation_velocity_at_origin", "psi", "psi_at_origin"]


class Relations(CommandLine):
    def test_is_what_the_command_line_says_to_the_bit(self):
        for name, values in [("stress", [0.01, 0.855, 1.03]), ("rupture_velocity", [1e-300, 0.5534, 1 - 1e-16]), ("slip_velocity", [1e-300, 0.1])]:
            out = slipfront.relations(**{name: values})
            self.assertEqual(list(out.data_vars), KEYS)
            arguments = [item for value in values for item in ("--" + name.replace("_", "-"), repr(value))]
            rows = json.loads(self.ok("relations", *arguments, "--json"))["relations"]
            for i, row in enumerate(rows):
                self.assertEqual({key: float(out[key][i]) for key in KEYS}, row)

    def test_numbers_of_the_paper(self):
        self.assertAlmostEqual(float(slipfront.relations(stress=1.03).slip_velocity), 0.1000039, 7)
        self.assertAlmostEqual(float(slipfront.relations(rupture_velocity=0.55).stress), 1.03653, 5)
        self.assertAlmostEqual(float(slipfront.relations(rupture_velocity=2.1352e-5).stress), 0.21173, 5)

    def test_shapes(self):
        self.assertEqual(slipfront.relations(stress=1.03).stress.shape, ())
        self.assertEqual(slipfront.relations(stress=[]).stress.shape, (0,))
        square = np.linspace(0.1, 2, 12).reshape(3, 4)
        out = slipfront.relations(stress=square.T)  # not contiguous
        self.assertEqual(out.psi.shape, (4, 3))
        np.testing.assert_array_equal(out.psi.values.T.ravel(), slipfront.relations(stress=square.ravel()).psi)
        np.testing.assert_array_equal(slipfront.relations(stress=np.float32([0.5])).stress, [0.5])
        named = xr.DataArray([0.5, 1.0], dims="event", coords={"event": ["a", "b"]})
        self.assertEqual(float(slipfront.relations(stress=named).stress.sel(event="b")), 1)

    def test_says_what_it_gives(self):
        about = slipfront.relations(stress=1.03)
        for key in KEYS:
            self.assertEqual(about[key].attrs["units"], "1")
            self.assertTrue(about[key].attrs["long_name"])
            self.assertIn("Eqs. 8-10", about[key].attrs["references"])
        self.assertEqual(about.slip_velocity.attrs["dimensional_unit"], "c A / pi")

    def test_threads_change_nothing(self):
        stress = np.geomspace(0.01, 100, 3000)
        self.assertTrue(slipfront.relations(stress=stress, threads=1).identical(slipfront.relations(stress=stress, threads=4)))

    def test_refuses(self):
        for arguments, says in [({}, "nothing"), ({"stress": 1, "slip_velocity": 1}, "more than one"), ({"stress": -1}, "'-1'"),
                                ({"rupture_velocity": 1}, "rupture_velocity"),
                                ({"stress": [1, 0, -3]}, "stress[1]"), ({"stress": "1"}, "allowed"), ({"stress": 1j}, "complex"),
                                ({"stress": [True]}, "bool"), ({"stress": [[1], [1, 2]]}, "stress"), ({"stress": {}}, "stress"), ({"stress": np.ma.array([1.0, 2.0], mask=[0, 1])}, "masked"),
                                ({"stress": 1, "threads": 0}, "threads"), ({"stress": 1, "threads": 1.5}, "threads")]:
            with self.subTest(**arguments), self.assertRaises(slipfront.InputError) as caught:
                slipfront.relations(**arguments)
            self.assertIn(says, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        with self.assertRaises(ValueError) as caught:  # the line of the command line
            slipfront.relations(stress=1e-9)
        self.assertIn(str(caught.exception).split("'")[2], self.refused(2, "relations", "--stress", "1e-9").stderr)


class Train(unittest.TestCase):
    def test_averages_and_fields_belong_together(self):
        phi, psi = 0.3, 0.1
        length = float(slipfront.train.spacing(phi, psi))
        xi = (np.arange(4000) + 0.5) / 4000 * length
        at = slipfront.train.fields(phi, psi, xi)
        mean = slipfront.train.averages(phi, psi)
        self.assertAlmostEqual(float(at.sigma.mean()), float(mean.k), 9)
        self.assertAlmostEqual(float((at.sigma**2).mean()), float(mean.sigma2), 9)
        self.assertAlmostEqual(float((1 - np.cos(at.u)).mean()), float(mean.one_minus_cos), 9)
        self.assertAlmostEqual(float(at.w.mean()), float(mean.W), 9)
        self.assertAlmostEqual(length, 2 * math.pi / float(mean.k), 12)
        np.testing.assert_allclose(-np.gradient(at.u.values, xi)[5:-5], at.sigma.values[5:-5], rtol=1e-4)

    def test_broadcasts(self):
        self.assertEqual(slipfront.train.averages(np.zeros((3, 1)), [0.1, 0.2]).k.shape, (3, 2))
        self.assertEqual(slipfront.train.averages(0, 0).k.shape, ())

    def test_rest_and_jacobi(self):
        stress = np.array([0.05, 0.855, 1.03, 30])
        np.testing.assert_allclose(slipfront.train.stress_at_rest(slipfront.train.psi_at_rest(stress)), stress, rtol=1e-14)
        z = np.linspace(-3, 3, 50)
        j = slipfront.train.jacobi(z, 0.2)
        np.testing.assert_allclose(j.sn**2 + j.cn**2, 1, rtol=1e-14)
        m = 1 - math.tanh(0.2) ** 2
        np.testing.assert_allclose(j.dn**2 + m * j.sn**2, 1, rtol=1e-14)

    def test_profile_of_the_pulse(self):
        known = slipfront.relations(stress=0.855)
        at = slipfront.train.profile(0.855, [-1, -float(known.rupture_velocity), 0, 0.09, 1])
        self.assertAlmostEqual(float(at.W.sel(x_over_t=0)), float(known.slip_velocity), 12)
        self.assertAlmostEqual(at.attrs["left_edge"], -float(known.rupture_velocity), 12)
        self.assertEqual(float(at.Sigma[-1]), 0)
        stressed = slipfront.train.profile(0.855, 0.0, stress_right=0.179)
        self.assertAlmostEqual(float(stressed.W), 0.0442333337, 9)

    def test_edge_speeds(self):
        # docs/theory/9_trains.md: the speeds of two trains, and those of one
        expected = [-0.55406978, -0.079921187, 0.13584596, 0.75218808]
        np.testing.assert_allclose(slipfront.train.edge_speeds([-0.1, 0.05, 0.2, 0.45]), expected, rtol=1e-8)
        one = slipfront.train.edge_speeds([-0.1, 0.3])
        edges = slipfront.riemann((float(slipfront.train.averages(0.1, 0.2).k), math.tanh(0.1)), 0)
        self.assertAlmostEqual(one[0], edges.left_edge, 10)
        for bad in ([0.1], [], [[0, 1], [1, 2]], [0.3, 0.1]):
            with self.assertRaises(slipfront.InputError):
                slipfront.train.edge_speeds(bad)

    def test_refuses(self):
        train, medium = slipfront.train, slipfront.medium
        for call in [lambda: train.averages(0, -1), lambda: train.averages(math.nan, 1), lambda: train.averages([1, 2], [1, 2, 3]),
                     lambda: train.averages(0, 1, 0), lambda: train.fields(0, 0, 1), lambda: train.fields(0, 1, math.inf), lambda: train.jacobi(1, 0),
                     lambda: train.spacing(0, 0), lambda: train.psi_at_rest(-1), lambda: train.psi_at_rest(math.nan),
                     lambda: train.profile(-1, 0), lambda: train.profile(1, math.nan), lambda: train.profile([1, 2], 0),
                     lambda: medium.speed_from_p_wave(-1, 0.3), lambda: medium.speed_from_p_wave(6000, 0.6),
                     lambda: medium.speed_from_p_wave([1, 2], [1, 2, 3]), lambda: medium.speed_from_p_wave("6 km/s", 0.3),
                     lambda: medium.units(30e9, 5000, [0.1], 1)]:
            with self.assertRaises(slipfront.InputError) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))

    def test_medium(self):
        self.assertAlmostEqual(float(slipfront.medium.speed_from_p_wave(6000.0, 0.3)), 5421.0, 0)
        np.testing.assert_allclose(slipfront.medium.plastic_contact_ratio([0, 0.3]), [0.5**0.5, 0.35**0.5])
        printed, meant = slipfront.medium.printed_traction_unit(30e9, 0.003), slipfront.medium.traction_unit(30e9, 0.3, 0.003)
        self.assertAlmostEqual(float(meant), 30e9 * 0.003**2 / (math.pi * 0.7), 6)
        self.assertAlmostEqual(float(printed / meant), 0.7 / 0.006, 9)
        self.assertNotIn("force", slipfront.medium.units(30e9, 5000.0, 0.003, 1e-3))


class FrictionRatio(unittest.TestCase):
    def test_is_what_the_pulse_solver_gives(self):
        frictionless = slipfront.relations(stress=0.7).slip_velocity
        for closure in ("consistent", "paper"):
            run = slipfront.pulse({"initial": {"profile": "step", "stress_left": 0.7, "stress_right": 0.0},
                                   "friction": {"law": "viscous", "coefficient": 2.0, "closure": closure},
                                   "time": {"end": 1.0}, "domain": {"left": -0.5, "right": 0.5}, "pulse": {"cells": 800}})
            ratio = slipfront.friction_ratio(0.7, 2.0, closure=closure).ratio
            self.assertAlmostEqual(float(run.attrs["slip_velocity_at_origin"] / frictionless / ratio), 1, 4)

    def test_shapes_and_derivatives(self):
        damping = xr.DataArray(np.geomspace(1e-2, 1e9, 50), dims="damping")
        out = slipfront.friction_ratio(0.855, damping)
        self.assertEqual(out.ratio.dims, ("damping",))
        self.assertTrue(np.all(np.diff(out.ratio) < 0))
        near = slipfront.friction_ratio(0.855, damping * (1 + 1e-6))
        np.testing.assert_allclose((near.ratio - out.ratio) / (damping * 1e-6), out.by_damping_number, rtol=1e-3)
        self.assertEqual(slipfront.friction_ratio([0.5, 1.0], [[1.0], [2.0], [3.0]]).ratio.shape, (3, 2))

    def test_refuses(self):
        for arguments, named in [((0.01, 1), {}), ((1, -1), {}), ((1, 1), {"measure": "middle"}), ((1, 1), {"closure": "none"})]:
            with self.assertRaises(slipfront.InputError):
                slipfront.friction_ratio(*arguments, **named)
        self.assertGreater(float(slipfront.friction_ratio(1.0, 100.0, closure="paper").uncertainty), 1e-3)

    def test_damping_number_is_the_other_way_round(self):
        damping = np.array([0.2, 3.0, 40.0])
        for closure in ("consistent", "paper"):
            ratio = slipfront.friction_ratio(0.7, damping, closure=closure).ratio
            back = slipfront.damping_number(0.7, ratio, closure=closure)
            np.testing.assert_allclose(back.damping_number, damping, rtol=1e-9)
            self.assertTrue(bool((back.damping_number_error > 0).all()))
        self.assertTrue(np.isnan(slipfront.damping_number(0.7, [0.5, np.nan]).damping_number[1]))
        with self.assertRaisesRegex(slipfront.InputError, "at most 1"):
            slipfront.damping_number(0.7, 1.2)


class Riemann(CommandLine):
    def test_is_what_the_command_line_says_to_the_bit(self):
        for solution in ("trains", "shocks"):
            with self.subTest(solution):
                self.compare(slipfront.riemann((1.0, 0.3), (0.5, -0.2), solution=solution),
                             json.loads(self.ok("riemann", "--left", "1,0.3", "--right", "0.5,-0.2", "--solution", solution, "--json")))

    def compare(self, out, said):
        self.assertEqual({name: float(out[f"star_{name}"]) for name in said["star"]}, said["star"])
        self.assertEqual([out.left_wave, *out.left_wave_edges], list(said["left_wave"].values()))
        self.assertEqual((out.left_edge, out.right_edge), (said["left_edge"], said["right_edge"]))
        self.assertEqual(out.sizes["x_over_t"], 201)
        for i, wave in enumerate(said.get("waves", [])):
            self.assertEqual({key: out[f"wave_{key}"].values[i] for key in wave}, wave)
        self.assertEqual(out.sizes.get("wave", 0), len(said.get("waves", [])))

    def test_gives_each_train(self):
        out = slipfront.riemann((1.0, 0.3), (0.5, -0.2), [-0.9, 0.0])
        self.assertEqual(out.trains.values.tolist(), [1, 2])
        self.assertTrue(np.isnan(out.W_2[0]))
        self.assertAlmostEqual(float(out.W_1[1] + out.W_2[1]), 0.201413471, 9)
        self.assertEqual(float(out.slip[1]), float(out.W[1]))

    def test_gives_the_leading_front_for_any_stress_ahead(self):
        out = slipfront.relations(stress=[0.855, 1.03], stress_right=[0.179, 0.4])
        np.testing.assert_allclose(out.leading_velocity, [0.1207373, 0.2607497], atol=6e-8)
        np.testing.assert_allclose(out.slip_velocity, [0.0442333337, 0.0828168462], atol=6e-11)
        said = json.loads(self.ok("relations", "--stress", "0.855", "--stress-right", "0.179", "--json"))["relations"][0]
        self.assertEqual({name: float(out[name][0]) for name in said}, said)
        with self.assertRaisesRegex(slipfront.InputError, "stress_right"):
            slipfront.relations(stress=0.5, stress_right=0.6)
        with self.assertRaisesRegex(slipfront.InputError, "stress_right"):
            slipfront.relations(slip_velocity=0.5, stress_right=0.1)

    def test_is_the_profile_of_trains_at_rest(self):
        x = np.linspace(-0.5, 0.3, 20)
        rest, same = slipfront.riemann(0.855, 0.2, x), slipfront.train.profile(0.855, x, stress_right=0.2)
        for name in ("U", "Sigma", "W", "P"):
            np.testing.assert_array_equal(rest[name], same[name])

    def test_refuses(self):
        for left, right, words in [((1, 2), 0, "left_velocity"), (0, 0, "empty"), ((1, 2, 3), 0, "3 numbers"), ("a", 1, "left"), (1, 1e7, "right_stress")]:
            with self.assertRaisesRegex(slipfront.InputError, words):
                slipfront.riemann(left, right)
        with self.assertRaisesRegex(slipfront.InputError, "solution"):
            slipfront.riemann(1, 0, solution="x")


if __name__ == "__main__":
    unittest.main()
