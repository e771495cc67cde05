"""The command slipfront fronts, which finds the fronts of a run."""

import csv
import json
import sys

from ._arguments import Arguments, chosen_units, put
from ._table import table

#: Titles of the table for the terminal, the variable of each, and its name for the unit.
COLUMNS = (("event", "front_event"), ("begin", "front_begin"), ("end", "front_end"),
           ("onset", "front_onset"), ("V", "front_velocity"),
           ("tau / sigma_N", "front_stress_ratio"), ("class", "front_kind"),
           ("ends at", "front_stop"))


def arguments(argv):
    options = Arguments("fronts").parse_args(argv)
    if (options.run is None) == (options.arrivals is None):
        raise ValueError("RUN.nc: either a run or a table of arrivals is needed; "
                         "allowed: RUN.nc, or --arrivals TABLE")
    if options.columns and not options.arrivals:
        raise ValueError("--columns: not for a run; allowed: with --arrivals")
    for option in ("output", "threshold", "dimensionless"):
        if options.arrivals and getattr(options, option):
            raise ValueError(f"--{option}: not allowed with --arrivals; allowed: --csv or --json")
    if options.csv and (options.json or options.output):
        raise ValueError("--csv: not allowed with --json or -o")
    return options


def known(value):
    """Returns a value as JSON has it: None for what is not finite."""
    return None if isinstance(value, float) and not abs(value) < float("inf") else value


def as_json(data, file):
    def rows(dimension):
        found: list[dict] = [{} for _ in range(data.sizes[dimension])]
        for name, variable in data.data_vars.items():
            if variable.dims == (dimension,):
                for row, value in zip(found, variable.values.tolist()):
                    row[name] = known(value)
        return found

    velocity = data["front_velocity"]
    return {"file": file, **{name: data.attrs[name] for name in ("rayleigh_speed", "tau")},
            "velocity_unit": velocity.attrs.get("dimensional_unit") or "m/s",
            "fronts": rows("front"), "events": rows("event")}


def cell(value):
    if isinstance(value, str):
        return value
    return "-" if value != value else f"{value:.4g}"


def rows(data):
    cells = []
    for title, name in COLUMNS:
        attributes = data[name].attrs
        unit = attributes.get("dimensional_unit") or attributes.get("units", "")
        cells.append([title, "" if unit == "1" else unit.replace("m s-1", "m/s"),
                      *(cell(value) for value in data[name].values.tolist())])
    return table(cells)


def write_csv(data, stream):
    """Writes fronts for slipfront laboratory. Raises ValueError if a constant is missing."""
    missing = [name for attribute, name in (("normal_stress_pa", "friction.normal_stress"),
                                            ("tau_unit_pa", "[medium]"), ("c_m_s", "[medium]"))
               if attribute not in data.attrs]
    if missing:
        raise ValueError("--csv: SI units need constants that the scenario does not give; "
                         f"allowed: a scenario with {' and '.join(dict.fromkeys(missing))}")
    normal, speed = (data.attrs[name] for name in ("normal_stress_pa", "c_m_s"))
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["name", "tau [MPa]", "normal_stress [MPa]", "front_velocity [m/s]", "class"])
    for i, (event, velocity, ratio, kind) in enumerate(
            zip(*(data[name].values.tolist() for name in ("front_event", "front_velocity",
                                                          "front_stress_ratio", "front_kind"))), 1):
        if abs(velocity) < float("inf"):
            writer.writerow([f"event {event} front {i}", f"{ratio * normal / 1e6:.6g}",
                             f"{normal / 1e6:.6g}", f"{velocity * speed:.6g}", kind])


def summary(data):
    counts = {kind: int((data["front_kind"] == kind).sum())
              for kind in dict.fromkeys(data["front_kind"].values.tolist())}
    yield f"fronts    {data.sizes['front']}: " + ", ".join(f"{count} {kind}"
                                                           for kind, count in counts.items())
    yield (f"events    {data.sizes['event']}, of which {int(data['event_crosses'].sum())} cross "
           "the whole block")
    yield (f"Rayleigh  {data.attrs['rayleigh_speed']:.4g} c"
           + (f" = {data.attrs['rayleigh_speed'] * data.attrs['c_m_s']:.4g} m/s"
              if "c_m_s" in data.attrs else ""))


def report_arrivals(options):
    """Prints the velocities from arrival times."""
    from ._arrivals import arrivals, csv_of_arrivals

    data = arrivals(options.arrivals, columns=options.columns)
    notes = [line for line in data.attrs["warnings"].split("\n") if line]
    cells = {name: data[name].values.tolist() for name in data.data_vars}
    if options.csv:
        sys.stdout.write(csv_of_arrivals(data))
    elif options.json:
        found = [dict(zip(cells, row)) for row in zip(*cells.values())]
        for front in found:
            front.update(velocity=known(front["velocity"]),
                         velocity_interval=[known(end) for end in front["velocity_interval"]])
        print(json.dumps({"file": options.arrivals, "fronts": found, "warnings": notes}))
    else:
        low, high = zip(*cells["velocity_interval"])
        columns = (("event", "", cells["event"]), ("begin", "m", cells["front_begin"]),
                   ("end", "m", cells["front_end"]), ("V", "m/s", cells["velocity"]),
                   ("5 %", "m/s", low), ("95 %", "m/s", high))
        put(table([[title, unit, *map(cell, values)] for title, unit, values in columns]))
        if not options.quiet:
            for note in notes:
                put(f"note: {note}")


def main(argv) -> int:
    options = arguments(argv)
    if options.arrivals:
        report_arrivals(options)
        return 0
    from . import fronts

    data = fronts(options.run, threshold=options.threshold, slow=options.slow,
                  output=options.output, si=False if options.csv else chosen_units(options))
    if options.csv:
        write_csv(data, sys.stdout)
        return 0
    if options.json:
        print(json.dumps(as_json(data, options.output)))
        return 0
    put("\n".join([rows(data), "", *summary(data)]))
    if options.output and not options.quiet:
        put(f"written to {options.output}")
    return 0
