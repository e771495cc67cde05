"""Helpers that the tests of the command line share. They run the program that $SLIPFRONT names."""

import contextlib
import fcntl
import json
import os
import pty
import random
import resource
import select
import signal
import struct
import subprocess
import tempfile
import termios
import time
import unittest

PROGRAM = os.environ["SLIPFRONT"]
SOURCE = os.environ["SLIPFRONT_SOURCE"]
PATIENCE = 1200  # seconds; longer than any run on a busy machine, so a run that takes longer does not end
SANITIZED = os.environ.get("SLIPFRONT_SANITIZED") == "ON"  # then everything takes ten times longer


def run(*arguments, stdin=""):
    return subprocess.run([PROGRAM, *arguments], input=stdin, capture_output=True, text=True, timeout=PATIENCE)


def on_terminal(width, *command, columns=None, errors=subprocess.DEVNULL):
    """Runs a command on a terminal of this width. Returns its output and exit code. `columns` sets the variable COLUMNS, and
    `errors` = subprocess.STDOUT shows stderr too."""
    terminal, end = pty.openpty()
    fcntl.ioctl(end, termios.TIOCSWINSZ, struct.pack("HHHH", 40, width, 0, 0))
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    if columns is not None:
        environment["COLUMNS"] = columns
    # The end stays open until all is read. If the program were the last to close it, Linux might lose the last lines.
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=end, stderr=errors, env=environment) as process:
        printed, ended, ready = b"", False, []
        while ready or not ended:
            ended = process.poll() is not None
            ready, _, _ = select.select([terminal], [], [], 0.05)
            if ready:
                printed += os.read(terminal, 65536)
    os.close(end)
    os.close(terminal)
    return printed.decode().replace("\r\n", "\n"), process.returncode


def processor_time():
    """Seconds of processor time that all ended child processes have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def processor_time_of(process):
    """Seconds of processor time that a running process has used, without its children."""
    with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def until_it_has_worked(process, seconds):
    """Waits until the program has used the processor for some seconds. On a busy machine that takes longer."""
    while process.poll() is None and processor_time_of(process) < seconds:
        time.sleep(0.001)


def until_it_answers(process, number):
    """Waits until the program handles a signal or has blocked it. Before that, the signal would end it."""
    while process.poll() is None:
        with open(f"/proc/{process.pid}/status", encoding="utf-8") as file:
            masks = [int(line.split()[1], 16) for line in file if line.startswith(("SigCgt:", "SigBlk:"))]
        if any(mask >> (number - 1) & 1 for mask in masks):
            return
        time.sleep(0.001)


class CommandLine(unittest.TestCase):
    #: Runs a command. tests/python/commands.py has another way.
    run_command = staticmethod(run)

    def ok(self, *arguments, stdin=""):
        done = self.run_command(*arguments, stdin=stdin)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def refused(self, code, *arguments, stdin="", says=()):
        done = self.run_command(*arguments, stdin=stdin)
        self.assertEqual(done.returncode, code, (arguments, done.stdout[:300], done.stderr))
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("slipfront: "), done.stderr)
        for text in says:
            self.assertIn(text, done.stderr)
        return done

    def file(self, name, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = os.path.join(folder.name, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path

    def pulse(self, *arguments):
        return json.loads(self.ok("pulse", *arguments, "--json"))

    def chain(self, *arguments):
        return json.loads(self.ok("chain", *arguments, "--json"))

    def slow_case(self):
        cells, scale = (300, 400) if SANITIZED else (700, 700)
        return self.file("slow.toml", "[initial]\nstress_left = 0.855\nstress_right = 0\n[friction]\nlaw = 'viscous'\ncoefficient = 0.5\n"
                                      f"[pulse]\ncells = {cells}\n[chain]\nscale = {scale}\n[output]\nevery = 0.3\n")

    @contextlib.contextmanager
    def takes_at_most(self, seconds):
        """Limits the processor time of the child processes. That time does not depend on how busy the machine is."""
        begun = processor_time()
        yield
        self.assertLess(processor_time() - begun, seconds)

    def wait_for(self, path, process):
        """Waits until the process has written the file or has ended."""
        while not os.path.exists(path) and process.poll() is None:
            time.sleep(1e-4)

    def interrupted(self, path, *arguments):
        """Sends Ctrl-C to a run as soon as its file exists, and returns its messages."""
        process = subprocess.Popen([PROGRAM, *arguments, "-o", path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.wait_for(path, process)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130, errors)
        return errors

    def killed_and_resumed(self, command, trials):
        """Kills a run at random moments and resumes it. The file must have the bytes of an uninterrupted run."""
        case = self.slow_case()
        folder = os.path.dirname(case)
        cut, reference = os.path.join(folder, "cut.nc"), os.path.join(folder, "reference.nc")
        started = time.monotonic()
        self.ok(command, case, "-o", reference)
        whole = time.monotonic() - started  # on this machine, in this build
        chance = random.Random(7)
        resumed = 0
        if SANITIZED:
            trials = max(2, trials // 4)
        for trial in range(trials):
            if os.path.exists(cut):
                os.remove(cut)
            process = subprocess.Popen([PROGRAM, command, case, "-o", cut], stdout=subprocess.DEVNULL)
            if trial % 2:  # every second run certainly has a checkpoint, even if the machine starts it slowly
                self.wait_for(cut, process)
            try:
                process.wait(chance.uniform(0, whole))
            except subprocess.TimeoutExpired:
                process.kill()
            process.wait()
            if not os.path.exists(cut):
                continue  # killed before the first checkpoint, so there is no file, complete or incomplete
            resumed += 1
            self.ok(command, case, "--resume", cut, "--threads", str(1 + trial % 2))
            with open(cut, "rb") as a, open(reference, "rb") as b:
                self.assertEqual(a.read(), b.read(), trial)
        self.assertGreaterEqual(resumed, trials // 2)
