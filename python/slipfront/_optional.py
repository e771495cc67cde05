"""Libraries that are loaded when they are needed."""

import importlib

_packages = {"xarray": "python3-xarray", "numpy": "python3-numpy", "matplotlib": "python3-matplotlib", "netCDF4": "python3-netcdf4",
             "distributed": "python3-distributed", "pandas": "python3-pandas", "PIL": "python3-pil"}


def import_optional(module):
    """The module of this (dotted) name. Raises ImportError that names the Debian package where it is missing."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        top = module.partition(".")[0]
        if error.name is not None and error.name.partition(".")[0] != top:
            raise
        raise ImportError(f"{top} is missing; install the Debian package {_packages[top]}", name=top) from error
