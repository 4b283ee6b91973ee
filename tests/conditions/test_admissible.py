"""Real and positive parameters: literal truths, laws of the order of a pair, evidence that is
altered.
"""

from collections import Counter
from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import given, settings, strategies as st

from disting import (
    Certainty,
    Chain,
    ContradictionError,
    Engine,
    Family,
    Outcome,
    Query,
    Relation,
    View,
    compare,
)
from disting.algebra.certainty import weakest
from disting.catalogs import Catalog
from disting.catalogs.build import build, false_evidence
from disting.catalogs.export import decisions_csv
from disting.conditions.inclusion import Inclusion
from disting.conditions.rule import positive_ways
from disting.decide import asking
from disting.decide.identifiability.analysis import identifiability
from disting.decide.positive import positive_finding, proves
from disting.decide.same.evidence_check import Witness
from disting.decide.same.real_and_positive import by_counts, positive_share, resting_on
from disting.evidence.kinds import evidence_from
from disting.evidence.positive import (
    BothWays,
    EmptyFibre,
    OddFibres,
    PositiveFinding,
    RealFactors,
    Share,
)
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.question import Answer, Domain, Settings
from disting.model.symmetry import canonical
from disting.report.payload import VIEWS, over, payload
from disting.verdict.result import Verdict
from tests.oracles.positive_synthesis import positive_point

POSITIVE = Query(View.POSITIVE)
REAL = Query(View.REAL)
PAIRS = list(combinations(range(1, 12), 2))


@pytest.fixture(scope="module")
def small():
    return {damped: build(3, damped=damped, engine=Engine()) for damped in (False, True)}


def shares(verdict):
    return tuple(
        None if x is None else x.share.value
        for x in (verdict.left_positive, verdict.right_positive)
    )


@pytest.mark.full
def test_damped_chains_of_three_masses(small):
    """Which pairs are so for positive parameters always, sometimes and never; nothing else is
    asked.
    """
    known = {(i, j): shares(v) for i, j, v in small[True].pairs() if shares(v) != (None, None)}
    always = ("always", "always")
    limits = {(6, 7): (None, "never"), (2, 3): (None, "never"), (3, 5): ("never", None)}
    assert known == {(1, 11): always, (2, 5): always, (9, 10): always} | limits
    over = {(i, j): v.relation for i, j, v in small[True].pairs(View.POSITIVE)}
    assert [pair for pair, r in over.items() if r is Relation.INDISTINGUISHABLE] == [
        (1, 11),
        (2, 5),
        (9, 10),
    ]
    assert set(over.values()) == {Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE}


@pytest.mark.full
@pytest.mark.parametrize(("n", "small_model", "large_model"), [(3, 7, 6), (4, 20, 8)])
def test_included_models_without_positive_equivalents(n, small_model, large_model):
    family = Family(n, damped=True)
    v = compare(family[small_model], family[large_model])
    assert v.relation is Relation.DISTINGUISHABLE and v.closure is Inclusion.LEFT_IN_RIGHT
    assert shares(v) == ("never", None)
    assert v.left_positive.certainty is Certainty.PROVEN
    assert shares(compare(family[large_model], family[small_model])) == (None, "never")


@pytest.mark.full
@pytest.mark.parametrize(("n", "i", "j"), [(4, 2, 6), (5, 3, 8)])
def test_undamped_pairs_that_depend_on_the_parameters(n, i, j):
    a, b = Family(n, damped=False)[i], Family(n, damped=False)[j]
    v = compare(a, b, query=POSITIVE)
    assert (v.relation, v.certainty, shares(v)) == (
        Relation.SOMETIMES,
        Certainty.THEOREM,
        ("always", "sometimes"),
    )
    low, high = v.right_positive.empirical.interval
    assert 0 < low < v.right_positive.empirical.hits / 100 < high < 1
    assert f"empirically {low:.0%} to {high:.0%}" in v.sentence
    assert Witness().confirms(v.evidence, v.representation, a, b)
    assert Verdict.from_dict(v.to_dict()) == v and evidence_from(v.evidence.to_dict()) == v.evidence


@pytest.mark.full
@settings(max_examples=30, deadline=None)
@given(
    st.sampled_from(PAIRS), st.booleans(), st.sampled_from((View.EXACT, View.POSITIVE, View.REAL))
)
def test_the_order_of_a_pair_swaps_what_is_said_of_the_sides(pair, damped, view):
    a, b = (Family(3, damped)[number] for number in pair)
    there, back = compare(a, b, query=Query(view)), compare(b, a, query=Query(view))
    assert shares(back) == shares(there)[::-1]
    assert (back.relation, back.certainty) == (there.relation, there.certainty)
    assert back.closure is there.closure.turned and back.image is there.image.turned
    asked = (Inclusion.EQUAL, Inclusion.LEFT_IN_RIGHT)
    assert (
        (there.left_positive is not None)
        == (there.closure in asked)
        == (back.right_positive is not None)
    )
    if isinstance(there.evidence, BothWays):
        assert back.evidence == BothWays(there.evidence.right, there.evidence.left)
    if isinstance(there.evidence, OddFibres):
        assert back.evidence == OddFibres(there.evidence.right, there.evidence.left)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_catalogues_decisions_and_single_pairs_say_the_same(small, damped):
    engine, family = Engine(), Family(3, damped)
    subjects = [engine.subject(f"3:{k}", chain) for k, chain in enumerate(family, 1)]
    for view in (View.EXACT, View.POSITIVE, View.REAL):
        decided = engine.decisions(subjects, Query(view))
        assert decisions_csv(decided) == small[damped].to_csv(view)
        for number, (i, j, v) in enumerate(small[damped].pairs(view)):
            assert decided.verdict(i - 1, j - 1) == v
            if number % 3:
                continue  # a third of them alone, each without what is known of others
            one = compare(family[i], family[j], query=Query(view))
            assert (one.relation, one.evidence, shares(one)) == (v.relation, v.evidence, shares(v))


@pytest.mark.full
def test_nothing_is_asked_of_the_papers_views(small):
    header, *rows = small[True].to_csv(View.COMBINED).splitlines()
    assert header.endswith(",image,closure,left_positive,right_positive,damped,quantity")
    assert all(row.endswith(",complex,,,,,true,acceleration") for row in rows)
    assert (
        sum(
            row.endswith(",complex,,right-in-left,,never,true,acceleration")
            for row in small[True].to_csv(View.EXACT).splitlines()
        )
        == 1
    )
    assert (
        sum(
            row.endswith(",positive,,right-in-left,,never,true,acceleration")
            for row in small[True].to_csv().splitlines()
        )
        == 1
    )


@pytest.mark.full
def test_altered_shares_are_found_out(small):
    records = [dict(record) for record in small[True].records]
    place = next(k for k, r in enumerate(records) if (r.get("left"), r.get("right")) == (6, 7))
    assert list(false_evidence(Catalog.from_records(records))) == []
    right = records[place]["right_positive"]
    lies = [
        right | {"share": "always"},
        right | {"certainty": "theorem"},
        right
        | {
            "evidence": right["evidence"] | {"name": "decay", "point": []},
            "certainty": "theorem",
        },
        right | {"evidence": right["evidence"] | {"point": []}, "certainty": "theorem"},
        right
        | {
            "evidence": {"kind": "theorem", "name": "duality"},
            "share": "always",
            "certainty": "theorem",
        },
    ]
    for lie in lies:
        altered = [
            *records[:place],
            records[place] | {"right_positive": lie},
            *records[place + 1 :],
        ]
        assert any("7:6" in sentence for sentence in false_evidence(Catalog.from_records(altered)))


@pytest.mark.full
def test_altered_evidence_of_a_verdict_is_refused():
    two, six = Family(4, damped=False)[2], Family(4, damped=False)[6]
    true = compare(two, six, query=POSITIVE).evidence
    nothing = PositiveFinding(Share.UNKNOWN, reason="forgotten")
    points = true.right.evidence
    swapped = replace(
        true.right, evidence=replace(points, with_one=points.without, without=points.with_one)
    )
    witness = Witness()
    assert witness.confirms(true, "parameters", two, six)
    assert not witness.confirms(true, "parameters", six, two)
    for lie in (
        BothWays(true.right, true.left),
        replace(true, right=swapped),
        BothWays(nothing, nothing),
    ):
        assert not witness.confirms(lie, "parameters", two, six)
    assert not proves(
        replace(true.right, share=Share.ALWAYS), canonical(six).chain, canonical(two).chain
    )


def test_a_smaller_error_than_the_bound_is_refused():
    family = Family(3, damped=True)
    found = positive_finding(family[1], family[4])
    assert isinstance(found.evidence, EmptyFibre) and proves(found, family[1], family[4])
    assert not proves(replace(found, safety=found.safety + 1), family[1], family[4])


@pytest.mark.full
def test_shares_to_findings():
    two, six = Family(4, damped=False)[2], Family(4, damped=False)[6]
    always, sometimes = positive_finding(two, six), positive_finding(six, two)
    damped = Family(3, damped=True)
    never, unknown = (
        positive_finding(damped[1], damped[4]),
        PositiveFinding(Share.UNKNOWN, reason="nobody knows"),
    )
    table = {
        (always, always): Outcome.HOLDS,
        (never, never): Outcome.FAILS,
        (always, sometimes): Outcome.SOMETIMES,
        (sometimes, sometimes): Outcome.SOMETIMES,
        (sometimes, unknown): Outcome.SOMETIMES,
        (always, unknown): Outcome.ABANDONED,
        (unknown, never): Outcome.ABANDONED,
        (unknown, unknown): Outcome.ABANDONED,
    }
    for (left, right), outcome in table.items():
        for ways in ((left, right), (right, left)):
            found = positive_ways(*ways)
            assert found.outcome is outcome
            assert ("nobody knows" in found.note) == (outcome is Outcome.ABANDONED)
    assert positive_ways(never, never).safety == never.safety - 1
    for ways in ((never, always), (sometimes, never)):
        with pytest.raises(ContradictionError):
            positive_ways(*ways)


def test_chains_of_two_kinds_are_not_compared():
    found = positive_share(
        Chain(3, damped=False), Chain(3, dead_time=True, damped=False), Settings()
    )
    assert found.share is Share.UNKNOWN and "one size" in found.reason


def test_grades_add_up():
    bounded = (Certainty.BOUNDED, 100)
    assert weakest((Certainty.THEOREM, 0), (Certainty.PROVEN, 0)) == (Certainty.PROVEN, 0)
    assert weakest(bounded, bounded, bounded) == (Certainty.BOUNDED, 98)
    assert weakest(bounded, (Certainty.NUMERICAL, 0)) == (Certainty.NUMERICAL, 0)


@pytest.mark.full
def test_over_real_parameters(small):
    """Rational maps; real factors both ways; an open set without real equivalents beside one
    with positive ones.
    """
    family = Family(3, damped=False)
    rational, factors, some = (
        compare(family[i], family[j], query=REAL) for i, j in ((2, 5), (1, 11), (1, 4))
    )
    assert (rational.relation, rational.certainty) == (
        Relation.INDISTINGUISHABLE,
        Certainty.THEOREM,
    )
    assert (factors.relation, factors.evidence) == (Relation.INDISTINGUISHABLE, RealFactors())
    assert (some.relation, some.decided_by) == (Relation.SOMETIMES, "admissible")
    settled = [v for *_, v in small[False].pairs(View.REAL) if v.decided_by == "admissible"]
    assert Counter(v.evidence.kind for v in settled) == {
        "theorem": 2,
        "real factors": 3,
        "real witnesses": 7,
    }
    assert list(false_evidence(small[False])) == []


@pytest.mark.full
def test_the_page_says_which_positive_models_have_equivalents(small):
    text = str(payload(small[True], [over(small[True], view) for view in VIEWS]))
    assert "No generic {R} with positive parameters has a positive equivalent {L}." in text
    assert "Every {L} with positive parameters has a positive equivalent {R}." in text


@pytest.mark.full
@pytest.mark.parametrize(("n", "i", "j"), [(3, 1, 11), (4, 1, 5), (4, 5, 29)])
def test_real_parameters_of_either_sign_have_real_equivalents(n, i, j):
    """Independent: the fibre in ball arithmetic at real points with negative elements."""
    family, seen = Family(n, damped=False), 0
    for one, other in ((family[i], family[j]), (family[j], family[i])):
        for k in range(8):
            point = {
                name: -v if (k >> at) & 1 else v
                for at, (name, v) in enumerate(positive_point(one, f"{k}").items())
            }
            found = fibre(other, target(one.structure, point))
            if found.status is Status.COMPLETE:
                assert any(s.real is not Answer.NO for s in found.solutions)
                seen += 1
    assert seen > 8


@pytest.mark.full
def test_odd_fibres_rest_on_the_finding_over_complex_parameters():
    """Undamped chains have a stronger reason; counts serve where there is none."""
    family = Family(3, damped=False)
    finding = by_counts(*(identifiability(family[k]) for k in (1, 11)))
    assert (finding.outcome, finding.evidence) == (Outcome.HOLDS, OddFibres(1, 1))
    over = asking.over_domain(
        Engine().subject("a", family[1]), Engine().subject("b", family[11]), Domain.REAL
    )
    assert (over.certainty, over.evidence, resting_on(over, (Certainty.BOUNDED, 120))) == (
        Certainty.THEOREM,
        RealFactors(),
        over,
    )
    assert (
        resting_on(
            replace(finding, certainty=Certainty.BOUNDED, safety=120), (Certainty.BOUNDED, 120)
        ).safety
        == 119
    )
    for lie in (OddFibres(1, 3), OddFibres(2, 2), OddFibres(3, 1)):
        assert not Witness().confirms(lie, "parameters", family[1], family[11])
