"""A session that `isochron explore --control` began, steered from outside."""

from __future__ import annotations

import json
import os
import re
import socket
from collections.abc import Iterator, Mapping, Sequence
from types import TracebackType
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ._arguments import PROFILE, Number, number, path, whole
from ._errors import ArgumentError, Error, MissingFileError
from ._mesh import Mesh

_PATIENCE = 5.0  # [s] for the answer to hello, which no session takes long to give


def _folder() -> str:
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    if runtime.startswith("/"):
        return os.path.join(runtime, "isochron")
    state = os.environ.get("XDG_STATE_HOME") or os.path.join(os.path.expanduser("~"), ".local", "state")
    return os.path.join(state, "isochron")


class Session:
    """A connection to a running session. Not for several threads at once; each may open its own.

    What a session refuses raises `isochron.Error` with the session's words, and so does a session that has ended.
    """

    def __init__(self, path: str | os.PathLike[str] | None = None, *, token: str | None = None) -> None:
        where = os.path.join(_folder(), "control.sock") if path is None else os.fspath(path)
        host, colon, port = where.rpartition(":")
        tcp = bool(colon) and "/" not in where
        if tcp and (host not in ("127.0.0.1", "localhost") or not port.isdecimal()):
            raise Error(f"{where}: expected a path, or 127.0.0.1:PORT")
        self._socket = socket.socket(socket.AF_INET if tcp else socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            self._socket.connect(("127.0.0.1", int(port)) if tcp else where)
        except OSError as error:
            self._socket.close()
            kind = MissingFileError if isinstance(error, FileNotFoundError) else Error
            raise kind(
                f"{where}: nobody listens there ({error.strerror}); isochron explore --control begins a session that does"
            ) from None
        self._stream = self._socket.makefile("rb")
        self._requests = 0
        self._events: list[dict[str, Any]] = []
        self._note: dict[str, Any] = {}
        try:
            if tcp and token is None:
                token = _token_of(port)
            self._socket.settimeout(_PATIENCE)
            self._ask("hello", token=token or "")
            self._socket.settimeout(None)
        except BaseException:
            self.close()
            raise

    def tell(self, commands: Mapping[str, Any] | None = None, /, **more: Any) -> int:
        """Says commands, with the keys of a recording's: tell(step=7, isovalue=0.5), tell(undo=True).

        Returns the number of the frame that obeys them once it is shown.
        """
        answer, _ = self._ask("commands", commands={**(commands or {}), **more})
        return int(answer["frame"])

    def state(self) -> dict[str, Any]:
        """All settings, as a recording's `start` has them."""
        state: dict[str, Any] = self._ask("state")[0]["state"]
        return state

    def picture(self, *, now: bool = False) -> NDArray[np.uint8]:
        """What the first window shows beside its panel: (height, width, 3) in sRGB.

        It shows what was told before, waits for the cells and the final quality, at most ten seconds of motion, unless
        `now` is true. `note` says what it shows.
        """
        answer, data = self._ask("picture", now=now)
        self._note = json.loads(re.sub("</?isochron-picture>", "", answer["note"]))
        return np.frombuffer(data, np.uint8).reshape(answer["height"], answer["width"], 3)

    @property
    def note(self) -> dict[str, Any]:
        """The note of the last picture, as pictures in files have it: the `state` that it shows, its `footprint` and more.

        Empty before the first picture.
        """
        return self._note

    def cells(
        self, isovalue: Number | None = None, step: SupportsIndex | None = None, *, array: str | None = None
    ) -> NDArray[Any]:
        """The numbers of the active cells, as `Run.cells` has them; what is not given is as it is shown."""
        answer, data = self._ask("cells", **_asked(isovalue, step, array))
        return np.frombuffer(data, np.uint64 if answer["id_bits"] == 64 else np.uint32)

    def mesh(
        self,
        isovalue: Number | None = None,
        step: SupportsIndex | None = None,
        *,
        array: str | None = None,
        dtype: DTypeLike = np.float32,
    ) -> Mesh:
        """The surface as points (N, 3) and triangles (M, 3), absolute, as `isochron export` writes them."""
        kind = np.dtype(dtype)
        if kind not in (np.dtype(np.float32), np.dtype(np.float64)):
            raise ArgumentError(f"dtype: expected float32 or float64, got {kind}")
        answer, data = self._ask("mesh", **_asked(isovalue, step, array))
        points, triangles = answer["points"], answer["triangles"]
        places = np.frombuffer(data, np.float32, 3 * points).reshape(points, 3)
        corners = np.frombuffer(data, np.uint32, 3 * triangles, 24 * points).reshape(triangles, 3)
        return Mesh((places + np.asarray(answer["origin"])).astype(kind), corners)

    def profile(
        self, *places: Sequence[Number], step: SupportsIndex | None = None, array: str | None = None
    ) -> NDArray[np.void]:
        """The values from place to place, as `Run.profile` has them; without places, along the ruler that is picked.

        What is not given is as it is shown.
        """
        of = _given(places=path(places)) if places else {}
        _, data = self._ask("profile", **of, **_asked(None, step, array))
        return np.frombuffer(data, PROFILE)

    def events(self, *topics: str, rate: Number = 30) -> Iterator[dict[str, Any]]:
        """What changes, until the session ends: `state`, `time`, `cells` or `statistics`, at most `rate` a second.

        Each event has the keys `event`, `frame`, and one of the topic's name. Leave the loop, and nothing more is sent.
        """
        self._ask("subscribe", to=list(topics or ("state",)), rate=number(rate, "rate"))
        try:
            while True:
                while self._events:
                    yield self._events.pop(0)
                line = self._stream.readline()
                if not line:
                    return
                event = json.loads(line)
                if "event" in event:
                    yield event
        finally:
            try:
                self._ask("subscribe", to=[])
            except (Error, OSError, ValueError):
                pass  # the session has ended
            self._events.clear()

    def close(self) -> None:
        """Ends the connection; the session goes on."""
        self._stream.close()
        self._socket.close()

    def __enter__(self) -> Session:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _ask(self, verb: str, **more: Any) -> tuple[dict[str, Any], bytes]:
        self._requests += 1
        line = as_json({"id": self._requests, "verb": verb, **more}, "commands")
        try:
            self._socket.sendall(line.encode())
            while True:
                answer = self._read()
                if "event" in answer:
                    self._events.append(answer)
                    continue
                data = self._stream.read(answer.get("bytes", 0))
                if answer.get("id") in (self._requests, None):
                    break
        except socket.timeout:
            raise Error(
                "control socket: no answer: the session hangs, or has as many clients as it takes"
            ) from None
        except OSError as error:
            raise Error(f"control socket: {error.strerror}") from None
        if not answer["ok"]:
            raise Error(answer["error"])
        return answer, data

    def _read(self) -> dict[str, Any]:
        line = self._stream.readline()
        if not line:
            raise Error("control socket: the session has ended the connection")
        answer: dict[str, Any] = json.loads(line)
        return answer


def _token_of(port: str) -> str:
    name = os.path.join(_folder(), f"control-{port}.token")
    try:
        with open(name, encoding="ascii") as file:
            return file.readline().strip()
    except OSError as error:
        kind = MissingFileError if isinstance(error, FileNotFoundError) else Error
        raise kind(f"{name}: {error.strerror}; token names the token of another user's session") from None


def _asked(isovalue: Number | None, step: SupportsIndex | None, array: str | None) -> dict[str, Any]:
    return _given(
        isovalue=None if isovalue is None else number(isovalue, "isovalue"),
        step=None if step is None else whole(step, "step"),
        array=array,
    )


def _given(**values: Any) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is not None}


def as_json(value: Any, name: str) -> str:
    """A line; NumPy's numbers and arrays are as JSON has them."""

    def plain(value: Any) -> Any:
        if isinstance(value, (np.generic, np.ndarray)):
            return value.tolist()
        raise ArgumentError(f"{name}: {type(value).__name__} is no value of a command")

    try:
        return json.dumps(value, default=plain, allow_nan=False) + "\n"
    except ArgumentError:
        raise
    except (TypeError, ValueError):  # of keys, and of numbers that JSON has not
        raise ArgumentError(f"{name}: expected finite numbers, and texts as keys") from None
