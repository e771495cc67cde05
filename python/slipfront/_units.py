"""Units of the model in SI units, and constants of rock and interface as users give them."""

import math
import re

from . import _slipfront
from . import medium as laws
from ._shown import shown
from ._slipfront import InputError

#: Constants of rock and interface, with the powers of m, kg and s of their units and an example.
CONSTANTS = {
    "shear_modulus": ((-1, 1, -2), "30 GPa"), "poisson_ratio": ((0, 0, 0), "0.3"), "p_wave_speed": ((1, 0, -1), "6 km/s"),
    "s_wave_speed": ((1, 0, -1), "3.3 km/s"), "density": ((-3, 1, 0), "2700 kg/m^3"), "contact_ratio": ((0, 0, 0), "0.01"),
    "asperity_spacing": ((1, 0, 0), "1 mm"),
}
_BASE_UNITS = {"m": (1, (1, 0, 0)), "g": (1e-3, (0, 1, 0)), "s": (1, (0, 0, 1)), "Pa": (1, (-1, 1, -2)), "bar": (1e5, (-1, 1, -2)), "N": (1, (1, 1, -2)),
               "min": (60, (0, 0, 1)), "h": (3600, (0, 0, 1)), "day": (86400, (0, 0, 1))}
_PREFIXES = {"n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "": 1, "h": 1e2, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}


def symbols(text):
    """Returns the symbols of a unit that are constants of rock and interface. Raises InputError for other texts."""
    return set(_slipfront.unit_symbols(str(text)).split())


def in_si(text, values):
    """Returns the unit in SI units, its name by UDUNITS, and whether it is of slip. The slip of one face becomes that between the faces, so
    that this unit is twice as large. `values` has the value of each symbol of the text.

    Raises InputError for a text that is not a unit of the model."""
    known = [math.nan if values[symbol] is None else values[symbol] for symbol in ("mu", "nu", "A", "b", "c")]
    return _slipfront.unit_in_si(str(text), known)


def converted(attrs, unit):
    """Returns the attributes of a variable in SI units. `unit` is a result of in_si."""
    _, name, between_faces = unit
    words = {"long_name": f"{attrs.get('long_name', '')}, between the faces".removeprefix(", ")} if between_faces else {}
    of_model = {"unit_of_model": attrs["dimensional_unit"]} if "dimensional_unit" in attrs else {}
    return {**{key: value for key, value in attrs.items() if key != "dimensional_unit"}, **words, "units": name, **of_model}


def of_model(attrs):
    """Returns the attributes of a variable in the unit of the model again, from those that `converted` or a file in SI units has."""
    kept = {key: value for key, value in attrs.items() if key not in ("unit_of_model", "scale_factor", "_FillValue")}
    if "unit_of_model" in attrs:
        kept.update(units="1", dimensional_unit=attrs["unit_of_model"], long_name=attrs["long_name"].removesuffix(", between the faces"))
    return kept


def without_si(attrs):
    """Returns the attributes of a Dataset without those that only one in SI units has."""
    return {key: value for key, value in attrs.items() if key not in ("unit_system", "medium", "comment")}


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
