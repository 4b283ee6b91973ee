"""What the structures that a fit left would show under further experiments."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from disting.equivalence import equivalents
from disting.experiments.menu import Costs, Item
from disting.export import predict
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.kinds import BRAKE, FORCE, INERTIA, LOCK, SENSOR
from disting.planning.fit_file import named_by
from disting.planning.next_experiment import (
    MOVES,
    STILL,
    Bench,
    Reason,
    bench_of,
    predictions,
    response_under,
    step,
    stood,
)
from disting.planning.power import power
from disting.report.fit.selection_json import _chain_to_dict
from disting.verdict.engine import Engine
from tests.fit.drives import dense_response, truth

FAMILY = Family(3, damped=True)
FREE, WALL = FAMILY[1], FAMILY[11]  # one force and one sensor do not tell them apart
VALUES = {"m1": 1.0, "m2": 2.0, "m3": 3.0, "k12": 100.0, "k23": 50.0, "d12": 0.1, "d23": 0.3}
BENCH = Bench(2 * np.pi * np.geomspace(0.1, 10.0, 40), np.full(40, 0.02), 1.5)


def member(chain: Chain, values: dict[str, float], **twins: dict[str, float]) -> dict[str, object]:
    """A structure that the data do not exclude, as the file of a fit has it."""
    same = [{"name": n, "parameters": v, "free_choices": 0} for n, v in twins.items()]
    plain = _chain_to_dict(chain) | {"parameters": values}
    return plain | {"equivalents": same}


def fit_file(path: Path, *members: dict[str, object], **more: object) -> Path:
    """A file of a fit that left these."""
    plain = {
        "selected": members[0],
        "explained": True,
        "alternatives": [],
        "not_excluded": members,
        "scatter": 0.02,
        "frequencies": {"low": 0.1, "high": 10.0, "lines": 40},
    }
    path.write_text(json.dumps(plain | more), encoding="utf-8")
    return path


def twin_values() -> dict[str, float]:
    """Positive values of WALL with the response of FREE at VALUES."""
    exact = {name: str(value) for name, value in VALUES.items()}
    (listing,) = [x for x in equivalents(FREE, exact, WALL).listings if x.members]
    return {n: complex(v).real for n, v in listing.members[0].values.items()}


@pytest.fixture(scope="module")
def left(tmp_path_factory):
    path = tmp_path_factory.mktemp("left") / "fit.json"
    twin = member(FREE, VALUES, **{"3:11": twin_values()})
    return named_by(
        fit_file(path, twin, member(Chain(2, damped=True), truth(Chain(2, damped=True), 1)))
    ).left


def test_reader_names_what_is_left_the_selected_first(left):
    assert [(one.name, one.fitted) for one in left] == [
        ("3:1", True),
        ("2:1", True),
        ("3:11", False),
    ]
    assert left[2].like == (FREE,) and left[2].chain == WALL and left[0].like == ()


def test_values_of_a_twin_go_to_the_masses_of_a_chain_that_is_counted_from_the_other_end(tmp_path):
    turned = Chain(2, 0, 0, 2, 0, 2, damped=True, ground_dampers=(1,))  # listed as 2:1+b2
    own = {"m1": 1.0, "m2": 2.0, "k12": 3.0, "d12": 0.1, "b1": 0.2}
    listed = {"m1": 2.0, "m2": 1.0, "k12": 3.0, "d12": 0.1, "b2": 0.2}
    path = fit_file(tmp_path / "fit.json", member(turned, own, **{"2:1+b2": listed}))
    (one,) = named_by(path).left
    assert one.values == (own, own) and one.name == "2:1+b2"


@pytest.mark.parametrize(
    ("item", "twin"),
    [
        (Item(SENSOR, 3), Chain(3, meas_plus=3, damped=True)),
        (Item(FORCE, 2), Chain(3, act_plus=2, damped=True)),
    ],
)
def test_what_is_moved_shows_what_the_moved_chain_shows(item, twin):
    s = 1j * BENCH.omega
    slow = [dense_response(twin, VALUES, at) for at in s]
    assert response_under(FREE, VALUES, item, BENCH) == pytest.approx(np.array(slow), rel=1e-9)


def test_a_locked_mass_and_an_added_inertia_are_limits_and_sums_of_masses():
    heavier = VALUES | {"m2": VALUES["m2"] + BENCH.inertia}
    slow = [dense_response(FREE, heavier, 1j * w) for w in BENCH.omega]
    assert response_under(FREE, VALUES, Item(INERTIA, 2), BENCH) == pytest.approx(
        np.array(slow), rel=1e-9
    )
    still = [dense_response(FREE, VALUES | {"m2": 1e14}, 1j * w) for w in BENCH.omega]
    assert response_under(FREE, VALUES, Item(LOCK, 2), BENCH) == pytest.approx(
        np.array(still), rel=1e-6
    )
    assert response_under(FREE, VALUES, Item(LOCK, 1), BENCH) is None


def test_a_known_brake_is_a_damper_to_the_ground():
    """As large as the inertia in the middle of the lines: J w, w = sqrt(w_1 w_n)."""
    braked = replace(FREE, ground_dampers=(2,))
    values = VALUES | {"b2": BENCH.inertia * 2 * np.pi}  # 0.1 to 10 Hz
    slow = [dense_response(braked, values, 1j * w) for w in BENCH.omega]
    assert response_under(FREE, VALUES, Item(BRAKE, 2), BENCH) == pytest.approx(
        np.array(slow), rel=1e-9
    )


def test_a_brake_is_on_the_menu_where_its_cost_is_named(left):
    kinds = {item.kind for item in predictions(left, BENCH).items(0)}
    seen = predictions(left, BENCH, costs=Costs.read("brake=2"))
    assert {item.kind for item in seen.items(0)} - kinds == {BRAKE}
    assert seen.sizes == {"inertia": BENCH.inertia, "brake": BENCH.size(1)}


def test_a_step_is_measured_in_units_of_the_scatter():
    one = np.full(40, 2.0 + 1j)
    found = step(one, one * (1 + 0.04j), BENCH)
    assert found.largest == pytest.approx(2.0) and found.noncentrality == pytest.approx(160.0)
    assert step(None, None, BENCH) == STILL and step(one, None, BENCH) == MOVES
    assert MOVES.is_motion and STILL < found < MOVES


def test_twins_show_the_same_now_and_differ_under_what_surely_tells_them_apart(left):
    seen = predictions(left, BENCH)
    now = [predict(one.chain, one.values[0], BENCH.omega) for one in (left[0], left[2])]
    assert step(*now, BENCH).largest < 1e-6
    assert Item(SENSOR, 1) not in seen.items(0) and Item(LOCK, 1) not in seen.items(0)
    for item in seen.items(0):
        found, place = seen.least(0, item, 2)
        every = [seen.at(item.kind, (0, item.at), (2, j)) for j in (1, 2, 3)]
        assert found == min(every) == every[place - 1] and found.noncentrality > 1
        assert seen.power(0, 2, found) == (1.0 if found.is_motion else power(found.noncentrality))


def test_other_values_of_a_structure_bring_it_nearer(left):
    first, *_ = left
    values = dict.fromkeys(VALUES, 1.0)
    more = type(first)(first.chain, True, (VALUES, values))
    other = type(first)(first.chain, True, (values,))
    assert predictions([first, other], BENCH).at(SENSOR, (0, 2), (1, 2)).largest > 1
    assert predictions([more, other], BENCH).at(SENSOR, (0, 2), (1, 2)).largest < 1e-9


def test_what_noise_leaves_is_no_twin(left):
    found = stood(left, Engine())
    assert found.classes == ((0, 2), (1,)) and found.groups == ((0, 2),)
    assert found.reason(0, 2) is Reason.EQUAL and found.reason(0, 1) is Reason.NOISE
    assert found.rule(1, 2) == found.rule(2, 1) == found.rule(0, 1) != ""
    across = replace(found, across=frozenset({(0, 1)}))
    assert across.reason(2, 1) is Reason.EQUAL and across.groups == found.groups


def test_what_behaves_the_same_for_its_values_alone_is_a_twin(left):
    other = type(left[0])(left[1].chain, False, (), (FREE,))
    assert stood([left[0], other], Engine()).reason(0, 1) is Reason.TWIN


def test_a_file_that_does_not_tell_its_lines_has_no_bench(tmp_path):
    named = named_by(fit_file(tmp_path / "fit.json", member(FREE, VALUES)))
    assert bench_of(named).inertia == 2.0 and len(bench_of(named).omega) == 40
    old = json.loads((tmp_path / "fit.json").read_text())
    del old["frequencies"]
    (tmp_path / "old.json").write_text(json.dumps(old))
    assert bench_of(named_by(tmp_path / "old.json")) is None
