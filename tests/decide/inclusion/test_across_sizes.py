"""Inclusion of chains in chains with more masses: all pairs of small sizes, evidence true and
false, and laws.
"""

from collections import Counter
from dataclasses import replace
from itertools import product

import pytest

from disting import Chain, Engine, Family, Inclusion, Query, compare
from disting.conditions.inclusion import Sense
from disting.decide.inclusion.across_sizes import by_sizes, exceeds, show_inclusion, twins
from disting.decide.inclusion.confirmation import confirms
from disting.decide.inclusion.decide import CLOSURE, inclusions
from disting.decide.inclusion.limit_fibre import tells
from disting.decide.inclusion.limits import is_limit, least_rank, most_rank
from disting.evidence.conditions import Counts
from disting.evidence.ideals import Solutions
from disting.evidence.limits import (
    Limit,
    LimitFibre,
    Meeting,
    PoleSharing,
    RowLimit,
    TooLarge,
)
from disting.model.symmetry import canonical

ENGINE = Engine()


def subjects(n, damped=False):
    return [ENGINE.subject(f"{n}:{i}", chain) for i, chain in enumerate(Family(n, damped), 1)]


def subject(n, number, damped=False):
    return ENGINE.subject(f"{n}:{number}", Family(n, damped)[number])


def limits(left, right):
    """What is said of limits; of finite elements only what follows from it."""
    both = inclusions(left, right)
    assert both.image == both.closure or not both.image.is_known
    return both.closure


def found(sizes, damped):
    """Findings on all pairs of unequal rank."""
    pairs = product(*(subjects(n, damped) for n in sizes))
    return {(a, b): limits(a, b) for a, b in pairs if a.rank != b.rank}


@pytest.mark.thin(3)
@pytest.mark.parametrize(
    ("sizes", "damped", "inside", "outside"),
    [
        ((1, 2), False, 3, 0), ((1, 3), False, 11, 0), ((1, 4), False, 29, 0),
        ((2, 3), False, 31, 0), ((2, 4), False, 85, 2), ((3, 4), False, 258, 21),
        ((1, 2), True, 3, 0), ((1, 3), True, 11, 0), ((1, 4), True, 29, 0),
        ((2, 3), True, 33, 0), ((2, 4), True, 87, 0),
    ],
)  # fmt: skip
def test_every_pair_is_settled(sizes, damped, inside, outside):
    """Of equal ranks, which only the undamped ones have, the verdict itself says that neither
    lies in the other.
    """
    findings = found(sizes, damped)
    counts = Counter(f.inclusion for f in findings.values())
    assert counts == {
        k: n for k, n in ((Inclusion.LEFT_IN_RIGHT, inside), (Inclusion.NEITHER, outside)) if n
    }
    for (a, b), finding in findings.items():
        assert confirms(finding.evidence, a, b) and not confirms(finding.evidence, b, a)
        assert CLOSURE.decode(CLOSURE.encode(finding)) == finding
        assert a.name in finding.evidence.sentence(a.name, b.name) and finding.evidence.formula


@pytest.mark.slow
def test_damped_models_of_three_in_four_masses():
    findings = found((3, 4), True)
    counts = Counter(f.inclusion for f in findings.values())
    assert counts == {Inclusion.LEFT_IN_RIGHT: 278, Inclusion.NEITHER: 41}
    assert all(confirms(f.evidence, *pair) for pair, f in findings.items())
    assert all(f.safety >= 100 for f in findings.values() if f.certainty == "bounded")


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_findings_turn_round_with_the_pair(damped):
    turned = {Inclusion.LEFT_IN_RIGHT: Inclusion.RIGHT_IN_LEFT}
    for a, b in product(subjects(3, damped), [subject(4, i, damped) for i in (1, 4, 10, 16, 23)]):
        if a.rank != b.rank:
            there, back = limits(a, b), limits(b, a)
            assert back.inclusion is turned.get(there.inclusion, there.inclusion)
            assert (there.certainty, there.safety) == (back.certainty, back.safety)
            assert confirms(back.evidence, b, a)


@pytest.mark.full
def test_one_mass_is_a_limit_of_every_model():
    for damped in (False, True):
        larger = (canonical(c).chain for n in (2, 3, 4) for c in Family(n, damped))
        assert all(
            isinstance(show_inclusion(Chain(1, damped=damped), chain, False), Limit)
            for chain in larger
        )


def test_a_chain_grows_by_its_last_mass():
    """The ports stay where they are, the new mass is let go."""
    small, large = (canonical(Chain(n, 1, 1, 2, 1, 3, damped=False)).chain for n in (3, 4))
    parts = {p.given: p for p in show_inclusion(small, large, False).parts}
    assert parts["grounded"] == RowLimit("grounded", "grounded", ())
    assert parts["free"].steps in ((("k23", "0"),), (("k12", "0"),), (("k23", "∞"),))


def test_a_row_let_go_while_the_other_comes_to_rest():
    evidence = limits(subject(3, 3), subject(4, 23)).evidence
    assert evidence == Limit(False, (RowLimit("grounded", "free", (("k01", "0"),)),))
    assert evidence.formula == "grounded ⇒ free: k01 → 0"
    assert "the grounded row becomes the free one with k01 zero" in evidence.sentence("3:3", "4:23")


def test_a_limit_by_a_theorem():
    """The free row of three is the same as a grounded row of two with a free mass, by duality."""
    evidence = limits(subject(3, 1, True), subject(4, 20, True)).evidence
    assert isinstance(evidence, Limit) and evidence.smaller == (3, 2, 2, 3, 2, 3)
    assert "3:1 being the same as the chain (3, 2, 2, 3, 2, 3)" in evidence.sentence("3:1", "4:20")


def test_a_row_by_a_count():
    """A free row of two masses, ports together, lies in that of three with ports apart, by
    dimensions.
    """
    small, large = subject(3, 6, True), subject(4, 10, True)
    evidence = limits(small, large).evidence
    free = next(p for p in evidence.parts if p.wanted == "free")
    assert free == RowLimit("free", "free", (), (6, 8, 1, 1)) and free.formula == "6 + 1 + 1 ≥ 8"
    for false in (
        free._replace(room=(7, 8, 1, 1)),
        free._replace(room=()),
        free._replace(steps=(("k12", "∞"),)),
    ):
        parts = tuple(false if p.wanted == "free" else p for p in evidence.parts)
        assert not confirms(replace(evidence, parts=parts), small, large)


def test_false_limits_are_refused():
    small, large = subject(3, 3), subject(4, 23)
    true = limits(small, large).evidence
    part = true.parts[0]
    assert confirms(true, small, large)
    for parts in (
        (),
        (part, part),
        (part._replace(given="free"),),
        (part._replace(wanted="grounded"),),
    ):
        assert not confirms(replace(true, parts=parts), small, large)
    for steps in ((), (("k01", "∞"),), (("m1", "∞"),), (("k99", "0"),)):
        assert not confirms(replace(true, parts=(part._replace(steps=steps),)), small, large)
    assert not confirms(replace(true, left_is_larger=True), small, large)
    assert not confirms(replace(true, smaller=(3, 0, 0, 1, 0, 1)), small, large)
    assert not confirms(replace(true, larger=(4, 9, 9, 9, 9, 9)), small, large)
    assert not confirms(replace(true, parts=(("free", "free", ()),)), subject(3, 1), subject(3, 2))


def test_false_counts_are_refused():
    small, large = subject(2, 1), subject(3, 7)
    true = limits(small, large).evidence
    assert (
        true == Meeting(False, 4, 6, 2, False)
        and true.formula == "4 + 2 ≥ 6"
        and confirms(true, small, large)
    )
    for false in (
        {"rank": 5},
        {"coordinates": 5},
        {"factors": 3},
        {"same_mass": True},
        {"left_is_larger": True},
    ):
        assert not confirms(replace(true, **false), small, large)
    for evidence in (
        Counts((4, 4), (2, 6)),
        TooLarge(5, 7),
        PoleSharing(False, "x", ((1, 2, 3),)),
        true,
    ):
        assert not confirms(evidence, subject(3, 1), subject(4, 1))


@pytest.mark.full
@pytest.mark.parametrize("number", [14, 20])
def test_a_limit_and_then_a_fibre(number):
    """The grounded row is let go: two free rows, one of negative mass, are a free and a
    grounded one.
    """
    small, large = subject(3, 6, True), subject(4, number, True)
    finding, turned = limits(small, large), limits(large, small)
    assert (finding.inclusion, turned.inclusion) == (
        Inclusion.LEFT_IN_RIGHT,
        Inclusion.RIGHT_IN_LEFT,
    )
    assert isinstance(finding.evidence, LimitFibre) and finding.safety >= 100
    assert finding.evidence.steps == (("grounded", (("k01", "0"),)), ("free", ()))
    assert finding.evidence.formula.startswith("grounded: k01 → 0")
    assert "k01 zero in the grounded row" in finding.evidence.sentence("S", "L")
    assert confirms(finding.evidence, small, large) and confirms(turned.evidence, large, small)
    assert CLOSURE.decode(CLOSURE.encode(turned)) == turned
    solutions = tuple(tuple(x + 1 for x in q) for q in finding.evidence.solutions)
    for false in (
        {"solutions": solutions},
        {"steps": ()},
        {"steps": finding.evidence.steps[:1]},
        {"left_is_larger": True},
    ):
        assert not confirms(replace(finding.evidence, **false), small, large)


def test_more_zeros_refute():
    small, large = subject(3, 1, True), subject(4, 4, True)
    finding = limits(small, large)
    assert (finding.inclusion, finding.certainty) == (Inclusion.NEITHER, "proven")
    assert finding.evidence == Counts((4, 4), (3, 6)) and confirms(finding.evidence, small, large)
    assert not confirms(Counts((4, 4), (4, 6)), small, large)


def test_larger_ranks_refute():
    """Four masses with force and sensor together have 7 parameters, five with ports 1 and 2
    apart in the rows only 6.
    """
    small, large = (
        ENGINE.subject("4:1", Chain(4, damped=False)),
        ENGINE.subject("5", Chain(5, 2, 1, 3, 2, 5, damped=False)),
    )
    finding = limits(small, large)
    assert (finding.inclusion, finding.evidence) == (Inclusion.NEITHER, TooLarge(7, 6))
    assert finding.safety >= 100 and confirms(finding.evidence, small, large)
    assert not confirms(TooLarge(7, 5), small, large) and not confirms(TooLarge(6, 7), small, large)
    assert limits(large, small).evidence == TooLarge(6, 7)


def test_as_many_poles_are_left_open():
    """A damper to the ground and a lag give the smaller chain as many poles: nothing is said
    against the larger one in it.
    """
    small = ENGINE.subject("small", Chain(2, ground_dampers=(1,), lag=True, damped=False))
    large = ENGINE.subject("large", Chain(3, meas_plus=3, damped=True))
    assert not exceeds(small.chain, small.chain)
    finding = by_sizes(small, large)
    assert finding.inclusion is Inclusion.UNKNOWN and "as many poles" in finding.reason


@pytest.mark.full
def test_a_large_common_factor_is_refuted_too():
    """Three masses fewer, but the grounded mass can share one pole only."""
    small, large = subject(3, 1), ENGINE.subject("6", Chain(6, 1, 1, 2, 1, 6, damped=False))
    finding = limits(small, large)
    assert (
        finding.inclusion is Inclusion.NEITHER
        and finding.certainty == "proven"
        and confirms(finding.evidence, small, large)
    )


@pytest.mark.slow
def test_undamped_models_of_up_to_six_masses():
    models = [s for n in range(1, 7) for s in subjects(n)]
    pairs = [
        (a, b)
        for a, b in product(models, repeat=2)
        if a.chain.n_masses < b.chain.n_masses and a.rank != b.rank
    ]
    counts = Counter(limits(a, b).inclusion for a, b in pairs)
    assert counts == {Inclusion.LEFT_IN_RIGHT: 15484, Inclusion.NEITHER: 4403}


def test_twins():
    assert twins(canonical(Chain(2, damped=True)).chain) == (
        Chain(2, damped=True),
        Chain(2, 1, 1, 2, 1, 2, damped=True),
    )
    lagging = Chain(2, lag=True, damped=False)
    assert twins(lagging) == (lagging,)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_inclusion_is_transitive_across_sizes(damped):
    """Through all sizes, with the inclusions and equalities of one size: what follows is never
    refuted.
    """
    models = [s for n in (1, 2, 3) for s in subjects(n, damped)]
    models += [subject(4, i, damped) for i in (4, 10, 16, 18, 23, 27)]
    decided = ENGINE.decisions(models, Query())
    inside, apart = set(), set()
    for i, j in product(range(len(models)), repeat=2):
        low, high = min(i, j), max(i, j)
        inclusion = decided.inclusion(low, high, Sense.CLOSURE)
        if i != j and inclusion in (
            Inclusion.EQUAL,
            Inclusion.LEFT_IN_RIGHT if i < j else Inclusion.RIGHT_IN_LEFT,
        ):
            inside.add((i, j))
        elif inclusion is Inclusion.NEITHER:
            apart.add((i, j))
    assert not [
        (i, j, k)
        for i, j in inside
        for k in range(len(models))
        if (j, k) in inside and (i, k) in apart
    ]
    assert len(inside) > 100 and len(apart) > 20


def test_compare_says_the_same_as_a_matrix():
    small, large = Family(2, damped=True)[1], Family(3, damped=True)[4]
    verdict, turned = compare(small, large, engine=ENGINE), compare(large, small, engine=ENGINE)
    assert verdict.closure is Inclusion.LEFT_IN_RIGHT and turned.closure is Inclusion.RIGHT_IN_LEFT
    assert verdict.inclusions.closure == limits(subject(2, 1, True), subject(3, 4, True))
    refused = compare(Family(3, damped=False)[2], Family(4, damped=False)[10], engine=ENGINE)
    assert refused.closure is Inclusion.NEITHER and isinstance(
        refused.inclusions.closure.evidence, PoleSharing
    )


def test_each_limit_is_shown_as_an_identity_when_it_is_found():
    small, large = (s.view.form for s in (subject(2, 2), subject(3, 9)))
    is_limit.cache_clear()
    evidence = show_inclusion(small, large, False)
    assert isinstance(evidence, Limit) and any(part.steps for part in evidence.parts)
    assert is_limit.cache_info().currsize >= sum(len(part.steps) for part in evidence.parts)


@pytest.mark.parametrize(
    ("chain", "is_proven"),
    [(Chain(3, damped=True), True), (Chain(5, 4, 1, 5, 2, 5, damped=False), False)],
)
def test_a_solution_in_the_larger_chain_alone_needs_a_rank_without_chance(chain, is_proven):
    """In the second eight of nine parameters are determined, by nine coefficients: points alone
    say that it is not more.
    """
    structure = chain.structure
    assert (most_rank(structure) == least_rank(structure)) is is_proven
    for left_given in (True, False):
        solved = Solutions(left_given, ("x",), ((1,),))
        assert tells(solved, structure, structure, "seed") is (left_given or is_proven)
