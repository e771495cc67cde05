"""Attacks `slipfront explore` in several ways at once. Usage: python3 tests/cli/explore_attack.py PROGRAM PAGE [SECONDS].

You start this test manually. It opens 300 slow connections, and sends bodies of 1 GB, requests with 10,000 ranges, and
requests for hosts other than this machine. Meanwhile another client requests the largest file of the page. The script prints
the slowest answer to this client, and the largest memory use of the server.
"""

import contextlib
import http.client
import json
import os
import pathlib
import subprocess
import sys
import threading
import time


def address(process):
    url = json.loads(process.stdout.readline())["url"]
    return url.rstrip("/").rpartition("/")[2]


def request(server, method, path, fields, body=()):
    """Sends a request, then pieces of a body. Returns the status of the answer, or None if the server closed the connection."""
    with contextlib.suppress(OSError, http.client.HTTPException):
        connection = http.client.HTTPConnection(server, timeout=60)
        connection.putrequest(method, path, skip_host=True)
        for name, value in fields.items():
            connection.putheader(name, value)
        connection.endheaders()
        with contextlib.suppress(OSError):
            for piece in body:
                connection.send(piece)
        return connection.getresponse().status


def send_large_body(server, path):
    piece = bytes(1 << 20)
    return request(server, "POST", path, {"Host": server, "Content-Length": str(1 << 30)}, (piece for _ in range(1 << 10)))


def ask_for_ranges(server, path):
    fields = {"Host": server} | {f"Range-{i}" if i else "Range": "bytes=" + ",".join(["0-"] * 2500) for i in range(4)}
    return request(server, "GET", path, fields)


def ask_as_stranger(server, path):
    return request(server, "GET", path, {"Host": "evil.example", "Origin": "http://evil.example"})


def be_slow(server, path):
    connections = [http.client.HTTPConnection(server, timeout=60) for _ in range(300)]
    for connection in connections:
        with contextlib.suppress(OSError):
            connection.connect()
    for _ in range(20):
        for i, connection in enumerate(connections):
            with contextlib.suppress(OSError, AttributeError):
                connection.sock.send(b"G" if i % 2 else f"GET {path} HTTP/1.1\r\nHost: {server}\r\n\r\n".encode())
        time.sleep(0.2)


def main(program, page, seconds=20.0):
    largest = max((path for path in pathlib.Path(page).rglob("*") if path.is_file()), key=os.path.getsize)
    path, size = "/" + largest.relative_to(page).as_posix(), largest.stat().st_size
    process = subprocess.Popen([program, "explore", "--no-open", "--json", "--port", "0", "--folder", page], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True)
    server, end, answers, attacks = address(process), time.monotonic() + float(seconds), [], {}

    def attack(kind):
        while time.monotonic() < end:
            status = kind(server, path)
            attacks.setdefault(kind.__name__, []).append(status)

    threads = [threading.Thread(target=attack, args=(kind,)) for kind in (send_large_body, ask_for_ranges, ask_as_stranger, be_slow)]
    for thread in threads:
        thread.start()
    while time.monotonic() < end:
        begun = time.monotonic()
        connection = http.client.HTTPConnection(server, timeout=60)
        connection.request("GET", path)
        assert len(connection.getresponse().read()) == size
        answers.append(time.monotonic() - begun)
        time.sleep(0.05)
    for thread in threads:
        thread.join()
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    memory = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM")) / 1000
    process.terminate()
    process.wait()
    for name, statuses in attacks.items():
        print(f"{name}: {len(statuses)} attacks, answers {dict((s, statuses.count(s)) for s in set(statuses))}")
    print(f"{len(answers)} files of {size} bytes for another client, the slowest in {max(answers):.3f} s; at most {memory:.1f} MB of memory")


if __name__ == "__main__":
    main(*sys.argv[1:])
