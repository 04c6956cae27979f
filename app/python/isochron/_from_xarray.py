"""Arrays of xarray, with their coordinates and attributes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray
from xarray import conventions

from ._arrays import _TIME_NAMES, Arrays, _Array, _expect_numbers, _no_gaps
from ._errors import ArgumentError
from ._netcdf import Variable

_LIMITS = ("valid_min", "valid_max", "valid_range")
_OF_VALUES = ("_FillValue", "missing_value", "scale_factor", "add_offset", "_Unsigned", *_LIMITS)


def arrays_of_xarray(given: Any, names: Sequence[str], label: str) -> Arrays:
    steps: list[xarray.Dataset] = []
    if isinstance(given, Sequence):
        steps = [_dataset(each)[0] for each in given]
        given, label = steps[0], f"list of {label}"
    data, unnamed = _dataset(given)
    chosen = [name for name in data.data_vars if sum(length > 1 for length in data[name].shape) >= 3]
    if not chosen:
        shapes = ", ".join(f"{name}{dict(data[name].sizes)}" for name in list(data.data_vars)[:8])
        raise ArgumentError(f"{label}: no array with three dimensions of more than one vertex: {shapes}")
    if steps:
        data = _with_time_of(data, steps, label)
    light = xarray.Dataset(
        {name: (data[name].dims, np.broadcast_to(np.int8(0), data[name].shape)) for name in chosen}, data.coords
    )
    encoded = _encoded(light)
    others = {
        str(name): written
        for name, variable in encoded.items()
        if name not in chosen and (written := _written(str(name), variable)) is not None
    }
    arrays = {}
    for name in chosen:
        variable = data[name].variable
        _expect_numbers(str(name), variable.dtype)
        time = next((dim for dim in variable.dims if _is_time(str(dim), others)), None)
        dims = [dim for dim in variable.dims if dim != time]
        long = [dim for dim in dims if variable.sizes[dim] > 1]
        if len(long) > (3 if time is not None else 4):
            raise ArgumentError(f"{name}: the dimensions {variable.dims}, expected x, y, z and time: "
                                f"{label}.isel({long[0]}=0) takes one of {long[0]}")  # fmt: skip
        if time is None and len(long) == 4:
            time = long[0]
            dims.remove(time)
        attributes = {str(key): value for key, value in variable.attrs.items()}
        if not set(attributes) & set(_OF_VALUES):
            attributes.update(_no_gaps(variable.dtype))
        if "coordinates" in encoded[name].attrs:
            attributes["coordinates"] = encoded[name].attrs["coordinates"]
        ordered = ([time] if time is not None else []) + dims
        arrays[str(name)] = _Array(
            tuple(map(str, ordered)),
            tuple(variable.sizes[dim] for dim in ordered),
            variable.dtype,
            attributes,
            _loader(steps, name) if steps else _cut(variable, time),
            _missing(variable),
        )
        if time is not None and str(time) != "time":
            _mark_time(str(time), others)
    return Arrays(arrays, others, label, unnamed)


def _dataset(given: Any) -> tuple[xarray.Dataset, bool]:
    """And whether its array has no name of its own."""
    if isinstance(given, xarray.Dataset):
        return given, False
    if not isinstance(given, xarray.DataArray):
        raise ArgumentError(f"files: expected arrays of xarray, got {type(given).__name__}")
    name = given.name if given.name is not None and given.name not in given.coords else "values"
    return given.to_dataset(name=name), given.name is None


def _cut(variable: xarray.Variable, time: Any) -> Callable[[int], Any]:
    return lambda step: (variable if time is None else variable.isel({time: step})).data


def _loader(steps: list[xarray.Dataset], name: Any) -> Callable[[int], Any]:
    return lambda step: steps[step][name].variable.data


def _with_time_of(data: xarray.Dataset, steps: list[xarray.Dataset], label: str) -> xarray.Dataset:
    """The first of several steps, with a dimension for all of them and their times."""
    for number, step in enumerate(steps):
        for name in data.data_vars:
            if name not in step or step[name].sizes != data[name].sizes or step[name].dtype != data[name].dtype:
                raise ArgumentError(f"{label}: {name} of step {number} is not as that of step 0")
    shape = {name: (len(steps), *data[name].shape) for name in data.data_vars}
    whole = {
        name: (("time", *data[name].dims), np.broadcast_to(np.zeros((), data[name].dtype), shape[name]), data[name].attrs)
        for name in data.data_vars
    }
    coordinates = {name: each for name, each in data.coords.items() if name != "time"}
    if all("time" in step.coords and step.coords["time"].ndim == 0 for step in steps):
        coordinates["time"] = xarray.concat([step.coords["time"] for step in steps], "time")
    return xarray.Dataset(whole, coordinates)


def _encoded(data: xarray.Dataset) -> dict[Any, xarray.Variable]:
    """Its variables with the attribute `coordinates` as files have it."""
    encode: Any = conventions.encode_dataset_coordinates
    variables: dict[Any, xarray.Variable] = encode(data)[0]
    return variables


def _written(name: str, variable: xarray.Variable) -> Variable | None:
    """A coordinate as xarray would write it; None if it is no number."""
    try:
        variable = conventions.encode_cf_variable(variable, name=name)
    except (TypeError, ValueError):
        return None
    dtype = variable.dtype
    if dtype.kind not in "iuf" or dtype.itemsize > 8 or dtype == np.float16 or variable.ndim > 2:
        return None
    values = np.asarray(variable.data) if variable.ndim < 2 else None
    return Variable(tuple(map(str, variable.dims)), dtype.newbyteorder("="), dict(variable.attrs), values)


def _is_time(dim: str, coordinates: Mapping[str, Variable]) -> bool:
    attributes = coordinates[dim].attributes if dim in coordinates else {}
    axis = str(attributes.get("axis", "")).lower()
    if axis in ("x", "y", "z", "t"):
        return axis == "t"
    return (
        " since " in str(attributes.get("units", "")).lower()
        or attributes.get("standard_name") == "time"
        or dim.lower() in _TIME_NAMES
    )


def _mark_time(dim: str, coordinates: dict[str, Variable]) -> None:
    if dim in coordinates:
        coordinates[dim].attributes.setdefault("axis", "T")


def _missing(variable: xarray.Variable) -> Callable[[NDArray[Any]], NDArray[np.bool_]] | None:
    """Finds missing values, by the attributes that files have for them."""
    attributes, packing = variable.attrs, {**variable.encoding, **variable.attrs}
    dtype = variable.dtype
    stand_ins = [
        np.asarray(value).astype(dtype)
        for name in ("_FillValue", "missing_value")
        if name in attributes
        for value in np.atleast_1d(attributes[name])
        if not np.isnan(value)
    ]
    slope, intercept = float(packing.get("scale_factor", 1)), float(packing.get("add_offset", 0))
    packed = "scale_factor" in attributes or "add_offset" in attributes

    def limit(name: str, number: int) -> float | None:
        value = attributes.get(name, attributes.get("valid_range"))
        if value is None:
            return None
        numbers = np.atleast_1d(value)
        value = numbers[number if numbers.size == 2 else 0]
        of_packed = np.asarray(value).dtype.kind in "iu"
        if packed and dtype.kind in "iu" and not of_packed:
            return (float(value) - intercept) / slope
        return float(value) if packed or not of_packed else float(value) * slope + intercept

    bounds = [each for each in (limit("valid_min", 0), limit("valid_max", 1)) if each is not None]
    low, high = limit("valid_min", 0), limit("valid_max", 1)
    if low is not None and high is not None and low > high:
        low, high = high, low
    if not stand_ins and not bounds:
        return None

    def found(values: NDArray[Any]) -> NDArray[np.bool_]:
        gaps = np.zeros(values.shape, bool)
        for value in stand_ins:
            gaps |= values == value
        if low is not None:
            gaps |= values < low
        if high is not None:
            gaps |= values > high
        return gaps

    return found
