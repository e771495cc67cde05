"""slipfront plot and slipfront.plots: the kinds of figures for each Dataset, labels with units, and refused input."""

import json
import os
import tempfile
import unittest

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from commands import PythonCommands
import slipfront
from slipfront import plots
from slipfront.plots import choose, files
from slipfront.plots.space_time import between
from slipfront.plots.pulse_parts import title_of
from slipfront.plots.style import label, plain_numbers, prefix_axes
from support import SOURCE

CASE = os.path.join(SOURCE, "cases/fig-08.toml")
STEP = os.path.join(SOURCE, "cases/step.toml")
PLANE = os.path.join(SOURCE, "cases/plane-friction.toml")


def samples(count=200):
    chance = np.random.default_rng(5)
    return xr.Dataset({"stress": ("sample", 1 + 0.1 * chance.normal(size=count)), "damping_number": ("sample", np.exp(chance.normal(size=count)))})


class Figures(PythonCommands):
    def labels(self, figure):
        """The texts on the axes. Every axes must have a label, or share one with axes next to it."""
        shown = [axes for axes in figure.axes if axes.axison]
        for axes in shown:
            siblings = axes.get_shared_x_axes().get_siblings(axes)
            self.assertTrue(any(other.get_xlabel() for other in siblings), axes)
        return [axes.get_xlabel() for axes in shown] + [axes.get_ylabel() for axes in shown]

    def test_pulse(self):
        pulse = slipfront.pulse(CASE)
        figure = plots.profiles(pulse)
        texts = self.labels(figure)
        self.assertIn("slip velocity W, cA/π", texts)
        self.assertIn("position x, b/A", texts)
        # The last line of the first panel is the slip velocity at the end.
        np.testing.assert_array_equal(figure.axes[0].lines[-1].get_ydata(), pulse["W"][-1])
        figure = plots.space_time(pulse)
        lines = {line.get_label(): line for line in figure.axes[0].lines}
        np.testing.assert_array_equal(lines["trailing edge, fast (V−)"].get_xdata(), pulse["trailing_front"])
        np.testing.assert_array_equal(lines["trailing edge, fast (V−)"].get_ydata(), pulse["time"])
        for axes in figure.axes[:2]:
            self.assertEqual({text.get_text(): text.get_ha() for text in axes.texts}, {"V−": "left", "V+": "right"})  # not on the dotted lines

    def test_a_map_follows_the_fronts_between_outputs(self):
        """Without friction the fields depend only on x / t, so the values between two outputs are known."""
        pulse = slipfront.pulse(STEP, set={"output.every": 1.5})
        times, positions = np.array([2.25, 3.75, 5.0]), np.linspace(-1.5, 0.4, 40)
        values = between(pulse, "W", times, positions)
        last = pulse.isel(time=-1)
        for time, row in zip(times, values):
            exact = np.interp(positions * float(last["time"]) / time, last["x"], last["W"])
            self.assertLess(np.abs(row - exact).max(), 0.03 * float(last["W"].max()))
        np.testing.assert_allclose(between(pulse, "W", pulse["time"].values, pulse["x"].values)[:-1], pulse["W"][:-1], atol=1e-12)

    def test_a_bad_cell_affects_no_other_cell(self):
        pulse = slipfront.pulse(CASE)
        whole = pulse.copy(deep=True)
        pulse["W"][8, 200], pulse["W"][4, 220] = np.nan, 1e9
        highest = float(whole["W"].max())
        mesh = plots.space_time(pulse).axes[0].collections[0]
        self.assertLessEqual(mesh.get_clim()[1], highest)
        image, sound = (plots.space_time(data).axes[0].collections[0].get_array() for data in (pulse, whole))
        self.assertLess(np.ma.count_masked(image) / image.size, 5e-3)
        self.assertGreater(np.ma.count_masked(image), 0)
        self.assertLess((np.abs(np.ma.filled(image, np.inf) - sound) > 1e-9).mean(), 0.01)
        self.assertLess(plots.profiles(pulse).axes[0].get_ylim()[1], 1.2 * highest)

    def test_paths(self):
        settings = {"chain.scale": 30, "chain.spacing": 0.2, "domain.left": -2, "domain.right": 2, "time.end": 1.5, "output.every": 0.25,
                    "output.dislocations": True, "output.displacement": True}
        chain = slipfront.chain(STEP, set=settings)
        position, level = chain["dislocation_position"], chain["dislocation_level"]
        self.assertEqual(chain.sizes["dislocation"], chain.attrs["dislocations"])
        self.assertTrue((position.diff("time") >= 0).all() or (position.diff("time").max() > 0.01))
        np.testing.assert_array_equal(level, np.broadcast_to(level[0], level.shape))
        # At the position of a dislocation, u passes (2 n + 1) pi.
        for time in (0, -1):
            u = np.interp(position[time], chain["site"], chain["displacement"][time]) * 30
            np.testing.assert_allclose(u, (2 * level[time] + 1) * np.pi, atol=0.05)
        self.assertEqual(choose.kinds_of(chain), ["space-time", "profiles", "paths"])
        line = plots.paths(chain).axes[0].lines[0]
        drawn = line.get_xdata()
        np.testing.assert_array_equal(drawn[np.isfinite(drawn)], position.transpose("dislocation", "time").values.ravel())
        # With antidislocations there are two colours and a legend, and a gap in a path is bridged.
        chain["dislocation_sign"][1] = -1
        position[2, 0] = np.nan
        figure = plots.paths(chain)
        self.assertEqual(len(figure.legends), 1)
        self.assertEqual(int(np.isfinite(figure.axes[0].lines[0].get_xdata()).sum()), position.size - 1 - chain.sizes["time"])

    def test_slip_backward_is_explained(self):
        hill = {"initial": {"profile": "formula", "formula": "0.3 + 0.5*exp(-x^2)"}, "domain": {"left": -6, "right": 6}, "time": {"end": 2}}
        backward = "below 0: slips backward, where stress rises with x"
        self.assertIn(backward, [text.get_text() for text in plots.profiles(slipfront.pulse(hill)).axes[0].texts])
        self.assertNotIn(backward, [text.get_text() for text in plots.profiles(slipfront.pulse(STEP)).axes[0].texts])

    def test_si_units_are_on_the_axes(self):
        rock = {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s", "poisson_ratio": 0.3}
        metric = slipfront.compare(STEP, scales=[50]).slipfront.si(contact_ratio=0.01, spacing="1 mm", medium=rock)
        figure = plots.comparison(metric)
        self.assertIn("slip velocity W, mm s⁻¹", self.labels(figure))
        self.assertRegex(figure.get_suptitle() if hasattr(figure, "get_suptitle") else figure._suptitle.get_text(), r"t = \S+ μs$")

    def test_titles_are_one_line_with_the_settings_that_fit(self):
        settings = ", ".join(f"initial.width={i}" for i in range(9))
        self.assertEqual(title_of(xr.Dataset(attrs={"title": "A run"})), "A run")
        title = title_of(xr.Dataset(attrs={"title": f"A run\n(with {settings})"}))
        self.assertEqual(title, "A run (with initial.width=0, initial.width=1, initial.width=2, …)")
        self.assertEqual(len(title_of(xr.Dataset(attrs={"title": "x" * 200}))), 76)

    def test_rounding_is_not_drawn(self):
        pulse = slipfront.pulse(STEP).copy(deep=True)
        pulse["Sigma"][:] = 0.5 * (1 + 1e-14 * np.arange(pulse.sizes["x"]))
        low, high = plots.profiles(pulse).axes[1].get_ylim()
        self.assertGreater(high - low, 0.05)
        self.assertEqual(plots.space_time(pulse).axes[1].collections[0].get_clim()[0], 0)
        pulse["Sigma"][:] = 1e-9
        pulse["Sigma"].attrs["units"] = "Pa"
        self.assertIn("zero", [text.get_text() for text in plots.profiles(pulse).axes[1].texts])

    def test_a_logarithmic_axis_has_a_prefix(self):
        figure = Figure()
        axes = figure.subplots()
        axes.set(xscale="log", yscale="log", xlim=(2e6, 8e7), ylim=(1, 2), xlabel="stress, Pa", ylabel="slip, m")
        plain_numbers(axes.xaxis)
        prefix_axes(figure)
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("stress, MPa", "slip, m"))
        shown = [text.get_text() for text in axes.get_xticklabels() if text.get_text()]
        self.assertIn("10", shown)
        self.assertFalse([text for text in shown if "e+" in text])

    def test_the_observed_front_of_a_chain_does_not_turn_back(self):
        chain = slipfront.chain(os.path.join(SOURCE, "cases/step-viscous.toml"), set={"chain.scale": 60, "output.every": 0.2})
        jumping = np.diff(chain["trailing_front_observed"].dropna("time"))
        self.assertTrue((jumping > 0).any() and (jumping < 0).any())
        lines = [line for line in plots.space_time(chain).axes[0].lines if line.get_linestyle() == ":"]
        for line, sign in zip(lines, (-1, 1)):
            steps = np.diff(line.get_xdata()[np.isfinite(line.get_xdata())])
            self.assertTrue((sign * steps >= 0).all())

    def test_a_rupture_on_a_plane_has_its_spectrum(self):
        x = np.linspace(-1, 1, 8)
        maps = {name: (("time", "y", "x"), np.ones((2, 8, 8))) for name in ("slip", "slip_velocity")}
        series = {"moment_rate": ("series_time", [0.0, 1.0]), "moment_rate_spectrum": ("frequency", [4.0, 2.0, 1.0])}
        axes = {"time": [0, 1], "x": x, "y": x, "series_time": [0, 1], "frequency": [0.0, 1.0, 2.0]}
        rupture = xr.Dataset({**maps, **series, "rupture_time": (("y", "x"), np.hypot(*np.meshgrid(x, x)))}, axes)
        spectrum = plots.plane(rupture).axes[-1]
        self.assertEqual((spectrum.get_xscale(), spectrum.get_yscale()), ("log", "log"))
        np.testing.assert_array_equal(spectrum.lines[0].get_xydata(), [[1, 2], [2, 1]])
        self.assertEqual(len(plots.plane(rupture.drop_dims("frequency")).axes), 7)

    def test_maps_of_a_plane_have_one_axis_of_y(self):
        x = np.linspace(-1e4, 1e4, 12)
        fields = {name: (("time", "y", "x"), np.ones((1, 12, 12))) for name in ("slip", "slip_velocity")}
        rupture = xr.Dataset({**fields, "rupture_time": (("y", "x"), np.ones((12, 12))), "moment_rate": ("series_time", [0.0, 1.0])},
                             {"time": [0.0], "x": ("x", x, {"units": "m"}), "y": ("y", x, {"units": "m"}), "series_time": [0.0, 1.0]})
        figure = plots.plane(rupture)
        prefix_axes(figure)
        figure.canvas.draw()
        first, *others = figure.axes[:3]
        self.assertIn("km", first.get_ylabel())
        self.assertIn("\N{MINUS SIGN}5", [tick.get_text() for tick in first.get_yticklabels()])
        for axes in others:
            self.assertEqual(axes.get_ylim(), first.get_ylim())
            self.assertFalse(any(tick.label1.get_visible() for tick in axes.yaxis.get_major_ticks()))

    def test_fault(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "grid.nc")
            self.ok("event", os.path.join(SOURCE, "cases/synthetic-fault.fsp"), "--fault-grid", "-o", path, "--quiet")
            with xr.open_dataset(path) as grid:
                self.assertEqual(choose.kinds_of(grid), ["fault"])
                axes = plots.fault(grid).axes
                for panel, name in zip(axes, ("slip", "rupture_time", "rise_time", "stress_drop")):
                    np.testing.assert_array_equal(panel.collections[0].get_array().ravel(), grid[name].isel(segment=0).values.ravel())
                self.assertEqual(axes[2].get_xlabel(), "position along strike, km")
                self.assertIn("static stress drop, MPa", [panel.get_xlabel() for panel in axes])

    def test_sweep(self):
        tables = {"set": {"friction.law": "viscous", "pulse.cells": 40}, "variables": ["slip_velocity_at_origin", "slip_at_origin"]}
        data = slipfront.sweep(STEP, {"friction.coefficient": [2, 0.1, 1], "initial.stress_left": [0.8, 0.9]}, **tables)
        figure = plots.sweep(data)
        self.assertEqual(figure.axes[0].get_xlabel(), "initial stress left, μA/π")
        np.testing.assert_array_equal(figure.axes[0].collections[0].get_array().ravel(), data.slip_velocity_at_origin.sortby("friction_coefficient").values.ravel())
        line = plots.sweep(data.isel(initial_stress_left=0), "slip_at_origin").axes[0]
        np.testing.assert_array_equal(line.lines[0].get_xdata(), [0.1, 1, 2])
        self.assertEqual(line.get_ylabel(), "slip u at x = 0, b/(2π)")
        closures = slipfront.sweep(STEP, {"friction.coefficient": [0.1, 1], "friction.closure": ["paper", "consistent"]}, **tables)
        self.assertEqual([text.get_text() for text in plots.sweep(closures).axes[0].get_legend().get_texts()], ["paper", "consistent"])
        self.assertEqual(choose.kinds_of(data), ["sweep"])
        for says, change in [("not a number", {"variable": "W"}), ("0 dimensions", {"data": data.isel(friction_coefficient=0, initial_stress_left=0)})]:
            with self.assertRaises(ValueError) as caught:
                plots.sweep(**{"data": data, **change})
            self.assertIn(says, str(caught.exception))

    def test_an_axis_of_equal_ratios_is_logarithmic(self):
        tables = {"set": {"friction.law": "viscous", "pulse.cells": 20}, "variables": ["slip_at_origin"]}
        data = slipfront.sweep(STEP, {"friction.coefficient": [0.1, 1, 10], "initial.stress_left": [0.5, 1, 1.5]}, **tables)
        axes = plots.sweep(data).axes[0]
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("linear", "log"))
        np.testing.assert_allclose(axes.get_ylim(), [10**-1.5, 10**1.5])
        self.assertEqual(plots.sweep(data.isel(initial_stress_left=0)).axes[0].get_xscale(), "log")
        self.assertEqual(plots.sweep(data.isel(friction_coefficient=0)).axes[0].get_xscale(), "linear")

    def test_relations_are_drawn_in_order(self):
        states = slipfront.relations(stress=[1.0, 0.2, 0.5])
        figure = plots.relations(states)
        self.assertEqual(len(figure.axes), 4)
        for axes in figure.axes:
            for line in axes.lines:
                self.assertTrue(np.all(np.diff(line.get_xdata()) > 0))
                self.assertTrue(np.all(np.diff(line.get_ydata()) > 0))
        self.labels(figure)
        self.assertEqual([axes.get_yscale() for axes in figure.axes], ["linear", "log", "linear", "log"])

    def test_comparison(self):
        levels = slipfront.compare(STEP, scales=[30])
        figure = plots.comparison(levels)
        self.labels(figure)
        names = [line.get_label() for line in figure.axes[0].lines]
        self.assertEqual(names, ["closed-form", "pulse-consistent", "pulse-paper", "chain-30"])

    def arrows(self, axes):
        return [text for text in axes.texts if getattr(text, "arrow_patch", None)]

    def test_events_lie_on_the_closed_form_or_above_it(self):
        events = slipfront.event()
        events = events.isel(event=events["rupture_velocity"].notnull().values)
        line = choose.line_through(events)
        figure = plots.events(events, line)
        at = np.interp(np.log(events["rupture_velocity"]), np.log(line["rupture_velocity"]), line["stress"])
        self.assertGreater(float((events["stress"] / at).min()), 1 - 2e-3)
        bounded = events["stress_bound"].notnull().values
        self.assertTrue(bounded.any())
        np.testing.assert_allclose(at[bounded], events["stress"].values[bounded], rtol=2e-3)
        self.assertEqual(figure.axes[0].get_xscale(), "log")
        stress, pascal = figure.axes
        self.assertIn("by construction", stress.get_title(loc="left"))
        self.assertEqual(len(self.arrows(stress)), bounded.sum())
        self.assertEqual(self.arrows(pascal), [])

    def test_lower_bounds_of_the_stress_in_pascal_have_arrows(self):
        both = {"rupture_velocity": "1 km/s", "slip_velocity": "0.1 m/s", "rupture_velocity_is": "characteristic"}
        events = slipfront.event([both, {**both, "contact_ratio": 0.01}])
        figure = plots.events(events, choose.line_through(events))
        self.assertEqual([len(self.arrows(axes)) for axes in figure.axes[:3]], [0, 0, 1])

    def test_kinds_of_events_have_different_colours(self):
        kinds = [f"kind {i}" for i in range(9)]
        events = slipfront.event([{"rupture_velocity": "1 km/s", "kind": kind} for kind in kinds], samples=0)
        handles, texts = plots.events(events, choose.line_through(events)).axes[0].get_legend_handles_labels()
        colours = {text: handle.lines[0].get_color() for handle, text in zip(handles, texts) if text in kinds}
        self.assertEqual(len(set(colours.values())), 9)

    def test_events_with_their_population(self):
        rows = "".join(f"E{i},{10 ** (-3 + 6 * i / 500)} m/s,{10 ** (-7 + 6 * i / 500)} m/s\n" for i in range(501))
        case = self.file("many.csv", "name,rupture_velocity,slip_velocity\n" + rows)
        path = os.path.join(os.path.dirname(case), "many.nc")
        self.ok("event", case, "-o", path)
        events = files.read(path)
        self.assertEqual(choose.kinds_of(events), ["events"])
        figure = choose.draw(events, "events")
        self.labels(figure)
        stress, pascal = figure.axes
        self.assertEqual((stress.get_yscale(), pascal.get_yscale()), ("linear", "log"))
        for axes in figure.axes:
            self.assertIn("decade: median, 5-95 %", [text.get_text() for text in axes.get_legend().get_texts()])
        cloud = pascal.lines[0]
        self.assertEqual(cloud.get_marker(), ".")
        np.testing.assert_allclose(cloud.get_ydata(), events["stress_pa"] / 1e6)
        one = self.file("one.csv", "name,rupture_velocity,slip_velocity\na,1 km/s,0.1 m/s\n")
        self.ok("event", one, "-o", path)
        self.assertNotIn("decade", str([t.get_text() for t in choose.draw(files.read(path), "events").axes[0].get_legend().get_texts()]))

    def test_corner(self):
        figure = plots.corner(samples())
        self.assertEqual(sum(axes.axison for axes in figure.axes), 3)
        self.assertEqual(figure.axes[3].get_xscale(), "log")  # its values span decades
        titles = [axes.get_title(loc="left").split("\n")[0] for axes in figure.axes]
        self.assertEqual([titles[0], titles[3]], ["initial stress Σ−, μA/π", "damping number Γ"])
        with self.assertRaisesRegex(ValueError, "too few"):
            plots.corner(samples(10))
        with self.assertRaisesRegex(ValueError, "in every sample"):
            plots.corner(samples().assign(stress=("sample", np.ones(200))))

    def test_corner_of_the_draws_of_an_event(self):
        case = self.file("event.toml", "[event]\nname = 'mine'\nrupture_velocity = '3.0 +- 0.2 km/s'\nslip_velocity = '0.5 */ 1.3 m/s'\nstress_drop = '40 */ 1.4 MPa'\n"
                                       "duration = '1 s'\n")
        path = os.path.join(os.path.dirname(case), "event.nc")
        self.ok("event", case, "--draws", "500", "-o", path)
        data = files.read(path)
        self.assertEqual(choose.kinds_of(data)[0], "corner")
        figure = choose.draw(data, "corner")
        self.assertEqual([axes.get_xlabel() for axes in figure.axes[-4:]], ["initial stress Σ−, μA/π", "contact ratio A", "initial stress, MPa", "damping number Γ"])
        middle = float(figure.axes[10].get_title(loc="left").split("\n")[1].split()[0])
        self.assertLess(abs(middle / (float(data["draw_stress_pa"].median()) / 1e6) - 1), 0.01)
        of_group = plots.corner(slipfront.open(path, group="posterior"))
        self.assertEqual([axes.get_title(loc="left") for axes in of_group.axes], [axes.get_title(loc="left") for axes in figure.axes])

    def test_units(self):
        pulse = slipfront.pulse(CASE)
        self.assertEqual(label(pulse["slip"]), "slip u, b/(2π)")
        self.assertEqual(label(pulse["time"]), "time t, b/(cA)")

    def test_saving_does_not_change_the_layout(self):
        figure = Figure(layout="none")
        axes = figure.add_axes((0.2, 0.3, 0.4, 0.5))
        for ending in ("svg", "png"):
            plots.save(figure, os.path.join(os.path.dirname(self.file("x", "")), f"a.{ending}"))
            np.testing.assert_allclose(axes.get_position().bounds, (0.2, 0.3, 0.4, 0.5))
        self.assertIsNone(figure.get_layout_engine())

    def test_drawing_does_not_change_the_global_style(self):
        import matplotlib

        before = dict(matplotlib.rcParams)
        plots.relations(slipfront.relations(stress=[1.0, 2.0]))
        self.assertEqual(before, dict(matplotlib.rcParams))


class Command(PythonCommands):
    def made(self, name, *arguments):
        path = os.path.join(os.path.dirname(self.file("x", "")), name)
        text = self.ok(*arguments) if arguments[0] in ("relations", "event") else self.ok(*arguments, "-o", path)
        if arguments[0] in ("relations", "event"):
            with open(path, "w", encoding="utf-8") as out:
                out.write(text)
        return path

    def test_draws_what_the_file_holds(self):
        """With -o it writes one file of that name; without, one for each kind of figure. Each run writes the same bytes."""
        for kinds, path in ((["space-time", "profiles"], self.made("p.nc", "pulse", CASE)), (["relations"], self.made("r.csv", "relations", "--stress", "0.2:2:9", "--csv")),
                            (["events"], self.made("e.csv", "event", "--csv")), (["comparison"], self.made("c.nc", "compare", STEP, "--scale", "30")),
                            (["plane"], self.made("q.nc", "plane", PLANE, "--set", "plane.loops=24", "plane.angles=16", "plane.cells=40")),
                            (["space-time", "profiles"], self.made("k.nc", "chain", STEP, "--set", "chain.scale=50", "--quiet")),
                            (["sweep"], self.made("s.nc", "sweep", STEP, "--vary", "initial.stress_left=0.5,1"))):
            with self.subTest(path):
                self.assertEqual(choose.kinds_of(files.read(path)), kinds)
                folder = os.path.dirname(path)
                before = set(os.listdir(folder))
                out = os.path.join(folder, "picture.svg")
                self.assertTrue(self.ok("plot", path, "-o", out, "--kind", kinds[0]).startswith(f"written to {out}"))
                self.assertEqual(set(os.listdir(folder)) - before, {"picture.svg"})
                with open(out, encoding="utf-8") as svg:
                    picture = svg.read()
                self.assertIn("<svg", picture[:3000])
                if kinds[0] in ("events", "plane"):
                    self.ok("plot", path, "-o", out)
                    with open(out, encoding="utf-8") as svg:
                        self.assertEqual(svg.read(), picture)
        for path, count in ((self.made("p.nc", "pulse", CASE), 2), (self.made("r.csv", "relations", "--stress", "0.2:2:9", "--csv"), 1)):
            written = [line.removeprefix("written to ") for line in self.ok("plot", path).split("\n")[:-1]]
            self.assertEqual(len(written), count)
            for name in written:
                with open(name, "rb") as png:
                    self.assertEqual(png.read(4), b"\x89PNG")
            self.assertEqual([name for name in os.listdir(os.path.dirname(path)) if name.startswith(".")], [])

    def test_names_the_number_of_a_sweep(self):
        path = self.made("s.nc", "sweep", STEP, "--vary", "initial.stress_left=0.5,1")
        out = os.path.join(os.path.dirname(path), "a.svg")
        self.assertEqual(self.ok("plot", path, "-o", out), f"written to {out}: slip_velocity_at_origin\n")
        self.assertEqual(json.loads(self.ok("plot", path, "-o", out, "--variable", "slip_at_origin", "--json")), {"pictures": [out], "variable": "slip_at_origin"})
        self.refused(2, "plot", path, "--variable", "slip", says=["--variable", "'slip'", "slip_at_origin"])
        self.refused(2, "plot", self.made("e.csv", "event", "--csv"), "--variable", "stress", says=["--variable stress", "sweep"])

    def test_refuses(self):
        csv = self.file("r.csv", self.ok("relations", "--stress", "1", "--csv"))
        folder = os.path.dirname(csv)
        self.refused(3, "plot", os.path.join(folder, "none.nc"), says=["none.nc", "No such file"])
        self.refused(2, "plot", csv, "-o", "x.bmp", says=[".bmp", "allowed"])
        self.refused(2, "plot", csv, "--kind", "corner", says=["corner", "allowed: relations"])
        self.refused(2, "plot", says=["FILE"])
        self.refused(2, "plot", csv, "--threads", "0", says=["'0'", "1 to 4096"])
        self.refused(2, "plot", self.file("empty.csv", "a,b\n"), says=["no rows"])
        self.refused(2, "plot", self.file("other.csv", "a,b\n1,2\n"), says=["nothing to draw"])
        self.refused(2, "plot", self.file("a.txt", "hello"), says=["neither NetCDF nor CSV"])
        self.refused(3, "plot", csv, "-o", os.path.join(folder, "nowhere", "x.png"), says=["nowhere"])
        whole = self.made("p.nc", "pulse", CASE)
        with open(whole, "rb") as file:
            start = file.read(20000)
        with open(os.path.join(folder, "cut.nc"), "wb") as file:
            file.write(start)
        self.refused(3, "plot", os.path.join(folder, "cut.nc"), says=["cut.nc", "not a whole NetCDF file"])


if __name__ == "__main__":
    unittest.main()
