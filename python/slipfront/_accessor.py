"""The accessor `slipfront` of xarray Datasets. It converts results to SI units."""

from collections.abc import Mapping

from . import _units
from ._messages import shown
from ._slipfront import InputError


def scenario_table(data, name):
    """Returns a table of the scenario of a Dataset, or an empty one if it has none."""
    import tomllib

    try:
        table = tomllib.loads(str(data.attrs.get("scenario", ""))).get(name, {})
    except tomllib.TOMLDecodeError:
        return {}
    return table if isinstance(table, dict) else {}


class SlipfrontAccessor:
    """Methods of a Dataset, as `dataset.slipfront`. It is available after `import slipfront`.

    >>> import slipfront
    >>> pulse = slipfront.pulse(slipfront.cases / "step.toml")
    >>> rock = {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s", "poisson_ratio": 0.3}
    >>> pulse.slipfront.si(contact_ratio=0.01, spacing=1e-3, medium=rock).x.units
    'm'
    """

    def __init__(self, data):
        self._data = data

    def _constants(self, contact_ratio, spacing, medium):
        """Returns constants in SI units: those of the user, or else of the scenario."""
        given = {} if medium is None else medium
        if not isinstance(given, Mapping):
            raise InputError(f"medium = '{shown(medium)}': a {type(medium).__name__}; allowed: a "
                             f"dict such as {{'shear_modulus': '30 GPa'}}")
        attrs = self._data.attrs
        table = scenario_table(self._data, "medium")
        # A sweep has the settings of all its points there
        for line in str(attrs.get("set", "")).splitlines():
            key, _, value = line.partition("=")
            if key.startswith("medium."):
                table[key.removeprefix("medium.")] = value.strip("\"'")
        parameters = {"contact_ratio": contact_ratio, "asperity_spacing": spacing}
        given = {**given,
                 **{name: value for name, value in parameters.items() if value is not None}}
        for name, values in self._data.coords.items():  # the axes of a sweep
            constant = str(name).removeprefix("medium_")
            is_axis = constant in _units.CONSTANTS and str(name).startswith("medium_")
            if is_axis and constant not in given:
                if values.ndim:
                    raise InputError(f"si: {constant} varies along the dimension {name}; allowed: "
                                     f"select one value with .sel, or give {constant}")
                table[constant] = values.item()
        known = {name: value
                 for name, value in table.items() if name in _units.CONSTANTS and name not in given}
        return {name: _units.constant(name, value) for name, value in {**known, **given}.items()}

    def si(self, *, contact_ratio=None, spacing=None, medium=None):
        """Returns the Dataset in SI units.

        Every variable and coordinate with a `dimensional_unit` is multiplied by that unit. Its
        attribute `units` is then the SI unit, such as "m" or "m s-1", and it has no
        `dimensional_unit`. Pure numbers do not change.

        The attributes of the Dataset, such as slip_at_origin of a pulse, remain dimensionless. So
        do `difference` and trend_extrapolated of a comparison, because they have several quantities
        in one variable. A Dataset in SI units, such as that of a run with si=True, is returned as
        it is.

        Parameters
        ----------
        contact_ratio : float, optional
            A, the real over the nominal area of contact. By default that of the table [medium] of
            the scenario, as are the other constants.
        spacing : float or str, optional
            Spacing b of the asperities, in m or with a unit such as "1 mm".
        medium : dict, optional
            Constants of the rock, such as {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s",
            "poisson_ratio": 0.3}. The keys are those of [medium] in a scenario (docs/scenario.md).
            Numbers are in SI units.

        Returns
        -------
        xarray.Dataset. Slip is between the faces: twice u b / (2 pi), because both move
        (docs/theory/1_chain.md). It is the integral of the slip velocity over time. Energies are
        those of a strip of the fault of width 1 m.

        Raises
        ------
        InputError if a constant is missing or wrong. The message names the missing ones.

        Examples
        --------
        >>> import slipfront
        >>> rock = {"shear_modulus": "30 GPa", "p_wave_speed": "6 km/s", "poisson_ratio": 0.3}
        >>> pulse = slipfront.pulse(slipfront.cases / "step.toml")
        >>> metric = pulse.slipfront.si(contact_ratio=0.01, spacing="1 mm", medium=rock)
        >>> metric.W.units, metric.Sigma.units, metric.time.units
        ('m s-1', 'Pa', 's')
        >>> print(f"{float(metric.Sigma.max()):.3g} Pa")
        8.16e+07 Pa
        """
        texts = {name: variable.attrs["dimensional_unit"] for name,
                 variable in self._data.variables.items() if variable.attrs.get("dimensional_unit")}
        wanted = set().union(*(_units.symbols(text) for text in texts.values()))
        values = _units.values_of(wanted, self._constants(contact_ratio, spacing, medium))
        changed = {}
        for name, text in texts.items():
            unit = _units.in_si(text, values)
            variable = self._data.variables[name]
            changed[name] = (variable.dims, variable.values * unit[0],
                             _units.converted(variable.attrs, unit))
        data = _replaced(self._data, changed)
        words = [f"{symbol} = {value:.6g} {unit}".rstrip()
                 for symbol, unit in (("A", ""), ("b", "m"), ("c", "m/s"), ("mu", "Pa"), ("nu", ""))
                 if symbol in wanted and (value := values[symbol]) is not None]
        if not words:
            return data
        return data.assign_attrs(comment=f"Variables are in SI units, for {', '.join(words)}. "
                                 "Attributes are dimensionless.", unit_system="SI",
                                 medium=", ".join(words))


def _replaced(data, changed):
    """Returns a Dataset with other variables and coordinates of the same names."""
    coordinates = {name: value for name, value in changed.items() if name in data.coords}
    return data.assign({name: value for name, value in changed.items()
                        if name not in coordinates}).assign_coords(coordinates)


def in_model(data):
    """Returns a Dataset in the units of the model, by the constants in its scenario."""
    texts = {name: variable.attrs["unit_of_model"]
             for name, variable in data.variables.items() if "unit_of_model" in variable.attrs}
    if not texts:
        return data
    wanted = set().union(*(_units.symbols(text) for text in texts.values()))
    values = _units.values_of(wanted, SlipfrontAccessor(data)._constants(None, None, None))
    changed = {}
    for name, text in texts.items():
        variable = data.variables[name]
        changed[name] = (variable.dims, variable.values / _units.in_si(text, values)[0],
                         _units.of_model(variable.attrs))
    data = _replaced(data, changed)
    data.attrs = _units.without_si(data.attrs)
    return data


def register():
    try:
        import xarray
    except ImportError:
        return  # functions that need xarray raise an error that names its package
    if not hasattr(xarray.Dataset, "slipfront"):
        xarray.register_dataset_accessor("slipfront")(SlipfrontAccessor)
