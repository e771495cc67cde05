"""The tables of growth of ./run bench: how times and memory grow with sites, threads, ranks, cells, runs and events.

An exponent p is the slope of log(time) over log(size), by least squares over the larger half of the sizes: the time of twice the
size is 2^p times as long."""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time

SITES = (1000, 10_000, 100_000, 1_000_000, 10_000_000)
BYTES_A_SITE = 16  # two levels of doubles
SCALES = (30, 100, 300, 1000, 3000)
CELLS = (50, 100, 200, 400, 800, 1600, 3200, 6400)
COUNTS = (10, 100, 1000)
RANKS = (1, 2, 4, 8)
LEVELS = 32  # between two exchanges
LATENCY = 2e-6  # seconds of a message between machines that we assume
ESTIMATES = ((16, 1e8), (256, 1e8), (256, 1e9), (4096, 1e9))
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}


def run(command, **more):
    """Output, seconds and largest memory in bytes of a command."""
    with tempfile.TemporaryFile("w+") as out:
        begun = time.perf_counter()
        process = subprocess.Popen(list(map(str, command)), stdout=out, stderr=subprocess.PIPE, text=True, **more)
        errors = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.perf_counter() - begun
        process.stderr.close()
        if process.returncode:
            raise subprocess.CalledProcessError(process.returncode, command, stderr=errors)
        out.seek(0)
        return out.read(), seconds, usage.ru_maxrss * 1024


def exponent(sizes, times):
    half = len(sizes) // 2
    x, y = [math.log(s) for s in sizes[half:]], [math.log(t) for t in times[half:]]
    centre, mean = sum(x) / len(x), sum(y) / len(y)
    return sum((a - centre) * (b - mean) for a, b in zip(x, y)) / sum((a - centre) ** 2 for a in x)


def print_table(title, sizes, columns):
    """Prints columns of times by name, and the exponents in the last row."""
    print(f"\nSeconds, and p of time = size^p for the larger half of the sizes\n\n| {title} | " + " | ".join(columns) + " |\n|---|" + "---|" * len(columns))
    for i, size in enumerate(sizes):
        print(f"| {size:,} | " + " | ".join(f"{times[i]:.3g}" for times in columns.values()) + " |")
    print("| exponent | " + " | ".join(f"{exponent(sizes, t):.2f}" for t in columns.values()) + " |", flush=True)


def site_rate(command, **more):
    """G site updates a second that chain_ranks prints, and its memory."""
    out, _, memory = run(command, **more)
    return float(re.findall(r"([\d.]+) G site", out)[0]), memory


def print_sites(folder, long):
    """Returns the rate of one thread with a million sites."""
    print("\nTime steps of a chain with viscous friction, best of seven; memory of the whole program, and what a site adds\n")
    print("| sites | one thread, G site updates a second | two threads | memory, MB | bytes a site |\n|---|---|---|---|---|")
    rates, empty = {}, site_rate([folder / "chain_ranks", 1, 64])[1]
    for sites in SITES + ((100_000_000,) if long else ()):
        (one, memory), (two, _) = (site_rate([folder / "chain_ranks", threads, sites]) for threads in (1, 2))
        rates[sites] = one
        print(f"| {sites:,} | {one:.3g} | {two:.3g} | {memory / 1e6:.0f} | {(memory - empty) / sites:.0f} |", flush=True)
    for sites in (100_000_000, 1_000_000_000):
        if sites not in rates:
            seconds = sites / rates[SITES[-1]] / 1e9
            print(f"| {sites:,} | estimate: {seconds:.3g} s a step | {seconds / 2:.2g} s a step | "
                  f"{sites * BYTES_A_SITE / 1e6:,.0f} | {BYTES_A_SITE} |")
    steps = [sites / rate for sites, rate in rates.items()]
    print(f"\nThe time of a step is sites^p with p = {exponent(list(rates), steps):.2f} (one thread).")
    return rates[1_000_000]


def print_whole_runs(program, scenario, runs):
    chains = []
    for scale in SCALES:
        command = [program, "chain", scenario, "--json", "--quiet", "--threads", 1, "--set", f"chain.scale={scale}"]
        chains.append(min(run(command)[1] for _ in range(runs)))
    print_table("scale of a chain", SCALES, {"whole run, one thread": chains})
    solve, whole = [], []
    for cells in CELLS:
        command = [program, "pulse", scenario, "--json", "--quiet", "--threads", 1, "--set", f"pulse.cells={cells}",
                   "friction.law=viscous", "friction.coefficient=0.5"]
        found = [run(command)[:2] for _ in range(runs)]
        solve.append(min(json.loads(out)["solve_seconds"] for out, _ in found))
        whole.append(min(seconds for _, seconds in found))
    print_table("cells of a pulse", CELLS, {"time steps": solve, "whole run": whole})


def print_batches(program, scenario, runs):
    columns = {f"{what}, {threads}": [] for what in ("sweep", "catalogue") for threads in ("one thread", "two threads")}
    for count in COUNTS:
        catalogue = pathlib.Path(scenario).with_name("events.csv")
        rows = (f"e{i},{2 + 0.8 * i / count:.4f},0.2,{0.1 + 0.5 * i / count:.4f}" for i in range(count))
        catalogue.write_text("name,rupture velocity (km/s),rupture velocity uncertainty (km/s),slip velocity (m/s)\n" + "\n".join(rows))
        sweep = [program, "sweep", scenario, "--set", "friction.law=viscous", "--vary", f"friction.coefficient=0.01:2:{count}"]
        for what, command in (("sweep", sweep), ("catalogue", [program, "event", catalogue])):
            for threads in (1, 2):
                words = [*command, "--json", "--quiet", "--threads", threads]
                least = min(run(words)[1] for _ in range(1 if count > 500 else runs))
                columns[f"{what}, {'one thread' if threads == 1 else 'two threads'}"].append(least)
    print_table("pulses of a sweep, events of a catalogue", COUNTS, columns)


def messages(folder):
    """Messages and bytes that rank 1 of 4 sends in 32 steps, as OpenMPI counts them, or None."""
    with tempfile.TemporaryDirectory() as out:
        monitor = {"OMPI_MCA_pml_monitoring_enable": "1", "OMPI_MCA_pml_monitoring_enable_output": "3",
                   "OMPI_MCA_pml_monitoring_filename": f"{out}/rank"}
        run(["mpirun", "-n", 4, folder / "chain_ranks", 1, 1_000_000], env={**os.environ, **MPI, **monitor})
        files = list(pathlib.Path(out).glob("*.1.prof"))
        rows = [line.split() for line in files[0].read_text().splitlines() if line.startswith("E")] if files else []
    if not rows:
        return None
    exchanges = 7 * 10_000_000 // 1_000_000  # chain_ranks makes so many
    return sum(int(r[5]) for r in rows) / exchanges, sum(int(r[3]) for r in rows) / exchanges


def print_ranks(program, folder, scenario, rate):
    print("\nA chain of a million sites on ranks of one thread; equal: all numbers of a whole run at scale 100 are those of one rank\n\n| ranks | G site updates a second | equal |\n|---|---|---|")
    reference = None
    for ranks in RANKS:
        mpirun, more = ["mpirun", "-n", ranks], {"env": {**os.environ, **MPI}}
        found = site_rate([*mpirun, folder / "chain_ranks", 1, 1_000_000], **more)[0]
        command = [*mpirun, program, "chain", scenario, "--json", "--quiet", "--threads", 1, "--set", "chain.scale=100"]
        numbers = json.loads(run(command, **more)[0])
        numbers = {k: v for k, v in numbers.items() if k not in ("ranks", "threads", "wall_seconds", "site_updates_per_second")}
        reference = reference or numbers
        print(f"| {ranks} | {found:.3g} | {'yes' if numbers == reference else 'no'} |", flush=True)
    sent = messages(folder)
    if not sent:
        print("Messages are not counted: this MPI has no monitoring component.")
        return
    print(f"\nRank 1 of 4 sends {sent[0]:.1f} messages with {sent[1]:.0f} bytes in {LEVELS} steps. If a message takes "
          f"{LATENCY * 1e6:.0f} microseconds\nand each rank reaches {rate:.3g} G, a cluster would reach (estimate):")
    print("\n| ranks | sites | G site updates a second | share of time that is not messages or halos |\n|---|---|---|---|")
    for ranks, sites in ESTIMATES:
        compute = LEVELS * sites / ranks / rate / 1e9
        halos = LEVELS * LEVELS / rate / 1e9  # on average 16 more sites at either end
        whole = compute + halos + LATENCY * (2 + 2 * math.log2(ranks))
        print(f"| {ranks} | {sites:.0e} | {LEVELS * sites / whole / 1e9:,.0f} | {compute / whole:.3f} |")


def print_growth(program, scenario, runs, long):
    folder = pathlib.Path(program).parent
    rate = None
    if (folder / "chain_ranks").exists():
        rate = print_sites(folder, long)
    else:
        print("\nSites and ranks are left out: chain_ranks was not built")
    print_whole_runs(program, scenario, runs)
    print_batches(program, scenario, runs)
    if rate and shutil.which("mpirun"):
        print_ranks(program, folder, scenario, rate)
    elif rate:
        print("\nRanks are left out: there is no mpirun")
