"""What all sides of a comparison keep, whatever they are sides of."""

import pytest

from disting import Engine, Experiment, Family, network_of
from disting.conditions.rule import Outcome
from disting.decide import asking
from disting.experiments.experiment import MeasuredChain

A = Family(3, damped=True)
TWICE = (Experiment(), Experiment(locked=2))


def chains(engine, numbers):
    return [engine.subject(str(m), A[m]) for m in numbers]


def machines(engine, numbers):
    return [engine.measured_subject(str(m), MeasuredChain(A[m], TWICE)) for m in numbers]


def models(engine, numbers):
    texts = {1: "R0-p(R1,C1)-p(R2,C2)", 11: "R0-p(C1,R1-p(R2,C2))", 3: "R0-p(R1,C1)"}
    return engine.general_subjects([network_of(texts[m]) for m in numbers])


@pytest.mark.parametrize("sides", [chains, machines, models])
def test_the_exact_decision_is_not_asked_of_unequal_ranks(sides):
    left, right = sides(Engine(), (1, 3))
    assert asking.same(left, right).outcome is Outcome.INAPPLICABLE
    evidence = asking.same(left, left).evidence
    assert evidence is not None and asking.same_again(left, right, evidence) is None


@pytest.mark.parametrize("sides", [chains, models])
def test_a_decision_is_found_again_from_both_sides(sides):
    left, right = sides(Engine(), (1, 11))
    for a, b in ((left, right), (right, left)):
        found = asking.same(a, b)
        assert found.outcome is Outcome.HOLDS
        again = asking.same_again(a, b, found.evidence)
        assert again is None or (again.outcome, again.evidence) == (found.outcome, found.evidence)


@pytest.mark.parametrize("sides", [chains, machines, models])
def test_what_is_prepared_is_what_is_asked(sides):
    group, asked = sides(Engine(), (1, 11, 3)), []
    pairs = [(a, b) for a in group for b in group if a is not b]
    asking.prepare_same(pairs, lambda question, models: asked.append((question, models)))
    wanted = [
        a.view.pair(b.view)
        for a, b in pairs
        if asking.same(a, b).outcome is not Outcome.INAPPLICABLE
    ]
    assert [pair for _, models in asked for pair in models] == wanted
    assert all(question.name.startswith("exact decisions") for question, _ in asked)
