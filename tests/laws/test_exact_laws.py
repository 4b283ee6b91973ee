"""Laws of the exact decision: what the conditions leave open, it settles alike from both sides,
with evidence that holds.
"""

import json
from dataclasses import replace
from functools import cache
from itertools import combinations

import pytest
from hypothesis import given, strategies as st

from disting import Chain, Query, Relation, Verdict, View
from disting.conditions.rule import EXACT
from disting.evidence.decision import FibreAt
from disting.verdict.cascade import audit, decide, steps
from tests.laws.pairs import ENGINE, PAPER, WITNESS, family, quick, similar_pairs, subject

ONLY = Query(View.EXACT, inclusion=False)
# masses, damped, pairs that conditions 1 to 9 leave open (facts of the paper)
FAMILIES = [(3, True, 6), (4, False, 9)]
RUBBED = [Chain(2, damped=True, ground_dampers=(1,)), Chain(2, damped=True, ground_dampers=(2,))]


@cache
def open_pairs():
    """Pairs that conditions 1 to 9 leave open."""
    found = [(subject(RUBBED[0]), subject(RUBBED[1]))]
    for n, damped, count in FAMILIES:
        subjects = family(n, damped)
        paper = ENGINE.decisions(subjects, PAPER)
        left = [
            pair
            for pair in combinations(range(len(subjects)), 2)
            if paper.relation(*pair) is Relation.UNDECIDED
        ]
        assert len(left) == count
        found += [(subjects[i], subjects[j]) for i, j in left]
    return found


PAIRS = range(1 + sum(count for _, _, count in FAMILIES))


@pytest.mark.thin(8)
@pytest.mark.parametrize("number", PAIRS)
def test_what_is_open_is_settled_alike_from_both_sides(number):
    left, right = open_pairs()[number]
    there, back = decide(left, right, ONLY), decide(right, left, ONLY)
    assert there.decided_by == back.decided_by == EXACT.name
    assert there.relation is back.relation is not Relation.UNDECIDED


@pytest.mark.thin(8)
@pytest.mark.parametrize("number", PAIRS)
def test_its_evidence_checks_again_and_survives_json(number):
    left, right = open_pairs()[number]
    found = decide(left, right, Query(View.EXACT))
    assert WITNESS.confirms(found.evidence, found.representation, left.chain, right.chain)
    assert Verdict.from_dict(json.loads(json.dumps(found.to_dict()))) == found


@pytest.mark.thin(8)
@pytest.mark.parametrize("number", PAIRS)
def test_its_evidence_is_refused_for_a_pair_of_the_other_relation(number):
    pairs = open_pairs()
    found = decide(*pairs[number], ONLY)
    others = [pair for pair in pairs if decide(*pair, ONLY).relation is not found.relation]
    assert others
    for left, right in others:
        assert not WITNESS.confirms(found.evidence, found.representation, left.chain, right.chain)


@pytest.mark.parametrize(
    "tamper",
    [
        lambda e: replace(e, left_given=not e.left_given),
        lambda e: replace(e, grounds="construction"),
        lambda e: replace(e, point=e.point[1:]),
        lambda e: replace(e, point=(("q1", "1"), *e.point[1:])),
        lambda e: replace(e, point=(("m1", "x"), *e.point[1:])),
        lambda e: replace(e, point=(("m1", "1/0"), *e.point[1:])),
    ],
)
def test_a_tampered_fibre_is_refused(tamper):
    left, right = family(3, True)[0], family(3, True)[5]
    found = decide(left, right, ONLY)
    assert isinstance(found.evidence, FibreAt) and found.relation is Relation.DISTINGUISHABLE
    assert WITNESS.confirms(found.evidence, found.representation, left.chain, right.chain)
    assert not WITNESS.confirms(
        tamper(found.evidence), found.representation, left.chain, right.chain
    )


def rigid(pair):
    """The pair without dampers to the ground, which make the exact decision slow."""
    return [replace(chain, ground_dampers=()) for chain in pair]


@pytest.mark.full
@quick
@given(pair=similar_pairs().map(rigid))
def test_it_never_contradicts_a_condition(pair):
    subjects = [subject(chain) for chain in pair]
    assert audit(*subjects, ONLY) == decide(*subjects, ONLY)
    assert decide(*subjects, PAPER).relation in (
        decide(*subjects, ONLY).relation,
        Relation.UNDECIDED,
    )


@pytest.mark.full
@quick
@given(pair=similar_pairs().map(rigid), markov=st.sampled_from([0, 3]))
def test_it_is_the_last_to_report(pair, markov):
    found = list(steps(*(subject(chain) for chain in pair), Query(markov=markov)))
    assert [(s.representation, s.finding.rule) for s in found].index(("fibre", EXACT)) == len(
        found
    ) - 1
    assert bool(found[-1].finding.evidence) == (found[-1].relation is not Relation.UNDECIDED)


@pytest.mark.full
@quick
@given(pair=similar_pairs().map(rigid))
def test_the_mirrored_pair_has_the_mirrored_verdict(pair):
    there, back = (
        decide(*(subject(chain) for chain in order), ONLY) for order in (pair, pair[::-1])
    )
    assert (there.relation, there.decided_by) == (back.relation, back.decided_by)
