"""Runs of scenarios: slipfront.pulse, chain, compare, check, and open for the files that they write."""

import os
import warnings

from . import _slipfront
from ._dataset import attributes, dataset
from ._optional import import_optional
from ._numbers import np, numbers, one_number, thread_count
from ._progress import showing
from ._scenario import arguments, path
from ._shown import shown
from ._slipfront import FileError, InputError

nan = float("nan")


def _axes(result):
    axes = {name: (about, values) for name, (about, values) in result["axes"].items()}
    coordinates = {name: (name, axes[name][1], attributes(axes[name][0])) for name in ("time", "x")}
    coordinates["x"][2].update(axis="X", bounds="x_bounds")
    about, bounds = axes["x_bounds"]
    return coordinates, {"x_bounds": (("x", "ends"), bounds, attributes(about))}


def _dataset(result, front=()):
    """The Dataset that the NetCDF file of this run holds, its summary as attributes."""
    for warning in result["warnings"]:
        warnings.warn(warning, stacklevel=3)
    coordinates, variables = _axes(result)
    for about, values in result["fields"]:
        variables[about[0]] = (front + ("time", "x"), values, attributes(about))
    for about, values in result["scalars"]:
        variables[about[0]] = (front + ("time",), values, attributes(about))
    for name, about, values in result.get("events", ()):
        variables[name] = ("event", values, attributes(about))
    errors = {f"{key}_error": error for key, error in result.get("errors", {}).items()}
    return dataset(variables, coordinates, {**result["attributes"], **result["summary"], **errors})


def pulse(scenario, *, set=None, output=None, resume=None, progress=None, threads=None, tolerance=None, errors=True):
    """The modulation equations with friction, Eqs. (7), on a scenario (docs/scenario.md).

    Parameters
    ----------
    scenario : path, str or dict
        Path of a TOML file; TOML text (a str with a line break); or a dict nested like the TOML.
    set : dict, optional
        Values in place of the scenario's, such as {"friction.coefficient": 0.5}.
    output : path, optional
        NetCDF file to write: whole or not at all, and now and then during the run, so that it can be resumed.
    resume : path, optional
        File of an unfinished run of this scenario to go on from; written to unless there is an output.
    progress : bool or callable, optional
        True for a line on stderr; or called some ten times a second with (time, end, steps, "").
    threads : int, optional
        Accepted as on the command line; changes nothing (docs/pulse.md).
    tolerance : float, optional
        Relative error, 1e-9 to 1, of slip, slip velocity and stress at x = 0 and of the peak: `pulse.cells` doubles from
        the scenario's until it is reached. Not with `resume`.
    errors : bool, optional
        Whether to estimate the errors, by runs with half and a quarter of the cells that take a third of the time.

    Returns
    -------
    xarray.Dataset with what the NetCDF file holds, its checkpoint apart: dimensions time and x; k, Sigma, U, W, slip and
    stress_drop over both; fronts, energies and values at x = 0 over time. Attributes closure, friction_coefficient,
    damping_number (Gamma = C t; both NaN unless friction is viscous), ..., wall_seconds are those of `slipfront pulse --json`: at the end of the run; NaN where
    there is none. With `errors`, slip_at_origin_error and the like are their estimated errors.

    Raises
    ------
    InputError, FileError, NumericsError as the command line's. KeyboardInterrupt leaves a checkpoint in the output.
    """
    thread_count(threads)
    if tolerance is not None:
        tolerance = one_number("tolerance", tolerance)
    with showing(progress) as call:
        request = arguments(scenario, set=set, output=output, resume=resume, progress=call)
        return _dataset(_slipfront.pulse(request, tolerance, bool(errors)))


def chain(scenario, *, set=None, output=None, resume=None, progress=None, threads=None):
    """Every dislocation, directly: Eqs. (1) and (3), on a scenario (docs/chain.md).

    Parameters, exceptions and the Dataset are those of `pulse`; `threads` (all cores unless given) share the sites and
    change no bits. Attributes time, scale, ..., dislocations, energy_drift, charge_error, wall_seconds are those of
    `slipfront chain --json`. With [loading], slip events have variables event_onset, event_duration, ... over `event`.
    """
    with showing(progress) as call:
        return _dataset(_slipfront.chain(arguments(scenario, set=set, output=output, resume=resume, progress=call),
                                         thread_count(threads)))


def _scales(scales):
    return numbers("scales", scales).reshape(-1).tolist()


def compare(scenario, *, scales=(), set=None, output=None, progress=None, threads=None):
    """Closed form, pulse with both closures and chain, side by side on a scenario.

    Parameters
    ----------
    scales : sequence of float, optional
        Of the chains; the scenario's unless given, or 100, 300 and 1000.
    scenario, set, output, progress, threads
        As of `pulse` and `chain`; the output is written level by level and cannot be resumed.

    Returns
    -------
    xarray.Dataset with the variables of `pulse` for each level, by name: `result.sel(name="chain-1000")`. `closure`,
    `scale`, `window`, `smooth_window` and `wall_seconds` tell of the level, `difference` (by level and quantity) how far
    its end is from that of pulse-consistent, `trend_exponent`, `trend_extrapolated` and `trend_difference` (by quantity)
    how the chain tends to it. Attributes time, friction_coefficient, damping_number (NaN unless friction is viscous),
    reference and notes.
    """
    with showing(progress) as call:
        result = _slipfront.compare(arguments(scenario, set=set, output=output, progress=call), _scales(scales), thread_count(threads))
    levels, trends = result["levels"], result["trends"]
    result["summary"].update(reference="pulse-consistent", notes="\n".join(result["notes"]))
    data = _dataset(result, ("level",))
    names = [level["name"] for level in levels]

    def of_level(key, long_name, unit=""):
        values = [nan if level[key] is None else level[key] for level in levels]
        return "level", values, {"long_name": long_name, "units": "s" if key == "wall_seconds" else "1", "dimensional_unit": unit}

    quantities = [trend[0] for trend in trends]
    last = np.array([[float(data[q][i, -1]) for q in quantities] for i in range(len(levels))]).reshape(len(levels), len(quantities))
    reference = last[names.index("pulse-consistent")] if "pulse-consistent" in names else np.full(len(quantities), nan)
    one = {"units": "1"}
    data = data.assign({
        "closure": ("level", [level["closure"] for level in levels], {"long_name": "how friction is averaged"}),
        "window": of_level("window", "of a chain: of the slip at x = 0", "b / A"),
        "smooth_window": of_level("smooth_window", "of a chain: of velocities and stresses", "b / A"),
        "wall_seconds": of_level("wall_seconds", "time that the level took, in seconds"),
        "difference": (("level", "quantity"), last - reference, {**one, "long_name": "end of the run less that of pulse-consistent"}),
        "trend_exponent": ("quantity", [t[1] for t in trends], {**one, "long_name": "p: the chain's difference falls as scale^-p"}),
        "trend_extrapolated": ("quantity", [t[2] for t in trends], {**one, "long_name": "of the chain, at infinite scale"}),
        "trend_difference": ("quantity", [t[3] for t in trends], {**one, "long_name": "of that from pulse-consistent"}),
    })
    scale = of_level("scale", "")[:2] + (attributes(result["scale_about"]),)
    data = data.assign_coords(name=("level", names, {"long_name": "level of theory"}), scale=scale, quantity=quantities)
    return data.set_xindex("name")


def check(scenario, *, set=None, command="pulse", scales=()):
    """Reads and validates a scenario and does all set-up of a run, but runs nothing.

    `command` is what would run: "pulse", "chain" or "compare" (with `scales`). Returns a dict that says it: cells, sites
    or levels, left and right end of the domain, end of time, ... Raises what the run would before its first step.
    """
    request = arguments(scenario, set=set)
    if command == "pulse":
        return _slipfront.check_pulse(request)
    if command == "chain":
        return _slipfront.check_chain(request)
    if command == "compare":
        return _slipfront.check_compare(request, _scales(scales))
    raise InputError(f"command = '{shown(command)}': unknown; allowed: pulse, chain, compare")


def open(file):
    """The Dataset of a file that pulse, chain, compare, sweep or event (-o) has written, read whole; a checkpoint in it is left out.

    Raises FileError unless it is one.
    """
    return read(path("file", file))


def read(name, any_file=False):
    """The same, or the Dataset of any NetCDF file."""
    xarray = import_optional("xarray")
    import_optional("netCDF4")
    _slipfront.require_readable_netcdf(os.fsencode(name))  # what is damaged would crash the library, and Python with it
    try:
        # The library is not made for threads, and a process that is started while a thread is in it waits for ever.
        with _slipfront.NetcdfLock(), xarray.open_dataset(name, engine="netcdf4") as stored:
            if not (any_file or "slipfront_format" in stored.attrs):
                raise FileError(f"{name}: not a file of slipfront")
            data = stored.drop_vars(["checkpoint", "scenario_text", "done"], errors="ignore").load()
    except OSError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"{name}: {error.strerror or error}") from error
    except (RuntimeError, ValueError) as error:  # damaged inside
        raise FileError(f"{name}: {' '.join(str(error).split())}") from error
    if "name" in data.coords and data["name"].dtype.kind == "S":
        data = data.assign_coords(name=(data["name"].dims, np.char.decode(data["name"].values, "utf-8"), data["name"].attrs)).set_xindex("name")
    return data
