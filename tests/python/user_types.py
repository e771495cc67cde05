"""A program of a user. Nothing runs it: .ci/lint checks with mypy that the stubs accept it and find its two errors."""

import numpy as np
import xarray as xr

import slipfront
from slipfront import plots

closed: xr.Dataset = slipfront.relations(stress=[0.5, 1.03])
pulse = slipfront.pulse(slipfront.cases / "step.toml", set={"pulse.cells": 100}, errors=False)
again = slipfront.open("run.nc")
grid = slipfront.sweep("run.toml", {"friction.coefficient": np.linspace(0, 1, 3)}, set={"friction.law": "viscous"})
events = slipfront.event({"rupture_velocity": ["2.7 km/s", 3000], "slip_velocity": [0.5, 0.3]})
rows = slipfront.event([{"rupture_velocity": "2.7 km/s", "slip_velocity": 0.5}])
cells: int = slipfront.check(slipfront.cases / "step.toml")["cells"]
plots.save(plots.profiles(pulse), "pulse.png")
spacing: float = float(slipfront.train.spacing(1.0, 0.5).max())
print(closed, again, grid, events, rows, cells, spacing, slipfront.friction_ratio(1.0, 1.03), slipfront.__version__)

# mypy must find these errors: it reports an unused "type: ignore".
slipfront.pulse(stress="high")  # type: ignore[call-arg]
plots.space_time(pulse, widths=3)  # type: ignore[call-arg]
