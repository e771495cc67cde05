"""The function slipfront.sweep."""

import contextlib
import itertools
import json
import math
import os
import tomllib
import warnings

from . import _slipfront
from ._cluster import on_cluster, run_points
from ._dataset import dataset
from ._files import write_dataset
from ._grid import QUANTITY
from ._numbers import np, thread_count
from ._progress import showing
from ._run import check, open
from ._scenario import arguments, overrides
from ._messages import shown
from ._slipfront import InputError, __version__
from ._store import Store
from ._units import converted, in_si, symbols

_format = "sweep 2"  # 1 had dimensions with dots
# The name of an SI unit does not depend on it
_any_medium = dict.fromkeys(("mu", "nu", "A", "b", "c"))


def _axes(axes):
    """Returns {key: list of different values}. Raises InputError."""
    if not hasattr(axes, "items") or not axes:
        raise InputError(f"axes = '{shown(axes)}': not a dict; allowed: {{'friction.coefficient': "
                         f"[0.1, 0.5], ...}}")
    checked = {}
    for key, values in axes.items():
        if not isinstance(key, str):
            raise InputError(f"axes: '{shown(key)}' is not a key; allowed: texts such as "
                             "'friction.coefficient'")
        try:
            array = np.asarray(values)
        except ValueError as error:
            raise InputError(f"axes: {key}: not an array: {error}; allowed: one row of numbers or "
                             "texts") from None
        if array.ndim != 1 or array.size == 0 or array.dtype.kind not in "fiubU":
            raise InputError(f"axes: {key}: an array of shape {array.shape} of {array.dtype}; "
                             "allowed: one row of numbers or texts")
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            raise InputError(f"axes: {key}: a value that is not finite; allowed: finite numbers or "
                             "texts")
        checked[key] = array.tolist()
        if len(set(checked[key])) < array.size:
            raise InputError(f"axes: {key}: a value is given twice; allowed: each once")
    return checked


def _variables(variables, command):
    numbers = _slipfront.numbers_of(command)
    known = {name: about for name, *about, _ in numbers}
    if variables is None:
        variables = [name for name, *_, is_result in numbers if is_result]
    if isinstance(variables, str):
        variables = [variables]
    for name in variables:
        if not isinstance(name, str) or name not in known:
            raise InputError(f"variables: '{shown(name)}': unknown; allowed: {', '.join(known)}")
    return {name: known[name] for name in variables}


def _check_some(scenario, settings, points, command):
    """Raises the error of the first point if no point can run, as with a wrong key."""
    errors = []
    for point in points:
        try:
            check(scenario, set={**settings, **point}, command=command)
            return
        except InputError as error:
            errors.append(error)
    raise errors[0]


def _si_by_default(scenario, settings, points):
    """Returns whether the first point that can be read has values in SI units."""
    for point in points:
        with contextlib.suppress(InputError):
            return _slipfront.results_in_si(arguments(scenario, set={**settings, **point}))
    return False


def sweep(scenario, axes, *, variables=None, set=None, command="pulse", output=None, resume=None,
          client=None, progress=None, threads=None, si=None):
    """Runs a scenario at every point of a grid of settings.

    Parameters
    ----------
    scenario, set
        As in `pulse`.
    axes : dict
        The values of each key of the scenario to vary, such as {"friction.coefficient": [0.1, 0.5],
        "friction.closure": ["paper", "consistent"]}. The sweep runs every combination.
    variables : list of str, optional
        Numbers of `slipfront pulse --json` (or chain) to return, at the end of each run. By default
        all of them except the time, the clocks and the numbers of threads and ranks.
    command : "pulse" or "chain", optional
        What to run.
    output : path, optional
        NetCDF file to write at the end. Until then results are appended to `<output>.part`.
    resume : path, optional
        Output of an interrupted sweep to resume. Scenario, axes, variables and version must be the
        same. A finished sweep is returned without running it again.
    client : distributed.Client, optional
        Dask cluster to run on. slipfront must be installed there, and the workers read tables of
        initial stress. Points whose worker dies are tried again.
    progress : bool or callable, optional
        True shows a line on stderr. A function is called with (points done, all points).
    threads : int, optional
        Number of points that run at the same time if there is no client, by default all cores.
        Results do not depend on it.
    si : bool, optional
        Whether the numbers are in SI units, by the constants [medium] of each point. By default
        they are if the first point that can be read has values with units outside of [medium]. The
        axes have the values that are given.

    Returns
    -------
    xarray.Dataset with the axes as dimensions. Their names are the keys with `_` for each dot, so
    that attribute access works: `data.sel(friction_coefficient=0.5)` and
    `data.friction_coefficient`. The attribute `key` of a coordinate has the key. An axis replaces
    the variable of its name. A point that failed is NaN, and `failure` gives the reason ("" for the
    others).

    Raises
    ------
    InputError if the axes are wrong or no point can run; FileError if a file cannot be read or
    written; NumericsError if the cluster is lost. After a KeyboardInterrupt, `<output>.part` holds
    the finished points.

    Examples
    --------
    >>> axes = {"initial.stress_left": [0.8, 0.9]}
    >>> sweep = slipfront.sweep(slipfront.cases / "step.toml", axes)
    >>> sweep.slip_at_origin.sel(initial_stress_left=0.9).round(2).item()
    0.38
    """
    if command not in ("pulse", "chain"):
        raise InputError(f"command = '{shown(command)}': unknown; allowed: pulse, chain")
    threads = thread_count(threads)
    axes, kept = _axes(axes), _variables(variables, command)
    shape = tuple(len(values) for values in axes.values())
    total = math.prod(shape)
    if total * (8 * len(kept) + 1500) > _slipfront.usable_memory():
        raise InputError(f"axes: {total} points need more memory than this process may have; "
                         "allowed: fewer")
    points = [dict(zip(axes, values)) for values in itertools.product(*axes.values())]
    request = arguments(scenario, output=output, resume=resume, si=si)
    if request["path"]:
        request["text"] = _slipfront.read_text(request["path"])
    settings = overrides(set)
    if si is None:
        request["si"] = _si_by_default(scenario, set or {}, points)
    about = {"format": _format, "version": __version__, "command": command,
             "scenario": request["text"], "set": settings, "axes": axes, "variables": list(kept),
             **({"si": True} if request["si"] else {})}
    kept_in = request["resume"] or request["output"]
    if resume is not None and os.path.exists(kept_in) and not os.path.exists(kept_in + ".part"):
        return _finished(kept_in, about)
    store = Store(kept_in + ".part", about, resume is not None) if kept_in else None
    try:
        if not (store and store.rows):
            _check_some(scenario, set or {}, points, command)
        values = np.full((len(kept), len(points)), np.nan)
        reasons = np.full(len(points), "", dtype=object)
        left = np.ones(len(points), dtype=bool)

        def take(rows):
            for point, numbers, reason in rows:
                left[point], reasons[point] = False, reason
                if not reason:
                    values[:, point] = numbers

        if store:
            take(store.rows)
        with showing(progress) as tell:
            def deliver(rows):
                if store:
                    store.append(rows)
                take(rows)
                if tell:
                    tell(int(len(points) - left.sum()), len(points))

            work = [(int(i), settings + overrides(points[i])) for i in np.flatnonzero(left)]
            if client is not None:
                on_cluster(client, command, request, work, list(kept), deliver)
            elif work:
                run_points(command, request, work, list(kept), threads, deliver)
        data = _dataset(about, axes, kept, values.reshape(-1, *shape), reasons.reshape(shape))
        if store:
            write_dataset(data, request["output"] or request["resume"])
    except BaseException:
        if store:
            store.close(remove=not store.rows_written and resume is None)
        raise
    if store:
        store.close(remove=True)
    # NumPy's != returns a single False if it cannot allocate memory
    failed = sum(reason != "" for reason in reasons)
    if failed:
        first = next(reason for reason in reasons if reason)
        warnings.warn(f"{failed} of {len(points)} points failed (see `failure`). The first error: "
                      f"{first}", stacklevel=2)
    return data


def _unit_of_stress_drop(about):
    """Returns the unit of event_median_stress_drop, which depends on loading.where."""
    given = [value.partition("=")[2].strip("'\"")
             for value in about["set"] if value.startswith("loading.where=")]
    places = (about["axes"].get("loading.where") or given[-1:]
              or [tomllib.loads(about["scenario"]).get("loading", {}).get("where", "everywhere")])
    units = {"mu A^2 / (pi (1 - nu))" if place == "everywhere" else "mu A / pi" for place in places}
    return units.pop() if len(units) == 1 or "si" in about else ""  # both are Pa in SI units


def _unit_of_axis(key, values):
    """Returns the unit of an axis, or "". That of a friction parameter depends on the law."""
    _, unit = _slipfront.scenario_keys().get(key, ("", ""))
    with contextlib.suppress(InputError):
        if not key.startswith("friction.") and not isinstance(values[0], str) and symbols(unit):
            return unit
    return ""


def _quantities(values):
    """Returns the numbers and the unit of texts such as "5 MPa", or the values and ""."""
    found = [match for value in values
             if isinstance(value, str) and (match := QUANTITY.fullmatch(value))]
    if len(found) < len(values) or len({match[2] for match in found}) > 1:
        return values, ""
    return [float(match[1]) for match in found], found[0][2]


def dimension_of(key):
    """Returns an axis as an identifier: friction_coefficient for friction.coefficient."""
    return key.replace(".", "_")


def _dataset(about, axes, kept, values, reasons):
    dims = tuple(dimension_of(key) for key in axes)
    variables = {}
    for (name, (words, unit)), array in zip(kept.items(), values):
        if name == "event_median_stress_drop":
            unit = _unit_of_stress_drop(about)
        if name not in dims:  # friction_coefficient is then the coordinate
            attrs = {"long_name": words or name.replace("_", " "), "units": "1",
                     "dimensional_unit": unit}
            variables[name] = (dims, array, converted(attrs, in_si(unit, _any_medium))
                               if unit and "si" in about else attrs)
    variables["failure"] = (dims, reasons, {"long_name": "reason why there is no result; empty for "
                                            "a point that succeeded"})
    coordinates = {}
    for dim, (key, array) in zip(dims, axes.items()):
        numbers, si_unit = _quantities(array)
        unit = _unit_of_axis(key, array)
        units = {"units": si_unit} if si_unit else {"dimensional_unit": unit} if unit else {}
        coordinates[dim] = (dim, numbers,
                            {"long_name": f"{key} of the scenario", "key": key, **units})
    return dataset(variables, coordinates,
                   {"Conventions": "CF-1.10", "source": f"slipfront {__version__}",
                    "history": f"slipfront.sweep of {about['command']}",
                    **({"unit_system": "SI"} if "si" in about else {}), "version": __version__,
                    "scenario": about["scenario"], "set": "\n".join(about["set"]),
                    "slipfront_format": _format, "sweep": json.dumps(about)})


def _finished(file, about):
    data = open(file)
    if data.attrs.get("sweep") != json.dumps(about):
        raise InputError(f"{file}: was written by another sweep; allowed: the scenario, axes, "
                         "variables and version of that sweep")
    return data
