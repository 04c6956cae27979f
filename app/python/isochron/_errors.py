"""What goes wrong, in one line, in the words of the module's parameters."""

from __future__ import annotations

import errno
import posixpath
import re
import shlex


class Error(Exception):
    """Bad input or a failed file operation: what, where, expected and got, in one line."""

    def __init__(self, line: str = "") -> None:
        super().__init__(" ".join(line.split()) if "\n" in line else line)  # arrays print as several lines


class MissingFileError(Error, FileNotFoundError):
    """A file is not there."""

    def __init__(self, line: str) -> None:
        super().__init__(line)
        self.errno = errno.ENOENT
        self.filename = line.split(": ")[0]

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[type[MissingFileError], tuple[str]]:
        return MissingFileError, (str(self),)


class ArgumentError(Error, TypeError, ValueError):
    """An argument is of a wrong type, or no value that it may have."""


class PlaceError(Error, IndexError):
    """There is no such step or vertex."""


_FLAGS = ("all-arrays", "times-from-names", "keep-first", "extra-axis-is-time", "allow-surplus", "big-endian", "append",
          "refer", "force", "quantize", "compress")  # fmt: skip
# What parameters are called whose options have another name.
_PARAMETERS = {
    "resample-by-cell": "resample='cell'",
    "no-normals": "normals=False",
    "precision double": "double=True",
    **{flag: flag.replace("-", "_") + "=True" for flag in _FLAGS},
}


def _as_call(command: re.Match[str]) -> str:
    """`isochron build data.nc -o folder/data.isochron`, as a call that writes into the working folder."""
    source, _, out, *arrays = shlex.split(command[1])
    named = f", array={arrays[1::2]!r}" if arrays else ""
    return f"isochron.build({source!r}, {posixpath.basename(out)!r}{named}) makes"


def in_parameters(text: str) -> str:
    """Options of the command line as parameters of Python: `--time-step` is `time_step`."""

    def name(option: re.Match[str]) -> str:
        word = option[1]
        return _PARAMETERS.get(word, word.replace("-", "_"))

    text = re.sub(r"`isochron build ([^`]*)` makes(?= an index of data$)", _as_call, text)
    text = text.replace("isochron build --array A --array B ...", "isochron.build(..., array=['A', 'B'])")
    text = re.sub(r"(?<![\w-])--(precision double|[a-z][a-z0-9]*(?:-[a-z0-9]+)*)", name, text)
    return text


def error_of(line: str, missing: bool) -> Error:
    """What a message of the native part is raised as."""
    text = in_parameters(line)
    return MissingFileError(text) if missing or ": there is no folder " in line else Error(text)


def missing(line: str) -> MissingFileError:
    return MissingFileError(line)
