"""Calibrates slipfront.population: draws synthetic populations from the prior and counts how often the intervals contain the truth.

Usage: population_calibration.py [--populations 100] [--events 20] [--studies 5] [--steps 250] [--processes 2] [--first 0] [--no-selection]

The package slipfront must be on PYTHONPATH. Each population has its own seed, so that any of them can be run again. It prints the table
of docs/population.md and, with --ranks, the ranks of the truth. 100 populations take half an hour or more on two cores.
"""

import argparse
import math
import multiprocessing
import os
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

import numpy as np  # noqa: E402

from slipfront._population import priors, sample, synthetic  # noqa: E402
from slipfront._population.likelihood import Likelihood  # noqa: E402

LOG_HARDNESS = math.log(1e10)
SMALLEST = -20.0  # smallest detected ln(pi P / (c T)^2), near what the medians of the prior predict


def rank(job):
    """Returns (seed, ranks of the true parameters among the draws, ranks of the true ln(A) of some events, R-hat, seconds) of one population."""
    seed, options = job
    generator = np.random.default_rng([20, seed])
    events = synthetic.design(generator, options.events, options.studies, smallest=-np.inf if options.no_selection else SMALLEST, threshold=options.threshold)
    truth = synthetic.parameters(generator, events, LOG_HARDNESS)
    synthetic.observe(generator, events, truth, LOG_HARDNESS)
    began = time.monotonic()
    draws = sample.sample(Likelihood(events, LOG_HARDNESS), options.steps, seed)
    return seed, (draws.values < truth).mean(axis=0), draws.rhat, draws.effective, time.monotonic() - began


def report(results):
    """Prints the table: populations whose 90 % interval contains the truth, and the mean of the ranks."""
    ranks = np.array([result[1] for result in results])
    print("| parameter | inside the 90 % interval | below it | above it | mean rank | in 4 quarters |\n|---|---|---|---|---|---|")
    for i, name in enumerate(priors.NAMES):
        r = ranks[:, i]
        quarters = np.histogram(r, bins=4, range=(0, 1))[0]
        print(f"| `{name}` | {((r >= 0.05) & (r <= 0.95)).sum()} of {len(r)} | {(r < 0.05).sum()} | {(r > 0.95).sum()} | {r.mean():.3f} | {' '.join(map(str, quarters))} |")
    print(f"largest R-hat {max(result[2] for result in results):.3f}, fewest independent draws {min(result[3] for result in results):.0f}, "
          f"median time {np.median([result[4] for result in results]):.0f} s")


def arguments(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value in (("populations", 100), ("events", 20), ("studies", 5), ("steps", 250), ("processes", 2), ("first", 0)):
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--threshold", type=float, default=1e-3, help="of the observer of the front; 0: |V-|")
    parser.add_argument("--no-selection", action="store_true")
    parser.add_argument("--ranks", action="store_true", help="print the ranks of each population")
    return parser.parse_args(argv)


def main():
    options = arguments()
    jobs = [(seed, options) for seed in range(options.first, options.first + options.populations)]
    results = []
    with multiprocessing.Pool(options.processes) as pool:
        for result in pool.imap_unordered(rank, jobs):
            results.append(result)
            if options.ranks:
                print(result[0], " ".join(f"{r:.3f}" for r in result[1]), f"R-hat {result[2]:.3f}", f"{result[4]:.0f} s", flush=True)
    report(results)


if __name__ == "__main__":
    main()
