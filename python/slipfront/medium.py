"""Constants of rock and interface (Eqs. 1-3), in SI units. Arguments broadcast as in numpy."""

from . import _slipfront
from ._numbers import broadcasting, one_number

__all__ = ["plastic_contact_ratio", "poisson_ratio", "printed_traction_unit", "slip_velocity_unit",
           "speed_from_p_wave", "speed_from_s_wave", "speed_from_shear_modulus", "stress_unit",
           "traction_unit", "units"]


def _each(function, **given):
    return getattr(_slipfront, function)(*broadcasting(**given))


def speed_from_p_wave(p_wave_speed, poisson_ratio):
    """The speed c of Eq. (3) in m/s, c_l sqrt(1 - 2 nu) / (1 - nu).

    >>> round(float(slipfront.medium.speed_from_p_wave(6000, 0.3)))
    5421
    """
    return _each("speed_from_p_wave", p_wave_speed=p_wave_speed, poisson_ratio=poisson_ratio)


def speed_from_s_wave(s_wave_speed, poisson_ratio):
    """The speed c of Eq. (3) in m/s, c_s sqrt(2 / (1 - nu)).

    >>> round(float(slipfront.medium.speed_from_s_wave(3300, 0.3)))
    5578
    """
    return _each("speed_from_s_wave", s_wave_speed=s_wave_speed, poisson_ratio=poisson_ratio)


def speed_from_shear_modulus(shear_modulus, density, poisson_ratio):
    """The speed c of Eq. (3) in m/s, sqrt(2 mu / (rho (1 - nu))).

    >>> round(float(slipfront.medium.speed_from_shear_modulus(30e9, 2700, 0.3)))
    5634
    """
    return _each("speed_from_shear_modulus", shear_modulus=shear_modulus, density=density,
                 poisson_ratio=poisson_ratio)


def poisson_ratio(p_wave_speed, s_wave_speed):
    """Poisson ratio from the two wave speeds, for c_l > 2 c_s / sqrt(3).

    >>> round(float(slipfront.medium.poisson_ratio(6000, 3300)), 4)
    0.2832
    """
    return _each("poisson_ratio", p_wave_speed=p_wave_speed, s_wave_speed=s_wave_speed)


def plastic_contact_ratio(poisson_ratio):
    """A_plastic = sqrt((1 - nu) / 2), the contact ratio at which the interface yields.

    >>> round(float(slipfront.medium.plastic_contact_ratio(0.3)), 4)
    0.5916
    """
    return _each("plastic_contact_ratio", poisson_ratio=poisson_ratio)


def stress_unit(shear_modulus, contact_ratio):
    """mu A / pi, in Pa.

    >>> round(float(slipfront.medium.stress_unit(30e9, 0.01)))
    95492966
    """
    return _each("stress_unit", shear_modulus=shear_modulus, contact_ratio=contact_ratio)


def slip_velocity_unit(speed, contact_ratio):
    """c A / pi, in m/s: twice what differentiating u gives, as both faces move.

    >>> round(float(slipfront.medium.slip_velocity_unit(5421, 0.01)), 2)
    17.26
    """
    return _each("slip_velocity_unit", speed=speed, contact_ratio=contact_ratio)


def traction_unit(shear_modulus, poisson_ratio, contact_ratio):
    """The unit of F and f, mu A^2 / (pi (1 - nu)), in Pa: F = 1 is the force F_d of Eq. (1) on each
    asperity, one to an area b^2.

    >>> round(float(slipfront.medium.traction_unit(30e9, 0.3, 0.01)))
    1364185
    """
    return _each("traction_unit", shear_modulus=shear_modulus, poisson_ratio=poisson_ratio,
                 contact_ratio=contact_ratio)


def printed_traction_unit(shear_modulus, contact_ratio):
    """The unit of F and f that the paper prints, mu A / (2 pi), in Pa: larger than Eq. (1) gives by
    (1 - nu) / (2 A).

    >>> round(float(slipfront.medium.printed_traction_unit(30e9, 0.01)))
    47746483
    """
    return _each("printed_traction_unit", shear_modulus=shear_modulus, contact_ratio=contact_ratio)


def units(shear_modulus, speed, contact_ratio, asperity_spacing):
    """A dict of the SI value of each dimensionless unit: slip, length, time, strain, stress,
    slip_velocity, velocity. Arguments are single numbers. The unit of F needs Poisson's ratio too:
    traction_unit.

    >>> units = slipfront.medium.units(30e9, 5421, 0.01, 1e-3)
    >>> round(units["length"], 6)
    0.1
    """
    given = {"shear_modulus": shear_modulus, "speed": speed, "contact_ratio": contact_ratio,
             "asperity_spacing": asperity_spacing}
    return _slipfront.units(*(one_number(name, value) for name, value in given.items()))
