"""The command slipfront population, a hierarchical model of many events."""

import json
import warnings

from ._arguments import Arguments, progress, put
from ._population.priors import NAMES, PARAMETERS
from ._table import table

#: Largest R-hat of a sample that has converged.
CONVERGED = 1.05


def prior(texts):
    found = {}
    for text in texts:
        name, _, pair = text.partition("=")
        try:
            median, factor = (float(part) for part in pair.split(","))
        except ValueError:
            raise ValueError(f"--prior {text}: not a median and a factor; allowed: "
                             "NAME=MEDIAN,FACTOR, such as friction_median=0.01,20") from None
        found[name.strip()] = (median, factor)
    return found


def summary(data):
    return {name: dict(zip(("5 %", "50 %", "95 %"),
                           data[name].quantile([0.05, 0.5, 0.95]).values.tolist()))
            for name in NAMES}


def parameters_of(data):
    """Returns the parameters as text, next to their priors."""
    units = {parameter.name: parameter.units for parameter in PARAMETERS}
    rows: list[tuple[str, ...]] = [("parameter", "unit", "5 %", "median", "95 %", "prior",
                                    "factor")]
    for name, numbers in summary(data).items():
        rows.append((name, "" if units[name] == "1" else units[name],
                     *(f"{value:.4g}" for value in numbers.values()),
                     f"{data[name].prior_median:.4g}", f"{data[name].prior_factor:.3g}"))
    return table(list(zip(*rows)), left=1)


def notes(data):
    """Returns lines about the events that were used and about the convergence."""
    lines = [f"{data.sizes['event']} events of {len(set(data.study.values.tolist()))} studies, "
             f"{data.sizes['draw']} draws, {data.effective_draws:.0f} of them independent"]
    lines += [f"left out: {text}" for text in data.left_out.values]
    if data.rhat > CONVERGED:
        lines.append(f"warning: the draws have not converged: R-hat is {data.rhat:.2f}, above "
                     f"{CONVERGED}; use more --steps")
    return lines


def main(argv) -> int:
    from . import population

    options = Arguments("population").parse_args(argv)
    chosen = prior(options.prior)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        data = population(
            options.catalogue or None, kind=options.kind, prior=chosen, hardness=options.hardness,
            smallest_slip=options.smallest_slip, smallest_moment=options.smallest_moment,
            velocity_error=options.velocity_error, size_error=options.size_error,
            p_wave_speed=options.p_wave_speed, poisson_ratio=options.poisson_ratio,
            shear_modulus=options.shear_modulus, steps=options.steps, seed=options.seed,
            output=options.output, columns=options.columns,
            progress=lambda done, all_steps: progress(options, f"{done} of {all_steps} steps"))
    progress(options, "")
    if options.json:
        print(json.dumps({"parameters": summary(data), "events": data.name.values.tolist(),
                          "left_out": data.left_out.values.tolist(), "file": options.output,
                          "rhat": data.rhat, "effective_draws": data.effective_draws,
                          "wall_seconds": data.wall_seconds}))
        return 0
    put(parameters_of(data))
    if not options.quiet:
        put("\n".join(notes(data)))
        if options.output:
            put(f"written to {options.output}")
    return 0
