"""Pulses that the reproduction needs: each is run once, side by side on all cores."""

import concurrent.futures
import math

import slipfront

CASES = slipfront.cases
CLOSURES = ("paper", "consistent")


def frozen(case, changes):
    """The key of a run."""
    return case, tuple(sorted(changes.items()))


class Runs:
    """Runs of the pulse solver by case file and changes, kept.

    threads: how many at the same time. tell: called with a text before each group of runs.
    """

    def __init__(self, threads, tell):
        self.threads, self.tell, self.done, self.swept = threads, tell, {}, 0

    def pulse(self, case, changes=None):
        """One run of a file of cases/, with {"table.key": value} changed."""
        return self.many("", [(case, changes or {})])[0]

    def many(self, what, wanted):
        """Runs, in the order of `wanted`: (case, changes) each."""
        missing = {frozen(*run): run for run in wanted if frozen(*run) not in self.done}
        if missing:
            self.tell(f"{what}: {len(missing)} pulses" if what else f"{len(missing)} pulses")
            with concurrent.futures.ThreadPoolExecutor(self.threads) as workers:
                results = workers.map(lambda run: slipfront.pulse(str(CASES / run[0]), set=run[1]), missing.values())
                self.done.update(zip(missing, results))
        return [self.done[frozen(*run)] for run in wanted]

    def sweep(self, what, case, axes, changes, variables):
        """Numbers at the end of the runs of a grid, {"table.key": values}. Raises NumericsError if one failed: the paper is reproduced whole."""
        self.tell(f"{what}: {math.prod(len(values) for values in axes.values())} pulses")
        data = slipfront.sweep(CASES / case, axes, variables=variables, set=changes, threads=self.threads)
        failures = [text for text in data["failure"].values.ravel() if text]
        if failures:
            raise slipfront.NumericsError(failures[0])
        self.swept += data["failure"].size
        return data[variables]


def at_origin(pulse, name="slip_velocity_at_origin"):
    """A quantity over time, at the last time."""
    return float(pulse[name][-1])
