"""The steps of a run, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, SupportsIndex, overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ._arguments import Isovalues, Number, several
from ._mesh import Mesh

if TYPE_CHECKING:
    from ._run import Run


class _Ahead:
    """Asks of the next step, in the background, what was asked of a step. Holds the answers of one step."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="isochron")
        self._answers: list[tuple[tuple[Any, ...], Future[Any]]] = []
        self._open = True

    def begin(self, number: int) -> None:
        """Forgets the answers of other steps, which nobody has asked for."""
        for question, answer in self._answers:
            if question[1] != number:
                answer.cancel()
        self._answers = [one for one in self._answers if one[0][1] == number]

    def ask(self, name: str, number: int, options: dict[str, Any]) -> Any:
        question = (name, number, options)
        answer = next((future for asked, future in self._answers if asked == question), None)
        result = answer.result() if answer else getattr(self._run, name)(step=number, **options)
        following = (name, number + 1, options)
        if self._open and number + 1 < len(self._run) and all(asked != following for asked, _ in self._answers):
            future = self._worker.submit(getattr(self._run, name), step=number + 1, **options)
            self._answers.append((following, future))
        return result

    def close(self) -> None:
        self._open = False
        self._worker.shutdown(cancel_futures=True)


class Step:
    """One step of a run, with the run's functions."""

    def __init__(self, run: Run, number: int, ahead: _Ahead | None = None) -> None:
        self._run = run
        self._number = number
        self._ahead = ahead

    @property
    def number(self) -> int:
        """From 0."""
        return self._number

    @property
    def time(self) -> float:
        """In the run's `time_unit`."""
        return float(self._run.times[self._number])

    @overload
    def cells(
        self, isovalue: Isovalues, *, fraction: Number | None = ..., level: SupportsIndex = ..., array: str | None = ...
    ) -> list[NDArray[np.uint32]]: ...
    @overload
    def cells(
        self, isovalue: Number, *, fraction: Number | None = ..., level: SupportsIndex = ..., array: str | None = ...
    ) -> NDArray[np.uint32]: ...
    def cells(
        self,
        isovalue: Number | Isovalues,
        *,
        fraction: Number | None = None,
        level: SupportsIndex = 0,
        array: str | None = None,
    ) -> NDArray[np.uint32] | list[NDArray[np.uint32]]:
        """As Run.cells."""
        cells: NDArray[np.uint32] | list[NDArray[np.uint32]] = self._ask(
            "cells", isovalue=_plain(isovalue), fraction=fraction, level=level or None, array=array
        )
        return cells

    @overload
    def mesh(
        self,
        isovalue: Isovalues,
        *,
        fraction: Number | None = ...,
        level: SupportsIndex = ...,
        array: str | None = ...,
        dtype: DTypeLike = ...,
        normals: bool = ...,
        values: str | None = ...,
    ) -> list[Mesh]: ...
    @overload
    def mesh(
        self,
        isovalue: Number,
        *,
        fraction: Number | None = ...,
        level: SupportsIndex = ...,
        array: str | None = ...,
        dtype: DTypeLike = ...,
        normals: bool = ...,
        values: str | None = ...,
    ) -> Mesh: ...
    def mesh(
        self,
        isovalue: Number | Isovalues,
        *,
        fraction: Number | None = None,
        level: SupportsIndex = 0,
        array: str | None = None,
        dtype: DTypeLike = np.float32,
        normals: bool = False,
        values: str | None = None,
    ) -> Mesh | list[Mesh]:
        """As Run.mesh."""
        mesh: Mesh | list[Mesh] = self._ask(
            "mesh", isovalue=_plain(isovalue), fraction=fraction, level=level or None, array=array, dtype=dtype,
            normals=normals, values=values,
        )  # fmt: skip
        return mesh

    def values(
        self,
        z: slice | SupportsIndex = slice(None),
        y: slice | SupportsIndex = slice(None),
        x: slice | SupportsIndex = slice(None),
        *,
        fraction: Number | None = None,
        level: SupportsIndex = 0,
        array: str | None = None,
    ) -> NDArray[Any]:
        """As Run.values."""
        values: NDArray[Any] = self._ask("values", z=z, y=y, x=x, fraction=fraction, level=level or None, array=array)
        return values

    def __repr__(self) -> str:
        return f"<isochron.Step {self._number} of {self._run.path}>"

    def _ask(self, name: str, **options: Any) -> Any:
        options = {
            key: value for key, value in options.items() if key == "isovalue" or (value is not None and value is not False)
        }
        if self._ahead is None:
            return getattr(self._run, name)(step=self._number, **options)
        return self._ahead.ask(name, self._number, options)


def _plain(isovalue: Number | Isovalues) -> Number | Isovalues:
    """So that what was asked can be compared."""
    return tuple(isovalue) if several(isovalue) else isovalue  # type: ignore[arg-type]


def iterate(run: Run) -> Iterator[Step]:
    """The steps in order, each asked ahead while the caller works on the one before."""
    ahead = _Ahead(run)
    try:
        for number in range(len(run)):
            ahead.begin(number)
            yield Step(run, number, ahead)
    finally:
        ahead.close()
