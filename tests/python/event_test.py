"""slipfront.event against the command line."""

import json
import os
import unittest

import numpy as np
import pandas as pd
import xarray as xr

import slipfront
from support import CommandLine, SOURCE

INFERRED = ["rupture_velocity", "stress", "frictionless_slip_velocity", "observed_slip_velocity", "contact_ratio", "stress_pa", "damping_number"]


def nothing(value):
    return np.nan if value is None else value


class Event(CommandLine):
    def test_a_dict_of_columns_is_a_table(self):
        table = {"name": ["a", "b"], "rupture_velocity": ["3 km/s", "2.5 +- 0.1 km/s"], "slip_velocity": ["0.5 m/s", None]}
        xr.testing.assert_identical(slipfront.event(table), slipfront.event(pd.DataFrame(table)))
        arrays = slipfront.event({"rupture_velocity [km/s]": np.array([3, 2.5])})
        np.testing.assert_allclose(arrays.rupture_velocity[0] / arrays.rupture_velocity[1], 1.2)
        for bad in ({"name": ["a", "b"], "rupture_velocity": ["3 km/s"]}, {"name": "a", "rupture_velocity": ["3 km/s"]}, {"rupture_velocity": []}):
            with self.assertRaisesRegex(slipfront.InputError, "not lists of one length"):
                slipfront.event(bad)

    def test_is_what_the_command_line_says(self):
        for files in (["cases/parkfield-2004.toml", "cases/ets.toml"], ["cases/catalogue.csv"], ["tests/data/fsp_usgs_single.fsp"]):
            files = [os.path.join(SOURCE, file) for file in files]
            rows = json.loads(self.ok("event", *files, "--json"))["events"]
            data = slipfront.event(files)
            self.assertEqual(data.sizes["event"], len(rows))
            for i, row in enumerate(rows):
                self.assertEqual(data.name.values[i], row["name"])
                self.assertEqual(data.warnings.values[i], "; ".join(row["warnings"]))
                np.testing.assert_equal(float(data.c_m_s[i]), nothing(row["c_m_s"]))
                for key in INFERRED:
                    np.testing.assert_equal(float(data[key][i]), nothing(row[key]), key)
                    np.testing.assert_equal(data[key + "_interval"].values[i], row[key + "_interval"] or [np.nan, np.nan], key)
        self.assertEqual(data.stress_pa.attrs["units"], "Pa")

    def test_is_what_the_file_holds(self):
        path = os.path.join(os.path.dirname(self.file("a", "")), "events.nc")
        case = os.path.join(SOURCE, "cases/catalogue.csv")
        self.ok("event", case, "-o", path)
        data = slipfront.event(case)
        with xr.open_dataset(path) as file:
            for name, variable in data.variables.items():
                self.assertEqual(file[name].dims, variable.dims, name)
                self.assertEqual(file[name].attrs, variable.attrs, name)
                np.testing.assert_equal(file[name].values, variable.values, name)
            self.assertEqual(file.attrs["seed"], "1")
            self.assertEqual(int(file.population_events.sum()), int(data.rupture_velocity.notnull().sum()))
            top = file.isel(decade=-1)
            inside = data.rupture_velocity >= float(top.decade_bounds[0])
            np.testing.assert_allclose(top.population_stress, data.stress.where(inside).quantile([0.05, 0.5, 0.95]), rtol=1e-14)
            np.testing.assert_allclose(file.line_stress, slipfront.relations(rupture_velocity=file.line_rupture_velocity.values).stress, rtol=1e-12)
            np.testing.assert_equal(np.isnan(data.stress_pa_bound.values) | np.isnan(data.stress_pa.values), True)
        drawn = slipfront.event({"name": "a", "rupture_velocity": "3.0 +- 0.2 km/s", "slip_velocity": "0.5 m/s"}, draws=7)
        self.assertEqual(drawn.draw_stress_pa.dims, ("event", "draw"))
        self.assertTrue(drawn.draw_stress_pa.notnull().all())
        opened = slipfront.open(path)
        self.assertNotIn("done", opened)
        self.assertEqual(opened.sizes["event"], data.sizes["event"])

    def test_pulse_through_a_finite_fault_model(self):
        path = os.path.join(SOURCE, "tests/data/fsp_srcmod_single.fsp")
        with open(path) as file:  # nine columns of two subfaults, ruptured from the middle at avVr
            text = "".join(line for line in file if line.startswith("%"))
        text = text.replace("Nx  =    3", "Nx  =    9").replace("Nsbfs =      6", "Nsbfs =     18").replace("SLIP      RAKE\n", "SLIP      RAKE     TRUP     RISE\n")
        text += "".join(f"\n 35.0 -120.0 {2 * (i - 4)} 0.0 {0.5 + 2 * j} 1.0 180.0 {abs(i - 4) * 2 / 2.5} 1.5" for j in range(2) for i in range(9))
        data = slipfront.event([text + "\n", path], pulse=True)
        self.assertAlmostEqual(float(data.pulse_front_velocity_ratio[0]), 1, 5)
        self.assertEqual(data.pulse_reason.values[0], "")
        self.assertIn("rupture times", data.pulse_reason.values[1])
        np.testing.assert_equal(data.pulse_columns.values, [9, np.nan])
        self.assertNotIn("pulse_columns", slipfront.event(path))

    def test_the_share_of_the_prior_is_that_of_json(self):
        path = self.file("known.toml", '[event]\nrupture_velocity = "3.0 +- 0.2 km/s"\nslip_velocity = "0.5 */ 1.2 m/s"\n'
                         "[medium]\ncontact_ratio = { mean = 0.01, sd = 0.002 }\n")
        event, = json.loads(self.ok("event", path, "--json"))["events"]
        data = slipfront.event(path).isel(event=0)
        for name, share in event["posterior"]["prior_share"].items():
            self.assertTrue(0 < share < 1, name)
            self.assertEqual(float(data[name + "_prior_share"]), share, name)

    def test_nothing_is_the_shipped_catalogue(self):
        self.assertEqual(slipfront.event().sizes["event"], len(json.loads(self.ok("event", "--json"))["events"]))

    def test_dicts_and_frames(self):
        flat = {"name": "a", "rupture_velocity": "3.0 km/s", "slip_velocity": "0.5 m/s"}
        nested = {"event": {"name": "a", "rupture_velocity": "3.0 km/s", "slip_velocity": "0.5 m/s"}}
        one, two = slipfront.event(flat), slipfront.event(nested)
        self.assertAlmostEqual(float(one.rupture_velocity), 0.5534, 4)
        self.assertEqual(float(one.stress), float(two.stress))
        written = slipfront.event({"event": {"name": "a", "rupture_velocity": "3.0 +- 0.2 km/s"}})
        table = slipfront.event({"event": {"name": "a", "rupture_velocity": {"mean": "3 km/s", "sd": "200 m/s"}}})
        np.testing.assert_allclose(table.stress_interval, written.stress_interval, rtol=1e-3)
        with self.assertRaisesRegex(slipfront.InputError, "event.rupture_velocity.meen: unknown key"):
            slipfront.event({"event": {"rupture_velocity": {"meen": "3 km/s", "sd": "200 m/s"}}})
        frame = pd.DataFrame({"name": ["a", "b"], "rupture_velocity_km_s": [3.0, np.nan], "slip_velocity_m_s": [0.5, 0.1]})
        data = slipfront.event(frame)
        self.assertEqual(float(data.stress[0]), float(one.stress))
        self.assertTrue(np.isnan(data.stress[1]))
        self.assertEqual(slipfront.event([flat, nested, frame]).sizes["event"], 4)

    def test_an_interrupted_catalogue_is_resumed_to_the_same_bytes(self):
        rows = "name,rupture_velocity,slip_velocity,contact_ratio\n" + "".join(
            f"e{i},3.{i % 10} +- 0.2 km/s,0.5 */ 1.3 m/s,0.00{i % 7 + 4} */ 1.4\n" for i in range(250))
        catalogue = self.file("catalogue.csv", rows)
        folder = os.path.dirname(catalogue)
        whole, stopped, of_program = (os.path.join(folder, name) for name in ("whole.nc", "stopped.nc", "program.nc"))
        seen = []
        data = slipfront.event(catalogue, output=whole, draws=5, progress=lambda *done: seen.append(done[:2]))
        self.assertTrue(all(total == 250 for _, total in seen))

        def stop(*_):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            slipfront.event(catalogue, output=stopped, draws=5, progress=stop)
        self.assertLess(slipfront.open(stopped).sizes["event"], 250)
        with self.assertRaisesRegex(slipfront.InputError, "another seed"):
            slipfront.event(catalogue, resume=stopped, draws=5, seed=2)
        resumed = slipfront.event(catalogue, resume=stopped, draws=5)
        self.assertTrue(resumed.identical(data))
        with open(whole, "rb") as one, open(stopped, "rb") as other:
            expected = one.read()
            self.assertEqual(expected, other.read())
        self.ok("event", catalogue, "--draws", "5", "-o", of_program)
        with open(of_program, "rb") as file:
            self.assertEqual(expected, file.read())

    def test_writes_the_csv_of_the_command(self):
        catalogue = os.path.join(SOURCE, "cases/catalogue.csv")
        folder = os.path.dirname(self.file("x", ""))
        one, other = os.path.join(folder, "one.csv"), os.path.join(folder, "other.csv")
        data = slipfront.event(catalogue, output=one)
        self.ok("event", catalogue, "-o", other)
        with open(one, "rb") as a, open(other, "rb") as b:
            self.assertEqual(a.read(), b.read())
        np.testing.assert_array_equal(pd.read_csv(one, float_precision="round_trip").stress, data.stress)
        event = {"rupture_velocity": "3 km/s"}
        for says, change in [("unsupported file type", {"output": "a.txt"}), ("no draws", {"output": one, "draws": 3}), ("cannot be resumed", {"output": one, "resume": "a.nc"})]:
            with self.assertRaisesRegex(slipfront.InputError, f"{says}; allowed: a name that ends in .nc"):
                slipfront.event(event, **change)

    def test_a_bad_event_does_not_lose_the_others(self):
        data = slipfront.event([{"name": "good", "rupture_velocity": "3 km/s"}, {"name": "bad", "rupture_velocity": "9 km/s"}])
        self.assertEqual(data.error.values[0], "")
        self.assertIn("9", data.error.values[1])
        self.assertTrue(np.isnan(data.stress[1]) and not np.isnan(data.stress[0]))

    def test_medium_of_the_user(self):
        slow = slipfront.event({"name": "a", "rupture_velocity": "3 km/s"}, p_wave_speed="7 km/s", poisson_ratio=0.25)
        self.assertAlmostEqual(float(slow.c_m_s), float(slipfront.medium.speed_from_p_wave(7000.0, 0.25)), 9)

    def test_columns_and_strict(self):
        table = pd.DataFrame({"name": ["A"], "VR": [2.7], "dVR": [0.2], "fc": [0.3]})
        columns = {"columns": {"VR": "rupture_velocity km/s", "dVR": "error of rupture_velocity"}}
        event = slipfront.event(table, columns=columns, samples=0)
        self.assertEqual(float(event.rupture_velocity_m_s[0]), 2700)
        self.assertEqual(event.attrs["ignored_columns"], "fc")
        self.assertEqual(event.attrs["ignored_quantities"], "fc")
        with self.assertRaisesRegex(slipfront.InputError, "fc: a column that looks like a quantity"):
            slipfront.event(table, columns=columns, strict=True)
        with self.assertRaisesRegex(slipfront.InputError, "columns:2: columns.VR = 'rupture_speed': unknown quantity"):
            slipfront.event(table, columns={"columns": {"VR": "rupture_speed km/s"}})


if __name__ == "__main__":
    unittest.main()
