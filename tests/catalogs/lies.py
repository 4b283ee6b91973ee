"""Lies in records of the shipped files: each leaf changed, removed, or exchanged with that of
another record.
"""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from copy import deepcopy
from functools import cache
from random import Random
from typing import Any

from disting.catalogs.files import shipped_folder

Record = dict[str, Any]
Path = tuple[str | int, ...]
WORDS = {
    "relation": ["distinguishable", "indistinguishable", "sometimes", "undecided"],
    "inclusion": ["left-in-right", "right-in-left", "neither", "unknown", "equal"],
    "share": ["always", "sometimes", "never"],
    "certainty": ["theorem", "proven", "bounded", ""],
    "decided_by": ["1", "2", "3", "4", "5", "6", "7", "8", "9", "exact", "admissible", ""],
    "representation": ["tf", "markov", "structure", "fibre", "parameters", ""],
    "kind": ["counts", "renaming", "free-choice", "solved", "limit", "theorem"],
    "finding": ["holds", "fails", "sometimes", "abandoned"],
}


@cache
def records(name: str) -> list[Record]:
    """All records of a shipped file, the header first."""
    text = (shipped_folder() / f"{name}.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def leaves(value: Any, path: Path = ()) -> Iterator[Path]:
    """Yield the paths of all leaves; empty lists and dictionaries are leaves."""
    if isinstance(value, dict | list) and value:
        parts = value.items() if isinstance(value, dict) else enumerate(value)
        for key, part in parts:
            yield from leaves(part, (*path, key))
    else:
        yield path


def leaf(record: Record, path: Path) -> Any:
    """The value at a path; raises LookupError or TypeError where there is none."""
    value: Any = record
    for key in path:
        value = value[key]
    return value


def with_leaf(record: Record, path: Path, value: Any) -> Record:
    """A copy with another value at a path."""
    found = deepcopy(record)
    leaf(found, path[:-1])[path[-1]] = value
    return found


def without_leaf(record: Record, path: Path) -> Record:
    """A copy without the leaf."""
    found = deepcopy(record)
    del leaf(found, path[:-1])[path[-1]]
    return found


def others(value: Any, path: Path) -> list[Any]:
    """Other values of a leaf: other words of its kind, neighbours of a number."""
    names = [key for key in path if isinstance(key, str)]
    words = next((WORDS[n] for n in names[-1:] if n in WORDS and isinstance(value, str)), None)
    if words is not None:
        return [w for w in words if w != value]
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, -value - 1]
    if isinstance(value, str):
        return [value + "7", "x", ""]
    return [1, ["x"], {"kind": "x"}]


def lies(record: Record, path: Path, strangers: list[Record]) -> Iterator[tuple[str, Record]]:
    """Yield (how, record with one lie at the path)."""
    value = leaf(record, path)
    for other in others(value, path):
        if other != value:
            yield f"{value!r:.40} -> {other!r:.40}", with_leaf(record, path, other)
    yield f"{value!r:.40} removed", without_leaf(record, path)
    for stranger in strangers:
        try:
            other = leaf(stranger, path)
        except (LookupError, TypeError):
            continue
        if other != value and not isinstance(other, dict | list):
            yield f"{value!r:.40} <-> {other!r:.40}", with_leaf(record, path, other)
            break


def sampled(name: str, kinds: Callable[[Record], str], each: int) -> Iterator[Record]:
    """Yield up to so many records of each kind, by a seed."""
    draw, of = Random(name), Counter[str]()
    for record in draw.sample(records(name)[1:], len(records(name)) - 1):
        of[kind := kinds(record)] += 1
        if of[kind] <= each:
            yield record


def kinds_of(record: Record) -> str:
    """Kinds of evidence in a record, as the kind of the record."""

    def walk(value: Any) -> Iterator[str]:
        if isinstance(value, dict):
            yield from [value["kind"]] if isinstance(value.get("kind"), str) else []
            value = list(value.values())
        for part in value if isinstance(value, list) else ():
            yield from walk(part)

    return " ".join(sorted({*walk(record)})) + " as" * ("as" in record)


def kind_at(record: Record, path: Path) -> str:
    """Kind of the innermost evidence around a leaf, "" outside of evidence."""
    around = [leaf(record, path[:i]) for i in range(len(path))]
    return next((e["kind"] for e in reversed(around) if isinstance(e, dict) and "kind" in e), "")


def spell(path: Path) -> str:
    """A path as text, places in lists as *.

    >>> spell(("tf", "evidence", "rows", 3))
    'tf.evidence.rows.*'
    """
    return ".".join("*" if isinstance(key, int) else key for key in path)
