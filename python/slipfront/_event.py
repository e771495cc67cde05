"""The function slipfront.event."""

import csv
import io
import pathlib
from collections.abc import Iterable, Mapping

from . import _slipfront
from ._dataset import BOUND, QUANTILE, about, attributes, dataset, texts
from ._numbers import thread_count, whole
from ._progress import showing
from ._scenario import is_path, output_path, path, to_toml
from ._slipfront import InputError

_shipped = pathlib.Path(__file__).parent / "cases" / "catalogue.csv"


def is_column(value):
    """Returns whether a value of a dict is a list, an array or another column."""
    return hasattr(value, "__len__") and not isinstance(value, (str, bytes, Mapping))


def text_of_columns(columns, name, example):
    """Returns a dict of columns, or of the values of one row, as the text of a CSV table."""
    rows: Iterable = [columns.values()]
    if not columns or any(map(is_column, columns.values())):
        lengths = {len(values) if is_column(values) else 0 for values in columns.values()}
        if len(lengths) != 1 or 0 in lengths:
            raise InputError(f"{name}: a dict whose values are not lists of one length; "
                             f"allowed: {example}")
        rows = zip(*columns.values())
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    try:
        writer.writerows(["" if value is None or value != value else value for value in row]
                         for row in rows)
    except RecursionError:
        raise InputError(f"{name}: a value is nested too deeply; "
                         "allowed: numbers and texts") from None
    return out.getvalue()


def source(table, name, example):
    """Returns (text, name or path, whether it is a path) of a table or an event as users give
    it."""
    if isinstance(table, Mapping):
        if any(isinstance(value, Mapping) for value in table.values()):
            return to_toml(table), name, False
        return text_of_columns(table, name, example), name, False
    if is_path(table):
        return "", path(name.partition("[")[0], table), True
    if isinstance(table, str):
        return table, name, False
    if hasattr(table, "to_csv") and hasattr(table, "columns"):
        return table.to_csv(index=False), name, False
    raise InputError(f"{name}: a {type(table).__name__}; "
                     "allowed: a path, text, a dict, a DataFrame or a list of these")


def sources(events):
    """Returns the sources of one item of `events` or of a list of them."""
    if events is None:
        events = _shipped
    example = ("one row as {'rupture_velocity': '3 km/s', ...}, or columns as "
               "{'rupture_velocity': ['3 km/s', '2 km/s'], ...}")
    if not isinstance(events, (list, tuple)):
        return [source(events, "events", example)]
    if not events:
        raise InputError("events: the list is empty; allowed: one event or more")
    return [source(item, f"events[{i}]", example) for i, item in enumerate(events)]


def column_map(columns):
    """Returns (TOML text, file) of a map of columns. One of them is empty."""
    if isinstance(columns, Mapping):
        return to_toml(columns), ""
    return "", path("columns", columns)


def _default(value):
    return "" if value is None else str(value)


def event(events=None, *, p_wave_speed=None, poisson_ratio=None, shear_modulus=None, samples=None,
          seed=1, closure="consistent", pulse=False, draws=0, output=None, resume=None,
          progress=None, threads=None, columns=None, strict=False):
    """Computes stress, contact ratio, slip velocity and friction of observed events.

    The closed forms (Eqs. 8-10) give the values of an event without uncertainties. Samples of the
    posterior distribution give the others (docs/events.md).

    Parameters
    ----------
    events : path, text, dict, DataFrame or list of these, optional
        A .toml or .csv file, a finite-fault model, or a folder with sources of one event; or the
        text of a file (docs/events.md). A dict is nested
        like the TOML, {"event": {...}, "medium": {...}}, or flat with the columns of a catalogue,
        {"name": ..., "rupture_velocity": "3 km/s", ...}. The values of a flat dict are those of one
        event, or lists of one length. A DataFrame has these columns. The default is the catalogue
        that comes with slipfront.
    p_wave_speed, poisson_ratio, shear_modulus : str or float, optional
        Elastic constants for events that give none, by default "6 km/s", 0.3 and "30 GPa".
    samples : int, optional
        Number of samples for every event, including its friction and errors; 0 for none. By
        default, 1000 for each event that has an uncertainty, both velocities of an observed front,
        a contact ratio, a stress drop or a friction coefficient, and none for the others. The
        number is doubled until the diagnostics pass, up to 64 times the first number.
    seed : int, optional
        Seed of the samples, >= 0.
    closure : "consistent" or "paper", optional
        How friction is averaged over the dislocations of a train.
    pulse : bool, optional
        Whether to run a frictionless pulse through the slip of each finite-fault model. This adds
        the variables pulse_front_velocity_ratio, pulse_correlation_of_slip, pulse_columns,
        pulse_columns_reached, pulse_slip_error, pulse_contact_ratio, and pulse_reason, which states
        why there is no pulse.
    draws : int, optional
        Number of posterior states to return for each sampled event, all of equal weight. They are
        the variables `draw_<name>` over the dimension `draw`.
    output : path, optional
        File to write, as `slipfront event -o` does. NetCDF holds the results, the population, and
        at intervals a checkpoint. An existing file is replaced at the end only. Until then, the
        checkpoint of `a.nc` is in `a.unfinished.nc`. A name that ends in .csv gives the rows of
        `slipfront event --csv`, which are written at the end.
    resume : path, optional
        File of an interrupted catalogue to resume, written by this function or by the program. The
        events and settings must be the same. The results are written to this file unless there is
        an `output`.
    progress : bool or callable, optional
        True shows a line on stderr. A function is called with (events done, all events, events
        done, "").
    threads : int, optional
        Number of threads, by default all cores. Results do not depend on it.
    columns : path or dict, optional
        What the titles of a table mean, where slipfront does not know them (docs/events.md): a TOML
        file, or its content as a dict such as {"decimal": ",", "columns": {"VR": "rupture_velocity
        km/s", "dVR": "error of rupture_velocity"}}.
    strict : bool, optional
        Whether to refuse a table with a bad row, or with a column that looks like a quantity and is
        not understood.

    Returns
    -------
    xarray.Dataset with the dimension `event`. Its variables are name, c_m_s (m/s), rupture_velocity
    (V / c), stress (mu A / pi), frictionless_slip_velocity and observed_slip_velocity (c A / pi),
    slip_velocity_ratio, contact_ratio, stress_pa (Pa), damping_number and friction_coefficient.
    `<name>_interval` holds [5 %, 95 %] of each. Values of sampled events are the median and the
    interval of the samples, and other values are those of the closed forms.

    The rupture velocity is that of the observed front, which friction slows, unless
    `rupture_velocity_is` states another. If the slip velocity is known too, it bounds contact_ratio
    and stress_pa from both sides. If the rupture velocity is "characteristic" and friction is not
    known, contact_ratio is a lower bound and stress_pa is NaN. contact_ratio_bound and
    stress_pa_bound are then the smallest possible values, those without friction. stress_bound is
    the smallest possible stress of an event with one velocity only. A quantity that cannot be
    identified is NaN.

    Sampled events also have `posterior_<name>` over `quantile` (5 %, 50 %, 95 %),
    effective_samples, pareto_k, samples and friction_identified (1 or 0). contact_ratio_prior_share
    and damping_number_prior_share are the width of an interval over that of its prior; near 1 the
    data say nothing. `warnings` holds the warnings of each event. If some events are wrong, the
    others have results; `error` gives the reason of each wrong event, and is "" for the others. The
    attribute ignored_columns names the columns of tables that were not used, and ignored_quantities
    those of them that look like quantities.

    Raises
    ------
    InputError if all events are wrong or a parameter is out of range; FileError if a file cannot be
    read or written. A KeyboardInterrupt leaves a checkpoint in the output.

    Examples
    --------
    >>> event = slipfront.event({"rupture_velocity": "3 km/s", "slip_velocity": "0.5 m/s"})
    >>> round(float(event.contact_ratio), 2)
    0.01
    """
    given = sources(events)
    map_text, map_file = column_map(columns)
    with showing(progress) as call:
        found = _slipfront.event(
            given,
            {"p_wave_speed": _default(p_wave_speed), "poisson_ratio": _default(poisson_ratio),
             "shear_modulus": _default(shear_modulus), "seed": whole("seed", seed),
             "samples": samples if samples is None else whole("samples", samples),
             "closure": str(closure), "pulse": bool(pulse), "draws": whole("draws", draws),
             "output": output_path(output, events, columns), "resume": path("resume", resume),
             "progress": call, "threads": thread_count(threads), "columns": map_text,
             "columns_file": map_file, "strict": bool(strict)})
    variables = {name: texts("event", values, words) for name, values, words in found["texts"]}
    errors = variables["error"][1]
    if not len(errors):
        raise InputError("events: the text contains no event; allowed: one event or more")
    if all(errors):
        raise InputError(errors[0])
    for name, dimensions, values, long_name, unit, of_model, reference in found["numbers"]:
        attrs = about(long_name, units=unit)
        if reference:
            attrs = {**attributes((name, long_name, of_model, reference)), "units": unit}
        variables[name] = (dimensions, values, attrs)
    return dataset(variables, {**BOUND, **QUANTILE},
                   {"ignored_columns": ", ".join(found["ignored"]),
                    "ignored_quantities": ", ".join(found["ignored_quantities"])})
