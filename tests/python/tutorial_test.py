"""The tutorial's scripts run, say what their text promises, and leave their pictures."""

import glob
import os
import subprocess
import sys
import tempfile
import unittest

from support import PATIENCE, SOURCE

SAYS = {
    "1_relations": "V = 0.5 c needs a stress of 0.9845",
    "2_event": "My earthquake: V = 0.517 c",
    "3_pulse": "C = 1, closure paper",
    "4_chain": "nearer to the chain: consistent",
}


class Tutorial(unittest.TestCase):
    def test_scripts(self):
        scripts = sorted(glob.glob(os.path.join(SOURCE, "docs/tutorial/*.py")))
        self.assertEqual([os.path.basename(script)[:-3] for script in scripts], sorted(SAYS))
        for script in scripts:
            name = os.path.basename(script)[:-3]
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, script], cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(SAYS[name], done.stdout)
                pictures = os.listdir(folder)
                self.assertTrue(pictures)
                self.assertTrue(all(picture.startswith(name[:2]) and picture.endswith(".png") for picture in pictures), pictures)


if __name__ == "__main__":
    unittest.main()
