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


@functools.cache
def captions() -> dict:
    """Name of a picture -> {"title", "text"}, with braces where facts go."""
    return tomllib.loads(CAPTIONS.read_text(encoding="utf-8"))


def picture(name, figure, data, **facts) -> Picture:
    """A figure with its words. facts: what the words quote."""
    words = captions()[name]
    return Picture(name, words["title"].format(**facts), words["text"].format(**facts), figure, data)
