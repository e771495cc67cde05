"""The function slipfront.event."""

import csv
import io
import pathlib
from collections.abc import Mapping

from . import _slipfront
from ._dataset import attributes, dataset
from ._numbers import np, thread_count
from ._progress import showing
from ._scenario import is_path, output_path, path, to_toml
from ._shown import shown
from ._slipfront import InputError

_shipped = pathlib.Path(__file__).parent / "cases" / "catalogue.csv"


def _row(event):
    """Returns a flat dict as the CSV text of a catalogue of one row. The keys are column titles (docs/events.md)."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(event)
    try:
        writer.writerow(["" if value is None or value != value else value for value in event.values()])
    except RecursionError:
        raise InputError("events: a value is nested too deeply; allowed: numbers and texts") from None
    return out.getvalue()


def is_column(value):
    """Returns whether a value of a dict is a list, an array or another column."""
    return hasattr(value, "__len__") and not isinstance(value, (str, bytes, Mapping))


def _rows(columns, name):
    """Returns a dict of columns as the CSV text of a catalogue."""
    lengths = {len(values) if is_column(values) else 0 for values in columns.values()}
    if len(lengths) != 1 or 0 in lengths:
        raise InputError(f"{name}: a dict whose values are not lists of one length; allowed: one row as "
                         "{'rupture_velocity': '3 km/s', ...}, or columns as {'rupture_velocity': ['3 km/s', '2 km/s'], ...}")
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values()):
        writer.writerow(["" if value is None or value != value else value for value in row])
    return out.getvalue()


def _source(event, name):
    """Returns (text, name or path, whether it is a path) of one item of `events`."""
    if isinstance(event, Mapping):
        if any(map(is_column, event.values())):
            return _rows(event, name), name, False
        nested = any(isinstance(value, Mapping) for value in event.values())
        return (to_toml(event) if nested else _row(event)), name, False
    if is_path(event):
        return "", path("events", event), True
    if isinstance(event, str):
        return event, name, False
    if hasattr(event, "to_csv") and hasattr(event, "columns"):
        return event.to_csv(index=False), name, False
    raise InputError(f"{name}: a {type(event).__name__}; allowed: a path, text, a dict, a DataFrame or a list of these")


def column_map(columns):
    """Returns (TOML text, file) of a map of columns as the user gives it. At most one of them is not empty."""
    return (to_toml(columns), "") if isinstance(columns, Mapping) else ("", path("columns", columns))


def _whole(name, value):
    if value is None or (isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**63):
        return value
    raise InputError(f"{name} = '{shown(value)}': not a whole number; allowed: >= 0")


def _number_of(name, value):
    """Like _whole, for a parameter whose default is a number."""
    if value is None:
        raise InputError(f"{name} = 'None': not a whole number; allowed: >= 0")
    return _whole(name, value)


def _default(value):
    return "" if value is None else str(value)


def event(events=None, *, p_wave_speed=None, poisson_ratio=None, shear_modulus=None, samples=None, seed=1, closure="consistent",
          pulse=False, draws=0, output=None, resume=None, progress=None, threads=None, columns=None, strict=False):
    """Computes stress, contact ratio, slip velocity and friction of observed events.

    The closed forms (Eqs. 8-10) give the values of an event without uncertainties. Samples of the posterior distribution
    give the others (docs/events.md).

    Parameters
    ----------
    events : path, text, dict, DataFrame or list of these, optional
        A .toml or .csv file or a finite-fault model, or its text (docs/events.md). A dict is nested like the TOML, {"event": {...},
        "medium": {...}}, or flat with the columns of a catalogue, {"name": ..., "rupture_velocity": "3 km/s", ...}. The
        values of a flat dict are those of one event, or lists of one length. A DataFrame has these columns. The default is the catalogue that comes with slipfront.
    p_wave_speed, poisson_ratio, shear_modulus : str or float, optional
        Elastic constants for events that give none, by default "6 km/s", 0.3 and "30 GPa".
    samples : int, optional
        Number of samples for every event, including its friction and errors; 0 for none. By default, 1000 for each event
        that has an uncertainty, both velocities of an observed front, a contact ratio, a stress drop or a friction
        coefficient, and none for the others. The number is doubled until the diagnostics pass, up to 64 times the first
        number.
    seed : int, optional
        Seed of the samples, >= 0.
    closure : "consistent" or "paper", optional
        How friction is averaged over the dislocations of a train.
    pulse : bool, optional
        Whether to run a frictionless pulse through the slip of each finite-fault model. This adds the variables
        pulse_front_velocity_ratio, pulse_correlation_of_slip, pulse_columns, pulse_columns_reached, pulse_slip_error,
        pulse_contact_ratio, and pulse_reason, which states why there is no pulse.
    draws : int, optional
        Number of posterior states to return for each sampled event, all of equal weight. They are the variables
        `draw_<name>` over the dimension `draw`.
    output : path, optional
        File to write, as `slipfront event -o` does. NetCDF holds the results, the population, and at intervals a checkpoint.
        An existing file is replaced at the end only. Until then, the checkpoint of `a.nc` is in `a.unfinished.nc`. A name
        that ends in .csv gives the rows of `slipfront event --csv`, which are written at the end.
    resume : path, optional
        File of an interrupted catalogue to resume, written by this function or by the program. The events and settings must
        be the same. The results are written to this file unless there is an `output`.
    progress : bool or callable, optional
        True shows a line on stderr. A function is called with (events done, all events, events done, "").
    threads : int, optional
        Number of threads, by default all cores. Results do not depend on it.
    columns : path or dict, optional
        What the titles of a table mean, where slipfront does not know them (docs/events.md): a TOML file, or its content as a
        dict such as {"decimal": ",", "columns": {"VR": "rupture_velocity km/s", "dVR": "error of rupture_velocity"}}.
    strict : bool, optional
        Whether to refuse a table with a bad row, or with a column that looks like a quantity and is not understood.

    Returns
    -------
    xarray.Dataset with the dimension `event`. Its variables are name, c_m_s (m/s), rupture_velocity (V / c), stress
    (mu A / pi), frictionless_slip_velocity and observed_slip_velocity (c A / pi), slip_velocity_ratio, contact_ratio,
    stress_pa (Pa), damping_number and friction_coefficient. `<name>_interval` holds [5 %, 95 %] of each. Values of sampled
    events are the median and the interval of the samples, and other values are those of the closed forms.

    The rupture velocity is that of the observed front, which friction slows, unless `rupture_velocity_is` states another.
    If the slip velocity is known too, it bounds contact_ratio and stress_pa from both sides. If the rupture velocity is
    "characteristic" and friction is not known, contact_ratio is a lower bound and stress_pa is NaN. contact_ratio_bound and
    stress_pa_bound are then the smallest possible values, those without friction. stress_bound is the smallest possible
    stress of an event with one velocity only. A quantity that cannot be identified is NaN.

    Sampled events also have `posterior_<name>` over `quantile` (5 %, 50 %, 95 %), effective_samples, pareto_k, samples and
    friction_identified (1 or 0). contact_ratio_prior_share and damping_number_prior_share are the width of an interval over
    that of its prior; near 1 the data say nothing. `warnings` holds the warnings of each event. If some events are wrong,
    the others have results; `error` gives the reason of each wrong event, and is "" for the others. The attribute
    ignored_columns names the columns of tables that were not used, and ignored_quantities those of them that look like
    quantities.

    Raises
    ------
    InputError if all events are wrong or a parameter is out of range; FileError if a file cannot be read or written. A
    KeyboardInterrupt leaves a checkpoint in the output.

    Examples
    --------
    >>> event = slipfront.event({"rupture_velocity": "3 km/s", "slip_velocity": "0.5 m/s"})
    >>> round(float(event.contact_ratio), 2)
    0.01
    """
    if events is None:
        events = _shipped
    sources = ([_source(item, f"events[{i}]") for i, item in enumerate(events)] if isinstance(events, (list, tuple))
               else [_source(events, "events")])
    if not sources:
        raise InputError("events: the list is empty; allowed: one event or more")
    map_text, map_file = column_map(columns)
    with showing(progress) as call:
        found = _slipfront.event(sources, {
            "p_wave_speed": _default(p_wave_speed), "poisson_ratio": _default(poisson_ratio), "shear_modulus": _default(shear_modulus),
            "samples": _whole("samples", samples), "seed": _number_of("seed", seed), "closure": str(closure), "pulse": bool(pulse),
            "draws": _number_of("draws", draws), "output": output_path(output, events, columns), "resume": path("resume", resume), "progress": call,
            "threads": thread_count(threads), "columns": map_text, "columns_file": map_file,
            "strict": bool(strict)})
    texts = {name: (values, long_name) for name, values, long_name in found["texts"]}
    errors = texts["error"][0]
    if errors and all(errors):
        raise InputError(errors[0])
    if not errors:
        raise InputError("events: the text contains no event; allowed: one event or more")

    variables = {name: ("event", np.array(values, dtype=object), {"long_name": long_name}) for name, (values, long_name) in texts.items()}
    for name, dimensions, values, long_name, unit, dimensional_unit, reference in found["numbers"]:
        attrs = attributes((name, long_name, dimensional_unit, reference))
        variables[name] = (dimensions, values, {**attrs, "units": unit} if reference else {"long_name": long_name, "units": unit})
    coordinates = {"bound": ("bound", ["5 %", "95 %"], {"long_name": "ends of an interval"}),
                   "quantile": ("quantile", [0.05, 0.5, 0.95], {"long_name": "share of the values below", "units": "1"})}
    return dataset(variables, coordinates, {"ignored_columns": ", ".join(found["ignored"]),
                                            "ignored_quantities": ", ".join(found["ignored_quantities"])})
