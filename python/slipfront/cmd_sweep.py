"""The command slipfront sweep, which runs a scenario at every point of a grid of settings."""

import csv
import itertools
import json
import os
import sys
import warnings

from . import _slipfront
from ._arguments import Arguments, chosen_units, put
from ._grid import values_of
from ._messages import DONE, NUMERICS, Interruption, complain
from ._messages import shown
from ._slipfront import InputError
from ._table import GAP, table, width

#: Largest number of points in the table for the terminal.
MOST_ROWS = 40

#: Characters of a text in the table, such as a formula.
WIDEST = 40


def arguments(argv):
    options = Arguments("sweep").parse_args(argv)
    if options.json and options.csv:
        raise ValueError("--json and --csv: both are given; allowed: one of them")
    return options


def pairs(option, texts):
    """Returns {key: text} of the options `--vary KEY=VALUES` or `--set KEY=VALUE`."""
    found = {}
    for text in texts:
        key, equals, value = (part.strip() for part in text.partition("="))
        if not key or not equals:
            raise ValueError(f"{option} {text}: no key and value; allowed: KEY=VALUE, such as "
                             "friction.coefficient=0.5")
        if key in found and option == "--vary":
            raise ValueError(f"{option} {text}: {key} is given twice; allowed: once, with all its "
                             "values")
        found[key] = value
    return found


def axes_of(texts):
    """Returns {key: values} of the options --vary."""
    kinds, axes = _slipfront.scenario_keys(), {}
    for key, text in pairs("--vary", texts).items():
        try:
            axes[key] = values_of(text, kinds.get(key, ("number", ""))[0])
        except ValueError as error:
            raise ValueError(f"--vary {key}={text}: {error}") from None
    return axes


def client_of(address):
    """Returns the client of a Dask cluster. Raises OSError if there is none at this address."""
    from ._optional import import_optional

    try:
        return import_optional("distributed").Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise OSError(f"--cluster {address}: no Dask scheduler answers there: {error}") from error


def run(options, axes):
    """Runs the sweep. An error names options instead of the parameters of the function."""
    from . import sweep

    client = client_of(options.cluster) if options.cluster else None
    settings = pairs("--set", options.set)
    try:
        return sweep(options.scenario, axes, variables=options.variables, set=settings,
                     command=options.command, output=options.output, resume=options.resume,
                     client=client, progress=sys.stderr.isatty() and not options.quiet,
                     threads=options.threads, si=chosen_units(options))
    except InputError as error:
        text = str(error)
        if text.startswith("axes: "):
            text = text.replace("axes: ", "--vary: ", 1)
        elif any(text.startswith(f"--set: {key}") for key in axes):
            text = text.replace("--set: ", "--vary: ", 1)
        raise ValueError(text.replace("variables: ", "--variables: ", 1)) from error
    finally:
        if client is not None:
            client.close()


def settings_of(coordinate):
    """Returns the values of an axis as the scenario has them, such as "5 MPa"."""
    unit = coordinate.attrs.get("units", "")
    return [f"{value!r}".removesuffix(".0") + f" {unit}" if unit else value
            for value in coordinate.values.tolist()]


def rows_of(data):
    """Yields a dict for each point: the keys with their values, the numbers, and `failure`."""
    keys = {dim: data[dim].attrs["key"] for dim in data["failure"].dims}
    flat = {name: data[name].values.ravel().tolist() for name in data.data_vars}
    points = itertools.product(*(settings_of(data[dim]) for dim in keys))
    for i, point in enumerate(points):
        yield {**dict(zip(keys.values(), point)),
               **{name: values[i] for name, values in flat.items()}}


def short(value):
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.6g}" if isinstance(value, float) else shown(value, WIDEST)


def width_of(columns):
    return sum(max(map(len, cells)) + GAP for cells in columns) - GAP


def points_of(data, most):
    """Returns a table of the points: axes, and the numbers that fit into `most` characters."""
    rows = list(itertools.islice(rows_of(data), MOST_ROWS))
    numbers = []
    for name in data.data_vars:
        if name != "failure":
            attrs = data[name].attrs
            numbers.append([name, attrs.get("dimensional_unit", attrs["units"]),
                            *("failed" if row["failure"] else short(row[name]) for row in rows)])

    def axes(title):
        keys = {data[dim].attrs["key"]: data[dim].attrs.get("dimensional_unit", "")
                for dim in data["failure"].dims}
        return [[title(key), unit, *(short(row[key]) for row in rows)]
                for key, unit in keys.items()]

    columns = axes(lambda key: key)
    if width_of(columns + numbers[:1]) > most:
        columns = axes(lambda key: key.rpartition(".")[2])
    columns += numbers[:1]
    for cells in numbers[1:]:
        if width_of([*columns, cells]) > most:
            break
        columns.append(cells)
    return table(columns)


def known(value):
    """Returns the value, or None for a NaN and for the empty text of `failure`."""
    return None if value != value or value == "" else value


def report(data, options):
    """Prints the results in the form that the options choose."""
    file = options.output or options.resume
    failed = int((data["failure"] != "").sum())
    if options.json:
        points = [{name: known(value) for name, value in row.items()} for row in rows_of(data)]
        units = {name: data[name].attrs["units"]
                 for name in data.data_vars if data[name].attrs.get("units", "1") != "1"}
        print(json.dumps({"command": options.command, "file": file, "failed": failed,
                          "points": points,
                          **({"unit_system": "SI", "units": units} if units else {})}))
    elif options.csv:
        out = csv.writer(sys.stdout, lineterminator="\n")
        for i, row in enumerate(rows_of(data)):
            if i == 0:
                out.writerow(row)
            out.writerow([known(value) for value in row.values()])
    else:
        put(points_of(data, width() or float("inf")))
        if data["failure"].size > MOST_ROWS and not options.quiet:
            put(f"... and {data['failure'].size - MOST_ROWS} more points; --csv prints all of them")
        if file and not options.quiet:
            put(f"written to {file}")
    return failed


def main(argv) -> int:
    options = arguments(argv)
    axes = axes_of(options.vary)
    file = options.resume or options.output

    def advice():
        if file and os.path.exists(f"{file}.part"):
            return f"; the finished points are in {file}.part: continue with --resume {file}"
        return "; nothing was written (a sweep with -o OUT.nc can be resumed)"

    Interruption.advice = advice
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        data = run(options, axes)
    failed = report(data, options)
    sys.stdout.flush()
    if not options.quiet:
        for warning in seen:
            complain(warning.message)
    return NUMERICS if failed else DONE
