"""slipfront.moment_duration and slipfront.population."""

import importlib.util
import json
import math
import pathlib
import unittest
import unittest.mock
import warnings

import numpy as np
from scipy import special

from commands import PythonCommands
import slipfront
import support
from slipfront._population import forward, hierarchy, priors, rows, sample, synthetic
from slipfront._population.likelihood import Likelihood

SOURCE = pathlib.Path(support.SOURCE)
LOG_HARDNESS = math.log(1e10)


def script(path):
    """Returns a script of the repository as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class MomentDuration(unittest.TestCase):
    def test_the_exponent_falls_from_two_to_one(self):
        damping = np.array([0.01, 1, 2, 4, 20, 40, 100, 1e4, 1e9])
        for stress in (0.2, 0.855):
            data = slipfront.moment_duration(stress, damping)
            exponent = data.exponent.values
            self.assertTrue((np.diff(exponent) < 1e-3).all(), exponent)
            np.testing.assert_allclose(exponent[[0, 6, 7, 8]], [2, 1, 1, 1], atol=0.012)
            mean = 2 + np.diff(np.log(data.potency.values)) / np.diff(np.log(damping))
            np.testing.assert_allclose(mean[[1, 2, 4]], [1.62, 1.41, 1.04], atol=0.01)
            self.assertEqual(float(slipfront.moment_duration(stress, 0).exponent), 2)

    def test_agrees_with_the_solver(self):
        potency = script(SOURCE / "tools" / "potency" / "make.py").potency
        for stress, damping in ((0.09, 3.0), (0.3, 250.0), (0.855, 0.0), (0.855, 0.7), (2.5, 30.0)):
            free = slipfront.relations(stress=stress)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                expected = potency(stress, damping) * float(free.rupture_velocity * free.slip_velocity)
            self.assertLess(abs(float(slipfront.moment_duration(stress, damping).potency) / expected - 1), 3e-3, (stress, damping))

    def test_the_exponent_is_the_slope(self):
        damping = np.geomspace(1e-3, 1e10, 2001)
        data = slipfront.moment_duration(0.4, damping)
        slope = 2 + np.gradient(np.log(data.potency.values), np.log(damping))
        np.testing.assert_allclose(data.exponent[1:-1], slope[1:-1], atol=1e-3)

    def test_out_of_range(self):
        for arguments, message in (((0.01, 1), "stress = 0.01: out of range; allowed: 0.05 to 3"), ((1, -1), "damping_number = -1: out of range; allowed: >= 0")):
            with self.assertRaisesRegex(slipfront.InputError, message):
                slipfront.moment_duration(*arguments)
        self.assertTrue(np.isnan(slipfront.moment_duration(np.nan, 1).potency))


def dense(events, i, values, offsets):
    """Returns ln of the likelihood of event i without selection, and ln of its probability of detection, for each offset of its study, by dense sums."""
    stress, stress_spread, normal, normal_spread, friction, friction_spread, _ = values
    contact, variance = np.log(normal) - LOG_HARDNESS, normal_spread**2 + friction_spread**2
    off = np.linspace(-6.5, 6.5, 261)[:, None] * np.sqrt(variance)
    ends = np.clip(np.log(stress) + np.array([-7, 7]) * stress_spread, forward.LOG_STRESS[0], forward.LOG_STRESS[-1])
    log_stress = np.linspace(*ends, 801)
    weight = np.exp(-0.5 * off**2 / variance) * np.exp(-0.5 * np.square((log_stress - np.log(stress)) / stress_spread))
    weight[:, [0, -1]] /= 2
    weight /= weight.sum()
    log_damping = contact + np.log(friction) + off + events.log_duration[i] + np.log(events.speed[i])
    error, deviation = events.front_error[i], np.hypot(events.size_error[i], normal_spread * friction_spread / np.sqrt(variance))
    front = (events.log_front[i] - forward.at(forward.front(events.threshold[i]), log_stress, log_damping)) / error
    size = contact + normal_spread**2 / variance * off + forward.at(forward.size(events.kind[i]), log_stress, log_damping)
    seen = np.log(weight) - 0.5 * front**2 - np.log(2 * np.pi * error * deviation)
    found = [special.logsumexp(seen - 0.5 * np.square((events.log_size[i] - size - offset) / deviation)) for offset in offsets]
    detected = [np.log(np.sum(weight * special.ndtr((size + offset - events.smallest[i]) / deviation))) for offset in offsets]
    return np.array(found), np.array(detected)


class Likelihoods(unittest.TestCase):
    """The likelihood against sums over events that are drawn from the population."""

    def test_sums_are_exact_for_populations_from_the_prior(self):
        worst, offset = [], []
        for seed in range(5):
            generator = np.random.default_rng([9, seed])
            events = synthetic.design(generator, 6, 2, smallest=-20.0, threshold=1e-3)
            truth = synthetic.parameters(generator, events, LOG_HARDNESS)
            synthetic.observe(generator, events, truth, LOG_HARDNESS)
            likelihood = Likelihood(events, LOG_HARDNESS)
            self.assertTrue(likelihood.selection.prepare(truth, LOG_HARDNESS))
            offsets = truth[-1] * np.array([-1.0, 0, 1])
            expected = np.array([dense(events, i, truth, offsets) for i in range(6)])
            found = np.stack([likelihood.each(truth, offsets, np.arange(6)), likelihood.selection.log_probability(offsets, np.arange(6))], axis=1)
            worst.append(np.abs(found - expected).max(axis=(0, 2)))
            offset.append((found - expected).mean(axis=(0, 2)))
        self.assertTrue((np.max(worst, axis=0) < [0.01, 0.03]).all(), np.max(worst, axis=0))
        self.assertTrue((np.abs(offset) < 0.005).all(), offset)

    @staticmethod
    def drawn(events, i, values, offsets, count=200_000):
        """Returns the likelihood of event i for each offset of its study, by simple Monte Carlo."""
        generator = np.random.default_rng(7)
        log_stress, log_contact, log_friction = synthetic.states(generator, values, count, LOG_HARDNESS)
        log_damping = log_contact + log_friction + np.log(events.speed[i]) + events.log_duration[i]
        size = log_contact + forward.at(forward.size(events.kind[i]), log_stress, log_damping)
        off = (events.log_front[i] - forward.at(forward.front(events.threshold[i]), log_stress, log_damping)) / events.front_error[i]
        density = np.exp(-0.5 * off**2) / (events.front_error[i] * np.sqrt(2 * np.pi))
        found = []
        for offset in offsets:
            rest = (events.log_size[i] - size - offset) / events.size_error[i]
            detected = special.ndtr((size + offset - events.smallest[i]) / events.size_error[i]).mean()
            found.append((density * np.exp(-0.5 * rest**2) / (events.size_error[i] * np.sqrt(2 * np.pi))).mean() / detected)
        return np.array(found)

    def check(self, values, smallest, tolerance, **options):
        generator = np.random.default_rng(6)
        events = synthetic.design(generator, 3, 2, smallest=smallest, **options)  # a study with two events, and one with one
        synthetic.observe(generator, events, values, LOG_HARDNESS)
        places, weights = np.polynomial.hermite_e.hermegauss(15)
        each = np.array([self.drawn(events, i, values, values[-1] * places) for i in range(3)])
        expected = sum(np.log(np.prod(each[events.study == study], axis=0) @ weights / weights.sum()) for study in (0, 1))
        self.assertLess(abs(Likelihood(events, LOG_HARDNESS)(values) - expected), tolerance)

    def test_is_the_mean_over_the_population(self):
        values = np.array([0.4, 0.15, 1e7, 0.5, 1e-2, 0.7, 0.3])
        self.check(values, -np.inf, 0.1, threshold=1e-3)
        self.check(values, -np.inf, 0.1, threshold=0.0, kind=forward.SLIP, front_error=0.3)
        self.check(np.array([0.6, 0.3, 1e7, 0.3, 1e-3, 0.5, 0.5]), -np.inf, 0.1, threshold=1e-3, size_error=0.4)

    def test_divides_by_the_probability_of_detection(self):
        self.check(np.array([0.4, 0.15, 1e7, 0.5, 1e-2, 0.7, 0.3]), -23.0, 0.1, threshold=1e-3)


class Populations(unittest.TestCase):
    def test_shuffled_slip_keeps_the_slope(self):
        slopes = script(SOURCE / "docs" / "population.py").invented_slopes()
        self.assertGreater(min(slopes), 0.85)


class Catalogues(PythonCommands):
    ROWS = "name,study,rupture_velocity_km_s,length_km,slip_m,moment_N_m,Mw,width_km,duration_s\n"

    def test_reads_moments_and_lengths(self):
        text = self.ROWS + "\n".join(("a,x,3 +- 0.3,,1,,,,10", "b,x,,30 */ 1.2,,1e19 */ 1.5,,20,10 */ 1.1", "c,y,,30,,,6.6,20,10", "d,y,2,,,1e19,,,10")) + "\n"
        found, left_out = hierarchy._read(text, None, ["", "", ""], {"velocity": 0.2, "size": 0.4})
        self.assertEqual(left_out, [("d", "no slip, and no moment with a width")])
        events = rows.arrays(found, {})
        self.assertEqual(events.study.tolist(), [0, 0, 1])
        np.testing.assert_allclose(np.exp(events.log_front) * events.speed, [3000, 3000, 3000])
        np.testing.assert_allclose(events.front_error, [0.1, np.hypot(np.log(1.2), np.log(1.1)), 0.2])
        np.testing.assert_allclose(np.exp(events.log_size[0]) * events.speed[0] / np.pi, 0.1)
        potency = np.exp(events.log_size) / np.pi * (events.speed * 10) ** 2
        np.testing.assert_allclose(potency[1:], [1e19 / 30e9 / 20e3, 10 ** (1.5 * 6.6 + 9.05) / 30e9 / 20e3])
        np.testing.assert_allclose(events.shared, [0, 2 * np.log(1.1) ** 2, 0])

    def test_refuses_bad_input(self):
        good = self.ROWS + "".join(f"e{i},x,3,,{i},,,,10\n" for i in range(1, 5))
        for arguments, message in ((["--smallest-slip", "2 m"], "'e1' is below the detection limit"), (["--smallest-moment", "1e18"], "smallest_moment: 'e1' has no such size"),
                                   (["--prior", "friction=1,2"], "prior: 'friction': unknown; allowed: stress_median"), (["--prior", "friction_median=1"], "not a median and a factor"),
                                   (["--kind", "flood"], "events: 0 can be used of the kind flood; allowed: 3 or more"), (["--steps", "2"], "steps = '2': out of range"),
                                   (["--hardness", "10 km"], "hardness"), (["--size-error", "0.5"], "size_error = '0.5': out of range; allowed: a number above 1"),
                                   (["-o", "a.txt"], "a.txt: unsupported file type")):
            with self.subTest(arguments):
                self.refused(2, "population", self.file("good.csv", good), *arguments, says=[message])
        self.assertEqual(support.run("population", "--steps", "2").returncode, 2)  # starts the program

    def test_a_bad_row_is_left_out_with_its_reason(self):
        text = self.ROWS + "".join(f"e{i},x,3,,{i},,,,10\n" for i in range(1, 5)).replace("3,,1,,,,10", "3,,1,,,1 kg,10")
        found, left_out = hierarchy._read(text, None, ["", "", ""], {"velocity": 0.2, "size": 0.4})
        self.assertEqual(([entry["name"] for entry in found], left_out[0][0]), (["e2", "e3", "e4"], "e1"))
        self.assertIn("events:2: width_km = '1 kg'", left_out[0][1])

    def test_a_map_names_columns(self):
        text = "who\tA1\tA2\tT\n" + "".join(f"e{i}\t{2 + i / 10}\t{i}\t{10 * i}\n" for i in range(1, 5))
        columns = {"columns": {"who": "name", "A1": "rupture_velocity km/s", "A2": "slip m", "T": "duration s"}}
        mapped = slipfront.population(text, steps=20, columns=columns)
        titled = slipfront.population(text.replace("who\tA1\tA2\tT", "name\tVr (km/s)\tslip (m)\tduration (s)"), steps=20)
        np.testing.assert_array_equal(mapped.stress_median, titled.stress_median)
        path = self.file("map.toml", "[columns]\nwho = 'name'\nA1 = 'rupture_velocity km/s'\nA2 = 'slip m'\nT = 'duration s'\n")
        out = json.loads(self.ok("population", self.file("t.csv", text), "--columns", path, "--steps", "20", "--json"))
        self.assertEqual(out["events"], ["e1", "e2", "e3", "e4"])

    def test_the_command_writes_what_it_prints(self):
        path = str(pathlib.Path(self.file("c.csv", "")).parent / "p.nc")
        with unittest.mock.patch.object(sample, "PARTICLES", 25):
            found = json.loads(self.ok("population", "--kind", "earthquake", "--steps", "20", "--json", "-o", path))
        data = slipfront.open(path)
        self.assertEqual(data.sizes["event"], 27)
        self.assertEqual(found["left_out"], list(data.left_out.values))
        for name in priors.NAMES:
            self.assertAlmostEqual(found["parameters"][name]["50 %"] / float(data[name].median()), 1, 12)
        self.assertTrue((np.diff(data.event_damping_number.values, axis=1) > 0).all())


if __name__ == "__main__":
    unittest.main()
