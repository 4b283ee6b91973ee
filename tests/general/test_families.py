"""Lists of general models through the one fold: classes, and a second run that computes nothing."""

from concurrent.futures import Executor
from itertools import combinations

import pytest

from disting import (
    Chain,
    ContradictionError,
    Engine,
    Family,
    Model,
    Query,
    Relation,
    Store,
    View,
    catalog,
    compare,
)
from disting.general.network_view import NetworkView
from tests.oracles.plain_chains import plain_state_space

ENTRIES = {
    "two leaks": ("k12", "(s + k12 + k01)*(s + k02)"),
    "exchange": ("k12", "s**2 + (k01 + k12 + k21)*s + k01*k21"),
    "swapped": ("b", "(s + b + c)*(s + a)"),
    "sum": ("b", "s**2 + (a + b)*s + c"),
}
MODELS = [Model.from_transfer_function(*pair, name=name) for name, pair in ENTRIES.items()]


class NoWorkers(Executor):
    """Refuses every task."""

    def submit(self, fn, /, *args, **kwargs):
        raise AssertionError(f"{args} was computed")


def decided(store, view, executor=None):
    engine = Engine(store=store)
    subjects = engine.general_subjects(MODELS)
    return engine.decisions(subjects, Query(view), executor=executor)


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize("view", [View.EXACT, View.REAL, View.POSITIVE])
def test_a_list_is_decided_as_its_pairs_are(view):
    with Store.open(":memory:") as store:
        found = decided(store, view)
    for i, left in enumerate(MODELS):
        for j, right in enumerate(MODELS[i + 1 :], i + 1):
            assert found.relation(i, j) is compare(left, right, query=Query(view)).relation


@pytest.mark.thin(1)
@pytest.mark.parametrize("view", [View.EXACT, View.POSITIVE])
def test_a_second_run_is_a_look_up(view):
    with Store.open(":memory:") as store:
        with pytest.raises(AssertionError, match="was computed"):
            decided(store, view, NoWorkers())
        first = decided(store, view)
        again = decided(store, view, NoWorkers())
    pairs = [(i, j) for i in range(len(MODELS)) for j in range(i + 1, len(MODELS))]
    assert [again.verdict(*p) for p in pairs] == [first.verdict(*p) for p in pairs]


@pytest.mark.full
def test_classes_are_those_that_no_parameters_tell_apart():
    with Store.open(":memory:") as store:
        assert decided(store, View.EXACT).classes() == ((0, 1, 2, 3),)
        over_positive = decided(store, View.POSITIVE)
    assert over_positive.classes() == ((0, 2),)
    assert over_positive.relation(0, 1) is Relation.SOMETIMES


def test_verdicts_that_contradict_a_class_are_refused():
    with Store.open(":memory:") as store:
        found = decided(store, View.EXACT)
    found.steps.pop((0, 3))  # without its finding a decided pair counts as distinguishable
    assert isinstance(found.subjects[0].view, NetworkView)
    with pytest.raises(ContradictionError, match="two leaks and sum are in one group"):
        found.classes()


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize(
    ("damped", "view"), [(False, View.EXACT), (True, View.EXACT), (True, View.POSITIVE)]
)
def test_chains_as_state_spaces_have_the_verdicts_of_the_catalogue(damped, view):
    family, known, engine = Family(3, damped), catalog(3, damped=damped), Engine()
    subjects = engine.general_subjects(
        [
            Model.from_state_space(*plain_state_space(chain), name=f"A{i}")
            for i, chain in enumerate(family, 1)
        ]
    )
    found = engine.decisions(subjects, Query(view))
    for low, high in combinations(range(1, len(family) + 1), 2):
        relation = found.relation(low - 1, high - 1)
        assert relation is known.relation(low, high, view) is not Relation.UNDECIDED


def test_a_plain_state_space_is_the_chain():
    for chain in (
        Chain(3, 1, 1, 3, 1, 2, damped=True, ground_dampers=(1, 3)),
        Chain(4, 2, 1, 3, 2, 4, damped=False),
        Chain(1, damped=False),
    ):
        assert Model.from_state_space(*plain_state_space(chain)) == Model.from_chain(chain)
