"""Pictures, which the program draws: a replay of a recording that is one moment long."""

from __future__ import annotations

import os
import struct
import tempfile
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._control import as_json
from ._errors import Error
from ._program import run as run_program

# One window without a screen; the data stand ahead of the eye, where all of them are seen.
_CONFIGURATION = """version = 1

[viewer]
position = [0.0, 1.6, 0.0]

[[windows]]
name = "picture"
size = [{width}, {height}]
stereo = "mono"

[[windows.viewports]]

[windows.viewports.projection]
carried_by = "head"
fit_aspect = true
lower_left = [-0.5, -0.5, -1.2]
upper_left = [-0.5, 0.5, -1.2]
upper_right = [0.5, 0.5, -1.2]

[rendering]
context = "egl"

[placement]
size = 1.5
height = 1.6
distance = 3.0
"""

_STAMP = "picture"


def _recording(index: str, state: Mapping[str, Any], size: tuple[int, int]) -> str:
    header = {
        "format": "isochron recording",
        "version": 2,
        "program": f"isochron {_native.__version__}",
        "configuration": _CONFIGURATION.format(width=size[0], height=size[1]),
        "data": index,
        "data_hash": "",
        "start": dict(state),
    }
    # Nothing happens for two seconds, so that the picture is one at rest.
    frames: list[dict[str, Any]] = [{"t": 0.1 * number} for number in range(20)]
    frames.append({"t": 2.0, "commands": {"stamps": [_STAMP]}})
    return "".join(as_json(line, "state") for line in [header, *frames])


def _pixels(tiff: bytes) -> NDArray[np.uint8]:
    """The pixels of a TIFF as the program writes it: strips by zlib, each row as differences."""
    (entries,) = struct.unpack_from("<I", tiff, 4)
    (count,) = struct.unpack_from("<H", tiff, entries)
    tags: dict[int, tuple[int, ...]] = {}
    for at in range(entries + 2, entries + 2 + 12 * count, 12):
        tag, kind, values = struct.unpack_from("<HHI", tiff, at)
        if kind in (3, 4):
            form = f"<{values}{'H' if kind == 3 else 'I'}"
            inside = struct.calcsize(form) <= 4
            tags[tag] = struct.unpack_from(form, tiff, at + 8 if inside else struct.unpack_from("<I", tiff, at + 8)[0])
    width, height, compression, channels, predictor = (tags[tag][0] for tag in (256, 257, 259, 277, 317))
    if (compression, channels, predictor, tags[258]) != (8, 3, 2, (8, 8, 8)):
        raise Error("the program wrote a picture of a kind that this module does not know")
    strips = b"".join(zlib.decompress(tiff[at : at + size]) for at, size in zip(tags[273], tags[279]))
    rows = np.frombuffer(strips, np.uint8).reshape(height, width, channels)
    return np.cumsum(rows, axis=1, dtype=np.uint8)


def render(index: str, state: Mapping[str, Any], size: tuple[int, int], authorization: str) -> NDArray[np.uint8]:
    with tempfile.TemporaryDirectory(prefix="isochron-") as folder:
        with open(os.path.join(folder, "picture.jsonl"), "w", encoding="utf-8") as file:
            file.write(_recording(index, state, size))
        try:
            run_program(["replay", "picture.jsonl", "--stamps", "--out", "pictures", "--format", "tiff"], folder, authorization)
        except Error as error:
            raise Error(str(error).replace("picture.jsonl:1: start", "state")) from None
        (picture,) = os.listdir(os.path.join(folder, "pictures"))
        with open(os.path.join(folder, "pictures", picture), "rb") as tiff:
            return _pixels(tiff.read())
