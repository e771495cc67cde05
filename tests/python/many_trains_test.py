"""Pulses with several trains at one position against chains of scale 4000, long after dislocations first overtake each other."""

import os
import unittest

import slipfront
import slipfront.plots
from support import SOURCE

#: Name -> (stress, ends of the domain, end of the run, trains at one position at most, largest L1 error of the slip, cells).
PROFILES = {
    "one fall": ("0.4 + 0.63 * (1 - tanh(x / 0.3)) / 2", -4, 4, 4, 2, 0.005, 400),
    "two falls": ("0.3 + 0.35 * (1 - tanh((x + 0.5) / 0.15)) / 2 + 0.4 * (1 - tanh((x - 0.3) / 0.15)) / 2", -4, 3, 5, 3, 0.005, 400),
    "hump": ("0.5 + 0.6 * exp(-(x / 0.4)^2)", -3, 3, 3, 2, 0.005, 400),
    "dip": ("1.1 - 0.6 * exp(-(x / 0.4)^2)", -4, 4, 3, 3, 0.005, 400),
    "waves": ("0.8 + 0.3 * cos(4 * x) * exp(-(x / 1.5)^2)", -5, 5, 3, 2, 0.005, 800),
    # docs/pulse.md lists these as wrong with one train: 10 % and 5 %.
    "gap": ("abs(x) < 0.3 ? 0 : 0.8", -8, 8, 12, 2, 0.005, 400),
    "step": ("x < 0 ? 0.855 : 0.179", -2.6, 0.9, 6.283185307179586, 2, 0.005, 400),
}


def error(pulse, chain):
    """Sum of the differences of the slip at the end over the sum of the chain's slip."""
    slip, reference = pulse["slip"].isel(time=-1), chain["slip"].isel(time=-1)
    return float(abs(slip - reference).sum() / abs(reference).sum())


class ManyTrains(unittest.TestCase):
    def test_slip_is_that_of_the_chain(self):
        for name, (formula, left, right, end, trains, most, cells) in PROFILES.items():
            with self.subTest(name):
                scenario = {"initial": {"profile": "formula", "formula": formula}, "domain": {"left": left, "right": right}, "time": {"end": end},
                            "pulse": {"trains": "many", "cells": cells}, "chain": {"scale": 4000}}
                pulse = slipfront.pulse(scenario, errors=False)
                off = error(pulse, slipfront.chain(scenario))
                print(f"{name}: L1 {100 * off:.3f} %, {pulse.attrs['solve_seconds']:.2f} s")
                self.assertLess(off, most)
                self.assertEqual(int(pulse["trains"].isel(time=-1).max()), trains)

    def test_slip_under_viscous_friction_is_that_of_the_chain(self):
        for coefficient, end in ((0.05, 4), (0.1, 4), (0.2, 4), (0.2, 8), (0.5, 4), (0.5, 8), (1, 10), (0.5, 20)):
            with self.subTest(coefficient=coefficient, end=end):
                scenario = {"initial": {"profile": "formula", "formula": PROFILES["one fall"][0]}, "friction": {"law": "viscous", "coefficient": coefficient},
                            "domain": {"left": -max(5, 1.2 * end), "right": max(5, 1.2 * end)}, "time": {"end": end}, "chain": {"scale": 2000 if end < 10 else 1000}}
                chain = slipfront.chain(scenario)
                one, many = (error(slipfront.pulse(scenario, errors=False, set={"pulse.trains": trains}), chain) for trains in ("one", "many"))
                print(f"C = {coefficient}, t = {end}: L1 {100 * one:.2f} % with one train, {100 * many:.2f} % with two")
                self.assertLess(many, 0.005)
                self.assertLess(many, one)

    def test_waves_where_a_gap_closes_vanish_with_the_scale(self):
        case = os.path.join(SOURCE, "cases/shock.toml")
        exact = slipfront.pulse(case, errors=False, set={"pulse.trains": "many", "pulse.cells": 400}).isel(time=-1)
        zone = (exact.x / exact.time > -0.17) & (exact.x / exact.time < -0.1)
        waves = {}
        for scale in (1000, 4000):
            chain = slipfront.chain(case, set={"chain.scale": scale}).isel(time=-1)
            waves[scale] = float(((chain.W - exact.W)[zone] ** 2).mean() ** 0.5)
        print("waves where a gap closes:", waves)
        self.assertLess(waves[1000], 0.03 * float(exact.W[zone].mean()))
        self.assertLess(waves[4000], 0.8 * waves[1000])

    def test_energy_of_the_gap_is_kept(self):
        case = {"initial": {"profile": "formula", "formula": "abs(x) < 0.3 ? 0 : 0.8"}, "domain": {"left": -8, "right": 8}, "time": {"end": 12}}
        lost = [slipfront.pulse(case, errors=False, set={"pulse.trains": trains})["energy_residual"].values[-1] for trains in ("one", "many")]
        self.assertLess(abs(lost[1]), 0.1 * lost[0])

    def test_case_is_drawn_with_its_trains(self):
        data = slipfront.pulse(os.path.join(SOURCE, "cases/overtaking.toml"), errors=False, set={"pulse.cells": 100})
        self.assertEqual(data["trains"].dims, ("time", "x"))
        self.assertEqual(int(data["trains"].max()), 3)
        self.assertEqual(int(data["trains"][0].max()), 1)
        outlined = slipfront.plots.space_time(data)
        plain = slipfront.plots.space_time(data.drop_vars("trains"))
        self.assertGreater(len(outlined.axes[0].collections), len(plain.axes[0].collections))


if __name__ == "__main__":
    unittest.main()
