"""The function slipfront.laboratory."""

import math
from statistics import NormalDist

from .. import _slipfront
from .. import medium as laws
from .._dataset import BOUND, QUANTILE, about, dataset, texts
from .._files import write_dataset
from .._numbers import np, whole
from .._scenario import output_path
from .._messages import shown
from .._slipfront import InputError
from .._units import constant, values_of
from . import fronts as of_fronts
from .hardness import LEAST_STRESS, Evidence, Posterior, closed_form

SHARES = (0.05, 0.5, 0.95)

#: Draws from which predictions are computed, and points of the predicted curve.
PREDICTIONS, CURVE = 20000, 120

#: Fronts whose tau / sigma_N differs by less than this share have the same.
SAME_RATIO = 0.02


def _range(name, values, least, most):
    """Returns two increasing numbers of a parameter. Raises InputError."""
    try:
        low, high = (float(value) for value in values)
    except (TypeError, ValueError):
        low = high = math.nan
    if not least <= low < high <= most:
        raise InputError(f"{name} = '{shown(values)}': not a range; "
                         f"allowed: two increasing numbers from {least:g} to {most:g}")
    return low, high


def _medium(**given):
    """Returns (c, nu, mu) in SI units. mu is None if it is not known. Raises InputError."""
    known = {name: constant(name, value) for name, value in given.items() if value is not None}
    values = values_of(set(), known)
    if values["c"] is None or values["nu"] is None:
        raise InputError("medium: the speed c is not known; allowed: poisson_ratio with "
                         "p_wave_speed, with s_wave_speed, or with shear_modulus and density")
    return values["c"], values["nu"], values["mu"]


def _why_left_out(front, speed):
    """Returns why a front is outside the theory, or ""."""
    velocity = front.front_velocity.middle
    if velocity < 1e-300 * speed:
        return "slower than 1e-300 c, where the closed form ends"
    if velocity >= speed:
        return f"faster than c = {speed:.4g} m/s: V / c = {velocity / speed:.4g}"
    return ""


def _measured(fronts, name):
    """Returns 5 %, the middle and 95 % of a quantity of each front; NaN where there is none."""
    def row(value):
        if value is None:
            return [math.nan] * 3
        ends = value.quantile([0.05, 0.95]) if not value.is_exact else [value.middle] * 2
        return [ends[0], value.middle, ends[1]]

    return np.array([row(getattr(front, name)) for front in fronts])


def _quantiles(values):
    return np.quantile(values, SHARES, axis=-1).T


class _Analysis:
    """The fronts of one experiment, their evidence and the posterior."""

    def __init__(self, fronts, speed, plastic, prior, scatter_prior, file="table"):
        self.speed, self.ln_factor, self.fronts = speed, math.log(math.pi / plastic), fronts
        highest = math.log(prior[1]) + 5 * scatter_prior[1]
        self.reasons = [_why_left_out(front, speed) for front in fronts]
        self.evidence = [None if reason else Evidence(front, speed, self.ln_factor, highest)
                         for front, reason in zip(fronts, self.reasons)]
        for i, one in enumerate(self.evidence):
            if one is not None and not one.possible:
                self.evidence[i] = None
                self.reasons[i] = ("no stress of the theory gives both the velocity and the stress "
                                   "drop")
        used = [one for one in self.evidence if one is not None]
        if not used:
            raise InputError(f"{shown(file)}: no front can be used: {self.reasons[0]}; "
                             "allowed: fronts slower than c")
        self.posterior = Posterior(used, prior, scatter_prior)

    def further_front(self, random):
        """Returns draws of the ln h of a further front."""
        y, ln_scatter = self.posterior.draws(PREDICTIONS, random)
        return y + np.exp(ln_scatter) * random.standard_normal(PREDICTIONS)


def _draws_of(measured, random):
    if measured.is_exact:
        return np.full(PREDICTIONS, measured.middle)
    draws = measured.quantile(random.random(PREDICTIONS))
    return np.where(draws > 0, draws, measured.middle)


def _deviation(mean, variance, predicted):
    return (mean - predicted.mean()) / math.sqrt(variance + predicted.var())


def _predictions(analysis, y_new, random):
    """Returns what each front was predicted to do, its own ln h, and its distances from these."""
    fronts = analysis.fronts
    velocity, drop, own = np.full((3, len(fronts), 3), math.nan)
    deviation, of_drop = np.full((2, len(fronts)), math.nan)
    ln_stresses = np.linspace(math.log(LEAST_STRESS), 12, 8000)
    shares = closed_form(ln_stresses)[1]
    for i, front in enumerate(fronts):
        shear = _draws_of(front.shear_stress, random)
        ratio = shear / _draws_of(front.normal_stress, random)
        ln_stress = analysis.ln_factor + np.log(ratio) + y_new
        velocity[i] = closed_form(_quantiles(ln_stress))[0]  # V increases with Sigma-
        predicted_drop = shear * np.interp(ln_stress, ln_stresses, shares)
        drop[i] = _quantiles(predicted_drop)
        one = analysis.evidence[i]
        if one is not None:
            points, masses = one.levels[0][:2]
            own[i] = np.exp(one.quantiles(SHARES))
            variance = float((masses * (points - one.mean) ** 2).sum())
            deviation[i] = _deviation(one.mean, variance, y_new)
        if front.stress_drop is not None:
            measured = np.log(_draws_of(front.stress_drop, random))
            of_drop[i] = _deviation(measured.mean(), measured.var(), np.log(predicted_drop))
    return velocity, drop, own, deviation, of_drop


def _with_interval(name, long_name, values, units="1", **further):
    """Returns a variable and its interval, of values whose last axis has the SHARES."""
    dims, attrs = ("front",)[:values.ndim - 1], about(long_name, units=units, **further)
    ends = {**attrs, "long_name": f"5 and 95 % of: {long_name}"}
    return {name: (dims, values[..., 1], attrs),
            f"{name}_interval": ((*dims, "bound"), values[..., ::2], ends)}


def _front_variables(analysis, y_new, random):
    fronts = analysis.fronts
    names = ("shear_stress", "normal_stress", "stress_drop")
    stresses = {name: _measured(fronts, name) for name in names}
    ratio = stresses["shear_stress"] / stresses["normal_stress"]
    ratio[:, ::2] = [np.quantile(_draws_of(front.shear_stress, random)
                                 / _draws_of(front.normal_stress, random), [0.05, 0.95])
                     for front in fronts]
    velocity, drop, own, deviation, of_drop = _predictions(analysis, y_new, random)
    rows = {"included": (np.array([not reason for reason in analysis.reasons], dtype="int8"),
                         "1 if the front is part of the inference"),
            "deviation": (deviation, "distance of the front from the prediction, in standard "
                          "deviations of ln h"),
            "stress_drop_deviation": (of_drop, "distance of the stress drop from the prediction, "
                                      "in standard deviations of its logarithm")}
    found = {"name": texts("front", [front.name for front in fronts], "name of the front"),
             "reason": texts("front", analysis.reasons, "why the front was left out")}
    found |= {name: ("front", values, about(words)) for name, (values, words) in rows.items()}
    for name, values in stresses.items():
        found |= _with_interval(name, f"measured {name.replace('_', ' ')}", values, "Pa")
    theory = "that the theory predicts for another front under these stresses"
    found |= _with_interval("stress_ratio", "measured shear stress over normal stress", ratio)
    found |= _with_interval("front_velocity", "measured front velocity over c",
                            _measured(fronts, "front_velocity") / analysis.speed,
                            dimensional_unit="c")
    found |= _with_interval("predicted_front_velocity", f"front velocity over c {theory}", velocity,
                            dimensional_unit="c", references=_slipfront.reference_of("Eqs. 8-10"))
    found |= _with_interval("predicted_stress_drop", f"static stress drop {theory}", drop, "Pa")
    return found | _with_interval("hardness_over_modulus_of_front",
                                  "hardness over shear modulus from this front only", own)


def _curve_variables(analysis, ratios, y_shares, y_new):
    """Returns V / c against tau / sigma_N, by the theory and of a further front, and the ratios."""
    at = np.geomspace(0.6 * ratios.min(), min(1.5 * ratios.max(), 1e3), CURVE)
    curve, front = (closed_form(np.log(at)[:, None] + analysis.ln_factor + y)[0]
                    for y in (y_shares, np.quantile(y_new, SHARES)))  # V increases with h
    dims, long_name = ("curve", "quantile"), "front velocity over c"
    return {"curve_front_velocity": (dims, curve, about(f"{long_name} by the theory", "c")),
            "curve_further_front_velocity":
                (dims, front, about(f"{long_name} of a further front, with the scatter", "c"))}, at


def _result_variables(y_shares, scatter_shares, modulus, draws):
    found = _with_interval("hardness_over_modulus", "penetration hardness sigma_p over shear "
                           "modulus mu", np.exp(y_shares))
    found |= _with_interval("scatter", "standard deviation of ln(sigma_p / mu) from front to front",
                            np.exp(scatter_shares))
    if modulus is not None:
        found |= _with_interval("hardness", "penetration hardness sigma_p",
                                modulus * np.exp(y_shares), "Pa")
    for name, symbol, values in zip(("hardness_over_modulus", "scatter"),
                                    ("sigma_p / mu", "the scatter"), draws):
        attrs = about(f"draws from the posterior of {symbol}, of equal weight")
        found[f"draw_{name}"] = ("draw", np.exp(values), attrs)
    return found


def laboratory(table, *, poisson_ratio=None, shear_modulus=None, density=None, p_wave_speed=None,
               s_wave_speed=None, prior=(1e-3, 10.0), scatter_prior=(1e-3, 1.0), draws=1000, seed=1,
               strict=False, output=None, columns=None, normal_stress=None):
    """Computes the penetration hardness over the shear modulus from fronts in the laboratory.

    The velocity of a front is a function of Sigma- = pi (sigma_p / mu) (tau / sigma_N) / A_plastic
    (Eqs. 8-10, no friction). All fronts have one sigma_p / mu, about which those of the single
    fronts scatter with the standard deviation `scatter` of the logarithm
    (docs/laboratory_fronts.md).

    Parameters
    ----------
    table : path, text, dict of columns or DataFrame
        CSV with the columns tau (or shear_stress), normal_stress, front_velocity (or
        rupture_velocity) and, if known, name and stress_drop, or the stress after the front in its
        place (shear_stress_after). The unit is in the title, as in `tau [MPa]`, or in the cell, as
        in `1.2 +- 0.1 MPa`. Errors are those of `slipfront.event`. A stress drop without an error
        is not used.
    poisson_ratio, shear_modulus, density, p_wave_speed, s_wave_speed : str or float
        Constants of the material in SI units, or texts such as "2 GPa". The speed c needs
        poisson_ratio, and p_wave_speed, s_wave_speed, or shear_modulus with density.
    prior, scatter_prior : (float, float), optional
        Ranges of sigma_p / mu and of the scatter, whose logarithms have uniform priors.
    draws : int, optional
        Number of draws from the posterior in the result.
    seed : int, optional
        Seed of the draws and of the predictions. The posterior itself is computed by quadrature.
    strict : bool, optional
        Whether a bad row is an error. By default the other rows are used, and the attribute
        `errors` has the reasons.
    output : path, optional
        NetCDF file to write.
    columns : path or dict, optional
        Meaning of the columns of the table: the map of `slipfront.event`, with the quantities
        shear_stress, shear_stress_after, normal_stress, rupture_velocity and stress_drop.
    normal_stress : str or float, optional
        Normal stress of fronts for which the table has none, such as "2 MPa" or a number in Pa.

    Returns
    -------
    xarray.Dataset with the scalars hardness_over_modulus, scatter and, if the shear modulus is
    known, hardness (Pa): medians, and `<name>_interval` with 5 and 95 %. Over `front`: the measured
    quantities, predicted_front_velocity and predicted_stress_drop, hardness_over_modulus_of_front,
    deviation, included and reason. Over `curve`: front velocity against tau / sigma_N. Over `draw`:
    draws from the posterior. If the table has stress drops, hardness_over_modulus_from_velocity is
    the result without them.

    Raises
    ------
    InputError if no front can be used or a parameter is out of range; FileError if a file cannot be
    read or written.

    Examples
    --------
    >>> fronts = {"tau [MPa]": [2.0, 2.6], "normal_stress [MPa]": [5.0, 5.0],
    ...           "front_velocity [m/s]": ["90 +- 9", "260 +- 26"]}
    >>> found = slipfront.laboratory(fronts, poisson_ratio=0.35, s_wave_speed="1300 m/s")
    >>> bool(0.1 < found.hardness_over_modulus < 1)
    True
    """
    medium = _medium(poisson_ratio=poisson_ratio, shear_modulus=shear_modulus, density=density,
                     p_wave_speed=p_wave_speed, s_wave_speed=s_wave_speed)
    priors = _range("prior", prior, 1e-12, 1e12), _range("scatter_prior", scatter_prior, 1e-6, 10)
    draws, seed = whole("draws", draws, 1, 10**7), whole("seed", seed, 0, 10**7)
    file = output_path(output, table, columns)
    found = of_fronts.read(table, strict, columns, normal_stress)
    given = medium[0], float(laws.plastic_contact_ratio(medium[1])), *priors
    analysis = _Analysis(found.fronts, *given, found.file)
    random = np.random.default_rng(seed)
    y, scatter = analysis.posterior.quantiles(SHARES)
    y_new = analysis.further_front(random)
    fronts = _front_variables(analysis, y_new, random)
    curve, ratios = _curve_variables(analysis, fronts["stress_ratio"][1], y, y_new)
    drawn = analysis.posterior.draws(draws, random)
    variables = {**fronts, **_result_variables(y, scatter, medium[2], drawn), **curve}
    if any(front.stress_drop for front in found.fronts):
        variables |= _without_drops(found.fronts, *given)
    warnings = [*found.notes, *_warnings(y, scatter, priors),
                *_contradictions(variables, np.exp(scatter))]
    coordinates = {**BOUND, **QUANTILE,
                   "curve_stress_ratio": ("curve", ratios,
                                          about("shear stress over normal stress"))}
    data = dataset(variables, coordinates, {**_attributes(found, analysis, medium, *priors),
                                            "warnings": "\n".join(warnings)})
    if file:
        write_dataset(data, file)
    return data


def _without_drops(fronts, *given):
    fronts = [of_fronts.Front(f.name, f.line, f.shear_stress, f.normal_stress, f.front_velocity)
              for f in fronts]
    shares = _Analysis(fronts, *given).posterior.quantiles(SHARES)[0]
    return _with_interval("hardness_over_modulus_from_velocity", "penetration hardness over shear "
                          "modulus without the stress drops", np.exp(shares))


def _contradictions(variables, scatter):
    """Returns where the fronts contradict the theory, and whether they can test it.

    `scatter` has the quantiles of the scatter from front to front."""
    def column(name):
        return variables[name][1]

    found, used = [], column("included") == 1
    sigmas = np.nan_to_num(column("stress_drop_deviation"))
    compared = np.isfinite(column("stress_drop_deviation")).sum()
    far = int(np.abs(sigmas).argmax())
    # Chance explains so much in 5 % of tables.
    if compared and abs(sigmas[far]) > NormalDist().inv_cdf(1 - 0.025 / compared):
        found.append(f"the stress drops contradict the theory: {column('name')[far]} is "
                     f"{abs(sigmas[far]):.2g} standard deviations "
                     f"{'above' if sigmas[far] > 0 else 'below'} its prediction, and "
                     f"{int((np.abs(sigmas) >= 2).sum())} of {compared} are 2 or more away")
    ratios, velocities = column("stress_ratio")[used], column("front_velocity")[used]
    if used.sum() > 1 and np.ptp(np.log(ratios)) < max(scatter[0], SAME_RATIO):
        found.append("the fronts cannot test the theory: tau / sigma_N spans only "
                     f"{ratios.min():.3g} to {ratios.max():.3g}; the scatter from front to front "
                     f"is {100 * scatter[1]:.2g} %, while the velocity spans a factor of "
                     f"{velocities.max() / velocities.min():.3g}")
    return found


def _warnings(y, scatter, priors):
    """Returns where a prior, and not the fronts, bounds the result."""
    found = []
    for name, shares, bounds in zip(("hardness over modulus", "scatter"), (y, scatter), priors):
        least, most = np.log(bounds)
        margin = 0.02 * (most - least)
        for wrong, side, at, bound in (
                (shares[0] < least + margin and name != "scatter", "below", bounds[0], "an upper"),
                (shares[2] > most - margin, "above", bounds[1], "a lower")):
            if wrong:
                found.append(f"the prior bounds the {name} from {side}, at {at:g}: "
                             f"give a wider prior or take the result as {bound} bound")
    return found


def _attributes(found, analysis, medium, prior, scatter_prior):
    speed, nu, modulus = medium
    return {"slipfront_format": "laboratory 1", "table": found.file, "c_m_s": speed,
            "poisson_ratio": nu, **({"shear_modulus_pa": modulus} if modulus else {}),
            "contact_ratio_of_yield": math.pi / math.exp(analysis.ln_factor),
            "prior_low": prior[0], "prior_high": prior[1], "scatter_prior_low": scatter_prior[0],
            "scatter_prior_high": scatter_prior[1],
            "fronts_left_out": sum(1 for reason in analysis.reasons if reason),
            "errors": "\n".join(found.errors), "ignored_columns": ", ".join(found.ignored_columns)}
