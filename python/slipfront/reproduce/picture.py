"""What a figure of the reproduction is."""

import dataclasses

import xarray
from matplotlib.figure import Figure


@dataclasses.dataclass
class Picture:
    """A figure, what it says, and the numbers drawn in it."""

    name: str  #: of its files, without ending
    title: str
    caption: str  #: plain text: what is drawn, from which input, what differs from the paper
    figure: Figure
    data: xarray.Dataset
