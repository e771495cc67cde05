"""The functions that run and check scenarios, and slipfront.open, which reads their files."""

import contextlib
import html
import os
import warnings

from . import _slipfront, _units
from ._dataset import about, attributes, dataset
from ._numbers import np, numbers, one_number, thread_count
from ._optional import import_optional
from ._progress import showing
from ._scenario import arguments, path
from ._messages import shown
from ._slipfront import FileError, InputError

nan = float("nan")


def in_results(result, dims, values, described):
    """Returns a variable of a result in the units of the results."""
    attrs, unit = attributes(described), result["units"].get(described[2])
    if unit:
        return dims, values * unit[0], _units.converted(attrs, unit)
    return dims, values, attrs


def dataset_of(result):
    """Returns the Dataset of the file of a run, with the summary and its errors."""
    for warning in result["warnings"]:
        warnings.warn(warning, stacklevel=3)
    variables = {}
    for described, dims, values, further in result["variables"]:
        variables[described[0]] = in_results(result, dims, values, described)
        variables[described[0]][2].update(further)
    errors = {f"{key}_error": error for key, error in result.get("errors", {}).items()}
    return dataset(variables, None, {**result["attributes"], **result["summary"], **errors})


def _run(solve, scenario, progress, *further, **given):
    """Returns the result of a binding that runs a scenario."""
    with showing(progress) as call:
        return solve(arguments(scenario, progress=call, **given), *further)


def pulse(scenario, *, set=None, output=None, resume=None, progress=None, threads=None,
          tolerance=None, errors=True, si=None):
    """Runs a scenario with the modulation equations and friction, Eqs. (7) (docs/pulse.md).

    Parameters
    ----------
    scenario : path, str or dict
        Path of a TOML file, TOML text (a str with a line break), or a dict nested like the TOML
        (docs/scenario.md).
    set : dict, optional
        Values that replace those of the scenario, such as {"friction.coefficient": 0.5}.
    output : path, optional
        NetCDF file to write, at intervals during the run, so that the run can be resumed, and at
        the end. The file is always complete.
    resume : path, optional
        File of an unfinished run of this scenario to resume. With a later time.end, also a finished
        run. The results are written to this file unless there is an `output`.
    progress : bool or callable, optional
        True shows a line on stderr. A function is called at most ten times a second with (time,
        end, steps, "").
    threads : int, optional
        Accepted as on the command line, without effect (docs/pulse.md).
    tolerance : float, optional
        Relative error, 1e-9 to 1, of slip, slip velocity and stress at x = 0 and of the peak. The
        cells of the scenario are doubled until it is reached. Not allowed with `resume`.
    errors : bool, optional
        Whether to estimate the errors of the results, by runs with half and a quarter of the cells,
        which take a third of the time.
    si : bool, optional
        Whether the results are in SI units, by the constants of the table [medium]: variables,
        attributes and the file. By default they are if the scenario has values with units outside
        of [medium].

    Returns
    -------
    xarray.Dataset with the contents of the NetCDF file except its checkpoint. The dimensions are
    time, in b / (c A), and x, in b / A. k, Sigma, U, W, slip and stress_drop depend on both.
    Fronts, energies and values at x = 0 depend on time. The attributes are the values that
    `slipfront pulse --json` prints for the end of the run: closure, friction_coefficient,
    damping_number, ..., wall_seconds. A value that does not exist is NaN, such as
    friction_coefficient and damping_number (Gamma = C t) unless friction is viscous; some have a
    reason, such as energy_shocks_reason. With `errors`, the attributes slip_at_origin_error and so
    on are their estimated errors.

    Raises
    ------
    InputError if the scenario or a parameter is wrong; FileError if a file cannot be read or
    written; NumericsError if the computation fails. A KeyboardInterrupt leaves a checkpoint in the
    output.

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
    return dataset_of(_run(_slipfront.pulse, scenario, progress, tolerance, bool(errors), set=set,
                           output=output, resume=resume, si=si))


def chain(scenario, *, set=None, output=None, resume=None, progress=None, threads=None, si=None):
    """Runs a scenario with a chain of every dislocation, Eqs. (1) and (3) (docs/chain.md).

    Parameters
    ----------
    scenario, set, output, resume, progress, si
        As in `pulse`.
    threads : int, optional
        Number of threads that share the sites, by default all cores. Results are identical to the
        bit for any number.

    Returns
    -------
    xarray.Dataset with the variables of `pulse`. The attributes are the values that `slipfront
    chain --json` prints: time, scale, ..., dislocations, energy_drift, charge_error, wall_seconds.
    With a table [loading], slip events have the variables event_onset, event_duration, ... over the
    dimension `event`. With output.fronts, event_arrival and the stresses before each event depend
    on `event` and `position`. With output.displacement, `displacement` depends on time and `site`.
    With output.dislocations, `dislocation_position` and `dislocation_level` depend on time and
    `dislocation`, and `dislocation_sign` on `dislocation`. They are NaN while a dislocation is not
    in the chain.

    Raises
    ------
    As `pulse`.

    Examples
    --------
    >>> chain = slipfront.chain(slipfront.cases / "step.toml", set={"chain.scale": 300})
    >>> chain.attrs["dislocations"]
    108
    """
    return dataset_of(_run(_slipfront.chain, scenario, progress, thread_count(threads), set=set,
                           output=output, resume=resume, si=si))


def plane(scenario, *, direct=False, set=None, output=None, resume=None, progress=None,
          threads=None, errors=True, si=None):
    """Runs a rupture on a plane, averaged or with every dislocation line (docs/plane.md).

    Parameters
    ----------
    scenario : path, str or dict
        As in `pulse`, with the table [plane]. A finite-fault model is computed line by line.
    direct : bool, optional
        Whether to follow every dislocation line, which needs chain.scale. By default, the averaged
        equations are solved.
    set, output, resume, progress, si
        As in `pulse`.
    threads : int, optional
        Number of threads of a direct run, by default all cores. Results are identical to the bit
        for any number.
    errors : bool, optional
        As in `pulse`, for the averaged equations. It takes a quarter of the time.

    Returns
    -------
    xarray.Dataset with the contents of the NetCDF file except its checkpoint. slip, in b / (2 pi),
    and slip_velocity, in c A / pi, depend on time, y and x. rupture_time, rupture_velocity,
    peak_slip_velocity, rise_time, initial_stress and final_stress depend on y and x. potency,
    moment, their rates, front and energies depend on series_time, and moment_rate_spectrum on
    frequency. With output.lines = true, line_time, line_number, line_x and line_y depend on
    line_point: they are the points of the rupture front or, with `direct`, of all dislocation
    lines, with NaN after each line. The attributes are the values that `slipfront plane --json`
    prints; energies have names such as energy_kinetic, and the comparison with a finite-fault model
    names such as model_duration. With `errors`, the attributes potency_error and so on are their
    estimated errors.

    Raises
    ------
    As `pulse`.

    Examples
    --------
    >>> rings = slipfront.plane(slipfront.cases / "plane-rings.toml", set={"plane.loops": 60})
    >>> dict(rings.slip.sizes)
    {'time': 13, 'y': 200, 'x': 200}
    """
    return dataset_of(_run(_slipfront.plane, scenario, progress, bool(direct), bool(errors),
                           thread_count(threads), set=set, output=output, resume=resume, si=si))


def _scales(scales):
    return numbers("scales", scales).reshape(-1).tolist()


def compare(scenario, *, scales=(), set=None, output=None, progress=None, threads=None, si=None):
    """Runs a scenario at each level of theory and compares the results.

    The levels are the closed form, if there is one, the pulse with both closures, and a chain for
    each scale.

    Parameters
    ----------
    scales : sequence of float, optional
        Scales of the chains, each > 0. By default that of the scenario, or 100, 300 and 1000.
    scenario, set, output, progress, threads, si
        As in `pulse` and `chain`. The output is written level by level and cannot be resumed.

    Returns
    -------
    xarray.Dataset with the variables of `pulse` for each level, which has a name:
    `result.sel(name="chain-1000")`. The variables `closure`, `scale`, `window`, `smooth_window`
    (averaging windows of a chain, in b / A) and `wall_seconds` (s) describe a level. `difference`
    is the value at the end of the run minus that of the level pulse-consistent, for each level and
    quantity. `trend_exponent`, `trend_extrapolated` and `trend_difference` describe how the chain
    approaches that level with increasing scale. The last two are NaN if the difference does not
    fall. The attributes are time, friction_coefficient, damping_number (both NaN unless friction is
    viscous), reference and notes.

    Raises
    ------
    As `pulse`, without a checkpoint.

    Examples
    --------
    >>> levels = slipfront.compare(slipfront.cases / "step.toml", scales=[300])
    >>> levels.name.values.tolist()
    ['closed-form', 'pulse-consistent', 'pulse-paper', 'chain-300']
    """
    result = _run(_slipfront.compare, scenario, progress, _scales(scales), thread_count(threads),
                  set=set, output=output, si=si)
    levels, trends = result["levels"], list(zip(*result["trends"])) or [()] * 4
    reference = "pulse-consistent"
    result["summary"].update(reference=reference, notes="\n".join(result["notes"]))
    data, names = dataset_of(result), [level["name"] for level in levels]

    def of_levels(key):
        return np.array([nan if level[key] is None else level[key] for level in levels], float)

    quantities = list(trends[0])
    last = np.array([data[name][:, -1] for name in quantities], float)
    last = last.reshape(len(quantities), len(levels)).T
    difference = last - (last[names.index(reference)] if reference in names else nan)
    clock = about("wall-clock time of the level", units="s")
    per_level = {described[0]: in_results(result, "level", values, described)
                 for described, values in result["level_numbers"]}
    closures = [level["closure"] for level in levels]
    off = about(f"value at the end of the run minus that of {reference}")
    data = data.assign({"closure": ("level", closures, {"long_name": "how friction is averaged"}),
                        **per_level, "wall_seconds": ("level", of_levels("wall_seconds"), clock),
                        "difference": (("level", "quantity"), difference, off)})
    words = {"exponent": f"p: the difference of the chain from {reference} falls as scale^-p",
             "extrapolated": "value of the chain, extrapolated to infinite scale",
             "difference": f"extrapolated value minus that of {reference}"}
    for (name, long_name), values in zip(words.items(), trends[1:]):
        data[f"trend_{name}"] = ("quantity", list(values), about(long_name))
    scale = ("level", of_levels("scale"), attributes(result["scale_about"]))
    data = data.assign_coords(name=("level", names, {"long_name": "level of theory"}), scale=scale,
                              quantity=quantities)
    return data.set_xindex("name")


class Plan(dict):
    """The plan of a run as a dict. A notebook shows it as a table."""

    def _repr_html_(self):
        rows = "".join(
            f"<tr><th>{html.escape(str(key))}</th><td>{html.escape(_text(key, value))}</td></tr>"
            for key, value in self.items())
        return f"<table>{rows}</table>"


def _text(key, value):
    if key.endswith("_bytes"):
        size, unit = next(((value / 10**power, unit)
                           for power, unit in ((9, "GB"), (6, "MB"), (3, "kB"))
                           if value >= 10**power), (value, "bytes"))
        return f"{size:.3g} {unit}"
    if isinstance(value, dict):
        return ", ".join(f"{name} = {_text(name, one)}" for name, one in value.items()) or "none"
    if isinstance(value, float):
        return f"{value:.6g}"
    return "none" if value is None else str(value)


def check(scenario, *, set=None, command="pulse", scales=(), direct=False):
    """Reads and validates a scenario and sets up its run, without running it.

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
    dict that describes the run: title; cells, sites or levels; left and right end of the domain;
    end of time; memory_bytes and disk_bytes (estimated, in bytes); and more, depending on the
    command. A notebook shows it as a table.

    Raises
    ------
    InputError, FileError or NumericsError, as the run would before its first step.

    Examples
    --------
    >>> slipfront.check(slipfront.cases / "step.toml")["cells"]
    400
    """
    checks = {"pulse": (_slipfront.check_pulse,), "chain": (_slipfront.check_chain,),
              "plane": (_slipfront.check_plane, bool(direct)),
              "compare": (_slipfront.check_compare, _scales(scales))}
    request = arguments(scenario, set=set)
    if not isinstance(command, str) or command not in checks:
        raise InputError(f"command = '{shown(command)}': unknown; allowed: {', '.join(checks)}")
    run, *further = checks[command]
    return Plan(run(request, *further))


def open(file, *, group=None, si=None):
    """Reads a NetCDF file that pulse, chain, plane, compare, sweep or event has written.

    Parameters
    ----------
    file : path
        The file, written by the program (`-o`) or by this package (`output`).
    group : str, optional
        A group of a file with draws of events: "posterior", "prior", "posterior_predictive",
        "observed_data" or "sample_stats" (docs/events.md).
    si : bool, optional
        Whether the variables are in SI units. By default they are in the units of the run. A file
        in the units of the model is converted by the constants in its scenario, as by
        `dataset.slipfront.si()`.

    Returns
    -------
    xarray.Dataset with the variables, coordinates and attributes that the run returned. All values
    are in memory, and the file is closed. A file does not hold what describes only the computation:
    the estimated errors, counts of steps and clocks of a pulse or a chain, the medians of its
    events, and the differences and trends of a comparison. A file of events also has the population
    and the settings.

    Raises
    ------
    InputError if `file` is not a path; FileError if it cannot be read or slipfront has not written
    it.

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
    """Returns attributes of a finished pulse or chain: values at the end, and settings."""
    command = str(data.attrs.get("history", "")).split()[1:2]
    known = set()
    if command in (["pulse"], ["chain"]):
        known = {row[0] for row in _slipfront.numbers_of(command[0])}
    found = {str(name): variable.values[-1].item() for name, variable in data.variables.items()
             if variable.dims == ("time",) and name in known}
    if command == ["pulse"]:
        with contextlib.suppress(InputError, FileError):  # its table of stress may be gone
            plan = check(str(data.attrs["scenario"]) + "\n")
            coefficient = plan["friction_coefficient"]
            coefficient = nan if coefficient is None else coefficient
            found.update(closure=plan["closure"], cells=plan["cells"],
                         friction_coefficient=coefficient, damping_number=coefficient * plan["end"])
    return found


def _in_model(data):
    """Returns a Dataset in the units of the model, from the numbers of a file in SI units."""
    if not any("scale_factor" in variable.attrs for variable in data.variables.values()):
        raise InputError("si = False: the file has its results in SI units only; "
                         "allowed: None or True")
    for variable in data.variables.values():
        variable.attrs = _units.of_model(variable.attrs)
    data.attrs = _units.without_si(data.attrs)
    return data


def _stored(name, any_file, group, si):
    """Returns the content of a NetCDF file."""
    xarray = import_optional("xarray")
    with _slipfront.NetcdfLock():  # the import initialises the libraries of NetCDF
        import_optional("netCDF4")
    # A damaged file can crash the NetCDF library, and Python with it.
    _slipfront.require_unbroken_seal(os.fsencode(name))

    def opened(**options):
        return files.enter_context(xarray.open_dataset(name, engine="netcdf4", group=group,
                                                       **options))

    # The library is not thread-safe: in a fork while another thread uses it, it would hang.
    with _slipfront.NetcdfLock(), contextlib.ExitStack() as files:
        stored = opened()
        if not (any_file or "slipfront_format" in stored.attrs):
            raise FileError(f"{name}: not a file that slipfront has written")
        to_model = si is False and stored.attrs.get("unit_system") == "SI"
        if to_model:
            stored = opened(mask_and_scale=False)
        hidden = ["checkpoint", "scenario_text", "done"]
        data = stored.drop_vars(hidden, errors="ignore").load()
    return _in_model(data) if to_model else data


def read(name, any_file=False, group=None, si=None):
    """Like `open`, for any NetCDF file if `any_file`. Does not convert results to SI units."""
    try:
        data = _stored(name, any_file, group, si)
    except (FileError, InputError):
        raise
    except OSError as error:
        raise FileError(f"{name}: {error.strerror or error}") from error
    except (RuntimeError, ValueError) as error:  # its contents are damaged
        raise FileError(f"{name}: {' '.join(str(error).split())}") from error
    if data.attrs.get("slipfront_format") == "sweep 1":  # dimensions such as friction.coefficient
        names = {name: name.replace(".", "_") for name in data.dims}
        replaced = [new for old, new in names.items() if new != old]
        data = data.drop_vars(replaced, errors="ignore").rename(names)
    data.attrs = {name: value.item() if isinstance(value, np.generic) else value
                  for name, value in data.attrs.items()}
    if data.attrs.get("finished") == 1 and data.sizes.get("time"):
        data = data.assign_attrs(_summary(data))
    if "name" in data.coords:
        data = data.set_xindex("name")
    return data
