"""report.html in a browser: no console message, nothing loaded, nothing wider than the page. Skipped where there is no chromium."""

import json
import re
import shutil
import subprocess
import tempfile
import unittest

from slipfront.reproduce import outputs, report
from slipfront.reproduce.states import contact

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
ROW = {"what": "a number " * 8, "unit": "c", "printed": "0.5", "computed": 0.51, "difference": 0.02, "agrees": False, "remark": "why " * 20}


@unittest.skipUnless(CHROMIUM, "no chromium here")
class Report(unittest.TestCase):
    def test_loads_quietly_and_fits(self):
        with tempfile.TemporaryDirectory() as folder:
            import pathlib

            place = pathlib.Path(folder)
            picture = contact()
            outputs.write_picture(place, picture)
            formula = {"where": "Eq. 1", "printed": "u", "mended": "2 u", "check": "slip", "by_printed": 0.5, "by_mended": None}
            statement = {"statement": "s", "found": "f", "holds": True}
            tables = {"numbers": [ROW], "formulas": [formula], "statements": [statement]}
            page = report.page(place, [picture], tables, {"version": "0", "seconds": 1.0, "pulses": 2})
            # The page says by its title how wide it came out.
            measure = "<script>document.title=JSON.stringify([document.documentElement.scrollWidth,innerWidth])</script>"
            (place / "report.html").write_text(page.replace("</body>", measure + "</body>"), encoding="utf-8")
            for width in (1400, 500):
                log = place / f"net-{width}.json"
                done = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", f"--user-data-dir={folder}/profile",
                                       f"--log-net-log={log}", f"--window-size={width},900", "--dump-dom", (place / "report.html").as_uri()],
                                      capture_output=True, text=True, timeout=120)
                self.assertNotIn("CONSOLE", done.stderr)
                scroll, inner = json.loads(re.search(r"<title>(.*?)</title>", done.stdout).group(1))
                self.assertLessEqual(scroll, inner)


if __name__ == "__main__":
    unittest.main()
