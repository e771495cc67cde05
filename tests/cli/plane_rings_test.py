"""Compares rings of dislocation lines under several laws of friction with every ring, which another program follows."""

import json
import os
import sys
import unittest

import numpy as np

from support import CommandLine, SOURCE

sys.path.insert(0, os.path.join(SOURCE, "tests/reference"))
import rings  # noqa: E402


class PlaneRings(CommandLine):
    def agrees(self, ring, settings, friction, end, probes, within):
        half = ring.r[-1] + end + 0.2
        table = self.file("rings.csv", ring.table())
        case = self.file("case.toml", f"[plane]\nleft = -{half}\nright = {half}\nbottom = -{half}\ntop = {half}\nfixed = 'x^2 + y^2 < {ring.r[0]**2}'\n"
                                      f"angles = 8\ncells = 8\n[initial]\nprofile = 'radial'\nfile = '{table}'\n")
        words = ["--set", f"time.end={end}", f"output.every={end}", f"output.probes={[[r, 0] for r in probes]}", *settings]
        out = json.loads(self.ok("plane", case, "--quiet", "--json", *words))
        slip, front = rings.follow(ring, 1000, end, probes, friction)
        for ours, theirs in [*zip(out["slip_at_probes"], slip), (out["front"], front)]:
            self.assertLess(abs(ours / theirs - 1), within, f"{ours} and {theirs}")

    def test_no_friction(self):
        self.agrees(rings.in_equilibrium(1, 2, 4), [], None, 1, [1.25, 1.65, 2.05], 0.004)

    def test_viscous(self):
        self.agrees(rings.in_equilibrium(2, 3, 9), ["friction.law=viscous", "friction.coefficient=0.2"], lambda w: 0.2 * w, 1.5, [2.3, 2.8, 3.2], 0.004)

    def test_power_law(self):
        self.agrees(rings.in_equilibrium(1, 2, 4), ["friction.law=power", "friction.coefficient=1.5", "friction.exponent=2"],
                    lambda w: 1.5 * np.abs(w) * w, 2, [1.25, 1.65, 2.05], 0.005)

    def test_strong_friction(self):
        self.agrees(rings.in_equilibrium(1, 2, 4), ["friction.law=viscous", "friction.coefficient=10"], lambda w: 10 * w, 2.5, [1.65, 2.05], 0.01)


if __name__ == "__main__":
    unittest.main()
