"""Packages whose public names are imported when they are used.

A package that imports all that it offers makes every import of one of its modules an import of all
of them. So it lists its names once, as imports below `if TYPE_CHECKING`: type checkers, editors and
the digest of the code behind a cached result read them there. Python skips them; `offer` reads the
same lines when a name is first used.

Every package loads this module, so it imports nothing that Python has not loaded already.
"""

import sys

TYPE_CHECKING = False  # the name that type checkers know; the module typing would double the start
if TYPE_CHECKING:
    from types import ModuleType
    from typing import Any
else:
    ModuleType = type(sys)


OLD_NAMES = {"disting.Sensor": "Quantity"}  # of public names


def offer(package: str) -> ModuleType:
    """Make the names public that a package lists below `if TYPE_CHECKING`, as `X as X`; return the
    package. Called at the end of its `__init__`.

    >>> import disting.measurement
    >>> disting.measurement.read.__module__
    'disting.measurement.files'
    """
    room = sys.modules[package]
    room.__class__ = _Room
    return room


def homes_in(source: str) -> dict[str, str]:
    """Return the modules of public names, by name, from the source of an `__init__`.

    >>> homes_in("if TYPE_CHECKING:\\n    from disting.store import Store as Store\\n")
    {'Store': 'disting.store'}
    """
    import re

    imports = re.findall(r"^    from ([\w.]+) import (\([^)]*\)|.*)$", source, re.MULTILINE)
    return {
        name: module for module, names in imports for name in re.findall(r"(\w+) as \1\b", names)
    }


class _Room(ModuleType):
    """A package that imports its public names on demand."""

    def __getattr__(self, name: str) -> object:
        """Import a public name or a module; raises AttributeError for what is neither."""
        from importlib import import_module
        from importlib.util import find_spec

        if (new := OLD_NAMES.get(f"{self.__name__}.{name}")) is not None:
            return _under_new_name(self, name, new)
        module = _homes(self).get(name, self.__name__)
        if module != self.__name__:
            value: object = getattr(import_module(module), name)
            setattr(self, name, value)
            return value
        here = self.__name__
        if name.startswith("_") or find_spec(f"{here}.{name}") is None:
            raise AttributeError(f"{here} has no {name}; dir({here}) lists what it has")
        return import_module(f"{here}.{name}")

    def __setattr__(self, name: str, value: object) -> None:
        """Keep a public name where a module is called the same, such as `disting.fit.select`:
        Python sets a module that is imported as an attribute of its package, whenever that is.
        """
        if not (isinstance(value, ModuleType) and name in _names(self)):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        """List what the Tab key offers."""
        return sorted(_homes(self))

    @property
    def __all__(self) -> list[str]:
        """Names that `from disting import *` gives.

        pydoc documents every member of everything in such a list, for `disting` on 7,400 lines.
        Without a list it prints the docstring, which has the names by subject.
        """
        caller = sys._getframe(1)
        for frame in (caller, caller.f_back):  # `disting` asks for a caller once
            if frame and frame.f_globals.get("__name__") == "pydoc":
                raise AttributeError("__all__")
        return [name for name in _names(self) if not name.startswith("_")]


def _under_new_name(package: ModuleType, old: str, new: str) -> object:
    """Return what a package calls `new`, with a DeprecationWarning."""
    import warnings

    here = package.__name__
    text = f"{here}.{old} is now {here}.{new}; the old name works in this version only"
    warnings.warn(text, DeprecationWarning, stacklevel=3)
    value: object = getattr(package, new)
    return value


def _names(package: ModuleType) -> list[str]:
    """Public names in order, without packages inside of this one."""
    return sorted(name for name, home in _homes(package).items() if home != package.__name__)


def _homes(package: ModuleType) -> dict[str, str]:
    """Return the modules of the public names of a package; read once."""
    if "_homes" not in package.__dict__:
        spec: Any = package.__spec__
        package.__dict__["_homes"] = homes_in(spec.loader.get_source(package.__name__))
    homes: dict[str, str] = package.__dict__["_homes"]
    return homes
