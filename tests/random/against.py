"""The pulse against its second opinions: the slow solvers of tests/reference, and the library's chain."""

import math
import pathlib
import re
import sys

import numpy as np

import loaded_block
import scenarios
from program import Failed, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "reference"))
import slow_chain  # noqa: E402
import slow_pulse  # noqa: E402

SPARSEST = 0.0045  # stress that the program takes for none
# A coarser grid pins dislocations (Peierls & Nabarro, exp(-pi^2 / h)) that a gradual change of stress pushes.
FINE = {"chain_spacing": 0.35}


def function(formula, *variables):
    """A formula of a scenario as a Python function of arrays."""
    chosen = re.fullmatch(r"([^?]*)\?([^:]*):(.*)", formula)
    text = f"np.where({chosen[1]}, {chosen[2]}, {chosen[3]})" if chosen else formula
    names = {name: getattr(np, name) for name in ("exp", "sin", "cos", "tanh", "abs")}
    code = compile(text.replace("^", "**"), formula, "eval")

    def call(*values):
        return eval(code, {"np": np, "pi": math.pi, **names, **dict(zip(variables, values))}) + 0 * values[0]
    return call


def stress_of(s):
    i = s["initial"]
    if i["profile"] == "step":
        return lambda x: i["stress_left"] if x < 0 else i["stress_right"]
    of_x = function(scenarios.as_formula(s)["initial"]["formula"], "x")

    def stress(x):
        value = float(of_x(x))
        return value if value >= SPARSEST else 0.0
    return stress


def forcing_of(s):
    return function(s["forcing"]["formula"], "x", "t") if "forcing" in s else None


def contact_of(s):
    return function(s["interface"]["contact"], "x") if "interface" in s else None


def mean(values, count):
    """Running mean with the weight 1 + cos over 2 count + 1 values; nothing changes beyond the ends."""
    weight = 1 + np.cos(np.pi * np.arange(-count, count + 1) / (count + 1))
    return np.convolve(np.pad(values, count, mode="edge"), weight / weight.sum(), "valid")


def distance(a, b, least=1e-12):
    """Mean difference over mean size, L1."""
    return float(np.mean(np.abs(a - b)) / max(least, np.mean(np.abs(b))))


def final(s, command="pulse"):
    """Places and slips at the end, bounds of the cells, and the run."""
    seen = run(scenarios.changed(s, output_variables=["slip"]), command, profiles=True)
    return seen.fields["x"], seen.fields["slip"][-1], seen.fields["x_bounds"], seen


def slow_slip(s, places, left, right, parcels):
    solver = slow_pulse.SlowPulse(stress_of(s), left, right, parcels, slow_pulse.Friction(**s["friction"]), forcing_of(s),
                                  contact_of(s))
    return solver.slip(solver.run([0, s["time"]["end"]], 1e-5)[-1], places)


def seen_from_ends(s, x, left, right):
    """Places that what happens at the ends has not reached: all of them where the stress is even there."""
    stress, end = stress_of(s), s["time"]["end"]
    margin = 0.05 * (right - left)
    even = all(abs(stress(a) - stress(b)) <= 0.01 * stress(a)
               for a, b in ((left + 1e-9, left + margin), (right - 1e-9, right - margin)))
    inside = (x > left + end) & (x < right - end)
    if not even and np.mean(inside) < 0.2:
        raise slow_pulse.Unsuitable("the ends are felt everywhere")
    return inside | even


def with_slow_pulse(s, parcels=100):
    """Slip along the interface with the default number of cells, to 1 % beside the slow solver's own error."""
    s = scenarios.changed(s, pulse_cells=400)
    x, slip, bounds, _ = final(s)
    _, half, *_ = final(scenarios.changed(s, pulse_cells=s["pulse"]["cells"] // 2))
    left, right = float(bounds[0, 0]), float(bounds[-1, 1])
    coarse = slow_slip(s, x, left, right, parcels)
    fine = slow_slip(s, x, left, right, 2 * parcels)
    half_at = np.interp(x, np.linspace(x[0], x[-1], len(half)), half)
    at = seen_from_ends(s, x, left, right)
    yield ("slip: slow pulse", distance(slip[at], fine[at]), 0.01 + distance(coarse[at], fine[at]),
           f"{parcels} and {2 * parcels} parcels; half the cells change {distance(half_at[at], slip[at]):.2g}")


def cells_of(spacings, s, scale, bounds):
    """Output cells, at least two, in so many spacings of the sparser train."""
    sparse = min(s["initial"]["stress_left"], s["initial"]["stress_right"])
    return 2 + int(spacings * 2 * math.pi / sparse / scale / (bounds[0, 1] - bounds[0, 0]))


def with_chain(s):
    """Slip along the interface, both averaged over four spacings of the sparser train, to 1 % beside what half the
    dislocations change on the chain. Under a load without the outer tenths: the train of the pulse goes on beyond its
    ends, that of the chain stops there."""
    plain = s["friction"]["law"] == "viscous" and "forcing" not in s and "interface" not in s
    scale = 1500 if plain else 400
    x, pulse, bounds, averaged = final(s)
    if not math.isnan(averaged.summary["first_crossing_time"]):
        return  # one train per position is not enough, and the run warns about it
    _, half, *_ = final(scenarios.changed(s, chain_scale=scale // 2, **FINE), "chain")
    _, chain, _, seen = final(scenarios.changed(s, chain_scale=scale, **FINE), "chain")
    count, wide = (cells_of(8, s, n, bounds) for n in (scale, scale // 2))
    least = 2 * math.pi / scale / 10  # a tenth of a dislocation
    edge = (x[-1] - x[0]) / 10 if "forcing" in s else 0
    at = (x >= x[0] + edge) & (x <= x[-1] - edge)
    own = distance(mean(half, wide)[at], mean(chain, wide)[at], least)
    yield ("slip: chain", distance(mean(chain, count)[at], mean(pulse, count)[at], least), 0.01 + own,
           f"scale {scale}, energy drift {seen.summary['energy_drift']:.1e}, mean slip {np.mean(np.abs(pulse)):.2g}")


def with_slow_chain(s, scale=200):
    """The library's chain against the slow one, the same number of dislocations."""
    x, chain, bounds, _ = final(scenarios.changed(s, chain_scale=scale), "chain")
    law = {key: value for key, value in s["friction"].items() if key != "closure"}
    slow = slow_chain.SlowChain(stress_of(s), float(bounds[0, 0]), float(bounds[-1, 1]), scale, forcing=forcing_of(s),
                                contact=contact_of(s), spacing=0.2, **law)
    slip = slow.run(s["time"]["end"])
    cells = np.searchsorted(bounds[:, 1], slow.x, side="right").clip(0, len(x) - 1)
    slip = np.bincount(cells, slip, len(x)) / np.bincount(cells, minlength=len(x))
    count = cells_of(8, s, scale, bounds)
    yield "slip: slow chain", distance(mean(slip, count), mean(chain, count)), 0.05, f"means over {count} cells"


def with_more_cells(s, most=3200):
    """Every scalar against the number of cells: what the last doubling changes is small, or half of what two doublings
    before did (first order would leave a quarter)."""
    counts = [100 * 2**i for i in range(int(math.log2(most / 100)) + 1)]
    runs = [run(scenarios.changed(s, pulse_cells=n)).summary for n in counts]
    reach = s["time"]["end"]
    units = {"slip_at_origin": abs(runs[-1]["peak_slip_velocity"]) * reach, "slip_velocity_at_origin": abs(runs[-1]["peak_slip_velocity"]),
             "conservation_error": 1}
    for key in sorted(set(runs[0]) - {"closure", "cells", "steps", "wall_seconds", "solve_seconds", "time"}):
        values = [r[key] for r in runs]
        if any(isinstance(v, str) or math.isnan(v) for v in values):
            continue
        least = 1e-9 * runs[-1]["energy_elastic"] if key.startswith("energy") else 1e-300
        unit = units.get(key, reach if "front" in key or "position" in key else max(abs(values[-1]), least))
        changes = [abs(b - a) / unit if unit else 0 for a, b in zip(values, values[1:])]
        yield f"cells: {key}", changes[-1], max(5e-4, changes[-3] / 2), " ".join(f"{v:.6g}" for v in values)


COMPARISONS = {"slow": (scenarios.make, [with_slow_pulse]), "chain": (scenarios.make_for_chain, [with_chain]),
               "slow-chain": (scenarios.make_for_chain, [with_slow_chain]), "cells": (scenarios.make, [with_more_cells]),
               "radau": (loaded_block.make, [loaded_block.with_radau, loaded_block.with_other_outputs])}


def results_of(s, *comparisons):
    found = []
    for compare in comparisons:
        try:
            found += list(compare(s))
        except Failed as failure:
            found.append((f"exit {failure.code}", math.inf, 0, str(failure)))
        except slow_pulse.Unsuitable:
            pass
        except ArithmeticError as error:
            found.append(("slow solver", math.inf, 0, str(error)))
    return found
