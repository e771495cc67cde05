"""The function slipfront.laboratory."""

import math
from statistics import NormalDist

from .. import _slipfront
from .. import medium as laws
from .._dataset import dataset
from .._files import write_dataset
from .._numbers import np
from .._scenario import output_path
from .._shown import shown
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
        raise InputError(f"{name} = '{shown(values)}': not a range; allowed: two increasing numbers from {least:g} to {most:g}")
    return low, high


def _count(name, value, least):
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= 10**7:
        raise InputError(f"{name} = '{shown(value)}': out of range; allowed: a whole number from {least} to 10000000")
    return int(value)


def _medium(given):
    """Returns (c, nu, mu) in SI units. mu is None if it is not known. Raises InputError."""
    values = values_of(set(), {name: constant(name, value) for name, value in given.items() if value is not None})
    if values["c"] is None or values["nu"] is None:
        raise InputError("medium: the speed c is not known; allowed: poisson_ratio with p_wave_speed, with s_wave_speed, or with shear_modulus and density")
    return values["c"], values["nu"], values["mu"]


def _why_left_out(front, speed):
    """Returns why a front is outside the theory, or ""."""
    velocity = front.front_velocity.middle
    if velocity < 1e-300 * speed:
        return "slower than 1e-300 c, where the closed form ends"
    return f"faster than c = {speed:.4g} m/s: V / c = {velocity / speed:.4g}" if velocity >= speed else ""


def _of_measured(fronts, name, scale=1.0):
    """Returns the middle of a measured quantity of each front and its 5 and 95 %; NaN where there is none."""
    measured = [getattr(front, name) for front in fronts]
    middle = np.array([math.nan if m is None else m.middle for m in measured]) / scale
    ends = np.array([[math.nan] * 2 if m is None else [m.middle] * 2 if m.is_exact else [float(m.quantile(p)) for p in (0.05, 0.95)] for m in measured])
    return middle, ends / scale


def _quantiles(values):
    return np.quantile(values, SHARES, axis=-1).T


class _Analysis:
    """The fronts of one experiment, their evidence and the posterior."""

    def __init__(self, fronts, speed, plastic, prior, scatter_prior, file="table"):
        self.speed, self.ln_factor, self.fronts = speed, math.log(math.pi / plastic), fronts
        highest = math.log(prior[1]) + 5 * scatter_prior[1]
        self.reasons = [_why_left_out(front, speed) for front in fronts]
        self.evidence = [None if reason else Evidence(front, speed, self.ln_factor, highest) for front, reason in zip(fronts, self.reasons)]
        for i, one in enumerate(self.evidence):
            if one is not None and not one.possible:
                self.reasons[i], self.evidence[i] = "no stress of the theory gives both the velocity and the stress drop", None
        used = [one for one in self.evidence if one is not None]
        if not used:
            raise InputError(f"{shown(file)}: no front can be used: {self.reasons[0]}; allowed: fronts slower than c")
        self.posterior = Posterior(used, prior, scatter_prior)

    def predict(self, random):
        """Returns draws of ln h and ln s, and of the ln h of a further front."""
        y, ln_scatter = self.posterior.draws(PREDICTIONS, random)
        return y, ln_scatter, y + np.exp(ln_scatter) * random.standard_normal(PREDICTIONS)


def _draws_of(measured, random):
    if measured.is_exact:
        return np.full(PREDICTIONS, measured.middle)
    draws = measured.quantile(random.random(PREDICTIONS))
    return np.where(draws > 0, draws, measured.middle)


def _of_fronts(analysis, y_new, random):
    """Returns the variables of each front: what it was predicted to do, and how far it is from that."""
    fronts = analysis.fronts
    velocity, drop, own = (np.full((len(fronts), 3), math.nan) for _ in range(3))
    deviation, of_drop = np.full(len(fronts), math.nan), np.full(len(fronts), math.nan)
    ln_stresses = np.linspace(math.log(LEAST_STRESS), 12, 8000)
    shares = closed_form(ln_stresses)[1]
    for i, front in enumerate(fronts):
        shear = _draws_of(front.shear_stress, random)
        ln_stress = analysis.ln_factor + np.log(shear / _draws_of(front.normal_stress, random)) + y_new
        predicted_drop = shear * np.interp(ln_stress, ln_stresses, shares)
        velocity[i], drop[i] = closed_form(_quantiles(ln_stress))[0], _quantiles(predicted_drop)  # V increases with Sigma-
        one = analysis.evidence[i]
        if one is not None:
            points, masses = one.levels[0][:2]
            variance = float((masses * (points - one.mean) ** 2).sum())
            own[i] = np.exp(one.quantiles(SHARES))
            deviation[i] = (one.mean - y_new.mean()) / math.sqrt(variance + y_new.var())
        if front.stress_drop is not None:
            measured, predicted = np.log(_draws_of(front.stress_drop, random)), np.log(predicted_drop)
            of_drop[i] = (measured.mean() - predicted.mean()) / math.sqrt(measured.var() + predicted.var())
    return velocity, drop, own, deviation, of_drop


def _front_variables(analysis, y_new, random):
    fronts = analysis.fronts
    velocity, velocity_ends = _of_measured(fronts, "front_velocity", analysis.speed)
    stresses = {name: _of_measured(fronts, name) for name in ("shear_stress", "normal_stress", "stress_drop")}
    ratio = stresses["shear_stress"][0] / stresses["normal_stress"][0]
    ratio_ends = np.array([np.quantile(_draws_of(f.shear_stress, random) / _draws_of(f.normal_stress, random), [0.05, 0.95]) for f in fronts])
    predicted, drop, own, deviation, of_drop = _of_fronts(analysis, y_new, random)
    per_front, per_bound = ("front",), ("front", "bound")
    variables: dict[str, tuple] = {
        "name": (per_front, np.array([front.name for front in fronts], dtype=object), {"long_name": "name of the front"}),
        "included": (per_front, np.array([not reason for reason in analysis.reasons], dtype="int8"), {"long_name": "1 if the front is part of the inference", "units": "1"}),
        "reason": (per_front, np.array(analysis.reasons, dtype=object), {"long_name": "why the front was left out"}),
    }

    def add(name, long_name, unit, middle, ends, **attrs):
        variables[name] = (per_front, middle, {"long_name": long_name, "units": unit, **attrs})
        variables[f"{name}_interval"] = (per_bound, ends, {"long_name": f"5 and 95 % of: {long_name}", "units": unit, **attrs})

    for name, (middle, ends) in stresses.items():
        add(name, f"measured {name.replace('_', ' ')}", "Pa", middle, ends)
    add("stress_ratio", "measured shear stress over normal stress", "1", ratio, ratio_ends)
    add("front_velocity", "measured front velocity over c", "1", velocity, velocity_ends, dimensional_unit="c")
    add("predicted_front_velocity", "front velocity over c that the theory predicts for another front under these stresses", "1", predicted[:, 1], predicted[:, ::2],
        dimensional_unit="c", references=_slipfront.reference_of("Eqs. 8-10"))
    add("predicted_stress_drop", "static stress drop that the theory predicts for another front under these stresses", "Pa", drop[:, 1], drop[:, ::2])
    add("hardness_over_modulus_of_front", "hardness over shear modulus from this front only", "1", own[:, 1], own[:, ::2])
    variables["deviation"] = (per_front, deviation, {"long_name": "distance of the front from the prediction, in standard deviations of ln h", "units": "1"})
    variables["stress_drop_deviation"] = (per_front, of_drop, {"long_name": "distance of the stress drop from the prediction, in standard deviations of its logarithm", "units": "1"})
    return variables


def _curve_variables(analysis, ratios, y_shares, y_new):
    """Returns V / c against tau / sigma_N: the curve, the interval of the curve, and that of a further front. V increases with h."""
    at = np.geomspace(0.6 * ratios.min(), min(1.5 * ratios.max(), 1e3), CURVE)
    curve = closed_form(np.log(at)[:, None] + analysis.ln_factor + y_shares)[0]
    front = closed_form(np.log(at)[:, None] + analysis.ln_factor + np.quantile(y_new, SHARES))[0]
    about = {"units": "1", "dimensional_unit": "c"}
    return {"curve_front_velocity": (("curve", "quantile"), curve, {"long_name": "front velocity over c by the theory", **about}),
            "curve_further_front_velocity": (("curve", "quantile"), front, {"long_name": "front velocity over c of a further front, with the scatter", **about})}, at


def _scalars(name, long_name, shares, unit="1"):
    return {name: ((), shares[1], {"long_name": long_name, "units": unit}),
            f"{name}_interval": (("bound",), np.array([shares[0], shares[2]]), {"long_name": f"5 and 95 % of: {long_name}", "units": unit})}


def _result_variables(analysis, y_shares, scatter_shares, modulus, draws):
    variables = _scalars("hardness_over_modulus", "penetration hardness sigma_p over shear modulus mu", np.exp(y_shares))
    variables.update(_scalars("scatter", "standard deviation of ln(sigma_p / mu) from front to front", np.exp(scatter_shares)))
    if modulus is not None:
        variables.update(_scalars("hardness", "penetration hardness sigma_p", modulus * np.exp(y_shares), "Pa"))
    y, ln_scatter = draws
    variables["draw_hardness_over_modulus"] = ("draw", np.exp(y), {"long_name": "draws from the posterior of sigma_p / mu, of equal weight", "units": "1"})
    variables["draw_scatter"] = ("draw", np.exp(ln_scatter), {"long_name": "draws from the posterior of the scatter, of equal weight", "units": "1"})
    return variables


def laboratory(table, *, poisson_ratio=None, shear_modulus=None, density=None, p_wave_speed=None, s_wave_speed=None, prior=(1e-3, 10.0), scatter_prior=(1e-3, 1.0),
               draws=1000, seed=1, strict=False, output=None, columns=None, normal_stress=None):
    """Computes the penetration hardness over the shear modulus from fronts in the laboratory.

    The velocity of a front is a function of Sigma- = pi (sigma_p / mu) (tau / sigma_N) / A_plastic (Eqs. 8-10, no friction). All fronts have one
    sigma_p / mu, about which those of the single fronts scatter with the standard deviation `scatter` of the logarithm (docs/laboratory_fronts.md).

    Parameters
    ----------
    table : path, text, dict of columns or DataFrame
        CSV with the columns tau (or shear_stress), normal_stress, front_velocity (or rupture_velocity) and, if known, name and stress_drop, or the
        stress after the front in its place (shear_stress_after). The unit is in the title, as in `tau [MPa]`, or in the cell, as in
        `1.2 +- 0.1 MPa`. Errors are those of `slipfront.event`. A stress drop without an error is not used.
    poisson_ratio, shear_modulus, density, p_wave_speed, s_wave_speed : str or float
        Constants of the material in SI units, or texts such as "2 GPa". The speed c needs poisson_ratio, and p_wave_speed, s_wave_speed, or
        shear_modulus with density.
    prior : (float, float), optional
        Range of sigma_p / mu, whose logarithm has a uniform prior.
    scatter_prior : (float, float), optional
        Range of the scatter, whose logarithm has a uniform prior.
    draws : int, optional
        Number of draws from the posterior in the result.
    seed : int, optional
        Seed of the draws and of the predictions. The posterior itself is computed by quadrature.
    strict : bool, optional
        Whether a bad row is an error. By default the other rows are used, and the attribute `errors` has the reasons.
    output : path, optional
        NetCDF file to write.
    columns : path or dict, optional
        Meaning of the columns of the table: the map of `slipfront.event`, with the quantities shear_stress, shear_stress_after, normal_stress,
        rupture_velocity and stress_drop.
    normal_stress : str or float, optional
        Normal stress of fronts for which the table has none, such as "2 MPa" or a number in Pa.

    Returns
    -------
    xarray.Dataset with the scalars hardness_over_modulus, scatter and, if the shear modulus is known, hardness (Pa): medians, and `<name>_interval`
    with 5 and 95 %. Over `front`: the measured quantities, predicted_front_velocity and predicted_stress_drop, hardness_over_modulus_of_front,
    deviation, included and reason. Over `curve`: front velocity against tau / sigma_N. Over `draw`: draws from the posterior. If the table has stress
    drops, hardness_over_modulus_from_velocity is the result without them.

    Raises
    ------
    InputError if no front can be used or a parameter is out of range; FileError if a file cannot be read or written.

    Examples
    --------
    >>> fronts = {"tau [MPa]": [2.0, 2.6], "normal_stress [MPa]": [5.0, 5.0], "front_velocity [m/s]": ["90 +- 9", "260 +- 26"]}
    >>> found = slipfront.laboratory(fronts, poisson_ratio=0.35, s_wave_speed="1300 m/s")
    >>> bool(0.1 < found.hardness_over_modulus < 1)
    True
    """
    speed, nu, modulus = _medium({"poisson_ratio": poisson_ratio, "shear_modulus": shear_modulus, "density": density, "p_wave_speed": p_wave_speed,
                                  "s_wave_speed": s_wave_speed})
    prior, scatter_prior = _range("prior", prior, 1e-12, 1e12), _range("scatter_prior", scatter_prior, 1e-6, 10)
    draws, seed, file = _count("draws", draws, 1), _count("seed", seed, 0), output_path(output, table, columns)
    found = of_fronts.read(table, strict, columns, normal_stress)
    plastic = float(laws.plastic_contact_ratio(nu))
    analysis = _Analysis(found.fronts, speed, plastic, prior, scatter_prior, found.file)
    random = np.random.default_rng(seed)
    y_shares, scatter_shares = analysis.posterior.quantiles(SHARES)
    _, _, y_new = analysis.predict(random)
    variables = _front_variables(analysis, y_new, random)
    curve, ratios = _curve_variables(analysis, variables["stress_ratio"][1], y_shares, y_new)
    variables.update(_result_variables(analysis, y_shares, scatter_shares, modulus, analysis.posterior.draws(draws, random)))
    variables.update(curve)
    if any(front.stress_drop for front in found.fronts):
        variables.update(_without_drops(found.fronts, speed, plastic, prior, scatter_prior))
    data = dataset(variables, _coordinates(ratios), {**_attributes(found, analysis, (speed, nu, modulus), prior, scatter_prior),
                                                     "warnings": "\n".join(found.notes + _warnings(y_shares, scatter_shares, prior, scatter_prior)
                                                                           + _contradictions(variables, np.exp(scatter_shares)))})
    if file:
        write_dataset(data, file)
    return data


def _without_drops(fronts, speed, plastic, prior, scatter_prior):
    fronts = [of_fronts.Front(f.name, f.line, f.shear_stress, f.normal_stress, f.front_velocity) for f in fronts]
    shares = _Analysis(fronts, speed, plastic, prior, scatter_prior).posterior.quantiles(SHARES)[0]
    return _scalars("hardness_over_modulus_from_velocity", "penetration hardness over shear modulus without the stress drops", np.exp(shares))


def _contradictions(variables, scatter):
    """Returns where the fronts contradict the theory, and whether they can test it. `scatter` has its quantiles from front to front."""
    found = []
    names, used, sigmas = variables["name"][1], variables["included"][1] == 1, variables["stress_drop_deviation"][1]
    compared = np.isfinite(sigmas).sum()
    farthest = int(np.abs(np.nan_to_num(sigmas)).argmax())
    if compared and abs(sigmas[farthest]) > NormalDist().inv_cdf(1 - 0.025 / compared):  # chance explains so much in 5 % of tables
        side = "above" if sigmas[farthest] > 0 else "below"
        found.append(f"the stress drops contradict the theory: {names[farthest]} is {abs(sigmas[farthest]):.2g} standard deviations {side} its prediction, "
                     f"and {int((np.abs(np.nan_to_num(sigmas)) >= 2).sum())} of {compared} are 2 or more away")
    ratios, velocities = variables["stress_ratio"][1][used], variables["front_velocity"][1][used]
    if used.sum() > 1 and np.ptp(np.log(ratios)) < max(scatter[0], SAME_RATIO):
        found.append(f"the fronts cannot test the theory: tau / sigma_N spans only {ratios.min():.3g} to {ratios.max():.3g}; the scatter from front to front is "
                     f"{100 * scatter[1]:.2g} %, while the velocity spans a factor of {velocities.max() / velocities.min():.3g}")
    return found


def _warnings(y_shares, scatter_shares, prior, scatter_prior):
    """Returns what the user must know about the priors: where one of them, and not the fronts, bounds the result."""
    found = []
    for name, (low, _, high), bounds in (("hardness over modulus", y_shares, prior), ("scatter", scatter_shares, scatter_prior)):
        least, most = np.log(bounds)
        margin = 0.02 * (most - least)
        if low < least + margin and name != "scatter":
            found.append(f"the prior bounds the {name} from below, at {bounds[0]:g}: give a wider prior or take the result as an upper bound")
        if high > most - margin:
            found.append(f"the prior bounds the {name} from above, at {bounds[1]:g}: give a wider prior or take the result as a lower bound")
    return found


def _coordinates(ratios):
    return {"bound": ("bound", ["5 %", "95 %"], {"long_name": "ends of an interval"}),
            "quantile": ("quantile", list(SHARES), {"long_name": "share of the values below", "units": "1"}),
            "curve_stress_ratio": ("curve", ratios, {"long_name": "shear stress over normal stress", "units": "1"})}


def _attributes(found, analysis, medium, prior, scatter_prior):
    speed, nu, modulus = medium
    return {"slipfront_format": "laboratory 1", "table": found.file, "c_m_s": speed, "poisson_ratio": nu, **({"shear_modulus_pa": modulus} if modulus else {}),
            "contact_ratio_of_yield": math.pi / math.exp(analysis.ln_factor), "prior_low": prior[0], "prior_high": prior[1],
            "scatter_prior_low": scatter_prior[0], "scatter_prior_high": scatter_prior[1],
            "fronts_left_out": sum(1 for reason in analysis.reasons if reason), "errors": "\n".join(found.errors), "ignored_columns": ", ".join(found.ignored_columns)}
