"""report.html in Chromium: it fits windows, and shows values under the cursor. Skipped if chromium is not installed."""

import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

from report_test import Drawn
from support import PATIENCE

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


@unittest.skipUnless(CHROMIUM, "no chromium here")
class Browser(Drawn):
    def ends_with(self, script, width):
        """The value of a script at the end of the page, in a window of this width. The page is the only file in its folder."""
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "moved.html"
            page.write_text(self.text.replace("</body>", f"<script>document.title=JSON.stringify({script})</script></body>"), encoding="utf-8")
            done = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", f"--user-data-dir={folder}/profile",
                                   f"--window-size={width},900", "--dump-dom", page.as_uri()], capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual([line for line in done.stderr.splitlines() if "CONSOLE" in line], [])
            return json.loads(re.search(r"<title>(.*?)</title>", done.stdout, re.DOTALL).group(1))

    def test_fits(self):
        for width in (1400, 400):
            scroll, inner = self.ends_with("[document.documentElement.scrollWidth,innerWidth]", width)
            self.assertLessEqual(scroll, inner)

    def test_pointing_reads_a_value(self):
        """Points at the middle of the logarithmic line, (10, 20), and at a point of the map."""
        lines, map_ = self.axes_in_page(self.pictures[0])
        shares = {"line": (lines["box"], (np.log(10 / lines["x"]["ends"][0]) / np.log(lines["x"]["ends"][1] / lines["x"]["ends"][0]),
                                          np.log(20 / lines["y"]["ends"][0]) / np.log(lines["y"]["ends"][1] / lines["y"]["ends"][0]))),
                  "map": (map_["box"], (0.55, 0.525))}
        shown = {}
        for name, ((left, top, width, height), (across, up)) in shares.items():
            shown[name] = self.ends_with(f"""(()=>{{const p=document.querySelector('.picture'), r=p.getBoundingClientRect();
                p.dispatchEvent(new PointerEvent('pointermove',{{clientX:r.left+{left + across * width}*r.width,clientY:r.top+{top + (1 - up) * height}*r.height}}));
                return document.getElementById('value').textContent}})()""", 1400)
        self.assertEqual(shown["line"], "twice\nstress: 10\nvelocity: 20")
        value = float(shown["map"].split("value: ")[1])
        self.assertLess(abs(value - (0.55 + 10 * 1.05)), 0.02)


if __name__ == "__main__":
    unittest.main()
