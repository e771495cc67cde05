import os
import pathlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy.typing as npt
import pandas
import xarray

from . import medium as medium
from . import train as train

__all__: list[str]
__version__: str
cases: pathlib.Path

_Path = str | os.PathLike[str]
_Scenario = _Path | Mapping[str, Any]
_Settings = Mapping[str, Any] | None
_Progress = bool | Callable[..., object] | None
_Event = _Path | Mapping[str, Any] | pandas.DataFrame

class InputError(ValueError): ...
class FileError(OSError): ...
class NumericsError(RuntimeError): ...

def relations(*, stress: npt.ArrayLike | None = ..., rupture_velocity: npt.ArrayLike | None = ..., slip_velocity: npt.ArrayLike | None = ...,
              threads: int | None = ...) -> xarray.Dataset: ...
def friction_ratio(stress: npt.ArrayLike, damping_number: npt.ArrayLike, *, measure: str = ..., closure: str = ...) -> xarray.Dataset: ...
def damping_number(stress: npt.ArrayLike, slip_velocity_ratio: npt.ArrayLike, *, measure: str = ..., closure: str = ...) -> xarray.Dataset: ...
def moment_duration(stress: npt.ArrayLike, damping_number: npt.ArrayLike) -> xarray.Dataset: ...
def pulse(scenario: _Scenario, *, set: _Settings = ..., output: _Path | None = ..., resume: _Path | None = ..., progress: _Progress = ...,
          threads: int | None = ..., tolerance: float | None = ..., errors: bool = ..., si: bool | None = ...) -> xarray.Dataset: ...
def chain(scenario: _Scenario, *, set: _Settings = ..., output: _Path | None = ..., resume: _Path | None = ..., progress: _Progress = ...,
          threads: int | None = ..., si: bool | None = ...) -> xarray.Dataset: ...
def compare(scenario: _Scenario, *, scales: Sequence[float] = ..., set: _Settings = ..., output: _Path | None = ..., progress: _Progress = ...,
            threads: int | None = ..., si: bool | None = ...) -> xarray.Dataset: ...
def event(events: _Event | Sequence[_Event] | None = ..., *, p_wave_speed: str | float | None = ..., poisson_ratio: str | float | None = ...,
          shear_modulus: str | float | None = ..., samples: int | None = ..., seed: int = ..., closure: str = ...,
          pulse: bool = ..., draws: int = ..., output: _Path | None = ..., resume: _Path | None = ...,
          progress: _Progress = ..., threads: int | None = ..., columns: _Path | Mapping[str, Any] | None = ...,
          strict: bool = ...) -> xarray.Dataset: ...
def laboratory(table: _Event, *, poisson_ratio: str | float | None = ..., shear_modulus: str | float | None = ..., density: str | float | None = ...,
               p_wave_speed: str | float | None = ..., s_wave_speed: str | float | None = ..., prior: Sequence[float] = ...,
               scatter_prior: Sequence[float] = ..., draws: int = ..., seed: int = ..., strict: bool = ..., output: _Path | None = ...) -> xarray.Dataset: ...
def population(events: _Event | Sequence[_Event] | None = ..., *, kind: str | None = ..., prior: Mapping[str, tuple[float, float]] | None = ...,
               hardness: str | float = ..., smallest_slip: str | float | None = ..., smallest_moment: str | float | None = ...,
               velocity_error: float = ..., size_error: float = ..., p_wave_speed: str | float | None = ..., poisson_ratio: str | float | None = ...,
               shear_modulus: str | float | None = ..., steps: int = ..., seed: int = ..., output: _Path | None = ...,
               progress: Callable[[int, int], object] | None = ...) -> xarray.Dataset: ...
def check(scenario: _Scenario, *, set: _Settings = ..., command: str = ..., scales: Sequence[float] = ...) -> dict[str, Any]: ...
def open(file: _Path, *, group: str | None = ..., si: bool | None = ...) -> xarray.Dataset: ...
def sweep(scenario: _Scenario, axes: Mapping[str, npt.ArrayLike], *, variables: Sequence[str] | None = ..., set: _Settings = ..., command: str = ...,
          output: _Path | None = ..., resume: _Path | None = ..., client: Any = ..., progress: _Progress = ..., threads: int | None = ...,
          si: bool | None = ...) -> xarray.Dataset: ...
