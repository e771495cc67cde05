"""The command slipfront reproduce: the paper's figures, numbers and statements as a page."""

import collections
import itertools
import json
import pathlib
import textwrap
import time
import warnings

from ._arguments import Arguments, progress, put
from ._optional import import_optional
from ._table import width


def table(rows) -> str:
    """Returns the table of numbers. On a narrow terminal its texts take several lines."""
    cells = [("the paper prints", f"{'printed':>11} {'rounded':>9} {'computed':>10}", "verdict")]
    cells += [(row["what"], f"{row['printed']:>11} {row['printed_digits']:>9} "
               f"{row['computed']:>10.4g}", row["verdict"]) for row in rows]
    longest, numbers = 70, 1 + len(cells[0][1]) + 2
    whole = longest + numbers + max(len(verdict) for _, _, verdict in cells)
    most = width() or whole
    if most >= whole:
        return "\n".join(f"{what[:longest]:<{longest}} {values}  {verdict}"
                         for what, values, verdict in cells)
    for_texts = max(most - numbers, 30)
    described = for_texts * 3 // 5
    lines = []
    for what, values, verdict in cells:
        parts = itertools.zip_longest(textwrap.wrap(what, described), [values],
                                      textwrap.wrap(verdict, for_texts - described), fillvalue="")
        lines += [f"{a:<{described}} {b:<{numbers - 3}}  {c}".rstrip() for a, b, c in parts]
    return "\n".join(lines)


def summary(tables) -> str:
    def counted(name):
        counts = collections.Counter(row["verdict"] for row in tables[name]).most_common()
        return f"{name}: {', '.join(f'{count} {verdict}' for verdict, count in counts)}"

    return f"{counted('numbers')}\n{counted('statements')}"


def main(argv) -> int:
    options = Arguments("reproduce").parse_args(argv)
    for module in ("numpy", "xarray", "matplotlib", "netCDF4", "pandas"):
        import_optional(module)
    from .reproduce import outputs, pipeline

    warnings.filterwarnings("ignore", "initial stress between 0 and")  # the far end of a tanh
    # The paper's steps into a stressed side: docs/pulse.md
    warnings.filterwarnings("ignore", "pulse: dislocations overtake")
    # Its points are means over many dislocations
    warnings.filterwarnings("ignore", "chain: .* dislocations at scale")
    started = time.monotonic()
    with outputs.whole_folder(options.output) as folder:
        tables = pipeline.reproduce(folder, options.threads, lambda text: progress(options, text),
                                    lambda: time.monotonic() - started)
    progress(options, "")
    report = str(pathlib.Path(options.output) / "report.html")
    if options.json:
        print(json.dumps(tables | {"report": report, "wall_seconds": time.monotonic() - started}))
        return 0
    print(table(tables["numbers"]))
    put("\n" + summary(tables))
    put(f"remarks, figures and data: {report}")
    return 0
