"""The plain SymPy twin alone reproduces what section 5.2 of the paper prints (Figs. 10, 11, 13)."""

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import combinations

import pytest

from disting.model.chain import Chain
from disting.model.family import Family
from tests.oracles import sympy_best, sympy_twin

OPEN = 0


@cache
def decided(n_masses: int, damped: bool, representation: str, count: int = 0):  # type: ignore[no-untyped-def]
    """Of a family, computed once for all tests."""
    return sympy_twin.decide_family(Family(n_masses, damped), representation, count)


def counts(found: dict[tuple[int, int], int]) -> dict[int, int]:
    return dict(sorted(Counter(found.values()).items()))


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("n_masses", "damped", "representation", "count", "expected"),
    [
        pytest.param(3, False, "tf", 0, {1: 26, 4: 15, 5: 2, 6: 2, 7: 10}, id="Fig. 10 left"),
        pytest.param(3, False, "markov", 8, {OPEN: 12, 3: 26, 4: 15, 5: 2}, id="Fig. 10 right"),
        pytest.param(3, True, "tf", 0, {OPEN: 10, 1: 26, 4: 7, 5: 10, 6: 2}, id="Fig. 11 left"),
        pytest.param(3, True, "markov", 7, {OPEN: 16, 3: 26, 4: 7, 5: 6}, id="Fig. 11 right"),
        pytest.param(3, True, "markov", 8, {OPEN: 16, 3: 26, 4: 7, 5: 6}, id="8 give the same"),
        pytest.param(3, True, "markov", 6, {OPEN: 22, 3: 26, 4: 7}, id="6 leave more open"),
        pytest.param(2, True, "tf", 0, {OPEN: 1, 1: 2}, id="2 masses damped"),
        pytest.param(
            4,
            False,
            "tf",
            0,
            {OPEN: 17, 1: 168, 4: 151, 5: 26, 6: 7, 7: 37},
            id="Fig. 13 coefficients",
        ),
        pytest.param(
            4,
            False,
            "markov",
            12,
            {OPEN: 61, 3: 208, 4: 113, 5: 24},
            id="Fig. 13 Markov parameters",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            4,
            True,
            "tf",
            0,
            {OPEN: 82, 1: 168, 4: 61, 5: 88, 6: 7},
            id="4 masses damped",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_pairs_by_deciding_condition(
    n_masses: int, damped: bool, representation: str, count: int, expected: dict[int, int]
) -> None:
    assert counts(decided(n_masses, damped, representation, count)) == expected


@pytest.mark.full
def test_both_representations_agree_on_the_three_mass_classes() -> None:
    """Undamped, Markov parameters leave exactly the indistinguishable pairs; damped, both
    together leave six pairs.
    """
    undamped = decided(3, False, "tf")
    series = decided(3, False, "markov", 8)
    assert all((undamped[pair] in (6, 7)) == (series[pair] == OPEN) for pair in undamped)

    damped = decided(3, True, "tf")
    series = decided(3, True, "markov", 7)
    assert {pair for pair, by in damped.items() if by == 6} == {(2, 5), (9, 10)}
    assert sum(damped[pair] == series[pair] == OPEN for pair in damped) == 6


@pytest.mark.slow
def test_markov_parameters_decide_eight_of_the_seventeen_four_mass_pairs() -> None:
    by_coefficients = decided(4, False, "tf")
    by_series = decided(4, False, "markov", 12)
    left = [pair for pair, by in by_coefficients.items() if by == OPEN]
    assert Counter(by_series[pair] for pair in left) == {OPEN: 9, 5: 8}
    assert by_coefficients[11, 13] == 7


@pytest.mark.full
def test_three_mass_coefficients_and_ranks() -> None:
    undamped, damped = (
        [sympy_twin.summary(chain) for chain in Family(3, damped)] for damped in (False, True)
    )
    assert {sum(model.symbolic_form) for model in undamped} == {3, 4, 5}
    assert {sum(model.symbolic_form) for model in damped} == {7, 8, 9}
    assert [i for i, model in enumerate(damped, 1) if sum(model.symbolic_form) == 7] == [3]
    assert [i for i, model in enumerate(damped, 1) if model.rank < len(model.parameters)] == [3, 7]
    assert damped[2].rank == damped[6].rank == 6


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_a_lag_is_distinguishable_from_none(damped: bool) -> None:
    for plain in Family(3, damped):
        assert 1 <= sympy_twin.decide(plain, replace(plain, lag=True)) <= 5


EXAMPLES = [
    *Family(2, damped=False),
    *Family(2, damped=True),
    *Family(3, damped=False),
    Family(3, damped=True)[1],
    Family(3, damped=True)[9],
    Chain(2, damped=True, lag=True),
    Chain(2, 1, 1, 2, 1, 2, quantity="velocity", lag=True, damped=False),
    Chain(2, 0, 0, 1, 0, 2, quantity="position", damped=True, ground_dampers=(1,)),
    Chain(2, 0, 0, 1, 0, 2, ground_dampers=(1, 2), damped=False),
]


@pytest.mark.thin(2)
@pytest.mark.sampled(5)
@pytest.mark.parametrize("chain", EXAMPLES, ids=str)
def test_the_quick_transfer_function_is_the_textbook_one(chain: Chain) -> None:
    assert sympy_twin.transfer_function(chain) == sympy_twin.transfer_function_textbook(chain)


@pytest.mark.thin(12)
@pytest.mark.parametrize("chain", EXAMPLES, ids=str)
def test_markov_parameters_are_the_series_of_the_transfer_function(chain: Chain) -> None:
    """(30): the coefficients of s^m, s^(m-1).. of denominator times series are those of the
    numerator.
    """
    b, a = sympy_twin.transfer_function(chain)
    series = sympy_twin.markov_parameters(chain, len(a))
    padded = [*b, *[0] * (len(a) + 1 - len(b))]
    for i in range(len(a) + 1):
        below = sum((a[len(a) - j] * series[i - j] for j in range(1, i + 1)), series[i])
        assert below == padded[len(a) - i]


@pytest.mark.full
def test_different_random_points_give_the_same_ranks_and_bases() -> None:
    for chain in list(Family(3, damped=True))[::3]:
        first, second = (sympy_twin.summary(chain, "tf", seed=seed) for seed in (1, 2))
        assert (first.rank, first.bases) == (second.rank, second.bases)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_the_tuned_baseline_counts_as_the_twin(damped: bool) -> None:
    tuned = sympy_best.run(3, 7, damped)
    for representation in sympy_twin.REPRESENTATIONS:
        models = [sympy_twin.summary(chain, representation, 7) for chain in Family(3, damped)]
        assert (
            Counter(sympy_twin.first_failing(*pair) for pair in combinations(models, 2))
            == tuned[representation]
        )


@pytest.mark.slow
def test_the_tuned_baseline_on_the_four_mass_damped_class() -> None:
    assert sympy_best.run() == {
        "tf": {OPEN: 89, 1: 168, 4: 61, 5: 88},
        "markov": {OPEN: 91, 3: 208, 4: 55, 5: 52},
        "tf, then markov": {OPEN: 53, 1: 168, 4: 61, 5: 124},
    }


@pytest.mark.slow
def test_the_twin_on_the_four_mass_damped_class_with_markov_parameters() -> None:
    found = decided(4, True, "markov", 12)
    assert counts(found) == {OPEN: 91, 3: 208, 4: 55, 5: 52}
