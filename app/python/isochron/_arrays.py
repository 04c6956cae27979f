"""Arrays in memory, or that read themselves when they are cut, as a series of volumes.

What axes, units and times mean is found where files are read: the arrays are described by a NetCDF file without values.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import ArgumentError, Error
from ._netcdf import Variable, write

_PIECE = 8 << 20  # [byte] of a step that are converted at a time
_TIME_NAMES = ("t", "nt", "time", "times", "ocean_time")


@dataclass
class _Array:
    """One array, its steps along the first of its dimensions if there are several."""

    dims: tuple[str, ...]
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    attributes: dict[str, Any]
    load: Callable[[int], Any]  #: a step of it
    missing: Callable[[NDArray[Any]], NDArray[np.bool_]] | None = None

    def has_steps(self) -> bool:
        return self.dims[0] == "time" or sum(length > 1 for length in self.shape) > 3


class Arrays:
    """Arrays on one grid, by name."""

    def __init__(self, arrays: dict[str, _Array], others: dict[str, Variable], label: str, unnamed: bool) -> None:
        self.arrays = {_name(name): array for name, array in arrays.items()}
        self.others = others  # coordinates
        self.label = label
        self.unnamed = unnamed

    def rename(self, name: str) -> None:
        ((_, array),) = self.arrays.items()
        self.arrays = {_name(name): array}

    def shape(self) -> tuple[int, ...]:
        """Steps, and vertices along z, y and x, of the first."""
        first = next(iter(self.arrays.values()))
        long = [length for length in (first.shape[1:] if first.has_steps() else first.shape) if length > 1]
        return (first.shape[0] if first.has_steps() else 1, *long)

    @contextlib.contextmanager
    def described(self) -> Iterator[tuple[str, str]]:
        """The name of a file that describes the arrays while this lasts, and what messages call them."""
        lengths: dict[str, int] = {}
        variables = dict(self.others)
        for name, array in self.arrays.items():
            variables[name] = Variable(array.dims, _stored(array.dtype), array.attributes)
            for dim, length in zip(array.dims, array.shape):
                if length == 0:
                    raise ArgumentError(f"{name}: has no values along {dim}, expected at least 2 vertices")
                if lengths.setdefault(dim, length) != length:
                    raise ArgumentError(f"{name}: {length} along {dim}, expected {lengths[dim]} as of the other arrays")
        for name, variable in self.others.items():
            if not set(variable.dims) <= set(lengths):
                del variables[name]
        with tempfile.TemporaryDirectory(prefix="isochron-") as folder:
            path = os.path.join(folder, self.label)
            write(path, lengths, variables)
            yield path, self.label

    def pieces(self, name: str, step: int, dtype: np.dtype[Any]) -> Iterator[NDArray[Any]]:
        """The values of a step, plane by plane."""
        array = self.arrays[name]
        whole = array.load(step)
        if isinstance(whole, np.ma.MaskedArray):
            if dtype.kind != "f" and np.ma.is_masked(whole):  # type: ignore[no-untyped-call]
                raise Error(f"{name}: step {step} has masked values, for which {dtype} has no number: .astype(float) has NaN")
            whole = np.ma.filled(whole.astype(dtype, copy=False), np.nan)  # type: ignore[no-untyped-call]
        whole = np.asarray(whole)
        lengths = array.shape[1:] if array.has_steps() else array.shape
        if whole.size != np.prod(lengths):
            raise Error(f"{name}: step {step} has the shape {whole.shape}, expected {lengths}")
        whole = whole.reshape([length for length in lengths if length > 1])
        planes = max(1, _PIECE // max(1, whole[0].size * dtype.itemsize))
        for first in range(0, len(whole), planes):
            yield _converted(whole[first : first + planes], dtype, array.missing, f"{name}: step {step}")


def _name(name: str) -> str:
    """As a file can have it."""
    return name.replace("/", "_")


def _converted(
    values: NDArray[Any],
    dtype: np.dtype[Any],
    missing: Callable[[NDArray[Any]], NDArray[np.bool_]] | None,
    name: str,
) -> NDArray[Any]:
    gaps = missing(values) if missing else None
    result = np.ascontiguousarray(values, dtype)
    if values.dtype.kind in "iu" and values.dtype.itemsize == 8 and (result.astype(values.dtype) != values).any():
        raise Error(f"{name}: has a 64-bit integer without an exact float64")
    if gaps is not None and gaps.any():
        result = np.array(result)  # it may be the caller's own
        result[gaps] = np.nan
    return result


def _stored(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """The type in which a file would have the values."""
    if dtype.kind == "b":
        return np.dtype(np.uint8)
    if dtype == np.float16:
        return np.dtype(np.float32)
    if dtype.kind == "f" and dtype.itemsize > 8:
        return np.dtype(np.float64)
    return dtype


def _expect_numbers(name: str, dtype: np.dtype[Any]) -> None:
    if dtype.kind not in "biuf":
        raise ArgumentError(f"{name}: values of type {dtype}, expected real numbers")


def _no_gaps(dtype: np.dtype[Any]) -> dict[str, Any]:
    """So that no value stands for a missing one, as one does in files that say nothing."""
    stored = _stored(dtype)
    return {"_FillValue": np.array(np.nan, stored)} if stored.kind == "f" else {}


def arrays_of(given: Any, names: Sequence[str]) -> Arrays:
    """@raises ArgumentError: of what cannot be indexed"""
    label = _label_of(given)
    first = given[0] if isinstance(given, Sequence) and len(given) else given
    if hasattr(first, "dims") and hasattr(first, "coords"):
        from ._from_xarray import arrays_of_xarray

        return arrays_of_xarray(given, names, label)
    if isinstance(given, Mapping):
        return Arrays({str(name): _array(array, str(name)) for name, array in given.items()}, {}, label, False)
    return Arrays({"values": _array(given, "values")}, {}, label, True)


def _label_of(given: Any) -> str:
    kind = type(given)
    return f"{kind.__module__.split('.')[0]}.{kind.__name__}" if kind.__module__ != "builtins" else kind.__name__


def _array(given: Any, name: str) -> _Array:
    if isinstance(given, Sequence):
        return _of_steps(given, name)
    if not hasattr(given, "shape") or not hasattr(given, "dtype"):
        raise ArgumentError(f"{name}: expected an array, got {type(given).__name__}")
    shape = tuple(map(int, given.shape))
    try:
        dtype = np.dtype(given.dtype)
    except TypeError:  # of a package that has types of its own
        dtype = np.asarray(given[:1]).dtype
    _expect_numbers(name, dtype)
    if len(shape) not in (3, 4):
        raise ArgumentError(f"{name}: the shape {shape}, expected (t, z, y, x) or (z, y, x)")
    masked = isinstance(given, np.ma.MaskedArray) and dtype.kind != "f"
    if masked:
        dtype = np.dtype(np.float32 if dtype.itemsize < 4 else np.float64)
    dims = ("time", "z", "y", "x")[-len(shape) :]
    load = (lambda step: given[step]) if len(shape) == 4 else (lambda step: given[...])
    return _Array(dims, shape, dtype, _no_gaps(dtype), load)


def _of_steps(given: Sequence[Any], name: str) -> _Array:
    steps = [_array(each, name) for each in given if not isinstance(each, Sequence)]
    if not steps or len(steps) != len(given):
        raise ArgumentError(f"{name}: expected an array, or a list of arrays (z, y, x), one for each step")
    for number, step in enumerate(steps):
        if len(step.shape) != 3 or step.shape != steps[0].shape or step.dtype != steps[0].dtype:
            raise ArgumentError(
                f"{name}: step {number} is {step.dtype} {step.shape}, expected {steps[0].dtype} {steps[0].shape[-3:]} "
                "as of step 0"
            )
    first = steps[0]
    return _Array(("time", *first.dims), (len(steps), *first.shape), first.dtype, first.attributes,
                  lambda step: steps[step].load(0))  # fmt: skip
