"""Calls of the page of two models: the same answers as the public API and the command line."""

import shlex

import pytest

from disting import compare, verify
from disting.app.interface import CALLS
from disting.app.pair import compare_two, find_formulas, find_values, show_motion, write_evidence
from disting.errors import InputError
from disting.verdict.verification import Status
from tests.app.typed import run_command

PAIRS = [
    ("3:1", "3:11"),
    ("1=2=3; F1; S1", "3:11"),
    ("1=2; F1; S1", "1=2; F1; S2"),
    ("p(R1,R2-C1)", "R1-p(R2,C1)"),
    ("1>2, 2>1, 2>0; in 1; out 1", "1>2, 2>1, 1>0; in 1; out 1"),
    ("2:1", "3:2"),
]


@pytest.mark.thin(1)
@pytest.mark.parametrize(("left", "right"), PAIRS)
def test_the_verdict_is_that_of_compare(left: str, right: str) -> None:
    answer, verdict = compare_two({"left": left, "right": right}), compare(left, right)
    assert answer["relation"] == verdict.relation.value
    assert (answer["sentence"], answer["certainty"]) == (verdict.sentence, verdict.sure)


@pytest.mark.thin(1)
@pytest.mark.parametrize(("left", "right"), PAIRS[:4])
def test_the_command_to_copy_says_the_same(
    left: str, right: str, capsys: pytest.CaptureFixture[str]
) -> None:
    answer = compare_two({"left": left, "right": right})
    _, *words = shlex.split(answer["command"])
    text = run_command(capsys, *words)
    assert answer["meaning"] in text
    assert answer["certainty"] in text


@pytest.mark.parametrize(("left", "right"), [PAIRS[0], PAIRS[3]])
def test_values_of_the_other_model_are_those_of_the_command(
    left: str, right: str, capsys: pytest.CaptureFixture[str]
) -> None:
    answer = find_values({"left": left, "right": right})
    _, *words = shlex.split(answer["command"])
    text = run_command(capsys, *words, "--json", "-")
    for value in answer["sets"][0].values():
        assert f'"{value}"' in text


def test_values_that_are_given_are_used_and_checked() -> None:
    request = {"left": "3:1", "right": "3:11"}
    given = {"m1": "1", "m2": "2", "m3": "3", "k12": "100", "k23": "50", "d12": "0.1", "d23": "0.3"}
    assert find_values(request | {"values": given})["sets"][0]["m1"] == "24/5"
    with pytest.raises(InputError, match="m1"):
        find_values(request | {"values": given | {"m1": "-1"}})
    with pytest.raises(InputError, match="q9"):
        find_values(request | {"values": given | {"q9": "1"}})


def test_formulas_are_told_where_they_are_known() -> None:
    (form,) = find_formulas({"left": "3:1", "right": "3:11"})["forms"]
    assert "m3'  = m1 + m2 + m3" in form["text"]
    assert find_formulas({"left": "3:1", "right": "3:2"})["forms"] == []


@pytest.mark.parametrize(("left", "right"), PAIRS[:4])
def test_evidence_is_verified(left: str, right: str) -> None:
    assert verify(write_evidence({"left": left, "right": right})["file"]).status is Status.HOLDS


def test_two_machines_move_with_values_that_give_the_same_response() -> None:
    answer = show_motion({"left": "3:1", "right": "3:11"})
    assert answer["same"]
    machine, values = answer["machines"][1], answer["values"][1]
    assert dict(zip(machine["names"], values, strict=True))["k01"] == pytest.approx(1350)
    assert not show_motion({"left": "1=2; F1; S1", "right": "1=2; F1; S2"})["same"]
    assert show_motion({"left": "R1", "right": "R1-C1"})["machines"] == []


@pytest.mark.parametrize("left", ["", "x" * 10_000, "nonsense", "1=2; F1; S1 S2", "ü"])
def test_bad_models_get_a_short_error(left: str) -> None:
    with pytest.raises(InputError) as trouble:
        compare_two({"left": left, "right": "2:1"})
    assert 0 < len(str(trouble.value)) < 400


@pytest.mark.parametrize("name", ["compare", "formulas", "values", "motion", "evidence"])
def test_answers_have_the_form_of_their_schema(name: str) -> None:
    validate = pytest.importorskip("jsonschema").validate
    request, call = {"left": "3:1", "right": "3:11"}, CALLS[name]
    validate(request, call.schema["properties"]["request"])
    validate(call.load()(request), call.schema["properties"]["answer"])
