"""Indexes, built of files or of arrays."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, SupportsIndex, Union

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _native
from ._arguments import Crop, Number, Steps, crop_word, number, numbers, option, steps_word, whole, word
from ._errors import ArgumentError, Error
from ._run import Run

if TYPE_CHECKING:
    import xarray

Path = Union[str, "os.PathLike[str]"]
#: What has values, beside files: arrays of NumPy or dask, or others that are cut as these are.
Arrays = Any
#: Along z, y and x, or by the names of the axes.
Along = Union[Sequence[Number], Mapping[str, Number]]

_TYPES = {"i1": "i8", "u1": "u8", "i2": "i16", "u2": "u16", "i4": "i32", "f4": "f32", "f8": "f64"}


def build(
    files: Path | Iterable[Path] | xarray.DataArray | xarray.Dataset | Arrays,
    out: Path,
    *,
    array: str | Iterable[str] | None = None,
    all_arrays: bool = False,
    component: SupportsIndex | str | None = None,
    member: SupportsIndex | None = None,
    spacing: Along | None = None,
    origin: Sequence[Number] | None = None,
    times: Sequence[Any] | NDArray[Any] | None = None,
    time_step: Number | None = None,
    length_unit: str | None = None,
    time_unit: str | None = None,
    value_unit: str | None = None,
    crop: Crop | None = None,
    stride: SupportsIndex | Along | str | None = None,
    steps: Steps | None = None,
    resample: Along | str | None = None,
    times_from_names: bool = False,
    dates: str | None = None,
    keep_first: bool = False,
    extra_axis_is_time: bool = False,
    allow_surplus: bool = False,
    allow: Path | Iterable[Path] = (),
    patience: SupportsIndex | None = None,
    dims: Sequence[SupportsIndex] | None = None,
    type: DTypeLike | None = None,
    big_endian: bool = False,
    header_bytes: SupportsIndex | None = None,
    color: str | None = None,
    color_component: SupportsIndex | str | None = None,
    color_unit: str | None = None,
    tiers: str | Iterable[str] | None = None,
    codec: str | None = None,
    lattice: SupportsIndex | None = None,
    max_variation: SupportsIndex | None = None,
    append: bool = False,
    refer: bool = False,
    threads: SupportsIndex | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> Run:
    """Indexes a series of volumes, as `isochron build` does, and opens the index.

    files: names, or patterns (`t*.vti`), of all steps in any order. Or arrays, one step in memory at a time:
        an xarray.DataArray or Dataset, whose axes, units and calendar mean what they would in a NetCDF file;
        an array (t, z, y, x) or (z, y, x) of NumPy, dask, h5py or zarr; a list of such arrays, one for each step;
        or {name: array, ...}.
    array: the name of the array to index, or several names; None if there is one. It names an array that has no name.
    all_arrays: every array that has the shape of the first.
    component: of vectors: its number from 0, "magnitude", "vorticity" or "q-criterion"; of scalars "gradient".
    spacing: distances between vertices along z, y and x, as Run.spacing, or {"x": 0.5, "y": 0.5, "z": 2}.
    origin: the place (x, y, z) of the first vertex, as Run.origin.
    times: of the steps, as numbers or dates; time_step: the time between steps.
    length_unit, time_unit, value_unit: `mm`, `s` or `days since 2000-01-01`, `K`.
    crop: vertices to keep: {"x": slice(0, 32)}, slices along z, y and x as numpy.s_ makes them, or
        "X0:X1,Y0:Y1,Z0:Z1" with both ends as for the program. Files need the ends of all axes.
    stride: every second vertex, or every so manieth along z, y and x. steps: slice(0, 21, 5), or "0:20:5" with both ends.
    resample: vertices along z, y and x onto which other grids are interpolated, or "cell": by the smallest cell.
    member: which run of an ensemble, from 0. dates: "dmy" or "mdy", of dates whose year is last.
    times_from_names, keep_first, extra_axis_is_time, allow_surplus, allow, patience: as `isochron build --help` says.
    dims, type, big_endian, header_bytes: of headerless raw files: dims is (nx, ny, nz), x fastest, type such as
        "f32" or numpy.float32. Arrays and other files are converted to the type.
    color, color_component, color_unit: a second array, to color surfaces by.
    tiers: "bricks", "tree" or "none"; codec: "none", "lz4" or "zstd"; lattice, max_variation: of the paper's tree.
    append: adds the steps that the index does not hold yet; all steps are given, the held ones first.
    refer: stores references to the files instead of a copy of their values.
    progress: called as progress(phase, fraction) now and then; what it raises ends the build, as Ctrl-C does,
        and leaves no index behind.
    """
    names = [] if array is None else [array] if isinstance(array, str) else list(array)
    arrays, paths = _arrays_or_files(files, names)
    if arrays is not None:
        for name, given in (("refer", refer), ("dims", dims), ("big_endian", big_endian), ("header_bytes", header_bytes),
                            ("times_from_names", times_from_names), ("resample", resample)):  # fmt: skip
            if given not in (None, False):
                raise ArgumentError(f"{name}: is for files, and arrays were given")
        if names and len(arrays.arrays) == 1 and arrays.unnamed:
            arrays.rename(names[0])
    shape = arrays.shape() if arrays is not None else None
    words = [each for name in names for each in option("array", name)]
    for name, on in (("all_arrays", all_arrays), ("times_from_names", times_from_names), ("keep_first", keep_first),
                     ("extra_axis_is_time", extra_axis_is_time), ("allow_surplus", allow_surplus),
                     ("big_endian", big_endian), ("append", append), ("refer", refer)):  # fmt: skip
        words += option(name, bool(on))
    for name, text in (("component", component), ("length_unit", length_unit), ("value_unit", value_unit),
                       ("color", color), ("color_component", color_component), ("color_unit", color_unit),
                       ("codec", codec), ("dates", dates), ("member", member), ("patience", patience),
                       ("header_bytes", header_bytes), ("lattice", lattice), ("max_variation", max_variation),
                       ("threads", threads)):  # fmt: skip
        if text is not None:
            words += option(name, text if isinstance(text, str) else whole(text, name))
    if tiers is not None:
        words += option("tiers", tiers if isinstance(tiers, str) else ",".join(tiers) or "none")
    if type is not None:
        words += option("type", _type_name(type))
    if time_step is not None:
        words += option("time_step", word(number(time_step, "time_step")))
    if dims is not None:
        words += ["--dims", *map(word, numbers(dims, "dims", 3))]
    if origin is not None:
        words += ["--origin", *map(word, numbers(origin, "origin", 3))]
    if spacing is not None:
        words += ["--spacing", *map(word, _along(spacing, "spacing"))]
    if isinstance(resample, str):
        if resample != "cell":
            raise ArgumentError(f"resample: expected three numbers of vertices or 'cell', got {resample!r}")
        words.append("--resample-by-cell")
    elif resample is not None:
        words += ["--resample", *map(word, _along(resample, "resample"))]
    if isinstance(stride, str):
        words += option("stride", stride)
    elif stride is not None:
        every: Any = stride
        along = isinstance(stride, Mapping) or np.ndim(every) > 0
        every = _along(every, "stride") if along else [whole(every, "stride")]
        words += option("stride", ",".join(map(word, every)))
    if crop is not None:
        words += option("crop", crop_word(crop, shape[1:] if shape else None))
    if steps is not None:
        words += option("steps", steps_word(steps, shape[0] if shape else None))
    for folder in [allow] if isinstance(allow, (str, os.PathLike)) else allow:
        words += option("allow", os.fspath(folder))
    moments: list[float] = []
    if times is not None:
        moments, unit = _times(times, time_unit)
        time_unit = unit or time_unit
    words += option("time_unit", time_unit)
    if arrays is None:
        _native.build(paths, os.fspath(out), words, moments, None, progress)
    else:
        with arrays.described() as (description, label):
            try:
                _native.build([], os.fspath(out), words, moments, (description, arrays.pieces, label), progress)
            except Error as error:
                raise error.__class__(str(error).replace(description, label)) from None
    return Run(out)


def _arrays_or_files(given: Any, names: Sequence[str]) -> tuple[Any, list[str]]:
    if isinstance(given, (str, os.PathLike)):
        return None, [os.fspath(given)]
    if not hasattr(given, "shape") and not isinstance(given, Mapping):
        if not isinstance(given, Iterable):
            raise ArgumentError(f"files: expected names of files or arrays, got {given!r}")
        lazy = not isinstance(given, Sequence)
        several: list[Any] = []
        for each in given:
            if lazy and not isinstance(each, (str, os.PathLike)):
                raise ArgumentError("files: arrays come one after the other from an iterator, expected a list of them, "
                                    "or an array that reads its steps when they are asked for, as dask's")  # fmt: skip
            several.append(each)
        if all(isinstance(each, (str, os.PathLike)) for each in several):
            return None, [os.fspath(each) for each in several]
        given = several
    from ._arrays import arrays_of

    return arrays_of(given, names), []


def _along(value: Along, name: str) -> list[float]:
    """Along x, y and z, as the program has it."""
    if isinstance(value, Mapping):
        if set(value) != set("xyz"):
            raise ArgumentError(f"{name}: expected one for each of x, y and z, got {value!r}")
        return [number(value[axis], name) for axis in "xyz"]
    return numbers(value, name, 3)[::-1]


def _type_name(type: Any) -> str:
    if isinstance(type, str) and type in _TYPES.values():
        return type
    try:
        kind = np.dtype(type).str[1:]
    except TypeError:
        kind = ""
    if kind not in _TYPES:
        raise ArgumentError(f"type: expected one of {', '.join(_TYPES.values())} or NumPy's types for them, got {type!r}")
    return _TYPES[kind]


def _times(times: Any, unit: str | None) -> tuple[list[float], str | None]:
    """Numbers, and their unit where dates say it."""
    given = np.asarray(times)
    if given.ndim != 1:
        raise ArgumentError(f"times: expected one for each step, got {given.ndim} dimensions")
    if given.dtype.kind == "M" or given.size and hasattr(given[0], "timetuple"):
        from ._arguments import date_number

        unit = unit if unit and " since " in unit else f"seconds since {str(given[0]).replace('T', ' ')[:19]}"
        return [date_number(date, unit) for date in given], unit
    return [number(time, "times") for time in given], None
