"""Table of the paper's statements, with verdict, finding, range of parameters and command."""

from . import on_fronts, on_model, on_slip


def table(runs, found, paper, stress) -> list:
    """Returns the rows. found: the result of pipeline.computed. stress: the data of Fig. 9."""
    return [*on_fronts.table(runs), *on_slip.table(runs, found, stress), *on_model.table(runs, found, paper)]
