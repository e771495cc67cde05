"""The function slipfront.population."""

import math
import time
from collections.abc import Mapping

from .. import _slipfront
from .._dataset import QUANTILE, about, dataset, texts
from .._event import _default, column_map, sources
from .._files import write_dataset
from .._numbers import np, whole
from .._optional import import_optional
from .._scenario import output_path
from .._messages import shown
from .._slipfront import InputError
from . import forward, priors, rows

#: Quantities of single events: name, long_name, units.
STATES = (("stress", "stress before the rupture, in mu A / pi", "1"),
          ("contact_ratio", "contact ratio A", "1"),
          ("friction_per_spacing", "friction coefficient over asperity spacing, C / b", "m-1"),
          ("damping_number", "damping number Gamma = C T c A / b", "1"))
QUANTILES = (0.05, 0.5, 0.95)
LEAST_EVENTS = 3
EVENT_DRAWS = 200


def _positive(name, value, low=0.0):
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not low < number < math.inf:
        raise InputError(f"{name} = '{shown(value)}': out of range; allowed: a number above "
                         f"{low:g}")
    return number


def _measure(name, value, dimension, unit):
    try:
        return _slipfront.measured(str(value), dimension, unit)[0]
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def _prior(changes):
    if not isinstance(changes or {}, Mapping):
        raise InputError(f"prior: a {type(changes).__name__}; allowed: a dict such as "
                         f"{{'friction_median': (0.01, 20)}}")
    for name, pair in (changes or {}).items():
        if name not in priors.NAMES:
            raise InputError(f"prior: '{shown(name)}': unknown; allowed: {', '.join(priors.NAMES)}")
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            raise InputError(f"prior: {name}: '{shown(pair)}': not a median and a factor; allowed: "
                             "two numbers, such as (0.01, 20)")
        _positive(f"prior: median of {name}", pair[0])
        _positive(f"prior: factor of {name}", pair[1], 1.0)
    return priors.Prior(changes)


def _read(events, kind, medium, errors, columns=None):
    """Returns dicts of the events that can be used, and (name, reason) of each of the others."""
    found, left_out = [], []
    for source in sources(events):
        for row in _slipfront.observations([source], medium, column_map(columns)):
            if kind is not None and row["kind"] != kind:
                continue
            read = rows.read_row(row, errors)
            if isinstance(read, str):
                left_out.append((row["name"], read))
            else:
                found.append(read)
    if len(found) < LEAST_EVENTS:
        reasons = f"; left out: '{left_out[0][0]}': {left_out[0][1]}" if left_out else ""
        raise InputError(f"events: {len(found)} can be "
                         f"used{f' of the kind {shown(kind)}' if kind is not None else ''}; "
                         f"allowed: {LEAST_EVENTS} or more{reasons}")
    return found, left_out


def _event_variables(likelihood, values, seed):
    """Returns quantiles of the states of events, in the population and as the only one."""
    from . import single

    generator = np.random.default_rng([seed, 1])
    chosen = values[generator.integers(len(values), size=EVENT_DRAWS)]
    together = np.array([single.draw(likelihood, row, generator) for row in chosen])
    alone = np.array([single.draw(likelihood, likelihood.prior.broad(), generator)
                      for _ in range(EVENT_DRAWS)])
    variables = {}
    for i, (name, long_name, units) in enumerate(STATES):
        for prefix, draws, meaning in (("event_", together, "within the population"),
                                       ("single_", alone, "from this event only")):
            variables[prefix + name] = (("event", "quantile"), np.exp(_quantiles(draws[:, i])),
                                        about(f"{long_name}, {meaning}", units=units))
        attrs = about(f"{long_name}, draws within the population", units=units)
        variables[f"event_draw_{name}"] = (("event", "event_draw"), np.exp(together[:, i]).T, attrs)
    attrs = about("offset of the event's study in ln(slip) or ln(moment)")
    variables["event_study_offset"] = (("event", "quantile"), _quantiles(together[:, 4]), attrs)
    return variables


def _quantiles(draws):
    return np.quantile(draws, QUANTILES, axis=0).T


def _result(likelihood, draws, left_out, studies, seed, attributes):
    prior, variables = likelihood.prior, {}
    for parameter, values, median, factor in zip(priors.PARAMETERS, draws.values.T, prior.medians,
                                                 prior.factors):
        attrs = about(parameter.long_name, units=parameter.units, prior_median=median,
                      prior_factor=factor)
        variables[parameter.name] = ("draw", values, attrs)
    variables |= _event_variables(likelihood, draws.values, seed)
    reasons = [f"{name}: {reason}" for name, reason in left_out]
    variables |= {"name": texts("event", likelihood.events.name, "name of the event"),
                  "study": texts("event", studies, "study that published the event"),
                  "left_out": texts("left_out_event", reasons, "event that was not used, and why")}
    return dataset(variables, QUANTILE,
                   {"Conventions": "CF-1.10", "source": f"slipfront {_slipfront.__version__}",
                    "history": "slipfront population", "slipfront_format": "population 1",
                    "effective_draws": draws.effective, "rhat": draws.rhat,
                    "acceptance": draws.acceptance, "seed": seed, "closure": "consistent",
                    **attributes})


def population(events=None, *, kind=None, prior=None, hardness="10 GPa", smallest_slip=None,
               smallest_moment=None, velocity_error=1.2, size_error=1.5, p_wave_speed=None,
               poisson_ratio=None, shear_modulus=None, steps=400, seed=1, output=None,
               progress=None, columns=None):
    """Infers what the events of a catalogue have in common: stress, effective normal stress and
    friction, and how much they scatter.

    This is a hierarchical model (docs/population.md). Stress, normal stress and friction over
    spacing are lognormal between events. Each event has a rupture velocity (or a length), a slip
    (or a moment and a width) and a duration. All sizes that one study published share an unknown
    factor.

    Parameters
    ----------
    events : path, text, dict, DataFrame or list of these, optional
        Events as in `event`. The model also uses length, width, moment, Mw and study (else
        citation). The default is the catalogue that comes with slipfront.
    kind : str, optional
        Use only events whose column `kind` is this text, such as "earthquake".
    prior : dict, optional
        {parameter: (median, factor)} in place of the defaults. The prior of each parameter is
        lognormal, and `factor` is one standard deviation.
    hardness : str or float, optional
        Penetration hardness, such as "10 GPa". The effective normal stress is the contact ratio
        times this number.
    smallest_slip, smallest_moment : str or float, optional
        Detection limit of the catalogue, in m or N m: it lacks all events below. Every event must
        report that size.
    velocity_error, size_error : float, optional
        Factors that one standard deviation is for rupture velocities, slips and moments without a
        stated error; above 1.
    p_wave_speed, poisson_ratio, shear_modulus : str or float, optional
        Elastic constants for events that give none, as in `event`.
    steps : int, optional
        Number of steps of each of the 40 walkers.
    seed : int, optional
        Seed of the draws, >= 0.
    output : path, optional
        NetCDF file to write.
    progress : callable, optional
        Called with (steps done, all steps).
    columns : path or dict, optional
        Meaning of the columns of a table, as in `event`.

    Returns
    -------
    xarray.Dataset with posterior draws of each parameter over `draw`: stress_median, stress_spread,
    normal_stress_median, normal_stress_spread, friction_median, friction_spread and study_spread.
    For each event, `event_<quantity>` has quantiles within the population, `single_<quantity>`
    those from this event only, and `event_draw_<quantity>` draws. `left_out` names the events that
    cannot be used, with the reason. The attributes `rhat` and `effective_draws` describe the
    convergence; rhat should be below 1.05.

    Raises
    ------
    InputError if fewer than three events can be used or a parameter is out of range; NumericsError
    if no parameters agree with the events.

    Examples
    --------
    >>> rows = "".join(f"{i},{2 + i / 10},{i},{3 * i}\\n" for i in range(1, 6))
    >>> rows = "name,rupture_velocity_km_s,slip_m,duration_s\\n" + rows
    >>> people = slipfront.population(rows, steps=20)
    >>> bool(0.3 < people.stress_median.median() < 3), people.sizes["event"]
    (True, 5)
    """
    from . import sample
    from .likelihood import Likelihood

    whole("steps", steps, 20, 2**31 - 1)
    whole("seed", seed, 0, 2**31 - 1)
    if progress is not None and not callable(progress):
        raise InputError(f"progress: a {type(progress).__name__}; allowed: a function of the steps "
                         "done and all steps")
    file = output_path(output, events, columns)
    import_optional("emcee")
    errors = {"velocity": math.log(_positive("velocity_error", velocity_error, 1.0)),
              "size": math.log(_positive("size_error", size_error, 1.0))}
    limits = {}
    if smallest_slip is not None:
        limits[forward.SLIP] = _measure("smallest_slip", smallest_slip, "length", "m")
    if smallest_moment is not None:
        limits[forward.MOMENT] = _measure("smallest_moment", smallest_moment, "ratio", "")
    if len(limits) > 1:
        raise InputError("smallest_slip and smallest_moment: both are given; allowed: one of them")
    chosen = _prior(prior)
    log_hardness = _measure("hardness", hardness, "pressure", "Pa")
    found, left_out = _read(events, kind, [_default(p_wave_speed), _default(poisson_ratio),
                                           _default(shear_modulus)], errors, columns)
    began = time.monotonic()
    likelihood = Likelihood(rows.arrays(found, limits), log_hardness, chosen)
    draws = sample.sample(likelihood, steps, seed, progress)
    data = _result(likelihood, draws, left_out, [entry["study"] for entry in found], seed,
                   {"hardness_Pa": math.exp(log_hardness),
                    "wall_seconds": time.monotonic() - began})
    if file:
        write_dataset(data, file)
    return data
