from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

__version__: str
FROM_BUILT: str
FROM_INSTALLED: str

def address_of(name: str) -> str: ...
def is_link(name: str) -> bool: ...
def authorization_for(address: str) -> str: ...

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
    levels: tuple[tuple[NDArray[np.float64], ...], ...]
    anatomy: str
    axis_names: tuple[str, str, str]
    dtype: np.dtype[Any]
    slope: float
    intercept: float
    range: tuple[float, float]
    notes: tuple[str, ...]

class RunArray:
    def cells(self, step: int, fraction: int, isovalue: float, level: int) -> NDArray[Any]: ...
    def change(
        self, step: int, fraction: int, isovalue: float, to_step: int, to_fraction: int, to_isovalue: float
    ) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]: ...
    def mesh(
        self,
        step: int,
        fraction: int,
        isovalue: float,
        absolute: bool,
        level: int,
        normals: bool,
        values: str | None,
        dust: int,
    ) -> tuple[NDArray[Any], NDArray[np.uint32], NDArray[np.float32] | None, NDArray[np.float32] | None]: ...
    def first_crossings(
        self, isovalue: float, blended: bool
    ) -> tuple[NDArray[np.uint16], NDArray[np.uint16] | None]: ...
    def measure(
        self,
        step: int,
        fraction: int,
        isovalue: float,
        on_surface: str | None,
        pieces: bool,
        crop: Sequence[tuple[int, int]] | None,
        clip: Sequence[float] | None,
        dust: int,
        place: Sequence[float] | None,
    ) -> tuple[list[float], NDArray[np.float64]]: ...
    def profile(self, step: int, fraction: int, places: Sequence[Sequence[float]]) -> NDArray[np.float64]: ...
    def values(self, step: int, fraction: int, box: Sequence[tuple[int, int]], level: int) -> NDArray[Any]: ...
    def description(self) -> About: ...
    def read_bytes(self) -> int: ...

class OpenRun:
    def __init__(self, path: str) -> None: ...
    def array(self, name: str | None) -> RunArray: ...
    def names(self) -> list[str]: ...
    def lost(self) -> str | None: ...

def set_program_folder(folder: str) -> None: ...
def measure_names() -> list[str]: ...
def times_in(wanted: str, given: str, times: list[float]) -> list[float] | None: ...
def build(
    files: Sequence[str],
    out: str,
    words: Sequence[str],
    times: Sequence[float],
    arrays: tuple[str, Callable[[str, int, np.dtype[Any]], Iterator[NDArray[Any]]], str] | None,
    progress: Callable[[str, float], object] | None,
) -> list[str]: ...
