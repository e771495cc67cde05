"""Objects show themselves in a notebook: Datasets and plans as tables, figures as pictures."""

import os
import unittest

import slipfront
from slipfront import plots
from support import SOURCE

STEP = os.path.join(SOURCE, "cases/step-viscous.toml")


class Notebook(unittest.TestCase):
    def test_results_are_tables(self):
        for data in (slipfront.relations(stress=[0.5, 1.0]), slipfront.event(samples=0), slipfront.pulse(STEP), slipfront.sweep(STEP, {"pulse.cells": [50, 60]}),
                     slipfront.friction_ratio(1.0, 0.5)):
            self.assertIn("xr-wrap", data._repr_html_())

    def test_a_plan_is_a_table(self):
        for command, key in (("pulse", "cells"), ("chain", "sites"), ("compare", "levels")):
            plan = slipfront.check(STEP, command=command, scales=[100] if command == "compare" else ())
            self.assertIn(f"<tr><th>{key}</th><td>{plan[key]}</td></tr>", plan._repr_html_())
            self.assertRegex(plan._repr_html_(), "memory_bytes</th><td>[0-9.]+ [kMG]B<")
        titled = slipfront.check({"title": "<b>", "initial": {"stress_left": 1.0, "stress_right": 0}})
        self.assertIn("&lt;b&gt;", titled._repr_html_())
        self.assertEqual(dict(titled), titled)

    def test_a_figure_is_a_picture(self):
        for figure in (plots.relations(slipfront.relations(stress=[0.5, 1.0])), plots.profiles(slipfront.pulse(STEP))):
            self.assertEqual(figure._repr_png_()[:4], b"\x89PNG")


if __name__ == "__main__":
    unittest.main()
