"""Runs the pulses and chains of the reproduction once each, on all cores."""

import concurrent.futures
import math

import slipfront

CASES = slipfront.cases
CLOSURES = ("paper", "consistent")

#: Scale of the chains, the factor by which they have more dislocations. A run takes half a second.
SCALE = 400


def frozen(case, changes):
    return case, tuple(sorted(changes.items()))


def pulse_of(case, changes):
    return slipfront.pulse(str(CASES / case), set=changes, errors=False)


def chain_of(case, changes):
    """Runs the chain, which resolves every dislocation, on one core."""
    return slipfront.chain(str(CASES / case), set={"chain.scale": SCALE} | changes, threads=1)


class Runs:
    """Runs scenarios and stores the results by case file and changes.

    `threads`: number of runs at the same time. `tell`: function that is called with a text before
    each group of runs.
    """

    def __init__(self, threads, tell):
        self.threads, self.tell, self.done, self.swept = threads, tell, {}, 0

    def pulse(self, case, changes=None):
        """Runs a scenario of cases/ with {"table.key": value} in place of its values."""
        return self.many("", [(case, changes or {})])[0]

    def many(self, what, wanted):
        """Returns runs of the pulse solver, of a list of (case, changes) in its order."""
        return self._each(what, "pulses", pulse_of, wanted)

    def chains(self, what, wanted):
        """Returns runs of the chain, like `many`. The friction of a chain has no closure."""
        return self._each(what, "chains", chain_of, wanted)

    def _each(self, what, kind, solve, wanted):
        missing = {(kind, *frozen(*run)): run
                   for run in wanted if (kind, *frozen(*run)) not in self.done}
        if missing:
            self.tell(f"{what}: {len(missing)} {kind}" if what else f"{len(missing)} {kind}")
            workers = concurrent.futures.ThreadPoolExecutor(self.threads)
            try:
                self.done.update(zip(missing,
                                     workers.map(lambda run: solve(*run), missing.values())))
            finally:  # after an error or an interruption we do not wait for the other runs
                workers.shutdown(wait=False, cancel_futures=True)
        return [self.done[(kind, *frozen(*run))] for run in wanted]

    def sweep(self, what, case, axes, changes, variables):
        """Returns numbers at the end of the runs of a grid. Raises NumericsError if one failed."""
        self.tell(f"{what}: {math.prod(len(values) for values in axes.values())} pulses")
        data = slipfront.sweep(CASES / case, axes, variables=variables, set=changes,
                               threads=self.threads)
        failures = [text for text in data["failure"].values.ravel() if text]
        if failures:
            raise slipfront.NumericsError(failures[0])
        self.swept += data["failure"].size
        return data[variables]


def at_origin(pulse, name="slip_velocity_at_origin"):
    """Returns the value of a quantity at the last output time."""
    return float(pulse[name][-1])
