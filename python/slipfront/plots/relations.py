"""Rupture and slip relations: what a stress means in velocities (Eqs. 8-10)."""

import numpy

from .style import Picture, label, plain_numbers, styled


@styled
def relations(states) -> Picture:
    """Rupture and leading velocity (above) and slip velocity at x = 0 (below) against the initial
    stress, on linear and logarithmic axes.

    Parameters
    ----------
    states : xarray.Dataset
        stress, rupture_velocity, leading_velocity and slip_velocity, positive, of one shape and in
        any order: what `slipfront.relations` gives.

    Examples
    --------
    >>> states = slipfront.relations(stress=np.geomspace(0.1, 2, 50))
    >>> figure = slipfront.plots.relations(states)
    >>> [axes.get_yscale() for axes in figure.axes[:2]]
    ['linear', 'log']
    """
    order = numpy.argsort(states["stress"].values.ravel())
    stress = states["stress"].values.ravel()[order]
    figure = Picture(figsize=(7.2, 5.6))
    axes = figure.subplots(2, 2, sharex="col")
    single = "o" if order.size == 1 else None
    for column, scale in enumerate(("linear", "log")):
        for row, names in enumerate((("rupture_velocity", "leading_velocity"), ("slip_velocity",))):
            for name in names:
                short = {"rupture_velocity": "|V−|, trailing edge (fast)",
                         "leading_velocity": "V+, leading edge (slow)"}.get(name)
                axes[row, column].plot(stress, states[name].values.ravel()[order], label=short,
                                       marker=single)
            axes[row, column].set(yscale=scale, xscale=scale if spans_decades(stress) else "linear")
    axes[0, 0].legend(loc="lower right")
    axes[0, 0].set(title="linear", ylabel=label(states["rupture_velocity"], "velocity of an edge"))
    axes[0, 1].set(title="logarithmic")
    axes[1, 0].set(ylabel=label(states["slip_velocity"]))
    for lower in axes[1]:
        lower.set_xlabel(label(states["stress"]))
        if lower.get_xscale() == "log":
            plain_numbers(lower.xaxis)
    return figure


def spans_decades(values) -> bool:
    """Returns whether positive values cover more than a decade, worth a logarithmic axis."""
    return values.max() > 10 * values.min()
