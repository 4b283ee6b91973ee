"""A verdict is checked from its file alone, and a file that was altered is found."""

import json
from copy import deepcopy
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest

from disting import Chain, Experiment, Family, Query, Relation, Settings, View, verdict_file, verify
from disting.catalogs import catalog
from disting.decide.same.exact import by_synthesis
from disting.model.symmetry import canonical
from disting.verdict.verification import Status
from tests.cli.process import called
from tests.verdict.lies import ENGINE, missed, plain, told_again

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


@pytest.mark.thin(1)
@pytest.mark.parametrize("kind", KINDS)
def test_what_was_decided_holds(kind: str) -> None:
    left, right, view = KINDS[kind]
    assert verify(plain(left, right, view)).sentence == "holds"


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize("kind", ["ranks", "both ways", "dead time"])
def test_every_altered_leaf_is_found(kind: str) -> None:
    left, right, view = KINDS[kind]
    assert not missed(plain(left, right, view))


@pytest.mark.slow
@pytest.mark.parametrize("kind", [k for k in KINDS if k not in ("ranks", "both ways", "dead time")])
def test_every_altered_leaf_is_found_in_every_kind_of_verdict(kind: str) -> None:
    test_every_altered_leaf_is_found(kind)


@pytest.mark.full
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


NEITHER = {"closure": "neither", "image": "neither"}
ONE_SIDED = {"closure": "left-in-right", "image": "left-in-right"}


@pytest.mark.full
@pytest.mark.parametrize(
    ("lies", "said"),
    [
        ({"inclusions": {}, **ONE_SIDED}, "an inclusion has no evidence"),
        ({"inclusions": {}, **NEITHER}, "an inclusion that is denied has no evidence"),
        ({"of": "inclusion"}, "an inclusion is stated for models of equal rank"),
        ({"of": "shares"}, "positive equivalents are stated for models for which they are not"),
        (
            {"beside": {"closure": "unknown", "image": "unknown"}},
            "the statement on complex parameters differs from the verdict over them",
        ),
        (
            {"beside": {"relation": "distinguishable"}},
            "it rests on equality over complex parameters, which the file does not show",
        ),
    ],
    ids=str,
)
def test_who_adds_to_a_verdict_what_it_does_not_show_is_found_too(
    lies: dict[str, Any], said: str
) -> None:
    data = plain("3:1", "3:11")
    if lies.get("of") == "inclusion":
        other = plain("3:6", "3:7", View.EXACT)
        data = plain("3:1", "3:4", View.EXACT)
        lies = {name: other[name] for name in ("inclusions", "closure", "image")}
    elif lies.get("of") == "shares":
        lies, data = {"left_positive": data["left_positive"]}, plain("2:1", "3:4")
    elif "beside" in lies:
        lies = {"over_complex": data["over_complex"] | lies["beside"]}
    assert said in verify(told_again(data, **lies)).sentence


def test_a_verification_is_neither_true_nor_false() -> None:
    with pytest.raises(TypeError, match="use its status"):
        bool(verify(plain("3:1", "3:2")))


FIELDS = ("n_masses", "gap", "act_minus", "act_plus", "meas_minus", "meas_plus")


@pytest.mark.slow
def test_a_bound_of_shares_that_was_raised_is_found_though_the_evidence_is_true() -> None:
    """What the evidence shows was true, and the bound that was told with it was not looked at."""
    row = plain("5:3", "5:8", View.EXACT, damped=True)
    assert (row["evidence"]["kind"], verify(row).sentence) == ("shared", "holds")
    sure = verify(told_again(row, safety=row["safety"] + 100)).sentence
    assert sure == "does not hold: the certainty is not that of the evidence"


@pytest.mark.full
@pytest.mark.parametrize(("left", "right"), [("3:3", "3:11"), ("3:1", "3:7")])
def test_a_bound_of_an_inclusion_that_was_raised_is_found(left: str, right: str) -> None:
    """An ideal refutes the one, a fibre tells the other."""
    data = plain(left, right, View.EXACT, damped=False)
    surer = deepcopy(data["inclusions"])
    for told in surer.values():
        told["safety"] += 100 * bool(told["safety"])
    assert verify(data).sentence == "holds" and surer != data["inclusions"]
    assert "its certainty" in verify(told_again(data, inclusions=surer)).sentence


@pytest.mark.full
@pytest.mark.parametrize("also", [None, [Experiment(), Experiment(sensor=1)]])
def test_a_limit_that_the_relative_degree_denied_does_not_hold(also: Any) -> None:
    """As a file of version 0.2.0 says it of T1 -> 0: proven, and false."""
    sides = (Chain(2), Chain(2, lag=True))
    data = plain(*sides, **({} if also is None else {"experiments": also}))
    assert verify(data).sentence == "holds"
    assert not data["left_positive"]  # no finite elements do it, so no positive ones
    counts = {"kind": "counts", "left": [2, 2], "right": [2, 3]}
    lie = {
        "inclusion": "neither",
        "certainty": "proven",
        "safety": 0,
        "evidence": counts,
        "reason": "",
    }
    both = {"image": "neither", "closure": "neither", "inclusions": {"closure": lie, "image": lie}}
    assert "is not true of these models" in verify(told_again(data, **both)).sentence


def test_a_fibre_of_models_of_unequal_rank_does_not_make_them_the_same() -> None:
    """3:7 lies in 3:1, so a fibre of 3:1 over a point of 3:7 is not empty; the reverse is."""
    data = plain("3:1", "3:7", View.EXACT, damped=False)
    sides = [canonical(Family(3, damped=False)[n]).chain for n in (1, 7)]
    first, second = sorted(sides, key=lambda c: (c.indices, c.ground_dampers, c.lag))
    found = by_synthesis(first, second, Settings())
    assert found is not None
    found = found if first == sides[0] else found.turned
    assert found.outcome.value == "holds" and found.evidence is not None
    lie = {
        "relation": "indistinguishable",
        "decided_by": "exact",
        "representation": "fibre",
        "certainty": "bounded",
        "safety": found.safety,
        "evidence": found.evidence.to_dict(),
        "inclusions": {},
        "image": "equal",
        "closure": "equal",
        "left_positive": {},
        "right_positive": {},
    }
    assert verify(told_again(data, **lie)).status is Status.FAILS


def test_what_is_open_cannot_be_checked_alone() -> None:
    found = verify(plain("3:1", "3:11", View.COMBINED))
    assert found.status is Status.OPEN and "because it is undecided" in found.sentence


def test_what_is_open_is_decided_by_nothing() -> None:
    data = plain("R1-p(R2,W1)", "p(R1,R2-W1)", View.COMBINED)
    data |= {"relation": "undecided", "evidence": {}, "decided_by": "", "representation": "",
             "certainty": "", "image": "unknown", "closure": "unknown"}  # fmt: skip
    assert verify(told_again(data)).status is Status.OPEN
    for lie in ({"decided_by": "7"}, {"decided_by": "exact"}, {"safety": 1}):
        assert verify(told_again(data, **lie)).status is Status.FAILS


@pytest.mark.full
def test_models_are_named_wholly_with_damping_and_sensor() -> None:
    data = plain("3:1+b2+lag", "A4", damped=False, quantity="velocity")
    assert (data["left"], data["right"]) == ("3:1+b2+lag", "3:4")
    first = data["models"][0]
    assert (first["name"], first["damped"], first["sensor"]) == ("3:1+b2+lag", False, "velocity")
    assert first["ground_dampers"] == [2] and first["lag"] and not first["dead_time"]
    mixed = json.loads(
        json.dumps(verdict_file(Chain(2, damped=False), Chain(2, damped=True), engine=ENGINE))
    )
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
            assert verify(data).status is (Status.HOLDS if known else Status.OPEN), (i, j)


@pytest.mark.full
def test_the_command_checks_files_and_pairs(tmp_path: Path) -> None:
    path = tmp_path / "verdict.json"
    path.write_text(called("compare", "4:4", "A1", "--undamped", "--json").stdout, encoding="utf-8")
    done = called("verify", path)
    assert done.returncode == 0 and done.stdout.startswith(f"{path}: holds\n4:1 and 4:4, undamped")
    path.write_text(path.read_text(encoding="utf-8").replace('"4:4"', '"4:5"'), encoding="utf-8")
    done = called("verify", path)
    assert done.returncode == 1 and f"{path}: does not hold: " in done.stdout
    done = called("verify", "3:1", "3:4", "--prove")
    assert done.returncode == 0 and done.stdout.startswith("3:1 and 3:4: holds\n")
    assert done.stdout.splitlines()[1].endswith(" Proven.")
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
