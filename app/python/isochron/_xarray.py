"""A run as xarray's Dataset."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
import xarray
from numpy.typing import NDArray
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing

from ._run import Run

_LazilyIndexed: Any = indexing.LazilyIndexedArray
_Variable: Any = xarray.Variable


class Values(BackendArray):
    """The values of one array of a run, read when they are asked for."""

    def __init__(self, run: Run, array: str) -> None:
        self.run = run
        self.array = array
        self.shape = run.shape
        self.dtype = run.values(0, slice(0), array=array).dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._part)

    def _part(self, key: tuple[int | slice, ...]) -> Any:
        step, z, y, x = key
        if not isinstance(step, slice):
            return self.run.values(int(step), z, y, x, array=self.array)
        parts = [self.run.values(i, z, y, x, array=self.array) for i in range(*step.indices(self.shape[0]))]
        empty = self.run.values(0, z, y, x, array=self.array)[np.newaxis][:0]
        return np.stack(parts) if parts else empty


def _with_unit(unit: str) -> dict[str, str]:
    return {"units": unit} if unit else {}


def _of_times(unit: str) -> dict[str, str]:
    """CF's attributes: a calendar stands behind the unit in brackets where it is not the usual one."""
    found = re.fullmatch(r"(.* since .*) \((\w+)\)", unit)
    return {"units": found[1], "calendar": found[2]} if found else _with_unit(unit)


class _Axis(NamedTuple):
    places: NDArray[np.float64]  #: of the vertices along an axis of the grid
    name: str = ""  #: of the coordinate that the files had, where it has another name
    unit: str = ""
    factor: float = 1.0  #: which makes that coordinate of the places


def _axis(run: Run, number: int) -> _Axis:
    """number: 0 is x"""
    distances = run._about["levels"][0][2 - number]
    step = run.direction[number][number]
    # On a grid that is turned, coordinates are distances along its own axes.
    if abs(step) != 1:
        return _Axis(distances)
    places = run.origin[number] + step * distances
    said = re.fullmatch(r"(-?)(.*?)(?: \((.*?)(?: ([*/]) ([0-9.e+-]+))?\))?", run.axis_names[number])
    if not said or not said[2] or said[2] in ("x", "y", "z", "time", *run.arrays):
        return _Axis(places)
    factor = -1.0 if said[1] else 1.0
    if said[4]:
        factor *= float(said[5]) if said[4] == "/" else 1 / float(said[5])
    return _Axis(places, said[2], said[3] or run.length_unit, factor)


def dataset(run: Run) -> xarray.Dataset:
    coordinates: dict[str, Any] = {"time": ("time", run.times, _of_times(run.time_unit))}
    for number, dim in reversed(list(enumerate("xyz"))):
        axis = _axis(run, number)
        coordinates[dim] = (dim, axis.places, _with_unit(run.length_unit))
        if axis.name:
            coordinates[axis.name] = (dim, axis.factor * axis.places, _with_unit(axis.unit))
    arrays = {}
    for name in run.arrays:
        about = run._array(name).description()
        values = _LazilyIndexed(Values(run, name))
        arrays[name] = _Variable(("time", "z", "y", "x"), values, _with_unit(about["unit"]))
        arrays[name].encoding.update(source=run._place, isochron_array=name)
    return xarray.Dataset(arrays, coordinates, {"source": run.path})


def decoded(data: xarray.Dataset, **options: Any) -> xarray.Dataset:
    """With dates instead of numbers, where times have a reference date."""
    sources = {name: dict(data[name].encoding) for name in data.data_vars}
    data = xarray.decode_cf(data, mask_and_scale=False, concat_characters=False, decode_coords=False, **options)
    for name, encoding in sources.items():
        data[name].encoding.update(encoding)
    return data


class Backend(BackendEntrypoint):
    """xarray.open_dataset("run42.isochron", engine="isochron")"""

    description = "Index of Isochron: time-varying volumes, read when they are needed"
    open_dataset_parameters = ("filename_or_obj", "drop_variables", "decode_times", "use_cftime", "decode_timedelta")

    def open_dataset(
        self,
        filename_or_obj: Any,
        drop_variables: str | Iterable[str] | None = None,
        decode_times: bool = True,
        use_cftime: bool | None = None,
        decode_timedelta: bool = False,
        **kwargs: Any,
    ) -> xarray.Dataset:
        run = Run(filename_or_obj)
        data = dataset(run)
        if drop_variables is not None:
            names = [drop_variables] if isinstance(drop_variables, str) else list(drop_variables)
            data = data.drop_vars([name for name in names if name in data.variables])
        if decode_times:
            data = decoded(data, use_cftime=use_cftime, decode_timedelta=decode_timedelta)
        data.set_close(run.close)
        return data

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        try:
            return str(os.fspath(filename_or_obj)).endswith(".isochron")
        except TypeError:
            return False
