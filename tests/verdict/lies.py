"""Files of verdicts with one thing altered, and whether that is found out."""

import json
from collections.abc import Iterator
from copy import deepcopy
from typing import Any

from disting import Engine, InputError, Query, Relation, View, verdict_file, verify
from disting.verdict.verdict_file import as_file, read_file
from disting.verdict.verification import Status

ENGINE = Engine()
# what other settings and questions would have given the same verdict: nothing follows from them
FREE = {"program", "settings", "query"}
OTHER = {
    "relation": [r.value for r in Relation],
    "share": ["always", "sometimes", "never"],
    "certainty": ["theorem", "proven", "bounded"],
    "domain": ["complex", "real", "positive"],
    "decided_by": ["1", "2", "3", "4", "5", "6", "7", "exact", "admissible"],
}


def plain(left: Any, right: Any, view: View = View.POSITIVE, **said: Any) -> dict[str, Any]:
    query = said.pop("query", Query(view))
    data = verdict_file(left, right, query=query, engine=ENGINE, **said)
    return json.loads(json.dumps(data))  # type: ignore[no-any-return]


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    parts = data.items() if isinstance(data, dict) else enumerate(data)
    for name, value in parts:
        if isinstance(value, dict | list) and value:
            yield from leaves(value, (*path, name))
        else:
            yield (*path, name)


def put(data: dict[str, Any], path: tuple[Any, ...], value: Any) -> dict[str, Any]:
    """A copy with another leaf."""
    found = deepcopy(data)
    place: Any = found
    for name in path[:-1]:
        place = place[name]
    place[path[-1]] = value
    return found


def altered(data: dict[str, Any], path: tuple[Any, ...]) -> Iterator[dict[str, Any]]:
    """The data with one leaf changed, in every way that stands for a sensible lie."""
    value: Any = data
    for name in path:
        value = value[name]
    lies: list[Any] = [v for v in OTHER.get(path[-1], []) if v != value]
    if isinstance(value, bool):
        lies = [not value]
    elif isinstance(value, int):
        lies = [value + 1, max(value - 1, 0)]
    elif isinstance(value, str) and not lies:
        lies = [value + "1", "", "x"]
    elif isinstance(value, dict | list):
        lies = [{"kind": "x"}, ["x"]]
    yield from (put(data, path, lie) for lie in lies if lie != value)


def found_out(data: dict[str, Any]) -> bool:
    try:
        return verify(data).status is Status.FAILS
    except InputError:
        return True


def missed(data: dict[str, Any], *free: str) -> list[tuple[Any, ...]]:
    """Leaves that can be altered without being found out, but for those that are free."""
    return [
        path
        for path in leaves(data)
        if not (FREE | set(free)).intersection(path) or path == ("query", "view")
        for lie in altered(data, path)
        if not found_out(lie)
    ]


def told_again(data: dict[str, Any], **lies: Any) -> dict[str, Any]:
    """A liar who writes all that is derived anew, sentences included."""
    return json.loads(json.dumps(as_file(read_file(data | lies))))  # type: ignore[no-any-return]


def believed(data: dict[str, Any], *free: str) -> list[tuple[Any, ...]]:
    """Leaves of the evidence, and lists of it without their last, that may be altered by a liar who
    writes all that is derived anew.
    """
    evidence = data["evidence"]
    lies = [(path, lie) for path in leaves(evidence) for lie in altered(evidence, path)]
    lies += [(path, put(evidence, path, some[:-1])) for path, some in _lists(evidence)]
    believed_ones = []
    for path, lie in lies:
        if set(free).intersection(path):
            continue
        try:
            again = told_again(data, evidence=lie)
        except (InputError, ValueError, KeyError, TypeError):  # it cannot be told at all
            continue
        believed_ones += [path] if not found_out(again) else []
    return believed_ones


def _lists(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], list[Any]]]:
    parts = data.items() if isinstance(data, dict) else enumerate(data)
    for name, value in parts:
        if isinstance(value, dict | list):
            yield from _lists(value, (*path, name))
        if isinstance(value, list) and value:
            yield (*path, name), value
