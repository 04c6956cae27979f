"""What the scripts of this folder share: each writes files with a library of its own into a folder, and beside them
manifest.json with what a reader must find in each. Values are those that the library reads back."""
import json
import os
import sys

import numpy as np

folder = sys.argv[1]
random = np.random.default_rng(7)
entries = []


def path(name):
    return os.path.join(folder, name)


def field(*shape, dtype="f4"):
    """Values that no two places share, as far as the type goes."""
    if np.dtype(dtype).kind == "f":
        return random.standard_normal(shape).astype(dtype)
    info = np.iinfo(dtype)
    native = np.dtype(dtype).newbyteorder("=")
    return random.integers(info.min, info.max, shape, dtype=native, endpoint=True).astype(dtype)


def expect(files, values, *, spacing=(1, 1, 1), origin=(0, 0, 0), times=None, direction=None, positions=None, kind=None,
           unit=None, note=None, **options):
    """values: [time][z][y][x] or [z][y][x], after all scaling. direction: of each index axis in physical space, by
    default x, y and z. positions: of all vertices along each axis. unit: of times. note: a part of one of the notes.
    options: array, component, extra_axis_is_time, ..."""
    values = np.asarray(values)
    if direction is None:
        direction = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    if values.ndim == 3:
        values = values[None]
    name = f"values_{len(entries)}.bin"
    values.astype("<f8").tofile(path(name))
    entries.append(dict(files=[files] if isinstance(files, str) else files, values=name,
                        vertices=list(values.shape[:0:-1]), steps=values.shape[0],
                        spacing=[float(v) for v in spacing], origin=[float(v) for v in origin],
                        times=None if times is None else [float(t) for t in times],
                        direction=direction, positions=positions, kind=kind, unit=unit, note=note, options=options))


def refuse(files, message, **options):
    """The reader's one line must hold this."""
    entries.append(dict(files=[files] if isinstance(files, str) else files, message=message, options=options))


def done():
    with open(path("manifest.json"), "w") as out:
        json.dump(entries, out)
