"""The header of a NetCDF file (CDF-5) and its small variables: what describes arrays that are in no file.

The format: https://docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

_DIMENSIONS, _VARIABLES, _ATTRIBUTES = 10, 11, 12
_TEXT = 2
_TYPES = {"i1": 1, "i2": 3, "i4": 4, "f4": 5, "f8": 6, "u1": 7, "u2": 8, "u4": 9, "i8": 10, "u8": 11}


@dataclass
class Variable:
    dims: tuple[str, ...]
    dtype: np.dtype[Any]
    attributes: dict[str, Any] = field(default_factory=dict)
    values: NDArray[Any] | None = None  #: None: the file has none


def _padded(data: bytes) -> bytes:
    return data + b"\0" * (-len(data) % 4)


def _name(name: str) -> bytes:
    text = name.replace("/", "_").encode(errors="replace")
    return struct.pack(">q", len(text)) + _padded(text)


def _listed(tag: int, items: list[bytes]) -> bytes:
    return struct.pack(">iq", tag if items else 0, len(items)) + b"".join(items)


def _attribute(name: str, value: Any) -> bytes | None:
    """None: of a kind that the format does not have."""
    if isinstance(value, str):
        text = value.encode(errors="replace")
        return _name(name) + struct.pack(">iq", _TEXT, len(text)) + _padded(text)
    numbers = np.atleast_1d(np.asarray(value))
    if numbers.dtype.kind == "b":
        numbers = numbers.astype(np.int8)
    kind = numbers.dtype.str[1:]
    if kind not in _TYPES or numbers.ndim != 1:
        return None
    data = numbers.astype(numbers.dtype.newbyteorder(">")).tobytes()
    return _name(name) + struct.pack(">iq", _TYPES[kind], numbers.size) + _padded(data)


def write(path: str, lengths: Mapping[str, int], variables: Mapping[str, Variable]) -> None:
    """Places for values that the file does not have are left empty on the disk, too."""
    numbers = {name: number for number, name in enumerate(lengths)}
    dimensions = [_name(name) + struct.pack(">q", length) for name, length in lengths.items()]

    def header(begins: Mapping[str, int]) -> bytes:
        listed = []
        for name, variable in variables.items():
            attributes = [_attribute(key, value) for key, value in variable.attributes.items()]
            listed.append(
                _name(name)
                + struct.pack(f">q{len(variable.dims)}q", len(variable.dims), *(numbers[dim] for dim in variable.dims))
                + _listed(_ATTRIBUTES, [each for each in attributes if each is not None])
                + struct.pack(">iqq", _TYPES[variable.dtype.str[1:]], sizes[name], begins[name])
            )
        return (
            b"CDF\5" + struct.pack(">q", 0)
            + _listed(_DIMENSIONS, dimensions) + _listed(_ATTRIBUTES, []) + _listed(_VARIABLES, listed)
        )  # fmt: skip

    sizes = {}
    for name, variable in variables.items():
        values = int(np.prod([lengths[dim] for dim in variable.dims], dtype=object))
        sizes[name] = (values * variable.dtype.itemsize + 3) // 4 * 4
    end = len(header(dict.fromkeys(variables, 0)))
    begins = {}
    for name in variables:
        begins[name] = end
        end += sizes[name]
    with open(path, "wb") as file:
        file.write(header(begins))
        for name, variable in variables.items():
            if variable.values is not None:
                file.seek(begins[name])
                file.write(variable.values.astype(variable.dtype.newbyteorder(">")).tobytes())
        file.truncate(end)
