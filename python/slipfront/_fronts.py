"""The function slipfront.fronts."""

import dataclasses
import math

from . import _front_paths, _slipfront, _units
from . import medium as laws
from ._accessor import in_model, scenario_table
from ._dataset import dataset
from ._files import write_dataset
from ._numbers import np
from ._run import read
from ._scenario import is_path, output_path
from ._shown import shown
from ._slipfront import InputError

#: Poisson's ratio where [medium] gives none.
POISSON_RATIO = 0.3

#: Classes of fronts by their velocity, from the slowest.
KINDS = ("slow", "sub-Rayleigh", "above Rayleigh", "faster than c", "too short")

#: Slip velocity at the front over the largest one, in a run without slip events, unless the scenario gives pulse.threshold.
THRESHOLD = 1e-3


@dataclasses.dataclass
class _Event:
    """Arrival of slip at each position. `number` counts from 1; it is 0 for a run without slip events."""

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


def _events(run, threshold):
    """Returns the positions and the events of a run. Raises InputError if the run has no arrivals."""
    if "event_arrival" in run:
        if threshold is not None:
            raise InputError("threshold: arrivals were recorded with that of the run; allowed: set loading.event_velocity in the scenario")
        rows = zip(*(run[name].values for name in ("event_arrival", "event_stress_ahead", "event_traction_ahead", "event_load")))
        return run["position"].values, [_Event(i, *row) for i, row in enumerate(rows, 1)]
    if "event_onset" in run or "loading_stress" in run and bool(run["loading_stress"].notnull().any()):
        raise InputError("fronts: the run did not record arrivals, or has no slip event; allowed: a loaded run with output.fronts = 200 or so")
    missing = [name for name in ("time", "x", "W", "Sigma") if name not in run.variables]
    if missing or "level" in run.dims:
        raise InputError(f"fronts: {', '.join(missing) or 'level'}: not a run with these variables; allowed: what pulse and chain return and write")
    speed = np.abs(run["W"].transpose("time", "x").values)
    share = THRESHOLD if threshold is None else threshold
    peak = np.nanmax(speed, initial=0)
    times = _front_paths.arrivals(run["time"].values, speed, share * peak) if peak > 0 else np.full(speed.shape[1], math.nan)
    unknown = np.full(times.size, math.nan)
    return run["x"].values, [_Event(0, times, run["Sigma"].isel(time=0).values, unknown)]


def _fronts_of(event, x, tolerance):
    """Yields the fronts of an event."""
    times = event.arrival
    reached = times[np.isfinite(times)]
    if not reached.size:
        return
    recorded = event.number > 0
    half = _front_paths.HALF_WINDOW if recorded else _front_paths.HALF_WINDOW_OF_OUTPUTS
    for begin, end in _front_paths.fronts_of(times, max(tolerance, 0.01 * float(reached.max() - reached.min()))):
        along, velocity = _front_paths.velocities(x, times, begin, end, half)
        # Outputs show either end of a fit to a cell, in position and in time.
        fitted = along.size - 1 - _front_paths.begin_of_motion(times, along)
        error = math.nan if recorded or along.size < 3 else 2 / min(fitted, 2 * half)
        step = 1 if end >= begin else -1
        if not 0 <= end + step < x.size:
            stops = "end of the block"
        else:
            stops = "stops" if math.isnan(times[end + step]) else "meets another front"
        yield _Front(event, along, velocity, stops, error)


def _kind(velocity, slow, rayleigh):
    """Returns the class of a velocity in c."""
    if math.isnan(velocity):
        return "too short"
    return KINDS[0 if velocity < slow * rayleigh else 1 if velocity <= rayleigh else 2 if velocity <= 1 else 3]


def _constants(run):
    """Returns (mu, nu, c, A, sigma_N) in SI units; None for what the scenario does not give."""
    given = run.slipfront._constants(None, None, None)
    try:
        known = _units.values_of(set(), given)
    except InputError:
        known = dict.fromkeys(("mu", "nu", "c", "A"))
    normal = scenario_table(run, "friction").get("normal_stress")
    return (*(known[symbol] for symbol in ("mu", "nu", "c", "A")), None if normal is None else _units.quantity("friction.normal_stress", normal, "pressure"))


def _ratio(run, constants):
    """Returns the quantity that is tau, its unit in Pa (None if it is not known), and sigma_N in Pa (None likewise).

    With a substrate tau is the stress of the theory. Without one, only friction resists, and tau is the traction on the interface."""
    mu, nu, _, A, normal = constants
    smooth = str(scenario_table(run, "interface").get("contact", 1)) in ("0", "0.0")
    if mu is None or A is None or (smooth and nu is None):
        return smooth, None, normal
    return smooth, float(laws.traction_unit(mu, nu, A) if smooth else laws.stress_unit(mu, A)), normal


def _median(values):
    values = values[~np.isnan(values)]
    return float(np.median(values)) if values.size else math.nan


def _table(fronts, x, smooth, factor):
    """Returns the variables of the fronts: what they are as a whole, and along their paths."""
    grid = np.full((3, len(fronts), x.size), math.nan)
    columns: dict[str, list] = {name: [] for name in ("event", "begin", "end", "onset", "duration", "length", "velocity", "velocity_error", "stress", "traction")}
    for row, front in enumerate(fronts):
        along, times = front.path, front.event.arrival[front.path]
        tau = (front.event.traction if smooth else front.event.stress)[along]
        for layer, values in zip(grid, (times, front.velocity, np.abs(tau) * factor)):
            layer[row, along] = values
        numbers = (front.event.number, x[along[0]], x[along[-1]], times[0], times[-1] - times[0], np.gradient(x)[along].sum(), _median(front.velocity), front.error * _median(front.velocity),
                   _median(np.abs(front.event.stress[along])), _median(np.abs(front.event.traction[along])))
        for column, number in zip(columns.values(), numbers):
            column.append(number)
    return grid, columns


def _described(long_name, unit=""):
    return {"long_name": long_name, "units": "1", **({"dimensional_unit": unit} if unit else {})}


def _variables(fronts, x, smooth, factor, limits):
    grid, columns = _table(fronts, x, smooth, factor)
    kinds = [_kind(velocity, *limits) for velocity in columns["velocity"]]
    about = {
        "event": "number of the slip event, from 1; 0 if the run has none", "begin": ("position at which the front begins", "b / A"),
        "end": ("position at which the front ends", "b / A"), "onset": ("time at which the front begins", "b / (c A)"),
        "duration": ("time from its begin to its end", "b / (c A)"), "length": ("length that the front crosses", "b / A"),
        "velocity": ("median of the velocity along the front", "c"),
        "velocity_error": ("error of the median, if the arrivals come from outputs, which show a front to a cell", "c"), "stress": ("median of the shear stress ahead of the front, before the event", "mu A / pi"),
        "traction": ("median of the force of friction and substrate ahead of the front, before the event", "mu A^2 / (pi (1 - nu))"),
    }
    variables: dict[str, tuple] = {}
    for name, text in about.items():
        values = np.array(columns[name], dtype="int64" if name == "event" else float)
        variables[f"front_{name}"] = ("front", values, _described(*([text] if isinstance(text, str) else text)))
    variables["front_kind"] = ("front", np.array(kinds, dtype=object), {"long_name": f"class by velocity: {', '.join(KINDS)}"})
    variables["front_stop"] = ("front", np.array([front.end for front in fronts], dtype=object), {"long_name": "where the front ends: inside, at the end of the block, or at another front"})
    variables["front_stress_ratio"] = ("front", np.array([_median(row) for row in grid[2]]), _described("median of tau / sigma_N ahead of the front, before the event"))
    along = ("front", "position")
    variables["arrival"] = (along, grid[0], _described("time at which the front arrives", "b / (c A)"))
    variables["velocity"] = (along, grid[1], _described("velocity of the front", "c"))
    variables["stress_ratio"] = (along, grid[2], _described("tau / sigma_N ahead of the front, before the event"))
    return variables


def _event_variables(events, x, unit_of_load):
    reached = np.array([np.isfinite(event.arrival) for event in events]).reshape(len(events), x.size)
    return {
        "event_number": ("event", np.array([event.number for event in events], dtype="int64"), _described("number of the slip event, from 1; 0 if the run has none")),
        "event_load": ("event", np.array([event.load for event in events]), _described("mean force on a site, or the stress at a pulled end, before the event", unit_of_load)),
        "event_length": ("event", reached @ np.gradient(x), _described("length that slip reaches", "b / A")),
        "event_crosses": ("event", reached.all(axis=1).astype("int8"), _described("1 if slip reaches the whole block")),
    }


def _number(name, value, most):
    if isinstance(value, bool) or not isinstance(value, (int, float, np.number)) or not 0 < value < most:
        raise InputError(f"{name} = '{shown(value)}': out of range; allowed: above 0 and below {most:g}")
    return float(value)


def fronts(run, *, threshold=None, slow=0.1, output=None, si=None):
    """Finds the fronts of a run: where each begins, its path and velocity, where it ends, and the stress ahead of it (docs/fronts.md).

    A front begins where slip arrives first. It ends at the end of the block, where it meets another front, or where slip does not reach the next
    position. Its velocity at a position is the median of the slopes of all pairs of the seven nearest arrivals. If the output times give the arrivals, it
    is that of the 41 nearest ones, and front_velocity_error is the error of the median along the front.

    Parameters
    ----------
    run : xarray.Dataset or path
        Result of `slipfront.chain` with output.fronts, which records the arrivals of each slip event; or of `pulse` or `chain` without [loading], whose
        output times give the arrivals.
    threshold : float, optional
        Slip velocity at the front over the largest of the run, by default 0.001. Not for recorded arrivals.
    slow : float, optional
        A front below this share of the speed of Rayleigh waves is slow.
    output : path, optional
        NetCDF file to write.
    si : bool, optional
        True for SI units, False for the units of the model. By default they are those of the run.

    Returns
    -------
    xarray.Dataset with the variables front_begin, front_end, front_velocity, ... over `front`, and arrival, velocity and stress_ratio over `front` and
    `position`. Over `event`: event_load, event_length and event_crosses. In the units of the model velocities are in c, which is faster than Rayleigh
    waves by the factor 1 over the attribute rayleigh_speed. front_kind is slow, sub-Rayleigh, above Rayleigh, faster than c or too short (fewer than three positions).
    stress_ratio is tau / sigma_N. With a substrate tau is the stress Sigma, and without one the traction on the interface. It is NaN unless the
    scenario has friction.normal_stress and a complete [medium].

    Raises
    ------
    InputError if the run has no arrivals or a parameter is out of range; FileError if a file cannot be read or written.

    Examples
    --------
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml", set={"output.every": 0.2})
    >>> found = slipfront.fronts(pulse)
    >>> found.front_velocity.round(2).values.tolist(), found.front_kind.values.tolist()
    ([0.37, 0.1], ['sub-Rayleigh', 'sub-Rayleigh'])
    """
    limits = _number("slow", slow, 1), None if threshold is None else _number("threshold", threshold, 1)
    file = output_path(output, run)
    if not is_path(run) and not hasattr(run, "data_vars"):
        raise InputError(f"run: a {type(run).__name__}; allowed: the Dataset of a run, or the path of its file")
    given = read(run) if is_path(run) else run
    run_in_si = given.attrs.get("unit_system") == "SI"
    run = read(run, si=False) if is_path(run) and run_in_si else in_model(given)
    x, events = _events(run, limits[1])
    constants = _constants(run)
    nu = POISSON_RATIO if constants[1] is None else constants[1]
    rayleigh = _front_paths.rayleigh_speed(nu)
    smooth, unit, normal = _ratio(run, constants)
    found = [front for event in events for front in _fronts_of(event, x, 2 * float(x[1] - x[0]))]
    factor = math.nan if unit is None or normal is None else unit / normal
    by_end = "loading_stress" in run and bool(run["loading_stress"].notnull().any())
    variables = {**_variables(found, x, smooth, factor, (limits[0], rayleigh)), **_event_variables(events, x, "mu A / pi" if by_end else "mu A^2 / (pi (1 - nu))")}
    attributes = {"slipfront_format": "fronts 1", "title": run.attrs.get("title", ""), "scenario": run.attrs.get("scenario", ""), "rayleigh_speed": rayleigh,
                  "slow_share": limits[0], "tau": "traction" if smooth else "stress", "references": _slipfront.reference_of("Eqs. 8-10")}
    known = {"normal_stress_pa": normal, "tau_unit_pa": unit, "c_m_s": constants[2]}
    data = dataset(variables, {"position": ("position", x, _described("position along the interface", "b / A"))},
                   {**attributes, **{name: value for name, value in known.items() if value is not None}})
    if run_in_si if si is None else si:
        data = data.slipfront.si()
    if file:
        write_dataset(data, file)
    return data
