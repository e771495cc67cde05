"""Libraries that are loaded when they are needed."""

import importlib
import pathlib
import platform

_packages = {"xarray": "python3-xarray", "numpy": "python3-numpy",
             "matplotlib": "python3-matplotlib", "netCDF4": "python3-netcdf4",
             "distributed": "python3-distributed", "pandas": "python3-pandas", "PIL": "python3-pil",
             "scipy": "python3-scipy", "emcee": "python3-emcee"}
_pip = {"PIL": "pillow"}


def import_optional(module):
    """Returns a module. If it is missing, the ImportError names its packages for apt and pip."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        top = (error.name or module).partition(".")[0]  # xarray, for example, needs pandas
        if top not in _packages:
            raise
        raise ImportError(f"{top} is missing; install the Debian package {_packages[top]}, or `pip "
                          f"install {_pip.get(top, top)}`", name=top) from error


def require_compiled():
    """Raises ImportError in one sentence if the compiled module of the package cannot be loaded."""
    try:
        importlib.import_module("._slipfront", __package__)
    except ImportError as error:
        here = f"Python {platform.python_version()} on {platform.machine()} {platform.system()}"
        files = pathlib.Path(__file__).parent.glob("_slipfront.*.so")
        # Such as cpython-311-x86_64-linux-gnu
        built_for = sorted(file.name.split(".")[1] for file in files)
        module = (f"its compiled module, which was built for {', '.join(built_for)}," if built_for
                  else "a compiled module, because none was built,")
        raise ImportError(f"slipfront cannot load {module} with {here} ({error}); use Linux and "
                          "the Python for which it was built, or build it with `pip install .`",
                          name=f"{__package__}._slipfront") from error
