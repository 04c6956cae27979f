"""A run as xarray's Dataset."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

if TYPE_CHECKING:
    from ._run import Run


class _Values(BackendArray):
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


def dataset(run: Run) -> xarray.Dataset:
    straight = run.direction == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    coordinates: dict[str, Any] = {"time": ("time", run.times, _of_times(run.time_unit))}
    for axis, distances, first in zip("zyx", run._about["distances"], reversed(run.origin)):
        # On a grid that is turned, coordinates are distances along its own axes.
        places = distances + first if straight else distances
        coordinates[axis] = (axis, places, _with_unit(run.length_unit))
    arrays = {}
    for name in run.arrays:
        about = run._array(name).description()
        values = indexing.LazilyIndexedArray(_Values(run, name))
        arrays[name] = xarray.Variable(("time", "z", "y", "x"), values, _with_unit(about["unit"]))
    return xarray.Dataset(arrays, coordinates, {"source": run.path})
