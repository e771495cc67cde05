"""Random scenarios. Each is made from a number, and the same number makes the same scenario on every machine.

A scenario is a dict of tables, as in TOML. `mirrored` and `shifted` give the same physics in other coordinates.
"""

import copy
import math
import random
import re

SMALLEST = 0.0045  # stress: smaller values count as zero


def short(value):
    """Rounds to three digits. They are enough for a random number, and the scenario stays readable."""
    return float(f"{value:.3g}")


def between(chance, low, high):
    return short(chance.uniform(low, high))


def decades(chance, low, high):
    """A number whose logarithm has a uniform distribution."""
    return short(math.exp(chance.uniform(math.log(low), math.log(high))))


# --- the parts of a scenario --------------------------------------------------------------------------------------

def stress_of(chance):
    """The stress of a dense train, or of a slow one whose state differs from a stressed vacuum by 1e-7 and less."""
    return between(chance, 0.15, 0.4) if chance.random() < 0.4 else decades(chance, 0.4, 2.0)


def sides(chance):
    high = stress_of(chance)
    kind = chance.random()
    if kind < 0.3:
        low = 0
    elif kind < 0.45:
        low = decades(chance, 0.005, 0.05)
    elif kind < 0.55:
        low = high
    else:
        low = short(max(SMALLEST, high * chance.uniform(0.1, 0.95)))
    return (high, low) if chance.random() < 0.7 else (low, high)


def initial(chance):
    kind = chance.random()
    left, right = sides(chance)
    if kind < 0.35:
        return {"profile": "step", "stress_left": left, "stress_right": right}
    if kind < 0.7:
        return {"profile": "tanh", "stress_left": left, "stress_right": right,
                "width": decades(chance, 0.05, 2)}
    a, b, c = stress_of(chance), between(chance, -1.5, 1.5), decades(chance, 0.2, 2)
    rest = chance.choice([0, short(a * chance.uniform(0.1, 0.9))])
    shape = chance.choice([
        f"{rest} + {a}*exp(-((x - ({b}))/{c})^2)",
        f"{a}*(1 + {between(chance, 0.05, 0.6)}*sin({between(chance, 0.5, 4)}*x))",
        f"abs(x - ({b})) < {c} ? {rest} : {a}",  # a gap, or a dip with steep walls
        f"{a}/(1 + exp((x - ({b}))/{c}))",
    ])
    return {"profile": "formula", "formula": shape}


def friction(chance):
    kind = chance.random()
    closure = "paper" if chance.random() < 0.2 else "consistent"
    if kind < 0.15:
        return {"law": "none"}
    if kind < 0.7:
        return {"law": "viscous", "coefficient": decades(chance, 0.02, 1e4), "closure": closure}
    if kind < 0.82:
        return {"law": "coulomb", "coefficient": decades(chance, 1e-5, 0.05), "closure": closure}
    return {"law": "power", "coefficient": decades(chance, 0.01, 100),
            "exponent": chance.choice([0.5, 0.7, 1.3, 2, 3]), "closure": closure}


def forcing(chance):
    size = chance.choice([-1, 1]) * decades(chance, 1e-3, 0.08)
    omega = decades(chance, 0.3, 20)
    return {"formula": chance.choice([
        f"{size}",
        f"{size}*cos({omega}*t)",
        f"{size}*exp(-(x - ({between(chance, -1, 1)}))^2)",
        f"{size}*sin({between(chance, 0.3, 2)}*x)*cos({omega}*t)",
        f"t < {between(chance, 0.3, 3)} ? {size} : 0",
    ])}


def contact(chance):
    size = between(chance, -0.4, 0.6)
    place, width = between(chance, -2, 2), between(chance, 0.2, 2)
    return {"contact": chance.choice([
        f"1 + ({size})*exp(-((x - ({place}))/{width})^2)",
        f"1 + ({size})*tanh((x - ({place}))/{width})",
        f"{between(chance, 0.7, 1.4)}",
    ])}


def make(number):
    """The scenario of this number."""
    chance = random.Random(number)
    s = {"title": f"random {number}", "initial": initial(chance), "friction": friction(chance)}
    if s["initial"].get("stress_left") == s["initial"].get("stress_right") or chance.random() < 0.25:
        s["forcing"] = forcing(chance)
    if chance.random() < 0.2:
        s["interface"] = contact(chance)
    s["time"] = {"end": decades(chance, 0.3, 15)}
    known = s["initial"]["profile"] != "formula" and "interface" not in s
    if not known or "forcing" in s or chance.random() < 0.5:
        reach = s["time"]["end"] * chance.choice([0.4, 1.1]) + 2 * s["initial"].get("width", 1)
        s["domain"] = {"left": short(-reach * chance.uniform(0.7, 1.3)),
                       "right": short(reach * chance.uniform(0.7, 1.3))}
    s["pulse"] = {"cells": chance.choice([50, 100, 100, 200])}
    return s


def any_friction(chance):
    """Any law that a scenario can name without a file. Most often it is one of those that `friction` draws."""
    kind = chance.random()
    if kind < 0.6:
        return friction(chance)
    if kind < 0.72:
        return {"law": "n-shaped", "coefficient": decades(chance, 0.01, 1), "velocity": decades(chance, 0.03, 1)}
    strength = decades(chance, 1e-3, 0.08)
    if kind < 0.8:
        return {"law": "flash-heating", "strength": strength, "weakened": short(strength * chance.uniform(0.1, 0.9)),
                "velocity": decades(chance, 0.03, 1)}
    if kind < 0.88:
        return {"law": "slip-weakening", "strength": strength, "residual": short(strength * chance.uniform(0.1, 0.9)),
                "characteristic_slip": decades(chance, 0.02, 1)}
    direct = short(strength * chance.uniform(0.05, 0.3))
    return {"law": "rate-and-state", "strength": strength, "direct_effect": direct,
            "evolution_effect": short(direct * chance.uniform(0.5, 3)), "reference_velocity": decades(chance, 0.02, 0.5),
            "characteristic_slip": decades(chance, 0.02, 1), "state": chance.choice(["ageing", "slip"])}


def smooth_sum(chance):
    """Two smooth steps of stress, or a smooth step and a hump, as one formula."""
    levels = [stress_of(chance) for _ in range(3)]
    place, width = decades(chance, 0.05, 1.5), decades(chance, 0.04, 1.2)
    step = f"0.5*(1-tanh((x-(-{place}))/({width})))"
    if chance.random() < 0.5:
        other = f"0.5*(1-tanh((x-({place}))/({width})))"
        return f"({levels[2]})+({short(levels[0] - levels[1])})*{step}+({short(levels[1] - levels[2])})*{other}"
    return f"({levels[0]})+({levels[1]})*{step}+({levels[2]})*exp(-((x-(-{short(2 * place)}))/({width}))^2)"


def make_wide(number):
    """A scenario that a user might run: any law, held profiles, two steps of stress, and waves far inside the domain."""
    chance = random.Random(f"wide {number}")
    s = {"title": f"random {number} of any law", "initial": initial(chance), "friction": any_friction(chance)}
    if chance.random() < 0.25:
        s["initial"] = {"profile": "formula", "formula": smooth_sum(chance)}
    if s["initial"].get("stress_left") == s["initial"].get("stress_right") or chance.random() < 0.15:
        s["forcing"] = forcing(chance)
    if chance.random() < 0.15:
        s["interface"] = contact(chance)
        if chance.random() < 0.5 and s["initial"]["profile"] != "step" and "abs" not in s["initial"].get("formula", ""):
            s["initial"]["hold"] = True
    s["time"] = {"end": decades(chance, 0.5, 15)}
    if s["initial"]["profile"] == "formula" or "interface" in s or "forcing" in s or chance.random() < 0.3:
        reach = 1.1 * s["time"]["end"] + 3 * s["initial"].get("width", 1)
        s["domain"] = {"left": -short(reach), "right": short(reach)}
    s["pulse"] = {"cells": chance.choice([100, 100, 200])}
    return s


def make_for_chain(number):
    """A scenario for comparison with the chain: moderate stress, waves that do not reach the ends, and no strong friction.
    The contact ratio changes so little that dislocations do not overtake each other."""
    chance = random.Random(f"chain {number}")
    high = decades(chance, 0.5, 1.4)
    low = short(high * chance.uniform(0.25, 0.9))
    left, right = (high, low) if chance.random() < 0.7 else (low, high)
    end = decades(chance, 2, 5)
    s = {"title": f"random {number} for the chain",
         "initial": {"profile": "tanh", "stress_left": left, "stress_right": right,
                     "width": decades(chance, 0.2, 1)},
         "time": {"end": end}}
    law = chance.choice(["viscous", "viscous", "coulomb", "power"])
    if law != "viscous":  # only viscous friction damps the waves that a shock radiates, so we avoid shocks
        i = s["initial"]
        i.update(width=between(chance, 0.8, 1.5), stress_left=max(left, short(0.6 * right)),
                 stress_right=max(right, short(0.6 * left)))
    s["friction"] = {"law": law, "closure": "consistent"}
    if law == "viscous":
        s["friction"]["coefficient"] = short(decades(chance, 0.3, 20) / end)  # Gamma > 0.3
    elif law == "coulomb":
        s["friction"]["coefficient"] = decades(chance, 1e-3, 0.02)
    else:
        s["friction"].update(coefficient=decades(chance, 0.1, 3), exponent=chance.choice([0.7, 1.3, 2]))
    if chance.random() < 0.3:
        s["forcing"] = {"formula": f"{between(chance, -0.02, 0.03)}*exp(-(x/{between(chance, 1, 3)})^2)"
                                   f"*cos({between(chance, 0, 2)}*t)"}
    reach = 0.8 * end + 4 * s["initial"]["width"]  # waves on a train of stress 1.4 are slower than 0.8 c
    if chance.random() < 0.25:  # uniform at the ends, which are fixed on the chain and continued on the pulse
        place, width = between(chance, -1, 1), between(chance, 0.8, 1.2)
        s["interface"] = {"contact": f"1 + ({between(chance, -0.15, 0.2)})*exp(-((x - ({place}))/{width})^2)"}
        reach = max(reach, abs(place) + 3 * width + 0.8 * end)
    s["domain"] = {"left": -short(reach), "right": short(reach)}
    s["pulse"] = {"cells": 200}
    return s


# --- the same physics in other coordinates ------------------------------------------------------------------------

def of_x(formula, x):
    """The formula with another expression instead of x."""
    return re.sub(r"\bx\b", f"({x})", formula)


def number(value):
    """The number with all its digits, in brackets if it is negative."""
    return repr(value) if value >= 0 else f"({value!r})"


def as_formula(s):
    """The scenario with its initial stress as a formula of x."""
    s = copy.deepcopy(s)
    i = s["initial"]
    if i["profile"] == "formula":
        return s
    left, right = i["stress_left"], i["stress_right"]
    shape = (f"x < 0 ? {left} : {right}" if i["profile"] == "step" else
             f"{right} + {number(left - right)}*(1 - tanh(x/{i['width']}))/2")
    s["initial"] = {"profile": "formula", "formula": shape}
    return s


def substituted(s, x, sign=""):
    s = copy.deepcopy(s)
    if "formula" in s["initial"]:
        s["initial"]["formula"] = of_x(s["initial"]["formula"], x)
    if "interface" in s:
        s["interface"]["contact"] = of_x(s["interface"]["contact"], x)
    if "forcing" in s:
        s["forcing"]["formula"] = f"{sign}({of_x(s['forcing']['formula'], x)})"
    return s


def mirrored(s):
    """The scenario with x -> -x and u -> -u. Stress does not change its sign, but F, slip and slip velocity do."""
    m = substituted(s, "-x", "-")
    i = m["initial"]
    if "stress_left" in i:
        i["stress_left"], i["stress_right"] = i["stress_right"], i["stress_left"]
    if "domain" in s:
        m["domain"] = {"left": -s["domain"]["right"], "right": -s["domain"]["left"]}
    for table in ("pulse", "chain"):
        for here, there in (("left", "right"), ("right", "left")):
            if here in s.get(table, {}):
                m[table][there] = s[table][here]
            elif there in m.get(table, {}):
                del m[table][there]
    return m


def shifted(s, by):
    """The scenario, moved along x by a distance. Its initial stress must be a formula."""
    moved = substituted(s, f"x - {number(by)}")
    moved["domain"] = {end: x + by for end, x in s["domain"].items()}
    return moved


def changed(s, **values):
    """The scenario with other values. Their names are table_key."""
    s = copy.deepcopy(s)
    for name, value in values.items():
        table, key = name.split("_", 1)
        s.setdefault(table, {})[key] = value
    return s


# --- TOML -----------------------------------------------------------------------------------------------------------

def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    return repr(value)


def text(s):
    """The TOML of a scenario, without the rows of its table. Those belong in a separate file."""
    lines = [f"{key} = {toml_value(value)}" for key, value in s.items() if not isinstance(value, dict)]
    for name, table in s.items():
        if isinstance(table, dict):
            lines += [f"[{name}]"] + [f"{key} = {toml_value(value)}" for key, value in table.items() if key != "rows"]
    return "\n".join(lines) + "\n"


def write(s, folder):
    """Writes the scenario, and its table if it has one, into a folder. Returns the path of the scenario."""
    path = folder / "scenario.toml"
    path.write_text(text(s), encoding="utf-8")
    if "rows" in s.get("initial", {}):
        rows = "".join(f"{x!r},{stress!r}\n" for x, stress in s["initial"]["rows"])
        (folder / s["initial"]["file"]).write_text("x,stress\n" + rows, encoding="utf-8")
    return path
