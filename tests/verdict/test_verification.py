"""A verdict is checked from its file alone, and a file that was altered is found."""

import json
from collections.abc import Iterator
from copy import deepcopy
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest

from disting import Chain, Engine, Family, InputError, Query, Relation, View, verdict_file, verify
from disting.catalogs import catalog
from disting.verdict.verification import Standing
from tests.cli.process import called

ENGINE = Engine()
KINDS = {
    "counts": ("3:1", "3:2", View.POSITIVE),
    "forms": ("2:1", "2:1+delay", View.COMBINED),
    "ranks": ("3:1", "3:4", View.POSITIVE),
    "renaming": ("3:2", "3:5", View.EXACT),
    "fibre": ("3:1", "3:6", View.POSITIVE),
    "theorem": ("3:1", "3:11", View.EXACT),
    "both ways": ("3:1", "3:11", View.POSITIVE),
    "dead time": ("3:1+delay", "3:11", View.POSITIVE),
    "inclusion": ("3:6", "3:7", View.POSITIVE),
    "across sizes": ("2:1", "3:4", View.POSITIVE),
}
# what other settings and questions would have given the same verdict: nothing follows from them
FREE = {"program", "settings", "query", "reason"}
OTHER = {
    "relation": [r.value for r in Relation],
    "share": ["always", "sometimes", "never"],
    "certainty": ["theorem", "proven", "bounded"],
    "domain": ["complex", "real", "positive"],
    "decided_by": ["1", "2", "3", "4", "5", "6", "7", "exact", "admissible"],
}


def plain(left: str, right: str, view: View = View.POSITIVE, **said: Any) -> dict[str, Any]:
    data = verdict_file(left, right, query=Query(view), engine=ENGINE, **said)
    return json.loads(json.dumps(data))  # type: ignore[no-any-return]


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    parts = data.items() if isinstance(data, dict) else enumerate(data)
    for name, value in parts:
        if isinstance(value, dict | list) and value:
            yield from leaves(value, (*path, name))
        else:
            yield (*path, name)


def altered(data: dict[str, Any], path: tuple[Any, ...]) -> Iterator[dict[str, Any]]:
    """The data with one leaf changed, in every way that stands for a sensible lie."""
    *above, last = path
    parent: Any = data
    for name in above:
        parent = parent[name]
    value = parent[last]
    lies: list[Any] = [v for v in OTHER.get(last, []) if v != value]
    if isinstance(value, bool):
        lies = [not value]
    elif isinstance(value, int):
        lies = [value + 1, max(value - 1, 0)]
    elif isinstance(value, str) and not lies:
        lies = [value + "1", "", "x"]
    elif isinstance(value, dict | list):
        lies = [{"kind": "x"}, ["x"]]
    for lie in lies:
        if lie != value:
            found = deepcopy(data)
            place: Any = found
            for name in above:
                place = place[name]
            place[last] = lie
            yield found


def found_out(data: dict[str, Any]) -> bool:
    try:
        return verify(data).standing is Standing.FAILS
    except InputError:
        return True


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_decided_holds(kind: str) -> None:
    left, right, view = KINDS[kind]
    assert verify(plain(left, right, view)).sentence == "holds"


@pytest.mark.parametrize("kind", ["ranks", "both ways", "dead time"])
def test_every_altered_leaf_is_found(kind: str) -> None:
    left, right, view = KINDS[kind]
    data = plain(left, right, view)
    missed = [
        path
        for path in leaves(data)
        if (not FREE.intersection(path) or path == ("query", "view"))
        # what is proven at one point is proven by any at which the proof goes through
        and not (path[1:3] == ("evidence", "point") and data[path[0]]["certainty"] == "proven")
        for lie in altered(data, path)
        if not found_out(lie)
    ]
    assert not missed


@pytest.mark.slow
@pytest.mark.parametrize("kind", [k for k in KINDS if k not in ("ranks", "both ways", "dead time")])
def test_every_altered_leaf_is_found_in_every_kind_of_verdict(kind: str) -> None:
    test_every_altered_leaf_is_found(kind)


def told_again(data: dict[str, Any], **lies: Any) -> dict[str, Any]:
    """A liar who writes all that is derived anew, sentences included."""
    from disting.verdict.verdict_file import as_file, read_file

    return as_file(read_file(data | lies))


def test_who_alters_a_verdict_and_all_that_is_derived_from_it_is_found_too() -> None:
    ranks, names = plain("3:1", "3:4"), plain("3:1", "3:11")
    numbers = ranks["evidence"] | {"left": 7, "right": 6}
    assert "not true of these models" in verify(told_again(ranks, evidence=numbers)).sentence
    ranks = plain("3:1", "3:4", View.EXACT)
    same = {"relation": "indistinguishable", "closure": "equal", "image": "equal"}
    assert "does not follow" in verify(told_again(ranks, inclusions={}, **same)).sentence
    sure = verify(told_again(ranks, safety=ranks["safety"] + 100)).sentence
    assert sure == "does not hold: the certainty is not that of the evidence"
    other = deepcopy(names)
    chain = Family(3, damped=True)[2]
    other["models"][1] |= {"name": "3:2", **dict(zip(FIELDS, chain.indices, strict=True))}
    for verdict in (other, other["over_complex"]):
        verdict["right"] = "3:2"
    assert "not true of these models" in verify(told_again(other)).sentence


FIELDS = ("n_masses", "gap", "act_minus", "act_plus", "meas_minus", "meas_plus")


def test_what_is_open_cannot_be_checked_alone() -> None:
    found = verify(plain("3:1", "3:11", View.COMBINED))
    assert found.standing is Standing.OPEN and "because it is undecided" in found.sentence


def test_models_are_named_wholly_with_damping_and_sensor() -> None:
    data = plain("3:1+b2+lag", "A4", damped=False, sensor="velocity")
    assert (data["left"], data["right"]) == ("3:1+b2+lag", "3:4")
    first = data["models"][0]
    assert (first["name"], first["damped"], first["sensor"]) == ("3:1+b2+lag", False, "velocity")
    assert first["ground_dampers"] == [2] and first["lag"] and not first["dead_time"]
    mixed = json.loads(json.dumps(verdict_file(Chain(2), Chain(2, damped=True), engine=ENGINE)))
    assert [m["damped"] for m in mixed["models"]] == [False, True]
    assert verify(mixed).sentence == "holds"


@pytest.mark.slow
@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False), (4, True)])
def test_all_verdicts_of_a_catalogue_hold(n: int, damped: bool) -> None:
    family, shipped = Family(n, damped), catalog(n, damped=damped)
    for i, j in combinations(range(1, len(family) + 1), 2):
        for view in View:
            data = verdict_file(family[i], family[j], query=Query(view), engine=ENGINE)
            known = shipped.relation(i, j, view) is not Relation.UNDECIDED
            assert verify(data).standing is (Standing.HOLDS if known else Standing.OPEN), (i, j)


def test_the_command_checks_files_and_pairs(tmp_path: Path) -> None:
    path = tmp_path / "verdict.json"
    path.write_text(called("compare", "4:4", "A1", "--undamped", "--json").stdout, encoding="utf-8")
    done = called("verify", path)
    assert (done.returncode, done.stdout) == (0, f"{path}: holds\n")
    path.write_text(path.read_text(encoding="utf-8").replace('"4:4"', '"4:5"'), encoding="utf-8")
    done = called("verify", path)
    assert done.returncode == 1 and f"{path}: does not hold: " in done.stdout
    done = called("verify", "3:1", "3:4", "--prove")
    assert (done.returncode, done.stdout) == (0, "3:1 and 3:4: holds\n")
    done = called("verify", "3:1", "3:11", "--conditions", "1-9")
    assert done.returncode == 3 and "cannot be checked alone because" in done.stdout


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("{", "holds no JSON"),
        ("[]", "no file of a verdict"),
        ('{"left": "a", "right": "b", "relation": "distinguishable"}', "without its models"),
    ],
)
def test_what_is_no_file_of_a_verdict_is_refused(tmp_path: Path, content: str, says: str) -> None:
    path = tmp_path / "some.json"
    path.write_text(content, encoding="utf-8")
    for arguments in ([path], [tmp_path / "none.json"], ["3:1"], ["3:1", "3:2", "3:3"]):
        done = called("verify", *arguments)
        assert done.returncode == 2 and done.stdout == ""
    assert says in called("verify", path).stderr
