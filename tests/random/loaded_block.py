"""Compares a block with rate-and-state friction that a spring pulls with scipy's Radau (tests/reference/spring_slider.py).

The ratio of strength to direct effect, f0 / a, ranges from that of gels (5) to that of rock (100) and more. a - b has both
signs, and the stiffness is 0.3 to 1.5 of the critical one. The chain is shorter than a third of the nucleation length, so that
it moves as one block.
"""

import math
import pathlib
import random
import sys

from program import run
from scenarios import changed, decades, short

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "reference"))
import spring_slider  # noqa: E402

TOLERANCES = {1e-6: 1e-3, 5e-5: 1e-2}  # chain.tolerance, the second being the default: relative error of onsets and peaks


def make(number):
    chance = random.Random(number)
    ratio, share = chance.choice([5, 20, 40, 60, 100, 200]), chance.choice([0.5, 0.8, 1.2, 1.5, 1.8])
    a = decades(chance, 1e-4, 0.02)
    b, f0 = short(a * share), short(a * ratio)
    D, w0, v = decades(chance, 0.01, 3), decades(chance, 1e-5, 1e-2), decades(chance, 1e-5, 3e-3)
    kappa = short(abs(b - a) / D * chance.uniform(0.3, 1.5))
    half = short(min(3, 0.3 * math.sqrt(D / abs(b - a))))
    theta = short(D / v * 10 ** chance.uniform(-1, 1)) if chance.random() < 0.5 else short(D / w0)
    return {"initial": {"profile": "step", "stress_left": 0, "stress_right": 0},
            "interface": {"contact": "0"},
            "friction": {"law": "rate-and-state", "strength": f0, "direct_effect": a, "evolution_effect": b,
                         "reference_velocity": w0, "characteristic_slip": D, "initial_state": theta,
                         "state": chance.choice(["ageing", "slip"])},
            "loading": {"stiffness": kappa, "velocity": v, "event_velocity": short(10 * v)},
            "domain": {"left": -half, "right": half},
            "chain": {"left": "free", "right": "free", "spacing": half / 6},
            "time": {"end": short((f0 + abs(b - a) * (160 if b > a else 120)) / (kappa * v))},
            "output": {"every": short((f0 + abs(b - a) * 160) / (kappa * v) * decades(chance, 1e-3, 1))}}


def block_of(s):
    f, loading = s["friction"], s["loading"]
    return spring_slider.Block(f["strength"], f["direct_effect"], f["evolution_effect"], f["characteristic_slip"],
                               f["reference_velocity"], loading["stiffness"], loading["velocity"], f["initial_state"],
                               loading["event_velocity"], f["state"])


def relative(values, expected):
    return max((abs(value / right - 1) for value, right in zip(values, expected)), default=0.0)


def of_largest(values, expected):
    """The largest difference over the largest value. Small events may occur between large ones; their peaks are close to the
    threshold and follow from the large events, so they need no smaller tolerance."""
    return max((abs(value - right) for value, right in zip(values, expected)), default=0.0) / max(expected, default=1.0)


def with_radau(s):
    """Events and slip at two tolerances. Differences of peaks are relative to the largest peak. If the run ends during an event,
    that event has no peak yet."""
    end = s["time"]["end"]
    onsets, peaks, complete, slip, _ = block_of(s).run(end)
    settled = complete and not (onsets and onsets[-1] > 0.99 * end)
    for tolerance, allowed in TOLERANCES.items():
        seen = run(changed(s, chain_tolerance=tolerance), "chain").summary
        events = seen["events"]
        note = f"f0/a {s['friction']['strength'] / s['friction']['direct_effect']:.0f}, tolerance {tolerance}, {seen['steps']} steps"
        yield f"events: number at {tolerance}", abs(len(events) - len(onsets)), 0, f"{note}: {len(events)} for {len(onsets)}"
        yield f"events: onset at {tolerance}", relative([e["onset"] for e in events], onsets), allowed, note
        whole = len(onsets) if settled else max(len(onsets) - 1, 0)
        yield (f"events: peak at {tolerance}", of_largest([e["peak_velocity"] for e in events][:whole], peaks[:whole]), allowed, note)
        if settled:
            yield f"slip at {tolerance}", abs(seen["slip_at_origin"] / slip - 1), allowed, note
        yield f"energy at {tolerance}", seen["energy_drift"], 1e-10, note


def with_other_outputs(s):
    """Steps, and therefore events, must not depend on the output times."""
    end = s["time"]["end"]
    few, many = (run(changed(s, output_every=end / count), "chain").summary for count in (1, 97))
    yield "events: same bits with other outputs", float(few["events"] != many["events"] or few["slip_at_origin"] != many["slip_at_origin"]), 0, ""
