"""
A finite-fault model
====================

Slip, rupture time, rise time and static stress drop of a model in the format of SRCMOD. The model is
synthetic.
"""
import pathlib
import subprocess
import tempfile

import xarray

import slipfront
from slipfront import plots

with tempfile.TemporaryDirectory() as folder:
    grid = pathlib.Path(folder) / "grid.nc"
    subprocess.run(["slipfront", "event", slipfront.cases / "synthetic-fault.fsp",
                    "--fault-grid", "-o", grid, "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    figure = plots.fault(xarray.load_dataset(grid))
