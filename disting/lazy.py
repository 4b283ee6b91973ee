"""Packages whose public names are imported when they are used.

A package that imports all that it offers makes every import of one of its modules an import of all
of them. So it lists its names twice: as imports below `if TYPE_CHECKING`, which are never made, for
type checkers, editors and the digest of the code behind a cached result; and with their modules,
for `offer`. A test compares the two lists.
"""

import sys
from collections.abc import Mapping
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import TYPE_CHECKING as TYPE_CHECKING


def offer(package: str, modules: Mapping[str, str]) -> None:
    """Make names of modules public in a package, each imported on its first use.

    `modules`: by the name of a module, in full or inside the package, its public names with spaces
    between. Called once, at the end of the `__init__` of the package.

    >>> import disting.measurement
    >>> disting.measurement.read.__module__
    'disting.measurement.files'
    """
    homes = {
        name: module if module.startswith("disting.") else f"{package}.{module}"
        for module, names in modules.items()
        for name in names.split()
    }
    room = sys.modules[package]
    room.__dict__.update(_homes=homes, __all__=sorted(homes))
    room.__class__ = _Room


class _Room(ModuleType):
    """A package that imports its public names on demand."""

    _homes: Mapping[str, str]

    def __getattr__(self, name: str) -> object:
        """Import a public name or a module; raises AttributeError for what is neither."""
        if not name.startswith("_") and name in self._homes:
            value: object = getattr(import_module(self._homes[name]), name)
            setattr(self, name, value)
            return value
        module = f"{self.__name__}.{name}"
        if name.startswith("_") or find_spec(module) is None:
            raise AttributeError(f"{self.__name__} has no {name}; dir() of it lists what it has")
        return import_module(module)

    def __setattr__(self, name: str, value: object) -> None:
        """Keep a public name where a module is called the same, such as `disting.fit.select`:
        Python sets a module that is imported as an attribute of its package, whenever that is.
        """
        if not (isinstance(value, ModuleType) and name in self._homes):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        """List what the Tab key offers."""
        return sorted(self._homes)
