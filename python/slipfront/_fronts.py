"""The function slipfront.fronts."""

import dataclasses
import math

from . import _front_paths, _slipfront, _units
from . import medium as laws
from ._accessor import in_model, scenario_table
from ._dataset import about, dataset, texts
from ._files import write_dataset
from ._numbers import np
from ._run import read
from ._scenario import is_path, output_path
from ._messages import shown
from ._slipfront import InputError

#: Poisson's ratio where [medium] gives none.
POISSON_RATIO = 0.3

#: Classes of fronts by their velocity, from the slowest.
KINDS = ("slow", "sub-Rayleigh", "above Rayleigh", "faster than c", "too short")

#: Slip velocity at the front over the largest one, in a run without slip events.
THRESHOLD = 1e-3

TRACTION = "mu A^2 / (pi (1 - nu))"


@dataclasses.dataclass
class _Event:
    """Arrival of slip at each position. `number` is from 1; 0 for a run without slip events."""

    number: int
    arrival: "np.ndarray"
    stress: "np.ndarray"
    traction: "np.ndarray"
    load: float = math.nan


@dataclasses.dataclass
class _Front:
    event: _Event
    path: "np.ndarray"
    velocity: "np.ndarray"
    end: str
    error: float  # relative error of the median velocity; NaN if it is not known


def _is_loaded_at_end(run):
    return "loading_stress" in run and bool(run["loading_stress"].notnull().any())


def _events(run, threshold):
    """Returns positions and events of a run. Raises InputError if it has no arrivals."""
    if "event_arrival" in run:
        if threshold is not None:
            raise InputError("threshold: arrivals were recorded with that of the run; "
                             "allowed: set loading.event_velocity in the scenario")
        names = ("arrival", "stress_ahead", "traction_ahead", "load")
        rows = zip(*(run[f"event_{name}"].values for name in names))
        return run["position"].values, [_Event(i, *row) for i, row in enumerate(rows, 1)]
    if "event_onset" in run or _is_loaded_at_end(run):
        raise InputError("fronts: the run did not record arrivals, or has no slip event; "
                         "allowed: a loaded run with output.fronts = 200 or so")
    missing = [name for name in ("time", "x", "W", "Sigma") if name not in run.variables]
    if missing or "level" in run.dims:
        raise InputError(f"fronts: {', '.join(missing) or 'level'}: not a run with these "
                         "variables; allowed: what pulse and chain return and write")
    speed = np.abs(run["W"].transpose("time", "x").values)
    level = (THRESHOLD if threshold is None else threshold) * np.nanmax(speed, initial=0)
    unknown = np.full(speed.shape[1], math.nan)
    times = _front_paths.arrivals(run["time"].values, speed, level) if level > 0 else unknown
    return run["x"].values, [_Event(0, times, run["Sigma"].isel(time=0).values, unknown)]


def _fronts_of(event, x, tolerance):
    times = event.arrival
    reached = times[np.isfinite(times)]
    if not reached.size:
        return
    recorded = event.number > 0
    half = _front_paths.HALF_WINDOW if recorded else _front_paths.HALF_WINDOW_OF_OUTPUTS
    tolerance = max(tolerance, 0.01 * float(np.ptp(reached)))
    for begin, end in _front_paths.fronts_of(times, tolerance):
        along, velocity = _front_paths.velocities(x, times, begin, end, half)
        # Outputs show either end of a fit to a cell, in position and in time.
        fitted = along.size - 1 - _front_paths.begin_of_motion(times, along)
        error = math.nan if recorded or along.size < 3 else 2 / min(fitted, 2 * half)
        ahead = end + (1 if end >= begin else -1)
        stops = "end of the block"
        if 0 <= ahead < x.size:
            stops = "stops" if math.isnan(times[ahead]) else "meets another front"
        yield _Front(event, along, velocity, stops, error)


def _kind(velocity, slow, rayleigh):
    """Returns the class of a velocity in c."""
    limits = (slow * rayleigh, rayleigh, 1)
    if math.isnan(velocity):
        return KINDS[-1]
    return KINDS[int(velocity >= limits[0]) + sum(velocity > limit for limit in limits[1:])]


def _constants(run):
    """Returns (mu, nu, c, A, sigma_N) in SI units; None for what the scenario does not give."""
    try:
        known = _units.values_of(set(), run.slipfront._constants(None, None, None))
    except InputError:
        known = {}
    normal = scenario_table(run, "friction").get("normal_stress")
    if normal is not None:
        normal = _units.quantity("friction.normal_stress", normal, "pressure")
    return (*(known.get(symbol) for symbol in ("mu", "nu", "c", "A")), normal)


def _ratio(run, constants):
    """Returns whether tau is a traction, and its unit and sigma_N in Pa, or None if not known.

    With a substrate tau is the stress of the theory. Without one, only friction resists, and tau is
    the traction on the interface."""
    mu, nu, _, A, normal = constants
    smooth = str(scenario_table(run, "interface").get("contact", 1)) in ("0", "0.0")
    if mu is None or A is None or (smooth and nu is None):
        return smooth, None, normal
    unit = laws.traction_unit(mu, nu, A) if smooth else laws.stress_unit(mu, A)
    return smooth, float(unit), normal


def _median(values):
    values = values[~np.isnan(values)]
    return float(np.median(values)) if values.size else math.nan


def _row(front, x):
    """Returns the numbers of a front by the names of their variables without `front_`."""
    event, along = front.event, front.path
    times, velocity = event.arrival[along], _median(front.velocity)
    return {"event": event.number, "begin": x[along[0]], "end": x[along[-1]], "onset": times[0],
            "duration": times[-1] - times[0], "length": np.gradient(x)[along].sum(),
            "velocity": velocity, "velocity_error": front.error * velocity,
            "stress": _median(np.abs(event.stress[along])),
            "traction": _median(np.abs(event.traction[along]))}


NUMBER = about("number of the slip event, from 1; 0 if the run has none")
BEFORE = "ahead of the front, before the event"
ABOUT = {"event": NUMBER, "begin": about("position at which the front begins", "b / A"),
         "end": about("position at which the front ends", "b / A"),
         "onset": about("time at which the front begins", "b / (c A)"),
         "duration": about("time from its begin to its end", "b / (c A)"),
         "length": about("length that the front crosses", "b / A"),
         "velocity": about("median of the velocity along the front", "c"),
         "velocity_error": about("error of the median, if the arrivals come from outputs, which "
                                 "show a front to a cell", "c"),
         "stress": about(f"median of the shear stress {BEFORE}", "mu A / pi"),
         "traction": about(f"median of the force of friction and substrate {BEFORE}", TRACTION)}


def _variables(fronts, x, smooth, factor, limits):
    rows = [_row(front, x) for front in fronts]
    arrival, velocity, ratio = np.full((3, len(fronts), x.size), math.nan)
    for i, front in enumerate(fronts):
        tau = (front.event.traction if smooth else front.event.stress)[front.path]
        arrival[i, front.path] = front.event.arrival[front.path]
        velocity[i, front.path] = front.velocity
        ratio[i, front.path] = np.abs(tau) * factor
    found = {}
    for name, attrs in ABOUT.items():
        values = np.array([row[name] for row in rows], "int64" if name == "event" else float)
        found[f"front_{name}"] = ("front", values, attrs)
    kinds, stops = [_kind(row["velocity"], *limits) for row in rows], [front.end
                                                                       for front in fronts]
    found["front_kind"] = texts("front", kinds, f"class by velocity: {', '.join(KINDS)}")
    found["front_stop"] = texts("front", stops, "where the front ends: inside, at the end of the "
                                "block, or at another front")
    along = ("front", "position")
    medians = np.array([_median(row) for row in ratio])
    return {**found,
            "front_stress_ratio": ("front", medians, about(f"median of tau / sigma_N {BEFORE}")),
            "arrival": (along, arrival, about("time at which the front arrives", "b / (c A)")),
            "velocity": (along, velocity, about("velocity of the front", "c")),
            "stress_ratio": (along, ratio, about(f"tau / sigma_N {BEFORE}"))}


def _event_variables(events, x, unit_of_load):
    reached = np.isfinite([event.arrival for event in events]).reshape(len(events), x.size)
    columns = {"number": (np.array([event.number for event in events], dtype="int64"), NUMBER),
               "load": (np.array([event.load for event in events]),
                        about("mean force on a site, or the stress at a pulled end, before the "
                              "event", unit_of_load)),
               "length": (reached @ np.gradient(x), about("length that slip reaches", "b / A")),
               "crosses": (reached.all(axis=1).astype("int8"),
                           about("1 if slip reaches the whole block"))}
    return {f"event_{name}": ("event", *column) for name, column in columns.items()}


def _share(name, value, most):
    if (isinstance(value, bool) or not isinstance(value, (int, float, np.number))
            or not 0 < value < most):
        raise InputError(f"{name} = '{shown(value)}': out of range; "
                         f"allowed: above 0 and below {most:g}")
    return float(value)


def _given(run, si):
    """Returns a run in the units of the model, and whether results are in SI units."""
    if not is_path(run) and not hasattr(run, "data_vars"):
        raise InputError(f"run: a {type(run).__name__}; "
                         "allowed: the Dataset of a run, or the path of its file")
    given = read(run) if is_path(run) else run
    in_si = given.attrs.get("unit_system") == "SI"
    of_model = read(run, si=False) if is_path(run) and in_si else in_model(given)
    return of_model, in_si if si is None else si


def fronts(run, *, threshold=None, slow=0.1, output=None, si=None):
    """Finds the fronts of a run: path, velocity, ends, and the stress ahead (docs/fronts.md).

    A front begins where slip arrives first. It ends at the end of the block, where it meets another
    front, or where slip does not reach the next position. Its velocity at a position is the median
    of the slopes of all pairs of the seven nearest arrivals. If the output times give the arrivals,
    it is that of the 41 nearest ones, and front_velocity_error is the error of the median along the
    front.

    Parameters
    ----------
    run : xarray.Dataset or path
        Result of `slipfront.chain` with output.fronts, which records the arrivals of each slip
        event; or of `pulse` or `chain` without [loading], whose output times give the arrivals.
    threshold : float, optional
        Slip velocity at the front over the largest of the run, by default 0.001. Not for recorded
        arrivals.
    slow : float, optional
        A front below this share of the speed of Rayleigh waves is slow.
    output : path, optional
        NetCDF file to write.
    si : bool, optional
        True for SI units, False for the units of the model. By default they are those of the run.

    Returns
    -------
    xarray.Dataset with the variables front_begin, front_end, front_velocity, ... over `front`, and
    arrival, velocity and stress_ratio over `front` and `position`. Over `event`: event_load,
    event_length and event_crosses. In the units of the model velocities are in c, which is faster
    than Rayleigh waves by the factor 1 over the attribute rayleigh_speed. front_kind is slow,
    sub-Rayleigh, above Rayleigh, faster than c or too short (fewer than three positions).
    stress_ratio is tau / sigma_N. With a substrate tau is the stress Sigma, and without one the
    traction on the interface. It is NaN unless the scenario has friction.normal_stress and a
    complete [medium].

    Raises
    ------
    InputError if the run has no arrivals or a parameter is out of range; FileError if a file cannot
    be read or written.

    Examples
    --------
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml", set={"output.every": 0.2})
    >>> found = slipfront.fronts(pulse)
    >>> found.front_velocity.round(2).values.tolist(), found.front_kind.values.tolist()
    ([0.37, 0.1], ['sub-Rayleigh', 'sub-Rayleigh'])
    """
    slow = _share("slow", slow, 1)
    threshold = None if threshold is None else _share("threshold", threshold, 1)
    file = output_path(output, run)
    run, in_si = _given(run, si)
    x, events = _events(run, threshold)
    constants = _constants(run)
    nu = POISSON_RATIO if constants[1] is None else constants[1]
    rayleigh = _front_paths.rayleigh_speed(nu)
    smooth, unit, normal = _ratio(run, constants)
    factor = math.nan if unit is None or normal is None else unit / normal
    found = [front for event in events for front in _fronts_of(event, x, 2 * float(x[1] - x[0]))]
    unit_of_load = "mu A / pi" if _is_loaded_at_end(run) else TRACTION
    variables = {**_variables(found, x, smooth, factor, (slow, rayleigh)),
                 **_event_variables(events, x, unit_of_load)}
    known = {"normal_stress_pa": normal, "tau_unit_pa": unit, "c_m_s": constants[2]}
    attributes = {"slipfront_format": "fronts 1", "title": run.attrs.get("title", ""),
                  "scenario": run.attrs.get("scenario", ""), "rayleigh_speed": rayleigh,
                  "slow_share": slow, "tau": "traction" if smooth else "stress",
                  "references": _slipfront.reference_of("Eqs. 8-10"),
                  **{name: value for name, value in known.items() if value is not None}}
    position = ("position", x, about("position along the interface", "b / A"))
    data = dataset(variables, {"position": position}, attributes)
    if in_si:
        data = data.slipfront.si()
    if file:
        write_dataset(data, file)
    return data
