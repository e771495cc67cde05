"""Spring-sliders that are coupled to their neighbours, each with numbers of its own, against scipy's Radau at 1e-8.

A chain of 64 sites on a smooth surface is such a row, and a ring whose sites have two sets of numbers in turn is a pair of them. Random
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
from scipy.sparse import lil_matrix

SETS = int(sys.argv.pop(sys.argv.index("--sets") + 1)) if "--sets" in sys.argv else 10
FRICTION = ("strength", "direct_effect", "evolution_effect", "characteristic_slip", "reference_velocity", "initial_state")
EVENT = 0.01  # slip velocity of an event
PART = 8  # sites of a part of the chain, whose mean velocity decides on events


def random_numbers(chance, count):
    """Friction and springs of each site. The ratio of strength to direct effect is 4 to 9, and b - a has both signs."""
    def around(middle, share):
        return np.array([middle * chance.uniform(1 - share, 1 + share) for _ in range(count)])
    a = around(0.01, 0.2)
    stiffness = 0.004 * chance.uniform(0.3, 1.2)
    return {"strength": around(0.06, 0.2), "direct_effect": a, "evolution_effect": a * around(1.6, 0.6), "characteristic_slip": around(1, 0.4),
            "reference_velocity": around(0.01, 0.3), "initial_state": around(100, 0.5),
            "stiffness": around(stiffness, 0.4), "velocity": around(0.001, 0.2)}


def solved(numbers, couple, matrix, end, times, event):
    """Slip at the times, the largest mean velocity of a part, and the time at which one first exceeds `event`."""
    f0, a, b, D, w0, theta0, kappa, pulled = numbers.values()
    count = len(a)

    def rates(t, y):
        u, v, log_theta = y.reshape(count, 3).T
        scale = np.exp((f0 + b * (log_theta + np.log(w0 / D))) / a) / (2 * w0)
        force = kappa * (pulled * t - u) - a * np.arcsinh(v * scale)
        return np.stack([v, couple(u) + force, np.exp(-log_theta) - abs(v) / D], axis=1).ravel()

    start = np.stack([np.zeros(count), np.zeros(count), np.log(theta0)], axis=1).ravel()
    sparsity = lil_matrix(np.kron(matrix != 0, np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0]])) + np.kron(np.eye(count), np.ones((3, 3))))
    answer = solve_ivp(rates, [0, end], start, "Radau", dense_output=True, rtol=1e-8, atol=1e-11, jac_sparsity=sparsity)
    t = np.unique(np.concatenate([np.linspace(one, other, 6) for one, other in zip(answer.t, answer.t[1:])]))
    means = answer.sol(t)[1::3].reshape(-1, min(PART, count), len(t)).mean(axis=1).max(axis=0)
    onset = np.interp(np.log(event), np.log(np.maximum.accumulate(np.maximum(means, 1e-30))), t) if means.max() > event else None
    return answer.sol(times)[0::3], means.max(), onset


class CoupledSliders(unittest.TestCase):
    def compare(self, numbers, spacing, ring):
        count = len(numbers["stiffness"])
        end = 1.5 * 0.06 / (np.mean(numbers["stiffness"]) * 0.001)
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
        slip, peak, onset = solved(numbers, lambda u: matrix @ u, matrix, end, chain["time"].values, EVENT)
        mine = chain["displacement"].values.T[:len(slip)]
        off = [abs(mine - slip).max() / slip.max()]
        if onset is not None:
            self.assertGreater(chain.sizes.get("event", 0), 0)
            off += [abs(float(chain["event_onset"][0]) / onset - 1), abs(float(chain["event_peak_velocity"].max()) / peak - 1)]
        else:
            self.assertEqual(chain.sizes.get("event", 0), 0)
        return off

    def check(self, name, sets, least_events):
        worst = np.zeros(3)
        events = 0
        for off in sets:
            worst[:len(off)] = np.maximum(worst[:len(off)], off)
            events += len(off) > 1
        print(f"{name}: {events} of {SETS} sets with events; differences at most {100 * worst[0]:.2g} % of slip, {100 * worst[1]:.2g} % of onsets, "
              f"{100 * worst[2]:.2g} % of peaks")
        self.assertGreaterEqual(events, least_events)
        self.assertLess(worst.max(), 1e-3)

    def test_a_chain_of_64_sites(self):
        def one(number):
            chance = random.Random(number)
            return self.compare(random_numbers(chance, 64), 10 ** chance.uniform(0, 1.2), False)
        self.check("64 sites", map(one, range(SETS)), SETS // 10)

    def test_two_coupled_sliders(self):
        def one(number):
            chance = random.Random(1000 + number)
            pair = random_numbers(chance, 2)
            return self.compare({name: np.tile(column, 4) for name, column in pair.items()}, 10 ** chance.uniform(0, 1.5), True)
        self.check("two sliders", map(one, range(SETS)), SETS // 30)


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--sets"])
