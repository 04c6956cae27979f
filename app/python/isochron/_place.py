"""Where the program lies that the package was installed or built with: its readers are found from there."""

from __future__ import annotations

import os
import sys

from . import _native


def program_folder() -> str:
    here = os.path.dirname(os.path.abspath(_native.__file__))
    within = os.path.join(here, "_program", "bin")  # where pip has put it
    if os.path.isdir(within):
        return within
    installed = os.path.normpath(os.path.join(here, _native.FROM_INSTALLED))
    if os.path.isdir(os.path.join(os.path.dirname(installed), "libexec", "isochron")):
        return installed
    return os.path.normpath(os.path.join(here, _native.FROM_BUILT))


def run_program() -> None:
    """The command `isochron` of an installation by pip."""
    program = os.path.join(program_folder(), "isochron")
    os.execv(program, [program, *sys.argv[1:]])
