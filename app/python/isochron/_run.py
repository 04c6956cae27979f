"""An open index."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any, SupportsIndex, overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _native
from ._arguments import (
    PROFILE, Crop, Isovalues, Number, Steps, T, Time,
    clip_plane, crop_box, least_cells, moment, number, numbers, path, several, span, time_number, whole,
)  # fmt: skip
from ._elsewhere import RUN, unknown
from ._errors import ArgumentError, Error, PlaceError, in_parameters, missing
from ._html import table
from ._mesh import Mesh
from ._steps import Step, iterate

if TYPE_CHECKING:
    import xarray


class Run:
    """An open index: a series of volumes on one grid, with one array of values or several.

    Arrays of values are (z, y, x), and so are `shape`, behind the number of steps, and `spacing`. Points are (x, y, z),
    and so is `origin`. Steps count from 0. `for step in run` gives one step after the other, and asks in the background
    of the next step what was asked of the last.

    A run can be pickled: the file is opened again, from any working folder. Several threads may use it at once; what
    searches, reads or builds lets the others of the interpreter run.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = _native.address_of(os.fspath(path))
        if "\0" in self._path:
            raise ArgumentError("path: expected no null character")
        self._native: _native.OpenRun | None = _native.OpenRun(self._path)
        self._place = self._path if _native.is_link(self._path) else os.path.abspath(self._path)
        self._names = tuple(self._native.names())
        self._about = self._native.array(None).description()
        lost = self._native.lost()
        if lost is not None:
            warnings.warn(lost, RuntimeWarning, stacklevel=3)

    @property
    def path(self) -> str:
        """The name of the file, as it was given."""
        return self._path

    @property
    def arrays(self) -> tuple[str, ...]:
        """The names of the arrays; the first is meant where none is named."""
        return self._names

    @property
    def times(self) -> NDArray[np.float64]:
        """The time of each step, increasing, in `time_unit`; the number of the step where the files say none."""
        return self._about["times"]

    @property
    def time_unit(self) -> str:
        """`s`, or `days since 2000-01-01`; empty if it is not known."""
        return self._about["time_unit"]

    @property
    def unit(self) -> str:
        """The unit of the values of the first array; empty if it is not known."""
        return self._about["unit"]

    @property
    def length_unit(self) -> str:
        """The unit of `spacing`, `origin` and points; empty if it is not known."""
        return self._about["length_unit"]

    @property
    def shape(self) -> tuple[int, int, int, int]:
        """Numbers of steps, and of vertices along z, y and x."""
        return self._about["shape"]

    @property
    def spacing(self) -> tuple[float, float, float]:
        """Distances between vertices along z, y and x; their mean where they are not even."""
        return self._about["spacing"]

    @property
    def origin(self) -> tuple[float, float, float]:
        """The place (x, y, z) of the first vertex, from which points in single precision count."""
        return self._about["origin"]

    @property
    def direction(self) -> tuple[tuple[float, float, float], ...]:
        """A matrix, row by row; its columns are the unit vectors of the axes x, y and z of the grid."""
        return self._about["direction"]

    @property
    def notes(self) -> tuple[str, ...]:
        """What the files state and is not used, or was changed when they were indexed."""
        return tuple(map(in_parameters, self._about["notes"]))

    @property
    def anatomy(self) -> str:
        """What the axes x, y and z of space point to: `RAS` or `LPS` (right or left, ...) in a body, `ENU` (east, north,
        up) on the Earth; empty if the files do not say."""
        return self._about["anatomy"]

    @property
    def axis_names(self) -> tuple[str, str, str]:
        """What the axes x, y and z of space are called: `longitude (degrees)`; empty where they have no other name."""
        return self._about["axis_names"]

    @property
    def levels(self) -> tuple[tuple[int, int, int], ...]:
        """Vertices along z, y and x at each level of detail: of the volume itself, of half as many along each axis, ..."""
        return tuple((len(z), len(y), len(x)) for z, y, x in self._about["levels"])

    def range(self, array: str | None = None) -> tuple[float, float]:
        """The lowest and the highest value of all steps."""
        return self._array(array).description()["range"]

    def step_at(self, time: Time) -> int:
        """The step whose time is the nearest to this one, which may be a date."""
        return int(np.abs(self.times - time_number(self, time)).argmin())

    @overload
    def cells(
        self,
        isovalue: Isovalues,
        step: SupportsIndex | None = ...,
        *,
        time: Time = ...,
        fraction: Number | None = ...,
        level: SupportsIndex = ...,
        array: str | None = ...,
    ) -> list[NDArray[np.uint32]]: ...
    @overload
    def cells(
        self,
        isovalue: Number,
        step: SupportsIndex | None = ...,
        *,
        time: Time = ...,
        fraction: Number | None = ...,
        level: SupportsIndex = ...,
        array: str | None = ...,
    ) -> NDArray[np.uint32]: ...
    def cells(
        self,
        isovalue: Number | Isovalues,
        step: SupportsIndex | None = None,
        *,
        time: Time = None,
        fraction: Number | None = None,
        level: SupportsIndex = 0,
        array: str | None = None,
    ) -> NDArray[np.uint32] | list[NDArray[np.uint32]]:
        """The numbers of the active cells, ascending: those with min < isovalue <= max over their eight vertices.

        Cell (x, y, z) of a step of shape (nz, ny, nx) has the number (z * (ny - 1) + y) * (nx - 1) + x, which
        numpy.unravel_index(cells, (nz - 1, ny - 1, nx - 1)) takes apart. The array is read-only and owns its memory. It
        is of type uint64 where a step has 2^32 cells or more.

        isovalue: in the unit of the values; of several isovalues, the result is a list.
        step: from 0; the first one if no moment is named.
        time: the moment instead, in the run's `time_unit`, or as a date.
        fraction: of the way to the next step: a share where it has a decimal point (0.5 is half way), or a whole number
            of 65536ths. Values are blended linearly and compared exactly.
        level: of detail; `levels` has their shapes.
        """
        of, at, detail = self._array(array), moment(self, step, fraction, time), self._level(level)
        return _each(isovalue, lambda value: of.cells(*at, value, detail))

    def change(
        self,
        isovalue: Number,
        step: SupportsIndex | None = None,
        to_step: SupportsIndex | None = None,
        to_isovalue: Number | None = None,
        *,
        time: Time = None,
        to_time: Time = None,
        fraction: Number | None = None,
        to_fraction: Number | None = None,
        array: str | None = None,
    ) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """The cells that become active, and those that cease to be, from one moment or isovalue to another.

        Moments are as for `cells`; where nothing is said of the second one, it is the same as the first.
        """
        value = number(isovalue, "isovalue")
        at = moment(self, step, fraction, time)
        to = at
        if to_step is not None or to_time is not None:
            to = moment(self, to_step, to_fraction, to_time)
        elif to_fraction is not None:
            to = moment(self, at[0], to_fraction, None)
        to_value = value if to_isovalue is None else number(to_isovalue, "to_isovalue")
        return self._array(array).change(*at, value, *to, to_value)

    @overload
    def mesh(
        self,
        isovalue: Isovalues,
        step: SupportsIndex | None = ...,
        *,
        time: Time = ...,
        fraction: Number | None = ...,
        level: SupportsIndex = ...,
        array: str | None = ...,
        dtype: DTypeLike = ...,
        normals: bool = ...,
        values: str | None = ...,
        dust: SupportsIndex = ...,
    ) -> list[Mesh]: ...
    @overload
    def mesh(
        self,
        isovalue: Number,
        step: SupportsIndex | None = ...,
        *,
        time: Time = ...,
        fraction: Number | None = ...,
        level: SupportsIndex = ...,
        array: str | None = ...,
        dtype: DTypeLike = ...,
        normals: bool = ...,
        values: str | None = ...,
        dust: SupportsIndex = ...,
    ) -> Mesh: ...
    def mesh(
        self,
        isovalue: Number | Isovalues,
        step: SupportsIndex | None = None,
        *,
        time: Time = None,
        fraction: Number | None = None,
        level: SupportsIndex = 0,
        array: str | None = None,
        dtype: DTypeLike = np.float32,
        normals: bool = False,
        values: str | None = None,
        dust: SupportsIndex = 0,
    ) -> Mesh | list[Mesh]:
        """The isosurface as points (N, 3) and triangles (M, 3) of numbers of points; several are a list.

        With float32 points count from `origin`; with float64 they are absolute. Triangles are counter-clockwise as
        seen from the side of lower values, and neighbors share their points. The result is a pair,
        `points, faces = run.mesh(...)`, that also is a `Mesh`, with `to_vtk` and `to_pyvista`.

        isovalue, step, time, fraction, level: as for `cells`.
        normals: whether the mesh gets `normals`: (N, 3), of length 1, towards lower values.
        values: the name of another array, whose values at the points the mesh gets.
        dust: leaves out the connected pieces of fewer active cells, at level 0.
        """
        kind = np.dtype(dtype)
        if kind not in (np.dtype(np.float32), np.dtype(np.float64)):
            raise ArgumentError(f"dtype: expected float32 or float64, got {kind}")
        of, at, detail = self._array(array), moment(self, step, fraction, time), self._level(level)
        absolute = bool(kind == np.float64)
        if values is not None and (detail > 0 or values not in self._names):
            where = f"of {', '.join(self._names)}, and level 0"
            raise ArgumentError(f"values: expected the name of an array {where}, got {values!r} at level {detail}")

        least = least_cells(dust)
        if least and detail > 0:
            raise ArgumentError(f"dust: expected level 0, where pieces are told apart, got level {detail}")

        def one(value: float) -> Mesh:
            points, faces, towards, others = of.mesh(*at, value, absolute, detail, bool(normals), values, least)
            return Mesh(
                points,
                faces,
                normals=towards,
                values=others,
                values_name=values or "values",
                origin=(0.0, 0.0, 0.0) if absolute else self.origin,
                isovalue=value,
            )

        return _each(isovalue, one)

    def first_crossings(
        self, isovalue: Number, *, blended: bool = False, array: str | None = None
    ) -> NDArray[np.float64]:
        """The time at which each cell is first active, in `time_unit`: (nz - 1, ny - 1, nx - 1), NaN where it never is.

        blended: also between the steps, where values are blended linearly; else the times are those of steps.

        Every step is searched, and two bytes for each cell, ten with the result, are held in memory.
        """
        steps, fractions = self._array(array).first_crossings(number(isovalue, "isovalue"), bool(blended))
        times = np.append(self.times, np.nan)
        never = steps == np.iinfo(np.uint16).max
        steps = np.where(never, len(times) - 1, steps).astype(np.intp)
        found = times[steps]
        if fractions is not None:
            following = times[np.minimum(steps + 1, len(self.times) - 1)]
            found += np.where(never, 0, fractions / 65536 * (following - found))
        return found.reshape([length - 1 for length in self.shape[1:]])

    def measure(
        self,
        isovalue: Number,
        step: SupportsIndex | None = None,
        *,
        time: Time = None,
        fraction: Number | None = None,
        array: str | None = None,
        on_surface: str | None = None,
        crop: Crop | None = None,
        clip: Sequence[Number] | None = None,
        dust: SupportsIndex = 0,
        place: Sequence[Number] | None = None,
    ) -> dict[str, float]:
        """Numbers of the surface: area, volume, pieces and more, by their names.

        `isochron measure --help` says what each is; areas and volumes are in powers of `length_unit`. What is not
        defined is NaN.

        isovalue, step, time, fraction: as for `cells`.
        on_surface: the name of another array, for `mean`, `least` and `greatest` on the surface.
        crop: vertices as for `build`: only the cells among them are measured, as if there were no others.
        clip: (x, y, z, nx, ny, nz): only what is not beyond the plane in this point, where the normal points to: the
            surface, cut without a cap, and volumes, exactly.
        dust: leaves out the connected pieces of fewer active cells.
        place: (x, y, z), for `distance`: from there to the nearest point of the surface.
        """
        at, box = moment(self, step, fraction, time), crop_box(crop, self.shape[1:])
        of, value, plane, least = self._array(array), number(isovalue, "isovalue"), clip_plane(clip), least_cells(dust)
        start = None if place is None else numbers(place, "place", 3)
        found, _ = of.measure(*at, value, on_surface, False, box, plane, least, start)
        return dict(zip(_measures(), found))

    def measures(
        self,
        isovalue: Number,
        steps: SupportsIndex | slice | Sequence[int] | None = None,
        *,
        array: str | None = None,
        on_surface: str | None = None,
        crop: Crop | None = None,
        clip: Sequence[Number] | None = None,
        dust: SupportsIndex = 0,
        place: Sequence[Number] | None = None,
    ) -> NDArray[np.void]:
        """`measure` of each step: a structured array with the fields step, time and those of `measure`.

        steps: one, a slice or a range; None: all.
        """
        first, last, stride = span(slice(None) if steps is None else steps, "steps", len(self))
        how: dict[str, Any] = {
            "array": array, "on_surface": on_surface, "crop": crop, "clip": clip, "dust": dust, "place": place,
        }  # fmt: skip
        rows = [
            (step, float(self.times[step]), *self.measure(isovalue, step, **how).values())
            for step in range(first, last + 1, stride)
        ]
        fields = [("step", np.int64), ("time", np.float64), *((each, np.float64) for each in _measures())]
        return np.array(rows, fields)

    def pieces(
        self,
        isovalue: Number,
        step: SupportsIndex | None = None,
        *,
        time: Time = None,
        fraction: Number | None = None,
        array: str | None = None,
        crop: Crop | None = None,
        clip: Sequence[Number] | None = None,
        dust: SupportsIndex = 0,
    ) -> NDArray[np.void]:
        """The connected pieces of the surface, the largest area first: a structured array.

        Fields: triangles, area, volume (what the piece encloses: negative around lower values, NaN unless closed),
        euler, closed (1 or 0), and x, y, z each of centroid (weighted by area), low and high (its extent).

        dust: leaves out pieces of fewer active cells.
        """
        at, box = moment(self, step, fraction, time), crop_box(crop, self.shape[1:])
        of, value, plane, least = self._array(array), number(isovalue, "isovalue"), clip_plane(clip), least_cells(dust)
        _, rows = of.measure(*at, value, None, True, box, plane, least, None)
        place = (np.float64, 3)
        kind = np.dtype([
            ("triangles", np.float64), ("area", np.float64), ("volume", np.float64), ("euler", np.float64),
            ("closed", np.float64), ("centroid", *place), ("low", *place), ("high", *place),
        ])  # fmt: skip
        return np.ascontiguousarray(rows).view(kind).reshape(len(rows))

    def profile(
        self,
        *places: Sequence[Number],
        step: SupportsIndex | None = None,
        time: Time = None,
        fraction: Number | None = None,
        array: str | None = None,
    ) -> NDArray[np.void]:
        """The values along straight lines from place to place, as a ruler in the window has them: a structured array of
        513 samples, equally far from each other, with the fields distance, x, y, z and value.

        Values are trilinear between vertices, and NaN outside the data and where they are missing. There are no samples
        where all places are one.

        places: (x, y, z) each, absolute, in `length_unit`; two or more.
        step, time, fraction: as for `cells`.
        """
        rows = self._array(array).profile(*moment(self, step, fraction, time), path(places))
        return rows.view(PROFILE).reshape(len(rows))

    def values(
        self,
        step: SupportsIndex | None = None,
        z: slice | SupportsIndex = slice(None),
        y: slice | SupportsIndex = slice(None),
        x: slice | SupportsIndex = slice(None),
        *,
        time: Time = None,
        fraction: Number | None = None,
        level: SupportsIndex = 0,
        array: str | None = None,
    ) -> NDArray[Any]:
        """The values at vertices, (z, y, x), a whole step or a part: only the chunks in which it lies are read.

        Whole numbers drop their axis, as NumPy's do. The type is that of the file, and float64 if its values have to be
        scaled. Between two steps it is float64: the greatest number that is not above the exact blend, and NaN where a
        value of the two steps is missing or infinite.

        step, time, fraction: as for `cells`.
        level: of detail: values of coarser levels are weighted means of those of the level before.
        """
        of, detail = self._array(array), self._level(level)
        about = of.description() if array is not None else self._about
        at = moment(self, step, fraction, time)
        box: list[tuple[int, int]] = []
        rest: list[slice | int] = []
        for name, wanted, size in zip("zyx", (z, y, x), self.levels[detail]):
            if isinstance(wanted, slice):
                places = range(*wanted.indices(size))
                first, end = (min(places[0], places[-1]), max(places[0], places[-1]) + 1) if places else (0, 0)
                box.append((first, end))
                rest.append(slice(None, None, places.step))
            else:
                place = whole(wanted, name)
                if not -size <= place < size:
                    raise PlaceError(f"{name}: vertex {place}, expected {-size} to {size - 1}")
                box.append((place % size, place % size + 1))
                rest.append(0)
        stored = of.values(*at, box, detail)[tuple(rest)]
        if at[1] != 0:
            return stored
        if about["slope"] == 1 and about["intercept"] == 0:
            return stored
        scaled = stored.astype(np.float64)  # before NumPy 2, a factor does not widen float32
        scaled *= about["slope"]
        scaled += about["intercept"]
        return scaled

    def export(
        self,
        out: str | os.PathLike[str],
        isovalue: Number | Isovalues,
        *,
        steps: Steps | None = None,
        step: SupportsIndex | None = None,
        time: Time = None,
        fraction: Number | None = None,
        array: str | None = None,
        format: str | None = None,
        color_by: str | None = None,
        color_map: str | None = None,
        range: tuple[Number, Number] | None = None,
        double: bool = False,
        unit: str | None = None,
        rate: Number | None = None,
        crop: Crop | None = None,
        clip: Sequence[Number] | None = None,
        simplify: Number | str | None = None,
        dust: SupportsIndex = 0,
        quantize: bool = False,
        compress: bool = False,
        normals: bool = True,
        force: bool = False,
    ) -> dict[str, Any]:
        """Writes surfaces as files for other programs, as `isochron export` does, and says which: `files`, `cells`,
        `vertices`, `triangles`, `empty_steps` and more.

        out: a file whose name says its format: .ply, .stl, .obj, .vtp, .glb, .usda or .csv; of several steps each file
            gets a number. Or a folder with a slash at its end, with `format`.
        isovalue: one, or up to eight.
        steps: a number, slice(first, end, stride), which counts as Python's do, or all; step: one of them; time, fraction: as for `cells`.
        array: whose surfaces; the first if none is named.
        color_by, color_map, range: another array that colors the vertices, and the values at the ends of its colors.
        double: coordinates of double precision, where the format has them.
        unit: of length, for the coordinates; rate: steps a second, of formats that hold all steps.
        crop: as for `build`: triangles within these vertices alone.
        clip: (x, y, z, nx, ny, nz): nothing beyond the plane in this point, where the normal points to.
        simplify: how far the surface may move for fewer triangles: a length, or "0.5cells".
        dust: leaves out the connected pieces of fewer active cells.
        quantize, compress: smaller glTF. force: replaces files that exist.
        """
        from ._export import export

        if step is not None:
            if steps is not None:
                raise ArgumentError("step: expected without steps, which say the moments, too")
            steps = step
        return export(self, os.fspath(out), isovalue, steps, time, fraction, {
            "array": array, "format": format, "color_by": color_by, "color_map": color_map, "range": range,
            "precision": "double" if double else None, "unit": unit, "rate": rate, "crop": crop, "clip": clip,
            "simplify": simplify, "dust": least_cells(dust) or None, "quantize": quantize, "compress": compress,
            "no_normals": not normals, "force": force,
        })  # fmt: skip

    def to_xarray(self, *, decode_times: bool = False) -> xarray.Dataset:
        """The arrays as a Dataset with coordinates and units; values are read when they are needed.

        decode_times: times with a reference date become dates, as xarray.open_dataset(..., engine="isochron") has them.
        """
        from ._xarray import dataset, decoded

        return decoded(dataset(self)) if decode_times else dataset(self)

    def render(
        self,
        state: Mapping[str, Any] | str | os.PathLike[str] | None = None,
        *,
        size: tuple[SupportsIndex, SupportsIndex] = (1280, 720),
        **fields: Any,
    ) -> NDArray[np.uint8]:
        """A picture (height, width, 3) in sRGB, which the program draws without a window.

        state: what differs from a new session, by the keys of a recording's `start`: {"step": 7, "isovalue": 0.5,
            "look": {"background": "light", "material": "satin", "occlusion": 0.6}}; or the name of a file in which the
            program saved a session.
        fields: the same by their names, `step=7, isovalue=0.5`, and what differs from `state`.
        """
        from ._render import render

        self._array(None)
        shown: Mapping[str, Any] = {}
        if isinstance(state, (str, os.PathLike)):
            shown = _saved_state(os.fspath(state))
        elif state is not None:
            shown = state
        shown = {**shown, **fields}
        width, height = (whole(length, "size") for length in size)
        return render(self._place, shown, (width, height), _native.authorization_for(self._place))

    def close(self) -> None:
        """Closes the index; arrays that it gave stay valid."""
        self._native = None

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            raise unknown(self, name, RUN)

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, number: SupportsIndex) -> Step:
        at = whole(number, "step")
        if not -len(self) <= at < len(self):
            raise PlaceError(f"{self._path}: step {at}, expected 0 to {len(self) - 1}")
        return Step(self, at % len(self))

    def __iter__(self) -> Iterator[Step]:
        return iterate(self)

    def __enter__(self) -> Run:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def __reduce__(self) -> tuple[type[Run], tuple[str], dict[str, str]]:
        return (Run, (self._place,), {"_path": self._path})

    def __repr__(self) -> str:
        steps, z, y, x = self.shape
        return f"<isochron.Run {self._path}: {', '.join(self._names)}; {steps} steps of {x} x {y} x {z} vertices>"

    def _repr_html_(self) -> str:
        steps, z, y, x = self.shape
        low, high = self._about["range"]
        unit = f" {self.unit}" if self.unit else ""
        rows = {
            "arrays": ", ".join(self._names),
            "vertices": f"{x} x {y} x {z}",
            "steps": f"{steps}, {self.times[0]:g} to {self.times[-1]:g} {self.time_unit}",
            f"values of {self._names[0]}": f"{low:g} to {high:g}{unit}",
            "spacing (x, y, z)": f"{', '.join(f'{one:g}' for one in reversed(self.spacing))} {self.length_unit}",
            "origin (x, y, z)": f"{', '.join(f'{one:g}' for one in self.origin)} {self.length_unit}",
        }
        if any(self.axis_names):
            rows["axes (x, y, z)"] = ", ".join(self.axis_names)
        if self.notes:
            rows["notes"] = "; ".join(self.notes)
        return table(f"isochron.Run {self._path}", rows)

    def _level(self, level: SupportsIndex) -> int:
        at = whole(level, "level")
        if not 0 <= at < len(self.levels):
            raise PlaceError(f"{self._path}: level {at}, expected 0 to {len(self.levels) - 1}")
        return at

    def _array(self, name: str | None) -> _native.RunArray:
        if self._native is None:
            raise Error(f"{self._path}: is closed")
        if name is not None and not isinstance(name, str):
            raise ArgumentError(f"array: expected a name, got {name!r}")
        if name is not None and name not in self._names:
            raise ArgumentError(f"{self._path}: no array {name}, expected {', '.join(self._names)}")
        return self._native.array(name)


def _measures() -> list[str]:
    """The names of all measures, as Python has them."""
    return [name.replace("-", "_") for name in _native.measure_names()]


def _each(isovalue: Number | Isovalues, answer: Callable[[float], T]) -> T | list[T]:
    """The answer to an isovalue, or a list of those to several."""
    if several(isovalue):
        return [answer(number(value, "isovalue")) for value in isovalue]  # type: ignore[union-attr]
    return answer(number(isovalue, "isovalue"))


def _saved_state(name: str) -> Mapping[str, Any]:
    try:
        with open(name, encoding="utf-8") as file:
            state: Mapping[str, Any] = json.load(file)["state"]
            return state
    except FileNotFoundError:
        raise missing(f"{name}: there is no such file") from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise Error(f"{name}: expected a session that the program saved: {error}") from None
