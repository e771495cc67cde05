"""What the paper says in words, and what is found: verdict first, then the number, the range tried, the command."""

from . import on_fronts, on_model, on_slip


def table(runs, found, paper, stress) -> list:
    """The rows. found: of pipeline.computed. stress: the data of Fig. 9."""
    return [*on_fronts.table(runs), *on_slip.table(runs, found, stress), *on_model.table(runs, found, paper)]
