"""Style of all pictures, and the labels of their axes."""

import functools
import io
import math
import pathlib
import re

import matplotlib
import numpy
from matplotlib.figure import Figure
from matplotlib.ticker import AutoLocator, Formatter, FuncFormatter, LogFormatter

from .._files import isolated, write_bytes
from .._slipfront import event_quantities, printable, relations_quantities

SHEET = pathlib.Path(__file__).resolve().parent.parent / "slipfront.mplstyle"

#: Short names of quantities for axes. Other quantities have their long_name. docs/NOTATION.md lists
#: the symbols.
NAMES = {
    "x": "position x",
    "y": "position y",
    "rupture_time": "rupture time",
    "series_time": "time t",
    "time": "time t",
    "W": "slip velocity W",
    "Sigma": "stress Σ",
    "k": "dislocation density k",
    "U": "dislocation velocity U",
    "slip": "slip u",
    "event_slip": "mean slip u",
    "event_length": "length",
    "event_stress_drop": "stress drop",
    "loading_force": "force F",
    "loading_stress": "stress at pulled end",
    "stress_drop": "stress drop",
    "leading_velocity": "velocity of the leading edge V+",
    "velocity_ratio": "|V−| / V+",
    "slip_velocity": "slip velocity W at x = 0",
    "stress_pa": "initial stress",
    "slip_at_origin": "slip u at x = 0",
    "slip_velocity_at_origin": "slip velocity W at x = 0",
    "stress_at_origin": "stress Σ at x = 0",
}

#: Units of quantities whose variable has none, as in CSV files.
UNITS = {name: unit for name, _, unit, _ in relations_quantities if unit}

# src/events/inference/quantities.cpp declares the names and units of events.
for _name, _unit, _label in event_quantities():
    if _label:
        NAMES[_name] = _label
    if _unit:
        UNITS[_name] = _unit


#: A field whose values are all smaller than this, in any units, is at rest. Interfaces under
#: rate-and-state friction creep at 1e-17 and less.
REST = 1e-12

#: The same for a stress in Pa.
REST_IN_PA = 1e-5

#: Digits of powers of ten.
POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


#: Decimal prefixes, and the units that take them. Times from two hours on are in hours, days or
#: years.
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "μ"), (1e-9, "n"),
            (1e-12, "p"))
TIMES = ((31557600.0, "years"), (86400.0, "days"), (3600.0, "h"))
PREFIXED = ("m", "s", "Pa", "m s⁻¹", "J m⁻¹", "J m⁻²")


def prefixed(name, largest) -> tuple[float, str]:
    """Returns factor and name of the unit for SI values up to `largest`, as (1e-3, "mm")."""
    if name not in PREFIXED or not 0 < largest < math.inf:
        return 1.0, name
    if name == "s":
        for factor, longer in TIMES:
            if largest >= 2 * factor:
                return factor, longer
    prefixes = [pair for pair in PREFIXES if name != "s" or pair[0] <= 1]
    factor, prefix = next((pair for pair in prefixes if largest >= pair[0] * (1 - 1e-9)),
                          prefixes[-1])
    return factor, prefix + name


class TicksIn(AutoLocator):
    """Round ticks in a unit that is `factor` times that of the axis."""

    def __init__(self, factor):
        super().__init__()
        self.factor = factor

    def tick_values(self, vmin, vmax):
        return super().tick_values(vmin / self.factor, vmax / self.factor) * self.factor


def in_units_of(factor) -> Formatter:
    """Returns the formatter of an axis in a unit that is `factor` times that of the axis."""
    return FuncFormatter(lambda value, _: Formatter.fix_minus(f"{value / factor:.4g}"))


def prefix_axes(figure) -> None:
    """Shows axes with an SI unit in one of suitable size, as in "position x, mm"."""
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        text = axis.get_label_text()
        name = re.split(r",\s", text)[-1]
        factor, shown = prefixed(name, float(numpy.abs(axis.get_view_interval()).max()))
        is_log = axis.get_scale() == "log" and isinstance(axis.get_major_formatter(), FuncFormatter)
        if factor == 1 or not (is_log or axis.get_scale() == "linear"):
            continue
        axis.set_label_text(text.removesuffix(name) + shown)
        if is_log:
            plain_numbers(axis, factor)
            continue
        axis.set_major_formatter(in_units_of(factor))
        if math.log10(factor) % 1:
            axis.set_major_locator(TicksIn(factor))


def is_si(dataset) -> bool:
    return getattr(dataset, "attrs", {}).get("unit_system") == "SI"


class Picture(Figure):
    """A Figure that a notebook shows as a picture, also without `%matplotlib inline`."""

    def _repr_png_(self) -> bytes:
        return drawn(self, "png")


def drawn(figure: Figure, kind: str, **options) -> bytes:
    """Returns the content of a file of a picture. `kind` is its format."""
    picture = io.BytesIO()
    # matplotlib 3.6 would change the layout of a figure that has no layout engine while it saves
    # the figure.
    with matplotlib.rc_context(fname=SHEET), matplotlib.rc_context(
            {"figure.constrained_layout.use": False}):
        figure.savefig(picture, format=kind, metadata={"Date": None} if kind == "svg" else None,
                       **options)
    return picture.getvalue()


def styled(draw):
    """Decorator that applies the style sheet, and prefixes for a Dataset in SI units."""

    @functools.wraps(draw)
    def with_style(*arguments, **options):
        with matplotlib.rc_context(fname=SHEET):
            figure = draw(*arguments, **options)
            if arguments and is_si(arguments[0]):
                prefix_axes(figure)
            return figure

    return with_style


def save(figure: Figure, path, **options) -> None:
    """Writes a picture to a file. The file is written completely, or not at all.

    The picture is drawn in a fork of this process, because matplotlib and NumPy can crash when
    memory runs out.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The picture.
    path : path
        Name of the file. Its ending chooses the format, such as .png, .svg or .pdf.
    options
        Further options of `Figure.savefig`.

    Raises
    ------
    FileError if the picture cannot be drawn or written; ValueError if matplotlib does not write
    files with this ending.

    Examples
    --------
    >>> import tempfile
    >>> figure = slipfront.plots.relations(slipfront.relations(stress=[0.5, 1.0]))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     slipfront.plots.save(figure, f"{folder}/relations.png")
    """
    kind, formats = (pathlib.Path(path).suffix.lower().lstrip("."),
                     figure.canvas.get_supported_filetypes())
    if kind not in formats:
        raise ValueError(f"{path}: a picture cannot be '.{kind}'; allowed: "
                         f"{', '.join(sorted(formats))}")

    write_bytes(path, isolated(path, lambda: drawn(figure, kind, **options)))


def plain(text) -> str:
    """Returns a text as a picture can show it, without control characters or mathematics."""
    return printable(str(text).encode("utf-8", "replace")).replace("$", r"\$")


def unit(variable) -> str:
    """Returns the unit of a DataArray as an axis shows it. It is empty for a pure number."""
    si, unit_of_model = variable.attrs.get("units", ""), variable.attrs.get("dimensional_unit")
    if not unit_of_model and si not in ("", "1"):  # m s-1 without its space would be a rate
        return plain(si).translate({ord("-"): "⁻", **{ord(digit): power for digit,
                                                      power in zip("123456789", "¹²³⁴⁵⁶⁷⁸⁹")}})
    text = plain(unit_of_model or UNITS.get(variable.name, ""))
    for written, printed in ((" ", ""), ("mu", "μ"), ("nu", "ν"), ("pi", "π"), ("^2", "²"),
                             ("^3", "³")):
        text = text.replace(written, printed)
    return "" if text == "1" else text


def rest_of(variable) -> float:
    """Returns the value below which a field is at rest, or zero within rounding."""
    return REST_IN_PA if variable.attrs.get("units") == "Pa" else REST


def quantity(variable, value, digits: int = 4) -> str:
    factor, name = (prefixed(unit(variable), abs(value)) if "unit_of_model" in variable.attrs
                    else (1.0, unit(variable)))
    return f"{value / factor:.{digits}g} {name}"


def label(variable, name: str = "") -> str:
    """Returns the label of a DataArray: `name`, by default that of the quantity, and the unit."""
    name = name or NAMES.get(variable.name) or plain(variable.attrs.get("long_name")
                                                     or str(variable.name).replace("_", " "))
    return f"{name}, {unit(variable)}" if unit(variable) else name


class LogNumbers(LogFormatter):
    """Numbers between decades of a short logarithmic axis, in `factor` times its unit."""

    def __init__(self, factor):
        super().__init__(labelOnlyBase=False, minor_thresholds=(1.2, 0.5))
        self.factor = factor

    def __call__(self, x, pos=None):
        return f"{x / self.factor:g}" if super().__call__(x, pos) else ""


def plain_numbers(axis, factor: float = 1.0) -> None:
    """Labels a logarithmic axis with numbers such as 0.1, in `factor` times its unit."""
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / factor:g}"))
    axis.set_minor_formatter(LogNumbers(factor))


def scaled(axis, variable, text, values) -> None:
    """Labels a linear axis with `text`, which ends with the unit of a variable. Large and small
    values are divided by a power of ten, which the label names before the unit, as in "time t, 10⁶
    b/(cA)"."""
    largest = numpy.nanmax(numpy.abs(values), initial=0)
    power = 3 * math.floor(math.log10(largest) / 3 + 1e-9) if largest > 0 else 0
    # SI units have prefixes instead
    if -2 <= math.log10(largest or 1) < 4 or "unit_of_model" in variable.attrs:
        power = 0
    if power:
        factor, name = f"10{str(power).translate(POWERS)}", unit(variable)
        text = f"{text.removesuffix(name)}{factor} {name}" if name else f"{text}, {factor}"
        axis.set_major_formatter(in_units_of(10.0**power))
    axis.set_label_text(text)
