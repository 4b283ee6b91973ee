"""Evidence as plain data and back: its kind and its fields. A class of another layout says so
in methods of these names.
"""

from collections.abc import Iterable
from dataclasses import asdict
from typing import Any


def to_dict(evidence: Any) -> dict[str, object]:
    """Plain data, ready for JSON."""
    if hasattr(evidence, "to_dict"):
        return dict(evidence.to_dict())
    return {"kind": evidence.kind, **asdict(evidence)}


def from_dict(data: dict[str, Any], kinds: Iterable[type[Any]]) -> Any:
    """Evidence of one of these kinds; lists become tuples. Raises KeyError, TypeError or
    ValueError for what is none.
    """
    if data["kind"] == "program":
        raise ValueError(
            "this verdict rests on an external program, which decides nothing now; ask for it again"
        )
    kind = {k.kind: k for k in kinds}[str(data["kind"])]
    if hasattr(kind, "from_dict"):
        return kind.from_dict(data)
    return kind(**fields(data))


def fields(data: dict[str, Any]) -> dict[str, Any]:
    """All but the kind."""
    return {name: tupled(value) for name, value in data.items() if name != "kind"}


def tupled(value: Any) -> Any:
    """Lists as tuples, however deep."""
    return tuple(map(tupled, value)) if isinstance(value, list | tuple) else value
