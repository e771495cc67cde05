"""All of the reproduction, in order."""

import numpy

import slipfront

from .._files import write_text
from . import formulas, laws, numbers, outputs, pulses, report, statements, states, sweeps, widths
from .runs import Runs


def reproduce(folder, threads, tell, seconds) -> dict:
    """Computes all and writes it into a folder that is there. Returns the tables: numbers, formulas, statements.

    tell: called with a text as the work goes on. seconds: called for the time spent so far.
    """
    paper = numbers.printed()
    runs = Runs(threads, tell)
    printed = {c: float(next(n["printed"] for n in paper["number"] if n["key"] == f"fig_8_factor_{c}")) for c in paper["inputs"]["friction"][1:]}
    factors = widths.factors(runs, paper)
    width = widths.nearest(factors, printed)
    values = numbers.computed(runs, paper, factors, width)
    slip, (small_drop, drops) = sweeps.slip(runs, paper), pulses.small_drop(runs)
    fronts = sweeps.fronts(runs, paper, laws.laws())
    weak, middle, strong = paper["inputs"]["friction"]
    seventh, ninth = pulses.weak_and_strong(runs, weak, strong)
    pictures = [states.contact(), states.dislocation(), states.initial(runs), laws.pulse(), laws.rupture(values), laws.slip(values),
                seventh, pulses.scaled(runs, [weak, middle, strong], width), widths.pictured(factors, printed, width), ninth, slip, small_drop, fronts]
    tables = {"numbers": numbers.table(paper, values), "formulas": formulas.table(paper),
              "statements": statements.table(slip.data, fronts.data, drops, slipfront.relations(stress=numpy.asarray(fronts.data["stress"])))}
    for picture in pictures:
        tell(f"writing {picture.name}")
        outputs.write_picture(folder, picture)
    for name, rows in tables.items():
        outputs.write_rows(folder / f"{name}.csv", rows)
    about = {"version": slipfront.__version__, "seconds": seconds(), "pulses": len(runs.done) + runs.swept}
    page = report.page(folder, pictures, tables, about)
    write_text(folder / "report.html", page)
    return tables
