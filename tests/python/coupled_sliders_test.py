"""Spring-sliders that are coupled to their neighbours, each with numbers of its own, against scipy's Radau at 1e-8.

A chain of 24 sites on a smooth surface is such a row, and a ring whose sites have two sets of numbers in turn is a pair of them. Random
friction and springs are given by tables. With `--sets N` the test takes N sets of each; it shares no code with slipfront.
"""

import os
import pathlib
import random
import sys
import tempfile
import unittest

import numpy as np
import slipfront
from scipy.integrate import solve_ivp
from scipy.ndimage import label
from scipy.sparse import kron

SETS = int(sys.argv.pop(sys.argv.index("--sets") + 1)) if "--sets" in sys.argv else 2
FRICTION = ("strength", "direct_effect", "evolution_effect", "characteristic_slip", "reference_velocity", "initial_state")
EVENT = 0.01  # slip velocity of an event
PART = 8  # sites of a part of the chain, whose mean velocity decides on events


def random_numbers(chance, count):
    """Friction and springs of each site. The ratio of strength to direct effect is 6 to 13, b - a has both signs, and the
    springs are mostly softer than the critical stiffness."""
    def around(middle, share):
        return np.array([middle * chance.uniform(1 - share, 1 + share) for _ in range(count)])
    a = around(0.01, 0.2)
    stiffness = 0.012 * chance.uniform(0.1, 0.7)
    return {"strength": around(0.09, 0.2), "direct_effect": a, "evolution_effect": a * around(2.2, 0.6),
            "characteristic_slip": around(1, 0.4), "reference_velocity": around(0.01, 0.3),
            "initial_state": around(100, 0.5), "stiffness": around(stiffness, 0.4), "velocity": around(0.001, 0.2)}


def events_of(t, slip, velocity):
    """Onset, peak velocity, mean slip and end of each event, by the rule of docs/loading.md, from means over parts."""
    moves = np.zeros(velocity.shape, bool)
    for i in range(len(t)):
        moves[:, i] = (velocity[:, i] > EVENT) | (moves[:, i - 1] & (velocity[:, i] >= EVENT / 2) if i else False)
    labels, count = label(moves, np.ones((3, 3)))
    found = []
    for event in range(1, count + 1):
        part, at = np.nonzero((labels == event) & (velocity > EVENT))
        first = part[at == at.min()][np.argmax(velocity[part[at == at.min()], at.min()])]
        begin, end = at.min() - 1, np.nonzero((labels == event).any(axis=0))[0][-1] + 2
        onset = np.interp(np.log(EVENT), np.log(velocity[first, begin:begin + 2]), t[begin:begin + 2])
        own = np.isin(labels[:, begin + 1:end], (0, event))
        slipped = (np.diff(slip[:, begin:end]) * own).sum() / len(slip)
        found.append((onset, velocity[part, at].max(), slipped, t[min(end, len(t)) - 1]))
    return np.array(sorted(found)).reshape(-1, 4)


def solved(numbers, matrix, end, times):
    """Slip of the sites at the times, and the events. The variables of a site are slip, friction over a, and ln(theta)."""
    f0, a, b, D, w0, theta0, kappa, pulled = numbers.values()
    count = len(a)

    def split(y):
        u, s, log_theta = y.reshape(count, 3, -1).swapaxes(0, 1)
        f0_, a_, b_, D_, w0_ = (column[:, None] for column in (f0, a, b, D, w0))
        scale = 2 * w0_ * np.exp(-(f0_ + b_ * (log_theta + np.log(w0_ / D_))) / a_)
        return u, s, log_theta, scale, scale * np.sinh(s)

    def rates(t, y):
        u, s, log_theta, scale, v = (column[:, 0] for column in split(y))
        ages = np.exp(-log_theta) - abs(v) / D
        force = matrix @ u + kappa * (pulled * t - u) - a * s
        return np.stack([v, force / (scale * np.cosh(s)) + np.tanh(s) * b / a * ages, ages], axis=1).ravel()

    start = np.stack([np.zeros(count), np.zeros(count), np.log(theta0)], axis=1).ravel()
    sparsity = kron(matrix != 0, np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0]])) + kron(np.eye(count), np.ones((3, 3)))
    answer = solve_ivp(rates, [0, end], start, "Radau", dense_output=True, rtol=1e-8, atol=1e-11, jac_sparsity=sparsity)
    assert answer.success, answer.message
    t = np.unique(np.concatenate([np.linspace(one, other, 6) for one, other in zip(answer.t, answer.t[1:])]))
    u, _, _, _, v = split(answer.sol(t))
    parts = [column.reshape(-1, min(PART, count), len(t)).mean(axis=1) for column in (u, v)]
    return answer.sol(times)[0::3], events_of(t, *parts)


class CoupledSliders(unittest.TestCase):
    def compare(self, numbers, spacing, ring):
        count = len(numbers["stiffness"])
        mean = {name: np.mean(column) for name, column in numbers.items()}
        end = 0.0
        for _ in range(9):  # until the load is about that of steady slip, of contacts as old as the run
            age = end + mean["initial_state"]
            end = (mean["strength"] + mean["evolution_effect"] * np.log(age * 0.01)) / (mean["stiffness"] * mean["velocity"])
        with tempfile.TemporaryDirectory() as folder:
            table = os.path.join(folder, "numbers.csv")
            last = [[spacing * count, *(column[0] for column in numbers.values())]] if ring else []
            rows = [[spacing * i, *(column[i] for column in numbers.values())] for i in range(count)] + last
            text = ",".join(["x", *numbers]) + "\n" + "".join(",".join(map(repr, map(float, row))) + "\n" for row in rows)
            pathlib.Path(table).write_text(text, encoding="utf-8")
            columns = {name: {"file": table, "column": name} for name in numbers}
            case = {"initial": {"stress_left": 0, "stress_right": 0}, "interface": {"contact": 0},
                    "friction": {"law": "rate-and-state", **{name: columns[name] for name in FRICTION}},
                    "loading": {"stiffness": columns["stiffness"], "velocity": columns["velocity"], "event_velocity": EVENT},
                    "domain": {"left": 0, "right": spacing * (count if ring else count - 1)}, "time": {"end": end},
                    "chain": {"scale": 1, "spacing": spacing, "model": "lattice", "tolerance": 1e-7,
                              **({"periodic": True} if ring else {"left": "free", "right": "free"})},
                    "output": {"every": end / 40, "displacement": True}}
            chain = slipfront.chain(case)
        matrix = np.diag(np.full(count, -2.0)) + np.diag(np.ones(count - 1), 1) + np.diag(np.ones(count - 1), -1)
        if ring:
            matrix[0, -1] = matrix[-1, 0] = 1
        else:
            matrix[0, 1] = matrix[-1, -2] = 2
        matrix /= spacing**2
        if ring:  # two sites stand for all
            matrix, numbers = np.array([[-2, 2], [2, -2]]) / spacing**2, {name: column[:2] for name, column in numbers.items()}
        slip, events = solved(numbers, matrix, end, chain["time"].values)
        mine = chain["displacement"].values.T[:len(slip)]
        onset, peak, slipped, ends = events.T
        time = chain["time"].values[:, None]
        quiet = ((time < onset) | (time > ends)).all(axis=1)  # within an event, slip is as uncertain as its onset
        off = [abs(mine - slip)[:, quiet].max() / slip.max()]
        self.assertEqual(chain.sizes.get("event", 0), len(events))
        if len(events):
            off += [abs(chain["event_onset"].values / onset - 1).max(), abs(chain["event_peak_velocity"].values / peak - 1).max(),
                    abs(chain["event_slip"].values - slipped).max() / slipped.max()]
        return off, len(events)

    def check(self, name, sets, least):
        worst = np.zeros(4)
        counts = []
        for off, events in sets:
            worst[:len(off)] = np.maximum(worst[:len(off)], off)
            counts.append(events)
        slip, onset, peak, slipped = 100 * worst
        print(f"{name}: {np.count_nonzero(counts)} of {SETS} sets with {sum(counts)} events; differences at most "
              f"{slip:.2g} % of slip, {onset:.2g} % of onsets, {peak:.2g} % of peaks, {slipped:.2g} % of slip in events")
        self.assertGreaterEqual(np.count_nonzero(counts), least)
        self.assertLess(worst.max(), 1e-3)

    def test_a_chain_of_24_sites(self):
        def one(number):
            chance = random.Random(number)
            return self.compare(random_numbers(chance, 24), 10 ** chance.uniform(0, 1.2), False)
        self.check("24 sites", map(one, range(SETS)), SETS // 2)

    def test_two_coupled_sliders(self):
        def one(number):
            chance = random.Random(1000 + number)
            pair = random_numbers(chance, 2)
            return self.compare({name: np.tile(column, 4) for name, column in pair.items()}, 10 ** chance.uniform(0, 1.5), True)
        self.check("two sliders", map(one, range(SETS)), SETS // 2)


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--sets"])
