"""Units of the model in SI units, and constants of rock and interface as users give them."""

import math

from . import _slipfront
from . import medium as laws
from ._messages import shown
from ._slipfront import InputError

#: Dimensions of the constants of rock and interface.
CONSTANTS = {"shear_modulus": "pressure", "poisson_ratio": "ratio", "p_wave_speed": "velocity",
             "s_wave_speed": "velocity", "density": "density", "contact_ratio": "ratio",
             "asperity_spacing": "length"}

#: What constants with bounds of their own must be above, and below, and these limits in words.
_LIMITS = {"poisson_ratio": (-1, 0.5, "above -1 and below 0.5"),
           "contact_ratio": (0, math.nextafter(1, 2), "above 0 and at most 1")}


def symbols(text):
    """Returns the constants in a unit of the model. Raises InputError for other texts."""
    return set(_slipfront.unit_symbols(str(text)).split())


def in_si(text, values):
    """Returns the SI value of a unit of the model, its UDUNITS name, and whether it is of slip.

    That of slip is twice as large, because slip is then between the faces. `values` has each symbol
    of the text. Raises InputError for a text that is not a unit of the model."""
    known = [math.nan if values[s] is None else values[s] for s in ("mu", "nu", "A", "b", "c")]
    return _slipfront.unit_in_si(str(text), known)


def converted(attrs, unit):
    """Returns the attributes of a variable in SI units. `unit` is a result of in_si."""
    _, name, between_faces = unit
    found = dict(attrs)
    if between_faces:
        found["long_name"] = f"{attrs.get('long_name', '')}, between the faces".removeprefix(", ")
    if "dimensional_unit" in found:
        found["unit_of_model"] = found.pop("dimensional_unit")
    return {**found, "units": name}


def of_model(attrs):
    """Returns the attributes in the unit of the model of a variable, from those in SI units."""
    left_out = ("unit_of_model", "scale_factor", "_FillValue")
    kept = {key: value for key, value in attrs.items() if key not in left_out}
    if "unit_of_model" in attrs:
        kept.update(units="1", dimensional_unit=attrs["unit_of_model"],
                    long_name=attrs["long_name"].removesuffix(", between the faces"))
    return kept


def without_si(attrs):
    """Returns the attributes of a Dataset without those that only one in SI units has."""
    return {k: value for k, value in attrs.items() if k not in ("unit_system", "medium", "comment")}


def constant(name, value):
    """Returns a constant in SI units, from a number in them or a text. Raises InputError."""
    if name not in CONSTANTS:
        raise InputError(f"medium: '{shown(name)}': unknown; allowed: {', '.join(CONSTANTS)}")
    result = quantity(name, value, CONSTANTS[name])
    above, below, words = _LIMITS.get(name, (0, math.inf, "positive and finite"))
    if not above < result < below:
        raise InputError(f"{name} = '{shown(value)}': out of range; allowed: {words}")
    return result


def quantity(name, value, dimension):
    """Returns a number in SI units, or such a text as "30 GPa", as a number. Raises InputError."""
    if isinstance(value, str):
        return _slipfront.quantity(name, value, dimension)
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} = '{shown(value)}': not one number; "
                         "allowed: a number in SI units, or a text with a unit") from None


def _speed(given, nu, modulus):
    """Returns c in m/s, or None if it is not known."""
    if nu is None:
        return None
    if "p_wave_speed" in given:
        return float(laws.speed_from_p_wave(given["p_wave_speed"], nu))
    if "s_wave_speed" in given:
        return float(laws.speed_from_s_wave(given["s_wave_speed"], nu))
    if modulus is None or "density" not in given:
        return None
    return float(laws.speed_from_shear_modulus(modulus, given["density"], nu))


def values_of(wanted, given):
    """Returns the values of the symbols mu, nu, A, b and c from constants in SI units.

    Raises InputError that names the constants that the symbols `wanted` lack."""
    nu, modulus = given.get("poisson_ratio"), given.get("shear_modulus")
    if nu is None and {"p_wave_speed", "s_wave_speed"} <= set(given):
        nu = float(laws.poisson_ratio(given["p_wave_speed"], given["s_wave_speed"]))
    if modulus is None and {"s_wave_speed", "density"} <= set(given):
        modulus = given["density"] * given["s_wave_speed"] ** 2
    values = {"A": given.get("contact_ratio"), "b": given.get("asperity_spacing"), "mu": modulus,
              "nu": nu, "c": _speed(given, nu, modulus)}
    sources = {"A": ["contact_ratio"], "b": ["spacing (the asperity spacing, in m)"],
               "mu": ["shear_modulus"], "nu": ["poisson_ratio"],
               "c": ["p_wave_speed"] if nu is not None else ["poisson_ratio", "p_wave_speed"]}
    missing = [name for symbol, names in sources.items() for name in names
               if symbol in wanted and values[symbol] is None]
    if missing:
        raise InputError(f"si: missing constants: {', '.join(dict.fromkeys(missing))}; allowed: "
                         "the parameters contact_ratio and spacing, and the others in medium, such "
                         "as medium={'shear_modulus': '30 GPa', 'p_wave_speed': '6 km/s', "
                         "'poisson_ratio': 0.3}")
    return values
