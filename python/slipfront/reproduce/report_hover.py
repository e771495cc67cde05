"""Collects axes and values of each figure for the script of the page."""

import math
import re

import numpy
from matplotlib.collections import QuadMesh
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

#: Largest numbers of points of a line, of cells of a map in each direction, and of points of a
#: surface in the page.
POINTS = 240
CELLS = 60
SURFACE = 1200


def rounded(values) -> list:
    """Returns numbers rounded to five digits, and None for those that are not finite."""
    return [float(f"{value:.5g}") if math.isfinite(value) else None
            for value in numpy.ravel(values).astype(float)]


def thinned(count: int, most: int) -> numpy.ndarray:
    """Returns at most `most` evenly spread indices below `count`, with both ends."""
    return numpy.unique(numpy.linspace(0, count - 1, min(count, most)).round().astype(int))


def line(drawn) -> dict | None:
    """Returns the name and the points of a line, or None if it has no data."""
    x, y = (numpy.asarray(values, float) for values in drawn.get_data(orig=False))
    if drawn.get_transform() != drawn.axes.transData or x.size < 2:
        return None
    chosen = thinned(x.size, POINTS)
    name = str(drawn.get_label())
    return {"name": "" if name.startswith("_") else plain(name), "x": rounded(x[chosen]),
            "y": rounded(y[chosen])}


def mesh(drawn) -> dict | None:
    """Returns centres and values of a map, thinned, or None if it is not rectangular."""
    corners, values = drawn.get_coordinates(), drawn.get_array()
    across, up = corners[0, :, 0], corners[:, 0, 1]
    if values is None or not (numpy.allclose(corners[..., 0], across)
                              and numpy.allclose(corners[..., 1], up[:, None])):
        return None
    values = numpy.ma.filled(numpy.ma.asarray(values, float), numpy.nan)
    values = values.reshape(len(up) - 1, len(across) - 1)
    rows, columns = thinned(len(up) - 1, CELLS), thinned(len(across) - 1, CELLS)
    middles = [(edges[1:] + edges[:-1]) / 2 for edges in (across, up)]
    return {"x": rounded(middles[0][columns]), "y": rounded(middles[1][rows]),
            "z": rounded(values[numpy.ix_(rows, columns)])}


def surface(drawn, figure) -> dict:
    """Returns points of a surface: position in the picture, and coordinates."""
    # One corner of each facet; matplotlib has no public function for them
    corners = numpy.asarray(drawn._vec)[:3, ::4]
    corners = corners[:, thinned(corners.shape[1], SURFACE)]
    flat = drawn.axes.transData.transform(
        numpy.transpose(proj3d.proj_transform(*corners, drawn.axes.get_proj())[:2]))
    seen = flat / [figure.bbox.width, figure.bbox.height]
    return {"left": rounded(seen[:, 0]), "top": rounded(1 - seen[:, 1]),
            **{name: rounded(values) for name, values in zip("xyz", corners)}}


def in_space(axes, figure) -> list:
    """Returns the surfaces of axes in space, as entries of `axes_of`."""
    names = {name: {"name": plain(getattr(axes, f"get_{name}label")())
                    or {"z": "value"}.get(name, name)} for name in "xyz"}
    about = axes.get_position()
    return [{"box": rounded([about.x0, 1 - about.y1, about.width, about.height]), **names,
             "surface": surface(drawn, figure)}
            for drawn in axes.collections if isinstance(drawn, Poly3DCollection)]


def plain(text) -> str:
    return re.sub(r"[${}\\]", "", str(text)).replace("\n", " ")


def frames(svg) -> list:
    """Returns left, top, width, height of the axes in an SVG, as fractions of the figure."""
    wide, high = (float(number)
                  for number in re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)[0])
    corners = re.findall(r'<g id="axes_\d+">\s*<g id="patch_\d+">\s*<path d="M ([\d.]+) ([\d.]+) '
                         r'\nL ([\d.]+) [\d.]+ \nL [\d.]+ ([\d.]+) ', svg)
    return [(x0 / wide, y0 / high, (x1 - x0) / wide, (y1 - y0) / high)
            for x0, y1, x1, y0 in (map(float, found) for found in corners)]


def axes_of(figure, svg) -> list:
    """Returns the axes of a figure with the data drawn in them.

    Each entry has box (from `frames`), x and y ({"name", "ends", "log"}), lines (from `line`) and
    map (from `mesh`, or None). `in_space` gives the entries of surfaces in space. The positions of
    flat axes are read from the SVG, because the layout of other formats differs slightly.
    """
    found, boxes = [], frames(svg)
    for axes in figure.axes:
        if axes.name == "3d":
            found += in_space(axes, figure)
        scales = {axes.get_xscale(), axes.get_yscale()}
        is_bar = axes.get_label() == "<colorbar>"
        if is_bar or axes.name != "rectilinear" or scales - {"linear", "log"}:
            continue
        lines = [told for told in map(line, axes.lines) if told]
        maps = [told for told in (mesh(drawn) for drawn in axes.collections
                                  if isinstance(drawn, QuadMesh)) if told]
        if not boxes or not lines and not maps:
            continue
        about = axes.get_position()
        box = min(boxes, key=lambda box: abs(box[0] - about.x0) + abs(box[1] - (1 - about.y1))
                  + abs(box[2] - about.width) + abs(box[3] - about.height))
        ends = {name: {"name": plain(label_of(axes, name)),
                       "ends": [float(end) for end in getattr(axes, f"get_{name}lim")()],
                       "log": getattr(axes, f"get_{name}scale")() == "log"} for name in "xy"}
        found.append({"box": rounded(box), **ends, "lines": lines,
                      "map": maps[0] if maps else None})
    return found


def label_of(axes, name) -> str:
    """Returns the label of an axis, or of an axis that is shared with it, or its name."""
    label = getattr(axes, f"get_{name}label")()
    shared = getattr(axes, f"get_shared_{name}_axes")().get_siblings(axes)
    return label or next((text for text in (getattr(other, f"get_{name}label")()
                                            for other in shared) if text), name)
