"""Verdicts under further experiments and on general models are checked from their files alone."""

import json
from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from disting import (
    Experiment,
    Family,
    InputError,
    MatrixModel,
    Model,
    Query,
    View,
    everywhere_file,
    verify,
)
from disting.decide import asking
from disting.errors import NotSeenError
from disting.evidence.kinds import evidence_from
from disting.general import model_evidence
from disting.general.any_model import of_network
from disting.general.newton import find_equivalent
from disting.network import network_of
from disting.verdict.verdict_file import read_file
from disting.verdict.verification import Status
from tests.cli.process import called
from tests.verdict.lies import ENGINE, believed, found_out, missed, plain, put, told_again

A, U = Family(3, damped=True), Family(3, damped=False)
FIRST = Experiment()
FEW = ("1", "2")  # conditions, so that ideals and lists have to decide


def inertia(left: int, right: int) -> tuple[Experiment, Experiment]:
    return Experiment(inertias={left: "1/2"}), Experiment(inertias={right: "1/2"})


def sensor(left: int, right: int) -> tuple[Experiment, Experiment]:
    return Experiment(sensor=left), Experiment(sensor=right)


def few(view: View = View.EXACT) -> Query:
    return Query(view, FEW)


def tf(text: str, name: str) -> Model:
    return Model.from_transfer_function(text, name=name)


LEAK = Model.from_state_space(
    [["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1], name="irreversible"
)
BACK = Model.from_state_space(
    [["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1], name="reversible"
)
ROOT, PLUS = tf("k/(s + k**2)", "square"), tf("(k + 1)/(s + (k + 1)**2)", "shifted")
FULL, HALF = tf("(a + b)/(s + a*b)", "sum"), tf("p/(s + q)", "plain")
SINGLE, DOUBLE = tf("1/(s + k)", "one"), tf("2/(s + k)", "two")
MATRIX = MatrixModel.from_transfer_functions([["1/(m*s**2 + k)"], ["s/(m*s**2 + k)"]], name="m")
NAMED = MatrixModel.from_transfer_functions([["1/(a*s**2 + b)"], ["s/(a*s**2 + b)"]], name="n")
OTHER = MatrixModel.from_transfer_functions([["1/(a*s**2 + b)"], ["s/(a*s**2 + 2*b)"]], name="o")
RC = [tf("R0 + R1/(1 + R1*C1*s) + R2/(1 + R2*C2*s)", "Voigt")]
RC += [tf("R0 + 1/(s*C1 + 1/(R1 + 1/(s*C2 + 1/R2)))", "ladder")]
Case = tuple[Any, Any, dict[str, Any]]
MEASURED: dict[str, Case] = {
    "counts": (A[3], A[7], {"experiments": [FIRST, sensor(3, 1)]}),
    "forms": (U[4], U[8], {"experiments": [FIRST, (Experiment(force=2), Experiment(force=1))]}),
    "ranks": (A[1], A[7], {"experiments": [FIRST, inertia(1, 2)]}),
    "renaming": (A[2], A[5], {"experiments": [FIRST, sensor(2, 3)]}),
    "fibre under experiments": (
        A[2],
        A[5],
        {"experiments": [FIRST, inertia(1, 2)], "query": few()},
    ),
    "solved": (A[2], A[5], {"experiments": [FIRST, inertia(1, 3)], "query": few()}),
    "both ways": (U[8], U[11], {"experiments": [FIRST, sensor(1, 2)]}),
    "theorem": (
        U[1],
        U[4],
        {"experiments": [FIRST, (Experiment(locked=1), Experiment(locked=2))]},
    ),
    "fibre": (A[1], A[6], {"experiments": [FIRST]}),
}
GENERAL: dict[str, Case] = {
    "counts": (SINGLE, LEAK, {}),
    "forms": (tf("1/(s + k)", "a"), tf("k/(s + 1)", "b"), {}),
    "ranks": (ROOT, HALF, {}),
    "renaming": (MATRIX, NAMED, {}),
    "free-choice": (FULL, HALF, {"view": View.EXACT}),
    "embedding": ("L1-p(R1,C1)", "p(L1,L2)-p(R1,C1)", {"view": View.EXACT}),
    "embedding, positive": ("1=2, 1=3; F1; S2", "1=2, 1=3, 2=3; F1; S2", {}),
    "explicit, a value of 0": (
        "1>0, 1>2, 1>3, 2>0, 2>1, 3>0, 3>1; in 2; out 2",
        "1>0, 1>2, 1>3, 2>0, 2>1, 2>3, 3>0, 3>1; in 2; out 2",
        {"view": View.REAL},
    ),
    "constants": (tf("(s + 2)/(s + 3 + 0*k)", "a"), tf("(s + 2)/(s + 4 + 0*k)", "b"), {}),
    "solved": (ROOT, PLUS, {"view": View.EXACT, "query": few()}),
    "refuted": (ROOT, tf("k/(s + k**3)", "cube"), {}),
    "witnesses": (LEAK, BACK, {}),
    "no equivalent": (ROOT, tf("-k/(s + k**2)", "negative"), {}),
    "explicit": (tf("a/(s + b)", "plain"), tf("p*q/(s + q)", "gain"), {}),
    "theorem": (*RC, {}),
    "matrix forms": (MATRIX, OTHER, {}),
}
CASES = {f"measured: {k}": v for k, v in MEASURED.items()} | {
    f"general: {k}": v for k, v in GENERAL.items()
}


def told(name: str) -> dict[str, Any]:
    left, right, said = CASES[name]
    return plain(left, right, **said)


@pytest.mark.sampled(15)
@pytest.mark.full
@pytest.mark.parametrize("name", CASES)
def test_what_was_decided_holds_from_its_file_alone(name: str) -> None:
    assert verify(told(name)).sentence == "holds"


@pytest.mark.full
def test_every_kind_of_evidence_is_among_the_cases() -> None:
    kinds = {told(name)["evidence"]["kind"] for name in CASES}
    assert kinds >= {"counts", "forms", "ranks", "renaming", "free-choice", "constants"}
    assert kinds >= {"fibre under experiments", "solved", "refuted", "fibre", "both ways"}
    assert kinds >= {"witnesses", "no equivalent", "explicit", "theorem", "embedding"}


def lies(data: dict[str, Any]) -> list[dict[str, Any]]:
    """Of a liar who writes all that is derived anew: surer, by another rule, another relation, or
    of the models in the other order.
    """
    told: list[dict[str, Any]] = [{"decided_by": "4"}, {"decided_by": "7"}]
    told += [{"relation": r} for r in ("distinguishable", "indistinguishable", "sometimes")]
    told += [{"certainty": c, "safety": 0} for c in ("theorem", "proven")]
    told += [{"certainty": "bounded", "safety": s} for s in (data["safety"] + 1, 10**6)]
    told += [{"domain": d} for d in ("complex", "real", "positive")]
    found = [lie for lie in told if any(data[name] != x for name, x in lie.items())]
    return [*found, {"models": data["models"][::-1]}]


@pytest.mark.sampled(10)
@pytest.mark.full
@pytest.mark.parametrize("name", CASES)
def test_who_lies_and_writes_all_that_is_derived_anew_is_found_out(name: str) -> None:
    data = told(name)
    believed = []
    for lie in lies(data):
        try:
            again = told_again(data, **lie)
        except (ValueError, KeyError):  # it cannot be told at all
            continue
        believed += [lie] if not found_out(again) else []
    assert not believed


SYMMETRIC = ("measured: renaming", "measured: theorem", "general: free-choice", "general: theorem")


@pytest.mark.thin(1)
@pytest.mark.parametrize("name", [name for name in CASES if name not in SYMMETRIC])
def test_models_that_change_places_with_their_names_are_found_out(name: str) -> None:
    data = told(name)
    names = {"left": data["right"], "right": data["left"]}
    lie: dict[str, Any] = {"models": data["models"][::-1], **names}
    if "experiments" in data:
        pairs = [{"left": e["right"], "right": e["left"]} for e in data["experiments"]]
        lie["experiments"] = pairs
    if data["over_complex"]:
        lie["over_complex"] = data["over_complex"] | names
    assert verify(told_again(data, **lie)).status is Status.FAILS


@pytest.mark.full
@pytest.mark.parametrize("name", ["measured: fibre under experiments", "general: witnesses"])
def test_every_altered_leaf_is_found(name: str) -> None:
    """Another model or experiment may be one of which the verdict is as true."""
    assert not missed(told(name), "num", "den", "G", "elements", "experiments", "rounded")


@pytest.mark.sampled(4)
@pytest.mark.full
@pytest.mark.parametrize(
    ("name", "free"),
    [
        ("measured: fibre", "left_given"),  # a symmetric pair
        ("measured: renaming", ""),
        ("general: refuted", "degree"),  # a contradiction is one in larger degrees too
        ("general: solved", ""),
        ("general: no equivalent", ""),
        ("general: explicit", ""),
        ("general: witnesses", "equivalent"),  # to a part in 100,000
    ],
)
def test_who_alters_evidence_and_writes_all_that_is_derived_anew_is_found_out(
    name: str, free: str
) -> None:
    assert not believed(told(name), *free.split())


@pytest.mark.full
@pytest.mark.parametrize(
    "lie",
    [
        lambda points: [["k01", "99"], *points],
        lambda points: points * 2,
        lambda points: points[::-1],
        lambda points: points[:-1],
        *(
            lambda points, text=text: [[points[0][0], text.format(points[0][1])], *points[1:]]
            for text in ("\n{}", "{}0", "{}1234567", "1{}", "0", "-1", "1e400", "abc", "")
        ),
    ],
)
def test_an_equivalent_is_written_as_it_is_rounded_each_value_once(lie: Callable[..., Any]) -> None:
    data = told("general: witnesses")
    evidence = data["evidence"]
    altered = put(evidence, ("equivalent",), lie(evidence["equivalent"]))
    assert found_out(told_again(data, evidence=altered))
    sides = read_file(data).sides(ENGINE)
    assert not asking.confirms(sides.left, sides.right, evidence_from(altered), "parameters")


@pytest.mark.parametrize(
    ("pair", "asked"),
    [
        (("1=2; F1; S2", "1=2; F1; S1"), Query(View.TF, ("4",))),
        (("2:1", "3:1"), Query(View.TF, ("4",))),
        (("2:1", "3:1+delay"), Query(View.POSITIVE, ("1", "2", "4"))),
        (("3:1", "3:1+delay"), Query(View.POSITIVE, ("1", "2", "4"))),
    ],
)
def test_ranks_of_all_rows_are_those_of_either_model(pair: tuple[str, str], asked: Query) -> None:
    """The rows that are named are those of the left one: the right one may have others."""
    for left, right in (pair, pair[::-1]):
        assert verify(plain(left, right, query=asked)).sentence == "holds"


ALTERED: dict[str, tuple[Case, Callable[[Any], Any]]] = {
    "all rows": (
        (Family(4, damped=False)[5], Family(4, damped=False)[10], {}),
        lambda e: replace(e, rows=e.rows[:-1]),
    ),
    "symmetries": (("3:2", "3:5", {"view": View.EXACT}), lambda e: replace(e, symmetries=("x",))),
    "solutions": (("3:1", "3:6", {}), lambda e: replace(e, solutions=1)),
    "contradictions": (GENERAL["no equivalent"], lambda e: replace(e, contradictions=("p0",))),
    "a condition": (
        GENERAL["explicit"],
        lambda e: replace(
            e, formulas=tuple((side, ("x",), values, root) for side, _, values, root in e.formulas)
        ),
    ),
    "a scale": (
        ("R1-p(R2,C1)", "p(R1,R2-C1)", {"view": View.EXACT, "query": few()}),
        lambda e: replace(e, solutions=tuple((*q[:-1], q[-1] + 1) for q in e.solutions)),
    ),
}


@pytest.mark.parametrize("what", ALTERED)
def test_evidence_is_looked_at_wholly_without_the_rest_of_the_file(what: str) -> None:
    """Catalogues and lists show it too."""
    case, altered = ALTERED[what]
    stored = read_file(plain(*case[:2], **case[2]))
    sides, verdict = stored.sides(ENGINE), stored.verdict
    evidence, representation = verdict.evidence, verdict.representation
    assert asking.confirms(sides.left, sides.right, evidence, representation)
    assert not asking.confirms(sides.left, sides.right, altered(evidence), representation)


@pytest.mark.slow
def test_another_processor_ends_at_another_equivalent_of_a_curve() -> None:
    """A search in rounded numbers does, where six unknowns have five equations."""
    pair = "1>0, 1>2, 1>3, 2>0, 2>3, 3>1; in 1; out 2", "1>0, 1>2, 1>3, 2>1, 2>3, 3>2; in 1; out 2"
    data = plain(*pair)
    evidence, (one, other) = data["evidence"], map(of_network, map(network_of, pair))
    assert (evidence["kind"], evidence["with_left_given"]) == ("witnesses", True)
    point = {name: Fraction(x) for name, x in evidence["point_with"]}
    start = [1.02 * float(x) for _, x in evidence["equivalent"]]
    found = find_equivalent(one, point, other, start)
    assert found is not None
    for values, holds in ((found, True), ([2 * found[0], *found[1:]], False)):
        texts = [[name, f"{x:.6g}"] for name, x in zip(other.parameters, values, strict=True)]
        assert texts != evidence["equivalent"]
        again = told_again(data, evidence=put(evidence, ("equivalent",), texts))
        assert found_out(again) is not holds


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_every_altered_leaf_is_found_in_every_case(name: str) -> None:
    test_every_altered_leaf_is_found(name)


@pytest.mark.full
def test_experiments_and_models_are_named_wholly() -> None:
    data = told("measured: solved")
    there = data["experiments"][1]["right"]
    assert there["inertias"] == [[3, "1/2"]] and there["force"] is None
    assert verify(put(data, ("experiments", 1, "right", "inertias"), [[3, "1/3"]])).status is (
        Status.FAILS
    )
    assert told("general: witnesses")["models"][0] == {
        "name": "irreversible",
        "num": ["k12"],
        "den": ["1", "k01 + k02 + k12", "k01*k02 + k02*k12"],
    }


@pytest.mark.full
def test_every_place_is_a_verdict_of_its_own_and_none_may_be_left_away() -> None:
    data = json.loads(json.dumps(everywhere_file(A[1], A[4], ["sensor=3"], engine=ENGINE)))
    assert verify(data).sentence == "holds"
    assert [one["places"] for one in data["verdicts"]] == [{"3": 1}, {"3": 2}, {"3": 3}]
    lies = [
        put(data, ("verdicts",), data["verdicts"][:2]),
        put(data, ("verdicts",), data["verdicts"][::-1]),
        put(data, ("answer",), "never"),
        put(data, ("experiments", 1), "sensor 2"),
        put(data, ("also", 0, "experiment", "sensor"), [2, 0]),
        put(data, ("also", 0, "places"), [[3, 1]]),
        put(data, ("also", 0, "experiment"), "sensor 3"),
        put(data, ("also",), 51 * data["also"]),
        put(data, ("verdicts", 1, "models"), 3),
        put(data, ("verdicts", 1, "places", "3"), 1),
        put(data, ("verdicts", 2, "safety"), 101),
        put(data, ("verdicts", 0, "models", 0, "damped"), False),
        put(data, ("verdicts", 0, "settings", "seed"), "mine"),
    ]
    assert all(map(found_out, lies))
    assert not any(lie == data for lie in lies)


def test_what_takes_too_long_to_see_again_is_open_and_all_else_is_checked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def tired(*_: object) -> bool:
        raise NotSeenError("the contradiction was not found again (too large)")

    data = told("general: refuted")
    monkeypatch.setattr(model_evidence, "confirms_models", tired)
    found = verify(data)
    assert found.status is Status.OPEN and "was not found again" in found.sentence
    assert verify(told_again(data, safety=data["safety"] + 1)).status is Status.FAILS


HOSTILE: dict[str, tuple[tuple[Any, ...], Any]] = {
    "points without end": (("settings", "points"), 10**9),
    "a seed that is none": (("settings", "seed"), ["x"]),
    "Markov parameters without end": (("query", "markov"), 10**9),
    "masses without end": (("models", 0, "n_masses"), 10**9),
    "a number of masses that is none": (("models", 0, "n_masses"), float("nan")),
    "an experiment that is none": (("experiments", 0, "left"), {"sensor": "x"}),
    "a size without end": (("experiments", 1, "right", "inertias"), [[3, "1e999999999"]]),
    "a size that is no text": (("experiments", 1, "right", "inertias"), [[3, 0.5]]),
    "experiments without end": (("experiments",), [{}] * 10**4),
    "evidence that is none": (("evidence",), {"kind": "solved", "labels": {}}),
    "a field of another type": (("evidence", "labels"), "abc"),
    "no evidence": (("evidence",), {}),
    "no settings": (("settings",), None),
    "no models": (("models",), []),
}


@pytest.mark.thin(8)
@pytest.mark.parametrize("name", HOSTILE)
def test_a_damaged_or_hostile_file_is_refused_in_a_sentence(name: str, tmp_path: Path) -> None:
    path = tmp_path / "v.json"
    path.write_text(json.dumps(put(told("measured: solved"), *HOSTILE[name])), encoding="utf-8")
    with pytest.raises(InputError) as error:
        verify(path)
    assert "damaged" in str(error.value) and len(str(error.value)) < 600


@pytest.mark.full
def test_a_missing_key_or_deep_nesting_is_refused(tmp_path: Path) -> None:
    path, data = tmp_path / "v.json", told("measured: solved")
    for key in [name for name in data if name != "format"]:
        cut = {name: value for name, value in data.items() if name != key}
        assert found_out(cut) or key in ("program", "experiments"), key
    for content in ("[" * 10**5, '{"format": ' * 10**5, "NaN", "1" * 5000):
        path.write_text(content, encoding="utf-8")
        with pytest.raises(InputError):
            verify(path)
    deep: Any = "x"
    for _ in range(5000):
        deep = [deep]
    with pytest.raises(InputError):
        verify(put(data, ("evidence", "labels"), deep))


@pytest.mark.full
def test_large_numbers_in_evidence_end_soon() -> None:
    refuted = told("general: refuted")
    assert verify(put(refuted, ("evidence", "degree"), -1)).status is Status.FAILS
    ranks = deepcopy(told("measured: ranks"))
    for labels in (["G999999999"], ["b0[1]"] * 2, []):
        assert found_out(told_again(ranks, evidence=ranks["evidence"] | {"rows": labels}))


@pytest.mark.full
def test_the_command_checks_experiments_and_models_of_files(tmp_path: Path) -> None:
    models = tmp_path / "models.json"
    models.write_text(
        '{"models": [{"name": "a", "G": "a/(s + b)"}, {"name": "p", "G": "p*q/(s + q)"}]}'
    )
    names = [f"{models}:a", f"{models}:p"]
    path = tmp_path / "v.json"
    for asked in (["3:1", "3:4", "--also", "sensor=3"], names):
        assert called("compare", *asked, "--json", path).returncode == 0
        done = called("verify", path)
        assert (done.returncode, done.stdout.splitlines()[0]) == (0, f"{path}: holds")
        done = called("verify", *asked)
        assert done.returncode == 0 and done.stdout.splitlines()[0].endswith(": holds")
    models.unlink()
    assert called("verify", path).stdout.startswith(f"{path}: holds\n")
    assert called("verify", path, "--also", "sensor=3").returncode == 2
