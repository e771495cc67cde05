#!/usr/bin/env python3
"""Tests a laboratory block in SI units against the numbers of tests/reference/laboratory_block.py, and its outputs."""

import json
import os
import unittest

import netCDF4
from support import SOURCE, CommandLine

BLOCK = os.path.join(SOURCE, "cases/laboratory-block.toml")
PERIOD, PEAK = 33.0761, 0.17383  # s and m/s, by Radau at a tolerance of 1e-9


class LaboratoryBlock(CommandLine):
    def test_agrees_with_an_independent_integration(self):
        out = json.loads(self.ok("chain", BLOCK, "--json", "--set", "output.every=100 s"))
        last, before = out["events"][-1], out["events"][-2]
        self.assertEqual(out["event_count"], 6)
        self.assertLess(abs((last["onset"] - before["onset"]) / PERIOD - 1), 1e-3)
        self.assertLess(abs(last["peak_velocity"] / PEAK - 1), 1e-3)
        self.assertLess(abs(out["event_median_peak_velocity"] / PEAK - 1), 5e-3)
        self.assertLess(abs(out["event_recurrence_time"] / PERIOD - 1), 5e-3)

    def test_has_further_outputs_in_events(self):
        file = self.file("block.nc", "")
        out = json.loads(self.ok("chain", BLOCK, "--json", "-o", file, "--set", "output.every=15 s", "output.per_event=20"))
        with netCDF4.Dataset(file) as data:
            times = data["time"][:].filled().tolist()
        for event in out["events"]:
            end = event["onset"] + event["duration"]
            within = sum(event["onset"] <= time <= end for time in times)
            self.assertTrue(20 <= within <= 41, f"{within} outputs in the event at {event['onset']}")
        whole = 2 + int(out["time"] / 15)
        self.assertLess(len(times), whole + 41 * len(out["events"]))


if __name__ == "__main__":
    unittest.main()
