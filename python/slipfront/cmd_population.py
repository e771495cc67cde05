"""The command slipfront population, a hierarchical model of many events."""

import json
import warnings

from ._arguments import Arguments, add_columns, netcdf_name, progress, put
from ._population.priors import NAMES, PARAMETERS
from ._table import table

#: Largest R-hat of a sample that has converged.
CONVERGED = 1.05


def arguments(argv):
    """Returns the options of the command line."""
    parser = Arguments("population", "Infers what the events of a catalogue have in common, as "
                       "slipfront.population does in Python: stress, effective normal stress and "
                       "friction, and how much they scatter. Each event needs a duration, a "
                       "rupture velocity or a length, and a slip or a moment with a width. "
                       "docs/population.md has the model and its priors.",
                       ["slipfront population CATALOGUE.csv -o pop.nc", "slipfront population "
                        "--kind earthquake", "slipfront population CATALOGUE.csv --smallest-moment "
                        "1e18 --prior friction_median=1e-3,20 --json"])
    parser.add_argument("catalogue", metavar="CATALOGUE", nargs="*", help="files of events as for "
                        "slipfront event (default: the catalogue that comes with slipfront)")
    parser.add_argument("-o", "--output", metavar="OUT.nc", type=netcdf_name,
                        help="NetCDF file to write, with all draws")
    parser.add_argument("--kind", metavar="KIND",
                        help="use only events of this kind, such as earthquake")
    parser.add_argument("--prior", metavar="NAME=MEDIAN,FACTOR", action="append", default=[],
                        help="lognormal prior of a parameter, one standard deviation a factor; "
                        "repeatable")
    parser.add_argument("--hardness", metavar="STRESS", default="10 GPa",
                        help="penetration hardness: normal stress is contact ratio times hardness "
                        "(default: 10 GPa)")
    parser.add_argument("--smallest-slip", metavar="LENGTH", help="detection limit: the catalogue "
                        "lacks all events with less slip, such as '1 mm'")
    parser.add_argument("--smallest-moment", metavar="MOMENT", help="detection limit: the "
                        "catalogue lacks all events with a smaller moment, in N m")
    parser.add_argument("--velocity-error", metavar="FACTOR", type=float, default=1.2,
                        help="one standard deviation of velocities without an error (default: 1.2)")
    parser.add_argument("--size-error", metavar="FACTOR", type=float, default=1.5, help="one "
                        "standard deviation of slips and moments without an error (default: 1.5)")
    for name, example in (("p-wave-speed", "6 km/s"), ("poisson-ratio", "0.3"),
                          ("shear-modulus", "30 GPa")):
        parser.add_argument(f"--{name}", metavar="VALUE", help="constant of the rock for events "
                            f"that give none (default: {example})")
    add_columns(parser)
    parser.add_argument("--steps", metavar="N", type=int, default=400,
                        help="steps of each of the 40 walkers (default: 400)")
    parser.add_argument("--seed", metavar="N", type=int, default=1,
                        help="seed of the draws (default: 1)")
    options = parser.parse_args(argv)
    return options


def prior(texts):
    """Returns {name: (median, factor)} of the options --prior."""
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
    """Returns {parameter: {quantile: value}}."""
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
    """Runs the model and returns the exit code."""
    from . import population

    options = arguments(argv)
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
