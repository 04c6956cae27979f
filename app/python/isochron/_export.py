"""Surfaces as files, which the program writes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from . import _native
from ._arguments import crop_word, moment, number, numbers, option, several, steps_word, word
from ._errors import ArgumentError
from ._program import run as run_program

if TYPE_CHECKING:
    from ._run import Run


def export(
    run: Run, out: str, isovalue: Any, steps: Any, time: Any, fraction: Any, options: dict[str, Any]
) -> dict[str, Any]:
    run._array(options["array"])
    words = ["export", run._place]
    for value in isovalue if several(isovalue) else [isovalue]:
        words += option("isovalue", word(number(value, "isovalue")))
    if time is not None:
        if steps is not None:
            raise ArgumentError("time: expected without steps, which say the moments, too")
        step, part = moment(run, None, fraction, time)
        words += [f"--steps={step}", f"--fraction={part}"]
    else:
        if steps is not None:
            words.append(f"--steps={steps_word(steps, len(run))}")
        if fraction is not None:
            whole, part = moment(run, None, fraction, None)
            if whole != 0:
                raise ArgumentError("fraction: expected a share below 1.0")
            words.append(f"--fraction={part}")
    words.append(f"--out={out}")
    for name, value in options.items():
        if value is None:
            continue
        if name in ("range", "clip"):
            words += [f"--{name}", *map(word, numbers(value, name, 2 if name == "range" else 6))]
        elif name == "crop":
            words += option(name, crop_word(value, run.shape[1:]))
        elif name == "rate" or name == "simplify" and not isinstance(value, str):
            words += option(name, word(number(value, name)))
        else:
            words += option(name, value)
    written: dict[str, Any] = json.loads(run_program([*words, "--json"], authorization=_native.authorization_for(run._place)))
    return written
