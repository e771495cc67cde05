"""`slipfront explore`: what it serves, to whom, and what it refuses."""

import json
import os
import signal
import subprocess
import tempfile
import unittest
import urllib.error
import urllib.request

from support import PROGRAM, CommandLine


class Explore(CommandLine):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        with open(os.path.join(self.folder, "index.html"), "w", encoding="ascii") as page:
            page.write("<title>page</title>")

    def serve(self, *arguments):
        process = subprocess.Popen([PROGRAM, "explore", "--no-open", "--json", "--folder", self.folder, *arguments],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process, json.loads(process.stdout.readline())

    def test_serves_the_folder_and_nothing_above_it(self):
        process, said = self.serve("--port", "0")
        self.assertTrue(said["url"].startswith("http://127.0.0.1:"))
        with urllib.request.urlopen(said["url"], timeout=10) as answer:
            self.assertEqual(answer.read(), b"<title>page</title>")
        for path in ("nothing", "../" + os.path.basename(__file__), "..%2f..%2fetc/passwd"):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(said["url"] + path, timeout=10)
            self.assertEqual(refused.exception.code, 404)
            refused.exception.close()
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(10), 130)

    def test_a_taken_port_is_an_error_where_it_was_asked_for(self):
        _, said = self.serve("--port", "0")
        port = said["url"].rstrip("/").rpartition(":")[2]
        self.refused(3, "explore", "--no-open", "--folder", self.folder, "--port", port, says=[port])

    def test_refuses(self):
        self.refused(2, "explore", "--folder", self.folder, "--port", "99999", says=["--port", "65535"])
        self.refused(2, "explore", "--folder", self.folder, "--address", "0.0.0.0", says=["--address", "--anyone"])
        self.refused(3, "explore", "--folder", os.path.join(self.folder, "none"), says=["index.html"])


if __name__ == "__main__":
    unittest.main()
