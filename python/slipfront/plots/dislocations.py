"""Computes the positions of the dislocations of an averaged field."""

import numpy


def positions(pulse, scale: float) -> numpy.ndarray:
    """Returns the position x (b / A) of each dislocation at each time of a pulse.

    pulse: Dataset with k over time and x (cell averages) and with x_bounds. Its left end must be at
    rest, because dislocations are counted from there. scale > 0: factor by which the density of the
    dislocations is multiplied.

    The result is an array over time and dislocation, ascending in x. Dislocation j is at the x that
    has j + 1/2 dislocations on its left. The number of dislocations is that at the first time. A
    dislocation that has left the domain is NaN.
    """
    bounds = pulse["x_bounds"].values
    edges = numpy.append(bounds[:, 0], bounds[-1, 1])
    # A cell that is NaN or negative has no dislocations
    density = numpy.fmax(pulse["k"].transpose("time", "x").values, 0)
    held = numpy.cumsum(density * numpy.diff(edges), axis=1) * scale / (2 * numpy.pi)
    held = numpy.concatenate((numpy.zeros((len(held), 1)), held), axis=1)
    wanted = numpy.arange(0.5, held[0, -1])
    # The count is constant across cells without dislocations. numpy.interp then takes their last
    # edge.
    return numpy.array([numpy.interp(wanted, row, edges, right=numpy.nan) for row in held])
