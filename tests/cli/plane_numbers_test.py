"""Results of `slipfront plane` against simulations of every line, symmetries, and a finite-fault model."""

import os
import unittest

import netCDF4
import numpy as np

from plane_test import FRICTION, PlaneCommand
from support import SOURCE


class PlaneNumbers(PlaneCommand):
    def test_friction_on_one_side_turns_the_rupture_to_the_other(self):
        """The reference is a direct simulation of every line at scale 160."""
        out = self.plane(FRICTION)
        for slip, reference in zip(out["slip_at_probes"], [0.17662, 0.23793, 0.30931, 0.17312, 0.2655]):
            self.assertLess(abs(slip / reference - 1), 0.02)
        self.assertLess(abs(out["potency"] / 3.1787 - 1), 0.01)

    def test_a_ratio_of_wave_speeds_stretches_the_rupture(self):
        """With half the wave speed along y, the same loops are ellipses: all values follow from those of the round ones."""
        case = self.file("case.toml", "[plane]\nleft = -3.2\nright = 3.2\nbottom = -3.2\ntop = 3.2\n[initial]\nprofile = 'formula'\n"
                                      "formula = 0\n[time]\nend = 0.5\n")
        common = ("--set", "plane.fixed=sqrt(x^2 + (y/R)^2) < 1", "output.probes=[[1.5, 0], [0, S]]",
                  "initial.formula=2 * max(0, 2 - max(1, sqrt(x^2 + (y/R)^2)))")

        def values(ratio):
            settings = [word.replace("R", str(ratio)).replace("S", str(1.5 * ratio)) for word in common]
            return self.plane(case, *settings, f"plane.wave_speed_ratio={ratio}", f"plane.bottom={-3.2 * ratio}",
                              f"plane.top={3.2 * ratio}")
        round_one, flat = values(1), values(0.5)
        self.assertAlmostEqual(round_one["slip_at_probes"][0], flat["slip_at_probes"][0], delta=1e-9)
        self.assertAlmostEqual(flat["slip_at_probes"][0], flat["slip_at_probes"][1], delta=1e-3)
        self.assertAlmostEqual(flat["potency"], round_one["potency"] / 2, delta=1e-9)
        self.assertAlmostEqual(round_one["front"], flat["front"], delta=1e-9)

    def test_lines_and_averages_have_the_same_rupture_from_a_patch(self):
        case = os.path.join(SOURCE, "cases/plane-nucleation.toml")
        folder, out, maps = self.folder(), {}, {}
        for name, more in (("averaged", []), ("direct", ["--direct"])):
            path = os.path.join(folder, name + ".nc")
            out[name] = self.plane(case, *more, "--set", "plane.cells=80", "time.end=1", "-o", path)
            with netCDF4.Dataset(path) as file:
                maps[name] = np.ma.filled(file["rupture_time"][:], np.nan)
                x, y = np.meshgrid(file["x"][:], file["y"][:])
                slip = np.array(file["slip"][-1])
        # Slip lowers the mean slip U here, and stays within 1.2 of the patch and outside the held disc.
        self.assertLess(slip.min(), -0.5)
        for name, rupture in maps.items():
            reached = ~np.isnan(rupture)
            self.assertTrue(np.all(reached[np.hypot(x - 1.5, y) < 0.5]), name)
            self.assertFalse(np.any(reached[(np.hypot(x - 1.5, y) > 1.2) | (np.hypot(x, y) < 0.6)]), name)
            self.assertAlmostEqual(out[name]["ruptured_area"], np.count_nonzero(reached) * 0.1 ** 2)
            self.assertAlmostEqual(out[name]["front"], np.hypot(x, y)[reached].max())
        # A cell of the averages ruptures at a smaller slip than half a line of the 40.
        self.assertLess(abs(out["averaged"]["ruptured_area"] / out["direct"]["ruptured_area"] - 1), 0.25)
        self.assertLess(abs(out["averaged"]["front"] - out["direct"]["front"]), 0.1)
        self.assertLess(out["averaged"]["errors"]["front"], 0.3)

    def test_a_finite_fault_model_ruptures(self):
        model = os.path.join(SOURCE, "cases/synthetic-fault.fsp")
        path = os.path.join(self.folder(), "out.nc")
        out = self.plane(model, "--set", "chain.scale=0.5", "-o", path)
        self.assertEqual(out["unit_system"], "SI")
        theirs = out["model"]
        self.assertLess(abs(out["moment"] / theirs["moment"] - 1), 0.2)
        self.assertGreater(theirs["reached"], 0.9 * theirs["subfaults"])
        self.assertTrue(0.3 < theirs["rupture_time_ratio"] < 1.5)
        with netCDF4.Dataset(path) as file:
            self.assertIn("synthetic-fault.fsp", file.getncattr("scenario"))
        broken = self.file("broken.fsp", "% no model\n")
        self.refused(2, "plane", broken, says=["broken.fsp"])


if __name__ == "__main__":
    unittest.main()
