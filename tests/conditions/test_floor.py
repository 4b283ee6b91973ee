"""No statement with an error bound above 2^-100, whoever makes it; bounds count what the
theorem counts.
"""

from dataclasses import replace
from math import log2

import pytest

from disting import Certainty, Chain, Relation, Settings, compare
from disting.algebra.certainty import LEAST_SAFETY, joint_safety, shortfall
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.decide.positive import positive_finding
from disting.decide.same.exact import by_synthesis
from disting.evidence.conditions import Ranks
from disting.evidence.positive import EmptyFibre, PositiveFinding, Share
from disting.model.symmetry import canonical
from tests.conditions.handmade import handmade

RANKS = Ranks(("b0",), 1, 0, all_rows=False)
LONG = [
    (Chain(7, 0, 0, 1, 0, 1, damped=True), Chain(7, 3, 3, 4, 3, 4, damped=True)),
    (Chain(8, 0, 0, 1, 0, 1, damped=True), Chain(8, 6, 6, 7, 6, 7, damped=True)),
]


@pytest.mark.thin(8)
@pytest.mark.parametrize("safety", [-3, 0, 1, 99])
@pytest.mark.parametrize("outcome", [Outcome.HOLDS, Outcome.FAILS, Outcome.SOMETIMES])
def test_a_finding_below_the_floor_is_abandoned(outcome, safety):
    found = Finding(EXACT, outcome, Certainty.BOUNDED, safety, RANKS)
    assert (found.outcome, found.certainty, found.safety, found.evidence) == (
        Outcome.ABANDONED,
        Certainty.PROVEN,
        0,
        None,
    )
    assert ("2^-99" in found.note) == (safety == 99)
    assert (
        replace(Finding(EXACT, outcome, evidence=RANKS), certainty=Certainty.BOUNDED, safety=safety)
        == found
    )


def test_a_finding_at_the_floor_stands():
    found = Finding(EXACT, Outcome.FAILS, Certainty.BOUNDED, LEAST_SAFETY, RANKS)
    assert found.outcome is Outcome.FAILS and Finding.from_json(found.to_json()) == found


def test_a_stored_finding_below_the_floor_is_not_believed():
    text = (
        Finding(EXACT, Outcome.FAILS, Certainty.BOUNDED, 100, RANKS).to_json().replace("100", "99")
    )
    assert Finding.from_json(text).outcome is Outcome.ABANDONED


def test_positive_equivalents_and_inclusion_keep_to_the_floor():
    never = PositiveFinding(Share.NEVER, Certainty.BOUNDED, 99, EmptyFibre(()))
    assert (never.share, never.certainty, never.evidence) == (
        Share.UNKNOWN,
        None,
        None,
    ) and "2^-99" in never.reason
    neither = InclusionFinding(
        Inclusion.NEITHER, certainty=Certainty.BOUNDED, safety=99, evidence=RANKS
    )
    assert (neither.inclusion, neither.certainty, neither.evidence) == (
        Inclusion.UNKNOWN,
        None,
        None,
    )


def test_only_bounded_findings_have_a_bound():
    with pytest.raises(ValueError, match="bounded"):
        Finding(EXACT, Outcome.HOLDS, Certainty.PROVEN, 120)
    assert shortfall(Certainty.THEOREM, 0) == shortfall(None, 0) == ""


@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right"), [pytest.param(*LONG[0], marks=pytest.mark.slow), *LONG[1:]], ids=str
)
def test_long_chains_keep_to_the_floor(left, right):
    """Points of 192 bits gave 2^-99 for 7 masses and 2^-82 for 8."""
    verdict = compare(left, right)
    assert (
        verdict.relation is Relation.UNDECIDED
        or verdict.safety == 0
        or verdict.safety >= LEAST_SAFETY
    )


def test_six_masses_with_all_ground_dampers_keep_to_the_floor():
    rubbing = tuple(range(1, 7))
    chains = [
        canonical(Chain(6, damped=True, ground_dampers=rubbing, meas_plus=m)).chain for m in (1, 2)
    ]
    found = by_synthesis(*chains, Settings())
    assert found is None or found.safety >= LEAST_SAFETY


def bound(searched):
    """The theorem in plain numbers: D^(n+1)/2^B with the parameters of the searched chain."""
    n = len(searched.parameters)
    return (n + 1) * log2(max(3 * searched.n_masses + 2, n + 1))


@pytest.mark.full
def test_the_bound_counts_the_parameters_of_the_searched_chain():
    """Equal ranks, unequal numbers of parameters: the given chain's number would claim more
    than is known.
    """
    chains = [
        Chain(3, 0, 0, a, 0, 1, damped=True, ground_dampers=g)
        for a in (1, 2)
        for g in ((1,), (1, 2), (1, 2, 3), (2, 3))
    ]
    seen = 0
    for one in chains:
        for other in chains:
            a, b = canonical(one).chain, canonical(other).chain
            if len(a.parameters) == len(b.parameters):
                continue
            found = by_synthesis(a, b, Settings())
            if found is None or found.outcome is not Outcome.FAILS:
                continue
            searched = b if found.evidence.left_given else a
            longest = max(
                int(number) for _, value in found.evidence.point for number in value.split("/")
            )
            assert found.safety <= longest.bit_length() - bound(searched)
            seen += 1
    assert seen > 4


# --- what is proven
# ----------------------------------------------------------------------------------------------------


def test_a_rank_of_all_free_rows_is_proven_only_where_the_others_are_proven_constant():
    """Rows that look constant at the points might vary and add to the rank."""
    rows, labels = [[1, 0, 0], [0, 1, 0], [0, 0, 0]], ("b0", "b1", "a0")
    assert not handmade(rows, labels=labels).rank_proven
    assert handmade(rows, labels=labels, zeros=("a0",)).rank_proven
    # no more than there are parameters
    assert handmade([[1, 0], [0, 1], [0, 0]], labels=labels).rank_proven


@pytest.mark.full
def test_a_family_is_as_sure_as_all_of_its_pairs():
    assert joint_safety([]) == 0
    assert joint_safety([121]) == 121
    assert joint_safety([121] * 2_700_000) == 99


def test_positive_findings_count_the_searched_chain():
    given, other = Chain(3, damped=True), Chain(3, 1, 1, 2, 1, 3, damped=True)
    found = positive_finding(given, other)
    assert found.safety == 0 or found.safety >= LEAST_SAFETY
