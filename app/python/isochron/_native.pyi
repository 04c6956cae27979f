from collections.abc import Callable, Sequence
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

__version__: str
FROM_BUILT: str
FROM_INSTALLED: str

class Error(Exception): ...

class About(TypedDict):
    array: str
    times: NDArray[np.float64]
    unit: str
    length_unit: str
    time_unit: str
    shape: tuple[int, int, int, int]
    spacing: tuple[float, float, float]
    origin: tuple[float, float, float]
    direction: tuple[tuple[float, float, float], ...]
    distances: tuple[NDArray[np.float64], ...]
    dtype: np.dtype[Any]
    slope: float
    intercept: float
    range: tuple[float, float]
    notes: tuple[str, ...]

class RunArray:
    def cells(self, step: int, fraction: int, isovalue: float) -> NDArray[Any]: ...
    def change(
        self, step: int, fraction: int, isovalue: float, to_step: int, to_fraction: int, to_isovalue: float
    ) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]: ...
    def mesh(
        self, step: int, fraction: int, isovalue: float, absolute: bool
    ) -> tuple[NDArray[Any], NDArray[np.uint32]]: ...
    def values(self, step: int, fraction: int, box: Sequence[tuple[int, int]]) -> NDArray[Any]: ...
    def description(self) -> About: ...
    def read_bytes(self) -> int: ...

class OpenRun:
    def __init__(self, path: str) -> None: ...
    def array(self, name: str | None) -> RunArray: ...
    def names(self) -> list[str]: ...
    def lost(self) -> str | None: ...

def set_program_folder(folder: str) -> None: ...
def build(
    files: Sequence[str],
    out: str,
    arrays: Sequence[str],
    component: str | None,
    progress: Callable[[str, float], object] | None,
) -> None: ...
