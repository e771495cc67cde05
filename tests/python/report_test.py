"""Checks report.html: one self-contained, well formed file with the command of each figure, and the values that it shows under the cursor."""

import pathlib
import re
import tempfile
import unittest

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from page import Page
from slipfront.plots.style import styled
from slipfront.reproduce import outputs, report, report_hover
from slipfront.reproduce.picture import Picture

NUMBER = {"what": "a number " * 8, "where": "4, Fig. 5", "unit": "c", "printed": "0.5", "computed": 0.51, "printed_digits": "0.5", "difference": 0.02,
          "verdict": "same", "remark": "why " * 20}
FORMULA = {"where": "Eq. 1", "printed": "u < 1 & more", "mended": "2 u", "check": "slip", "by_printed": 0.5, "by_mended": None}
STATEMENT = {"statement": "V- does not depend on friction", "where": "1", "verdict": "Refuted", "found": "it does", "range": "C = 0 to 2", "command": "slipfront compare a.toml"}
LEVEL = {"friction_coefficient": 0.5, "damping_number": 3.14, "closed_form": None, "consistent": 0.1696, "chain": 0.1691, "paper": 0.2191, "consistent_off": 0.003, "paper_off": 0.3}
TABLES = {"numbers": [NUMBER, NUMBER | {"verdict": "the paper is wrong"}], "formulas": [FORMULA], "statements": [STATEMENT], "inputs": [{"what": "C", "where": "3.2", "printed": "0.1"}]}
ABOUT = {"version": "0", "seconds": 1.0, "pulses": 2,
         "levels": {"rows": [LEVEL], "scale": 1000, "worst": 0.003, "paper": 0.3, "command": "slipfront compare cases/step.toml"}}


@styled
def drawn(name) -> Picture:
    """A figure with a line on logarithmic axes and a map of x + 10 t."""
    figure = Figure(figsize=(6, 3))
    left, right = figure.subplots(1, 2)
    left.loglog([1, 10, 100], [2, 20, 200], label="twice")
    left.axvline(3)
    left.set(xlabel="stress", ylabel="velocity")
    x, t = np.linspace(0, 1, 11), np.linspace(0, 2, 21)
    right.pcolormesh(x, t, ((x[1:] + x[:-1]) / 2)[None, :] + 10 * ((t[1:] + t[:-1]) / 2)[:, None])
    right.set(xlabel="x", ylabel="t")
    return Picture(name, "A & B", "caption of " + name, figure, xr.Dataset({"y": ("x", [1.0, 2.0])}), command=f"slipfront draw {name}", printed=[("slope", "2.1", 2.0)])


@styled
def solid(name) -> Picture:
    """A figure with the surface x t in space."""
    figure = Figure(figsize=(4, 4), layout="none")
    axes = figure.add_subplot(projection="3d")
    x, t = np.meshgrid(np.linspace(0, 1, 12), np.linspace(0, 2, 12))
    axes.plot_surface(x, t, x * t, rcount=12, ccount=12)
    axes.set(xlabel="x", ylabel="t")
    return Picture(name, "A solid", "caption", figure, xr.Dataset({"y": ("x", [1.0, 2.0])}), command="slipfront draw")


class Drawn(unittest.TestCase):
    """A page of two figures."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.pictures = [drawn("fig-04"), drawn("fig-05")]
        for picture in cls.pictures:
            outputs.write_picture(cls.folder, picture)
        cls.text = report.page(cls.folder, cls.pictures, TABLES, ABOUT)
        cls.page = Page(cls.text)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def axes_in_page(self, picture):
        """The data on the axes of a figure that the page has."""
        return report_hover.axes_of(picture.figure, (self.folder / f"{picture.name}.svg").read_text(encoding="utf-8"))


class Report(Drawn):
    def test_is_well_formed(self):
        self.assertEqual(self.page.errors, [])

    def test_needs_no_other_file_and_no_network(self):
        self.assertEqual(self.page.loads, [])
        self.assertIn("https://doi.org/10.3390/lubricants3020311", self.page.links)
        self.assertFalse("@import" in self.text)
        self.assertEqual([use for use in re.findall(r"url\(([^)]*)\)", self.text) if not use.startswith("#")], [])
        self.assertEqual([word for word in ("fetch(", "XMLHttpRequest", "import(", "http:") if word in report.HERE.joinpath("report.js").read_text(encoding="utf-8")], [])

    def test_every_figure_is_in_the_contents_and_has_its_command(self):
        for picture in self.pictures:
            self.assertEqual(self.page.figures[picture.name], [picture.command])
            self.assertIn("#" + picture.name, self.page.links)
        for name, _ in report.SECTIONS:
            self.assertIn("#" + name, self.page.links)

    def test_has_printed_and_computed_values(self):
        self.assertTrue(re.search(r"slope</td><td[^>]*>2\.1</td><td[^>]*>2</td>", self.text))
        self.assertTrue("2 printed numbers. Same: 1; the paper is wrong: 1." in self.text)
        self.assertTrue('class=bad data-name="verdict">Refuted' in self.text)
        self.assertTrue("u &lt; 1 &amp; more" in self.text)

    def test_surfaces_in_space_have_values(self):
        picture = solid("fig-07")
        outputs.write_picture(self.folder, picture)
        (axes,) = self.axes_in_page(picture)
        surface = axes["surface"]
        np.testing.assert_allclose(surface["z"], np.array(surface["x"]) * surface["y"], atol=1e-4)
        self.assertEqual([axes[name]["name"] for name in "xyz"], ["x", "t", "value"])
        highest, lowest = np.argmax(surface["z"]), np.argmin(surface["z"])
        self.assertLess(surface["top"][highest], surface["top"][lowest])  # drawn higher up
        self.assertTrue(all(0 < share < 1 for side in ("left", "top") for share in surface[side]))

    def test_values_under_the_cursor_are_those_drawn(self):
        lines, map_ = self.axes_in_page(self.pictures[0])
        self.assertEqual(lines["lines"], [{"name": "twice", "x": [1, 10, 100], "y": [2, 20, 200]}])  # without the vertical rule
        self.assertTrue(lines["x"]["log"] and lines["y"]["log"])
        self.assertEqual((lines["x"]["name"], map_["y"]["name"]), ("stress", "t"))
        at = map_["map"]
        np.testing.assert_allclose(np.reshape(at["z"], (len(at["y"]), len(at["x"]))), np.array(at["x"]) + 10 * np.array(at["y"])[:, None], rtol=1e-4)
        self.assertTrue(all(0 < share < 1 for share in lines["box"]))


if __name__ == "__main__":
    unittest.main()
