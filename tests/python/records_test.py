"""Records of experiments: stick-slip events, and the velocity of fronts from arrival times at
gauges."""

import io
import json
import os
import pathlib
import tempfile
import unittest

import numpy

import slipfront
from support import run

STIFFNESS, SPEED = 0.05, 1.0  # MPa/um, um/s


def record(noise=0.002):
    """Rows (time, load point, slip, shear stress) of a block on a spring. Returns also the drops
    and slips of its events."""
    rows, events, time, load, slip, stress, step = [], [], 0.0, 0.0, 0.0, 1.0, 0.01
    for number in range(6):
        while stress < 1.6 + 0.05 * number:
            time, load, stress = time + step, load + step * SPEED, stress + STIFFNESS * step * SPEED
            rows.append((time, load, slip, stress))
        drop = 0.4 + 0.02 * number
        events.append((drop, drop / STIFFNESS))
        for _ in range(10):
            time, load, slip = time + step, load + step * SPEED, slip + drop / STIFFNESS / 10
            stress += STIFFNESS * step * SPEED - drop / 10
            rows.append((time, load, slip, stress))
    table = numpy.array(rows)
    table[:, 3] += noise * numpy.random.default_rng(1).standard_normal(len(table))
    return table, numpy.array(events)


def text_of(table, titles, columns):
    return (
        ",".join(titles)
        + "\n"
        + "".join(",".join(f"{row[i]:.6f}" for i in columns) + "\n" for row in table)
    )


class LaboratoryEvents(unittest.TestCase):
    def test_events_have_drop_slip_duration_and_stiffness(self):
        table, events = record()
        found = slipfront.laboratory_events(
            text_of(table, ("time_s", "slip [um]", "shear stress (MPa)"), (0, 2, 3)),
            normal_stress="5 MPa",
        )
        self.assertEqual(found.sizes["event"], len(events))
        numpy.testing.assert_allclose(found.stress_drop, 1e6 * events[:, 0], atol=0.008e6)
        numpy.testing.assert_allclose(found.slip, 1e-6 * events[:, 1], rtol=0.02)
        numpy.testing.assert_allclose(found.stiffness, 1e12 * STIFFNESS, rtol=0.03)
        numpy.testing.assert_allclose(found.duration, 0.1, atol=0.011)
        self.assertTrue((found.normal_stress == 5e6).all())

    def test_a_load_point_gives_the_stiffness_of_the_load(self):
        table, events = record()
        found = slipfront.laboratory_events(
            text_of(table, ("Time [s]", "LPDisp", "Tau [MPa]"), (0, 1, 3)),
            load_point=True,
            columns={"columns": {"LPDisp": "displacement um"}},
        )
        numpy.testing.assert_allclose(found.stiffness, 1e12 * STIFFNESS, rtol=0.01)
        numpy.testing.assert_allclose(found.slip, 1e-6 * events[:, 1], rtol=0.02)

    def test_slow_falls_are_no_events(self):
        table, events = record(0)
        ramp = [
            (table[-1, 0] + 0.1 * i, 0, table[-1, 2], table[-1, 3] + 0.005 * min(i, 120 - i))
            for i in range(1, 180)
        ]
        found = slipfront.laboratory_events(
            text_of([*table, *ramp], ("t [s]", "slip [um]", "tau [MPa]"), (0, 2, 3))
        )
        self.assertEqual(found.sizes["event"], len(events))
        self.assertIn(
            "falls of the stress that are not 3 times faster than its rise, left out: 1",
            found.attrs["warnings"],
        )
        with self.assertRaisesRegex(slipfront.InputError, "no event: the shear stress never falls"):
            slipfront.laboratory_events(
                text_of(ramp[60:], ("t [s]", "slip [um]", "tau [MPa]"), (0, 2, 3))
            )

    def test_errors_name_line_and_column(self):
        for text, says in (
            ("time,slip [um],tau [MPa]\n1,1,1\n", "1: time: no unit; allowed: a unit in the title"),
            ("time [s],tau [MPa]\n1,1\n", "1: displacement: the table has no such column"),
            ("time [m],slip [um],tau [MPa]\n1,1,1\n", "time .m. = '1 m'"),
            ("time [s],slip [um],tau [MPa]\n1,1,1\n1,2,3\n", "row 2 is not later"),
            ("time [s],slip [um],tau [MPa]\n1,x,1\n", "no row has all of"),
        ):
            with self.assertRaisesRegex(slipfront.InputError, says):
                slipfront.laboratory_events(text)

    def test_the_program_writes_a_table_that_laboratory_and_event_read(self):
        with tempfile.TemporaryDirectory() as folder:
            source, out = os.path.join(folder, "record.csv"), os.path.join(folder, "events.csv")
            pathlib.Path(source).write_text(
                text_of(record()[0], ("time_s", "slip [um]", "tau [MPa]"), (0, 2, 3)),
                encoding="utf-8",
            )
            done = run("laboratory", source, "--events", "--normal-stress", "5 MPa", "-o", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("events    6", done.stdout)
            self.assertEqual(
                len(json.loads(run("laboratory", source, "--events", "--json").stdout)["events"]), 6
            )
            found = slipfront.event(out, samples=0)
            self.assertEqual([str(error) for error in found.error.values], [""] * 6)
            text = pathlib.Path(out).read_text(encoding="utf-8")
            filled = "\n".join(
                line + "120" if i else line for i, line in enumerate(text.splitlines())
            )
            fronts = slipfront.laboratory(filled, poisson_ratio=0.35, s_wave_speed="1300 m/s")
            self.assertEqual(fronts.sizes["front"], 6)
            self.assertEqual(run("laboratory", source, "--events", "-o", "x.nc").returncode, 2)
            self.assertEqual(run("laboratory", source, "--load-point").returncode, 2)


class Arrivals(unittest.TestCase):
    TABLE = (
        "event,x [mm],arrival_us,t_err"
        " [us]\na,0,0,1\na,10,52,1\na,20,98,1\na,30,152,1\nb,0,10,20\nb,10,22,20\n"
    )

    def test_intervals_hold_ninety_percent_of_repeated_measurements(self):
        found = slipfront.arrivals(self.TABLE)
        self.assertEqual(found.sizes["front"], 5)
        random = numpy.random.default_rng(2)
        times = 1e-6 * (numpy.array([0.0, 50.0]) + random.standard_normal((4000, 2)) * 3)
        inside = 0
        for first, second in times:
            low, high = slipfront._arrivals._velocity(0.01, second - first, 0.0, 3e-6 * 2**0.5)[
                1:
            ]
            inside += low <= 200 <= high
        self.assertAlmostEqual(inside / len(times), 0.9, delta=0.02)

    def test_all_gauges_give_a_narrower_interval(self):
        found = slipfront.arrivals(self.TABLE)
        widths = (found.velocity_interval[:, 1] - found.velocity_interval[:, 0]).values
        self.assertLess(widths[3], 0.5 * widths[:3].min())
        self.assertAlmostEqual(float(found.velocity[3]), 199, delta=1)
        self.assertEqual(float(found.velocity_interval[4, 1]), float("inf"))

    def test_a_front_in_two_directions_has_no_single_velocity(self):
        found = slipfront.arrivals({"x [m]": [0, 1, 2], "t [s]": [1.0, 0.0, 2.0]})
        self.assertEqual(found.velocity.values.tolist(), [1.0, 0.5])

    def test_equal_arrival_times_give_no_velocity_but_a_reason(self):
        exact = slipfront.arrivals({"x [m]": [0, 1, 2], "t [s]": [1.0, 1.0, 1.0]})
        self.assertEqual(exact.sizes["front"], 3)
        self.assertTrue(numpy.isnan(exact.velocity).all() and numpy.isnan(exact.velocity_interval).all())
        self.assertEqual(exact.attrs["warnings"].count("equal arrival times"), 3)
        table = {"x [m]": [0, 1], "t [s]": [1.0, 1.0], "error of time [s]": [0.1, 0.1]}
        bounded = slipfront.arrivals(table)
        self.assertTrue(numpy.isnan(bounded.velocity[0]))
        bound = 1 / (slipfront._arrivals.SIGMAS * 0.1 * 2**0.5)
        numpy.testing.assert_allclose(bounded.velocity_interval[0], [bound, float("inf")])
        self.assertIn("only a lower bound", bounded.attrs["warnings"])
        later = slipfront.arrivals({**table, "t [s]": [1.0, 1.0 + 1e-9]})
        numpy.testing.assert_allclose(later.velocity_interval[0, 0], bound, rtol=1e-6)

    def test_a_map_names_other_titles(self):
        found = slipfront.arrivals(
            {"gauge": [0, 10], "T1": [0, 50], "sT": [1, 1]},
            columns={
                "columns": {"gauge": "position mm", "T1": "time us", "sT": "error of time us"}
            },
        )
        self.assertAlmostEqual(float(found.velocity[0]), 200)
        self.assertLess(float(found.velocity_interval[0, 0]), 195)
        with self.assertRaisesRegex(
            slipfront.InputError, "T1 = 'speed': no quantity of this table"
        ):
            slipfront.arrivals(
                {"x [m]": [0, 1], "t [s]": [0, 1]}, columns={"columns": {"T1": "speed"}}
            )

    def test_the_program_writes_fronts_that_laboratory_reads(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "gauges.csv")
            pathlib.Path(path).write_text(self.TABLE, encoding="utf-8")
            done = run("fronts", "--arrivals", path, "--csv")
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = [
                line.rsplit(",", 1) for line in io.StringIO(done.stdout).read().splitlines()[1:]
            ]
            self.assertEqual(rows[-1][1], ">170.872")
            text = done.stdout.replace("[m/s]", "[m/s],tau [MPa],normal_stress [MPa]").replace(
                "\n", ",2,5\n"
            )
            text = text.replace("normal_stress [MPa],2,5", "normal_stress [MPa]")
            self.assertEqual(
                slipfront.laboratory(text, poisson_ratio=0.35, s_wave_speed="1300 m/s").sizes[
                    "front"
                ],
                4,
            )
            self.assertEqual(run("fronts").returncode, 2)
            self.assertEqual(
                len(json.loads(run("fronts", "--arrivals", path, "--json").stdout)["fronts"]), 5
            )


if __name__ == "__main__":
    unittest.main()
