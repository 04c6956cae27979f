"""Where the program lies that the package was installed or built with: its readers are found from there."""

from __future__ import annotations

import os

from . import _native


def program_folder() -> str:
    here = os.path.dirname(os.path.abspath(_native.__file__))
    installed = os.path.normpath(os.path.join(here, _native.FROM_INSTALLED))
    if os.path.isdir(os.path.join(os.path.dirname(installed), "libexec", "isochron")):
        return installed
    return os.path.normpath(os.path.join(here, _native.FROM_BUILT))
