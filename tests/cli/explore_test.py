"""`slipfront explore`: what it serves, to whom, and what it refuses."""

import contextlib
import json
import os
import signal
import socket
import subprocess
import tempfile
import threading
import unittest
import urllib.error
import urllib.request

from support import PATIENCE, PROGRAM, SANITIZED, CommandLine


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
        said = json.loads(process.stdout.readline())
        self.port = int(said["url"].rstrip("/").rpartition(":")[2])
        return process, said

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)

    def connect(self):
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE)
        self.addCleanup(connection.close)
        return connection

    def ask(self, path="/", method="GET", host=None, fields=""):
        """Status, header and body of an answer, read until the server closes."""
        connection = self.connect()
        host = f"127.0.0.1:{self.port}" if host is None else host
        connection.sendall(f"{method} {path} HTTP/1.1\r\nHost: {host}\r\n{fields}\r\n".encode("latin-1"))
        return self.answer(connection)

    def answer(self, connection):
        answer = b""
        while piece := connection.recv(1 << 16):
            answer += piece
        connection.close()
        header, _, body = answer.partition(b"\r\n\r\n")
        return int(header.split()[1]), header.decode("latin-1"), body

    def most_memory(self, process):
        """Largest resident size so far, in MB."""
        with open(f"/proc/{process.pid}/status", encoding="ascii") as status:
            return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1000

    def test_serves_the_folder_and_nothing_above_it(self):
        process, said = self.serve("--port", "0")
        self.assertTrue(said["url"].startswith("http://127.0.0.1:"))
        with urllib.request.urlopen(said["url"], timeout=PATIENCE) as answer:
            self.assertEqual(answer.read(), b"<title>page</title>")
        for path in ("nothing", "../" + os.path.basename(__file__), "..%2f..%2fetc/passwd"):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(said["url"] + path, timeout=PATIENCE)
            self.assertEqual(refused.exception.code, 404)
            refused.exception.close()
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE), 130)

    def test_serves_only_regular_files_that_are_not_hidden(self):
        self.write("assets/module.js", b"code")
        self.write(".secret", b"no")
        self.write(".git/config", b"no")
        with tempfile.NamedTemporaryFile() as outside:
            os.symlink(outside.name, os.path.join(self.folder, "link"))
            os.symlink(os.path.dirname(outside.name), os.path.join(self.folder, "folder"))
            os.mkfifo(os.path.join(self.folder, "pipe"))
            self.serve("--port", "0")
            inside = "folder/" + os.path.basename(outside.name)
            for path in ("link", inside, "pipe", "assets", "assets/", ".secret", "%2esecret", ".git/config", "assets/../.secret",
                         "assets//module.js", "", "assets%2fmodule.js", "index.html%00", "a" * 5000):
                self.assertEqual(self.ask("//" if path == "" else "/" + path)[0], 404, path)
        status, header, body = self.ask("/assets/module.js?v=1#there")
        self.assertEqual((status, body), (200, b"code"))
        self.assertIn("text/javascript", header)
        status, header, body = self.ask("/%61ssets/module.js", method="HEAD")
        self.assertEqual((status, body), (200, b""))
        self.assertIn("Content-Length: 4\r\n", header)

    def test_a_page_of_another_origin_cannot_use_it(self):
        self.serve("--port", "0")
        for host in ("evil.example", f"evil.example:{self.port}", "127.evil.example", "localhost.evil.example", "192.168.0.1", "[::2]"):
            self.assertEqual(self.ask(host=host)[0], 421, host)
        for host in ("localhost", f"LOCALHOST:{self.port}", "127.0.0.1:9000", "127.0.0.9", "[::1]:80"):
            self.assertEqual(self.ask(host=host)[0], 200, host)
        for host in ("", ":80"):
            self.assertEqual(self.ask(host=host)[0], 400, host)
        self.assertEqual(self.ask(fields="Host: localhost\r\n")[0], 400)
        for origin in ("http://evil.example", "null", "http://127.0.0.1", f"http://127.0.0.1:{self.port}.evil.example"):
            self.assertEqual(self.ask(fields=f"Origin: {origin}\r\n")[0], 403, origin)
        self.assertEqual(self.ask(fields=f"Origin: http://127.0.0.1:{self.port}\r\n")[0], 200)

    def test_the_page_cannot_be_framed_nor_load_what_is_elsewhere(self):
        self.serve("--port", "0")
        for path in ("/", "/nothing"):
            _, header, _ = self.ask(path)
            for text in ("frame-ancestors 'none'", "default-src 'none'", "X-Frame-Options: DENY", "nosniff", "same-origin"):
                self.assertIn(text, header)

    def test_refuses_what_is_not_a_request_for_a_file(self):
        self.serve("--port", "0")
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "TRACE", "get"):
            status, header, _ = self.ask(method=method, fields="Content-Length: 5\r\n")
            self.assertEqual(status, 405, method)
            self.assertIn("Allow: GET, HEAD", header)
        for text, status in (("nonsense\r\n\r\n", 400), ("GET /\r\n\r\n", 400), ("GET / HTTP/2.0\r\n\r\n", 505), ("\r\n\r\n", 400),
                             ("GET x HTTP/1.1\r\nHost: localhost\r\n\r\n", 400), ("GET /% HTTP/1.1\r\nHost: localhost\r\n\r\n", 400),
                             ("GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n", 400), ("GET / HTTP/1.1\r\nHost\r\n\r\n", 400)):
            connection = self.connect()
            connection.sendall(text.encode())
            self.assertEqual(self.answer(connection)[0], status, text)

    def test_a_request_costs_no_more_memory_than_it_needs(self):
        content = os.urandom(1 << 20)
        self.write("large.bin", content)
        process, _ = self.serve("--port", "0")
        self.assertEqual(self.ask("/large.bin")[2], content)
        before = self.most_memory(process)
        ranges = ",".join(["0-"] * 2600)
        self.assertEqual(self.ask("/large.bin", fields=f"Range: bytes={ranges}\r\n")[2], content)
        ranges = ",".join(["0-"] * 10000)
        self.assertEqual(self.ask("/large.bin", fields=f"Range: bytes={ranges}\r\nX: {'x' * 10000}\r\n")[0], 431)
        connection = self.connect()
        connection.sendall(b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000000\r\n\r\n")
        with contextlib.suppress(ConnectionError):  # it closes after a second, however much is to come
            for _ in range(100):
                connection.sendall(bytes(1000000))
        connection = self.connect()
        with contextlib.suppress(ConnectionError):
            for _ in range(1000):
                connection.sendall(b"x" * 100000)  # a request line without an end
        self.assertEqual(self.ask()[0], 200)
        self.assertLess(self.most_memory(process) - before, 60 if SANITIZED else 10)

    def test_header_fields_without_an_end_cost_no_memory(self):
        process, _ = self.serve("--port", "0")
        self.ask()
        before = self.most_memory(process)
        connection = self.connect()
        with contextlib.suppress(ConnectionError):
            connection.sendall(b"GET / HTTP/1.1\r\na")
            for _ in range(1000):
                connection.sendall(b":\r\na" * 5000)  # Beast bounds no sum of pieces that end in a name
        self.assertEqual(self.ask()[0], 200)
        self.assertLess(self.most_memory(process) - before, 60 if SANITIZED else 10)

    def test_slow_clients_do_not_keep_others_waiting(self):
        self.write("large.bin", bytes(1 << 24))
        process, _ = self.serve("--port", "0")
        slow = [self.connect() for _ in range(300)]
        for connection in slow[200:]:
            connection.sendall(b"GET /large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")  # and the answer is not read
        done = threading.Event()

        def send_a_byte_each():
            while not done.wait(0.1):
                for connection in slow[:200]:
                    with contextlib.suppress(OSError):
                        connection.send(b"G")

        dripping = threading.Thread(target=send_a_byte_each)
        dripping.start()
        try:
            for _ in range(10):
                self.assertEqual(self.ask()[0], 200)
        finally:
            done.set()
            dripping.join()
        self.assertLess(self.most_memory(process), 1000 if SANITIZED else 200)

    def test_runs_out_of_descriptors_without_an_end(self):
        limit = 20
        process = subprocess.Popen(["bash", "-c", f'ulimit -n {limit}; exec "$@"', "-", PROGRAM, "explore", "--no-open", "--json", "--port",
                                    "0", "--folder", self.folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.port = int(json.loads(process.stdout.readline())["url"].rstrip("/").rpartition(":")[2])
        waiting = [self.connect() for _ in range(3 * limit)]
        self.assertEqual(self.ask()[0], 200)
        self.assertEqual(len(waiting), 3 * limit)

    def test_a_client_that_asks_nothing_is_let_go(self):
        self.serve("--port", "0")
        silent, cut = self.connect(), self.connect()
        cut.sendall(b"GET / HTTP/1.1\r\n")
        self.assertEqual(silent.recv(100), b"")
        self.assertEqual(self.answer(cut)[0], 408)

    def test_a_taken_port_is_an_error_where_it_was_asked_for(self):
        _, said = self.serve("--port", "0")
        port = said["url"].rstrip("/").rpartition(":")[2]
        self.refused(3, "explore", "--no-open", "--folder", self.folder, "--port", port, says=[port])

    def test_refuses(self):
        self.refused(2, "explore", "--folder", self.folder, "--port", "99999", says=["--port", "65535"])
        self.refused(2, "explore", "--folder", self.folder, "--address", "0.0.0.0", says=["--address", "--anyone"])
        self.refused(3, "explore", "--folder", self.folder, "--address", "127.example.invalid", says=["127.example.invalid"])
        self.refused(3, "explore", "--folder", os.path.join(self.folder, "none"), says=["index.html"])


if __name__ == "__main__":
    unittest.main()
