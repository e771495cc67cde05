"""Where the dislocations of an averaged field are."""

import numpy


def positions(pulse, scale: float) -> numpy.ndarray:
    """x (b / A) of each dislocation at each time of a pulse: those that lie scale times as dense as in the file's own units.

    pulse: Dataset with k over time and x (cell averages), and x_bounds; its left end is at rest, from which dislocations are counted. scale > 0.
    Returns an array over time and dislocation, ascending; the j-th is where the field holds j + 1/2 dislocations left of x. The number is that of
    the first time; nan where one has left the domain.
    """
    bounds = pulse["x_bounds"].values
    edges = numpy.append(bounds[:, 0], bounds[-1, 1])
    density = numpy.fmax(pulse["k"].transpose("time", "x").values, 0)  # a bad cell holds none
    held = numpy.cumsum(density * numpy.diff(edges), axis=1) * scale / (2 * numpy.pi)
    held = numpy.concatenate((numpy.zeros((len(held), 1)), held), axis=1)
    wanted = numpy.arange(0.5, held[0, -1])
    # Where nothing lies between two cells the count stands still: the last edge before it counts on.
    return numpy.array([numpy.interp(wanted, row, edges, right=numpy.nan) for row in held])
