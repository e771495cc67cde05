"""slipfront plot of chains that springs load, and of sweeps of them: what is drawn, and what is refused."""

import os
import unittest

import numpy as np

from commands import PythonCommands
import slipfront
from slipfront import plots
from slipfront.plots import choose, files
from slipfront.plots.loaded_parts import force_with_events, slip_rates
from support import SOURCE

#: A block on a spring (docs/loading.md). Its period is about 5e4.
BLOCK = {"title": "Block", "initial": {"profile": "step", "stress_left": 0, "stress_right": 0}, "interface": {"contact": "0"},
         "friction": {"law": "rate-and-state", "strength": 0.05, "direct_effect": 0.01, "evolution_effect": 0.015, "reference_velocity": 0.01, "characteristic_slip": 1},
         "loading": {"stiffness": 0.0025, "velocity": 0.001}, "domain": {"left": -10, "right": 10}, "chain": {"left": "free", "right": "free", "steps": "implicit"},
         "time": {"end": 2e5}, "output": {"every": 1e3}, "pulse": {"cells": 20}}
RING = os.path.join(SOURCE, "cases/stick-slip.toml")
SMALL = {"domain.left": -100, "domain.right": 100, "pulse.cells": 20, "time.end": 3e5, "output.every": 5e3, "interface.contact": "1 + 0.05*cos(x*0.031415926535897934)"}


def line(axes, text):
    """Returns the line of this label."""
    return next(line for line in axes.lines if line.get_label().startswith(text))


def texts(axes):
    return [text.get_text() for text in axes.texts]


class Loaded(PythonCommands):
    @classmethod
    def setUpClass(cls):
        cls.block = slipfront.chain(BLOCK)
        cls.rest = slipfront.chain(BLOCK, set={"time.end": 100, "output.every": 10, "loading.velocity": 1e-6, "friction.strength": 0.6})

    def test_the_force_is_that_of_the_springs(self):
        expected = 0.0025 * (0.001 * self.block["time"] - self.block["slip"].mean("x"))
        np.testing.assert_allclose(self.block["loading_force"], expected, atol=1e-9)
        self.assertTrue(self.block["loading_stress"].isnull().all())
        self.assertTrue(slipfront.pulse(os.path.join(SOURCE, "cases/step.toml"), errors=False)["loading_force"].isnull().all())

    def test_a_pulled_end_has_a_stress(self):
        pulled = slipfront.chain(BLOCK, set={"loading.where": "left", "loading.stiffness": 0.05, "time.end": 1e3, "output.every": 100})
        self.assertTrue(pulled["loading_force"].isnull().all())
        # A scheme of first order at the end has 0.0479318, 0.0478565, 0.0478190, 0.0478003 at spacings 0.4 to 0.05: the limit is this.
        self.assertAlmostEqual(float(pulled["loading_stress"][-1]), 0.0477816, delta=1e-7)
        self.assertEqual(plots.loading(pulled).axes[0].get_ylabel().split(",")[0], "stress at pulled end")

    def test_the_force_falls_by_the_stress_drop_of_each_event(self):
        run = self.block
        times, forces, at_onsets = force_with_events(run)
        self.assertTrue(np.all(np.diff(times) >= 0))
        np.testing.assert_allclose(np.interp(run["time"], times, forces), run["loading_force"], atol=1e-12)
        whole = run["event_complete"].values > 0
        after = np.interp((run["event_onset"] + run["event_duration"]).values, times, forces)
        np.testing.assert_allclose((at_onsets - after)[whole], run["event_stress_drop"].values[whole], rtol=1e-3)

    def test_force_events_and_slip_velocity_over_time(self):
        run = self.block
        force, rates = plots.loading(run).axes[:2]
        np.testing.assert_array_equal(line(force, "onset").get_xdata(), run["event_onset"][run["event_complete"] > 0])
        self.assertEqual(force.get_ylabel(), "force F, μA²/(π(1-ν))")
        self.assertEqual(rates.get_xlabel(), "time t, 10³ b/(cA)")
        mesh = rates.collections[0]
        expected = np.diff(run["slip"].values, axis=0) / 1e3
        np.testing.assert_allclose(mesh.get_array().reshape(expected.T.shape), np.abs(expected).T, atol=1e-15)
        self.assertEqual(type(mesh.norm).__name__, "LogNorm")
        self.assertGreater(mesh.norm.vmax / mesh.norm.vmin, 1e5)

    def test_the_time_until_an_event_is_logarithmic(self):
        figure = plots.loading(self.block, until_failure=True, event=2)
        force, rates = figure.axes[:2]
        self.assertEqual((rates.get_xscale(), rates.get_xlabel()), ("log", "time until event 2, b/(cA)"))
        onset, first_end = float(self.block["event_onset"][1]), float(self.block["event_onset"][0] + self.block["event_duration"][0])
        left, right = rates.get_xlim()
        self.assertTrue(onset - first_end >= left > right > 0)
        self.assertTrue(np.all(np.diff(force.lines[0].get_xdata()) < 0))

    def test_an_event_close_up(self):
        run = slipfront.chain(RING, set=SMALL)
        number = int(run["event_slip"].argmax()) + 1
        figure = plots.slip_event(run)
        self.assertIn(f"event {number} of {run.sizes['event']}", figure._suptitle.get_text())
        onset, duration = (float(run[f"event_{name}"][number - 1]) for name in ("onset", "duration"))
        near = np.linspace(onset - duration, onset + 2 * duration, 60).tolist()
        tables = {key: value for key, value in SMALL.items() if key != "output.every"}
        with open(RING, encoding="utf-8") as file:
            text = file.read().replace("every = 2.56e5", f"times = {near}")
        dense = slipfront.chain(text, set={**tables, "time.end": near[-1]})
        event = int(np.argmin(np.abs(dense["event_onset"].values - onset)))
        axes = plots.slip_event(dense, event + 1).axes
        left, right = axes[0].get_xlim()
        self.assertLessEqual(right - left, 3.001 * duration)
        front = line(axes[0], "front")
        np.testing.assert_array_equal(front.get_ydata(), dense["x"])
        arrivals = front.get_xdata()
        self.assertLess(abs(np.nanmin(arrivals)), 0.1 * duration)
        velocity = float(dense["event_rupture_velocity"][event])
        if np.isfinite(velocity):
            fitted = line(axes[0], "fitted velocity")
            self.assertAlmostEqual(np.diff(fitted.get_ydata())[0] / np.diff(fitted.get_xdata())[0], velocity)
        slip = axes[1].lines[0].get_xdata()
        self.assertAlmostEqual(slip.mean() / float(dense["event_slip"][event]), 1, delta=0.1)

    def test_catalogue(self):
        left, right = plots.catalogue(self.block).axes
        run, whole = self.block, self.block["event_complete"].values > 0
        np.testing.assert_array_equal(left.lines[0].get_xdata(), run["event_length"][whole])
        np.testing.assert_array_equal(left.lines[0].get_ydata(), run["event_slip"][whole])
        np.testing.assert_array_equal(right.lines[0].get_xdata(), np.diff(run["event_onset"])[whole[1:]])
        np.testing.assert_array_equal(right.lines[0].get_ydata(), run["event_stress_drop"][1:][whole[1:]])
        self.assertEqual((left.get_ylim()[0], right.get_ylim()[0]), (0, 0))
        self.assertIn("one event only", texts(plots.catalogue(run.isel(event=[0])).axes[1]))

    def test_an_event_that_the_end_of_the_run_cuts_does_not_choose_the_scale(self):
        cut = self.block.copy(deep=True)
        cut["event_complete"][-1], cut["event_slip"][-1] = 0, 0.01
        axes = plots.catalogue(cut).axes[0]
        self.assertEqual(axes.get_yscale(), "linear")
        self.assertEqual(line(axes, "event that the end").get_ydata().tolist(), [0.01])
        self.assertEqual(line(axes, "event that the end").get_markerfacecolor(), "white")

    def test_a_run_at_rest_is_drawn_as_such(self):
        force, rates = plots.loading(self.rest).axes[:2]
        self.assertIn("no events", texts(force))
        self.assertIn("at rest", texts(rates))
        self.assertEqual(rates.collections[0].get_clim(), (0, 1))
        for axes, text in zip(plots.profiles(self.rest).axes, ("at rest", "zero", "at rest")):
            self.assertIn(text, texts(axes))
            self.assertEqual(axes.get_ylim(), (-1, 1))
        self.assertIn("at rest", texts(plots.space_time(self.rest).axes[0]))

    def test_profiles_show_the_whole_domain(self):
        self.assertEqual(plots.profiles(self.block).axes[0].get_xlim(), (-10, 10))

    def test_kinds(self):
        self.assertEqual(choose.kinds_of(self.block), ["loading", "event", "catalogue", "profiles"])
        self.assertEqual(choose.kinds_of(self.rest), ["loading", "profiles"])
        self.assertEqual(choose.kinds_of(self.block.isel(time=[0])), ["catalogue", "profiles"])
        np.testing.assert_allclose(slip_rates(self.rest), 0, atol=1e-12)

    def test_command(self):
        folder = os.path.dirname(self.file("x", ""))
        path, out = os.path.join(folder, "run.nc"), os.path.join(folder, "a.svg")
        slipfront.chain(BLOCK, output=path)
        self.assertEqual(choose.kinds_of(files.read(path))[0], "loading")
        self.assertEqual(self.ok("plot", path, "--until-failure", "--event", "2", "-o", out), f"written to {out}\n")
        self.ok("plot", path, "--kind", "event", "--event", "3", "-o", out)
        self.refused(2, "plot", path, "--event", "99", "-o", out, "--kind", "event", says=["--event 99", "allowed: 1 to"])
        self.refused(2, "plot", path, "--event", "0", "--until-failure", "-o", out, says=["--event 0", "allowed: 1 to"])
        self.refused(2, "plot", path, "--event", "1", "--kind", "profiles", says=["--event", "loading, event"])
        self.refused(2, "plot", path, "--until-failure", "--kind", "catalogue", says=["--until-failure", "loading"])


class Sweeps(unittest.TestCase):
    def test_of_loaded_runs(self):
        tables = {"command": "chain", "set": {"time.end": 2e4, "output.every": 2e4}, "variables": ["loading_force", "slip_at_origin"]}
        data = slipfront.sweep(BLOCK, {"loading.stiffness": np.geomspace(0.001, 0.01, 3), "friction.strength": [-1, 0.03, 0.05]}, **tables)
        axes = plots.sweep(data, "loading_force").axes[0]
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("linear", "log"))
        self.assertEqual(axes.get_title(loc="left"), "grey: 3 of 9 runs without this number")
        self.assertEqual(np.ma.count_masked(axes.collections[0].get_array()), 3)
        gaps = plots.sweep(data.isel(loading_stiffness=0), "loading_force").axes[0]
        self.assertEqual(gaps.get_title(loc="left"), "gaps: 1 of 3 runs without this number")

    def test_numbers_over_many_decades_have_a_logarithmic_scale(self):
        data = slipfront.sweep(BLOCK, {"loading.velocity": [1e-6, 1e-4, 1e-2], "friction.strength": [0.03, 0.05]}, command="chain",
                               set={"time.end": 100, "output.every": 100}, variables=["loading_force"])
        self.assertEqual(type(plots.sweep(data).axes[0].collections[0].norm).__name__, "LogNorm")
        lines = plots.sweep(data.isel(friction_strength=0)).axes[0]
        self.assertEqual((lines.get_xscale(), lines.get_yscale()), ("log", "log"))


if __name__ == "__main__":
    unittest.main()
