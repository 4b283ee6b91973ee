"""Evidence as plain data and back: its kind and its fields. A class of another layout says so
in methods of these names.
"""

from collections.abc import Iterable
from dataclasses import asdict, is_dataclass
from types import UnionType
from typing import Any, ClassVar, Union, get_args, get_origin, get_type_hints

GONE = {
    "program": "an external program, which decides nothing now",
    "row": "an answer about rows of masses that is shipped no more",
}  # kinds that older versions wrote, each with what it rested on


def to_dict(evidence: Any) -> dict[str, object]:
    """Plain data, ready for JSON."""
    if hasattr(evidence, "to_dict"):
        return dict(evidence.to_dict())
    return {"kind": evidence.kind, **asdict(evidence)}


def from_dict(data: dict[str, Any], kinds: Iterable[type[Any]]) -> Any:
    """Evidence of one of these kinds; lists become tuples. Raises KeyError, TypeError or
    ValueError for what is none.
    """
    name = str(data["kind"])
    if name in GONE:
        raise ValueError(f"this verdict rests on {GONE[name]}; ask for it again")
    kind = {k.kind: k for k in kinds}[name]
    if hasattr(kind, "from_dict"):
        return kind.from_dict(data)
    return kind(**fields(data))


def fields(data: dict[str, Any]) -> dict[str, Any]:
    """All but the kind."""
    return {name: tupled(value) for name, value in data.items() if name != "kind"}


def tupled(value: Any) -> Any:
    """Lists as tuples, however deep."""
    return tuple(map(tupled, value)) if isinstance(value, list | tuple) else value


def is_well_typed(evidence: Any) -> bool:
    """Whether every field of evidence, however deep, is of the type that its class says: what a
    file holds may be anything. None is no evidence.
    """
    return evidence is None or all(
        _is_of(getattr(evidence, name), hint) for name, hint in _hints(type(evidence)).items()
    )


def _hints(kind: type[Any]) -> dict[str, Any]:
    """Types of the fields of a dataclass or a named tuple."""
    found = get_type_hints(kind)
    return {name: hint for name, hint in found.items() if get_origin(hint) is not ClassVar}


def _is_of(value: Any, hint: Any) -> bool:
    if get_origin(hint) in (Union, UnionType):
        return any(_is_of(value, one) for one in get_args(hint))
    if get_origin(hint) is tuple:
        return isinstance(value, tuple) and _items_are_of(value, get_args(hint))
    if hint in (int, bool, str):
        return type(value) is hint
    whole = is_dataclass(hint) or hasattr(hint, "_fields")
    return isinstance(value, hint) and (not whole or is_well_typed(value))


def _items_are_of(value: tuple[Any, ...], items: tuple[Any, ...]) -> bool:
    if items[1:] == (Ellipsis,):
        return all(_is_of(item, items[0]) for item in value)
    return len(value) == len(items) and all(map(_is_of, value, items))
