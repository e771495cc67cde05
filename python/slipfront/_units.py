"""Units of the model in SI units, and constants of rock and interface as users give them."""

import ast
import math
import operator
import re

from . import medium as laws
from ._shown import shown
from ._slipfront import InputError

#: Powers of Pa, m and s of each symbol of a unit.
_SYMBOLS = {"mu": (1, 0, 0), "nu": (0, 0, 0), "pi": (0, 0, 0), "A": (0, 0, 0), "b": (0, 1, 0), "c": (0, 1, -1)}
_OPERATIONS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv, ast.Pow: operator.pow}

#: Usual names of some units. Others are products of Pa, m and s.
_NAMES = {(1, 1, 0): "J m-2", (1, 2, 0): "J m-1", (0, 0, 0): "1"}

#: Constants of rock and interface, with the powers of m, kg and s of their units and an example.
CONSTANTS = {
    "shear_modulus": ((-1, 1, -2), "30 GPa"), "poisson_ratio": ((0, 0, 0), "0.3"), "p_wave_speed": ((1, 0, -1), "6 km/s"),
    "s_wave_speed": ((1, 0, -1), "3.3 km/s"), "density": ((-3, 1, 0), "2700 kg/m^3"), "contact_ratio": ((0, 0, 0), "0.01"),
    "asperity_spacing": ((1, 0, 0), "1 mm"),
}
_BASE_UNITS = {"m": (1, (1, 0, 0)), "g": (1e-3, (0, 1, 0)), "s": (1, (0, 0, 1)), "Pa": (1, (-1, 1, -2)), "bar": (1e5, (-1, 1, -2)), "N": (1, (1, 1, -2)),
               "min": (60, (0, 0, 1)), "h": (3600, (0, 0, 1)), "day": (86400, (0, 0, 1))}
_PREFIXES = {"n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "": 1, "h": 1e2, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}


def _tree(text):
    """Returns the syntax tree of a unit such as `mu A^2 / (pi (1 - nu))`. Factors may follow each other without an operator."""
    product = re.sub(r"(?<=[\w)])\s+(?=[\w(])|(?<=\))(?=[\w(])|(?<=\d)(?=[A-Za-z(])", "*", text.strip())
    try:
        return ast.parse(product.replace("^", "**"), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise _unknown(text) from None
    except SystemError as error:  # the parser of Python 3.11 ran out of memory
        raise MemoryError from error


def _unknown(text):
    return InputError(f"dimensional_unit = '{shown(text)}': not a unit of the model; allowed: products and powers of {', '.join(_SYMBOLS)}")


def symbols(text):
    """Returns the symbols of a unit that are constants of rock and interface. Raises InputError for other texts."""
    names = {node.id for node in ast.walk(_tree(text)) if isinstance(node, ast.Name)}
    if not names <= set(_SYMBOLS):
        raise _unknown(text)
    return names - {"pi"}


def in_si(text, values):
    """Returns the unit in SI units and its name by UDUNITS. `values` has the value of each symbol of the text.

    Raises InputError for a text that is not a unit of the model."""
    values = {**values, "pi": math.pi}

    def quantity(node):
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return node.value, (0, 0, 0)
        if isinstance(node, ast.Name) and node.id in _SYMBOLS:
            return values[node.id], _SYMBOLS[node.id]
        if not isinstance(node, ast.BinOp) or type(node.op) not in _OPERATIONS:
            raise _unknown(text)
        (a, left), (b, right) = quantity(node.left), quantity(node.right)
        if isinstance(node.op, ast.Pow):
            if not isinstance(node.right, ast.Constant) or not -9 <= b <= 9:
                raise _unknown(text)
            powers = tuple(p * b for p in left)
        elif isinstance(node.op, (ast.Add, ast.Sub)):
            if left != right:
                raise _unknown(text)
            powers = left
        else:
            sign = 1 if isinstance(node.op, ast.Mult) else -1
            powers = tuple(p + sign * q for p, q in zip(left, right))
        return _OPERATIONS[type(node.op)](a, b), powers

    factor, powers = quantity(_tree(text))
    parts = [f"{name}{'' if power == 1 else f'{power:g}'}" for name, power in zip(("Pa", "m", "s"), powers) if power]
    return factor, _NAMES.get(powers) or " ".join(parts)


def _named_unit(name):
    """Returns the factor and the powers of a unit with or without a prefix, such as `km`; None if it is unknown."""
    for base, (size, powers) in _BASE_UNITS.items():
        prefix = name.removesuffix(base)
        if name.endswith(base) and prefix in _PREFIXES and not (prefix and base in ("min", "h", "day", "bar")):
            return size * _PREFIXES[prefix], powers
    return None


def _unit(text):
    """Returns the factor and the powers of m, kg and s of a unit such as `kg/m^3`; None if it is unknown."""
    factor, powers, sign = 1.0, [0, 0, 0], 1
    for part in re.findall(r"/|[^\s/.*·]+", text):
        if part == "/":
            sign = -1
            continue
        found = re.fullmatch(r"([^\W\d]+)\^?(-?\d)?", part)
        unit = _named_unit(found[1]) if found else None
        if found is None or unit is None:
            return None
        power = sign * int(found[2] or 1)
        factor *= unit[0] ** power
        powers = [p + power * q for p, q in zip(powers, unit[1])]
        sign = 1
    return factor, tuple(powers)


def constant(name, value):
    """Returns a constant in SI units. `value` is a number in SI units or a text such as "30 GPa". Raises InputError."""
    if name not in CONSTANTS:
        raise InputError(f"medium: '{shown(name)}': unknown; allowed: {', '.join(CONSTANTS)}")
    result = quantity(name, value, *CONSTANTS[name])
    above, below = {"poisson_ratio": (-1, 0.5), "contact_ratio": (0, math.nextafter(1, 2))}.get(name, (0, math.inf))
    if not above < result < below:
        limits = {"poisson_ratio": "above -1 and below 0.5", "contact_ratio": "above 0 and at most 1"}.get(name, "positive and finite")
        raise InputError(f"{name} = '{shown(value)}': out of range; allowed: {limits}")
    return result


def quantity(name, value, powers, example):
    """Returns a quantity in SI units, whose unit has these powers of m, kg and s. Raises InputError."""
    allowed = f"a number in SI units, or a text such as '{example}'"
    number, factor = value, 1.0
    if isinstance(value, str):
        found = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*", value)
        if not found:
            raise InputError(f"{name} = '{shown(value)}': not a number with a unit; allowed: {allowed}")
        number, unit = float(found[1]), _unit(found[2]) if found[2] else None
        if found[2] and (unit is None or unit[1] != powers):
            raise InputError(f"{name} = '{shown(value)}': the unit is unknown or of another quantity; allowed: {allowed}")
        factor = unit[0] if unit else 1.0
    try:
        return float(number) * factor
    except (TypeError, ValueError):
        raise InputError(f"{name} = '{shown(value)}': not one number; allowed: {allowed}") from None


def values_of(wanted, given):
    """Returns the values of the symbols `wanted`, from constants in SI units. Raises InputError that names those that are missing."""
    have = given.get
    values, missing = {}, []
    nu, modulus = have("poisson_ratio"), have("shear_modulus")
    if nu is None and {"p_wave_speed", "s_wave_speed"} <= set(given):
        nu = float(laws.poisson_ratio(given["p_wave_speed"], given["s_wave_speed"]))
    if modulus is None and {"s_wave_speed", "density"} <= set(given):
        modulus = given["density"] * given["s_wave_speed"] ** 2
    speed = None
    if nu is not None:
        if "p_wave_speed" in given:
            speed = float(laws.speed_from_p_wave(given["p_wave_speed"], nu))
        elif "s_wave_speed" in given:
            speed = float(laws.speed_from_s_wave(given["s_wave_speed"], nu))
        elif modulus is not None and "density" in given:
            speed = float(laws.speed_from_shear_modulus(modulus, given["density"], nu))
    for symbol, value, source in [("A", have("contact_ratio"), "contact_ratio"), ("b", have("asperity_spacing"), "spacing (the asperity spacing, in m)"),
                                  ("mu", modulus, "shear_modulus"), ("nu", nu, "poisson_ratio"),
                                  ("c", speed, "p_wave_speed")]:
        if symbol in wanted and value is None:
            missing += [source] if symbol != "c" or nu is not None else ["poisson_ratio", source]
        values[symbol] = value
    if missing:
        raise InputError(f"si: missing constants: {', '.join(dict.fromkeys(missing))}; allowed: the parameters contact_ratio and spacing, and the others in medium, "
                         "such as medium={'shear_modulus': '30 GPa', 'p_wave_speed': '6 km/s', 'poisson_ratio': 0.3}")
    return values
