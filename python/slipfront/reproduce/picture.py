"""A figure of the reproduction, with its caption and its data."""

import dataclasses
import functools
import pathlib
import tomllib

import xarray
from matplotlib.figure import Figure

from .._dataset import about

CAPTIONS = pathlib.Path(__file__).with_name("captions.toml")

#: Line styles and colours of the three curves of Figs. 8-10: solid, dashed dotted.
CURVES = (("-", "C0"), ("--", "C1"), (":", "C2"))

#: Colours of the values that the paper reads off: red for Parkfield, green for the ETS event.
RED, GREEN = "#c1272d", "#00843d"

#: Markers of the chain, and of the values that the paper prints.
CHAIN = {"marker": "o", "markersize": 3.2, "color": "black", "markerfacecolor": "white",
         "linestyle": "none"}
PRINTED = {"marker": "x", "markersize": 6, "color": RED, "linestyle": "none",
           "markeredgewidth": 1.6}

#: Titles of the columns of a figure with friction.
TITLES = {"paper": "closure “paper”", "consistent": "closure “consistent”"}

FRICTION = about("friction coefficient C")
STRESS = about("initial stress Sigma-", "mu A / pi")
STRESS_RIGHT = about("stress on the right Sigma+", "mu A / pi")
SLIP_VELOCITY = about("slip velocity W at x = 0, t = 2 pi", "c A / pi")


@dataclasses.dataclass
class Picture:
    """A figure, its texts, and the numbers drawn in it."""

    name: str  #: name of its files without the ending, and its key in captions.toml
    title: str
    caption: str
    figure: Figure
    data: xarray.Dataset
    command: str = ""  #: command that computes the data again
    # : (quantity, printed, computed) of each value that the paper reads off the figure
    printed: list = dataclasses.field(default_factory=list)


@functools.cache
def captions() -> dict:
    """Returns {picture: {"title", "text", "command"}}. Texts quote values in braces."""
    return tomllib.loads(CAPTIONS.read_text(encoding="utf-8"))


def picture(name, figure, data, printed=(), **facts) -> Picture:
    """Returns a figure with its texts. printed: readings. facts: values that texts quote."""
    words = captions()[name]
    return Picture(name, words["title"].format(**facts), words["text"].format(**facts), figure,
                   data, words["command"].format(**facts), list(printed))
