"""The tutorials run, print what their text quotes, and draw their pictures."""

import contextlib
import glob
import io
import os
import runpy
import tempfile
import unittest

from matplotlib.figure import Figure
from support import SOURCE

#: What each prints, as its text quotes it, and how many pictures it draws.
RESULTS = {
    "plot_1_my_earthquake": ("stress drop                               0.11               0.08", 2),
    "plot_2_slow_slip": ("least stress     varies by a factor of 2.04", 1),
    "plot_3_laboratory_block": ("half a period 0.71 ms", 2),
    "plot_4_heterogeneous_fault": ("  of it taken by friction   96.5%", 4),
    "plot_5_dispersive_shock": ("slip over x, difference from the chain: one train 2.1 %, many trains 0.1 %", 2),
}


class Tutorial(unittest.TestCase):
    def test_every_tutorial_has_a_result(self):
        scripts = sorted(glob.glob(os.path.join(SOURCE, "docs/tutorials/*.py")))
        self.assertEqual([os.path.basename(script)[:-3] for script in scripts], sorted(RESULTS))

    def test_tutorials_print_and_draw(self):
        for name, (line, pictures) in RESULTS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
                with contextlib.redirect_stdout(io.StringIO()) as printed:
                    names = runpy.run_path(os.path.join(SOURCE, "docs/tutorials", f"{name}.py"))
                self.assertIn(line, printed.getvalue())
                self.assertEqual(len({id(value) for value in names.values() if isinstance(value, Figure)}), pictures)


if __name__ == "__main__":
    unittest.main()
