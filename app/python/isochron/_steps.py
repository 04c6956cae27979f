"""The steps of a run, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

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

    def cells(self, isovalue: float, *, array: str | None = None) -> NDArray[np.uint32]:
        """As Run.cells."""
        cells: NDArray[np.uint32] = self._ask("cells", isovalue=isovalue, array=array)
        return cells

    def mesh(
        self, isovalue: float, *, array: str | None = None, dtype: DTypeLike = np.float32
    ) -> tuple[NDArray[Any], NDArray[np.uint32]]:
        """As Run.mesh."""
        mesh: tuple[NDArray[Any], NDArray[np.uint32]] = self._ask("mesh", isovalue=isovalue, array=array, dtype=dtype)
        return mesh

    def values(
        self,
        z: slice | int = slice(None),
        y: slice | int = slice(None),
        x: slice | int = slice(None),
        *,
        array: str | None = None,
    ) -> NDArray[Any]:
        """As Run.values."""
        values: NDArray[Any] = self._ask("values", z=z, y=y, x=x, array=array)
        return values

    def __repr__(self) -> str:
        return f"<isochron.Step {self._number} of {self._run.path}>"

    def _ask(self, name: str, **options: Any) -> Any:
        if self._ahead is None:
            return getattr(self._run, name)(step=self._number, **options)
        return self._ahead.ask(name, self._number, options)


def iterate(run: Run) -> Iterator[Step]:
    """The steps in order, each asked ahead while the caller works on the one before."""
    ahead = _Ahead(run)
    try:
        for number in range(len(run)):
            ahead.begin(number)
            yield Step(run, number, ahead)
    finally:
        ahead.close()
