"""Files of verdicts on networks that were changed by hand so that they lie: none of them holds."""

from copy import deepcopy

import pytest

from disting import verify
from disting.errors import InputError
from disting.verdict.verdict_file import verdict_file

SAME = ("1~2, 2~3, 1~3; F1:2; S1:2", "1~2~3; F1:2; S1:2")
LIMIT = ("R0-p(R1,C1)", "R0-p(R1,C1)-p(R2,C2)")
ROLES = ("relation", "closure", "image", "domain", "decided_by", "certainty", "inclusion", "name")
WORDS = {
    *("indistinguishable", "distinguishable", "sometimes"),
    *("equal", "left-in-right", "right-in-left", "neither"),
    *("complex", "real", "positive", "1", "4", "6", "7", "8", "exact", "admissible"),
    *("theorem", "proven", "Foster", "Foster and Cauer", "symmetry", "replacement"),
}


def lies(data, path=()):
    """Yield files with one word of a statement, one flag or one place changed."""
    if isinstance(data, dict):
        for key, value in data.items():
            if key not in ("models", "settings", "query", "sentence", "program"):
                yield from ((key, *rest) for rest in lies(value, key))
    elif isinstance(data, list):
        for at, value in enumerate(data):
            yield from ((at, *rest) for rest in lies(value, path))
    elif isinstance(data, bool):
        yield (not data,)
    elif isinstance(data, int) and path == "places":
        yield (data + 1,)
    elif path in ROLES and data in WORDS:
        yield from ((word,) for word in sorted(WORDS - {data}))


def put(data, path):
    made = deepcopy(data)
    *way, last, value = path
    inside = made
    for step in way:
        inside = inside[step]
    inside[last] = value
    return made


def holds(data):
    try:
        return verify(data).status.value == "holds"
    except InputError:
        return False


@pytest.mark.full
@pytest.mark.parametrize("pair", [SAME, LIMIT])
def test_no_statement_can_be_changed(pair):
    data = verdict_file(*pair)
    assert holds(data)
    changed = list(lies(data))
    assert len(changed) > 40
    assert not [path for path in changed if holds(put(data, path))]


@pytest.mark.full
def test_a_sensor_that_is_turned_is_seen():
    data = verdict_file(*SAME)
    assert data["evidence"] == {"kind": "theorem", "name": "replacement"}
    assert data["models"][1]["sensor"] == [[1, 2]]
    assert not holds(put(data, ("models", 1, "sensor", [[2, 1]])))


@pytest.mark.parametrize("names", [("missing",), ("rigid",)])
def test_what_is_left_out_is_told_as_it_is(names):
    data = verdict_file(*LIMIT)
    way = ("inclusions", "closure", "evidence", *names)
    for told in ([], ["R1"], ["R0", "C1"]):
        assert not holds(put(data, (*way, told)))
