"""Active cells, surfaces and values of time-varying volumes, from an index of Isochron.

    import isochron
    with isochron.open("run42.isochron") as run:
        cells = run.cells(0.5, step=7)
        points, faces = run.mesh(0.5, step=7)

What is wrong with a file or a request raises `isochron.Error`, in one line. Where Python has an exception for the case, it
is that, too: a missing file is a FileNotFoundError.
"""

from __future__ import annotations

import os as _os

from . import _native, _when_imported
from ._build import build
from ._control import Session
from ._errors import ArgumentError, Error, MissingFileError, PlaceError
from ._mesh import Mesh
from ._place import program_folder as _program_folder
from ._run import Run
from ._steps import Step

__all__ = [
    "ArgumentError",
    "Error",
    "Mesh",
    "MissingFileError",
    "PlaceError",
    "Run",
    "Session",
    "Step",
    "build",
    "connect",
    "open",
]
__version__: str = _native.__version__

_native.set_program_folder(_program_folder())
_when_imported.call("xarray", "isochron._accessor")


def open(path: str | _os.PathLike[str]) -> Run:
    """Opens an index, which reads little of it. Several threads may use the run at once.

    path: of a file, or a link, `https://.../run42.isochron`, also the one that `isochron serve` prints.

    Raises Error if the file is missing (MissingFileError), is no index, or is damaged.
    """
    return Run(path)


def connect(path: str | _os.PathLike[str] | None = None, *, token: str | None = None) -> Session:
    """Connects to a session that `isochron explore --control` began.

    path: of its socket, or 127.0.0.1:PORT; None: where `--control` without a value opens it.
    token: of 127.0.0.1:PORT; None: the one that the session wrote for this user.

    Raises Error if nobody listens there.
    """
    return Session(path, token=token)


for _name in __all__:
    globals()[_name].__module__ = __name__
del _name
