"""Arguments and attributes that have another name now: the old one is accepted for one version,
with a warning.
"""

import warnings
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from disting.errors import InputError

P = ParamSpec("P")
T = TypeVar("T")
K = TypeVar("K", bound=type)


def renamed(**names: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Accept keyword arguments by their old names too, old=new, with a DeprecationWarning that
    points at the caller. Type checkers know the new names only.

    The decorated function raises InputError if an argument is given by both names.

    >>> @renamed(sensor="quantity")
    ... def show(*, quantity="position"):
    ...     return quantity
    >>> show(quantity="velocity")
    'velocity'
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        """Wrap one function."""
        name = function.__qualname__.removesuffix(".__init__")

        @wraps(function)
        def call(*args: P.args, **keywords: P.kwargs) -> T:
            """Call it with the new names."""
            for old, new in names.items():
                if old not in keywords:
                    continue
                if new in keywords:
                    raise InputError(f"{name}: {old} is the old name of {new}; give {new} alone")
                _warn(f"{name}: the argument {old} is now called {new}")
                keywords[new] = keywords.pop(old)
            return function(*args, **keywords)

        return call

    return decorate


def renamed_attributes(**names: str) -> Callable[[K], K]:
    """Accept the old names of attributes of a dataclass, old=new, where they are read and where an
    object is made, with a DeprecationWarning that points at the caller.

    >>> from dataclasses import dataclass
    >>> @renamed_attributes(sensor="quantity")
    ... @dataclass
    ... class Shown:
    ...     quantity: str = "position"
    >>> Shown(quantity="velocity").quantity
    'velocity'
    """

    def decorate(kind: K) -> K:
        """Add the old names to a class."""
        make = kind.__init__  # type: ignore[misc]
        kind.__init__ = renamed(**names)(make)  # type: ignore[misc]
        for old, new in names.items():
            setattr(kind, old, property(_reader(kind.__name__, old, new)))
        return kind

    return decorate


def _reader(kind: str, old: str, new: str) -> Callable[[object], object]:
    def read(self: object) -> object:
        _warn(f"{kind}: the attribute {old} is now called {new}")
        return getattr(self, new)

    read.__doc__ = f"Old name of `{new}`."
    return read


def _warn(text: str) -> None:
    """Warn whoever called what calls this."""
    message = f"{text}; the old name works in this version only"
    warnings.warn(message, DeprecationWarning, stacklevel=3)
