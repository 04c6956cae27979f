"""What the program does for the module."""

from __future__ import annotations

import os
import subprocess
import warnings
from collections.abc import Sequence

from ._errors import Error, error_of, in_parameters
from ._place import program_folder


def run(words: Sequence[str], folder: str | None = None, authorization: str = "") -> str:
    """What the program prints. @raises Error: in its last line

    authorization: what the program sends to a web server, as ISOCHRON_AUTHORIZATION has it; empty: nothing more.
    """
    environment = {**os.environ, "ISOCHRON_AUTHORIZATION": authorization} if authorization else None
    program = os.path.join(program_folder(), "isochron")
    try:
        ran = subprocess.run(
            [program, *words],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            errors="replace",
        )
    except FileNotFoundError:
        raise Error(f"isochron: not found in {os.path.dirname(program)}") from None
    said = [line.removeprefix("isochron: ") for line in ran.stderr.splitlines() if line.startswith("isochron: ")]
    if ran.returncode != 0:
        line = said[-1] if said else f"isochron {words[0]}: exit status {ran.returncode}"
        line = line.replace(f" (see isochron {words[0]} --help)", "")
        raise error_of(line, line.endswith("there is no such file"))
    for line in said:
        warnings.warn(in_parameters(line.removeprefix("note: ")), RuntimeWarning, stacklevel=4)
    return ran.stdout
