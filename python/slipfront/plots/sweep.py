"""Draws a number of a sweep against its axes."""

import numpy
from matplotlib.colors import LogNorm

from .space_time import colours
from .style import Picture, label, plain_numbers, scaled, styled

#: Number of a sweep to draw by default; if it has none, its first.
PREFERRED = "slip_velocity_at_origin"


def axis_label(coordinate) -> str:
    """Returns the label of an axis of a sweep: its key in words, and its unit."""
    return label(coordinate, str(coordinate.name).replace("_", " "))


def variable_of(data, variable: str = "") -> str:
    """Returns the number to draw: `variable`, or the default. Raises ValueError."""
    numbers = [str(name) for name, values in data.data_vars.items() if values.dtype.kind in "fiu"]
    variable = variable or next((name for name in (PREFERRED, *numbers) if name in numbers), "")
    if variable not in numbers:
        raise ValueError(f"variable = '{variable}': not a number of this sweep; allowed: "
                         f"{', '.join(numbers)}")
    return variable


def has_equal_ratios(values) -> bool:
    """Returns whether three or more values have equal ratios and span more than a factor 3."""
    if values.size < 3 or values.min() <= 0 or values.max() <= 3 * values.min():
        return False
    ratios = values[1:] / values[:-1]
    return bool(numpy.allclose(ratios, ratios[0], rtol=1e-6))


def spans_many(values) -> bool:
    """Returns whether known numbers are positive and span more than three decades."""
    known = values[numpy.isfinite(values)]
    return bool(known.size and known.min() > 0 and known.max() > 1e3 * known.min())


def value_scale(values) -> dict:
    known = values[numpy.isfinite(values)]
    return {"norm": LogNorm(known.min(), known.max())} if spans_many(values) else colours(values)


def edges(values):
    """Returns the edges of the cells of a map around these values, which increase."""
    logarithmic = has_equal_ratios(values)
    at = numpy.log(values) if logarithmic else values.astype(float)
    middle = (at[1:] + at[:-1]) / 2
    all_edges = numpy.concatenate([[2 * at[0] - middle[0]], middle, [2 * at[-1] - middle[-1]]])
    return numpy.exp(all_edges) if logarithmic else all_edges


def scale_of(coordinate) -> str:
    """Returns "log" if the values of an axis have equal ratios, and otherwise "linear"."""
    return ("log" if coordinate.dtype.kind in "fiu" and has_equal_ratios(coordinate.values)
            else "linear")


@styled
def sweep(data, variable: str = "") -> Picture:
    """Draws a number of a sweep: lines for one swept dimension, and a map for two.

    Dimensions of length 1 do not count. An axis whose values have equal ratios is logarithmic, and
    so is the scale of a number that is positive and spans more than three decades. Points that
    failed are gaps in a line, and grey in a map; the title counts them. An axis of texts, such as
    friction.closure, gives one line for each of them.

    Parameters
    ----------
    data : xarray.Dataset
        Result of `slipfront.sweep`. Select values of further dimensions with `.sel`.
    variable : str, optional
        Name of the number. By default slip_velocity_at_origin, or else the first that the sweep
        has.

    Raises
    ------
    ValueError if the Dataset has no such number, or if more than two dimensions are swept.

    Examples
    --------
    >>> data = slipfront.sweep(slipfront.cases / "step.toml", {"initial.stress_left": [0.8, 0.9]})
    >>> figure = slipfront.plots.sweep(data, "slip_at_origin")
    >>> figure.axes[0].get_xlabel()
    'initial stress left, μA/π'
    """
    values = data[variable_of(data, variable)].squeeze()
    if not 1 <= values.ndim <= 2:
        raise ValueError(f"the sweep has {values.ndim} dimensions of two or more values; allowed: "
                         "1 or 2; select values of the others with .sel")
    texts = [dim for dim in values.dims if values[dim].dtype.kind not in "fiu"]
    figure = Picture(figsize=(6.0, 4.0))
    axes = figure.subplots()
    if values.ndim == 1 or texts:
        lines(axes, values.transpose(*texts[:1], ...))
        if spans_many(values.values):
            axes.set(yscale="log", ylabel=label(values))
        else:
            scaled(axes.yaxis, values, label(values), values.values)
    else:
        values = values.sortby(list(values.dims))
        up, across = (values[dim] for dim in values.dims)
        image = axes.pcolormesh(edges(across.values), edges(up.values),
                                numpy.ma.masked_invalid(values.values), rasterized=True,
                                **value_scale(values.values))
        axes.set_facecolor("0.75")
        axes.grid(False)
        axes.set(xlabel=axis_label(across), ylabel=axis_label(up), xscale=scale_of(across),
                 yscale=scale_of(up))
        for axis in (axes.xaxis, axes.yaxis):
            if axis.get_scale() == "log":
                plain_numbers(axis)
        figure.colorbar(image, ax=axes, label=label(values))
    failed = int(numpy.isnan(values.values.astype(float)).sum())
    if failed:
        axes.set_title(f"{'gaps' if axes.lines else 'grey'}: {failed} of {values.size} runs "
                       "without this number", fontsize="small", color="0.3")
    return figure


def lines(axes, values) -> None:
    """Draws lines over the last dimension, one for each value of the first of two."""
    across = values[values.dims[-1]]
    if across.dtype.kind in "fiu":
        values = values.sortby(across.name)
        across = values[across.name]
    positions = [str(text)
                 for text in across.values] if across.dtype.kind not in "fiu" else across.values
    for row in numpy.atleast_2d(values.values):
        axes.plot(positions, row, marker="o" if values.sizes[across.name] < 30 else None,
                  linestyle="-", markersize=4)
    if values.ndim == 2:
        axes.legend([str(text) for text in values[values.dims[0]].values],
                    title=axis_label(values[values.dims[0]]))
    axes.set_xlabel(axis_label(across))
    if scale_of(across) == "log":
        axes.set_xscale("log")
        plain_numbers(axes.xaxis)
