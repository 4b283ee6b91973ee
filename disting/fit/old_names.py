"""Keywords of `select` that have another name or another meaning now: the old ones are accepted for
one version, with a warning.
"""

import warnings
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

from disting.errors import InputError

P = ParamSpec("P")
T = TypeVar("T")
RENAMED = {"bounds": "bound", "fixed": "fix", "method": "optimiser", "most_lines": "lines"}


def accept_old_names(select: Callable[P, T]) -> Callable[P, T]:
    """Accept the keywords of before, with a DeprecationWarning that points at the caller: those of
    `RENAMED`, a function as `lines`, `alike`, and a pair of numbers as `weights`.

    The decorated function raises InputError if an argument is given by both names.
    """

    @wraps(select)
    def call(*args: P.args, **keywords: P.kwargs) -> T:
        """Call it with the new names."""
        return select(*args, **_with_new_names(keywords))

    return call


def _with_new_names(keywords: dict[str, Any]) -> Any:
    new = dict(keywords)
    if isinstance(new.get("weights"), tuple):
        _move(new, "weights", "case_weights", new.pop("weights"))
    if callable(new.get("lines")):
        _move(new, "lines", "weights", new.pop("lines"))
    if "alike" in new:
        _move(new, "alike", "weights", "none" if new.pop("alike") else "auto")
    for old, name in RENAMED.items():
        if old in new:
            _move(new, old, name, new.pop(old))
    return new


def _move(keywords: dict[str, Any], old: str, name: str, value: object) -> None:
    if name in keywords:
        raise InputError(f"select: {old} is the old name of {name}; give {name} alone")
    text = f"select: the argument {old} is now called {name}; the old name works in this version"
    warnings.warn(f"{text} only", DeprecationWarning, stacklevel=4)
    keywords[name] = value
