"""Unusual conditions around a run: names of outputs, leftovers, signals, text with control codes, unusual inputs."""

import fcntl
import os
import re
import resource
import signal
import subprocess
import time
import unittest

from support import PATIENCE, PROGRAM, SOURCE, CommandLine, processor_time, processor_time_of, run, until_it_answers, until_it_has_worked

STEP = os.path.join(SOURCE, "cases/step.toml")
SMALL = ["--set", "pulse.cells=16", "--set", "chain.scale=20", "--set", "time.end=0.5"]


def little_memory():
    resource.setrlimit(resource.RLIMIT_AS, (2 * 10**9, 2 * 10**9))


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Outputs(CommandLine):
    def test_unusable_output_names_are_refused(self):
        events = os.path.join(SOURCE, "cases/parkfield-2004.toml")
        for command in (["pulse", STEP], ["chain", STEP], ["compare", STEP], ["event", events]):
            self.refused(2, *command, "-o", "", says=["the file name is empty"])
            self.refused(2, *command, "-o", "x.txt", says=["x.txt"])
        self.refused(2, "pulse", STEP, "-o", "x.csv", says=["unsupported file type", ".nc"])

    def test_the_file_behind_stdout_is_not_replaced(self):
        folder = os.path.dirname(self.file("x", ""))
        where = os.path.join(folder, "said.nc")
        for name in ("/dev/stdout", "/proc/self/fd/1", "/dev/fd/1"):
            link = os.path.join(folder, "link.nc")
            os.symlink(name, link)
            with open(where, "w", encoding="ascii") as out:
                done = subprocess.run([PROGRAM, "pulse", STEP, *SMALL, "-o", link], stdout=out, stderr=subprocess.PIPE, text=True)
            os.unlink(link)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("open file", done.stderr)
            self.assertEqual((sorted(os.listdir(folder)), content(where)), (["said.nc", "x"], b""))

    def test_a_finished_result_outlives_a_run_that_is_cut_short(self):
        case = self.slow_case()
        folder = os.path.dirname(case)
        out, unfinished = os.path.join(folder, "out.nc"), os.path.join(folder, "out.unfinished.nc")
        self.ok("pulse", STEP, *SMALL, "-o", out)
        old = content(out)
        process = subprocess.Popen([PROGRAM, "pulse", case, "--set", "pulse.cells=2000", "-o", out], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.wait_for(unfinished, process)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn(f"--resume {unfinished} -o {out}", errors)
        self.assertEqual(content(out), old)
        self.ok("pulse", case, "--set", "pulse.cells=2000", "--resume", unfinished, "-o", out)
        self.assertNotEqual(content(out), old)
        self.assertFalse(os.path.exists(unfinished))

    def test_help_to_a_full_device_is_an_error(self):
        for arguments in (["--help"], ["pulse", "--help"], ["--version"], ["plot", "--help"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), (arguments, done.stderr))

    def test_leftovers_of_killed_runs_are_removed(self):
        folder = os.path.dirname(self.file("mine.nc.part", ""))
        out = os.path.join(folder, "out.nc")
        for name in ("out.nc.part17-0", "out.nc.part99999-12", "out.nc.part18-0"):
            with open(os.path.join(folder, name), "w", encoding="ascii") as left:
                left.write("half")
        with open(os.path.join(folder, "out.nc.part18-0"), "a", encoding="ascii") as living:
            fcntl.flock(living, fcntl.LOCK_EX)
            self.ok("pulse", STEP, *SMALL, "-o", out)
        self.assertEqual(sorted(os.listdir(folder)), ["mine.nc.part", "out.nc", "out.nc.part18-0"])

    def test_leftovers_of_checkpoints_are_removed_by_every_command(self):
        """A new run, or one that ends before its first checkpoint, does not write OUT.unfinished.nc. It removes old leftovers."""
        events = self.file("events.csv", "name,rupture_velocity,slip_velocity\na,3 km/s,0.5 m/s\n")
        folder = os.path.dirname(events)
        out, left = os.path.join(folder, "out.nc"), os.path.join(folder, "out.unfinished.nc.part17-0")
        for command in (["pulse", STEP, *SMALL], ["chain", STEP, *SMALL], ["event", events], ["compare", STEP, *SMALL, "--scale", "20"]):
            for there in (False, True):
                with open(left, "w", encoding="ascii") as half:
                    half.write("half")
                if not there and os.path.exists(out):
                    os.unlink(out)
                self.ok(*command, "-o", out)
                self.assertEqual(sorted(os.listdir(folder)), ["events.csv", "out.nc"], (command, there))


class Sizes(CommandLine):
    def sizes_by_check(self, *arguments):
        """(GB of memory, GB on the disk) that --check prints."""
        text = self.ok(*arguments, "--check", "--wide")
        return tuple(float(x) for x in re.search(r"([\d.e+-]+) GB of memory, ([\d.e+-]+) GB on the disk with -o[.,]", text).groups())

    def test_every_check_prints_memory_and_disk(self):
        for command in (["pulse", STEP], ["chain", STEP], ["compare", STEP, "--scale", "20"]):
            few = self.sizes_by_check(*command)
            many = self.sizes_by_check(*command, "--set", "output.every=0.02")
            self.assertTrue(all(20 * a < b for a, b in zip(few, many)), (command, few, many))

    def test_check_prints_the_size_of_the_file(self):
        for command, file in (("pulse", "p.nc"), ("chain", "c.nc"), ("compare", "l.nc")):
            words = [command, STEP, *SMALL, *(["--scale", "20"] if command == "compare" else []), "--set", "pulse.cells=60", "--set", "output.every=0.005"]
            out = os.path.join(os.path.dirname(self.file("x", "")), file)
            self.ok(*words, "-o", out)
            self.assertAlmostEqual(self.sizes_by_check(*words)[1] * 1e9 / os.path.getsize(out), 1, delta=0.25, msg=command)

    def test_runs_that_do_not_fit_are_refused_before_they_start(self):
        events = self.file("e.csv", "name,rupture_velocity,slip_velocity\n" + "a,3 +- 0.1 km/s,0.5 m/s\n" * 100)
        draws = os.path.join(os.path.dirname(events), "d.nc")
        # AddressSanitizer needs more memory than any limit. Then we test only a run that every machine refuses.
        limited = subprocess.run([PROGRAM, "--version"], preexec_fn=little_memory, capture_output=True).returncode == 0
        for says, command in (("pulse.cells", ["pulse", STEP, "--set", "pulse.cells=10000000"]),
                              ("output.every", ["pulse", STEP, "--set", "output.every=1e-5"]),
                              ("sites", ["chain", STEP, "--set", "chain.scale=1e9"]),
                              ("output.every", ["compare", STEP, "--set", "output.every=1e-5"]),
                              ("--samples", ["event", events, "--samples", "10000000", "--threads", "16"]),
                              ("--draws", ["event", events, "--draws", "100000", "-o", draws])):
            if not limited and command[0] != "chain":
                continue  # a large machine might run it
            done = subprocess.run([PROGRAM, *command], preexec_fn=little_memory if limited else None, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), (command, done.stderr))
            self.assertIn(says, done.stderr)
            self.assertIn("GB", done.stderr)
        self.assertFalse(os.path.exists(draws))


class Signals(CommandLine):
    def ended_by(self, number, arguments, before, environment=None):
        """Sends a signal to a run after before(process), and returns its messages. The run must end soon after the signal."""
        cores = os.cpu_count()
        before_all = processor_time()
        process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
        before(process)
        until_it_answers(process, number)
        used = processor_time_of(process)
        process.send_signal(number)
        _, errors = process.communicate(timeout=PATIENCE)
        self.assertLess(processor_time() - before_all - used, 6 * cores, errors)  # one second, and the time to end
        self.assertEqual((process.returncode, errors.count("\n")), (130, 1), errors)
        return errors

    def test_hang_up_is_like_ctrl_c(self):
        case = self.slow_case()
        out = os.path.join(os.path.dirname(case), "out.nc")
        for number in (signal.SIGHUP, signal.SIGTERM):
            errors = self.ended_by(number, ["pulse", case, "--set", "pulse.cells=2000", "-o", out], lambda process: self.wait_for(out, process))
            self.assertIn("--resume", errors)
            os.remove(out)

    def test_a_signal_at_the_start_ends_the_program(self):
        """Until the program handles signals, they end it. From then on it prints one line and returns an exit code."""
        ends = set()
        for number in (signal.SIGHUP, signal.SIGTERM, signal.SIGINT):
            for trial in range(8):
                process = subprocess.Popen([PROGRAM, "chain", STEP, "--set", "chain.scale=1e6"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                if trial < 7:
                    time.sleep(0.004 * trial)
                else:
                    until_it_answers(process, number)
                process.send_signal(number)
                out, errors = process.communicate(timeout=PATIENCE)
                ends.add(process.returncode)
                self.assertIn((process.returncode, out, errors.count("\n")), ((-number, "", 0), (130, "", 1)), errors)
        self.assertIn(130, ends)

    def test_a_large_chain_ends_during_its_setup(self):
        errors = self.ended_by(signal.SIGINT, ["chain", STEP, "--set", "chain.scale=1e6"], lambda process: until_it_has_worked(process, 0.5))
        self.assertIn("interrupted", errors)

    def test_only_a_file_that_exists_can_be_resumed(self):
        """A large chain has written nothing when it has worked for a second."""
        out = os.path.join(os.path.dirname(self.file("x", "")), "out.nc")
        errors = self.ended_by(signal.SIGINT, ["chain", STEP, "--set", "chain.scale=1e6", "-o", out], lambda process: until_it_has_worked(process, 0.5))
        self.assertEqual("--resume" in errors, os.path.exists(out), errors)

    def test_one_event_with_many_samples_ends(self):
        events = self.file("e.csv", "name,rupture_velocity,slip_velocity\na,3 +- 0.1 km/s,0.5 m/s\n")
        out = os.path.join(os.path.dirname(events), "out.nc")
        for where in (["-o", out], []):
            self.ended_by(signal.SIGINT, ["event", events, "--samples", "9000000", *where], lambda process: until_it_has_worked(process, 0.7))

    def test_python_commands_end(self):
        folder = os.path.dirname(self.file("x", ""))
        self.ended_by(signal.SIGTERM, ["reproduce", "-o", os.path.join(folder, "r")], lambda process: until_it_has_worked(process, 1))
        self.ok("pulse", STEP, *SMALL, "-o", os.path.join(folder, "p.nc"))


class Text(CommandLine):
    HOSTILE = "a\\u001b[31mred\\u009b2J\\u202edlrow\\u0007"

    def assert_harmless(self, text):
        for character in "\x1b\x9b\u202e\x07":
            self.assertNotIn(character, text)

    def test_titles(self):
        case = self.file("t.toml", f'title = "{self.HOSTILE}"\n[initial]\nstress_left = 0.8\nstress_right = 0\n[pulse]\ncells = 16\n[chain]\nscale = 20\n')
        for arguments in (["pulse", case, "--check"], ["pulse", case], ["chain", case, "--check"], ["compare", case, "--check"]):
            out = self.ok(*arguments)
            self.assertIn("red", out)
            self.assert_harmless(out)

    def test_names_of_events_and_files(self):
        events = self.file("e\x1b[2J.csv", "name,rupture_velocity\nred\x1b[31m\u202e,3 km/s\nbad\x1b]0;x\x07,-3 km/s\n")
        done = run("event", events)
        self.assert_harmless(done.stdout + done.stderr)
        self.assertIn("red", done.stdout)
        self.assert_harmless(run("event", events, "--csv").stdout)
        self.assert_harmless(run("event", events, "--json").stdout)
        self.assert_harmless(run("pulse", "/no\x1b[31m.toml").stderr)
        self.assert_harmless(run("plot", "/no\x1b[31m.nc").stderr)

    def test_csv_holds_no_text_that_a_spreadsheet_would_execute(self):
        events = self.file("e.csv", "name,note,rupture_velocity\n=1+cmd|x,@sum,3 km/s\n")
        row = self.ok("event", events, "--csv").splitlines()[1]
        self.assertTrue(row.startswith("\"'=1+cmd|x\""), row)
        self.assertIn("\"'@sum\"", row)


class Inputs(CommandLine):
    def test_one_set_option_takes_several_settings(self):
        together = self.pulse(STEP, "--set", "pulse.cells=16", "time.end=0.5")
        self.assertEqual((together["cells"], together["time"]), (16, 0.5))
        self.assertEqual(self.pulse("--set", "pulse.cells=16", "time.end=0.5", STEP)["cells"], 16)
        self.refused(2, "pulse", STEP, STEP, says=["a second scenario file"])

    def test_a_result_file_is_refused_as_a_scenario(self):
        out = os.path.join(os.path.dirname(self.file("x", "")), "out.nc")
        self.ok("pulse", STEP, *SMALL, "-o", out)
        self.refused(2, "pulse", out, says=["a NetCDF file"])
        self.refused(2, "event", out, says=["NetCDF"])

    def test_tables_that_are_not_regular_files_are_refused(self):
        folder = os.path.dirname(self.file("x", ""))
        os.mkfifo(os.path.join(folder, "pipe.csv"))
        os.symlink("/dev/zero", os.path.join(folder, "zero.nc"))
        for name in ("pipe.csv", "zero.nc"):
            case = os.path.join(folder, "case.toml")
            with open(case, "w", encoding="ascii") as file:
                file.write(f"[initial]\nprofile = 'table'\nfile = '{name}'\n[domain]\nleft = -1\nright = 1\n")
            self.refused(3, "pulse", case, says=["not a regular file"])

    def test_an_invalid_medium_is_reported_once(self):
        for option, value in (("--poisson-ratio", "0.7"), ("--shear-modulus", "-3 GPa"), ("--p-wave-speed", "0 km/s")):
            self.refused(2, "event", f"{option}={value}", says=[option, "out of range"])

    def test_too_many_columns_are_refused(self):
        wide = self.file("wide.csv", ",".join(f"c{i}" for i in range(300000)) + "\n")
        with self.takes_at_most(10):
            self.refused(2, "event", wide, says=["wide.csv:1: more than 10000 columns"])

    def test_a_ring_is_observed_at_its_very_end(self):
        """The end of the domain, moved back by whole periods, lies past the end of the ring by a rounding error. The loop that moves
        it back did not end."""
        case = self.file("ring.toml", "[initial]\nprofile = 'step'\nstress_left = 4\nstress_right = 0.1\n[friction]\nlaw = 'power'\ncoefficient = 1\n"
                         "[time]\nend = 0.855\n[pulse]\ncells = 30\nperiodic = true\n[output]\nevery = 0.7\n")
        done = run("pulse", case, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_files_without_an_end_are_refused(self):
        """Devices and pipes may be read as events and scenarios, but not without an end. The program reads 16 MB of them at most."""
        commands = [["event"], ["event", os.path.join(SOURCE, "cases/parkfield-2004.toml"), "--columns"], ["pulse"], ["chain"], ["plane"], ["compare"], ["units"], ["laboratory", "--poisson-ratio", "0.35", "--s-wave-speed", "1300 m/s"], ["population"],
                    ["sweep", "--vary", "time.end=1,2"]]
        for device in ("/dev/zero", "/dev/urandom"):
            for command in commands[:3] if device == "/dev/urandom" else commands:
                with self.subTest(command=command, device=device), self.takes_at_most(4):
                    self.refused(3, *command, device, says=[device + ": not a text: byte ", " is zero"])
        yes = subprocess.Popen(["yes"], stdout=subprocess.PIPE)
        done = subprocess.run(["prlimit", f"--as={2 << 30}", PROGRAM, "event", "-"], capture_output=True, text=True, stdin=yes.stdout)
        yes.stdout.close()
        yes.wait()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)
        self.assertIn("stdin: more than 0.2", done.stderr)
        self.assertIn("without an end", done.stderr)

    def test_sizes_are_known_before_the_work(self):
        for check in ([], ["--check"]):
            with self.takes_at_most(5):
                self.refused(2, "pulse", STEP, "--set", "output.every=1e-12", *check, says=["output.every"])
            done = subprocess.run(["prlimit", f"--as={4 << 30}", PROGRAM, "pulse", STEP, "--set", "output.every=1e-5", *check], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, "output.every.* need .* GB of memory, this process may have 4.29 GB")
        with self.takes_at_most(10):
            self.ok("pulse", STEP, "--set", "pulse.cells=1000000", "--check")
        self.ok("relations", "--stress", "1:2:1000", "--csv", "--threads", "4096")


if __name__ == "__main__":
    unittest.main()
