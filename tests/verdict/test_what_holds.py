"""What `verify` says of a file that holds, and that the file says nothing which is not compared."""

import json

import pytest

from disting import Chain, InputError, Model, Query, View, verify
from disting.model.names import name_of
from disting.network.denotation import FREE_NAMES
from disting.verdict.result import Verdict
from disting.verdict.verification import Status
from tests.cli.process import called
from tests.verdict.lies import found_out, plain, put, told_again


@pytest.mark.full
def test_it_says_which_verdict_holds_and_what_was_looked_at():
    data = plain("3:6", "3:7")
    found = verify(data)
    assert found.verdicts == (data["sentence"],)
    assert found.models == "3:6 and 3:7: numbered chains, the catalogue's numbers"
    assert found.found_again[-2:] == ("which is a limit of the other", "positive equivalents")
    assert "seed 'disting'" in found.as_written[0] and "0." in found.as_written[1]
    for part in (found.sentence, *found.verdicts, found.models, *found.found_again):
        assert part in found.text


def test_what_does_not_hold_is_not_said_again():
    found = verify(plain("3:1", "3:4") | {"relation": "indistinguishable"})
    assert found.status is Status.FAILS and found.text == found.sentence
    assert found.verdicts == () == found.found_again


@pytest.mark.full
def test_free_names_are_said_to_be_free():
    models = (
        Model.from_transfer_function("a", "s + b", name="pump"),
        Model.from_transfer_function("c", "s**2 + d", name="tank"),
    )
    found = verify(plain(*models))
    assert found.status is Status.HOLDS
    assert found.models == f"pump and tank: {FREE_NAMES}"
    beside = verify(plain("2:1", models[0]))
    assert beside.models == f"2:1: a numbered chain; pump: {FREE_NAMES}"
    assert (
        verify(plain("R1-C1", "p(R1,C1)")).models
        == "R1-C1 and p(R1,C1): as denoted by the notation"
    )


def test_a_chain_without_a_number_is_not_said_to_have_one():
    far = Chain(3, act_plus=3, meas_plus=3)
    found = verify(plain(far, Chain(3)))
    name = name_of(far)
    assert name.startswith("(") and found.status is Status.HOLDS
    assert found.models == f"{name}: a chain without a number; 3:1: a numbered chain"


def test_the_command_says_it(tmp_path):
    path = tmp_path / "v.json"
    assert called("compare", "3:1", "3:11", "--json", path).returncode == 0
    first, sentence, models, *_ = called("verify", path).stdout.splitlines()
    assert first == f"{path}: holds" and models.endswith("the catalogue's numbers")
    assert sentence == json.loads(path.read_text(encoding="utf-8"))["sentence"]


@pytest.mark.parametrize("name", ["relation", "models", "format"])
def test_a_key_that_is_there_twice_is_refused(name, tmp_path):
    """Of two values a reader sees the first, and the check the second."""
    data = plain("3:1", "3:4")
    lie = json.dumps({name: "indistinguishable"})[:-1]
    path = tmp_path / "doubled.json"
    path.write_text(f"{lie},{json.dumps(data)[1:]}", encoding="utf-8")
    with pytest.raises(InputError, match=f"'{name}' is given twice"):
        verify(path)


@pytest.mark.parametrize(
    "place",
    [("comment",), ("models", 0, "comment"), ("query", "comment"), ("evidence", "comment")],
    ids=str,
)
def test_what_nothing_compares_is_refused(place):
    data = put(plain("3:1", "3:4"), place, "proven by the authors of the paper")
    assert found_out(data)


@pytest.mark.full
def test_words_that_nothing_compares_are_not_in_a_file():
    """Reasons of what is not known, and what was given up; whoever adds some is found out."""
    limit = plain("3:6", "3:7")
    assert limit["inclusions"]["image"]["reason"] == ""
    assert found_out(put(limit, ("inclusions", "image", "reason"), "it was proven elsewhere"))
    query = Query(View.COMBINED, conditions=("1", "2"))
    undecided = plain("3:1", "3:11", query=query)
    assert undecided["relation"] == "undecided" and undecided["notes"] == []
    assert found_out(undecided | {"notes": ["which shows that both are the same"]})
    assert found_out(limit | {"program": "0.2.0, read by three referees"})


@pytest.mark.parametrize(
    ("name", "lie"),
    [("damped", False), ("quantity", "position"), ("experiments", ["sensor 3"])],
)
def test_damping_quantity_and_experiments_are_compared(name, lie):
    assert found_out(put(plain("3:1", "3:4"), ("left_premise", name), lie))


@pytest.mark.full
def test_every_way_to_place_experiments_is_said(tmp_path):
    path = tmp_path / "ways.json"
    assert called("compare", "2:1", "2:2", "--also", "sensor=2", "--json", path).returncode == 0
    found = verify(path)
    assert found.status is Status.HOLDS and len(found.verdicts) == 2
    data = json.loads(path.read_text(encoding="utf-8"))
    assert verify(data | {"comment": "x"}).status is Status.FAILS
    assert verify(data | {"program": "three referees"}).status is Status.FAILS


def test_models_that_differ_are_not_equal_over_complex_parameters_by_an_undecided_verdict():
    equal = {"image": "equal", "closure": "equal"}
    nothing = {"decided_by": "", "representation": "", "certainty": "", "evidence": {}, "safety": 0}
    undecided = told_again(
        plain("3:1", "3:4", View.EXACT), relation="undecided", **nothing, **equal
    )
    lie = plain("3:1", "3:4", View.REAL) | equal
    lie["over_complex"] = json.loads(json.dumps(Verdict.from_dict(undecided).to_dict()))
    found = verify(lie)
    assert found.status is Status.FAILS
    assert "equality over complex parameters is stated without evidence" in found.reason


@pytest.mark.parametrize(
    "name", ["lag\nmodels      3:1 and 3:9: numbered chains", "a\x1b[2J", "\u202e"]
)
def test_a_name_says_no_more_than_a_name(name):
    """What is printed of a verdict that holds is a thing a line."""
    models = [
        Model.from_transfer_function("a", "s + b"),
        Model.from_transfer_function("c", "s + d"),
    ]
    data = plain(*models)
    data["models"][1]["name"] = name
    with pytest.raises(InputError, match="printable characters"):
        verify(data)
    with pytest.raises(InputError, match="printable characters"):
        Model.from_transfer_function("a", "s + b", name=name)
