"""Slip pulses on frictional interfaces: from the stress stored along an interface to how fast it slips, and back.

Functions have the names of the command line and give xarray Datasets. Everything is dimensionless; the attribute
`dimensional_unit` of a variable is what to multiply it by, `references` the equation of the paper (Gershenzon,
Bambakidis and Skinner 2015, doi 10.3390/lubricants3020311).
"""

from ._slipfront import FileError, InputError, NumericsError, __version__
from ._relations import relations

__all__ = ["FileError", "InputError", "NumericsError", "__version__", "relations"]
