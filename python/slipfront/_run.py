"""The functions that run scenarios, slipfront.pulse, chain, plane and compare; check; and slipfront.open, which reads their files."""

import contextlib
import os
import warnings

from . import _slipfront, _units
from ._dataset import attributes, dataset
from ._optional import import_optional
from ._numbers import np, numbers, one_number, thread_count
from ._plan import Plan
from ._progress import showing
from ._scenario import arguments, path
from ._shown import shown
from ._slipfront import FileError, InputError

nan = float("nan")


def in_results(result, dims, values, about):
    """Returns a variable of a result in the units of the results."""
    attrs, unit = attributes(about), result["units"].get(about[2])
    return (dims, values * unit[0], _units.converted(attrs, unit)) if unit else (dims, values, attrs)


def dataset_of(result):
    """Returns the Dataset that the NetCDF file of this run holds. The summary and its errors are attributes."""
    for warning in result["warnings"]:
        warnings.warn(warning, stacklevel=3)
    variables = {}
    for about, dims, values, further in result["variables"]:
        variables[about[0]] = in_results(result, dims, values, about)
        variables[about[0]][2].update(further)
    errors = {f"{key}_error": error for key, error in result.get("errors", {}).items()}
    return dataset(variables, None, {**result["attributes"], **result["summary"], **errors})


def pulse(scenario, *, set=None, output=None, resume=None, progress=None, threads=None, tolerance=None, errors=True, si=None):
    """Runs a scenario with the modulation equations and friction, Eqs. (7) (docs/pulse.md).

    Parameters
    ----------
    scenario : path, str or dict
        Path of a TOML file, TOML text (a str with a line break), or a dict nested like the TOML (docs/scenario.md).
    set : dict, optional
        Values that replace those of the scenario, such as {"friction.coefficient": 0.5}.
    output : path, optional
        NetCDF file to write. It is written at intervals during the run, so that the run can be resumed, and at the end. The
        file is always complete.
    resume : path, optional
        File of an unfinished run of this scenario to resume. With a later time.end, also a finished run. The results are
        written to this file unless there is an `output`.
    progress : bool or callable, optional
        True shows a line on stderr. A function is called at most ten times a second with (time, end, steps, "").
    threads : int, optional
        Accepted as on the command line, without effect (docs/pulse.md).
    tolerance : float, optional
        Relative error, 1e-9 to 1, of slip, slip velocity and stress at x = 0 and of the peak. The number of cells is doubled
        from that of the scenario until the error is reached. Not allowed with `resume`.
    errors : bool, optional
        Whether to estimate the errors of the results. This runs the scenario again with half and with a quarter of the cells,
        which takes a third of the time.
    si : bool, optional
        Whether the results are in SI units, by the constants of the table [medium]: variables, attributes and the file. By
        default they are if the scenario has values with units outside of [medium].

    Returns
    -------
    xarray.Dataset with the contents of the NetCDF file except its checkpoint. The dimensions are time, in b / (c A), and x,
    in b / A. k, Sigma, U, W, slip and stress_drop depend on both. Fronts, energies and values at x = 0 depend on time. The
    attributes are the values that `slipfront pulse --json` prints for the end of the run: closure, friction_coefficient,
    damping_number, ..., wall_seconds. A value that does not exist is NaN, such as friction_coefficient and damping_number
    (Gamma = C t) unless friction is viscous; some have a reason, such as energy_shocks_reason. With `errors`, the
    attributes slip_at_origin_error and so on are their estimated errors.

    Raises
    ------
    InputError if the scenario or a parameter is wrong; FileError if a file cannot be read or written; NumericsError if the
    computation fails. A KeyboardInterrupt leaves a checkpoint in the output.

    Examples
    --------
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml", set={"pulse.cells": 200})
    >>> dict(pulse.sizes)
    {'time': 2, 'x': 200, 'ends': 2}
    >>> round(pulse.attrs["slip_at_origin"], 2)
    0.3
    """
    thread_count(threads)
    if tolerance is not None:
        tolerance = one_number("tolerance", tolerance)
    with showing(progress) as call:
        request = arguments(scenario, set=set, output=output, resume=resume, progress=call, si=si)
        return dataset_of(_slipfront.pulse(request, tolerance, bool(errors)))


def chain(scenario, *, set=None, output=None, resume=None, progress=None, threads=None, si=None):
    """Runs a scenario with a chain that resolves every dislocation, Eqs. (1) and (3) (docs/chain.md).

    Parameters
    ----------
    scenario : path, str or dict
        Path of a TOML file, TOML text (a str with a line break), or a dict nested like the TOML (docs/scenario.md).
    set : dict, optional
        Values that replace those of the scenario, such as {"chain.scale": 300}.
    output, resume, progress, si
        As in `pulse`.
    threads : int, optional
        Number of threads that share the sites, by default all cores. Results are identical to the bit for any number.

    Returns
    -------
    xarray.Dataset with the variables of `pulse`. The attributes are the values that `slipfront chain --json` prints: time,
    scale, ..., dislocations, energy_drift, charge_error, wall_seconds. With a table [loading], slip events have the
    variables event_onset, event_duration, ... over the dimension `event`. With output.fronts, event_arrival and the stresses
    before each event depend on `event` and `position`. With output.displacement, `displacement` depends on time and `site`.
    With output.dislocations, `dislocation_position` and `dislocation_level` depend on time and `dislocation`, and
    `dislocation_sign` on `dislocation`. They are NaN while a dislocation is not in the chain.

    Raises
    ------
    InputError if the scenario or a parameter is wrong; FileError if a file cannot be read or written; NumericsError if the
    computation fails. A KeyboardInterrupt leaves a checkpoint in the output.

    Examples
    --------
    >>> chain = slipfront.chain(slipfront.cases / "step.toml", set={"chain.scale": 300})
    >>> chain.attrs["dislocations"]
    108
    """
    with showing(progress) as call:
        request = arguments(scenario, set=set, output=output, resume=resume, progress=call, si=si)
        return dataset_of(_slipfront.chain(request, thread_count(threads)))


def plane(scenario, *, direct=False, set=None, output=None, resume=None, progress=None, threads=None, errors=True, si=None):
    """Runs a rupture on a fault plane, with the averaged equations or with every dislocation line (docs/plane.md).

    Parameters
    ----------
    scenario : path, str or dict
        Path of a TOML file, TOML text (a str with a line break), or a dict nested like the TOML, with the table [plane]
        (docs/scenario.md). A finite-fault model is computed line by line.
    direct : bool, optional
        Whether to follow every dislocation line, which needs chain.scale. By default, the averaged equations are solved.
    set : dict, optional
        Values that replace those of the scenario, such as {"plane.loops": 240}.
    output, resume, progress, si
        As in `pulse`.
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


def _scales(scales):
    return numbers("scales", scales).reshape(-1).tolist()


def compare(scenario, *, scales=(), set=None, output=None, progress=None, threads=None, si=None):
    """Runs a scenario at each level of theory and compares the results.

    The levels are the closed form, if there is one, the pulse with both closures, and a chain for each scale.

    Parameters
    ----------
    scales : sequence of float, optional
        Scales of the chains, each > 0. By default that of the scenario, or 100, 300 and 1000.
    scenario, set, output, progress, threads, si
        As in `pulse` and `chain`. The output is written level by level and cannot be resumed.

    Returns
    -------
    xarray.Dataset with the variables of `pulse` for each level, which has a name: `result.sel(name="chain-1000")`. The
    variables `closure`, `scale`, `window`, `smooth_window` (averaging windows of a chain, in b / A) and `wall_seconds` (s)
    describe a level. `difference` is the value at the end of the run minus that of the level pulse-consistent, for each
    level and quantity. `trend_exponent`, `trend_extrapolated` and `trend_difference` describe how the chain approaches
    that level with increasing scale. The last two are NaN if the difference does not fall. The attributes are time,
    friction_coefficient, damping_number (both NaN unless friction is viscous), reference and notes.

    Raises
    ------
    InputError if the scenario or a parameter is wrong; FileError if a file cannot be read or written; NumericsError if the
    computation fails.

    Examples
    --------
    >>> levels = slipfront.compare(slipfront.cases / "step.toml", scales=[300])
    >>> levels.name.values.tolist()
    ['closed-form', 'pulse-consistent', 'pulse-paper', 'chain-300']
    """
    with showing(progress) as call:
        result = _slipfront.compare(arguments(scenario, set=set, output=output, progress=call, si=si), _scales(scales), thread_count(threads))
    levels, trends = result["levels"], result["trends"]
    result["summary"].update(reference="pulse-consistent", notes="\n".join(result["notes"]))
    data = dataset_of(result)
    names = [level["name"] for level in levels]

    def of_levels(key):
        return np.array([nan if level[key] is None else level[key] for level in levels], dtype=float)

    quantities = [trend[0] for trend in trends]
    last = np.array([[float(data[q][i, -1]) for q in quantities] for i in range(len(levels))]).reshape(len(levels), len(quantities))
    reference = last[names.index("pulse-consistent")] if "pulse-consistent" in names else np.full(len(quantities), nan)
    one = {"units": "1"}
    data = data.assign({
        "closure": ("level", [level["closure"] for level in levels], {"long_name": "how friction is averaged"}),
        **{about[0]: in_results(result, "level", values, about) for about, values in result["level_numbers"]},
        "wall_seconds": ("level", of_levels("wall_seconds"), {"long_name": "wall-clock time of the level", "units": "s"}),
        "difference": (("level", "quantity"), last - reference, {**one, "long_name": "value at the end of the run minus that of pulse-consistent"}),
        "trend_exponent": ("quantity", [t[1] for t in trends], {**one, "long_name": "p: the difference of the chain from pulse-consistent falls as scale^-p"}),
        "trend_extrapolated": ("quantity", [t[2] for t in trends], {**one, "long_name": "value of the chain, extrapolated to infinite scale"}),
        "trend_difference": ("quantity", [t[3] for t in trends], {**one, "long_name": "extrapolated value minus that of pulse-consistent"}),
    })
    scale = ("level", of_levels("scale"), attributes(result["scale_about"]))
    data = data.assign_coords(name=("level", names, {"long_name": "level of theory"}), scale=scale, quantity=quantities)
    return data.set_xindex("name")


def check(scenario, *, set=None, command="pulse", scales=(), direct=False):
    """Checks a scenario without running it.

    The function reads and validates the scenario and sets up the run.

    Parameters
    ----------
    scenario, set
        As in `pulse`.
    command : "pulse", "chain", "plane" or "compare", optional
        The run to check.
    scales : sequence of float, optional
        Scales of the chains of "compare".
    direct : bool, optional
        Whether "plane" follows every dislocation line.

    Returns
    -------
    dict that describes the run: title; cells, sites or levels; left and right end of the domain; end of time; memory_bytes
    and disk_bytes (estimated, in bytes); and more, depending on the command. A notebook shows it as a table.

    Raises
    ------
    InputError, FileError or NumericsError, as the run would before its first step.

    Examples
    --------
    >>> slipfront.check(slipfront.cases / "step.toml")["cells"]
    400
    """
    request = arguments(scenario, set=set)
    if command == "pulse":
        return Plan(_slipfront.check_pulse(request))
    if command == "chain":
        return Plan(_slipfront.check_chain(request))
    if command == "plane":
        return Plan(_slipfront.check_plane(request, bool(direct)))
    if command == "compare":
        return Plan(_slipfront.check_compare(request, _scales(scales)))
    raise InputError(f"command = '{shown(command)}': unknown; allowed: pulse, chain, plane, compare")


def open(file, *, group=None, si=None):
    """Reads a NetCDF file that pulse, chain, plane, compare, sweep or event has written.

    Parameters
    ----------
    file : path
        The file, written by the program (`-o`) or by this package (`output`).
    group : str, optional
        A group of a file with draws of events: "posterior", "prior", "posterior_predictive", "observed_data" or
        "sample_stats" (docs/events.md).
    si : bool, optional
        Whether the variables are in SI units. By default they are in the units of the run. A file in the units of the model is
        converted by the constants in its scenario, as by `dataset.slipfront.si()`.

    Returns
    -------
    xarray.Dataset with the variables, coordinates and attributes that the run returned. All values are in memory, and the file
    is closed. A file does not hold what describes only the computation: the estimated errors, counts of steps and clocks
    of a pulse or a chain, the medians of its events, and the differences and trends of a comparison. A file of events also has the population and
    the settings.

    Raises
    ------
    InputError if `file` is not a path; FileError if the file cannot be read or slipfront has not written it.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     pulse = slipfront.pulse(slipfront.cases / "step.toml", output=f"{folder}/pulse.nc")
    ...     stored = slipfront.open(f"{folder}/pulse.nc")
    >>> bool((stored.W == pulse.W).all())
    True
    """
    data = read(path("file", file), group=None if group is None else str(group), si=si)
    return data.slipfront.si() if si else data


def _summary(data):
    """Returns the attributes of a finished pulse or chain that follow from its file: the values at the end, and the settings of
    a pulse."""
    command = str(data.attrs.get("history", "")).split()[1:2]
    known = {row[0] for row in _slipfront.numbers_of(command[0])} if command in (["pulse"], ["chain"]) else set()
    found = {str(name): variable.values[-1].item() for name, variable in data.variables.items() if variable.dims == ("time",) and name in known}
    if command == ["pulse"]:
        with contextlib.suppress(InputError, FileError):  # its table of stress may be gone
            plan = check(str(data.attrs["scenario"]) + "\n")
            coefficient = nan if plan["friction_coefficient"] is None else plan["friction_coefficient"]
            found.update(closure=plan["closure"], cells=plan["cells"], friction_coefficient=coefficient, damping_number=coefficient * plan["end"])
    return found


def _in_model(data):
    """Returns a Dataset in the units of the model, from the stored numbers of a file in SI units."""
    if not any("scale_factor" in variable.attrs for variable in data.variables.values()):
        raise InputError("si = False: the file has its results in SI units only; allowed: None or True")
    for variable in data.variables.values():
        variable.attrs = _units.of_model(variable.attrs)
    data.attrs = _units.without_si(data.attrs)
    return data


def read(name, any_file=False, group=None, si=None):
    """Like `open`, but also reads other NetCDF files if `any_file` is true. It does not convert results to SI units."""
    xarray = import_optional("xarray")
    with _slipfront.NetcdfLock():  # the import initialises the libraries of NetCDF
        import_optional("netCDF4")
    _slipfront.require_unbroken_seal(os.fsencode(name))  # a damaged file can crash the NetCDF library, and Python with it
    try:
        # The NetCDF library is not thread-safe. A process that is forked while another thread uses it would wait for ever.
        with _slipfront.NetcdfLock(), contextlib.ExitStack() as files:
            stored = files.enter_context(xarray.open_dataset(name, engine="netcdf4", group=group))
            if not (any_file or "slipfront_format" in stored.attrs):
                raise FileError(f"{name}: not a file that slipfront has written")
            in_si = stored.attrs.get("unit_system") == "SI"
            if in_si and si is False:
                stored = files.enter_context(xarray.open_dataset(name, engine="netcdf4", group=group, mask_and_scale=False))
            data = stored.drop_vars(["checkpoint", "scenario_text", "done"], errors="ignore").load()
    except OSError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"{name}: {error.strerror or error}") from error
    except (RuntimeError, ValueError) as error:  # its contents are damaged
        raise FileError(f"{name}: {' '.join(str(error).split())}") from error
    if in_si and si is False:
        data = _in_model(data)
    if data.attrs.get("slipfront_format") == "sweep 1":  # its dimensions have dots, as in friction.coefficient
        names = {name: name.replace(".", "_") for name in data.dims}
        data = data.drop_vars([new for old, new in names.items() if new != old], errors="ignore").rename(names)
    data.attrs = {name: value.item() if isinstance(value, np.generic) else value for name, value in data.attrs.items()}
    if data.attrs.get("finished") == 1 and data.sizes.get("time"):
        data = data.assign_attrs(_summary(data))
    if "name" in data.coords:
        data = data.set_xindex("name")
    return data
