"""Constants of rock and interface (Eqs. 1-3), in SI units; arrays as in numpy."""

from ._slipfront import (plastic_contact_ratio, poisson_ratio, slip_velocity_unit, speed_from_p_wave, speed_from_s_wave,
                         speed_from_shear_modulus, stress_unit, units)

__all__ = ["plastic_contact_ratio", "poisson_ratio", "slip_velocity_unit", "speed_from_p_wave", "speed_from_s_wave",
           "speed_from_shear_modulus", "stress_unit", "units"]
