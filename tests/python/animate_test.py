"""slipfront animate: dislocations where the field has them, files that play, what is refused."""

import json
import os
import shutil
import unittest
import unittest.mock

import numpy as np
from PIL import Image

from commands import PythonCommands, run_here
import slipfront
from slipfront import cmd_animate
from slipfront.plots.animation import Scene
from slipfront.plots.animation import positions
from slipfront.plots.plane_animation import PlaneScene
from support import SOURCE, run

STEP = os.path.join(SOURCE, "cases/step.toml")


class Positions(unittest.TestCase):
    def test_rest_is_evenly_spaced(self):
        places = positions(slipfront.pulse(STEP), 100)[0]
        np.testing.assert_allclose(np.diff(places)[:-3], 2 * np.pi / (0.855 * 100), rtol=1e-6)
        self.assertLess(places[-1], 0)

    def test_passed_dislocations_are_the_slip(self):
        pulse, scale = slipfront.pulse(STEP), 2000
        places = positions(pulse, scale)
        passed = (places[-1] > 0).sum() - (places[0] > 0).sum()
        self.assertLess(abs(passed - scale * float(pulse["slip_at_origin"][-1]) / (2 * np.pi)), 1.5)

    def test_first_moves_with_the_leading_edge(self):
        pulse = slipfront.pulse(STEP)
        self.assertLess(abs(np.nanmax(positions(pulse, 5000)[-1]) - float(pulse["leading_front"][-1])), 0.01)


class Animate(PythonCommands):
    def test_plays(self):
        folder = os.path.dirname(self.file("x", ""))
        source = os.path.join(folder, "p.nc")
        self.ok("pulse", STEP, "-o", source, "--set", "output.every=1.5")
        for ending, command in (("gif", run), ("webp", run_here)):  # the first one starts the program
            out = os.path.join(folder, f"a.{ending}")
            said = json.loads(command("animate", source, "-o", out, "--json").stdout)
            with Image.open(out) as picture:
                self.assertEqual(picture.n_frames, said["frames"])
                self.assertEqual(picture.n_frames, slipfront.open(source).sizes["time"])
                first = np.asarray(picture.convert("RGB"))
                picture.seek(picture.n_frames - 1)
                self.assertGreater((first != np.asarray(picture.convert("RGB"))).mean(), 1e-3)  # it moves
        if shutil.which("ffmpeg"):
            out = os.path.join(folder, "a.mp4")
            self.ok("animate", source, "-o", out)
            with open(out, "rb") as file:
                self.assertEqual(file.read(12)[4:8], b"ftyp")
        self.assertEqual([name for name in os.listdir(folder) if name.startswith(".")], [])

    def test_knows_models_by_their_content(self):
        for model in ("subfaults.srf", "subfaults.param", "subfaults.geojson"):
            with open(os.path.join(SOURCE, "tests/data", model), encoding="utf-8") as file:
                named = self.file(f"{model}.txt", file.read())
            with unittest.mock.patch.object(cmd_animate, "run", side_effect=ValueError("run")):
                self.assertRaisesRegex(ValueError, "^run$", cmd_animate.content_to_show, named)
        self.refused(2, "animate", self.file("row.txt", "name,slip\na,1\n"), "-o", "a.gif", says=["neither NetCDF nor CSV"])

    def test_side_by_side_with_scales_in_si(self):
        pulses = [slipfront.pulse(STEP, set={"output.every": 1.5, "friction.law": "viscous", "friction.coefficient": c}) for c in (0, 0.5)]
        si = slipfront.medium.units(30e9, 5421.0, 0.003, 0.01)
        scene = Scene(pulses, si)
        scene.show(2)
        without, with_friction = scene.columns
        heights = [column.lines[0].get_ydata().max() for column in (without, with_friction)]
        self.assertLess(heights[1], 0.8 * heights[0])
        for column, pulse in zip(scene.columns, pulses):
            names = {text.get_text().strip(): text.get_position()[0] for _, _, _, text in column.fronts}
            self.assertEqual(names, {"V−": float(pulse["trailing_front"][2]), "V+": float(pulse["leading_front"][2])})
        right = scene.panels[0, 1].child_axes[0]
        self.assertEqual(right.get_ylabel(), "m/s")
        scene.figure.canvas.draw()
        self.assertAlmostEqual(right.get_ylim()[1], scene.panels[0, 1].get_ylim()[1] * 5421 * 0.003 / np.pi, delta=1e-6)
        self.assertIn("1.84 ms", scene.clock.get_text())  # 3 b / (c A) of b / (c A) = 0.01 m / (5421 m/s 0.003)
        with self.assertRaisesRegex(ValueError, "different output times"):
            Scene([pulses[0], slipfront.pulse(STEP, set={"output.every": 1})])

    def test_ruptures_on_a_plane_side_by_side(self):
        rings = os.path.join(SOURCE, "cases/plane-rings.toml")
        settings = {"plane.loops": 40, "plane.cells": 40, "time.end": 1, "output.every": 0.25, "output.lines": True, "chain.scale": 10}
        averaged, direct = (slipfront.plane(rings, set=settings, direct=by_line, errors=False) for by_line in (False, True))
        scene = PlaneScene([averaged, direct])
        first, last = scene.show(0), scene.show(4)
        self.assertGreater((first != last).mean(), 1e-2)
        self.assertIn("t = 1", scene.clock.get_text())
        lines = scene.maps[1].lines.get_xdata()
        self.assertGreater(np.isnan(lines).sum(), np.isnan(scene.maps[0].lines.get_xdata()).sum())
        distance = np.hypot(*(scene.maps[0].lines.get_data()))
        self.assertAlmostEqual(np.nanmax(distance), float(averaged["front"][-1]), delta=1e-3)
        with self.assertRaisesRegex(ValueError, "different output times"):
            PlaneScene([averaged, averaged.isel(time=slice(2))])

    def test_a_scenario_on_a_plane_runs_first(self):
        folder = os.path.dirname(self.file("x", ""))
        case = self.file("rings.toml", "[plane]\nleft = -3.2\nright = 3.2\nbottom = -3.2\ntop = 3.2\ncells = 40\nfixed = 'sqrt(x^2 + y^2) < 1'\n"
                                       "[initial]\nprofile = 'formula'\nformula = '2 * max(0, 2 - max(1, sqrt(x^2 + y^2)))'\n"
                                       "[chain]\nscale = 10\n[time]\nend = 0.5\n[output]\ntimes = [0.25]\n")
        for options in ([], ["--direct"]):
            out = os.path.join(folder, "a.gif")
            said = json.loads(self.ok("animate", case, "-o", out, "--json", *options))
            self.assertEqual(said["frames"], 3)
        self.refused(2, "animate", case, STEP, "-o", out, says=["some are on a plane"])
        self.refused(2, "animate", STEP, "--direct", "-o", out, says=["--direct", "plane"])

    def test_refuses(self):
        table = self.file("r.csv", self.ok("relations", "--stress", "1", "--csv"))
        out = os.path.join(os.path.dirname(table), "a.gif")
        self.refused(2, "animate", table, "-o", out, says=["no pulse"])
        self.refused(2, "animate", STEP, says=["-o"])
        self.refused(2, "animate", STEP, "-o", out, "--contact-ratio", "0.003", says=["--asperity-spacing", "both"])
        self.refused(2, "animate", STEP, "-o", "a.png", says=["'.png'", "gif, webp, mp4"])
        self.refused(3, "animate", "/nowhere.toml", "-o", out, says=["nowhere.toml"])
        self.refused(2, "animate", self.file("bad.toml", "title = 3"), "-o", out, says=["title"])
        self.refused(3, "animate", STEP, "-o", "/nowhere/a.gif", says=["/nowhere/a.gif"])


if __name__ == "__main__":
    unittest.main()
