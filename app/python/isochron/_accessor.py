"""`data.isochron`: of xarray's arrays, imported with xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

from ._arguments import Isovalues, Number, moment
from ._build import Path, build
from ._elsewhere import DATA, unknown
from ._errors import ArgumentError
from ._run import Run

_of_dataset: Any = xarray.register_dataset_accessor
_of_array: Any = xarray.register_dataarray_accessor


class _Accessor:
    def __init__(self, data: Any) -> None:
        self._data = data

    def build(self, out: Path, **options: Any) -> Run:
        """Indexes the array, as isochron.build(data, out, ...) does, and opens the index."""
        return build(self._data, out, **options)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            raise unknown(self, name, DATA)


@_of_dataset("isochron")
class DatasetAccessor(_Accessor):
    """Of a Dataset: build, and the run that it was opened from."""

    @property
    def run(self) -> Run:
        """The open index whose values the Dataset has, as xarray.open_dataset(..., engine="isochron") opens it."""
        for name in self._data.data_vars:
            return DataArrayAccessor(self._data[name]).run
        raise ArgumentError("the Dataset has no arrays of an index")


@_of_array("isochron")
class DataArrayAccessor(_Accessor):
    """Of an array: build, and where it comes from an index also its run, cells and surfaces.

    ds = xarray.open_dataset("run42.isochron", engine="isochron")
    ds.rho.sel(time=3.5).isochron.mesh(0.5).to_pyvista().plot()
    """

    @property
    def run(self) -> Run:
        """The open index whose values the array has."""
        source = self._data.encoding.get("source")
        if source is None or "isochron_array" not in self._data.encoding:
            raise ArgumentError(
                f"{self._data.name}: expected an array as an index has it, not a computed one; "
                "isochron.build(name) makes an index of it"
            )
        return Run(source)

    def cells(self, isovalue: Number | Isovalues, **options: Any) -> Any:
        """As Run.cells, of the moment that was selected: data.sel(time=3.5).isochron.cells(0.5)."""
        return self._ask("cells", isovalue, options)

    def mesh(self, isovalue: Number | Isovalues, **options: Any) -> Any:
        """As Run.mesh, of the moment that was selected."""
        return self._ask("mesh", isovalue, options)

    def _ask(self, name: str, isovalue: Any, options: dict[str, Any]) -> Any:
        run = self.run
        data = self._data
        sizes = dict(zip("zyx", run.shape[1:]))
        if {axis: data.sizes.get(axis) for axis in "zyx"} != sizes:
            raise ArgumentError(
                f"{data.name}: {dict(data.sizes)}, expected the whole grid {sizes}: its part can be indexed by "
                ".isochron.build(name)"
            )
        said = {"step", "time", "fraction"} & set(options)
        if "time" in data.coords and data.coords["time"].ndim == 0:
            if said:
                raise ArgumentError(f"{data.name}: a moment is selected already, expected no {said.pop()}")
            options = {**options, "time": data.coords["time"].values[()]}
        elif "time" in data.dims and data.sizes["time"] != len(run):
            raise ArgumentError(f"{data.name}: {data.sizes['time']} of {len(run)} steps, expected one or all")
        elif "time" in data.dims and not said and len(run) > 1:
            raise ArgumentError(f"{data.name}: {len(run)} steps: expected time or step, or one of them selected")
        array = data.encoding["isochron_array"]
        at, part = moment(run, *(options.get(each) for each in ("step", "fraction", "time")))
        if "time" in data.dims:
            shown = {step: data.isel(time=step) for step in (at, at + (part > 0))}
        else:
            shown = {at: data}
        if not all(self._is_as_stored(run, array, values, step) for step, values in shown.items()):
            raise ArgumentError(f"{data.name}: its values or places were changed: .isochron.build(name) makes an index of it")
        return getattr(run, name)(isovalue, array=array, **options)

    @staticmethod
    def _is_as_stored(run: Run, array: str, data: Any, step: int) -> bool:
        """Values that are not in memory yet are those of the file."""
        from ._xarray import Values  # imports xarray, which imports this

        places = run.to_xarray().coords
        if any(axis in data.coords and not np.array_equal(data[axis], places[axis]) for axis in "zyx"):
            return False
        held = data.variable._data
        while hasattr(held, "array"):  # xarray's wrappers
            held = held.array
        if isinstance(held, Values):
            return True
        return np.array_equal(data.transpose(*"zyx").values, run.values(step, array=array), equal_nan=True)
