"""Wild random scenarios: every law, loading, contacts that change, laboratory ratios, tables with gaps, few cells. They
may be coarse or impossible; a run of one is refused, finishes, or ends with a reason, within the steps that it may take."""

import random

from scenarios import between, contact, decades, forcing, short, sides, stress_of

SMALL, MANY = [4, 4, 5, 6, 7, 8, 8, 10, 12], [20, 30, 50]
ENDS = ["continued", "fixed", "free"]


def table(chance):
    """Rows (x, stress) with gaps, jumps within a few hundredths, and stresses that count as none."""
    x, rows = -4.0, []
    while x < 4 or len(rows) < 2:
        empty = bool(rows) and rows[-1][1] == 0
        value = 0 if not empty and chance.random() < 0.4 else chance.choice([1.2, 0.3, 0.0046, stress_of(chance)])
        rows.append((short(x), value))
        x += decades(chance, 0.01, 2)
    increasing = [row for before, row in zip([(-9, 0), *rows], rows) if row[0] > before[0]]
    return {"profile": "table", "file": "table.csv", "rows": increasing}


def initial(chance):
    if chance.random() < 0.4:
        return table(chance)
    left, right = sides(chance)
    if chance.random() < 0.5:
        return {"profile": "step", "stress_left": left, "stress_right": right}
    return {"profile": "tanh", "stress_left": left, "stress_right": right, "width": decades(chance, 0.01, 2)}


def rate_and_state(chance):
    """Strength over direct effect of a laboratory is 40 to 100."""
    direct = decades(chance, 1e-6, 1e-2)
    law = {"law": "rate-and-state", "strength": short(direct * decades(chance, 2, 200)), "direct_effect": direct,
           "evolution_effect": short(direct * decades(chance, 0.3, 3)), "characteristic_slip": decades(chance, 1e-4, 10),
           "reference_velocity": decades(chance, 1e-6, 0.1), "state": chance.choice(["ageing", "slip"])}
    if chance.random() < 0.3:
        law["initial_state"] = decades(chance, 1e-2, 1e4)
    return law


def friction(chance):
    strength, velocity = decades(chance, 1e-5, 0.1), decades(chance, 1e-4, 1)
    size = decades(chance, 1e-5, 0.05)
    return chance.choice([
        lambda: {"law": "none"},
        lambda: {"law": "viscous", "coefficient": decades(chance, 0.01, 1e4)},
        lambda: {"law": "coulomb", "coefficient": strength},
        lambda: {"law": "power", "coefficient": decades(chance, 1e-3, 10), "exponent": chance.choice([0.2, 0.3, 0.5, 1.5])},
        lambda: {"law": "formula", "formula": chance.choice([
            f"{size}*sqrt(w)", f"{size}*w/(1+(w/{velocity})^2)", f"{size}*log(1+w/{velocity})", f"{size}*w^0.1"])},
        lambda: {"law": "n-shaped", "coefficient": strength, "velocity": velocity},
        lambda: {"law": "flash-heating", "strength": strength, "weakened": short(0.3 * strength), "velocity": velocity},
        lambda: {"law": "slip-weakening", "strength": strength, "residual": chance.choice([0.0, short(strength / 3)]),
                 "characteristic_slip": decades(chance, 1e-3, 1)},
        lambda: rate_and_state(chance),
        lambda: rate_and_state(chance),
    ])()


def ageing_contacts(chance):
    return {"contact_ageing": decades(chance, 1e-4, 0.02), "contact_time": decades(chance, 1e-3, 1),
            "dilatancy": decades(chance, 1e-3, 0.1), "drainage_time": decades(chance, 0.1, 1e3), "pore_pressure": 0.5}


def make(number):
    """The scenario of this number, with the commands that can run it: (scenario, [command])."""
    chance = random.Random(f"wild {number}")
    s = {"title": f"wild {number}", "initial": initial(chance), "friction": friction(chance)}
    if chance.random() < 0.25:
        s["forcing"] = chance.choice([forcing(chance), {"formula": f"{between(chance, -0.05, 0.05)}*sqrt(t)"}])
    if chance.random() < 0.25:
        s["interface"] = contact(chance)
    s["time"] = {"end": decades(chance, 1e-3, 10)}
    s["domain"] = {"left": -3.5 if "rows" in s["initial"] else -decades(chance, 0.1, 8),
                   "right": 3.5 if "rows" in s["initial"] else decades(chance, 0.1, 8)}
    s["pulse"] = {"cells": chance.choice(SMALL if chance.random() < 0.7 else MANY),
                  "left": chance.choice(ENDS), "right": chance.choice(ENDS)}
    if chance.random() < 0.1:
        s["pulse"] = {"cells": s["pulse"]["cells"], "periodic": True}
    s["chain"] = {"scale": decades(chance, 1, 20)}
    commands = ["pulse", "chain"] if chance.random() < 0.3 else ["pulse"]
    if chance.random() < 0.15:
        s["loading"] = {"stiffness": decades(chance, 1e-5, 0.1), "velocity": decades(chance, 1e-5, 0.05),
                        "where": chance.choice(["everywhere", "left", "right"])}
        commands = ["chain"]
    if s["friction"]["law"] == "rate-and-state" and chance.random() < 0.2:
        s["friction"].update(ageing_contacts(chance))
        commands = ["chain"]
    return s, commands
