"""Pulses and chains that the reproduction needs: each is run once, side by side on all cores."""

import concurrent.futures
import math

import slipfront

CASES = slipfront.cases
CLOSURES = ("paper", "consistent")

#: Scale of the chains: so many times the dislocations, which takes half a second each.
SCALE = 400


def frozen(case, changes):
    """The key of a run."""
    return case, tuple(sorted(changes.items()))


def pulse_of(case, changes):
    """A run of the pulse solver."""
    return slipfront.pulse(str(CASES / case), set=changes, errors=False)


def chain_of(case, changes):
    """A run that follows every dislocation, on one core."""
    return slipfront.chain(str(CASES / case), set={"chain.scale": SCALE} | changes, threads=1)


class Runs:
    """Runs by case file and changes, kept.

    threads: how many at the same time. tell: called with a text before each group of runs.
    """

    def __init__(self, threads, tell):
        self.threads, self.tell, self.done, self.swept = threads, tell, {}, 0

    def pulse(self, case, changes=None):
        """One run of a file of cases/, with {"table.key": value} changed."""
        return self.many("", [(case, changes or {})])[0]

    def many(self, what, wanted):
        """Runs of the pulse solver, in the order of `wanted`: (case, changes) each."""
        return self._each(what, "pulses", pulse_of, wanted)

    def chains(self, what, wanted):
        """Runs of the chain, in the order of `wanted`. Its friction knows no closure."""
        return self._each(what, "chains", chain_of, wanted)

    def _each(self, what, kind, solve, wanted):
        missing = {(kind, *frozen(*run)): run for run in wanted if (kind, *frozen(*run)) not in self.done}
        if missing:
            self.tell(f"{what}: {len(missing)} {kind}" if what else f"{len(missing)} {kind}")
            workers = concurrent.futures.ThreadPoolExecutor(self.threads)
            try:
                self.done.update(zip(missing, workers.map(lambda run: solve(*run), missing.values())))
            finally:  # after an error or an interruption nothing is left to wait for
                workers.shutdown(wait=False, cancel_futures=True)
        return [self.done[(kind, *frozen(*run))] for run in wanted]

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
