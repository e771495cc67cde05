#!/usr/bin/python3
"""Measures how often the stated errors of pulse runs hold, and lists the runs that end with exit code 4.

Usage: coverage.py [--count 200] [--seed 1] [--jobs N] [--misses KEY] [--number N]

Scenario i of a seed has the number seed * 1000000 + i. `scenarios.make_wide` makes it, with 100 to 200 cells. Each scenario
runs with its cells and with four times as many. A stated error holds if it is at least the difference of the two values. The
script prints for every scalar how many of its stated errors hold. With --refusals it runs each scenario once. It lists the
runs that do not end with exit code 0, and how those with exit code 4 end with four times the cells.
"""

import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import sys

import scenarios
from program import Failed, run

OF_THE_COMPUTATION = {"closure", "cells", "steps", "time", "solve_seconds", "wall_seconds", "conservation_error"}
ROUNDING = 1e-12  # relative to the value; for energies, to the elastic energy


def both(number):
    """The scenario, its run, and the run with four times the cells. A failed run is replaced by the text of its error."""
    s = scenarios.make_wide(number)
    runs = []
    for more in (1, 4):
        try:
            runs.append(run(scenarios.changed(s, pulse_cells=more * s["pulse"]["cells"])))
        except Failed as failure:
            runs.append(f"exit {failure.code}: {failure}")
            if more == 1 and failure.code != 4:
                break
    return number, s, runs


def ending(number):
    """How the run of a scenario ends and, if it ends with exit code 4, how the run with four times the cells ends."""
    s = scenarios.make_wide(number)
    for more in (1, 4):
        try:
            run(scenarios.changed(s, pulse_cells=more * s["pulse"]["cells"]))
            end = "runs"
        except Failed as failure:
            end = f"exit {failure.code}: {failure}"
        if more == 1 and not end.startswith("exit 4"):
            return number, end, ""
        if more == 1:
            first = end
    return number, first, end


def compared(coarse, fine):
    """For each scalar with a stated error: its value, the value with more cells, the stated error, and whether it holds."""
    for key, stated in coarse.errors.items():
        value, right = coarse.summary[key], fine.summary.get(key, math.nan)
        if key in OF_THE_COMPUTATION or isinstance(value, str) or math.isnan(stated) or math.isnan(right):
            continue
        size = coarse.summary["energy_elastic"] if key.startswith("energy") else abs(value)
        yield key, value, right, stated, abs(value - right) <= stated + ROUNDING * size


def refusals(numbers, jobs):
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        ended = collections.Counter()
        for number, end, with_more in pool.map(ending, numbers):
            ended[end.split(":")[0]] += 1
            if end != "runs":
                print(f"{number} {end}" + (f"; with four times the cells {with_more}" if with_more else ""), flush=True)
    print(", ".join(f"{count} {kind}" for kind, count in ended.most_common()))
    return int(ended["exit 4"] > 0)


def coverage(numbers, jobs, misses, log):
    held, stated_of, worst = collections.Counter(), collections.Counter(), {}
    ran = 0
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        for number, _, runs in pool.map(both, numbers):
            if len(runs) < 2 or any(isinstance(r, str) for r in runs):
                continue
            ran += 1
            for key, value, right, stated, holds in compared(*runs):
                stated_of[key] += 1
                held[key] += holds
                ratio = abs(value - right) / stated if stated > 0 else math.inf
                if log:
                    log.write(json.dumps([number, key, value, right, stated, holds]) + "\n")
                if holds:
                    continue
                worst[key] = max(worst.get(key, (0, 0)), (ratio, number))
                if key in misses:
                    print(f"{number} {key} {value:.6g}, four times the cells {right:.6g}, stated {stated:.3g}", flush=True)
    print(f"{ran} of {len(numbers)} scenarios ran with both numbers of cells")
    for key in sorted(stated_of):
        share = held[key] / stated_of[key]
        note = f"worst {worst[key][0]:.3g} times the stated error in {worst[key][1]}" if key in worst else ""
        print(f"{key:<28}{held[key]:>5} of {stated_of[key]:<5}{100 * share:6.1f} %  {note}")
    return int(any(held[key] < 0.95 * stated_of[key] for key in stated_of))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--number", type=int, help="one scenario: its text, and its scalars")
    parser.add_argument("--refusals", action="store_true", help="list the runs that end with another code than 0")
    parser.add_argument("--misses", nargs="*", default=[], help="scalars whose misses are listed")
    parser.add_argument("--log", type=pathlib.Path, help="file for every comparison, a JSON array a line")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    a = parser.parse_args()
    if a.number is not None:
        _, s, runs = both(a.number)
        print(scenarios.text(s))
        if any(isinstance(r, str) for r in runs):
            print(*[r if isinstance(r, str) else "runs" for r in runs], sep="\n")
            return 1
        for key, value, right, stated, holds in compared(*runs):
            print(f"{'' if holds else 'MISSED ':<8}{key:<28}{value:<14.8g}{right:<14.8g} stated {stated:.3g}")
        return 0
    numbers = range(a.seed * 1000000, a.seed * 1000000 + a.count)
    if a.refusals:
        return refusals(numbers, a.jobs)
    if a.log is None:
        return coverage(numbers, a.jobs, a.misses, None)
    with a.log.open("w", encoding="utf-8") as log:
        return coverage(numbers, a.jobs, a.misses, log)


if __name__ == "__main__":
    sys.exit(main())
