"""Arguments as people write them: NumPy's scalars, shares and times."""

from __future__ import annotations

import datetime
import math
import operator
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, SupportsIndex, TypeVar, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import ArgumentError, PlaceError

if TYPE_CHECKING:
    from ._run import Run

#: A number, NumPy's scalars among them.
Number = Union[float, "np.integer[Any]", "np.floating[Any]"]
#: Several isovalues.
Isovalues = Union[Sequence[Number], NDArray[Any]]
#: A moment: a number in the run's unit of time, or a date.
Time = Any
#: Steps: a number, as a slice or range of Python, or FIRST:LAST:STRIDE with both ends.
Steps = Union[SupportsIndex, slice, range, str]
#: Vertices to keep: {"x": slice(0, 32), ...}, slices along z, y and x, or X0:X1,Y0:Y1,Z0:Z1 with both ends.
Crop = Union[str, Mapping[str, slice], Sequence[slice]]

#: A sample of a profile.
PROFILE = np.dtype([(name, "<f8") for name in ("distance", "x", "y", "z", "value")])

_WHOLE = 65536
T = TypeVar("T")


def number(value: Any, name: str) -> float:
    """@raises ArgumentError: it is none, or not finite"""
    if isinstance(value, (str, bytes)):
        raise ArgumentError(f"{name}: expected a number, got {value!r}")
    try:
        found = float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{name}: expected a number, got {value!r}") from None
    if not math.isfinite(found):
        raise ArgumentError(f"{name}: expected a finite number, got {found}")
    return found


def whole(value: Any, name: str) -> int:
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    try:
        return operator.index(value)
    except TypeError:
        raise ArgumentError(f"{name}: expected a whole number, got {value!r}") from None


def several(value: Any) -> bool:
    """Whether isovalues are given, not one: a list, or an array of NumPy, xarray or pandas."""
    arrays = isinstance(value, Sequence) or hasattr(value, "ndim")
    return arrays and not isinstance(value, (str, bytes)) and np.ndim(value) > 0


def moment(run: Run, step: Any, fraction: Any, time: Time) -> tuple[int, int]:
    """The step and 65536ths of the way to the next one.

    step, fraction: None where they are not given
    """
    if time is not None:
        if step is not None or fraction is not None:
            raise ArgumentError("time: expected without step and fraction, which say the moment, too")
        return at_time(run, time)
    at = 0 if step is None else whole(step, "step")
    if not 0 <= at < len(run):
        raise PlaceError(f"{run.path}: step {at}, expected 0 to {len(run) - 1}")
    part = 0 if fraction is None else _fraction(fraction)
    if part and at + 1 == len(run):
        raise ArgumentError(f"{run.path}: fraction {fraction} after step {at}, which is the last one: expected 0")
    return (at + 1, 0) if part == _WHOLE else (at, part)


def _fraction(value: Any) -> int:
    """A share where the value has a decimal point, else 65536ths."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (float, np.floating)) or not hasattr(type(value), "__index__"):
        share = number(value, "fraction")
        if not 0 <= share <= 1:
            raise ArgumentError(
                f"fraction: expected a share from 0.0 to 1.0, or a whole number of 65536ths, got {share}"
            )
        return round(share * _WHOLE)
    parts = whole(value, "fraction")
    # 65536ths end before the next step, as in files.
    if not 0 <= parts < _WHOLE:
        raise ArgumentError(f"fraction {parts}, expected 0 to {_WHOLE - 1}")
    return parts


def at_time(run: Run, time: Time) -> tuple[int, int]:
    """The moment at a time: between two steps their blend, as `fraction` has it."""
    times = run.times
    wanted = time_number(run, time)
    after = int(np.searchsorted(times, wanted))
    if after < len(times) and times[after] == wanted:
        return after, 0
    if after in (0, len(times)):
        unit = f" {run.time_unit}" if run.time_unit else ""
        raise ArgumentError(f"{run.path}: time {time}, expected {times[0]:.10g} to {times[-1]:.10g}{unit}")
    share = (wanted - times[after - 1]) / (times[after] - times[after - 1])
    part = round(float(share) * _WHOLE)
    return (after, 0) if part == _WHOLE else (after - 1, part)


def time_number(run: Run, time: Time) -> float:
    """A time in the run's unit. Dates need a unit such as `days since 2000-01-01`."""
    if isinstance(time, np.ndarray) and time.ndim == 0:
        time = time[()]
    if hasattr(time, "ndim") and hasattr(time, "values") and time.ndim == 0:  # of xarray
        time = time.values[()]
    if isinstance(time, (np.timedelta64, datetime.timedelta)):
        seconds = float(np.timedelta64(time) / np.timedelta64(1, "us")) / 1e6
        found = _native.times_in(run.time_unit, "s", [seconds])
        if not found:
            raise ArgumentError(f"time: {time}, expected a moment in {run.time_unit or 'the numbers of the steps'}")
        return found[0]
    if not isinstance(time, (str, np.datetime64)) and not hasattr(time, "timetuple"):
        return number(time, "time")
    return date_number(time, run.time_unit)


def date_number(date: Any, unit: str) -> float:
    """A date in a unit, by the calendar that stands behind the unit in brackets, where it is not the usual one."""
    if getattr(date, "tzinfo", None) is not None:
        date = date.astimezone(datetime.timezone.utc).replace(tzinfo=None)
    text = str(date).replace("T", " ")
    calendar = re.search(r" \(\w+\)$", unit)
    found = _native.times_in(unit, f"seconds since {text}{calendar[0] if calendar else ''}", [0.0])
    if " since " not in unit:
        raise ArgumentError(f"time: {text} is a date, expected a number{' in ' + unit if unit else ''}")
    if not found:
        raise ArgumentError(f"time: expected a date such as 2000-01-31 or 2000-01-31 06:00 in {unit}, got {text}")
    return found[0]


def option(name: str, value: Any) -> list[str]:
    """A parameter as the program takes it: `--time-step=0.5`, `--force`; nothing where it is not given."""
    flag = "--" + name.replace("_", "-")
    if value is None or value is False or (isinstance(value, np.bool_) and not value):
        return []
    if value is True or isinstance(value, np.bool_):
        return [flag]
    return [f"{flag}={value}"]


def numbers(values: Any, name: str, count: int) -> list[float]:
    try:
        found = [number(value, name) for value in values]
    except TypeError:
        found = []
    if len(found) != count:
        raise ArgumentError(f"{name}: expected {count} numbers, got {values!r}")
    return found


def word(value: float) -> str:
    """A number as the program reads it, exactly."""
    return repr(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))


def span(part: Any, name: str, length: int | None) -> tuple[int, int, int]:
    """The first and the last place of a slice or range, and the stride.

    length: None where it is not known: then the slice has to name its end
    """
    given = part
    if isinstance(part, range):
        part = slice(part.start, part.stop, part.step)
    if not isinstance(part, slice):
        at = whole(part, name)
        part = slice(at, at + 1 if at != -1 else None)
    if length is None:
        ends = (part.start or 0, part.stop)
        if part.stop is None or min(ends) < 0:
            raise ArgumentError(f"{name}: expected a first and an end that count from 0, got {part}")
        length = whole(part.stop, name)
    stride = 1 if part.step is None else whole(part.step, name)
    places = range(*part.indices(length))
    if stride < 1 or not places:
        raise ArgumentError(f"{name}: expected at least one of 0 to {length - 1}, ascending, got {given}")
    return places[0], places[-1], stride


def crop_word(crop: Crop, shape: tuple[int, ...] | None) -> str:
    """X0:X1,Y0:Y1,Z0:Z1, both ends included.

    shape: vertices along z, y and x; None where they are not known
    """
    if isinstance(crop, str):
        return crop
    parts = dict(crop) if isinstance(crop, Mapping) else dict(zip("zyx", crop))
    if not isinstance(crop, Mapping) and len(crop) != 3 or not set(parts) <= set("xyz"):
        raise ArgumentError(f"crop: expected slices along z, y and x, or of the axes x, y and z by name, got {crop!r}")
    said = []
    for axis, length in zip("xyz", reversed(shape) if shape else (None, None, None)):
        first, last, stride = span(parts.get(axis, slice(None)), f"crop along {axis}", length)
        if stride != 1:
            raise ArgumentError(f"crop along {axis}: expected no stride, got {parts[axis]}; stride leaves vertices out")
        said.append(f"{first}:{last}")
    return ",".join(said)


def crop_box(crop: Crop | None, shape: tuple[int, ...]) -> list[tuple[int, int]] | None:
    """The first and the last vertex along x, y and z. shape: vertices along z, y and x"""
    if crop is None:
        return None
    said = crop_word(crop, shape)
    found = re.fullmatch(r"(\d+):(\d+),(\d+):(\d+),(\d+):(\d+)", said)
    places = [int(each) for each in found.groups()] if found else []
    box = list(zip(places[::2], places[1::2]))
    if not box or any(not first < last < length for (first, last), length in zip(box, reversed(shape))):
        x, y, z = (length - 1 for length in reversed(shape))
        raise ArgumentError(
            f"crop: expected vertices from 0 to {x}, {y} and {z} along x, y and z, the first below the last, got {said}"
        )
    return box


def least_cells(dust: Any) -> int:
    """Active cells that a piece has at least; 0: any."""
    found = whole(dust, "dust")
    if not 0 <= found < 1 << 32:
        raise ArgumentError(f"dust: expected a number of cells, from 0, got {found}")
    return found


def path(places: Sequence[Sequence[Number]]) -> list[list[float]]:
    """Places, two or more, of a profile."""
    found = [numbers(place, "profile", 3) for place in places]
    if len(found) < 2:
        raise ArgumentError(f"profile: expected two places (x, y, z) or more, got {len(found)}")
    return found


def clip_plane(clip: Sequence[Number] | None) -> list[float] | None:
    """A point on the plane and its normal, which is made 1 long."""
    if clip is None:
        return None
    found = numbers(clip, "clip", 6)
    length = math.hypot(*found[3:])
    if not 0 < length < math.inf:
        raise ArgumentError(f"clip: expected a point on the plane and its normal, which is not 0, got {clip!r}")
    return found[:3] + [each / length for each in found[3:]]


def steps_word(steps: Steps, length: int | None) -> str:
    """FIRST:LAST:STRIDE, both ends included."""
    if isinstance(steps, str):
        return steps
    return ":".join(str(each) for each in span(steps, "steps", length))
