import pytest
from sympy import Poly, Rational, sympify

from disting import (
    Chain,
    Engine,
    Experiment,
    Family,
    InputError,
    Model,
    Query,
    View,
    compare,
    compare_everywhere,
)
from disting.experiments.changes import Change
from disting.experiments.experiment import MeasuredChain
from disting.experiments.machine_model import MachineModel, expand, shape
from disting.model.kinds import BRAKE, LOCK, SENSOR
from tests.experiments.plain_stack import S, coefficients, transfer

A = Family(3, damped=True)
COMPLEX = Query(View.EXACT)


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"force": (2, 2)}, "two different ends"),
        ({"sensor": "3"}, "at a mass or between two"),
        ({"sensor": -1}, "at a mass or between two"),
        ({"sensor": True}, "at a mass or between two"),
        ({"locked": 0}, "mass 1, 2"),
        ({"inertias": {1: 0}}, "is positive"),
        ({"inertias": {1: -0.5}}, "is positive"),
        ({"inertias": {1: "heavy"}}, "a positive number or generic"),
        ({"inertias": {1: "1e999999999"}}, "a positive number or generic"),
        ({"inertias": [(1, 2), (1, 3)]}, "give their sum"),
        ({"inertias": "1:2"}, "are written"),
        ({"inertias": 5}, "are written"),
        ({"springs": [1]}, "are written"),
        ({"brakes": {1: 0}}, "a known brake is positive"),
        ({"brakes": {0: 1}}, "the place of a brake is mass 1, 2"),
        ({"brakes": [(1, 2), (1, 2)]}, "two known brakes at one mass"),
        ({"brakes": {1: None}}, "a positive number or generic, not None"),
        ({"locked": [[1]]}, "the place of a lock is mass 1, 2"),
        ({"locked": "2"}, "the place of a lock is mass 1, 2"),
        ({"inertias": [([1], 2)]}, "mass 1, 2"),
        ({"changes": [Change(LOCK, "last")]}, "mass 1, 2"),
        ({"inertias": {1: float("nan")}}, "a positive number or generic"),
        ({"inertias": {1: float("inf")}}, "a positive number or generic"),
        ({"quantity": "jerk"}, "position, velocity or acceleration"),
    ],
)
def test_what_is_no_experiment_is_refused(given, said):
    with pytest.raises(InputError, match=said):
        Experiment(**given)


@pytest.mark.parametrize(
    ("kind", "size", "said"),
    [
        (LOCK, 2, "has no size"),
        (SENSOR, None, "not a change of the machine"),
        (BRAKE, None, "None"),
    ],
)
def test_what_is_no_change_is_refused(kind, size, said):
    with pytest.raises(InputError, match=said):
        Change(kind, 1, size)


def test_an_argument_of_no_kind_is_none_of_an_experiment():
    with pytest.raises(TypeError, match="no 'magnets'; what it changes: locked, inertias"):
        Experiment(magnets={1: 2})


@pytest.mark.parametrize(
    ("experiment", "said"),
    [
        (Experiment(sensor=4), "no mass 4 in a chain with masses 1 to 3"),
        (Experiment(locked=4), "no mass 4"),
        (Experiment(inertias={5: 1}), "no mass 5"),
        (Experiment(locked=(1, 2, 3)), "leave one that moves"),
    ],
)
def test_what_the_chain_does_not_have_is_refused(experiment, said):
    with pytest.raises(InputError, match=said):
        compare(A[1], A[11], experiments=[Experiment(), experiment])


def test_models_given_by_formulas_have_no_places():
    formula = Model.from_transfer_function("b/(s + a)")
    with pytest.raises(InputError, match="no masses to measure at"):
        compare_everywhere(formula, A[2], ["sensor=1"])
    with pytest.raises(InputError, match="no masses to measure at"):
        compare(formula, A[2], experiments=[Experiment(sensor=1)])


def test_a_chain_that_is_given_as_a_model_is_measured_as_the_chain():
    given = compare_everywhere(Model.from_chain(A[1]), A[11], ["sensor=2/3"])
    plain = compare_everywhere(A[1], A[11], ["sensor=2/3"])
    assert [v.relation for _, v in given.verdicts] == [v.relation for _, v in plain.verdicts]


def test_a_number_is_exact_and_a_generic_one_the_same_for_all():
    assert Experiment(inertias={1: 0.1}) == Experiment(inertias={1: "1/10"})
    assert Experiment(inertias={1: "generic"}) == Experiment(inertias=((1, "generic"),))


def test_a_locked_mass_that_carries_the_force_teaches_nothing_and_that_is_said():
    assert (A[1].act_plus, A[11].act_plus, A[11].act_minus) == (1, 3, 2)
    pair = (Experiment(locked=1), Experiment(locked=(2, 3)))
    found = compare(A[1], A[11], experiments=[Experiment(), pair], query=COMPLEX)
    assert found.relation.value == "indistinguishable"
    assert found.notes == ("nothing is learned from experiment 2: its sensor never moves",)


def test_one_that_sees_nothing_differs_from_one_that_sees_something():
    one = Chain(2, 1, 1, 2, 1, 2, damped=True)
    pair = (Experiment(sensor=1, locked=1), Experiment(sensor=1))
    found = compare(one, one, experiments=[Experiment(), pair], query=COMPLEX)
    assert found.decided_by == "1" and found.relation.value == "distinguishable"
    assert "In experiment 2" in found.sentence and "a sensor that does not move" in found.sentence


@pytest.mark.full
@pytest.mark.parametrize(
    ("chain", "experiments"),
    [
        # one mass that varies, with and without what is known
        (Chain(1, damped=True), [(Experiment(), Experiment(inertias={1: 1}))]),
        (Chain(2, damped=True), [(Experiment(), Experiment(inertias={2: "1/3"}))]),
        # nobody sees mass 1: whatever is added to it
        (
            Chain(3, 1, 1, 2, 1, 2, damped=True),
            [
                (Experiment(2, 2), Experiment(2, 2)),
                (Experiment(2, 3), Experiment(2, 3, inertias={1: 1})),
            ],
        ),
    ],
)
def test_what_is_done_to_one_side_alone_is_compared_all_the_same(chain, experiments):
    found = compare(chain, chain, experiments=experiments, query=COMPLEX, audit=True)
    assert found.relation.value == "indistinguishable"


def test_nothing_moves_in_any_experiment():
    found = compare(A[1], A[1], experiments=[Experiment(locked=1)], query=COMPLEX)
    assert found.relation.value == "indistinguishable"


CASES = [
    (A[1], {}),
    (A[1], {"sensor": (3, 0)}),
    (A[1], {"locked": (2,)}),
    (A[1], {"sensor": (2, 3)}),  # two ends in one row: terms of both signs
    (A[1], {"force": (1, 3), "sensor": (1, 3)}),
    (A[11], {"inertias": {2: "1/2"}, "springs": {3: 2}}),
    (A[11], {"brakes": {2: "1/2"}}),
    (Chain(3, damped=False), {"brakes": {1: 2, 3: "2/7"}, "sensor": (3, 0)}),
    (A[9], {"brakes": {2: 3}, "inertias": {2: "1/5"}, "springs": {2: 7}, "locked": (1,)}),
    (A[1], {"force": (1, 3), "sensor": (2, 3), "brakes": {3: 1}}),  # terms of both signs
    (Chain(2, damped=True, quantity="position"), {"brakes": {1: 1}, "inertias": {1: 1}}),
    (A[11], {"sensor": (1, 0)}),  # only the grounded part is seen
    (A[9], {"locked": (2,), "sensor": (3, 0), "force": (3, 0)}),
    (Chain(3, 1, 1, 2, 1, 3, ground_dampers=(2,), lag=True, damped=False), {"sensor": (3, 1)}),
    (Chain(4, 0, 0, 2, 0, 3, damped=True, ground_dampers=(1,)), {"locked": (1, 4)}),
    (Chain(3, damped=True, quantity="velocity"), {"sensor": (2, 0)}),
]


@pytest.mark.full
@pytest.mark.parametrize(("chain", "changes"), CASES)
def test_transfer_functions_are_those_of_the_dynamic_stiffness_matrix(chain, changes):
    numbers = {name: Rational(7 * i + 3, i + 2) for i, name in enumerate(chain.parameters)}
    plain = coefficients(*transfer(chain, numbers, **changes))
    entry = MeasuredChain(chain, (Experiment(**changes),)).entries[0]
    sides = (Poly(sympify(str(p)).subs(numbers), S, domain="QQ") for p in expand(entry))
    num, den = sides
    ours = [[c / den.LC() for c in p.all_coeffs()[::-1]] for p in (num, den)]
    assert ours == plain
    found = shape(entry)
    assert found.degrees == (len(plain[0]) - 1, len(plain[1]) - 1)
    zero = {
        f"{letter}{i}"
        for letter, side in zip("ba", plain, strict=True)
        for i, c in enumerate(side)
        if c == 0
    }
    assert found.zeros == zero


def test_a_sensor_behind_a_locked_mass_sees_nothing():
    measured = MeasuredChain(A[1], (Experiment(), Experiment(locked=2, sensor=3)))
    numbers = dict.fromkeys(A[1].parameters, 2)
    assert transfer(A[1], numbers, locked=(2,), sensor=(3, 0))[0] == 0
    assert MachineModel(measured).degrees[1] == (-1, 0)


def test_a_verdict_is_kept(tmp_path):
    from disting import Store

    path = str(tmp_path / "kept.sqlite3")
    asked = [Experiment(), Experiment(locked=2)]
    first = compare(A[2], A[5], experiments=asked, engine=Engine(store=Store.open(path)))
    again = compare(A[2], A[5], experiments=asked, engine=Engine(store=Store.open(path)))
    assert first == again
