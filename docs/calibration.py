"""Calibrates slipfront.event: draws synthetic events from the prior and counts how often the intervals contain the truth.

Usage: calibration.py [--events 1500] [--threads 2] [--seed 1] [--only 1,3] [--samples 1000]

The package slipfront must be on PYTHONPATH. It prints the table of docs/calibration.md: 12 combinations of observations, 1500 events each.
Each combination has its own random numbers, so that any of them can be run again.
"""

import argparse
import dataclasses
import time

import numpy as np

import slipfront
from slipfront import _slipfront

SPEED = float(slipfront.medium.speed_from_p_wave(6000.0, 0.3))  # c of the default constants, m/s
SHEAR_MODULUS = 30e9
PLASTIC = float(slipfront.medium.plastic_contact_ratio(0.3))
LEAST_CONTACT, MOST_DAMPING = 1e-8, 1e8
LEAST_SEEN = 1e-6  # only events whose observed rupture velocity is at least this, over c, are kept
DRAWS, BINS = 199, 10
QUANTITIES = ("contact_ratio", "stress", "stress_pa", "damping_number")


@dataclasses.dataclass
class Error:
    """How an observation is made: a lognormal error with a factor, a normal one with shares of the true value, or a range with a ratio.
    "unrelated" is a normal error whose standard deviation has nothing to do with the true value, and has shares of the observed value."""

    shape: str
    size: tuple

    def observe(self, random, truth):
        """Returns the observed middles, or lower ends, and the texts of the observations."""
        n = len(truth)
        if self.shape == "lognormal":
            seen = truth * np.exp(np.log(self.size[0]) * random.standard_normal(n))
            return seen, [f"{x!r} */ {self.size[0]}" for x in seen.tolist()]
        if self.shape == "normal":
            spread = truth * random.uniform(*self.size, n)
            seen = truth + spread * random.standard_normal(n)
            return seen, [f"{x!r} +- {s!r}" for x, s in zip(seen.tolist(), spread.tolist())]
        if self.shape == "unrelated":
            spread = np.exp(random.uniform(np.log(truth.min() / 100), np.log(truth.max()), n))
            seen = truth + spread * random.standard_normal(n)
            kept = (spread > self.size[0] * seen) & (spread < self.size[1] * seen)
            return np.where(kept, seen, -1), [f"{x!r} +- {s!r}" for x, s in zip(seen.tolist(), spread.tolist())]
        low = truth * self.size[0] ** -random.uniform(size=n)
        return low, [f"{x!r}..{self.size[0] * x!r}" for x in low.tolist()]

    def __str__(self):
        if self.shape in ("normal", "unrelated"):
            return f"{self.shape}, {100 * self.size[0]:.0f} to {100 * self.size[1]:.0f} %"
        return f"{'factor' if self.shape == 'lognormal' else 'range of factor'} {self.size[0]}"


def factor(size):
    return Error("lognormal", (size,))


def shares(least, most):
    return Error("normal", (least, most))


def within(ratio):
    return Error("range", (ratio,))


#: Which rupture velocity was seen, and the errors of the observations. `contact`: normal stress with hardness; `friction`: C with b and T.
COMBINATIONS = (
    ("front", {"rupture_velocity": factor(1.1), "slip_velocity": factor(1.3)}),
    ("front", {"rupture_velocity": factor(1.1), "slip_velocity": factor(1.3), "contact_ratio": factor(1.5)}),
    ("front", {"rupture_velocity": factor(1.1), "slip_velocity": factor(1.3), "stress_drop": factor(1.5)}),
    ("front", {"rupture_velocity": factor(1.1), "slip": factor(1.3), "friction_coefficient": factor(1.5)}),
    ("front", {"rupture_velocity": factor(1.2), "slip_velocity": factor(1.3), "normal_stress": factor(1.3)}),
    ("front", {"rupture_velocity": shares(0.1, 0.6), "slip_velocity": shares(0.1, 0.6)}),
    ("front", {"rupture_velocity": within(1.3), "slip_velocity": within(2), "contact_ratio": within(3)}),
    ("front", {"rupture_velocity": factor(1.1), "stress_drop": factor(1.5)}),
    ("characteristic", {"rupture_velocity": factor(1.1), "slip_velocity": factor(1.3), "contact_ratio": factor(1.5)}),
    ("characteristic", {"rupture_velocity": factor(1.1), "slip_velocity": factor(1.3), "stress_drop": factor(1.5)}),
    ("characteristic", {"rupture_velocity": factor(1.1), "slip": factor(1.3), "friction_coefficient": factor(1.5)}),
    ("characteristic", {"rupture_velocity": shares(0.1, 0.6), "slip_velocity": shares(0.1, 0.6), "contact_ratio": factor(1.5)}),
    # Only with --only 13.
    ("characteristic", {"rupture_velocity": Error("unrelated", (0.1, 0.6)), "slip_velocity": factor(1.2), "contact_ratio": factor(1.5)}),
)
USUAL = range(1, 13)


def prior(random, n):
    """Draws the true states. The prior is uniform in ln|V-| below the largest tabled stress, ln(A) and ln(1 + Gamma). Slower events than
    LEAST_SEEN / 20 are not drawn, because none of them would be kept."""
    most = float(slipfront.relations(stress=3.0).rupture_velocity)
    velocity = np.exp(random.uniform(np.log(LEAST_SEEN / 20), np.log(most), n))
    free = slipfront.relations(rupture_velocity=velocity)
    return {"velocity": velocity, "stress": np.clip(free.stress.values, 0.05, 3), "free": free.slip_velocity.values,
            "contact_ratio": np.exp(random.uniform(np.log(LEAST_CONTACT), np.log(PLASTIC), n)),
            "damping_number": np.expm1(random.uniform(0, np.log1p(MOST_DAMPING), n))}


def predicted(random, truth, which, observed):
    """Returns the true values of all observations, and the columns of what is stated in addition: time, hardness, spacing."""
    n, A, stress, damping = len(truth["stress"]), truth["contact_ratio"], truth["stress"], truth["damping_number"]
    measure = "time-mean" if "slip" in observed else "origin"
    unit = SHEAR_MODULUS * A / np.pi
    truth["stress_pa"] = unit * stress
    values = {"rupture_velocity": SPEED * truth["velocity"], "contact_ratio": A}
    if which == "front":
        values["rupture_velocity"] = values["rupture_velocity"] * _slipfront.front_ratio(stress, damping, 1e-3, "consistent")
    values["slip_velocity"] = SPEED * A / np.pi * truth["free"] * slipfront.friction_ratio(stress, damping, measure=measure).ratio.values
    values["stress_drop"] = unit * stress * _slipfront.stress_drop_share(stress, damping, "consistent")
    # A stated duration or hardness is the middle of its distribution, from which the truth is drawn.
    stated = np.exp(random.uniform(0, np.log(1e6), n))
    duration = stated * np.exp(np.log(1.2) * random.standard_normal(n))
    hardness = 1e10 * np.exp(np.log(1.2) * random.standard_normal(n))
    more = {}
    if "normal_stress" in observed:
        more["hardness"] = ["1e10 */ 1.2 Pa"] * n
    if "slip" in observed:
        more["duration"] = [f"{x!r} */ 1.2 s" for x in stated.tolist()]
        more["asperity_spacing"] = ["1 m"] * n
    values["normal_stress"] = A * hardness / PLASTIC
    values["slip"] = values["slip_velocity"] * duration
    values["friction_coefficient"] = damping / (duration * SPEED * A)
    return values, more


UNITS = {"rupture_velocity": "m/s", "slip_velocity": "m/s", "slip": "m", "stress_drop": "Pa", "normal_stress": "Pa"}


def synthetic(random, events, which, errors):
    """Returns the table of `events` synthetic events as CSV, and their truth. Which events are kept depends on their observations only: the
    rupture velocity is between LEAST_SEEN c and c, and every observed number is positive."""
    truth = prior(random, 40 * events)
    values, columns = predicted(random, truth, which, errors)
    keep = np.ones(len(truth["stress"]), bool)
    for name, error in errors.items():
        seen, texts = error.observe(random, values[name])
        columns[name] = [f"{text} {UNITS.get(name, '')}".strip() for text in texts]
        keep &= seen > 0
        if name == "rupture_velocity":
            keep &= (seen >= LEAST_SEEN * SPEED) & (seen * (error.size[0] if error.shape == "range" else 1) < SPEED)
        if name == "contact_ratio":
            keep &= seen * (error.size[0] if error.shape == "range" else 1) < PLASTIC
    chosen = np.flatnonzero(keep)[:events]
    if len(chosen) < events:
        raise RuntimeError(f"only {len(chosen)} of {events} synthetic events can be kept")
    lines = ["name,rupture_velocity_is," + ",".join(columns)]
    lines += [f"e{i},{which}," + ",".join(texts[i] for texts in columns.values()) for i in chosen]
    return "\n".join(lines) + "\n", {name: x[chosen] for name, x in truth.items()}


def compared(data, truth):
    """Returns for each quantity: the share of events with an interval, the coverage of the intervals, and the counts of the ranks."""
    rows = {}
    for name in QUANTITIES:
        low, high = data[f"{name}_interval"].values.T
        known = np.isfinite(low) & np.isfinite(high)
        inside = ((low <= truth[name]) & (truth[name] <= high))[known]
        rank = (data[f"draw_{name}"].values < truth[name][:, None]).sum(axis=1)[known]
        rows[name] = known.mean(), inside.mean() if known.any() else np.nan, np.bincount(rank * BINS // (DRAWS + 1), minlength=BINS)
    return rows


def probability(counts):
    """Returns the probability that equally likely ranks are at least as uneven as these (chi-square)."""
    from scipy.special import gammaincc

    expected = counts.sum() / len(counts)
    return float(gammaincc((len(counts) - 1) / 2, ((counts - expected) ** 2 / expected).sum() / 2)) if expected else np.nan


def calibrate(number, options):
    """Returns the rows of combination `number`, and the seconds that the sampling took."""
    which, errors = COMBINATIONS[number - 1]
    table, truth = synthetic(np.random.default_rng([30, options.seed, number]), options.events, which, errors)
    began = time.monotonic()
    data = slipfront.event(table, draws=DRAWS, threads=options.threads, seed=options.seed, samples=options.samples)
    return compared(data, truth), time.monotonic() - began


def described(number):
    which, errors = COMBINATIONS[number - 1]
    return which + ": " + "; ".join(f"{name} ({error})" for name, error in errors.items())


def arguments(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value in (("events", 1500), ("threads", 2), ("seed", 1), ("samples", 1000)):
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--only", type=lambda text: [int(number) for number in text.split(",")], default=USUAL,
                        help="numbers of the combinations, such as 1,3 (default: 1 to 12)")
    return parser.parse_args(argv)


def main(argv=None):
    options = arguments(argv)
    print(f"{options.events} events each\n")
    print("| no. | " + " | ".join(QUANTITIES) + " | with interval | uniform ranks, p | time, s |\n" + "|---" * (len(QUANTITIES) + 4) + "|")
    counts, names = {}, []
    for number in options.only:
        rows, seconds = calibrate(number, options)
        counts[number] = rows
        coverage = " | ".join(f"{rows[name][1]:.3f}" for name in QUANTITIES)
        uniform = " ".join(f"{probability(rows[name][2]):.2g}" for name in QUANTITIES)
        print(f"| {number} | {coverage} | {min(row[0] for row in rows.values()):.4f} | {uniform} | {seconds:.0f} |", flush=True)
        names.append(f"{number}. {described(number)}")
    print("\n" + "\n".join(names))
    missed = [f"{number} {name} {rows[name][1]:.3f}" for number, rows in counts.items() for name in QUANTITIES if not 0.885 <= rows[name][1] <= 0.915]
    print(f"\noutside 0.885 to 0.915: {len(missed)} of {len(counts) * len(QUANTITIES)}" + "".join(f", {text}" for text in missed))
    for number, rows in counts.items():
        for name in QUANTITIES:
            if probability(rows[name][2]) < 0.01:
                print(f"ranks of {name} in {number}: " + " ".join(map(str, rows[name][2])))


if __name__ == "__main__":
    main()
