"""slipfront.laboratory: tables of fronts, the posterior of the hardness over modulus, the command and its figure."""

import contextlib
import io
import json
import math
import os
import tempfile
import unittest

import numpy as np
import pandas
from commands import PythonCommands
import slipfront
from slipfront.__main__ import run as run_in_this_process
from slipfront import _slipfront
from slipfront._population import fronts as tables
from slipfront._population import laboratory
from slipfront._population.hardness import Evidence, Posterior
from support import SOURCE, run

FRONTS = os.path.join(SOURCE, "cases", "synthetic-laboratory-fronts.csv")
POLYMER = {"poisson_ratio": 0.35, "s_wave_speed": "1300 m/s"}
OPTIONS = ("--poisson-ratio", "0.35", "--s-wave-speed", "1300 m/s")
SPEED = float(slipfront.medium.speed_from_s_wave(1300, 0.35))
PLASTIC = float(slipfront.medium.plastic_contact_ratio(0.35))

#: The closed form as a table, for the experiments of this test and for the brute force.
LN_STRESS = np.linspace(math.log(0.005), math.log(200), 40000)
STATES = slipfront.relations(stress=np.exp(LN_STRESS))
SHARES = 1 - STATES.stress_at_origin.values / STATES.stress.values


def velocity_of(ln_stress):
    return SPEED * np.interp(ln_stress, LN_STRESS, STATES.rupture_velocity.values)


def measured(text, dimension):
    return _slipfront.parse_measured(text, dimension, "", "test", 1, "value")


def front(shear, normal, velocity, drop=None):
    return tables.Front("a", 1, measured(shear, "pressure"), measured(normal, "pressure"), measured(velocity, "velocity"), drop and measured(drop, "pressure"))


def ratio_of(found, other):
    return found / other - 1


class Theory(unittest.TestCase):
    def test_an_exact_front_gives_the_inverse_of_the_closed_form(self):
        found = slipfront.laboratory({"tau [MPa]": [2.5], "normal_stress [MPa]": [5], "front_velocity [m/s]": [200]}, **POLYMER)
        stress = float(slipfront.relations(rupture_velocity=200 / SPEED).stress)
        self.assertAlmostEqual(float(found.hardness_over_modulus_of_front[0]), stress * PLASTIC / math.pi / 0.5, 12)
        self.assertAlmostEqual(float(found.hardness_over_modulus), stress * PLASTIC / math.pi / 0.5, 3)
        # With one front the scatter is that of its prior, uniform in its logarithm from 0.001 to 1.
        self.assertLess(abs(float(found.scatter) / math.sqrt(0.001) - 1), 0.02)

    def test_exact_fronts_have_the_posterior_of_a_normal_sample(self):
        """The y_i are known, so the posterior of ln h at a given scatter is normal about their mean."""
        y = np.log(0.2) + np.array([-0.05, 0.0, 0.02, 0.09])
        velocity = velocity_of(math.log(math.pi / PLASTIC * 0.5) + y)
        evidence = [Evidence(front("2.5 MPa", "5 MPa", f"{v:.12g} m/s"), SPEED, math.log(math.pi / PLASTIC), 3) for v in velocity]
        posterior = Posterior(evidence, (1e-3, 10), (1e-3, 1))
        ln_s = np.linspace(math.log(1e-3), 0, 4001)
        weight = np.exp(-3 * ln_s - ((y - y.mean()) ** 2).sum() / 2 * np.exp(-2 * ln_s))
        share = np.cumsum(weight) / weight.sum()
        for ends in (0.05, 0.5, 0.95):
            self.assertAlmostEqual(float(posterior.quantiles([ends])[1][0]), float(np.interp(ends, share, ln_s)), 2)
        # Over the scatter, ln h has Student's distribution with 3 degrees of freedom: its 95 % quantile is 2.353.
        self.assertAlmostEqual(float(posterior.quantiles([0.95])[0][0]), y.mean() + 2.353 * y.std(ddof=1) / 2, 3)

    def test_the_stress_drop_is_before_minus_after(self):
        found = slipfront.laboratory(FRONTS, **POLYMER)
        stress = math.pi / PLASTIC * float(found.hardness_over_modulus) * found.stress_ratio.values
        expected = found.shear_stress.values * np.interp(np.log(stress), LN_STRESS, SHARES)
        self.assertLess(abs(ratio_of(found.predicted_stress_drop.values, expected)).max(), 0.01)
        self.assertTrue(((expected / found.shear_stress.values > 0.14) & (expected / found.shear_stress.values < 0.37)).all())


class BruteForce(unittest.TestCase):
    def assert_agrees(self, fronts, prior, scatter_prior, count):
        """Importance sampling: parameters, stresses and deviations from their distributions, weighted by velocity and drop."""
        random = np.random.default_rng(1)
        y, ln_s = random.uniform(*np.log(prior), count), random.uniform(*np.log(scatter_prior), count)
        weight = np.ones(count)
        for one in fronts:
            shear, normal = one.shear_stress.quantile(random.random(count)), one.normal_stress.quantile(random.random(count))
            ln_stress = math.log(math.pi / PLASTIC) + np.log(shear / normal) + y + np.exp(ln_s) * random.standard_normal(count)
            weight *= one.front_velocity.likelihood(velocity_of(ln_stress))
            if one.stress_drop is not None:
                weight *= one.stress_drop.likelihood(shear * np.interp(ln_stress, LN_STRESS, SHARES))
        posterior = laboratory._Analysis(fronts, SPEED, PLASTIC, prior, scatter_prior).posterior
        effective = weight.sum() ** 2 / (weight**2).sum()
        self.assertGreater(effective, 2000)
        for values, found in zip((y, ln_s), posterior.quantiles([0.05, 0.5, 0.95])):
            shares = [weight[values < at].sum() / weight.sum() for at in found]
            for share, wanted in zip(shares, (0.05, 0.5, 0.95)):
                self.assertLess(abs(share - wanted), 4 * math.sqrt(wanted * (1 - wanted) / effective) + 0.001)

    def test_lognormal_errors_and_a_stress_drop(self):
        self.assert_agrees([front("2.5 */ 1.05 MPa", "5 */ 1.03 MPa", "190 */ 1.3 m/s", "0.55 */ 1.2 MPa"), front("3 */ 1.05 MPa", "5 MPa", "260 */ 1.2 m/s"),
                            front("3.5 */ 1.05 MPa", "5 MPa", "900 */ 1.2 m/s")], (0.1, 0.4), (0.02, 0.5), 500000)

    def test_normal_errors_and_ranges(self):
        self.assert_agrees([front("2.5 +- 0.2 MPa", "4.8..5.2 MPa", "190 +- 70 m/s"), front("3.0..3.2 MPa", "5 +- 0.1 MPa", "250..400 m/s", "0.6 +- 0.2 MPa")],
                           (0.1, 0.4), (0.02, 0.5), 500000)

    def test_a_front_near_c_is_a_lower_bound(self):
        self.assert_agrees([front("2.5 */ 1.1 MPa", "5 MPa", "2200 +- 150 m/s")], (0.05, 5), (0.02, 0.5), 400000)


class Calibration(unittest.TestCase):
    def test_intervals_cover_what_they_say(self):
        """Synthetic experiments of six fronts, their parameters drawn from the prior. Of 200, 90 % intervals hold 180 +- 4.2."""
        prior, scatter_prior = (0.1, 0.4), (0.01, 0.5)
        random = np.random.default_rng(7)
        covered = np.zeros(2, dtype=int)
        for _ in range(200):
            y, ln_s = random.uniform(*np.log(prior)), random.uniform(*np.log(scatter_prior))
            posterior = laboratory._Analysis(self.fronts(y, ln_s, random), SPEED, PLASTIC, prior, scatter_prior).posterior
            covered += [0.05 < posterior.share_below(y) < 0.95, 0.05 < posterior.share_of_scatter_below(ln_s) < 0.95]
        for count in covered:
            self.assertTrue(180 - 3 * 4.3 <= count <= 180 + 3 * 4.3, covered)

    @staticmethod
    def fronts(y, ln_s, random):
        found = []
        for _ in range(6):
            shear = random.uniform(1, 4)
            ln_ratio = math.log(shear / 5) + random.standard_normal() * math.log(1.05)
            velocity = velocity_of(math.log(math.pi / PLASTIC) + ln_ratio + y + math.exp(ln_s) * random.standard_normal())
            found.append(front(f"{shear} */ 1.05 MPa", "5 MPa", f"{velocity * 1.1 ** random.standard_normal():.10g} */ 1.1 m/s"))
        return found


class Table(unittest.TestCase):
    def test_forms_of_a_table_agree(self):
        columns = {"tau [MPa]": [2.0, 2.6], "normal_stress": ["5 MPa", "5000 kPa"], "front_velocity_m_s": ["90 +- 9", "0.26 +- 0.026 km/s"]}
        found = slipfront.laboratory(columns, **POLYMER)
        texts = ["shear_stress (MPa);sigma_n (MPa);Rupture_velocity (m/s);rupture_velocity_err\n2.0;5;90;9\n2.6;5;260;26\n",
                 "# a comment\ntau\tnormal_stress\tfront_velocity [m/s]\n2.0 MPa\t5 MPa\t90 +- 10 %\n\n2.6 MPa\t5 MPa\tnormal(260, 26)\n"]
        for table in (*texts, pandas.DataFrame(columns)):
            with self.subTest(table):
                other = slipfront.laboratory(table, **POLYMER)
                self.assertAlmostEqual(float(other.hardness_over_modulus), float(found.hardness_over_modulus), 12)

    def test_bad_rows_are_named_and_good_rows_are_kept(self):
        text = "tau [MPa],normal_stress [MPa],front_velocity [m/s],stress_drop [MPa],colour\n2,5,90,,red\nx,5,90,,red\n2,5,-,,red\n2,5,90,0.4,red\n2,5\n2,0,90,,red\n"
        found = slipfront.laboratory(text, **POLYMER)
        self.assertEqual((found.sizes["front"], found.attrs["ignored_columns"]), (2, "colour"))
        for line, says in zip(found.attrs["errors"].split("\n"), ("table:3: tau [MPa] = 'x'", "table:4: front_velocity [m/s] = '-': no value", "2 cells", "not positive"),
                              strict=True):
            self.assertIn(says, line)
        with self.assertRaisesRegex(slipfront.InputError, "table:3"):
            slipfront.laboratory(text, strict=True, **POLYMER)

    def test_a_stress_drop_without_an_error_is_not_used(self):
        text = "name,tau [MPa],normal_stress [MPa],front_velocity [m/s],stress_drop [MPa]\nb,0.66,2,120,0.02{}\nc,0.67,2,150,0.02\n"
        without = slipfront.laboratory(text.format(""), **POLYMER)
        velocities = slipfront.laboratory(text.replace(",stress_drop [MPa]", "").replace(",0.02{}", "").replace(",0.02", ""), **POLYMER)
        self.assertEqual(float(without.hardness_over_modulus), float(velocities.hardness_over_modulus))
        self.assertIn("2 of 2 stress drops have no error and are not used, the first in line 2", without.attrs["warnings"])
        some = slipfront.laboratory(text.format(" */ 1.1"), **POLYMER)
        self.assertIn("1 of 2 stress drops have no error and are not used, the first in line 3", some.attrs["warnings"])
        self.assertEqual(some.attrs["errors"], "")

    def test_a_bound_is_no_value(self):
        found = slipfront.laboratory("tau [MPa],normal_stress [MPa],front_velocity [m/s]\n2,5,90\n2,5,<90\n", **POLYMER)
        self.assertEqual(found.attrs["errors"], "table:3: front_velocity: no value; allowed: a number with its unit")

    def test_the_stress_after_gives_the_drop(self):
        fronts = {"tau [MPa]": ["0.66 +- 0.003", 0.67], "normal_stress [MPa]": [2, 2], "front_velocity [m/s]": [120, 150]}
        after = slipfront.laboratory({**fronts, "residual stress [MPa]": ["0.5 +- 0.004", "0.5 +- 0.05"]}, **POLYMER)
        drop = slipfront.laboratory({**fronts, "stress_drop [MPa]": ["0.16 +- 0.005", "0.17 +- 0.05"]}, **POLYMER)
        np.testing.assert_allclose(after.stress_drop_interval, drop.stress_drop_interval, rtol=1e-12)
        np.testing.assert_allclose(after.hardness_over_modulus, drop.hardness_over_modulus, rtol=1e-9)
        with self.assertRaisesRegex(slipfront.InputError, "table:2: .*not below the shear stress before"):
            slipfront.laboratory({**fronts, "residual stress [MPa]": [0.7, 0.7]}, **POLYMER)

    def test_a_map_and_a_constant_normal_stress(self):
        titles = "id,shear stress before [MPa],N [MPa],rupture_velocity[m/s]\nb,0.66,2,120\nc,0.67,2,150\n"
        found = slipfront.laboratory(titles, columns={"columns": {"N [MPa]": "normal_stress MPa"}}, **POLYMER)
        self.assertEqual(found.name.values.tolist(), ["b", "c"])
        constant = slipfront.laboratory("tau_MPa;V_L (m/s)\n0.66;120\n0.67;150\n".replace("V_L", "front_velocity"), normal_stress="2 MPa", **POLYMER)
        in_pascal = slipfront.laboratory({"tau": ["0.66 MPa", "0.67 MPa"], "front_velocity_m_s": [120, 150]}, normal_stress=2e6, **POLYMER)
        for other in (constant, in_pascal):
            self.assertEqual(float(other.hardness_over_modulus), float(found.hardness_over_modulus))
        with self.assertRaisesRegex(slipfront.InputError, "normal_stress = '2 kg'"):
            slipfront.laboratory(titles, normal_stress="2 kg", **POLYMER)

    def test_refuses(self):
        row = {"tau [MPa]": [2.0], "normal_stress [MPa]": [5], "front_velocity [m/s]": [90]}
        for change, says in [({"table": {}}, "dict"), ({"table": 3}, "int"), ({"table": ""}, "path"), ({"table": "tau\n1 MPa\n"}, "normal_stress: the table has no such column"),
                             ({"table": {**row, "tau [kg]": [1]}}, "kg"), ({"table": {**row, "tau_MPa": [1]}}, "a second column of shear_stress"), ({"table": "a\n"}, "shear_stress"),
                             ({"poisson_ratio": None}, "poisson_ratio"), ({"s_wave_speed": "3 kg"}, "s_wave_speed"), ({"prior": (1, 1)}, "prior"), ({"scatter_prior": 3}, "scatter_prior"),
                             ({"draws": 0}, "draws"), ({"seed": -1}, "seed"), ({"table": {**row, "front_velocity [m/s]": [9000]}}, "faster than c")]:
            with self.subTest(says), self.assertRaisesRegex(slipfront.InputError, says):
                slipfront.laboratory(**{"table": row, **POLYMER, **change})


class Results(unittest.TestCase):
    def test_the_synthetic_fronts_give_the_hardness_that_made_them(self):
        found = slipfront.laboratory(FRONTS, shear_modulus="2 GPa", **POLYMER)
        low, high = found.hardness_over_modulus_interval.values
        self.assertTrue(low < 0.20 < high, (low, high))
        self.assertTrue(found.scatter_interval[0] < 0.06 < found.scatter_interval[1])
        self.assertAlmostEqual(float(found.hardness / found.hardness_over_modulus / 2e9), 1, 12)
        self.assertEqual((found.attrs["fronts_left_out"], found.included.values.tolist()), (1, [1] * 14 + [0]))
        self.assertIn("faster than c", str(found.reason.values[-1]))
        self.assertTrue((abs(found.deviation.values[:14]) < 3).all() and (abs(found.stress_drop_deviation.values[:14:2]) < 3).all())

    def test_draws_have_the_quantiles_of_the_posterior(self):
        found = slipfront.laboratory(FRONTS, draws=20000, **POLYMER)
        for name in ("hardness_over_modulus", "scatter"):
            draws = np.quantile(found[f"draw_{name}"].values, [0.05, 0.95])
            width = np.ptp(found[f"{name}_interval"].values)
            self.assertLess(abs(draws - found[f"{name}_interval"].values).max(), 0.03 * width)

    def test_extreme_fronts_are_used_or_named(self):
        fronts = {"tau [MPa]": [2.5, 2.5, 1e250, "2.5 */ 1e200", 2.5], "normal_stress [MPa]": [5, 5, 1e-250, 5, 5],
                  "front_velocity [m/s]": ["200 +- 20", "1e-300", "2000 +- 20", "200", "1 */ 1e200"]}
        found = slipfront.laboratory(fronts, **POLYMER)
        self.assertEqual(found.included.values.tolist(), [1, 0, 1])
        self.assertRegex(found.attrs["errors"], "table:4: shear_stress: it is inf of the normal stress.*\ntable:5: shear_stress: the error is too large")
        self.assertIn("slower than", str(found.reason.values[1]))
        self.assertTrue(np.isfinite([found.hardness_over_modulus, *found.hardness_over_modulus_interval]).all())

    def test_a_prior_that_bounds_the_result_is_named(self):
        fronts = {"tau [MPa]": [2.5, 2.6], "normal_stress [MPa]": [5, 5], "front_velocity [m/s]": ["200 +- 20", "240 +- 20"]}
        self.assertEqual(slipfront.laboratory(fronts, **POLYMER).attrs["warnings"], "")
        self.assertIn("from below, at 1", slipfront.laboratory(fronts, prior=(1, 10), **POLYMER).attrs["warnings"])
        self.assertIn("from above, at 0.1", slipfront.laboratory(fronts, prior=(0.01, 0.1), **POLYMER).attrs["warnings"])

    def test_stress_drops_that_contradict_the_theory_are_named(self):
        fronts = {"name": list("bcd"), "tau [MPa]": [0.66, 0.67, 0.68], "normal_stress [MPa]": [2] * 3, "front_velocity [m/s]": ["120 +- 6", "150 +- 8", "180 +- 9"]}
        agrees = slipfront.laboratory(fronts, **POLYMER)
        self.assertNotIn("contradict", agrees.attrs["warnings"])
        drops = [f"{drop / 1e6} */ 1.1" for drop in agrees.predicted_stress_drop.values]
        self.assertNotIn("contradict", slipfront.laboratory({**fronts, "stress_drop [MPa]": drops}, **POLYMER).attrs["warnings"])
        found = slipfront.laboratory({**fronts, "stress_drop [MPa]": ["0.02 */ 1.1"] * 3}, **POLYMER)
        self.assertRegex(found.attrs["warnings"], "the stress drops contradict the theory: [bcd] is [0-9.]+ standard deviations below its prediction, and 3 of 3 are 2 or more away")

    def test_a_table_of_one_stress_ratio_cannot_test_the_theory(self):
        fronts = {"tau [MPa]": [1.6, 1.62, 1.65], "normal_stress [MPa]": [5] * 3, "front_velocity [m/s]": ["20 +- 1", "100 +- 5", "600 +- 30"]}
        says = r"cannot test the theory: tau / sigma_N spans only 0.32 to 0.33;.*while the velocity spans a factor of 30"
        self.assertRegex(slipfront.laboratory(fronts, **POLYMER).attrs["warnings"], says)
        wide = {**fronts, "tau [MPa]": [1, 1.6, 3], "front_velocity [m/s]": ["20 +- 1", "100 +- 5", "600 +- 30"]}
        self.assertNotIn("cannot test", slipfront.laboratory(wide, **POLYMER).attrs["warnings"])

    def test_a_drop_that_the_theory_excludes_is_named(self):
        fronts = {"tau [MPa]": [2.5, 2.5], "normal_stress [MPa]": [5, 5], "front_velocity [m/s]": ["200 +- 20"] * 2, "stress_drop [MPa]": ["0.5 +- 0.05", "2.0..2.2"]}
        found = slipfront.laboratory(fronts, **POLYMER)
        self.assertEqual(found.included.values.tolist(), [1, 0])
        self.assertIn("stress drop", str(found.reason.values[1]))
        self.assertGreater(float(found.stress_drop_deviation[1]), 4)

    def test_the_docs_script_makes_the_case(self):
        with open(FRONTS, encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(text.startswith("# Synthetic"))
        self.assertEqual(_made_by_docs(), text)


def _made_by_docs():
    import importlib.util
    import pathlib

    spec = importlib.util.spec_from_file_location("synthetic_fronts", os.path.join(SOURCE, "docs", "synthetic_fronts.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    with tempfile.TemporaryDirectory() as folder:
        module.OUTPUT = pathlib.Path(folder) / "fronts.csv"
        module.main()
        return module.OUTPUT.read_text(encoding="utf-8")


class Command(PythonCommands):
    def test_equals_the_python_function_and_has_a_picture(self):
        output = os.path.join(os.path.dirname(self.file("unused", "")), "fronts.nc")
        printed = run("laboratory", FRONTS, *OPTIONS, "-o", output).stdout  # starts the program
        found = slipfront.laboratory(FRONTS, **POLYMER)
        stored = slipfront.open(output)
        for name in ("hardness_over_modulus", "predicted_front_velocity", "draw_scatter", "curve_front_velocity"):
            self.assertTrue((stored[name] == found[name]).all(), name)
        self.assertLessEqual(max(map(len, printed.splitlines())), 80)
        self.assertIn("left out: front 15: faster than c", printed)
        told = json.loads(self.ok("laboratory", FRONTS, *OPTIONS, "--json"))
        self.assertEqual((told["hardness_over_modulus"], told["fronts"][14]["deviation"]), (float(found.hardness_over_modulus), None))
        picture = output.replace(".nc", ".png")
        self.ok("plot", output, "-o", picture)
        self.assertGreater(os.path.getsize(picture), 20000)
        in_si = json.loads(self.ok("laboratory", FRONTS, *OPTIONS, "--json", "--si"))
        self.assertAlmostEqual(in_si["fronts"][0]["front_velocity"] / SPEED, told["fronts"][0]["front_velocity"], 12)

    def test_options_for_columns(self):
        table = self.file("t.csv", "a b c\n1 0.66 120\n2 0.67 150\n")
        columns = self.file("map.toml", "separator = ' '\n[columns]\na = 'name'\nb = 'shear_stress MPa'\nc = 'rupture_velocity m/s'\n")
        told = json.loads(self.ok("laboratory", table, *OPTIONS, "--columns", columns, "--normal-stress", "2 MPa", "--json"))
        self.assertEqual([front["name"] for front in told["fronts"]], ["1", "2"])
        self.refused(2, "laboratory", table, *OPTIONS, "--columns", columns, says=["normal_stress: the table has no such column"])

    def test_refuses(self):
        bad = self.file("bad.csv", "tau [MPa],normal_stress [MPa],front_velocity [m/s],other\n2,5,90,1\nx,5,90,1\n")
        told = json.loads(self.refused(2, "laboratory", bad, *OPTIONS, "--json", says=["bad.csv:3: tau [MPa] = 'x'"]).stdout)
        self.assertEqual((len(told["fronts"]), len(told["errors"]), told["ignored_columns"]), (1, 1, ["other"]))
        for code, arguments, says in [(2, (bad, *OPTIONS, "--strict"), "bad.csv:3"), (2, (FRONTS,), "poisson_ratio"), (2, (FRONTS, *OPTIONS, "--prior", "1"), "--prior '1'"), (2, (FRONTS, *OPTIONS, "--draws", "x"), "whole number; allowed"),
                                      (2, (FRONTS, *OPTIONS, "-o", "a.csv"), "a.csv: unsupported file type"), (3, ("/nowhere.csv", *OPTIONS), "/nowhere.csv"),
                                      (3, (FRONTS, *OPTIONS, "-o", "/nowhere/a.nc"), "/nowhere/a.nc")]:
            with self.subTest(says), contextlib.redirect_stderr(io.StringIO()) as complaint, contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(run_in_this_process("laboratory", arguments), code)
                self.assertIn(says, complaint.getvalue())
                self.assertEqual(complaint.getvalue().count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
