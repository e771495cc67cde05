"""Runs the steps of the reproduction in order."""

from typing import Any

import slipfront

from .._files import write_text
from . import (closed_form, formulas, levels, numbers, outputs, profiles, ratios, report,
               schematics, statements, surfaces, sweeps, widths)
from .runs import Runs


def pictures_of(runs, paper, found) -> list:
    """Returns all figures. found: the result of `computed`."""
    values, given = found["values"], numbers.taken(paper)
    factors = {c: given[f"fig_8_factor_{c}"] for c in numbers.FRICTION[1:]}
    return [schematics.contact(), schematics.sliding(), schematics.initial(runs),
            closed_form.ratio(values), closed_form.rupture(values, given),
            closed_form.slip(values, given), surfaces.with_friction(runs),
            profiles.scaled(runs, found["width"], found["ratio"].attrs["width"]),
            widths.pictured(found["factors"], factors, found["width"]), profiles.stress(runs),
            sweeps.friction(found["curves"], found["ratio"]), surfaces.with_right_stress(runs),
            sweeps.against_drop(found["drops"])]


def computed(runs, paper) -> dict:
    """Returns what tables and figures use: numbers, sweeps, best widths of the profile."""
    given = numbers.taken(paper)
    found: dict[str, Any] = {"factors": widths.factors(runs), "curves": sweeps.ratios(runs),
                             "ratio": ratios.ratios(runs, sweeps.READ), "drops": sweeps.drops(runs)}
    found["width"] = widths.nearest(found["factors"],
                                    {c: given[f"fig_8_factor_{c}"] for c in numbers.FRICTION[1:]})
    found["values"] = numbers.computed(paper, found["factors"], found["width"], found["ratio"],
                                       found["curves"])
    return found


def reproduce(folder, threads, tell, seconds) -> dict:
    """Computes everything and writes it into an existing folder. Returns the tables: numbers,
    formulas, statements, inputs.

    `tell`: function that is called with a text to report progress. `seconds`: function that returns
    the time spent so far.
    """
    paper = numbers.printed()
    runs = Runs(threads, tell)
    found = computed(runs, paper)
    pictures = pictures_of(runs, paper, found)
    tables = {"numbers": numbers.table(paper, found["values"]), "formulas": formulas.table(paper),
              "statements": statements.table(runs, found, paper,
                                             next(picture.data for picture in pictures
                                                  if picture.name == "fig-09")),
              "inputs": [{"what": row["what"], "where": row["where"], "printed": row["printed"]}
                         for row in paper["input"]]}
    for picture in pictures:
        tell(f"writing {picture.name}")
        outputs.write_picture(folder, picture)
    for name, rows in tables.items():
        outputs.write_rows(folder / f"{name}.csv", rows)
    tell("closed form, pulse and chain")
    about = {"levels": levels.table(threads), "version": slipfront.__version__,
             "seconds": seconds(), "pulses": len(runs.done) + runs.swept}
    page = report.page(folder, pictures, tables, about)
    write_text(folder / "report.html", page)
    return tables
