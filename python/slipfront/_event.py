"""slipfront.event"""

import csv
import io
import pathlib
from collections.abc import Mapping

from . import _slipfront
from ._dataset import attributes, dataset
from ._numbers import np, thread_count
from ._progress import showing
from ._scenario import is_path, path, to_toml
from ._shown import shown
from ._slipfront import InputError

_shipped = pathlib.Path(__file__).parent / "cases" / "catalogue.csv"


def _row(event):
    """A flat dict as a catalogue of one row, named by columns as docs/events.md has them."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(event)
    try:
        writer.writerow(["" if value is None or value != value else value for value in event.values()])
    except RecursionError:
        raise InputError("events: a value that is nested too deeply; allowed: numbers and texts") from None
    return out.getvalue()


def _source(event, name):
    """(text, name or path, whether it is a path) of one item that a user gives."""
    if isinstance(event, Mapping):
        nested = any(isinstance(value, Mapping) for value in event.values())
        return (to_toml(event) if nested else _row(event)), name, False
    if is_path(event):
        return "", path("events", event), True
    if isinstance(event, str):
        return event, name, False
    if hasattr(event, "to_csv") and hasattr(event, "columns"):
        return event.to_csv(index=False), name, False
    raise InputError(f"{name}: a {type(event).__name__}; allowed: a path, text, a dict, a DataFrame or a list of these")


def _whole(name, value):
    if value is None or (isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**63):
        return value
    raise InputError(f"{name} = '{shown(value)}': not a whole number; allowed: >= 0")


def _default(value):
    return "" if value is None else str(value)


def event(events=None, *, p_wave_speed=None, poisson_ratio=None, shear_modulus=None, samples=None, seed=1, closure="consistent",
          pulse=False, draws=0, output=None, resume=None, progress=None, threads=None):
    """Stress, contact ratio, slip velocity and friction of observed events, by the closed forms (Eqs. 8-10) and by samples.

    Parameters
    ----------
    events : path, text, dict, DataFrame or list of these, optional
        A .toml, .csv or .fsp file or its text (docs/events.md); a dict nested like the TOML, {"event": {...}, "medium":
        {...}}, or flat with the columns of a catalogue, {"name": ..., "rupture_velocity": "3 km/s", ...}; a DataFrame
        with these columns. Nothing: the shipped catalogue.
    p_wave_speed, poisson_ratio, shear_modulus : str or float, optional
        Of events that give none, such as "6 km/s", 0.3, "30 GPa" (the defaults).
    samples : int, optional
        Samples of the state of every event, friction and errors included (docs/events.md); without it, 1000 for events that
        carry an uncertainty, a contact ratio, a stress drop or a friction coefficient. They double until they suffice. 0: none.
    seed : int, optional
        Of the samples.
    closure : "consistent" or "paper", optional
        Of the friction.
    pulse : bool, optional
        A frictionless pulse through the slip of each finite-fault model: adds pulse_front_velocity_ratio, pulse_correlation_of_slip,
        pulse_columns, pulse_columns_reached, pulse_slip_error, pulse_contact_ratio, and pulse_reason where there is none.
    draws : int, optional
        States of the posterior of each sampled event to return, alike in weight: `draw_<name>` over `draw`.
    output : path, optional
        NetCDF file to write, as `slipfront event -o` does: results, population, and a checkpoint now and then. A file
        that stands there is replaced at the end alone; until then the checkpoint of `a.nc` is in `a.unfinished.nc`.
    resume : path, optional
        File of an interrupted catalogue, of this function or of the program, to go on from; the events and settings must be the same.
        It is written to, unless an output is given.
    progress : bool or callable, optional
        True for a line on stderr; or called with (events done, all events, events done, "").
    threads : int, optional
        All cores unless given; results do not depend on it.

    Returns
    -------
    xarray.Dataset over `event`: name, c_m_s, rupture_velocity (V / c), stress (mu A / pi), frictionless_slip_velocity and
    observed_slip_velocity (c A / pi), slip_velocity_ratio, contact_ratio, stress_pa (Pa), damping_number,
    friction_coefficient, and `<name>_interval` = [5 %, 95 %] of each: by the closed forms, and of sampled events the median
    and interval of the samples. Where friction is not known contact_ratio is a lower bound and stress_pa NaN:
    contact_ratio_bound and stress_pa_bound say what they are at least, if friction took nothing; stress_bound likewise where
    there is no rupture velocity. Of sampled events `posterior_<name>` over `quantile` (5 %, 50 %, 95 %), effective_samples,
    pareto_k, samples and friction_identified (1 or 0). NaN where not identifiable; and `warnings`. One bad event of several
    does not lose the others: its `error` says why, and is "" for the rest.

    Raises
    ------
    InputError if all events are bad, FileError. KeyboardInterrupt leaves a checkpoint in the output.
    """
    if events is None:
        events = _shipped
    sources = ([_source(item, f"events[{i}]") for i, item in enumerate(events)] if isinstance(events, (list, tuple))
               else [_source(events, "events")])
    if not sources:
        raise InputError("events: none; allowed: one or more")
    with showing(progress) as call:
        columns = _slipfront.event(sources, {
            "p_wave_speed": _default(p_wave_speed), "poisson_ratio": _default(poisson_ratio), "shear_modulus": _default(shear_modulus),
            "samples": _whole("samples", samples), "seed": _whole("seed", seed), "closure": str(closure), "pulse": bool(pulse),
            "draws": _whole("draws", draws), "output": path("output", output), "resume": path("resume", resume), "progress": call,
            "threads": thread_count(threads)})
    texts = {name: (values, long_name) for name, values, long_name in columns["texts"]}
    errors = texts["error"][0]
    if errors and all(errors):
        raise InputError(errors[0])
    if not errors:
        raise InputError("events: none in the text; allowed: one or more")

    variables = {name: ("event", np.array(values, dtype=object), {"long_name": long_name}) for name, (values, long_name) in texts.items()}
    for name, dimensions, values, long_name, unit, dimensional_unit, reference in columns["numbers"]:
        attrs = attributes((name, long_name, dimensional_unit, reference))
        variables[name] = (dimensions, values, {**attrs, "units": unit} if reference else {"long_name": long_name, "units": unit})
    return dataset(variables, {"bound": ("bound", ["5 %", "95 %"], {"long_name": "ends of an interval"}),
                               "quantile": ("quantile", [0.05, 0.5, 0.95], {"long_name": "share of the values below", "units": "1"})}, {"ignored_columns": ", ".join(columns["ignored"])})
