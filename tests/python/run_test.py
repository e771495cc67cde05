"""Compares slipfront.pulse, chain and compare with the command line and its files."""

import json
import math
import os
import pathlib
import threading
import time
import unittest

import numpy as np
import xarray as xr

import slipfront
from support import CommandLine, SOURCE

CASE = os.path.join(SOURCE, "cases/fig-08.toml")
STEP = os.path.join(SOURCE, "cases/step.toml")


class Run(CommandLine):
    def folder(self):
        return os.path.dirname(self.file("unused", ""))

    def same(self, first, second):
        with open(first, "rb") as a, open(second, "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_summary_is_the_json_of_the_command_line(self):
        for run, command in [(slipfront.pulse, "pulse"), (slipfront.chain, "chain")]:
            asked = json.loads(self.ok(command, CASE, "--set", "chain.scale=150", "--threads", "2", "--json"))
            got = run(CASE, set={"chain.scale": 150}, threads=2).attrs
            for key, value in asked.items():
                if key == "warnings":
                    self.assertEqual(got[key], "\n".join(value))
                elif key == "reasons":
                    self.assertEqual({name: got[f"{name}_reason"] for name in value}, value)
                elif "second" not in key and key != "errors":  # times differ; attrs has each error as KEY_error
                    np.testing.assert_equal(got[key], np.nan if value is None else value, key)

    def test_file_and_dataset_are_those_of_the_command_line(self):
        folder = self.folder()
        for run, command in [(slipfront.pulse, "pulse"), (slipfront.chain, "chain"), (slipfront.compare, "compare")]:
            ours, theirs = os.path.join(folder, command + ".nc"), os.path.join(folder, command + "-c.nc")
            scale = {"chain.scale": 150}
            data = run(CASE, set=scale, output=ours, threads=1)
            self.ok(command, CASE, "--set", "chain.scale=150", "-o", theirs, "--threads", "1")
            self.same(ours, theirs)
            with xr.open_dataset(ours) as stored:
                added = {"quantity", "closure", "window", "smooth_window", "wall_seconds", "difference", "trend_exponent",
                         "trend_extrapolated", "trend_difference"} if command == "compare" else set()
                self.assertEqual(set(data.variables), set(stored.variables) - {"checkpoint"} | added)
                for name in set(stored.variables) - {"checkpoint"}:
                    self.assertEqual(data[name].dims, stored[name].dims)
                    self.assertEqual(data[name].attrs, stored[name].attrs)
                    self.assertEqual(set(data[name].coords) - {"quantity"}, set(stored[name].coords), name)
                    if name != "name":
                        np.testing.assert_array_equal(data[name].values, stored[name].values)
                for name in stored.attrs:
                    self.assertEqual(data.attrs[name], stored.attrs[name], name)
            again = slipfront.open(ours)
            xr.testing.assert_equal(again, data[list(again.data_vars)].drop_vars("quantity", errors="ignore"))

    def test_scenario_as_path_text_and_dict(self):
        tables = {"title": "quo\"ted \\ \x7f", "initial": {"profile": "tanh", "stress_left": 0.855, "stress_right": np.float64(0.179), "width": 1},
                  "friction": {"law": "viscous", "coefficient": 0.5}, "output": {"times": np.array([1.0, 2]), "variables": ["k", "W"]},
                  "pulse": {"cells": np.int64(60)}}
        data = slipfront.pulse(tables)
        self.assertEqual(data.attrs["title"].encode().replace(b"\x7f", b""), tables["title"].encode().replace(b"\x7f", b""))
        self.assertEqual(list(data.time.values[:3]), [0, 1, 2])
        self.assertNotIn("U", data)
        text = data.attrs["scenario"]
        self.assertTrue(slipfront.pulse(text).k.identical(data.k))
        self.assertTrue(slipfront.pulse(pathlib.Path(self.file("s.toml", text))).k.identical(data.k))
        self.assertTrue(slipfront.pulse(tables, set={"friction.coefficient": 0.25, "friction.closure": "paper"}).attrs["closure"] == "paper")

    def test_numbers_of_the_theory(self):
        self.assertLess(abs(slipfront.pulse(STEP).attrs["slip_velocity_at_origin"] / 0.0482084 - 1), 1e-5)
        damped = slipfront.pulse(STEP, set={"friction.law": "viscous", "friction.coefficient": 0.5})
        self.assertLess(abs(damped.attrs["slip_at_origin"] - 0.16962), 1e-5)
        self.assertAlmostEqual(damped.attrs["damping_number"], math.pi)
        sticks = {"friction.law": "rate-and-state", "friction.strength": 0.05, "pulse.cells": 20}
        for data in (slipfront.pulse(STEP, set=sticks), slipfront.compare(STEP, set=sticks, scales=[20])):
            self.assertTrue(math.isnan(data.attrs["friction_coefficient"]) and math.isnan(data.attrs["damping_number"]))
        checked = slipfront.check(STEP, set=sticks)
        self.assertEqual((checked["friction_coefficient"], checked["friction_parameters"]["strength"]), (None, 0.05))
        chain = slipfront.chain(STEP, set={"chain.scale": 1000}, threads=1)
        self.assertLess(abs(chain.attrs["slip_at_origin"] / 0.30290 - 1), 0.01)

    def test_compare_has_the_keys_of_the_command_line(self):
        data = slipfront.compare(STEP, scales=[100, 50])
        out = json.loads(self.ok("compare", STEP, "--scale", "100", "--scale", "50", "--json"))
        self.assertEqual(list(data.name.values), [level["level"] for level in out["levels"]])
        nothing = lambda value: np.nan if value is None else value
        for level in out["levels"]:
            at = data.sel(name=level["level"]).isel(time=-1)
            for key in ("slip_at_origin", "stress_at_origin", "leading_front", "energy_dissipated", "scale", "window", "smooth_window"):
                np.testing.assert_equal(float(at[key]), nothing(level[key]), key)
            self.assertEqual(at.closure.item() or None, level["closure"])
            for key, value in level["difference"].items():
                np.testing.assert_equal(float(at.difference.sel(quantity=key)), nothing(value), key)
        for key, trend in out["trend"].items():
            for name, value in trend.items():
                np.testing.assert_equal(float(data["trend_" + name].sel(quantity=key)), nothing(value), key)
        for key in ("time", "friction_coefficient", "damping_number", "reference"):
            self.assertEqual(data.attrs[key], out[key])
        self.assertEqual(data.attrs["notes"].split("\n"), out["notes"])

    def test_check_reports_sizes_without_a_run(self):
        self.assertEqual(slipfront.check(CASE)["cells"], 400)
        self.assertGreater(slipfront.check(CASE, command="chain", set={"chain.scale": 1e4})["sites"], 1e5)
        self.assertEqual(slipfront.check(STEP, command="compare", scales=[10])["levels"], 4)

    def test_stated_errors_hold_and_a_tolerance_is_reached(self):
        """The stated error of W(0) covers the exact value. A tolerance chooses the number of cells that reaches it."""
        plain = slipfront.pulse(STEP, set={"pulse.cells": 100}).attrs
        self.assertLess(abs(plain["slip_velocity_at_origin"] - 0.0482084186), plain["slip_velocity_at_origin_error"])
        self.assertNotIn("slip_at_origin_error", slipfront.pulse(STEP, set={"pulse.cells": 100}, errors=False).attrs)
        held = slipfront.pulse(STEP, set={"pulse.cells": 100}, tolerance=2e-5).attrs
        self.assertGreater(held["cells"], 100)
        self.assertLess(held["slip_at_origin_error"], 2e-5 * held["slip_at_origin"])
        for wrong in ({"tolerance": 2}, {"tolerance": 0}, {"tolerance": "a"}, {"tolerance": 1e-3, "resume": "x.nc"}):
            with self.assertRaises(slipfront.InputError):
                slipfront.pulse(STEP, **wrong)

    def test_progress_is_reported_and_may_stop_the_run(self):
        reports = []
        slipfront.pulse(self.slow_case(), progress=lambda *at: reports.append(at))
        self.assertGreater(len(reports), 0)  # the first step is reported; how many follow depends on the machine
        done, end, steps, level = zip(*reports)
        self.assertTrue(all(a < b for a, b in zip(done, done[1:])) and all(a < b for a, b in zip(steps, steps[1:])))
        self.assertEqual((set(end), set(level)), ({2 * math.pi}, {""}))

        class Enough(Exception):
            pass

        def stop(*_):
            raise Enough("of it")

        output = os.path.join(self.folder(), "stopped.nc")
        case = self.slow_case()
        with self.assertRaises(Enough):
            slipfront.chain(case, set={"chain.scale": 1200}, output=output, progress=stop, threads=1)
        self.assertEqual(slipfront.open(output).attrs["finished"], 0)
        slipfront.chain(case, set={"chain.scale": 1200}, resume=output, threads=1)
        whole = os.path.join(self.folder(), "whole.nc")
        self.ok("chain", case, "--set", "chain.scale=1200", "--threads", "1", "-o", whole)
        self.same(output, whole)

    def test_a_finished_run_continues_to_a_later_end(self):
        for run in (slipfront.pulse, slipfront.chain):
            settings = {"domain.left": -4, "domain.right": 4, "pulse.cells": 60, "chain.scale": 100}
            output, whole = os.path.join(self.folder(), "out.nc"), os.path.join(self.folder(), "whole.nc")
            run(STEP, set={**settings, "time.end": 1}, output=output)
            continued = run(STEP, set={**settings, "time.end": 2.0}, resume=output)
            run(STEP, set={**settings, "time.end": 2.0}, output=whole)
            self.assertEqual(continued.time.values[-1], 2)
            self.same(output, whole)
            with self.assertRaisesRegex(slipfront.InputError, "earlier than the end of the file, 2;"):
                run(STEP, set={**settings, "time.end": 1.5}, resume=output)

    def test_other_threads_run_during_a_computation(self):
        """A computation releases the GIL, so Python continues while another thread computes."""
        case, rounds = self.slow_case(), 0

        def work():
            slipfront.chain(case, set={"chain.scale": 2000}, threads=1)

        thread = threading.Thread(target=work)
        thread.start()
        while thread.is_alive():
            time.sleep(0.001)
            rounds += 1
        thread.join()
        self.assertGreater(rounds, 20)  # hundreds on an idle machine; one or two if the thread held the GIL

    def test_two_threads_at_once_give_the_results_of_one(self):
        results = [None, None]

        def work(i):
            results[i] = slipfront.pulse(CASE, set={"friction.coefficient": 0.5 + i, "forcing.formula": "0.01*cos(t)"})

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i in range(2):
            alone = slipfront.pulse(CASE, set={"friction.coefficient": 0.5 + i, "forcing.formula": "0.01*cos(t)"})
            self.assertTrue(results[i].W.identical(alone.W))


if __name__ == "__main__":
    unittest.main()
