"""Arguments that have another name now: the old one is accepted for one version, with a warning."""

import warnings
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from disting.errors import InputError

P = ParamSpec("P")
T = TypeVar("T")


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
        name = function.__name__

        @wraps(function)
        def call(*args: P.args, **keywords: P.kwargs) -> T:
            """Call it with the new names."""
            for old, new in names.items():
                if old not in keywords:
                    continue
                if new in keywords:
                    raise InputError(f"{name}: {old} is the old name of {new}; give {new} alone")
                text = f"{name}: the argument {old} is called {new} now; the next version refuses"
                warnings.warn(f"{text} {old}", DeprecationWarning, stacklevel=2)
                keywords[new] = keywords.pop(old)
            return function(*args, **keywords)

        return call

    return decorate
