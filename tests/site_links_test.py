"""The link check of the documentation site finds dead links and resources of other hosts."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[1] / "docs/site/check_links.py"


class SiteLinks(unittest.TestCase):
    def check(self, **pages: str) -> subprocess.CompletedProcess[str]:
        with tempfile.TemporaryDirectory() as folder:
            for name, text in pages.items():
                (Path(folder) / f"{name}.html").write_text(text, encoding="utf-8")
            return subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True, check=False)

    def test_accepts_links_that_lead_somewhere(self):
        found = self.check(a='<a href="b.html#here">b</a><a href="https://doi.org/x">x</a>', b='<p id="here"><a href="#here"></a></p>')
        self.assertEqual((found.returncode, found.stderr), (0, ""))

    def test_names_page_line_and_address_of_what_is_wrong(self):
        found = self.check(a='<a href="c.html">c</a>\n<a href="b.html#there">b</a>\n<img src="https://example.org/x.png">', b="")
        self.assertEqual(found.returncode, 1)
        self.assertEqual(found.stderr.splitlines(), [
            "a.html:1: c.html leads to no file", "a.html:2: b.html#there leads to no anchor",
            "a.html:3: the page loads https://example.org/x.png; allowed: files of the site"])


if __name__ == "__main__":
    unittest.main()
