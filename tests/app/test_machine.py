"""Calls of the Machine page: the same answers as the public API and the command line, and parts of
machines as text and back.
"""

import itertools
import shlex

import pytest
from hypothesis import given, settings, strategies as st

from disting import identifiability, network_of
from disting.app.interface import CALLS
from disting.app.machine import (
    add_sensor,
    determine,
    draw_machine,
    find_alike,
    model_of,
    separate,
)
from disting.app.parts import parts_of, text_of
from disting.catalogs import lookalikes
from disting.errors import InputError
from disting.network.families import FAMILIES
from tests.app.typed import run_command

MACHINES = [n.name for n in FAMILIES["machines-2-damped"].networks]
MACHINES += [n.name for n in FAMILIES["machines-2"].networks]
MACHINES += [n.name for n in FAMILIES["trees-3"].networks][::4] if "trees-3" in FAMILIES else []
MACHINES += [
    "1=2=3; F1; S1",
    "1~2~3; F1; S3",
    "1=2*i, 2-#; F1; S1",
    "1~2, 2~3, 2~4; F1; S4",
    "1=2; F1; S1 S2",
    "1~2; F1:2; S1; position",
    "1~#, 1-#; F1; S1",
    "F1; S1",
    "1~2*3/2; F2; S2:1; velocity",
    "1~2, 3-4, 2~3; F4; S#:1",
    "1-2-3, 1~#; F1; S2",
    "1=2=3=1; F1; S2",
    "1~12, 12~3; F1; S12",
    "2=3; F2; S3",
]
OTHERS = ["R0-p(R1,C1)", "R0-p(R1-W1,C1)", "1>2, 2>1, 2>0; in 1; out 1", "3:1", "2:2", "4:3+b2"]


def test_machines_are_at_least_forty() -> None:
    assert len({*MACHINES}) >= 40


@pytest.mark.thin(8)
@pytest.mark.parametrize("text", MACHINES)
def test_parts_of_a_machine_describe_it(text: str) -> None:
    network = network_of(text)
    parts = parts_of(network)
    assert parts is not None
    again = network_of(text_of(parts))
    same = [{(e.value, frozenset(e.nodes), e.ratio) for e in n.elements} for n in (again, network)]
    assert same[0] == same[1]
    assert (again.inputs, again.outputs, again.order) == (
        network.inputs,
        network.outputs,
        network.order,
    )


@pytest.mark.full
@pytest.mark.parametrize("text", MACHINES)
def test_what_can_be_determined_is_what_the_public_function_says(text: str) -> None:
    answer = determine({"text": text})
    found = identifiability(text)
    assert (answer["sentence"], answer["rank"]) == (found.sentence, found.rank)
    assert {x["name"]: x["level"] for x in answer["levels"]} == dict(found.levels)


@pytest.mark.thin(3)
@pytest.mark.parametrize("text", [*OTHERS[2:], *MACHINES[::3]])
def test_the_count_that_comes_first_is_that_of_the_whole_answer(text: str) -> None:
    found = determine({"text": text})
    size, how = found["sentence"].split(" parameter")[0], f"only {found['rank']}"
    count = draw_machine({"text": text})["count"]
    assert count.startswith(f"{size} parameter")
    assert (how if found["rank"] < int(size) else "all") + " determinable" in count
    if found["rank"] == int(size):
        assert not any(x["level"] == "not" for x in found["levels"])


@pytest.mark.parametrize("text", ["3:1+delay", "R0-p(R1,P1)", "=".join(map(str, range(1, 30)))])
def test_no_count_where_it_would_say_too_much_or_take_too_long(text: str) -> None:
    ends = "" if text.startswith(("3:", "R")) else "; F1; S1"
    assert draw_machine({"text": text + ends})["count"] == ""


@pytest.mark.parametrize("text", ["1=2*i, 2-#; F1; S1", "R0-p(R1,C1)", "1>2, 2>0; in 1; out 2"])
def test_the_command_to_copy_says_the_same(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    answer = determine({"text": text})
    program, *words = shlex.split(answer["command"])
    assert program == "disting"
    assert answer["sentence"] in run_command(capsys, *words)


@pytest.mark.thin(8)
@pytest.mark.parametrize("text", [*MACHINES[::5], *OTHERS])
def test_a_drawing_has_the_words_of_its_model(text: str) -> None:
    answer = draw_machine({"text": text})
    assert answer["drawing"].startswith("<svg")
    assert answer["words"]
    assert set(answer["values"]) == set(answer["parameters"])
    assert 'style="' not in answer["drawing"]  # the page refuses such


def _structures(draw: st.DrawFn) -> dict:
    masses = draw(st.lists(st.integers(1, 30), min_size=1, max_size=6, unique=True).map(sorted))
    pairs = [(a, b) for i, a in enumerate(masses) for b in [*masses[i + 1 :], 0]]
    more = draw(st.lists(st.sampled_from(pairs), max_size=6, unique=True))
    # a way from every force to every sensor
    chosen = {*itertools.pairwise(masses), *more, (masses[0], 0)}
    kinds = st.sampled_from(["spring", "damper", "both"])
    joints = [
        {
            "from": a,
            "to": b,
            "kind": draw(kinds),
            "ratio": draw(st.sampled_from(["", "i", "3/2", "g1"])) if b else "",
        }
        for a, b in sorted(chosen)
    ]
    joints.sort(key=lambda j: sorted(i or float("inf") for i in (j["from"], j["to"])))
    nodes = st.sampled_from([*masses, 0])
    port = st.tuples(nodes, nodes).filter(lambda p: p[0] != p[1]).map(list)
    forces, sensors = (draw(st.lists(port, min_size=1, max_size=2, unique_by=tuple)) for _ in "FS")
    quantity = draw(st.sampled_from(["position", "velocity", "acceleration"]))
    return {
        "masses": masses,
        "joints": joints,
        "forces": forces,
        "sensors": sensors,
        "quantity": quantity,
    }


@pytest.mark.full
@settings(deadline=None, max_examples=150)
@given(st.composite(_structures)())
def test_parts_are_the_same_after_text_and_back(parts: dict) -> None:
    assert parts_of(network_of(text_of(parts))) == parts


PLAIN = {"masses": [1], "joints": [], "forces": [[1, 0]], "sensors": [[1, 0]]}
BAD = [
    ({"masses": []}, "add one"),
    ({"masses": [1, 2]}, "mass 2 is joined with nothing"),
    ({"forces": []}, "there is no force"),
    ({"sensors": []}, "there is no sensor"),
    ({"forces": [[3, 0]]}, "there is no mass 3"),
]


@pytest.mark.parametrize(("change", "words"), BAD)
def test_parts_that_are_no_machine_say_what_to_do(change: dict, words: str) -> None:
    with pytest.raises(InputError, match=words):
        text_of(PLAIN | change)


TEXTS = [
    "",
    "   ",
    "x" * 10_000,
    "nonsense",
    "ü~ö; F1; S1",
    "1=2; F1",
    "\u202e\x00",
    "3:9999",
    "1=2; F1; S9; S",
]


@pytest.mark.parametrize("text", TEXTS)
def test_bad_texts_get_a_short_error(text: str) -> None:
    for call in (draw_machine, determine, find_alike):
        with pytest.raises(InputError) as trouble:
            call({"text": text})
        assert 0 < len(str(trouble.value)) < 400


@pytest.mark.full
def test_what_looks_the_same_is_what_the_catalogue_says() -> None:
    (chains, machines) = find_alike({"text": "3:1"})["rows"]
    assert [x["name"] for x in chains["others"]] == ["3:11"]
    assert machines["others"] == []
    (row,) = find_alike({"text": "p(R1,R2-C1)"})["rows"]
    same = [x["name"] for x in row["others"] if x["relation"] == "indistinguishable"]
    assert "R1-p(R2,C1)" in same
    assert find_alike({"text": "1=2*i, 2-#; F1; S1"})["rows"] == []


def test_a_machine_is_found_in_its_catalogue_under_any_numbers_and_from_either_port() -> None:
    one = lookalikes.of_network(network_of("1~2, 2~#; F1; S2"))
    other = lookalikes.of_network(network_of("7~4, 4~#; F4; S7; velocity"))
    assert one is not None
    assert one == other


@pytest.mark.full
@pytest.mark.parametrize("family", ["machines-2-damped", "compartments-2", "circuits-4"])
def test_the_look_up_agrees_with_the_command(
    family: str, capsys: pytest.CaptureFixture[str]
) -> None:
    for network in FAMILIES[family].networks[::9]:
        (row,) = find_alike({"text": network.name})["rows"][-1:]
        _, *words = shlex.split(row["command"])
        text = run_command(capsys, *words[: words.index("--set")])
        count = {
            r: sum(x["relation"] == r for x in row["others"])
            for r in ("indistinguishable", "sometimes")
        }
        assert f"{count['indistinguishable']} of " in text.splitlines()[0]
        assert f"{count['sometimes']} for some" in text.splitlines()[0]


def test_a_machine_with_friction_to_the_ground_is_looked_up_too(
    capsys: pytest.CaptureFixture[str],
) -> None:
    (row,) = find_alike({"text": "4:3+b2"})["rows"]
    assert [(x["name"], x["relation"]) for x in row["others"]] == [("4:7+b3", "indistinguishable")]
    assert row["sentence"].startswith("1 of 463 other models is not always")
    _, *words = shlex.split(row["command"])
    assert "4:7+b3" in run_command(capsys, *words)
    (row,) = find_alike({"text": "1=2=3, 3-#; F1; S1"})["rows"]
    assert row["sentence"] == "All other 87 models are distinguishable from it."
    assert find_alike({"text": "1=2, 1-#; F1; S1"})["rows"] == []


def test_what_separates_two_chains_is_what_the_catalogue_says() -> None:
    answer = separate({"text": "3:1", "others": ["3:11"]})
    assert answer["sentence"].startswith("Separates all of them: a sensor at any further mass")
    assert answer["command"] == "disting next 3:1 3:11"


def test_a_further_sensor_says_what_the_public_function_says() -> None:
    answer = add_sensor({"text": "1=2=3; F1; S3", "mass": 2})
    assert answer["sentence"].endswith("all globally identifiable.")
    assert answer["command"].endswith("--also sensor=2")


@pytest.mark.parametrize("name", ["machine", "determine", "alike", "sensor", "separate"])
def test_answers_have_the_form_of_their_schema(name: str) -> None:
    validate = pytest.importorskip("jsonschema").validate
    more = {"sensor": {"mass": 2}, "separate": {"others": ["3:11"]}}.get(name, {})
    request = {"text": "3:1"} | more
    call = CALLS[name]
    properties = call.schema["properties"]
    validate(request, properties["request"])
    validate(call.load()(request), properties["answer"])


def test_a_name_without_masses_says_how_a_model_is_written() -> None:
    with pytest.raises(InputError):
        model_of("A4")
