"""What the file of a fit names: the selected structure, its rivals, and how it was measured.

Rivals are the structures that the data do not exclude and those of which it is not known whether
they behave the same. What behaves exactly the same for the fitted values stands apart: no data
with this force and sensor tell it from the selected one.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from disting.errors import InputError
from disting.fit.candidates import reference
from disting.fit.plain import chain_from_dict, model_from_dict
from disting.model.chain import Chain
from disting.verdict import Relation


@dataclass(frozen=True, slots=True)
class Named:
    """`explained`: whether the selected structure explains the data; `same`: names of what behaves
    the same, with the reason; `rivals` with their fitted values, none of those that were not
    fitted; `scatter` of a line; `low`, `high` [Hz] and number of the `lines`, 0
    each where the file does not tell.
    """

    model: Chain
    values: dict[str, float]
    explained: bool
    rivals: dict[Chain, dict[str, float]]
    same: dict[str, str]
    scatter: float
    low: float
    high: float
    lines: int


def named_by(path: Path) -> Named:
    """What a JSON file of `disting fit` names; raises InputError."""
    try:
        plain = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as reason:
        raise InputError(f"{path} is no JSON file of a fit: {reason}") from None
    if not isinstance(plain, dict) or not isinstance(plain.get("selected"), dict):
        raise InputError(f"{path} holds no selected model: name a file of 'disting fit --json'")
    model, values = model_from_dict(plain["selected"])
    try:
        range_of = plain.get("frequencies", {"low": 0.0, "high": 0.0, "lines": 0})
        same = dict(_same(plain))
        return Named(
            model,
            values,
            plain["explained"] is True,
            {c: v for c, v in _rivals(plain) if c != model and reference(c) not in same},
            same,
            float(plain["scatter"]),
            float(range_of["low"]),
            float(range_of["high"]),
            int(range_of["lines"]),
        )
    except (KeyError, TypeError, ValueError, AttributeError) as reason:
        raise InputError(f"{path} is no whole file of a fit: {reason} is missing") from None


def _rivals(plain: dict[str, Any]) -> Iterator[tuple[Chain, dict[str, float]]]:
    """In the order of the file, those with values last, which stand."""
    for found in plain["alternatives"]:
        if found["relation"] != Relation.INDISTINGUISHABLE:
            yield chain_from_dict(found), {}
    yield from map(model_from_dict, plain["not_excluded"][1:])


def _same(plain: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Names and reasons."""
    for found in plain["alternatives"]:
        if found["relation"] == Relation.INDISTINGUISHABLE:
            yield reference(chain_from_dict(found)), found["reason"]
    for member in plain["not_excluded"][:1]:
        for twin in member["equivalents"]:
            yield twin["name"], "the same response for the fitted values"
