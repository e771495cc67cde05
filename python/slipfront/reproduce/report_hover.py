"""What a drawn figure tells the page's script: where its axes are, and the values drawn in them."""

import math
import re

import numpy
from matplotlib.collections import QuadMesh
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

#: Points of a line, cells of a map across and up, and points of a surface that go into the page.
POINTS = 240
CELLS = 60
SURFACE = 1200


def rounded(values) -> list:
    """Numbers to five digits, None for what is not finite."""
    return [float(f"{value:.5g}") if math.isfinite(value) else None for value in numpy.ravel(values).astype(float)]


def thinned(count: int, most: int) -> numpy.ndarray:
    """Indices of at most `most` of `count` points, evenly, the first and the last among them."""
    return numpy.unique(numpy.linspace(0, count - 1, min(count, most)).round().astype(int))


def line(drawn) -> dict | None:
    """Name and points of a line; None for one that shows no data (a rule across the axes, an empty line)."""
    x, y = (numpy.asarray(values, float) for values in drawn.get_data(orig=False))
    if drawn.get_transform() != drawn.axes.transData or x.size < 2:
        return None
    chosen = thinned(x.size, POINTS)
    name = str(drawn.get_label())
    return {"name": "" if name.startswith("_") else plain(name), "x": rounded(x[chosen]), "y": rounded(y[chosen])}


def mesh(drawn) -> dict | None:
    """Values of a map on straight rows and columns, thinned: x and y of the cells' middles, and the values row by row. None for any other map."""
    corners, values = drawn.get_coordinates(), drawn.get_array()
    across, up = corners[0, :, 0], corners[:, 0, 1]
    if values is None or not (numpy.allclose(corners[..., 0], across) and numpy.allclose(corners[..., 1], up[:, None])):
        return None
    values = numpy.ma.filled(numpy.ma.asarray(values, float), numpy.nan).reshape(len(up) - 1, len(across) - 1)
    rows, columns = thinned(len(up) - 1, CELLS), thinned(len(across) - 1, CELLS)
    middles = [(edges[1:] + edges[:-1]) / 2 for edges in (across, up)]
    return {"x": rounded(middles[0][columns]), "y": rounded(middles[1][rows]), "z": rounded(values[numpy.ix_(rows, columns)])}


def surface(drawn, figure) -> dict:
    """Points of a surface in space: where each is seen, as shares of the figure from its upper left corner, and its three coordinates."""
    corners = numpy.asarray(drawn._vec)[:3, ::4]  # one of each facet; matplotlib offers no other way to them
    corners = corners[:, thinned(corners.shape[1], SURFACE)]
    flat = drawn.axes.transData.transform(numpy.transpose(proj3d.proj_transform(*corners, drawn.axes.get_proj())[:2]))
    seen = flat / [figure.bbox.width, figure.bbox.height]
    return {"left": rounded(seen[:, 0]), "top": rounded(1 - seen[:, 1]), **{name: rounded(values) for name, values in zip("xyz", corners)}}


def in_space(axes, figure) -> list:
    """The surfaces of axes in space, each as an entry of `axes_of` with "surface" in place of lines and map."""
    names = {name: {"name": plain(getattr(axes, f"get_{name}label")()) or {"z": "value"}.get(name, name)} for name in "xyz"}
    about = axes.get_position()
    return [{"box": rounded([about.x0, 1 - about.y1, about.width, about.height]), **names, "surface": surface(drawn, figure)}
            for drawn in axes.collections if isinstance(drawn, Poly3DCollection)]


def plain(text) -> str:
    """A label without the marks of matplotlib's mathematics."""
    return re.sub(r"[${}\\]", "", str(text)).replace("\n", " ")


def frames(svg) -> list:
    """The rectangles of all axes in a figure's SVG: left, top, width, height as shares of the figure, from its upper left corner."""
    wide, high = (float(number) for number in re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)[0])
    corners = re.findall(r'<g id="axes_\d+">\s*<g id="patch_\d+">\s*<path d="M ([\d.]+) ([\d.]+) \nL ([\d.]+) [\d.]+ \nL [\d.]+ ([\d.]+) ', svg)
    return [(x0 / wide, y0 / high, (x1 - x0) / wide, (y1 - y0) / high) for x0, y1, x1, y0 in (map(float, found) for found in corners)]


def axes_of(figure, svg) -> list:
    """The axes of a figure with what is drawn in them; where flat ones are is read from its SVG, as another format lays them out a little differently.

    box: of `frames`. x, y: {"name", "ends", "log"}. lines: of `line`. map: of `mesh`, or None.
    Surfaces in space are those of `in_space`.
    """
    found, boxes = [], frames(svg)
    for axes in figure.axes:
        if axes.name == "3d":
            found += in_space(axes, figure)
        if axes.name != "rectilinear" or axes.get_label() == "<colorbar>" or {axes.get_xscale(), axes.get_yscale()} - {"linear", "log"}:
            continue
        lines = [told for told in map(line, axes.lines) if told]
        maps = [told for told in (mesh(drawn) for drawn in axes.collections if isinstance(drawn, QuadMesh)) if told]
        if not boxes or not lines and not maps:
            continue
        about = axes.get_position()
        box = min(boxes, key=lambda box: abs(box[0] - about.x0) + abs(box[1] - (1 - about.y1)) + abs(box[2] - about.width) + abs(box[3] - about.height))
        ends = {name: {"name": plain(label_of(axes, name)), "ends": [float(end) for end in getattr(axes, f"get_{name}lim")()],
                       "log": getattr(axes, f"get_{name}scale")() == "log"} for name in "xy"}
        found.append({"box": rounded(box), **ends, "lines": lines, "map": maps[0] if maps else None})
    return found


def label_of(axes, name) -> str:
    """Label of an axis, or that of the axes which share it."""
    label = getattr(axes, f"get_{name}label")()
    shared = getattr(axes, f"get_shared_{name}_axes")().get_siblings(axes)
    return label or next((text for text in (getattr(other, f"get_{name}label")() for other in shared) if text), name)
