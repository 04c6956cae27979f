"""Active cells, surfaces and values of time-varying volumes, from an index of Isochron.

    import isochron
    with isochron.open("run42.isochron") as run:
        cells = run.cells(0.5, step=7)
        points, faces = run.mesh(0.5, step=7)

What is wrong with a file or a request raises `isochron.Error`, in one line, the one that the program prints.
"""

from __future__ import annotations

import glob as _glob
import os as _os
from collections.abc import Callable, Iterable

from . import _native
from ._control import Session
from ._native import Error
from ._place import program_folder as _program_folder
from ._run import Run
from ._steps import Step

__all__ = ["Error", "Run", "Session", "Step", "build", "connect", "open"]
__version__: str = _native.__version__

Error.__module__ = "isochron"
Error.__doc__ = "Bad input or a failed file operation: what, where, expected and got, in one line."


_native.set_program_folder(_program_folder())


def open(path: str | _os.PathLike[str]) -> Run:
    """Opens an index, which reads little of it. Several threads may use the run at once.

    Raises Error if the file is missing, is no index, or is damaged.
    """
    return Run(path)


def connect(path: str | _os.PathLike[str] | None = None, *, token: str | None = None) -> Session:
    """Connects to a session that `isochron explore --control` began.

    path: of its socket, or 127.0.0.1:PORT; None: where `--control` without a value opens it.
    token: of 127.0.0.1:PORT; None: the one that the session wrote for this user.

    Raises Error if nobody listens there.
    """
    return Session(path, token=token)


def _expanded(patterns: Iterable[str | _os.PathLike[str]]) -> list[str]:
    files: list[str] = []
    for each in patterns:
        pattern = _os.fspath(each)
        # A file may have brackets in its name: an existing file is a name, not a pattern.
        if _os.path.exists(pattern) or not any(sign in pattern for sign in "*?["):
            files.append(pattern)
            continue
        found = sorted(_glob.glob(pattern))
        if not found:
            raise Error(f"{pattern}: no file matches")
        files += found
    return files


def build(
    files: str | _os.PathLike[str] | Iterable[str | _os.PathLike[str]],
    out: str | _os.PathLike[str],
    *,
    array: str | Iterable[str] | None = None,
    component: int | str | None = None,
    progress: Callable[[str, float], object] | None = None,
) -> Run:
    """Indexes a series of volume files, as `isochron build` does, and opens the index.

    files: names, or patterns (`t*.vti`), of all steps in any order.
    array: the name of the array to index, or several names; None if the files have one.
    component: of vectors: its number from 0, "magnitude", "gradient", "vorticity" or "q-criterion".
    progress: called as progress(phase, fraction) now and then; what it raises ends the build, as Ctrl-C does,
        and leaves no index behind.
    """
    if isinstance(files, (str, _os.PathLike)):
        files = [files]
    names = [] if array is None else [array] if isinstance(array, str) else list(array)
    part = None if component is None else str(component)
    _native.build(_expanded(files), _os.fspath(out), names, part, progress)
    return Run(out)
