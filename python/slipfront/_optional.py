"""Libraries that are loaded when they are needed."""

import importlib
import platform

_packages = {"xarray": "python3-xarray", "numpy": "python3-numpy", "matplotlib": "python3-matplotlib", "netCDF4": "python3-netcdf4",
             "distributed": "python3-distributed", "pandas": "python3-pandas", "PIL": "python3-pil"}
_pip = {"PIL": "pillow"}


def import_optional(module):
    """Returns the module of this (dotted) name. If it is missing, the ImportError names its packages for apt and pip."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        top = module.partition(".")[0]
        if error.name is not None and error.name.partition(".")[0] != top:
            raise
        raise ImportError(f"{top} is missing; install the Debian package {_packages[top]}, or `pip install {_pip.get(top, top)}`", name=top) from error


def require_compiled():
    """Raises ImportError in one sentence if the compiled module of the package cannot be loaded."""
    try:
        importlib.import_module("._slipfront", __package__)
    except ImportError as error:
        raise ImportError(f"slipfront cannot load its compiled module with Python {platform.python_version()} on {platform.system()} ({error}); use Linux and the "
                          "Python for which it was built, or build it with `pip install .`", name=f"{__package__}._slipfront") from error
