"""An open index."""

from __future__ import annotations

import json
import operator
import os
import warnings
from collections.abc import Iterator, Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _native
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
        self._path = os.fspath(path)
        self._place = os.path.abspath(self._path)
        self._native: _native.OpenRun | None = _native.OpenRun(self._path)
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
        return self._about["notes"]

    def range(self, array: str | None = None) -> tuple[float, float]:
        """The lowest and the highest value of all steps."""
        return self._array(array).description()["range"]

    def cells(
        self, isovalue: float, step: int = 0, *, fraction: int = 0, array: str | None = None
    ) -> NDArray[np.uint32]:
        """The numbers of the active cells, ascending: those with min < isovalue <= max over their eight vertices.

        Cell (x, y, z) of a step of shape (nz, ny, nx) has the number (z * (ny - 1) + y) * (nx - 1) + x, which
        numpy.unravel_index(cells, (nz - 1, ny - 1, nx - 1)) takes apart. The array is read-only and owns its memory. It
        is of type uint64 where a step has 2^32 cells or more. `fraction`: so many 65536ths of the way to the next step,
        where values are blended linearly and compared exactly.
        """
        return self._array(array).cells(step, fraction, isovalue)

    def change(
        self,
        isovalue: float,
        step: int = 0,
        to_step: int | None = None,
        to_isovalue: float | None = None,
        *,
        fraction: int = 0,
        to_fraction: int | None = None,
        array: str | None = None,
    ) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """The cells that become active, and those that cease to be, from one moment or isovalue to another.

        Moments are steps and 65536ths of the way to the next one, as for `cells`; `to_fraction` is the same as
        `fraction` unless it or `to_step` is given.
        """
        same = fraction if to_step is None else 0
        return self._array(array).change(
            step,
            fraction,
            isovalue,
            step if to_step is None else to_step,
            same if to_fraction is None else to_fraction,
            isovalue if to_isovalue is None else to_isovalue,
        )

    def mesh(
        self,
        isovalue: float,
        step: int = 0,
        *,
        fraction: int = 0,
        array: str | None = None,
        dtype: DTypeLike = np.float32,
    ) -> tuple[NDArray[Any], NDArray[np.uint32]]:
        """The isosurface as points (N, 3) and triangles (M, 3) of numbers of points.

        With float32 points count from `origin`; with float64 they are absolute. Triangles are counter-clockwise as
        seen from the side of lower values, and neighbors share their points. `fraction`: as for `cells`.
        """
        kind = np.dtype(dtype)
        if kind not in (np.dtype(np.float32), np.dtype(np.float64)):
            raise TypeError(f"dtype: expected float32 or float64, got {kind}")
        return self._array(array).mesh(step, fraction, isovalue, kind == np.float64)

    def values(
        self,
        step: int = 0,
        z: slice | int = slice(None),
        y: slice | int = slice(None),
        x: slice | int = slice(None),
        *,
        fraction: int = 0,
        array: str | None = None,
    ) -> NDArray[Any]:
        """The values at vertices, (z, y, x), a whole step or a part: only the chunks in which it lies are read.

        Whole numbers drop their axis, as NumPy's do. The type is that of the file, and float64 if its values have to be
        scaled.
        Between two steps (`fraction`, as for `cells`) it is float64: the greatest number that is not above the exact
        blend, and NaN where a value of the two steps is missing or infinite.
        """
        of = self._array(array)
        about = of.description() if array is not None else self._about
        box: list[tuple[int, int]] = []
        rest: list[slice | int] = []
        for name, wanted, size in zip("zyx", (z, y, x), self.shape[1:]):
            if isinstance(wanted, slice):
                places = range(*wanted.indices(size))
                first, end = (min(places[0], places[-1]), max(places[0], places[-1]) + 1) if places else (0, 0)
                box.append((first, end))
                rest.append(slice(None, None, places.step))
            else:
                place = operator.index(wanted)
                if not -size <= place < size:
                    raise IndexError(f"{name}: vertex {place}, expected {-size} to {size - 1}")
                box.append((place % size, place % size + 1))
                rest.append(0)
        stored = of.values(step, fraction, box)[tuple(rest)]
        if fraction != 0:
            return stored
        if about["slope"] == 1 and about["intercept"] == 0:
            return stored
        scaled = stored.astype(np.float64)  # before NumPy 2, a factor does not widen float32
        scaled *= about["slope"]
        scaled += about["intercept"]
        return scaled

    def to_xarray(self) -> xarray.Dataset:
        """The arrays as a Dataset with coordinates and units; values are read when they are needed."""
        from ._xarray import dataset

        return dataset(self)

    def render(
        self, state: Mapping[str, Any] | str | os.PathLike[str] | None = None, *, size: tuple[int, int] = (1280, 720)
    ) -> NDArray[np.uint8]:
        """A picture (height, width, 3) in sRGB, which the program draws without a window.

        state: what differs from a new session, by the keys of a recording's `start`: {"step": 7, "isovalue": 0.5,
            "look": {"background": "light", "material": "satin", "occlusion": 0.6}}; or the name of a file in which the
            program saved a session.
        """
        from ._render import render

        self._array(None)
        shown: Mapping[str, Any] = {}
        if isinstance(state, (str, os.PathLike)):
            with open(state, encoding="utf-8") as file:
                shown = json.load(file)["state"]
        elif state is not None:
            shown = state
        return render(self._place, shown, size)

    def close(self) -> None:
        """Closes the index; arrays that it gave stay valid."""
        self._native = None

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, number: int) -> Step:
        at = operator.index(number)
        if not -len(self) <= at < len(self):
            raise IndexError(f"{self._path}: step {at}, expected 0 to {len(self) - 1}")
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

    def _array(self, name: str | None) -> _native.RunArray:
        if self._native is None:
            raise _native.Error(f"{self._path}: is closed")
        return self._native.array(name)
