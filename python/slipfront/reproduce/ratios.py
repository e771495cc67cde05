"""Fig. 10 from a smooth profile into a stressed side, of the width nearest to the paper."""

import numpy
import xarray

from .._dataset import about
from . import picture as look
from .numbers import FRICTION
from .runs import CLOSURES, at_origin

WIDTHS = numpy.round(numpy.concatenate((numpy.arange(0.05, 0.6, 0.05),
                                        numpy.arange(0.6, 1.25, 0.1))), 3)
COEFFICIENTS = (0.0, *FRICTION)


def share(runs, case, changes) -> numpy.ndarray:
    """Returns W(0) over that without friction at COEFFICIENTS, for each of `changes`."""
    wanted = [(case, change | {"friction.law": "viscous", "friction.coefficient": c})
              for change in changes for c in COEFFICIENTS]
    W = numpy.reshape([at_origin(run) for run in runs.many("Fig. 10, widths", wanted)],
                      (len(changes), len(COEFFICIENTS)))
    return W / W[:, :1]


def nearest(by_width, read) -> int:
    """Returns the index of the width with the least sum of squared logarithms."""
    return int((numpy.log(by_width[:, 1:] / numpy.asarray(read)) ** 2).sum(axis=1).argmin())


def ratios(runs, read) -> xarray.Dataset:
    """Returns ratios into Sigma+ = 0.179, over closure and friction coefficient.

    They are from the nearest width (`smooth`), at Parkfield's Sigma- = 1.03 (`at_parkfield`, width
    0.1) and from a true step (`step_stressed`); `by_width` is with the paper's closure."""
    by_width = share(runs, "fig-10.toml", [{"friction.closure": "paper", "initial.width": width}
                                           for width in WIDTHS.tolist()])
    width = float(WIDTHS[nearest(by_width, read)])
    changes = {"smooth": ("fig-10.toml", {"initial.width": width}),
               "at_parkfield": ("fig-10.toml", {"initial.width": 0.1, "initial.stress_left": 1.03}),
               "step_stressed": ("step.toml", {"initial.stress_right": 0.179})}
    attrs = about("slip velocity at x = 0 over that without friction, into Sigma+ = 0.179")
    variables = {}
    for name, (case, change) in changes.items():
        values = share(runs, case, [{"friction.closure": closure} | change for closure in CLOSURES])
        variables[name] = (("closure", "friction_coefficient"), values, attrs)
    variables["by_width"] = (("width", "friction_coefficient"), by_width,
                             about("the same with the paper's closure"))
    return xarray.Dataset(
        variables,
        {"closure": list(CLOSURES),
         "friction_coefficient": ("friction_coefficient", list(COEFFICIENTS), look.FRICTION),
         "width": ("width", WIDTHS, about("width of the initial tanh profile", "b / A"))},
        {"width": width})
