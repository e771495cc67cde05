"""Ruptures on a fault plane: slipfront.plane."""

from . import _slipfront
from ._numbers import thread_count
from ._progress import showing
from ._run import dataset_of
from ._scenario import arguments


def plane(scenario, *, direct=False, set=None, output=None, resume=None, progress=None, threads=None, errors=True, si=None):
    """Runs a rupture on a fault plane, with the averaged equations or with every dislocation line (docs/plane.md).

    Parameters
    ----------
    scenario : path, str or dict
        Path of a TOML file, TOML text (a str with a line break), or a dict nested like the TOML, with the table [plane]
        (docs/scenario.md). A finite-fault model (.fsp) is computed line by line.
    direct : bool, optional
        Whether to follow every dislocation line, which needs chain.scale. By default, the averaged equations are solved.
    set : dict, optional
        Values that replace those of the scenario, such as {"plane.loops": 240}.
    output, resume, progress, si
        As in `pulse`. To resume, the scenario must be that of the file, with the same end.
    threads : int, optional
        Number of threads of a direct run, by default all cores. Results are identical to the bit for any number.
    errors : bool, optional
        Whether to estimate the errors of the results of the averaged equations. This runs the scenario again with half and
        with a quarter of the cells, which takes a quarter of the time.

    Returns
    -------
    xarray.Dataset with the contents of the NetCDF file except its checkpoint. slip, in b / (2 pi), and slip_velocity, in
    c A / pi, depend on time, y and x. rupture_time, rupture_velocity, peak_slip_velocity, rise_time, initial_stress and
    final_stress depend on y and x. potency, moment, their rates, front and energies depend on series_time, and
    moment_rate_spectrum on frequency. With output.lines = true, line_time, line_number, line_x and line_y depend on
    line_point: they are the points of the rupture front or, with `direct`, of all dislocation lines, with NaN after each
    line. The attributes are the values that `slipfront plane --json` prints; energies have names such as energy_kinetic,
    and the comparison with a finite-fault model names such as model_duration. With `errors`, the attributes potency_error
    and so on are their estimated errors.

    Raises
    ------
    InputError if the scenario or a parameter is wrong; FileError if a file cannot be read or written; NumericsError if the
    computation fails. A KeyboardInterrupt leaves a checkpoint in the output.

    Examples
    --------
    >>> rings = slipfront.plane(slipfront.cases / "plane-rings.toml", set={"plane.loops": 60})
    >>> dict(rings.slip.sizes)
    {'time': 13, 'y': 200, 'x': 200}
    """
    with showing(progress) as call:
        request = arguments(scenario, set=set, output=output, resume=resume, progress=call, si=si)
        return dataset_of(_slipfront.plane(request, bool(direct), bool(errors), thread_count(threads)))
