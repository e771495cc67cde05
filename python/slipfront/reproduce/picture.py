"""A figure of the reproduction, with its caption and its data."""

import dataclasses
import functools
import pathlib
import tomllib

import xarray
from matplotlib.figure import Figure

CAPTIONS = pathlib.Path(__file__).with_name("captions.toml")


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
