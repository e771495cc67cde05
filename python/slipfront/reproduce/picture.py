"""What a figure of the reproduction is."""

import dataclasses
import functools
import pathlib
import tomllib

import xarray
from matplotlib.figure import Figure

CAPTIONS = pathlib.Path(__file__).with_name("captions.toml")


@dataclasses.dataclass
class Picture:
    """A figure, what it says, and the numbers drawn in it."""

    name: str  #: of its files, without ending, and in captions.toml
    title: str
    caption: str
    figure: Figure
    data: xarray.Dataset
    command: str = ""  #: what computes it again
    printed: list = dataclasses.field(default_factory=list)  #: (what, printed, computed) that the paper reads off it


@functools.cache
def captions() -> dict:
    """Name of a picture -> {"title", "text", "command"}, with braces in the text where facts go."""
    return tomllib.loads(CAPTIONS.read_text(encoding="utf-8"))


def picture(name, figure, data, printed=(), **facts) -> Picture:
    """A figure with its words. printed: what the paper reads off it. facts: what the words quote."""
    words = captions()[name]
    return Picture(name, words["title"].format(**facts), words["text"].format(**facts), figure, data, words["command"].format(**facts), list(printed))
