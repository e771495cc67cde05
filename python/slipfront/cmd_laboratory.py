"""The command slipfront laboratory: hardness over modulus from fronts."""

import json
import sys

from ._arguments import Arguments, put
from ._messages import DONE, INPUT, complain
from ._messages import shown
from ._table import table

#: Titles of the table for the terminal, the variable in units of the model, and in SI units.
COLUMNS = (("tau / sigma_N", "stress_ratio"), ("V", "front_velocity"),
           ("predicted", "predicted_front_velocity"), ("deviation", "deviation"))


#: Characters of a name in the table.
WIDEST = 40


def interval(text):
    """Returns two numbers of an option LOW:HIGH."""
    low, colon, high = text.partition(":")
    try:
        return float(low), float(high if colon else "none")
    except ValueError:
        raise ValueError(f"'{text}': not a range; allowed: LOW:HIGH, such as 0.01:1") from None


def arguments(argv):
    options = Arguments("laboratory").parse_args(argv)
    ending = ".csv" if options.events else ".nc"
    if options.output and not options.output.endswith(ending):
        raise ValueError(f"-o {options.output}: unsupported file type; "
                         f"allowed: a name that ends in {ending}")
    if not options.events and (options.load_point or options.least_drop):
        option = "--load-point" if options.load_point else "--least-drop"
        raise ValueError(f"{option}: not without --events; "
                         "allowed: with the record of an experiment")
    for option in ("prior", "scatter_prior"):
        try:
            setattr(options, option, interval(getattr(options, option)))
        except ValueError as error:
            raise ValueError(f"--{option.replace('_', '-')} {error}") from None
    return options


def known(value):
    """Returns a value as JSON has it: None for NaN."""
    if isinstance(value, list):
        return [known(one) for one in value]
    return None if value != value else value


def lines(data, name):
    return [line for line in data.attrs[name].split("\n") if line]


def velocity_scale(data, si):
    return data.attrs["c_m_s"] if si else 1.0


def as_json(data, file, si):
    fronts: list[dict] = [{} for _ in range(data.sizes["front"])]
    found = {"file": file, **{name: data.attrs[name] for name in ("c_m_s", "fronts_left_out")}}
    for name, variable in data.data_vars.items():
        values = (variable.values * velocity_scale(data, si)
                  if variable.attrs.get("dimensional_unit") == "c" else variable.values)
        if not set(variable.dims) - {"bound"}:
            found[name] = known(values.tolist())
        elif variable.dims[0] == "front":
            for front, value in zip(fronts, values.tolist()):
                front[name] = known(value)
    return {**found, "warnings": lines(data, "warnings"), "velocity_unit": "m/s" if si else "c",
            "fronts": fronts, "errors": lines(data, "errors"),
            "ignored_columns": list(filter(None, data.attrs["ignored_columns"].split(", ")))}


def with_interval(data, name, scale=1.0):
    low, high = scale * data[f"{name}_interval"].values
    return f"{scale * float(data[name]):.4g} ({low:.4g} to {high:.4g})"


def summary(data, si):
    yield f"hardness over modulus  {with_interval(data, 'hardness_over_modulus')}"
    if "hardness" in data:
        yield (f"hardness               {with_interval(data, 'hardness', 1 if si else 1e-9)} "
               f"{'Pa' if si else 'GPa'}")
    if "hardness_over_modulus_from_velocity" in data:
        yield f"  without stress drop  {with_interval(data, 'hardness_over_modulus_from_velocity')}"
    yield f"scatter of ln(h)       {with_interval(data, 'scatter')}"
    yield (f"fronts used            {int(data['included'].sum())} of {data.sizes['front']}, c = "
           f"{data.attrs['c_m_s']:.4g} m/s")


def rows(data, si):
    unit = "m/s" if si else "c"
    cells = [["front", "", *(shown(name, WIDEST) for name in data["name"].values)]]
    for title, name in COLUMNS:
        is_velocity = data[name].attrs.get("dimensional_unit") == "c"
        values = data[name].values * (velocity_scale(data, si) if is_velocity else 1)
        cells.append([title, unit if is_velocity else "",
                      *("-" if value != value else f"{value:.3g}" for value in values)])
    return table(cells, left=1)


def report(data, options):
    """Prints the results in the form that the options choose."""
    if options.json:
        print(json.dumps(as_json(data, options.output, options.si)))
        return
    put("\n".join([rows(data, options.si), "", *summary(data, options.si)]))
    if options.quiet:
        return
    for name, reason in zip(data["name"].values, data["reason"].values):
        if reason:
            put(f"left out: {name}: {reason}")
    for warning in lines(data, "warnings"):
        put(f"note: {warning}")
    if data.attrs["ignored_columns"]:
        put("ignored columns: "
            f"{', '.join(shown(title) for title in data.attrs['ignored_columns'].split(', '))}")
    if options.output:
        put(f"written to {options.output}")


def report_events(options):
    """Finds the events of a record, and prints or writes them."""
    from ._files import write_text
    from ._laboratory_events import cells_of, csv_of, laboratory_events

    data = laboratory_events(options.table, columns=options.columns,
                             normal_stress=options.normal_stress, least_drop=options.least_drop,
                             load_point=options.load_point)
    titles, cells = cells_of(data)
    if options.output:
        write_text(options.output, csv_of(data))
    if options.json:
        rows = zip(*(variable.values for variable in data.data_vars.values()))
        found = [{name: known(float(value)) for name, value in zip(data.data_vars, row)}
                 for row in rows]
        about = {name: data.attrs[name] for name in ("least_drop_pa", "displacement_is")}
        print(json.dumps({"file": options.output, **about, "warnings": lines(data, "warnings"),
                          "events": found}))
        return
    heads = [(title.partition(" [")[0], title.partition(" [")[2].rstrip("]")) for title in titles]
    columns = [["event", "", *(str(number) for number in data["event"].values)]]
    columns += [[name, unit, *(row[i] or "-" for row in cells)]
                for i, (name, unit) in enumerate(heads)]
    put("\n".join([table(columns), "", f"events    {len(cells)}, with drops of "
                   f"{data.attrs['least_drop_pa'] / 1e6:.3g} MPa and more"]))
    if not options.quiet:
        for warning in lines(data, "warnings"):
            put(f"note: {warning}")
        if options.output:
            put(f"written to {options.output}: fill in front_velocity to use it with "
                "slipfront laboratory")


def main(argv) -> int:
    options = arguments(argv)
    if options.events:
        report_events(options)
        return DONE
    from . import laboratory

    data = laboratory(options.table, poisson_ratio=options.poisson_ratio,
                      shear_modulus=options.shear_modulus, density=options.density,
                      p_wave_speed=options.p_wave_speed, s_wave_speed=options.s_wave_speed,
                      prior=options.prior, scatter_prior=options.scatter_prior, draws=options.draws,
                      seed=options.seed, strict=options.strict, output=options.output,
                      columns=options.columns, normal_stress=options.normal_stress)
    report(data, options)
    sys.stdout.flush()
    errors = lines(data, "errors")
    for line in errors:
        complain(line)
    return INPUT if errors else DONE
