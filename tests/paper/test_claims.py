"""What section 5 of the paper prints, and what is known beyond it, found by this package; literal
numbers throughout.

Where the conditions leave open what is true (the candidates of Fig. 1), the truth is shown by a
fibre, and what the conditions reach is stated beside it.
"""

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import chain as flatten, combinations

import numpy as np
import pytest

from disting import Chain, Engine, Family, Outcome, Quantity, Query, Relation, View, compare
from disting.behaviour.sample import Representation
from disting.conditions.sufficient import condition_7, condition_9
from tests.paper.fibre import fibre_is_empty

ENGINE = Engine()
PAPER = Query(View.COMBINED)


@cache
def decided(n_masses, damped=False, view=View.COMBINED, markov=0, sensor=Quantity.ACCELERATION):
    subjects = [
        ENGINE.subject(f"A{i}", chain)
        for i, chain in enumerate(Family(n_masses, damped, sensor), 1)
    ]
    return ENGINE.decisions(subjects, Query(view, markov=markov))


COMPLEX = Query(View.EXACT)


@cache
def verdict(left, right, query=COMPLEX):
    """Over complex parameters, as in the paper."""
    return compare(left, right, query=query, engine=ENGINE)


def counts(*args, **kwargs):
    """Pairs by deciding condition, undecided ones under 0."""
    return {int(number or 0): n for number, n in decided(*args, **kwargs).counts().items() if n}


def numbers(found):
    """Pairs (i, j) of model numbers by deciding condition."""
    size = len(found.subjects)
    return {(i + 1, j + 1): int(found.rule(i, j) or 0) for i, j in combinations(range(size), 2)}


def profiles(chains, representation=Representation.TF, count=0):
    return [ENGINE.subject("", chain).profile(representation, count) for chain in chains]


def damper_sets(n):
    """All sets of masses 1..n, the smaller ones first."""
    return list(flatten.from_iterable(combinations(range(1, n + 1), size) for size in range(n + 1)))


def with_dampers(chain):
    return [replace(chain, ground_dampers=masses) for masses in damper_sets(chain.n_masses)]


# --- Table 2
# ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("n_masses", "models"),
    [(1, 1), (2, 3), (3, 11), (4, 29), (5, 73), (6, 157), (7, 314), (8, 574), (9, 993), (10, 1623)],
)
def test_table_2_and_its_continuation(n_masses, models):
    assert len(Family(n_masses, damped=False)) == models


# --- Figs. 10, 11 and 13: pairs by deciding condition
# ----------------------------------------------------------------


@pytest.mark.parametrize(
    ("n_masses", "damped", "view", "markov", "expected"),
    [
        pytest.param(3, False, View.TF, 0, {1: 26, 4: 15, 5: 2, 6: 2, 7: 10}, id="Fig. 10 left"),
        pytest.param(3, False, View.MARKOV, 8, {0: 12, 3: 26, 4: 15, 5: 2}, id="Fig. 10 right"),
        pytest.param(3, False, View.MARKOV, 7, {0: 29, 3: 26}, id="fewer than 8 leave more open"),
        pytest.param(3, True, View.TF, 0, {0: 10, 1: 26, 4: 7, 5: 10, 6: 2}, id="Fig. 11 left"),
        pytest.param(3, True, View.MARKOV, 7, {0: 16, 3: 26, 4: 7, 5: 6}, id="Fig. 11 right"),
        pytest.param(3, True, View.MARKOV, 8, {0: 16, 3: 26, 4: 7, 5: 6}, id="8 give the same"),
        pytest.param(3, True, View.MARKOV, 6, {0: 22, 3: 26, 4: 7}, id="6 leave more open"),
        pytest.param(
            4,
            False,
            View.TF,
            0,
            {0: 17, 1: 168, 4: 151, 5: 26, 6: 7, 7: 37},
            id="Fig. 13 coefficients",
        ),
        pytest.param(
            4,
            False,
            View.MARKOV,
            12,
            {0: 61, 3: 208, 4: 113, 5: 24},
            id="Fig. 13 Markov parameters",
        ),
        pytest.param(
            4, True, View.TF, 0, {0: 82, 1: 168, 4: 61, 5: 88, 6: 7}, id="4 masses damped"
        ),
        pytest.param(
            3,
            False,
            View.COMBINED,
            0,
            {1: 26, 4: 15, 5: 2, 6: 2, 7: 10},
            id="3 masses undamped, all",
        ),
        pytest.param(
            3, True, View.COMBINED, 0, {0: 6, 1: 26, 4: 7, 5: 14, 6: 2}, id="3 masses damped, all"
        ),
        pytest.param(
            4, False, View.COMBINED, 0, {0: 9, 1: 168, 4: 151, 5: 34, 6: 7, 7: 37}, id="Fig. 13"
        ),
    ],
)
def test_pairs_by_deciding_condition(n_masses, damped, view, markov, expected):
    assert counts(n_masses, damped, view, markov) == expected


def test_seven_and_eight_markov_parameters_draw_the_same_picture():
    assert np.array_equal(
        decided(3, True, View.MARKOV, 7).decided_by,
        decided(3, True, View.MARKOV, 8).decided_by,
    )


def test_undamped_markov_parameters_leave_exactly_the_indistinguishable_pairs():
    by_coefficients, by_series = (
        numbers(decided(3, view=View.TF)),
        numbers(decided(3, view=View.MARKOV, markov=8)),
    )
    left = {pair for pair, by in by_series.items() if by == 0}
    assert left == {pair for pair, by in by_coefficients.items() if by in (6, 7)}
    assert len(left) == 12


def test_markov_parameters_decide_eight_of_the_seventeen():
    by_coefficients = numbers(decided(4, view=View.TF))
    by_series = numbers(decided(4, view=View.MARKOV, markov=12))
    open_pairs = [pair for pair, by in by_coefficients.items() if by == 0]
    assert Counter(by_series[pair] for pair in open_pairs) == {0: 9, 5: 8}


def test_damped_renamings_are_the_two_of_the_symmetries():
    assert {pair for pair, by in numbers(decided(3, True)).items() if by == 6} == {(2, 5), (9, 10)}


def test_markov_parameters_tell_a1_from_a4_where_coefficients_cannot():
    """Fig. 12: "indistinguishability" is printed where distinguishability is shown."""
    assert numbers(decided(3, True, View.TF))[1, 4] == 0
    found = verdict(*(Family(3, damped=True)[i] for i in (1, 4)))
    assert (found.relation, found.decided_by, found.representation) == (
        Relation.DISTINGUISHABLE,
        "5",
        "markov",
    )


# --- numbers of coefficients and of determinable parameters
# ----------------------------------------------------------


@pytest.mark.parametrize(
    ("damped", "free", "ranks"),
    [
        (False, [5, 4, 3, 5, 4, 5, 5, 5, 5, 5, 5], [5, 4, 3, 5, 4, 5, 4, 5, 4, 4, 5]),
        (True, [9, 8, 7, 9, 8, 9, 9, 9, 9, 9, 9], [7, 7, 6, 7, 7, 7, 6, 7, 7, 7, 7]),
    ],
)
def test_non_constant_coefficients_and_ranks_of_the_three_mass_models(damped, free, ranks):
    found = profiles(Family(3, damped))
    assert [len(p.form) for p in found] == free
    assert [p.rank for p in found] == ranks
    assert {p.n_parameters for p in found} == {7 if damped else 5}


def test_a3_alone_has_seven_coefficients_and_a3_and_a7_rank_six():
    found = dict(enumerate(profiles(Family(3, damped=True)), 1))
    assert [i for i, p in found.items() if len(p.form) == 7] == [3]
    assert [i for i, p in found.items() if p.rank < p.n_parameters] == [3, 7]


# --- condition 9
# -----------------------------------------------------------------------------------------------------


def test_four_mass_models_11_and_13_differ_in_the_gap_alone():
    left, right = Family(4, damped=False)[11], Family(4, damped=False)[13]
    assert left.indices == (4, 1, 1, 3, 1, 3)
    assert replace(left, gap=2) == right


def test_condition_7_decides_11_and_13_and_condition_9_does_not():
    """Printed: condition 9. The chain without gap has 8 determinable parameters, its two
    submodels 7.
    """
    left, right = (ENGINE.subject(str(i), Family(4, damped=False)[i]) for i in (11, 13))
    assert condition_7(*profiles((left.chain, right.chain))).outcome is Outcome.HOLDS
    finding = condition_9(left, right)
    assert (finding.outcome, finding.note) == (Outcome.FAILS, "7, 7 and 8 determinable parameters")
    assert compare(left.chain, right.chain, query=Query(View.EXACT)).decided_by == "7"


@pytest.mark.parametrize(
    ("n_masses", "pairs"), [(3, 0), (4, 2), pytest.param(5, 11, marks=pytest.mark.slow)]
)
def test_condition_9_never_holds_in_a_family(n_masses, pairs):
    subjects = [ENGINE.subject("", chain) for chain in Family(n_masses, damped=False)]
    outcomes = Counter(condition_9(*pair).outcome for pair in combinations(subjects, 2))
    assert outcomes[Outcome.FAILS] == pairs
    assert outcomes[Outcome.HOLDS] == 0


# --- condition 2
# -----------------------------------------------------------------------------------------------------


def pivotal_for_condition_2(*groups):
    """Pairs of models of different groups with equally many coefficients, split differently."""
    degrees = [[p.degrees for p in profiles(group)] for group in groups]
    split = (
        a != b
        for one, other in combinations(degrees, 2)
        for a in one
        for b in other
        if sum(a) == sum(b)
    )
    return sum(split)


def test_condition_2_is_pivotal_between_undamped_sizes_only():
    """Printed for one size: never. A mass more can move two coefficients from the numerator to
    the denominator.
    """
    assert pivotal_for_condition_2(*(Family(n, damped=False) for n in (1, 2, 3, 4))) == 20
    assert pivotal_for_condition_2(*(Family(n, damped=True) for n in (1, 2, 3, 4))) == 0


def test_a_collocated_two_mass_and_a_three_mass_model_differ_by_condition_2():
    found = verdict(Chain(2, damped=False), Chain(3, meas_plus=3, damped=False))
    assert (found.relation, found.decided_by, found.evidence.left, found.evidence.right) == (
        Relation.DISTINGUISHABLE,
        "2",
        (2, 2),
        (0, 4),
    )


def test_within_a_family_conditions_2_and_8_are_never_pivotal():
    families = [(n, damped) for n in (2, 3, 4) for damped in (False, True)]
    assert not any({2, 8} & set(counts(n, damped)) for n, damped in families)


# --- sensors, lag and dead time
# --------------------------------------------------------------------------------------


@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("view", [View.TF, View.MARKOV, View.COMBINED])
@pytest.mark.parametrize("sensor", [Quantity.POSITION, Quantity.VELOCITY])
def test_every_sensor_quantity_gives_the_same_picture(sensor, view, damped):
    plain, other = decided(3, damped, view), decided(3, damped, view, sensor=sensor)
    assert np.array_equal(plain.decided_by, other.decided_by)
    assert np.array_equal(plain.representation, other.representation)


@pytest.mark.parametrize("damped", [False, True])
def test_a_lag_is_distinguishable_from_none_in_all_eleven_cases(damped):
    found = [verdict(chain, replace(chain, lag=True)) for chain in Family(3, damped)]
    assert Counter((v.relation, v.decided_by) for v in found) == {
        (Relation.DISTINGUISHABLE, "1"): 11
    }


@pytest.mark.parametrize("damped", [False, True])
def test_lagged_models_are_told_from_all_eleven_original_ones(damped):
    found = [verdict(a, replace(b, lag=True)) for a in Family(3, damped) for b in Family(3, damped)]
    assert {v.relation for v in found} == {Relation.DISTINGUISHABLE}
    assert Counter(v.decided_by for v in found) == ({"1": 103, "2": 18} if damped else {"1": 121})


@pytest.mark.parametrize("damped", [False, True])
def test_a_dead_time_is_distinguishable_from_none(damped):
    found = [verdict(chain, replace(chain, dead_time=True)) for chain in Family(3, damped)]
    assert Counter((v.relation, v.decided_by, v.evidence.only_right) for v in found) == {
        (Relation.DISTINGUISHABLE, "3", ("Td",)): 11
    }


# --- Fig. 14: ground dampers
# -----------------------------------------------------------------------------------------

LEFT_OPEN = {
    2: {((1,), (2,))},
    3: {((2,), (3,)), ((1, 2), (1, 3)), ((1, 2), (2, 3)), ((1, 3), (2, 3))},
}


@pytest.mark.parametrize(("n_masses", "distinguishable"), [(1, 1), (2, 5), (3, 24)])
def test_candidates_of_fig_1_with_any_ground_dampers(n_masses, distinguishable):
    """All pairs are distinguishable. The conditions prove it but for a few, which need a fibre
    (below).
    """
    pairs = list(combinations(with_dampers(Chain(n_masses, damped=True)), 2))
    found = {(a.ground_dampers, b.ground_dampers): verdict(a, b, PAPER).relation for a, b in pairs}
    assert Counter(found.values())[Relation.DISTINGUISHABLE] == distinguishable
    assert Counter(found.values())[Relation.INDISTINGUISHABLE] == 0
    assert {pair for pair, r in found.items() if r is Relation.UNDECIDED} == LEFT_OPEN.get(
        n_masses, set()
    )


def test_candidates_of_fig_1_with_four_masses():
    relations = Counter(
        verdict(a, b, PAPER).relation
        for a, b in combinations(with_dampers(Chain(4, damped=True)), 2)
    )
    assert relations == {Relation.DISTINGUISHABLE: 96, Relation.UNDECIDED: 24}


@pytest.mark.parametrize(
    "n_masses", [1, 2, *(pytest.param(n, marks=pytest.mark.slow) for n in (3, 4))]
)
def test_the_exact_decision_tells_all_candidates_apart(n_masses):
    chains = with_dampers(Chain(n_masses, damped=True))
    assert {verdict(a, b).relation for a, b in combinations(chains, 2)} == {
        Relation.DISTINGUISHABLE
    }


@pytest.mark.parametrize(("left", "right"), [((2,), (3,)), ((1, 2), (1, 3)), ((1,), (1, 2, 3))])
def test_the_exact_decision_tells_some_candidates_of_three_masses_apart(left, right):
    """Two of them are pairs that conditions leave open."""
    pair = (Chain(3, damped=True, ground_dampers=masses) for masses in (left, right))
    assert verdict(*pair).relation is Relation.DISTINGUISHABLE


@pytest.mark.slow
@pytest.mark.parametrize(
    ("n_masses", "left", "right"),
    [(2, (1,), (2,)), (3, (2,), (3,))]
    + [
        pytest.param(3, *pair, marks=pytest.mark.slow)
        for pair in sorted(LEFT_OPEN[3])
        if len(pair[0]) == 2
    ],
)
def test_a_fibre_tells_the_candidates_apart_that_the_conditions_leave_open(n_masses, left, right):
    """No parameters of the right model give the transfer function of the left one at a random
    point.
    """
    one, other = (Chain(n_masses, damped=True, ground_dampers=masses) for masses in (left, right))
    assert fibre_is_empty(one, other)
    assert not fibre_is_empty(one, one)


def test_ground_dampers_of_a3_cannot_be_located():
    """Every two non-empty sets: condition 6 where one set mirrors the other, condition 7
    everywhere else.
    """
    found = {
        (a.ground_dampers, b.ground_dampers): verdict(a, b)
        for a, b in combinations(with_dampers(Family(3, damped=True)[3])[1:], 2)
    }
    assert len(found) == 21
    assert {v.relation for v in found.values()} == {Relation.INDISTINGUISHABLE}
    assert {pair for pair, v in found.items() if v.decided_by == "6"} == {
        ((1,), (3,)),
        ((1, 2), (2, 3)),
    }
    assert Counter(v.decided_by for v in found.values()) == {"6": 2, "7": 19}


def test_a_ground_damper_of_a3_is_told_from_none():
    none, *some = with_dampers(Family(3, damped=True)[3])
    assert {(verdict(none, other).relation, verdict(none, other).decided_by) for other in some} == {
        (Relation.DISTINGUISHABLE, "1")
    }


def test_eight_and_nine_are_pivotal_with_ground_dampers():
    """Printed for one family: condition 8 never. Dampers that only add to what is there decide
    by structure.
    """
    free = Chain(2, 1, 1, 2, 1, 2, ground_dampers=(1,), damped=False)
    assert verdict(free, replace(free, damped=True)).decided_by == "8"
    long = Chain(3, 2, 1, 3, 2, 3, damped=True, ground_dampers=(1,))
    assert verdict(long, replace(long, ground_dampers=(2,))).decided_by == "9"
