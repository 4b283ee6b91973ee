"""Evidence checks again, and false evidence is refused."""

from dataclasses import replace

import pytest
from hypothesis import given

from disting import Chain, Family, Query, Relation, View
from disting.decide.same.evidence_check import Witness
from disting.evidence.conditions import (
    Counts,
    Embedding,
    Forms,
    FreeChoice,
    Ranks,
    Renaming,
    Supermodel,
)
from disting.verdict.cascade import steps
from tests.laws.pairs import (
    EXAMPLES,
    PAPER,
    WITNESS,
    any_pair,
    often,
    quick,
    similar_pairs,
    subject,
    verdict,
    with_examples,
)


@pytest.mark.full
@often
@with_examples
@given(pair=any_pair)
def test_evidence_checks_again(pair):
    found = verdict(*pair)
    if found.evidence:
        assert WITNESS.confirms(found.evidence, found.representation, *pair)
        assert WITNESS.confirms(found.evidence.turned, found.representation, *reversed(pair))


@pytest.mark.full
@often
@with_examples
@given(pair=any_pair)
def test_every_condition_that_decides_has_evidence_that_checks_again(pair):
    """Of the necessary ones the first in each representation, for the later ones presuppose it."""
    done = set()
    for step in steps(*(subject(chain) for chain in pair), PAPER):
        if step.relation is not Relation.UNDECIDED and step.representation not in done:
            assert WITNESS.confirms(step.finding.evidence, step.representation, *pair)
            if step.relation is Relation.DISTINGUISHABLE:
                done.add(step.representation)


def swapped(pairs):
    """Two images of a renaming exchanged."""
    (a, x), (b, y), *rest = pairs
    return ((a, y), (b, x), *rest)


def evidence_of(kind):
    pair = {
        Counts: (Family(3, damped=True)[1], Family(3, damped=True)[2]),
        Forms: (Chain(1, damped=False), Chain(1, dead_time=True, damped=False)),
        Ranks: (Family(3, damped=True)[1], Family(3, damped=True)[4]),
        Renaming: (Family(3, damped=False)[2], Family(3, damped=False)[5]),
        FreeChoice: (Family(4, damped=False)[11], Family(4, damped=False)[13]),
        Embedding: EXAMPLES[4],
        Supermodel: EXAMPLES[5],
    }[kind]
    found = verdict(*pair)
    assert isinstance(found.evidence, kind)
    return found, pair


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("kind", "tamper"),
    [
        (Counts, lambda e: replace(e, left=(e.left[0] + 1, e.left[1]))),
        (Counts, lambda e: replace(e, left=e.right)),
        (Counts, lambda e: replace(e, right=e.left)),
        (Counts, lambda e: replace(e, right=(e.right[0], e.right[1] - 1))),
        (Counts, lambda e: Counts(e.right, e.left)),
        (Forms, lambda e: Forms((), ())),
        (Forms, lambda e: Forms(e.only_right, ())),
        (Forms, lambda e: Forms((), ("b0",))),
        (Forms, lambda e: Forms((), ("Td", "b0"))),
        (Ranks, lambda e: replace(e, left=e.left + 1)),
        (Ranks, lambda e: replace(e, right=e.right - 1)),
        (Ranks, lambda e: replace(e, left=e.right, right=e.left)),
        (Ranks, lambda e: replace(e, right=e.left)),
        (Ranks, lambda e: replace(e, rows=e.rows[:6])),
        (Ranks, lambda e: replace(e, rows=("G0", *e.rows))),
        (Ranks, lambda e: replace(e, rows=())),
        (Ranks, lambda e: replace(e, rows=("Gx", *e.rows[1:]))),
        (Renaming, lambda e: replace(e, pairs=swapped(e.pairs))),
        (Renaming, lambda e: replace(e, pairs=e.pairs[1:])),
        (Renaming, lambda e: replace(e, pairs=((e.pairs[0][0], e.pairs[1][1]), *e.pairs[1:]))),
        (Renaming, lambda e: replace(e, pairs=((e.pairs[0][0], "b9"), *e.pairs[1:]))),
        (Renaming, lambda e: replace(e, pairs=tuple((a, a) for a, _ in e.pairs))),
        (FreeChoice, lambda e: replace(e, free=e.free[1:])),
        (FreeChoice, lambda e: replace(e, free=(*e.free, "a1"))),
        (Embedding, lambda e: replace(e, left_is_submodel=not e.left_is_submodel)),
        (Embedding, lambda e: replace(e, rank=e.rank + 1)),
        (Embedding, lambda e: replace(e, numbering=swapped(e.numbering))),
        (Supermodel, lambda e: replace(e, rank=e.rank - 1)),
        (Supermodel, lambda e: replace(e, parameters=e.parameters[:-1])),
    ],
)
def test_tampered_evidence_is_refused(kind, tamper):
    found, pair = evidence_of(kind)
    assert WITNESS.confirms(found.evidence, found.representation, *pair)
    assert tamper(found.evidence) != found.evidence
    assert not WITNESS.confirms(tamper(found.evidence), found.representation, *pair)


OTHER = (Family(3, damped=True)[3], Family(3, damped=True)[7])


@pytest.mark.parametrize(
    "kind", [Counts, Forms, Ranks, Renaming, FreeChoice, Embedding, Supermodel]
)
def test_evidence_of_another_pair_is_refused(kind):
    found, pair = evidence_of(kind)
    assert not WITNESS.confirms(found.evidence, found.representation, *OTHER)
    assert not WITNESS.confirms(found.evidence, found.representation, pair[0], OTHER[1])


def test_a_supermodel_of_larger_rank_is_refused():
    """The chain without gap has rank 8, its two rows have 7."""
    left, right = Family(4, damped=False)[11], Family(4, damped=False)[13]
    names = left.structure.united(right.structure).parameters
    assert not any(
        WITNESS.confirms(Supermodel(names, rank), "structure", left, right) for rank in (6, 7, 8)
    )


def test_a_whole_of_larger_rank_is_refused():
    part, whole = (
        Chain(2, damped=True, ground_dampers=(1,)),
        Chain(2, damped=True, ground_dampers=(1, 2)),
    )
    numbering = ((0, 0), (1, 1), (2, 2))
    assert not any(
        WITNESS.confirms(Embedding(True, numbering, rank), "structure", part, whole)
        for rank in (5, 6)
    )


@pytest.mark.full
@quick
@given(pair=similar_pairs(), other=similar_pairs())
def test_evidence_of_one_pair_never_decides_another_one_wrongly(pair, other):
    """Confirmed for other models, it tells the truth about them."""
    found = verdict(*pair)
    if isinstance(found.evidence, Counts | Forms | Ranks | Embedding | Supermodel):
        confirmed = WITNESS.confirms(found.evidence, found.representation, *other)
        assert not confirmed or verdict(*other).relation in (found.relation, Relation.UNDECIDED)


def test_witnesses_use_points_of_their_own():
    pair = Family(3, damped=True)[1], Family(3, damped=True)[4]
    evidence = verdict(*pair).evidence
    one, other = Witness("one"), Witness("other")
    assert one.confirms(evidence, "markov", *pair)
    assert other.confirms(evidence, "markov", *pair)
    assert set(one.memo) == set(other.memo)
    assert all(one.memo[key] != other.memo[key] for key in one.memo)


@pytest.mark.full
@often
@with_examples
@given(pair=any_pair)
def test_every_condition_reports_in_order_under_its_own_number(pair):
    parts = [("tf", "1234567"), ("markov", "1234567"), ("structure", "89")]
    expected = [(where, name) for where, names in parts for name in names]
    for count in (0, 3):
        found = list(steps(*(subject(chain) for chain in pair), Query(View.COMBINED, markov=count)))
        assert [(s.representation, s.finding.rule.name) for s in found] == expected
        assert all(
            bool(s.finding.evidence) == (s.relation is not Relation.UNDECIDED) for s in found
        )
