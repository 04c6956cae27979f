"""What is to be imported as soon as another package is, without importing that package."""

from __future__ import annotations

import importlib
import importlib.abc
import importlib.util
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec
from types import ModuleType


class _Watch(importlib.abc.MetaPathFinder):
    """Finds one package as others do, and imports a module once it is there."""

    def __init__(self, package: str, module: str) -> None:
        self._package = package
        self._module = module

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name != self._package:
            return None
        sys.meta_path.remove(self)
        found = importlib.util.find_spec(name)
        if found is None or found.loader is None:
            return found
        run = found.loader.exec_module

        def run_and_follow(module: ModuleType) -> None:
            run(module)
            importlib.import_module(self._module)

        setattr(found.loader, "exec_module", run_and_follow)
        return found


def call(package: str, module: str) -> None:
    """Imports the module now, if the package is imported already, else right after the package."""
    if package in sys.modules:
        importlib.import_module(module)
    else:
        sys.meta_path.insert(0, _Watch(package, module))
