"""Every condition with every outcome that it knows: holds, fails, does not apply, was given up."""

from dataclasses import replace
from itertools import combinations

import pytest

from disting import (
    CONDITIONS,
    Certainty,
    Chain,
    Engine,
    Family,
    Finding,
    Inclusion,
    Outcome,
    Query,
    Relation,
    Settings,
    View,
    compare,
)
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.profile import NoMatroid, profile
from disting.behaviour.sample import Representation
from disting.conditions import sufficient
from disting.conditions.inclusion import InclusionFinding, Inclusions, inclusions_from_dict
from disting.conditions.necessary import (
    condition_1,
    condition_2,
    condition_3,
    condition_4,
    condition_5,
)
from disting.conditions.rule import INVARIANTS
from disting.conditions.sufficient import condition_6, condition_7, condition_8, condition_9
from disting.evidence.conditions import Counts, Forms, Ranks
from tests.conditions.handmade import handmade, markov

ENGINE = Engine()
PAPER = Query(View.COMBINED)
HOLDS, FAILS, INAPPLICABLE, ABANDONED, _ = Outcome
INDEPENDENT = [[1, 0], [0, 1]]
PARALLEL = [[1, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1]]
GENERAL = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 2, 3]]


def subject(chain, settings=None):
    return (Engine(settings) if settings else ENGINE).subject(str(chain), chain)


def subjects(*chains):
    return [subject(chain) for chain in chains]


def ground(*masses, chain=None):
    return replace(chain or Chain(2, damped=True), ground_dampers=masses)


# --- 1 and 2: numbers of coefficients
# --------------------------------------------------------------------------------


def test_condition_1_counts_by_degree():
    two, three = handmade(INDEPENDENT, degrees=(1, 0)), handmade(INDEPENDENT, degrees=(1, 1))
    assert condition_1(two, two).outcome is HOLDS
    finding = condition_1(two, three)
    assert (finding.outcome, finding.certainty, finding.evidence) == (
        FAILS,
        Certainty.PROVEN,
        Counts((1, 0), (1, 1)),
    )


def test_condition_2_wants_the_same_split():
    left, right = handmade(INDEPENDENT, degrees=(2, 4)), handmade(INDEPENDENT, degrees=(0, 6))
    assert condition_1(left, right).outcome is HOLDS
    assert condition_2(left, left).outcome is HOLDS
    finding = condition_2(left, right)
    assert (finding.outcome, finding.evidence) == (FAILS, Counts((2, 4), (0, 6)))


@pytest.mark.parametrize("condition", [condition_1, condition_2])
def test_markov_parameters_have_no_degrees(condition):
    series = markov(INDEPENDENT, n_states=1)
    assert condition(series, series).outcome is INAPPLICABLE


# --- 3: symbolic form
# ------------------------------------------------------------------------------------------------


def test_condition_3_compares_what_is_constant():
    left, right = handmade([[1, 0], [0, 0]]), handmade([[0, 0], [0, 1]])
    assert condition_3(left, left).outcome is HOLDS
    finding = condition_3(left, right)
    assert (finding.outcome, finding.evidence) == (FAILS, Forms(("b0",), ("b1",)))


@pytest.mark.parametrize(
    ("zeros_left", "zeros_right", "certainty"),
    [((), (), Certainty.BOUNDED), (("b1",), (), Certainty.PROVEN), ((), ("b0",), Certainty.PROVEN)],
)
def test_condition_3_is_proven_where_a_zero_is(zeros_left, zeros_right, certainty):
    left, right = (
        handmade([[1, 0], [0, 0]], zeros=zeros_left),
        handmade([[0, 0], [0, 1]], zeros=zeros_right),
    )
    finding = condition_3(left, right)
    assert finding.certainty is certainty
    assert (finding.safety > 0) == (certainty is Certainty.BOUNDED)


def test_a_zero_of_the_side_that_varies_proves_nothing():
    left, right = handmade([[1, 0], [0, 0]], zeros=("b0",)), handmade([[1, 0], [0, 1]])
    assert condition_3(left, right).certainty is Certainty.BOUNDED


def test_an_invariant_that_one_model_lacks_is_constant_there():
    left, right = handmade(INDEPENDENT), handmade([*INDEPENDENT, [1, 1]])
    finding = condition_3(left, right)
    assert (finding.outcome, finding.certainty, finding.evidence) == (
        FAILS,
        Certainty.PROVEN,
        Forms((), ("b2",)),
    )


# --- 4: generic rank
# -------------------------------------------------------------------------------------------------


def test_condition_4_compares_ranks():
    low, high = handmade([[1, 0], [2, 0]]), handmade(INDEPENDENT)
    assert condition_4(high, high).outcome is HOLDS
    assert condition_4(high, high).certainty is Certainty.PROVEN
    assert condition_4(low, low).certainty is Certainty.BOUNDED
    for left, right in ((low, high), (high, low)):
        finding = condition_4(left, right)
        assert (finding.outcome, finding.evidence) == (
            FAILS,
            Ranks(("b0", "b1"), left.rank, right.rank, True),
        )


def test_condition_4_is_proven_where_the_smaller_rank_cannot_be_larger():
    """A rank at a point is a lower bound: the larger one needs no proof, the smaller one has it
    where it is full.
    """
    full, larger = handmade([[1], [2], [3]]), handmade([[1, 0], [2, 0], [0, 1]])
    deficient, largest = (
        handmade([[1, 0, 0], [2, 0, 0], [3, 0, 0]]),
        handmade([[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    )
    assert [condition_4(*pair).certainty for pair in ((full, larger), (larger, full))] == [
        Certainty.PROVEN
    ] * 2
    assert [
        condition_4(*pair).certainty for pair in ((deficient, largest), (largest, deficient))
    ] == [Certainty.BOUNDED] * 2
    assert condition_4(deficient, larger).safety == min(deficient.safety, larger.safety) - 1


# --- 5: dependences
# --------------------------------------------------------------------------------------------------


def test_condition_5_finds_the_smallest_rows_that_differ():
    left, right = handmade(PARALLEL), handmade(GENERAL)
    assert condition_5(left, left).outcome is HOLDS
    finding = condition_5(left, right)
    assert (finding.outcome, finding.certainty) == (FAILS, Certainty.BOUNDED)
    assert finding.evidence == Ranks(("b0", "b1"), 1, 2, False)
    assert condition_5(right, left).evidence == Ranks(("b0", "b1"), 2, 1, False)


def test_condition_5_ignores_where_the_constants_are():
    """Zero rows are left out, so summaries with other constants compare; labels keep their
    names.
    """
    left, right = (
        handmade([[1, 0], [0, 0], [0, 1]]),
        handmade([[1, 0], [0, 1]], labels=("b0", "b2")),
    )
    assert condition_5(left, right).outcome is HOLDS
    names = ("b0", "b1", "b2", "b3", "b4")
    left = handmade([[0, 0, 0], *PARALLEL], labels=names)
    right = handmade([*GENERAL], labels=names[1:])
    assert condition_5(left, right).evidence == Ranks(("b1", "b2"), 1, 2, False)


@pytest.mark.parametrize("other", [handmade([[1, 0], [0, 0]]), handmade([[1, 0], [2, 0]])])
def test_condition_5_is_asked_after_3_and_4_only(other):
    assert condition_5(handmade(INDEPENDENT), other).outcome is INAPPLICABLE


def test_condition_5_is_abandoned_where_a_matroid_is_too_large():
    full, limited = handmade(GENERAL), handmade(GENERAL, limit=3)
    assert limited.matroid == NoMatroid(
        "more than 3 sets of coefficients to examine: 4 rows of rank 3"
    )
    for pair in ((full, limited), (limited, full), (limited, limited)):
        finding = condition_5(*pair)
        assert (finding.outcome, finding.note) == (
            ABANDONED,
            "more than 3 sets of coefficients to examine: 4 rows of rank 3",
        )


@pytest.mark.parametrize("searched", [PARALLEL, [[1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0]]])
def test_a_special_search_point_is_recognised(searched):
    """A dependence, or a rank, that is there at the search point only makes no matroid."""
    special = handmade(GENERAL, searched=searched)
    assert special.matroid == NoMatroid("every search point was special; choose another seed")


def test_more_than_64_invariants_that_depend_on_each_other_are_not_searched():
    """Those that are zero, as of high powers of v that do not occur, are none of them."""
    assert isinstance(handmade([[1]] * 65).matroid, NoMatroid)
    assert not isinstance(handmade([[1]] * 64).matroid, NoMatroid)
    assert not isinstance(handmade([*[[0]] * 65, [1]]).matroid, NoMatroid)


@pytest.mark.full
@pytest.mark.parametrize(("limit", "lost"), [(0, 14), (35, 14), (36, 4), (2000, 0)])
def test_a_small_limit_leaves_pairs_undecided_and_never_decides_wrongly(limit, lost):
    """36 subsets are enough for 9 coefficients of dual rank 2, but not for 13 Markov parameters."""
    limited = Engine(Settings(subset_limit=limit))
    undecided = 0
    for left, right in combinations(Family(3, damped=True), 2):
        truth = compare(left, right, query=PAPER, engine=ENGINE).relation
        found = compare(left, right, query=PAPER, engine=limited)
        assert found.relation in (truth, Relation.UNDECIDED)
        if found.relation is not truth:
            undecided += 1
            assert any(
                f"was abandoned: more than {limit} sets of coefficients" in note
                for note in found.notes
            )
    assert undecided == lost


# --- 6: renamings
# ----------------------------------------------------------------------------------------------------


def test_condition_6_by_symmetry_is_a_theorem():
    finding = condition_6(*subjects(Family(3, damped=False)[2], Family(3, damped=False)[5]), True)
    assert (finding.outcome, finding.certainty) == (HOLDS, Certainty.THEOREM)
    assert finding.evidence.symmetries


def test_condition_6_finds_renamings_that_are_no_symmetry():
    """A free mass with a ground damper is the same with and without springs that are not there."""
    finding = condition_6(*subjects(Chain(1, damped=True), Chain(1, damped=False)), True)
    assert (finding.outcome, finding.certainty, finding.evidence.symmetries) == (
        HOLDS,
        Certainty.PROVEN,
        (),
    )
    assert finding.evidence.pairs == (("m1", "m1"),)


def test_condition_6_fails_where_no_renaming_exists():
    assert (
        condition_6(*subjects(Family(3, damped=False)[1], Family(3, damped=False)[4]), True).outcome
        is FAILS
    )


def test_condition_6_needs_exhaustive_summaries():
    assert (
        condition_6(
            *subjects(Family(3, damped=False)[2], Family(3, damped=False)[5]), False
        ).outcome
        is INAPPLICABLE
    )


def test_condition_6_is_abandoned_after_too_many_candidates(monkeypatch):
    monkeypatch.setattr(sufficient, "CANDIDATES", 0)
    assert (
        condition_6(*subjects(Chain(1, damped=True), Chain(1, damped=False)), True).outcome
        is ABANDONED
    )


@pytest.mark.parametrize(("count", "outcome"), [(11, INAPPLICABLE), (12, HOLDS), (13, HOLDS)])
def test_condition_6_on_markov_parameters_counts_the_states(count, outcome):
    """N_S1 + N_S2 = 12 for two 3-mass models."""
    relation = compare(
        Family(3, damped=False)[2],
        Family(3, damped=False)[5],
        query=Query(View.MARKOV, (6,), count),
        engine=ENGINE,
    ).relation
    assert (relation is Relation.INDISTINGUISHABLE) == (outcome is HOLDS)


# --- 7: free choice
# --------------------------------------------------------------------------------------------------


def test_condition_7_holds_for_full_rank_and_equal_constants():
    p = handmade([[1, 0], [0, 0], [0, 1]], [5, 3, 7], zeros=("b1",))
    finding = condition_7(p, p)
    assert (finding.outcome, finding.evidence.rank, finding.evidence.free) == (
        HOLDS,
        2,
        ("b0", "b2"),
    )
    assert finding.certainty is Certainty.PROVEN


def test_condition_7_asks_for_constants_that_are_proven():
    """Residues that look like one number may belong to two: what is only seen at points is not
    compared.
    """
    rows = [[1, 0], [0, 0], [0, 1]]
    sure, unsure = handmade(rows, zeros=("b1",)), handmade(rows)
    for pair in ((sure, unsure), (unsure, sure), (unsure, unsure)):
        found = condition_7(*pair)
        assert (found.outcome, found.note) == (
            INAPPLICABLE,
            "not all constant invariants are known exactly",
        )


@pytest.mark.parametrize(
    ("other", "note"),
    [
        (handmade([[1, 0], [0, 0], [0, 1]], [5, 4, 7]), "the constant invariants differ"),
        (handmade([[1, 0], [1, 1], [0, 1]]), "the constant invariants differ"),
        (handmade([[1, 0], [0, 1]], [5, 7], labels=("b0", "b2")), "the constant invariants differ"),
        (
            handmade([[1, 0], [0, 0], [1, 0]], [5, 3, 7]),
            "2 and 1 determinable parameters for 2 invariants",
        ),
    ],
)
def test_condition_7_fails(other, note):
    p = handmade([[1, 0], [0, 0], [0, 1]], [5, 3, 7])
    assert (condition_7(p, other).outcome, condition_7(p, other).note) == (FAILS, note)
    assert condition_7(other, p).outcome is FAILS


def test_equally_low_ranks_are_no_free_choice():
    p = handmade([[1, 0, 0], [2, 0, 0], [0, 1, 0]])
    assert condition_7(p, p).note == "2 and 2 determinable parameters for 3 invariants"


def test_condition_7_needs_as_many_markov_parameters_as_states():
    enough, too_few = (markov([[0, 0], [1, 0], [0, 1]], n_states=n, zeros=("G0",)) for n in (1, 2))
    assert condition_7(enough, enough).outcome is HOLDS
    for pair in ((enough, too_few), (too_few, enough), (too_few, too_few)):
        assert condition_7(*pair).outcome is INAPPLICABLE


# --- 8: submodels
# ----------------------------------------------------------------------------------------------------

LONG = Chain(3, meas_plus=3, damped=True)  # A3: its ground dampers cannot be located


@pytest.mark.parametrize("part", [(1,), (2,), (3,), (1, 2), (1, 3), (2, 3)])
def test_condition_8_holds_for_subsets_of_ground_dampers(part):
    small, large = ground(*part, chain=LONG), ground(1, 2, 3, chain=LONG)
    forward, backward = condition_8(*subjects(small, large)), condition_8(*subjects(large, small))
    assert forward.outcome is backward.outcome is HOLDS
    assert (forward.evidence.left_is_submodel, backward.evidence.left_is_submodel) == (True, False)
    assert forward.evidence.rank == backward.evidence.rank == 8
    assert (
        forward.evidence.numbering
        == backward.evidence.numbering
        == ((0, 0), (1, 1), (2, 2), (3, 3))
    )


def test_condition_8_fails_where_a_damper_adds_a_determinable_parameter():
    finding = condition_8(*subjects(ground(1), ground(1, 2)))
    assert (finding.outcome, finding.note) == (FAILS, "5 and 6 determinable parameters")


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (ground(1), ground(2)),  # equally many elements
        (ground(1), ground(2, chain=Chain(3, damped=True))),  # no ground damper at mass 1
        (Chain(2, damped=False), Chain(3, meas_plus=3, damped=False)),  # other ports
        (ground(1), ground(1, 2, chain=Chain(2, damped=True, quantity="velocity"))),
        (ground(1), ground(1, 2, chain=Chain(2, damped=True, dead_time=True))),
    ],
)
def test_condition_8_does_not_apply(left, right):
    assert condition_8(*subjects(left, right)).outcome is INAPPLICABLE
    assert condition_8(*subjects(right, left)).outcome is INAPPLICABLE


def test_condition_8_compares_chains_of_different_sizes():
    finding = condition_8(*subjects(Chain(2, damped=False), Chain(3, damped=False)))
    assert (finding.outcome, finding.note) == (FAILS, "3 and 5 determinable parameters")


# --- 9: supermodels
# --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("one", "other"), [((1,), (2,)), ((1,), (2, 3)), ((1, 2), (2, 3))])
def test_condition_9_holds_for_ground_dampers_that_cannot_be_located(one, other):
    finding = condition_9(*subjects(ground(*one, chain=LONG), ground(*other, chain=LONG)))
    united = tuple(f"b{i}" for i in sorted({*one, *other}))
    assert (finding.outcome, finding.evidence.rank) == (HOLDS, 8)
    assert finding.evidence.parameters == (*LONG.parameters, *united)


def test_condition_9_fails_where_the_third_model_has_more_to_determine():
    finding = condition_9(*subjects(ground(1), ground(2)))
    assert (finding.outcome, finding.note) == (FAILS, "5, 5 and 6 determinable parameters")


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (Family(3, damped=False)[1], Family(3, damped=False)[2]),  # other sensor place
        (Family(3, damped=False)[1], replace(Family(3, damped=False)[1], quantity="position")),
        (ground(1), replace(ground(2), dead_time=True)),
        (ground(1), ground(1, 2)),  # a submodel: condition 8
        (ground(1), ground(1)),
    ],
)
def test_condition_9_does_not_apply(left, right):
    assert condition_9(*subjects(left, right)).outcome is INAPPLICABLE


def test_the_bounds_of_8_and_9_cover_all_profiles():
    """Each of two or three ranks could be wrong: two bits less than the weakest, which is the
    largest model's.
    """
    chain = Chain(3, 1, 1, 2, 1, 3, damped=True)
    one, other, both = subjects(*(ground(*masses, chain=chain) for masses in ((2,), (3,), (2, 3))))
    whole = both.chain.structure
    largest, third = (
        profile(ChainModel(whole), Representation.TF, 0, Settings(subset_limit=n)).safety
        for n in (10**6, 0)
    )
    assert max(largest, third) < one.profile(Representation.TF, 0).safety
    for finding, weakest in (
        (condition_8(one, both), largest),
        (condition_8(both, one), largest),
        (condition_9(one, other), third),
    ):
        assert (finding.certainty, finding.safety) == (Certainty.BOUNDED, weakest - 2)


# --- the table and the finding
# ---------------------------------------------------------------------------------------


def test_the_table_is_in_the_order_of_the_paper():
    assert [c.rule.name for c in CONDITIONS] == list("123456789")
    assert len({c.rule.title for c in CONDITIONS}) == 9


def test_every_condition_reports_under_its_own_number():
    tf, chains = handmade(INDEPENDENT), subjects(Chain(2, damped=False), Chain(2, damped=False))
    necessary = [
        c(tf, tf) for c in (condition_1, condition_2, condition_3, condition_4, condition_5)
    ]
    findings = [
        *necessary,
        condition_6(*chains, True),
        condition_7(tf, tf),
        condition_8(*chains),
        condition_9(*chains),
    ]
    assert [f.rule.name for f in findings] == list("123456789")


def test_a_finding_is_neither_true_nor_false():
    with pytest.raises(TypeError, match="outcome"):
        bool(Finding(INVARIANTS, HOLDS))


def test_nor_is_one_on_an_inclusion():
    unknown = InclusionFinding(Inclusion.UNKNOWN, None)
    with pytest.raises(TypeError, match="use its inclusion"):
        bool(unknown)
    with pytest.raises(TypeError, match="use image and closure"):
        bool(Inclusions(unknown, unknown))
    with pytest.raises(TypeError, match="both statements are dictionaries"):
        inclusions_from_dict({"closure": "unknown"})


@pytest.mark.parametrize(("certainty", "safety"), [(Certainty.PROVEN, 5), (Certainty.THEOREM, 1)])
def test_a_finding_has_an_error_bound_exactly_if_it_is_bounded(certainty, safety):
    with pytest.raises(ValueError, match="error bound"):
        Finding(INVARIANTS, HOLDS, certainty, safety)
    assert Finding(INVARIANTS, HOLDS, Certainty.BOUNDED, 0).outcome is Outcome.ABANDONED
