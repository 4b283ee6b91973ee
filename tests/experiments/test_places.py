import json

import pytest

from disting import Chain, Engine, Experiment, Family, InputError, Query, View, compare_everywhere
from disting.cli import main
from disting.experiments.places import move, parse_experiment, ways
from disting.verdict.sides import sides_of
from disting.verdict.verdict_file import verdict_file
from disting.verdict.verification import Status, verify

A = Family(3, damped=True)
COMPLEX = Query(View.EXACT)


@pytest.mark.parametrize(
    ("text", "experiment", "places"),
    [
        ("sensor=3", Experiment(sensor=3), ()),
        ("sensor=3/2", Experiment(sensor=3), ((3, 2),)),
        ("sensor=3/2-1", Experiment(sensor=(3, 1)), ((3, 2),)),
        ("sensor=3-0", Experiment(sensor=3), ()),
        ("force=2,sensor=3,quantity=position", Experiment(2, 3, "position"), ()),
        ("lock=1/3+2", Experiment(locked=(1, 2)), ((1, 3),)),
        ("inertia=1:0.5,inertia=2:1/3", Experiment(inertias={1: "1/2", 2: "1/3"}), ()),
        ("spring=2/1:100", Experiment(springs={2: 100}), ((2, 1),)),
        ("brake=2/1:1e-3,brake=1:2", Experiment(brakes={1: 2, 2: "1/1000"}), ((2, 1),)),
        ("inertia=1:generic", Experiment(inertias={1: "generic"}), ()),
    ],
)
def test_what_is_written(text, experiment, places):
    found = parse_experiment(text)
    assert (found.experiment, found.places) == (experiment, places)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "an experiment is written"),
        ("sensor", "an experiment is written"),
        ("look=3", "an experiment is written"),
        ("sensor=three", "a place is a mass such as 3"),
        ("sensor=1,sensor=2", "one sensor"),
        ("sensor=1-2-3", "at a mass or between two"),
        ("inertia=1", "inertia=1:1"),
        ("sensor=0/1", "0 is the ground"),
        ("lock=1/2,sensor=1/3", "both 2 and 3 of the right"),
        ("lock=1/2,sensor=3/2", "both 1 and 3 of the left"),
    ],
)
def test_what_cannot_be_read_is_refused(text, said):
    with pytest.raises(InputError, match=said):
        parse_experiment(text)


def test_places_that_are_not_known_are_all_that_are_left_over():
    asked = [parse_experiment("sensor=3"), parse_experiment("lock=1/2")]
    assert ways(A[1], A[11], asked) == [((1, 2), (3, 1)), ((1, 2), (3, 3))]
    assert ways(A[1], A[11], asked, ((3, 3),)) == [((1, 2), (3, 3))]
    assert ways(A[1], A[11], [parse_experiment("quantity=position")]) == [()]


def test_experiments_move_with_their_places():
    one = parse_experiment("force=1,sensor=3-2,lock=4,inertia=3:1,spring=2:1").experiment
    there = move(one, ((1, 4), (2, 3), (3, 2), (4, 1)))
    assert there == parse_experiment("force=4,sensor=2-3,lock=1,inertia=2:1,spring=3:1").experiment


@pytest.mark.parametrize(
    ("texts", "said"),
    [
        (["sensor=4"], "no mass 4 in a chain with masses 1 to 3"),
        (["sensor=3/4"], "no mass 4 in the right model"),
        (["lock=1+2+3"], "leave one that moves"),
    ],
)
def test_places_that_do_not_exist(texts, said):
    with pytest.raises(InputError, match=said):
        compare_everywhere(A[1], A[11], texts)


def test_more_things_than_the_right_model_has():
    with pytest.raises(InputError, match="cannot all be different ones"):
        compare_everywhere(A[1], Chain(1, damped=True), ["sensor=1", "lock=2"])
    with pytest.raises(InputError, match="at most 200"):
        compare_everywhere(
            Chain(6, damped=False), Chain(6, damped=False), [f"sensor={i}" for i in range(1, 7)]
        )


@pytest.mark.full
def test_one_second_sensor_anywhere_settles_the_first_pair():
    for i in (1, 2, 3):
        found = compare_everywhere(A[1], A[11], [f"sensor={i}"], query=COMPLEX)
        assert found.answer.value == "surely" and len(found.verdicts) == 3


@pytest.mark.full
def test_of_the_reciprocal_twins_it_depends_on_the_place():
    found = compare_everywhere(A[2], A[5], ["sensor=2"], query=COMPLEX)
    told = {places[0][1]: verdict.relation.value for places, verdict in found.verdicts}
    assert told == {1: "distinguishable", 2: "distinguishable", 3: "indistinguishable"}
    assert found.answer.value == "depends on the places"
    known = compare_everywhere(A[2], A[5], ["sensor=2/3"], query=COMPLEX)
    assert known.answer.value == "never"


def told(capsys, *arguments):
    code = main(["compare", *arguments, "--damped", "--no-cache"])
    return code, capsys.readouterr()


@pytest.mark.full
def test_command_line(capsys):
    code, out = told(capsys, "3:1", "3:11", "--also", "sensor=3/2", "--also", "lock=2/1")
    assert code == 0 and out.out.startswith("DISTINGUISHABLE")
    assert "experiment 3  mass 2 locked" in out.out and "masses 2/1, 3/2 of 3:1/3:11" in out.out
    code, out = told(capsys, "3:2", "3:5", "--also", "sensor=2", "--domain", "complex")
    assert code == 0 and out.out.startswith("DEPENDS ON THE PLACES: 3:2 and 3:5")
    code, out = told(capsys, "3:2", "3:5", "--also", "lock=2/2", "--domain", "complex")
    assert code == 0 and "nothing is learned from experiment 2" in out.out


@pytest.mark.full
def test_one_chain_is_told_apart_by_its_experiments(capsys):
    code, out = told(capsys, "3:1", "3:1", "--also", "sensor=2/3")
    first, second = "3:1 with sensor 2", "3:1 with sensor 3"
    assert code == 0 and out.out.startswith("DISTINGUISHABLE")
    assert f"{first} (damped, acceleration, measured as it is and with sensor 2) and" in out.out
    assert f"  {first}  [1FS]=[2]=[3] | [1F]=[2S]=[3]\n" in out.out
    assert f"  {second}  [1FS]=[2]=[3] | [1F]=[2]=[3S]\n" in out.out
    assert "places     masses 2/3 of 3:1/3:1" in out.out
    code, out = told(capsys, "3:1", "3:1", "--also", "brake=2:1")
    assert out.out.startswith(
        "DEPENDS ON THE PLACES: 3:1 and the other 3:1 are distinguishable or not"
    )
    assert (
        "masses 2/1 of 3:1/the other 3:1: 3:1 with brake 1 at mass 2 (damped, acceleration, "
        in out.out
    )


@pytest.mark.full
@pytest.mark.parametrize(
    ("experiments", "names"),
    [
        ([], ("3:1", "3:1")),
        ([(Experiment(sensor=2), Experiment(sensor=2))], ("3:1", "3:1")),
        (
            [(Experiment(), Experiment(locked=2))],
            ("3:1 with nothing done", "3:1 with mass 2 locked"),
        ),
        (
            [
                (Experiment(sensor=2), Experiment(sensor=2)),
                (Experiment(brakes={1: 2}), Experiment(brakes={3: 2})),
                (Experiment(force=2), Experiment(force=3)),
            ],
            (
                "3:1 with brake 2 at mass 1 and with force 2",
                "3:1 with brake 2 at mass 3 and with force 3",
            ),
        ),
    ],
)
def test_names_under_experiments(experiments, names):
    asked = [(Experiment(), Experiment()), *experiments]
    sides = sides_of(A[1], A[1], asked, Engine())
    assert (sides.left.name, sides.right.name) == names
    stored = json.loads(json.dumps(verdict_file(A[1], A[1], experiments=asked)))
    assert (stored["left"], stored["right"]) == names
    assert verify(stored).status is Status.HOLDS
    assert verify(stored | {"left": "3:4"}).status is Status.FAILS


def test_two_chains_have_names_of_their_own():
    pair = [(Experiment(sensor=2), Experiment(sensor=3))]
    sides = sides_of(A[1], A[4], [(Experiment(), Experiment()), *pair], Engine())
    assert (sides.left.name, sides.right.name) == ("3:1", "3:4")


@pytest.mark.full
def test_command_line_as_json(capsys):
    code, out = told(capsys, "3:1", "3:11", "--also", "sensor=3", "--json")
    data = json.loads(out.out)
    assert code == 0 and data["answer"] == "surely"
    assert [v["places"] for v in data["verdicts"]] == [{"3": 1}, {"3": 2}, {"3": 3}]
    assert data["experiments"] == ["as it is", "sensor 3"]


@pytest.mark.parametrize(
    ("also", "said"),
    [
        (("--also", "sensor=7"), "there is no mass 7 in a chain with masses 1 to 3"),
        (("--also", "lock=1+2+3"), "leave one that moves"),
        (("--also", "inertia=1:-2"), "a known inertia is positive"),
        (("--also", "sensor=1", "--prove"), "--prove and --bound are not supported"),
    ],
)
def test_command_line_errors_are_one_sentence(capsys, also, said):
    code, out = told(capsys, "3:1", "3:11", *also)
    assert code == 2 and said in out.err and "Traceback" not in out.err
