"""disting next with the file of a fit."""

import csv
import io
import json
from math import pi

import pytest

from disting.model.chain import Chain
from disting.model.kinds import SENSOR
from disting.planning.fit_file import named_by
from disting.planning.next_experiment import bench_of, predictions
from tests.cli.process import called
from tests.fit.drives import truth
from tests.fit.test_predictions import FREE, VALUES, fit_file, member, twin_values

PLAIN, FRICTION = (Chain(3, damped=True, ground_dampers=b) for b in ((), (2,)))


RIVAL = Chain(2, ground_dampers=(1,))


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    folder = tmp_path_factory.mktemp("next")
    larger = member(FRICTION, VALUES | {"b2": 0.2})
    rival = member(RIVAL, truth(RIVAL, 2))
    twin = member(FREE, VALUES, **{"3:11": twin_values()})
    return fit_file(folder / "fit.json", twin, larger, rival)


@pytest.fixture(scope="module")
def said(path):
    done = called("next", path)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.full
def test_each_pair_has_a_sentence(said, path):
    first, empty, head, selected, *_ = said.splitlines()
    assert first == (
        "measure next: a sensor at mass 2 (cost 1); if the machine is 3:1, it shows a difference"
        " from 2:1+b1, 3:11 (power 95 % or more for the values fitted now; a rival that is fitted again comes"
        " closer)"
    )
    assert (empty, head) == ("", "3 structures that the fit left:")
    assert selected.split() == ["3:1", "[1FS]=[2]=[3]", "fitted"]
    (noise,) = [line for line in said.splitlines() if line.startswith("2:1+b1: ")]
    assert "the data are too noisy to tell it from 3:1 (disting plan" in noise
    assert f"(disting plan {path})" in noise
    assert (
        "\nnot a rival: 3:1+b2 contains 3:1 or one of its rivals; no experiment excludes a structure"
        " that contains the true one\n"
    ) in said
    (twin,) = [line for line in said.splitlines() if line.startswith("3:11: ")]
    assert twin.startswith(
        "3:11: with this force and sensor no data can tell it from 3:1, whatever"
    )
    assert "a sensor at mass 2 (cost 1) shows up to" in twin and "power > 99.9 %" in twin
    assert "at the fitted values, before a rival is fitted again" in said


@pytest.mark.full
def test_the_group_is_told_what_next_tells_of_its_names(said):
    by_name = called("next", "3:1", "3:11", "--damped").stdout
    for line in by_name.splitlines()[2:]:
        assert line in said


WRONG = [1e308, 10**400, float("inf"), float("nan"), True, "1", None]
PLACES = [
    ("selected", "parameters", "m1"),
    ("not_excluded", 0, "parameters", "k12"),
    ("not_excluded", 0, "equivalents", 0, "parameters", "m1"),
    ("not_excluded", 0, "equivalents", 0, "free_choices"),
    ("scatter",),
    ("frequencies", "low"),
    ("frequencies", "high"),
    ("frequencies", "lines"),
]


@pytest.mark.full
@pytest.mark.parametrize("command", ["next", "plan"])
@pytest.mark.parametrize("way", PLACES, ids=str)
def test_numbers_that_no_fit_writes_are_refused(path, tmp_path, way, command):
    for value in WRONG:
        plain = json.loads(path.read_text(encoding="utf-8"))
        place = plain
        for key in way[:-1]:
            place = place[key]
        place[way[-1]] = value
        file = tmp_path / "wrong.json"
        file.write_text(json.dumps(plain), encoding="utf-8")
        done = called(command, file)
        assert done.returncode == 2 and done.stdout == ""
        assert "missing or wrong" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("command", ["next", "plan"])
def test_a_deep_file_is_no_file_of_a_fit(tmp_path, command):
    file = tmp_path / "deep.json"
    for content in ("[" * 10**5, '{"selected": ' * 10**5):
        file.write_text(content, encoding="utf-8")
        done = called(command, file)
        assert done.returncode == 2 and done.stderr.count("\n") == 1


@pytest.mark.full
def test_costs_change_what_is_cheapest(path):
    done = called("next", path, "--cost", "sensor=9,move=9,lock=0.5")
    (twin,) = [line for line in done.stdout.splitlines() if line.startswith("3:11: ")]
    assert "locked (cost 0.5)" in twin


@pytest.mark.full
def test_tables_hold_all_pairs_of_places(path):
    done = called("next", path, "--csv", "-")
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    assert len(rows) == 4 * 21
    pairs = {(r["left"], r["right"], r["relation"]) for r in rows}
    assert ("3:1", "2:1+b1", "distinguishable") in pairs
    (moved,) = [
        r for r in rows
        if (r["experiment"], r["left"], r["at_left"], r["right"], r["at_right"])
        == ("sensor", "3:1", "2", "3:11", "2")
    ]  # fmt: skip
    assert moved["relation"] == "distinguishable" and float(moved["largest"]) > 1
    found = predictions(named_by(path).left, bench_of(named_by(path)))
    step = found.at(SENSOR, (0, 2), (2, 2))
    assert float(moved["noncentrality"]) == pytest.approx(step.noncentrality)


@pytest.mark.full
def test_plain_data_says_what_the_numbers_are(path):
    plain = json.loads(called("next", path, "--json", "-").stdout)
    assert [one["name"] for one in plain["structures"]] == ["3:1", "2:1+b1", "3:11"]
    assert [group["structures"] for group in plain["groups"]] == [["3:1", "3:11"]]
    assert {(p["left"], p["right"]): p["standing"] for p in plain["pairs"]} == {
        ("3:1", "2:1+b1"): "noise", ("3:1", "3:11"): "equal", ("2:1+b1", "3:11"): "noise",
    }  # fmt: skip
    measured = plain["measured"]
    assert measured["what"] == "at the fitted values, before a rival is fitted again"
    assert (measured["lines"], measured["scatter"], measured["inertia"]) == (40, 0.02, 2.0)
    assert len(plain["sentences"]) == 2
    (lock,) = [
        one for one in measured["least"]
        if (one["structure"], one["experiment"], one["mass"], one["other"]) == ("3:1", "lock", 2, "3:11")
    ]  # fmt: skip
    assert 0 < lock["power"] <= 1


@pytest.mark.full
def test_a_brake_is_told_of_where_it_costs_something(path):
    said = called("next", path, "--cost", "brake=0.5").stdout
    assert "a known brake at mass 2" in said
    assert (
        "the added inertia is 2, the mean of the masses; a brake is 12.6, times 2 pi f in the"
        in said
    )
    rows = list(
        csv.DictReader(
            io.StringIO(called("next", path, "--cost", "brake=0.5", "--csv", "-").stdout)
        )
    )
    assert len(rows) == 5 * 21 and {"brake", "lock"} < {row["experiment"] for row in rows}
    plain = json.loads(called("next", path, "--cost", "brake=0.5", "--json", "-").stdout)
    assert plain["measured"]["brake"] == pytest.approx(4 * pi)


@pytest.mark.full
def test_a_set_of_one_has_nothing_to_tell_apart(tmp_path):
    """Said plainly, with the parameter of the largest error, which falls with the root."""
    errors = {name: 0.02 * value for name, value in VALUES.items()}
    for worst, said in (
        (0.3, "d12 has the largest error, ± 30 % (one standard error): 9 times as many periods, or"
         " lines in the same range, reduce it to ± 10 % as far as noise is the cause"),
        (0.05, "d12 has the largest error, ± 5 % (one standard error)\n"),
        (None, "the data do not determine d12: another sensor, another place of the force"),
    ):  # fmt: skip
        own = None if worst is None else worst * VALUES["d12"]
        selected = member(FREE, VALUES) | {"standard_errors": errors | {"d12": own}}
        path = fit_file(tmp_path / "one.json", selected)
        done = called("next", path)
        assert done.returncode == 0 and done.stdout.startswith(
            f"{path} leaves 3:1 alone: no further measurement is needed to distinguish"
            f" structures; {said}"
        )
        plain = json.loads(called("next", path, "--json", "-").stdout)
        assert plain["first"] + "\n" == done.stdout and plain["again"] == ""
        assert [one["name"] for one in plain["structures"]] == ["3:1"] and plain["pairs"] == []
    none = fit_file(tmp_path / "none.json", member(FREE, VALUES), explained=False, not_excluded=[])
    done = called("next", none)
    assert done.returncode == 2 and "explains its data, so the fit leaves no set" in done.stderr


@pytest.mark.full
def test_several_responses_and_a_fit_that_explains_nothing_are_warned_of(tmp_path):
    chains = [Chain(2, damped=True, ground_dampers=(i,)) for i in (1, 2)]
    members = [member(chain, truth(chain, 2)) for chain in chains]
    path = fit_file(tmp_path / "fit.json", *members, explained=False, responses=[{}, {}])
    done = called("next", path)
    assert done.returncode == 0 and "explains its data" in done.stderr
    assert "has 2 responses; the menu starts from the first one only" in done.stderr


@pytest.mark.full
def test_a_file_that_does_not_tell_its_lines_still_has_its_menu(tmp_path):
    twin = member(FREE, VALUES, **{"3:11": twin_values()})
    path = fit_file(tmp_path / "fit.json", twin, frequencies={"low": 0, "high": 0, "lines": 0})
    done = called("next", path)
    assert "does not name the lines of its data" in done.stdout and "sufficient: " in done.stdout
    assert json.loads(called("next", path, "--json", "-").stdout)["measured"] is None


@pytest.mark.parametrize(
    ("text", "more", "words"),
    [
        ("[]", (), "holds no selected model"),
        ("no json", (), "holds no JSON; name a file of 'disting fit --json'"),
        ('{"selected": null}', (), "holds no selected model"),
        ("{}", ("--damped",), "names its structures itself"),
        ("{}", ("3:1",), "names its structures itself"),
    ],
)
def test_what_is_no_fit_is_refused_in_one_sentence(tmp_path, text, more, words):
    path = tmp_path / "fit.json"
    path.write_text(text, encoding="utf-8")
    done = called("next", path, *more)
    assert done.returncode == 2 and words in done.stderr and len(done.stderr.splitlines()) == 1
