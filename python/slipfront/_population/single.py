"""Draws states of single events, given draws of the parameters of their population."""

from .._numbers import np
from . import likelihood as of

FINER = 0.6  # largest step between nodes; draws are uniform within steps


def _offsets(likelihood, values, generator):
    """Returns a draw of the offset of each event's study; NaN for a study of one event."""
    offsets = np.full(len(likelihood.events), np.nan)
    if len(likelihood.several):
        exponent = likelihood.by_study(values) - 0.5 * of.FINE**2
        drawn = of.FINE[(exponent + generator.gumbel(size=exponent.shape)).argmax(axis=1)]
        drawn = drawn + (of.FINE[1] - of.FINE[0]) * (generator.random(len(drawn)) - 0.5)
        offsets[likelihood.several] = values[-1] * drawn[likelihood.studies]
    return offsets


def draw(likelihood, values, generator):
    """Returns ln(Sigma-), ln(A), ln(C / b), ln(Gamma) and the offset of the study of each event,
    for one set of parameters.

    The nodes of the likelihood are draws of the states of single events. Their weights are those of
    the population."""
    if likelihood.selection:
        likelihood.selection.prepare(values, likelihood.log_hardness)
    _, _, normal, normal_spread, friction, friction_spread, study_spread = values
    offsets = _offsets(likelihood, values, generator)
    alone = np.isnan(offsets)
    nodes = likelihood.nodes(values, np.arange(len(alone)), FINER)
    deviation = nodes.deviation
    known = np.where(alone, 0, offsets)
    width = np.where(alone, np.hypot(deviation, study_spread), deviation)
    off = (nodes.rest - known[:, None, None]) / width[:, None, None]
    exponent = nodes.weight - 0.5 * off**2
    events = np.arange(len(exponent))
    flat = exponent.reshape(len(exponent), -1)
    place = (flat + generator.gumbel(size=flat.shape)).argmax(axis=1)
    rest = nodes.rest.reshape(flat.shape)[events, place]
    normals = generator.standard_normal((2, len(events)))
    row, node = np.divmod(place, nodes.weight.shape[2])
    steps = generator.random((2, len(events))) - 0.5
    column = nodes.column[events, row] + nodes.stride * (node + steps[0])
    log_stress = np.interp(column, np.arange(of.STRESS_STEPS + 1), of.LOG_STRESS)
    share = study_spread**2 / (study_spread**2 + deviation**2)
    offsets = np.where(alone, share * rest + study_spread * np.sqrt(1 - share) * normals[0],
                       offsets)
    variance = normal_spread**2 + friction_spread**2
    kappa = nodes.kappa[events, row]
    scatter = (normal_spread * friction_spread) ** 2 / variance
    gain = scatter / (scatter + likelihood.error**2)
    contact = np.log(normal) - likelihood.log_hardness
    log_contact = (contact + normal_spread**2 / variance * (kappa - contact - np.log(friction))
                   + gain * (rest - offsets) + np.sqrt(scatter * (1 - gain)) * normals[1])
    kappa = kappa + nodes.kappa_step * steps[1]
    log_damping = kappa + np.log(likelihood.events.speed) + likelihood.events.log_duration
    return log_stress, log_contact, kappa - log_contact, log_damping, offsets
