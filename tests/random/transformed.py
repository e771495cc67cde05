"""Runs a problem in other coordinates, with every command, and compares the results.

    mirrored   x -> -x and u -> -u; on a plane also y -> -y, and the axes exchanged; sides of a Riemann problem exchanged
    stretched  x and t times a factor, with friction and load divided by it: as many times more dislocations
    shifted    another origin of x (and y)
    scaled     other units: the moduli, the speeds of waves and the length b times factors; and a chain of another scale
    boosted    the frame of an observer at a velocity: Riemann problems, which follow sine-Gordon

Results must agree to rounding, or within the sum of the errors that both runs state.
"""

import json
import math
import os
import pathlib
import random
import re
import subprocess
import tempfile

import numpy as np

import checks
import scenarios
from program import PROGRAM, Failed, limit_time, run
from scenarios import between, changed, decades, short

ROUNDING = 1e-6
CHAIN_SCALE = 60
SITE = 0.4 / CHAIN_SCALE  # distance of the sites of a chain


def call(*words, **files):
    """The JSON that a command prints. A word {name} stands for a file of this name and content."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            pathlib.Path(folder, name.replace("_", ".")).write_text(text, encoding="utf-8")
        places = {name: os.path.join(folder, name.replace("_", ".")) for name in files}
        done = subprocess.run([PROGRAM, *(str(word).format(**places) for word in words), "--json", "--quiet"], capture_output=True, text=True,
                              preexec_fn=limit_time, check=False)
    if done.returncode != 0:
        raise Failed(done.returncode, done.stderr.strip().split("\n")[-1])
    return json.loads(done.stdout)


def flat(printed, name=""):
    """{path: number} of all numbers of a JSON value."""
    if isinstance(printed, dict):
        return {key: value for part, item in printed.items() for key, value in flat(item, f"{name}.{part}".lstrip(".")).items()}
    if isinstance(printed, list):
        return {key: value for part, item in enumerate(printed) for key, value in flat(item, f"{name}[{part}]").items()}
    return {name: float(printed)} if isinstance(printed, (int, float)) and not isinstance(printed, bool) else {name: math.nan} if printed is None else {}


def last_name(key):
    return key.rpartition(".")[2].partition("[")[0]


def compare(what, a, b, factors, units, errors=(), leave=()):
    """Compares numbers a of one run with those b of the other. `factors` has b / a by the last part of a key (1 if it has none; None: not
    compared), and `units` the size with which a difference is compared (otherwise that of the number)."""
    for key, value in a.items():
        factor = factors.get(key, factors.get(last_name(key), 1))
        if factor is None or last_name(key) in leave or key not in b:
            continue
        expected = value * factor
        if expected == b[key] or math.isnan(expected) and math.isnan(b[key]):
            continue
        error = sum(e.get(key, 0) * abs(f) for e, f in zip(errors, (factor, 1)) if not math.isnan(e.get(key, 0)))
        unit = max(units.get(key, units.get(last_name(key), 0)), abs(expected), abs(b[key])) if not math.isnan(expected - b[key]) else 0
        difference = abs(expected - b[key]) / unit if unit > 0 else math.inf
        yield f"{what}: {key}", difference, ROUNDING + (error / unit if unit > 0 else 0), f"{expected:.9g}, {b[key]:.9g}"


# --- random problems ----------------------------------------------------------------------------------------------

def on_line(chance):
    """A scenario of a line with a domain, and friction that does not stop everything."""
    s = scenarios.make_for_chain(chance.randrange(10**6))
    s["time"]["end"] = short(min(2, s["time"]["end"]))
    s["pulse"] = {"cells": 60}
    s["chain"] = {"scale": CHAIN_SCALE}
    # Sites of a chain lie symmetrically, and a shift moves them onto each other. Otherwise results change with the sites.
    half = round(s["domain"]["right"] / SITE) * SITE
    s["domain"] = {"left": -half, "right": half}
    if chance.random() < 0.3:
        s["friction"] = {"law": "rate-and-state", "strength": 0.03, "direct_effect": decades(chance, 1e-3, 1e-2), "evolution_effect": decades(chance, 1e-3, 2e-2),
                         "characteristic_slip": decades(chance, 0.01, 1), "reference_velocity": decades(chance, 1e-3, 0.1), "state": chance.choice(["ageing", "slip"])}
    return s


SHAPE = "sqrt(x^2 + y^2) + ({e})*x + ({f})*y"


def on_plane(chance):
    """A slip that falls along each ray from the origin, whose contours are no circles. The grid takes two of them."""
    rho = SHAPE.format(e=between(chance, -0.3, 0.3), f=between(chance, -0.3, 0.3))
    size = between(chance, 2, 5)
    return {"plane": {"left": -2.4, "right": 2.4, "bottom": -2.4, "top": 2.4, "cells": 24, "loops": 10, "angles": 16},
            "initial": {"profile": "formula", "formula": f"({rho}) < 1.1 ? {size}*(1 - (({rho})/1.1)^2)^1.5 : 0"},
            "friction": {"law": "viscous", "coefficient": decades(chance, 0.1, 3)}, "time": {"end": between(chance, 0.1, 0.3)}, "chain": {"scale": 20, "spacing": 0.2},
            "output": {"probes": [[0.6, 0.2], [-0.4, 0.7], [0.1, -0.9]]}}


def plane_ways(chance):
    """Solver and arguments of a run on a plane."""
    return chance.choice([("loops", []), ("grid", []), ("direct", ["--direct"])])


def of_plane(s, way):
    name, arguments = way
    s = changed(s, plane_solver="grid") if name == "grid" else s
    seen = run(s, "plane", arguments=arguments)
    return flat(seen.summary), flat(seen.errors)


def substituted(s, x, y):
    """The scenario on a plane with other expressions for x and y."""
    s = changed(s)
    formula = s["initial"]["formula"]
    s["initial"]["formula"] = scenarios.of_x(formula.replace("y", "Y"), x).replace("Y", f"({y})")
    return s


def train(chance):
    return decades(chance, 0.02, 3), round(chance.uniform(-0.9, 0.9), 3)


def riemann(left, right):
    """Waves and states of a Riemann problem between (stress, U) on both sides."""
    def side(stress, velocity):
        return f"{stress!r},{velocity!r}" if stress else "0"
    out = call("riemann", f"--left={side(*left)}", f"--right={side(*right)}")
    out["waves"] = [w for w in out["waves"] if w["to"] - w["from"] > 1e-12]  # rounding decides whether there is a wave of no width
    return {key: out[key] for key in ("left", "star", "right", "waves", "at_origin", "left_edge", "right_edge")}


# --- mirrored -----------------------------------------------------------------------------------------------------

ODD_OF_CHAIN = checks.ODD | {"trailing_front", "potency"}
OF_MACHINE = ("wall_seconds", "solve_seconds", "site_updates_per_second", "threads", "ranks", "steps", "energy_drift", "charge_error", "conservation_error", "energy_shocks", "energy_residual",
              "window", "smooth_window")


def units_of_line(a, s):
    fastest, end = abs(a.get("peak_slip_velocity", 0)), s["time"]["end"]
    energy = 1e-6 * abs(a.get("energy_elastic", 0)) + abs(a.get("energy_kinetic", 0)) + abs(a.get("energy_dissipated", 0))
    of = {key: energy for key in ("energy_elastic", "energy_kinetic", "energy_dissipated", "energy_supplied", "energy_phonons", "energy_through_ends")}
    places = {key: end for key in (*checks.PLACES, "trailing_characteristic")}
    return {"slip_velocity_at_origin": fastest, "slip_at_origin": fastest * end, "potency": fastest * end, **places, **of}


def line(command, s, other, factors, what):
    a, b = run(s, command), run(other, command)
    leave = set(OF_MACHINE) | ({"peak_position"} if abs(a.summary.get("peak_slip_velocity", 0)) < 1e-12 else set())
    errors = flat(a.errors), flat(b.errors)
    if command == "chain" and "mirrored" in what:  # its dislocations begin elsewhere; results agree to a twentieth of one
        leave |= {"peak_position", "energy_phonons", "trailing_front_observed", "leading_front_observed", "leading_front", "slip_velocity_at_origin", "peak_slip_velocity", "stress_at_origin"}
        start = 0.05 * 2 * math.pi / CHAIN_SCALE
        energy = 0.5 * 8 / CHAIN_SCALE  # the domain may hold half a dislocation more, of energy 8 in the units of the chain
        errors = ({**errors[0], "slip_at_origin": start, "potency": start * s["domain"]["right"],
                   **{key: energy for key in ("energy_elastic", "energy_kinetic", "energy_dissipated", "energy_supplied", "energy_through_ends")}}, errors[1])
    yield from compare(what, flat(a.summary), flat(b.summary), factors, units_of_line(a.summary, s), errors, leave)


def mirrored_pulse(chance):
    s = scenarios.make(chance.randrange(10**6))
    return s, lambda: checks.same_in_a_mirror(checks.Case(s))


def mirrored_chain(chance):
    s = on_line(chance)
    odd = {key: -1 for key in ODD_OF_CHAIN}
    return s, lambda: line("chain", s, scenarios.mirrored(s), {**odd, "trailing_characteristic": None}, "chain mirrored")


def mirrored_plane(chance):
    s, way = on_plane(chance), plane_ways(chance)
    x, y = chance.choice([("-x", "y"), ("x", "-y"), ("y", "x")])
    probes = [[-a if x == "-x" else a, -b if y == "-y" else b] if x != "y" else [b, a] for a, b in s["output"]["probes"]]
    other = changed(substituted(s, x, y), output_probes=probes)

    def results():
        (a, errors), (b, others) = of_plane(s, way), of_plane(other, way)
        yield from compare(f"plane {way[0]} {x} {y}", a, b, {}, units_of_plane(a, s), (errors, others), OF_MACHINE)
    return s, results


def units_of_plane(a, s):
    fastest, largest = abs(a["peak_slip_velocity"]), max(abs(a["energies." + part]) for part in ("kinetic", "elastic", "dissipated"))
    of = {"slip_velocity_at_probes": fastest, "slip_at_probes": fastest * s["time"]["end"], "stress_drop": fastest}
    return {**of, **{f"energies.{part}": largest for part in ("kinetic", "elastic", "dissipated", "supplied", "vanished", "radiated")}}


def mirrored_riemann(chance):
    left, right = train(chance), train(chance) if chance.random() < 0.8 else (0, 0)

    def results():
        a, b = riemann(left, right), riemann((right[0], -right[1]), (left[0], -left[1]))
        b["left"], b["right"] = b["right"], b["left"]
        b["left_edge"], b["right_edge"] = b["right_edge"], b["left_edge"]
        b["waves"] = [{"kind": w["kind"], "from": w["to"], "to": w["from"], "trains": w["trains"]} for w in reversed(b["waves"])]
        for both in (a, b):
            both["at_origin"].pop("each")
        odd = {key: -1 for key in ("U", "W", "P", "from", "to", "left_edge", "right_edge", "slip_velocity")}
        yield from compare("riemann mirrored", flat(a), flat(b), odd, {key: 1 for key in ("from", "to", "left_edge", "right_edge", "U", "W", "P", "slip_velocity", "Sigma", "stress")})
        yield "riemann mirrored: kinds", float([w["kind"] for w in a["waves"]] != [w["kind"] for w in b["waves"]]), 0, ""
    return {"left": list(left), "right": list(right)}, results


def mirrored_compare(chance):
    s = changed(on_line(chance), friction_law="viscous")
    s["friction"] = {"law": "viscous", "coefficient": decades(chance, 0.1, 1)}
    s["time"]["end"] = 1.0

    def levels(scenario):
        out = call("compare", "{s_toml}", s_toml=scenarios.text(scenario))
        return flat(out)

    def results():
        a, b = levels(s), levels(scenarios.mirrored(s))
        # The chain of `compare` has sites that are no mirror images.
        common = {key: a[key] for key in a if key in b and "levels[2]" not in key and last_name(key) in ("slip_velocity_at_origin", "slip_at_origin", "stress_at_origin")}
        odd = {"slip_velocity_at_origin": -1, "slip_at_origin": -1}
        errors = [{key: 0.02 * abs(value) for key, value in each.items()} for each in (a, b)]
        yield from compare("compare mirrored", common, b, odd, {"slip_velocity_at_origin": 1e-3, "slip_at_origin": 1e-3}, errors)
    return s, results


def fronts_of(s, folder):
    """JSON of the fronts of a pulse. Those of a chain depend on where its dislocations begin."""
    path = os.path.join(folder, "run.nc")
    scenario = pathlib.Path(folder, "s.toml")
    scenario.write_text(scenarios.text(s), encoding="utf-8")
    for words in (["pulse", str(scenario), "-o", path], ["fronts", path]):
        done = subprocess.run([PROGRAM, *words, "--json", "--quiet", "--threads", "1"], capture_output=True, text=True, preexec_fn=limit_time, check=False)
        if done.returncode != 0:
            raise Failed(done.returncode, done.stderr.strip().split("\n")[-1])
    return json.loads(done.stdout)


def front_scenario(chance):
    s = on_line(chance)
    s["friction"] = {"law": "viscous", "coefficient": decades(chance, 0.1, 1)}
    return changed(s, output_every=s["time"]["end"] / 60)


def fronts_results(s, other, to_other, what):
    """Compares fronts; to_other(x) is a position of the other run."""
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
        a, b = fronts_of(s, one)["fronts"], fronts_of(other, two)["fronts"]
    yield f"{what}: number of fronts", abs(len(a) - len(b)), 0, f"{len(a)}, {len(b)}"
    for front in a:
        front.update({key: to_other(front[key]) for key in ("front_begin", "front_end")})
    if len(a) == len(b):
        for x, y in zip(sorted(a, key=order_of), sorted(b, key=order_of)):
            units = {"front_begin": 1, "front_end": 1, "front_onset": s["time"]["end"], "front_duration": s["time"]["end"]}
            yield from compare(what, flat(x), flat(y), {}, units)


def order_of(front):
    return round(front["front_onset"], 6), round(front["front_begin"], 6), round(front["front_end"], 6)


def mirrored_fronts(chance):
    s = front_scenario(chance)
    return s, lambda: fronts_results(s, scenarios.mirrored(s), lambda x: -x, "fronts mirrored")


# --- stretched ----------------------------------------------------------------------------------------------------

FORCES = ("coefficient", "strength", "weakened", "residual", "direct_effect", "evolution_effect")


def stretched(s, by):
    """The scenario with x and t times `by`, and as many times more dislocations. Friction and load are divided by it."""
    n = scenarios.substituted(s, f"x/{by}")
    if "forcing" in n:
        formula = n["forcing"]["formula"].replace("exp", "E#")
        n["forcing"]["formula"] = f"({re.sub(r'(?<![a-z])t(?![a-z])', f'(t/{by})', formula).replace('E#', 'exp')})/{by}"
    i = n["initial"]
    if "width" in i:
        i["width"] *= by
    friction = n["friction"]
    for key in FORCES:
        if key in friction:
            friction[key] /= by
    for key in ("characteristic_slip", "initial_state"):
        if key in friction:
            friction[key] *= by
    n["time"]["end"] *= by
    n["domain"] = {side: x * by for side, x in n["domain"].items()}
    if "chain" in n:
        n["chain"]["scale"] /= by
    return n


def factors_of_stretch(by):
    longer = {key: by for key in ("time", "slip_at_origin", "dislocations", *checks.PLACES, "trailing_characteristic", "damping_time")}
    energies = {key: by for key in ("energy_elastic", "energy_kinetic", "energy_dissipated", "energy_supplied", "energy_through_ends", "energy_phonons")}
    return {**longer, **energies, "potency": by * by, "friction_coefficient": 1 / by, "scale": 1 / by}


def stretched_line(command):
    def make(chance):
        s, by = on_line(chance), chance.choice([0.25, 0.5, 3, 8])
        # A chain counts its own dislocations, which are as many in both runs.
        factors = factors_of_stretch(by) | ({"dislocations": 1, "spacing": None} if command == "chain" else {})
        return s, lambda: line(command, s, stretched(s, by), factors, f"{command} stretched")
    return make


def stretched_plane(chance):
    s, way, by = on_plane(chance), plane_ways(chance), chance.choice([0.5, 2, 4])
    other = substituted(s, f"x/{by}", f"y/{by}")
    other["initial"]["formula"] = f"{by}*({other['initial']['formula']})"
    other["friction"]["coefficient"] /= by
    other["time"]["end"] *= by
    other["chain"]["scale"] /= by
    other["output"]["probes"] = [[a * by, b * by] for a, b in s["output"]["probes"]]
    for side in ("left", "right", "bottom", "top"):
        other["plane"][side] *= by
    longer = {"time": by, "slip_at_probes": by, "front": by, "last_rupture_time": by, "duration": by, "arrest_radius": by, "corner_frequency": 1 / by}
    factors = {**longer, "potency": by**3, "moment": by**3, "potency_rate": by**2, "ruptured_area": by**2, **{key: by**2 for key in ("kinetic", "elastic", "dissipated", "supplied", "vanished", "radiated")}}

    def results():
        (a, errors), (b, others) = of_plane(s, way), of_plane(other, way)
        yield from compare(f"plane {way[0]} stretched", a, b, factors, units_of_plane(a, s), (errors, others), OF_MACHINE)
    return s, results


def event(chance):
    return {"slip": decades(chance, 0.01, 10), "duration": decades(chance, 1, 100), "rupture_velocity": between(chance, 0.5, 3)}


def event_text(e, speed=1.0, length=1.0):
    return f"name,rupture_velocity,slip,duration\na,{e['rupture_velocity'] * speed!r} km/s,{e['slip'] * length!r} m,{e['duration'] * length / speed!r} s\n"


def event_of(text, speed=1.0, modulus=1.0):
    out = call("event", "{e_csv}", "--samples", 0, f"--p-wave-speed={6 * speed!r} km/s", f"--shear-modulus={30 * modulus!r} GPa", e_csv=text)
    return flat(out["events"][0])


def stretched_event(chance):
    e, by = event(chance), chance.choice([0.1, 3, 10])
    lengths = {key: by for key in ("slip", "duration", "rise_time")}
    return e, lambda: compare("event stretched", event_of(event_text(e)), event_of(event_text(e, length=by)), lengths, {})


# --- shifted ------------------------------------------------------------------------------------------------------

def shifted_pulse(chance):
    s = scenarios.make(chance.randrange(10**6))
    if "domain" not in s:
        s["domain"] = {"left": -5.0, "right": 5.0}
    return s, lambda: checks.same_when_shifted(checks.Case(s))


def shifted_chain(chance):
    s, by = scenarios.as_formula(on_line(chance)), chance.choice([-480, 105, 375]) * SITE

    def results():
        a, b = (run(changed(each, output_variables=["slip"]), "chain", profiles=True) for each in (s, scenarios.shifted(s, by)))
        yield "chain shifted: x", float(np.max(np.abs(b.fields["x"] - a.fields["x"] - by))), 1e-9, ""
        slip = float(np.max(np.abs(a.fields["slip"][-1] - b.fields["slip"][-1])))
        yield "chain shifted: slip", slip, 2 * math.pi / CHAIN_SCALE, "one dislocation, as the first one begins elsewhere"
        for key in ("sites", "spacing"):
            yield f"chain shifted: {key}", abs(a.summary[key] - b.summary[key]) / max(1, abs(a.summary[key])), ROUNDING, ""
    return s, results


def shifted_plane(chance):
    s, way, by = on_plane(chance), chance.choice([("grid", []), ("direct", ["--direct"])]), chance.choice([-0.65, 1.25])
    other = substituted(s, f"x - ({by})", f"y + ({by})")
    for side, sign in (("left", 1), ("right", 1), ("bottom", -1), ("top", -1)):
        other["plane"][side] += sign * by
    other["output"]["probes"] = [[a + by, b - by] for a, b in s["output"]["probes"]]

    def results():
        (a, errors), (b, others) = of_plane(s, way), of_plane(other, way)
        yield from compare(f"plane {way[0]} shifted", a, b, {"front": None, "arrest_radius": None}, units_of_plane(a, s), (errors, others), OF_MACHINE)
    return s, results


def shifted_fronts(chance):
    s = scenarios.as_formula(front_scenario(chance))
    return s, lambda: fronts_results(s, scenarios.shifted(s, 375 * SITE), lambda x: x + 375 * SITE, "fronts shifted")


# --- scaled -------------------------------------------------------------------------------------------------------

def medium(modulus=1.0, speed=1.0, length=1.0):
    return {"contact_ratio": 0.01, "shear_modulus": f"{30 * modulus!r} GPa", "poisson_ratio": 0.25, "p_wave_speed": f"{6 * speed!r} km/s",
            "asperity_spacing": f"{length!r} mm"}


def factors_of_units(units, modulus, speed, length):
    """b / a of numbers in SI units, from units such as "N m s-1"."""
    time = length / speed
    of = {"Pa": modulus, "m": length, "s": time, "Hz": 1 / time, "J": modulus * length**3, "N": modulus * length**2, "W": modulus * length**3 / time}

    def factor(unit):
        parts = [re.fullmatch(r"([A-Za-z]+)(-?\d+)?", part) for part in unit.split()]
        if not all(part and part[1] in of for part in parts):
            return None
        return math.prod(of[part[1]] ** int(part[2] or 1) for part in parts)
    return {key: factor(unit) for key, unit in units.items()}


def scaled(command, make, arguments=()):
    def case(chance):
        s = make(chance)
        s["medium"] = medium()
        by = chance.choice([0.5, 4]), chance.choice([0.5, 2]), chance.choice([0.25, 10])
        other = {**s, "medium": medium(*by)}

        def results():
            a, b = (run(each, command, arguments=[*arguments, "--si"]) for each in (s, other))
            units = {last_name(key) if key.startswith("energies") else key: unit for key, unit in flat_texts(a.summary.pop("units")).items()}
            b.summary.pop("units")
            factors = factors_of_units(units, *by)
            unknown = [units[key] for key, factor in factors.items() if factor is None]
            yield f"{command} scaled: units known", len(unknown), 0, " ".join(map(str, unknown))
            yield from compare(f"{command} scaled", flat(a.summary), flat(b.summary), factors, {}, (), OF_MACHINE)
        return s, results
    return case


def flat_texts(units, name=""):
    if isinstance(units, dict):
        return {key: value for part, item in units.items() for key, value in flat_texts(item, f"{name}.{part}".lstrip(".")).items()}
    return {name: units}


def scaled_chain(chance):
    """The averages of chains of two scales agree within the sum of their errors."""
    s = on_line(chance)
    s["friction"] = {"law": "viscous", "coefficient": decades(chance, 0.1, 2)}

    def results():
        a, b = (run(changed(s, chain_scale=scale), "chain") for scale in (300, 700))
        for key in ("slip_velocity_at_origin", "stress_at_origin"):
            error = a.errors.get(key, math.nan) + b.errors.get(key, math.nan)
            if error == error:
                yield f"chain of two scales: {key}", abs(a.summary[key] - b.summary[key]), error, f"{a.summary[key]:.6g}, {b.summary[key]:.6g}"
    return s, results


def scaled_event(chance):
    """The stress in Pa goes as the modulus, and nothing else does. Ratios of velocities stay."""
    e, modulus, speed = event(chance), chance.choice([0.3, 2]), chance.choice([0.5, 0.8])

    def results():
        a, b = event_of(event_text(e)), event_of(event_text(e, speed), speed, modulus)
        for key, value in a.items():
            factor = modulus if "_pa" in key else speed if "_m_s" in key else 1
            if value and math.isfinite(value):
                yield f"event scaled: {key}", abs(b[key] / value / factor - 1), ROUNDING, f"{value}, {b[key]}"
    return e, results


def scaled_laboratory(chance):
    rows = [(decades(chance, 0.5, 4), decades(chance, 3, 8), decades(chance, 10, 200)) for _ in range(5)]
    modulus, speed = chance.choice([0.1, 5]), chance.choice([0.5, 2])

    def table(by_stress, by_speed):
        return "tau [MPa],normal_stress [MPa],front_velocity [m/s]\n" + "".join(
            f"{t * by_stress!r} */ 1.05,{n * by_stress!r} */ 1.05,{v * by_speed!r} */ 1.2\n" for t, n, v in rows)

    def results():
        words = ["laboratory", "{t_csv}", "--draws", 500, "--poisson-ratio", 0.35]
        a = call(*words, "--s-wave-speed", "1300 m/s", t_csv=table(1, 1))
        b = call(*words, "--s-wave-speed", f"{1300 * speed!r} m/s", t_csv=table(modulus, speed))
        factors = {"shear_stress": modulus, "normal_stress": modulus, "shear_stress_interval": modulus, "normal_stress_interval": modulus, "c_m_s": speed,
                   "predicted_stress_drop": modulus, "predicted_stress_drop_interval": modulus}
        yield from compare("laboratory scaled", flat(a), flat(b), factors, {"deviation": 1, "stress_drop_deviation": 1})
    return {"rows": [list(row) for row in rows]}, results


def scaled_relations(chance):
    """Each number of a pulse gives the others, in model units and in SI units of two rocks."""
    stress, modulus, speed = decades(chance, 0.05, 3), chance.choice([0.5, 4]), chance.choice([0.5, 2])

    def si(by_modulus, by_speed):
        return call("relations", "--stress", repr(stress), "--si", "--contact-ratio", "0.003", f"--shear-modulus={30 * by_modulus!r} GPa", f"--p-wave-speed={6 * by_speed!r} km/s")

    def results():
        whole = call("relations", "--stress", repr(stress))["relations"][0]
        for option, key in (("--rupture-velocity", "rupture_velocity"), ("--slip-velocity", "slip_velocity")):
            again = call("relations", option, repr(whole[key]))["relations"][0]
            yield from compare(f"relations from {key}", flat(whole), flat(again), {}, {})
        between_trains = riemann((stress, 0.0), (0, 0))
        yield "relations: riemann", abs(between_trains["at_origin"]["slip_velocity"] / whole["slip_velocity"] - 1), 1e-9, ""
        a, b = si(1, 1), si(modulus, speed)
        factors = factors_of_units(flat_texts(a.pop("units", {})), modulus, speed, 1)
        b.pop("units", None)
        factors = {last_name(key): factor for key, factor in factors.items()}
        yield from compare("relations scaled", flat(a), flat(b), factors, {})
    return {"stress": stress}, results


# --- boosted ------------------------------------------------------------------------------------------------------

def boosted_train(side, by):
    """The train (stress, U) for an observer with the velocity -by: density and flux are a vector."""
    stress, velocity = side
    return (stress * (1 + velocity * by) / math.sqrt(1 - by * by), (velocity + by) / (1 + velocity * by)) if stress else (0, 0)


def boosted_riemann(chance):
    left = train(chance)
    right = train(chance) if chance.random() < 0.8 else (0, 0)
    by = round(chance.uniform(-0.8, 0.8), 3)

    def seen(x_over_t):
        return (x_over_t + by) / (1 + x_over_t * by)

    def results():
        a, b = riemann(left, right), riemann(boosted_train(left, by), boosted_train(right, by))
        yield "riemann boosted: kinds", float([w["kind"] for w in a["waves"]] != [w["kind"] for w in b["waves"]]), 0, ""
        gamma = 1 / math.sqrt(1 - by * by)
        for place in ("left", "star", "right"):
            one, two = a[place], b[place]
            size = max(abs(two["Sigma"]), abs(two["W"]), 1e-12)
            for key, value in (("Sigma", gamma * (one["Sigma"] + by * one["W"])), ("W", gamma * (one["W"] + by * one["Sigma"]))):
                yield f"riemann boosted: {place} {key}", abs(value - two[key]) / size, 1e-9, f"{value}, {two[key]}"
        if len(a["waves"]) == len(b["waves"]):
            for one, two in zip(a["waves"], b["waves"]):
                for end in ("from", "to"):
                    yield f"riemann boosted: {end}", abs(seen(one[end]) - two[end]), 1e-9, f"{seen(one[end])}, {two[end]}"
    return {"left": list(left), "right": list(right), "by": by}, results


CASES = {"mirrored": [mirrored_pulse, mirrored_chain, mirrored_plane, mirrored_riemann, mirrored_compare, mirrored_fronts],
         "stretched": [stretched_line("pulse"), stretched_line("chain"), stretched_plane, stretched_event],
         "shifted": [shifted_pulse, shifted_chain, shifted_plane, shifted_fronts],
         "scaled": [scaled("pulse", on_line), scaled("chain", on_line), scaled("plane", on_plane), scaled_chain, scaled_event, scaled_laboratory, scaled_relations],
         "boosted": [boosted_riemann]}


def results_of(number, what):
    """(scenario, results). The number chooses the command in turn."""
    chance = random.Random(f"{what} {number}")
    cases = CASES[what]
    s, results = cases[number % len(cases)](chance)
    found = []
    try:
        found += list(results())
    except Failed as failure:  # exit code 4 is allowed: the run has found its own error and reported it
        found.append((f"exit {failure.code}", math.inf, math.inf if failure.code == 4 else 0, str(failure)))
    return s, found
