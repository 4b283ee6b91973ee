"""The text of all that makes a value what it is: keys of what is kept and labels of random points
are made of it.

It is not `repr`, which is made for a reader and may leave things out: a key that leaves something
out serves one model's answer for another one.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

PLAIN = {int, str, bool, float, complex, type(None)}  # whose `repr` tells all


def full_text(value: Any) -> str:
    """A value with all fields of all dataclasses in it, but for those that say `repr=False`; what
    is no dataclass, tuple, list or mapping, by its `repr`. A dataclass whose text must not change
    with its layout says its fields in `written_fields`.

    Raises ValueError for a whole number of more digits than Python writes in decimal.

    >>> from disting import Chain
    >>> full_text((Chain(1),))[:42], repr((Chain(1),))[:18]
    ('(Chain(n_masses=1, gap=0, act_minus=0, act', '(<Chain: 1:1 [1FS]')
    """
    kind = type(value)
    if kind in PLAIN or isinstance(value, str):
        return repr(value)
    if isinstance(value, tuple) and PLAIN.issuperset(map(type, value)):
        return repr(value)  # a named tuple says its name
    if kind is tuple:
        parts = ", ".join(map(full_text, value))
        return f"({parts},)" if len(value) == 1 else f"({parts})"
    if kind is list:
        return f"[{', '.join(map(full_text, value))}]"
    if is_dataclass(kind):
        own = getattr(value, "written_fields", None)
        inside_fields = (
            {name: getattr(value, name) for name in _names(kind)} if own is None else own
        )
        inside = ", ".join(f"{name}={full_text(item)}" for name, item in inside_fields.items())
        return f"{kind.__qualname__}({inside})"
    if isinstance(value, Mapping):
        parts = ", ".join(f"{full_text(key)}: {full_text(item)}" for key, item in value.items())
        return f"{{{parts}}}"
    return repr(value)


@cache
def _names(kind: type) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind) if field.repr)
