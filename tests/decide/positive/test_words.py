"""Words of undamped rows: against eigenvalues (numpy), against explicit synthesis, and
literally.
"""

from fractions import Fraction
from itertools import pairwise, product
from random import Random

import numpy as np
import pytest
from flint import acb_poly, ctx, fmpq, fmpq_poly
from hypothesis import given, settings, strategies as st

from disting import Chain
from disting.decide.positive.obstacles import receptances
from disting.decide.positive.undamped_rows import word, words
from disting.fibres.synthesis.branch import Receptance, RowValues
from disting.fibres.synthesis.task import Target
from disting.fibres.synthesis.undamped_rows import neighbours_at
from disting.model.row import Row

PORTS = [(n, a, b) for n in range(2, 6) for a in range(1, n) for b in range(a + 1, n + 1)]


def eigenvalue_word(masses, springs, a, b):
    """springs[i] lies to the left of node i; poles and zeros as eigenvalues of M^-1/2 K M^-1/2 and
    of its corners.

    None where a pole and a zero are too near for double precision.
    """
    n = len(masses)
    stiffness = np.diag([springs[i] + (springs[i + 1] if i + 1 < n else 0) for i in range(n)])
    for i in range(1, n):
        stiffness[i, i - 1] = stiffness[i - 1, i] = -springs[i]
    jacobi = stiffness / np.sqrt(np.outer(masses, masses))
    poles = np.linalg.eigvalsh(jacobi)
    zeros = [*np.linalg.eigvalsh(jacobi[: a - 1, : a - 1]), *np.linalg.eigvalsh(jacobi[b:, b:])]
    if zeros and np.abs(np.subtract.outer(poles, zeros)).min() < 1e-10 * poles[-1]:
        return None
    return tuple(int(sum(low < z < high for z in zeros)) for low, high in pairwise(poles))


def row(random, n, at_wall):
    values = [[float(2 ** random.uniform(-5, 5)) for _ in range(n)] for _ in range(2)]
    if not at_wall:
        values[1][0] = 0.0
    return values


def from_word(given):
    """A receptance with this word: poles 0, -10, -20, ..; two zeros of a gap at 3 and 7."""
    zeros = [10 * i + place for i, count in enumerate(given) for place in ((), (3,), (3, 7))[count]]
    numerator, denominator = fmpq_poly([1]), fmpq_poly([1])
    for z in zeros:
        numerator *= fmpq_poly([z, 1])
    for i in range(len(given) + 1):
        denominator *= fmpq_poly([10 * i, 1])
    return Target(numerator, denominator)


def has_positive_neighbours(n, a, t, kappa):
    with ctx.workprec(600):
        data = Receptance(acb_poly(t.numerator), acb_poly(t.denominator))
        leaves = [
            x
            for x in neighbours_at(Row(n, False, a, a + 1), data, kappa)
            if isinstance(x, RowValues)
        ]
        values = [[*leaf.masses, *(k[0] for k in leaf.springs)] for leaf in leaves]
        return any(all(v.real > 0 and abs(v.imag) < 1e-60 for v in each) for each in values)


def test_literal_sets():
    assert words(4, 1, 2).lower == {(0, 1, 1), (1, 0, 1), (1, 1, 0)}
    assert words(4, 2, 3).lower == {(0, 1, 1), (1, 0, 1), (1, 1, 0), (0, 2, 0)}
    assert words(3, 1, 3).lower == {(0, 0)}


@pytest.mark.full
def test_complete_to_six_masses_and_always_for_neighbours():
    for n in range(2, 10):
        for a, b in product(range(1, n), range(2, n + 1)):
            if a < b:
                known = words(n, a, b)
                assert known.lower <= known.upper
                if n <= 6 or b == a + 1 or a == 1 or b == n:
                    assert known.lower == known.upper


@pytest.mark.full
def test_one_zero_a_gap_at_most_is_always_possible():
    """So two rows with the same distance between the ports always have words in common."""
    for n in range(2, 10):
        for a, b in product(range(1, n), range(2, n + 1)):
            if a < b:
                assert words(n, 1, 1 + b - a).lower <= words(n, a, b).lower


def test_first_row_with_an_open_word():
    known = words(7, 3, 5)
    assert known.upper - known.lower == {(0, 0, 2, 2, 0, 0)}


@pytest.mark.full
@pytest.mark.sampled(7)
@pytest.mark.parametrize("at_wall", [False, True])
@pytest.mark.parametrize(
    ("n", "a", "b"),
    [pytest.param(*p, marks=[pytest.mark.slow] * (p[0] == 5 and p[1:] != (2, 4))) for p in PORTS],
)
def test_random_rows_have_exactly_these_words(n, a, b, at_wall):
    random = Random(f"{n}{a}{b}{at_wall}")
    seen = {eigenvalue_word(*row(random, n, at_wall), a, b) for _ in range(1500)}
    assert seen - {None} == words(n, a, b).lower


@settings(max_examples=60, deadline=None)
@given(st.integers(2, 5), st.integers(), st.integers(0, 99), st.integers(0, 99), st.booleans())
def test_exact_word_agrees_with_eigenvalues(n, seed, i, j, at_wall):
    a, b = 1 + i % (n - 1), 0
    b = a + 1 + j % (n - a)
    masses, springs = row(Random(seed), n, at_wall)
    chain = (
        Chain(n + 1, n, a, n + 1, b, n + 1, damped=False)
        if at_wall
        else Chain(n, 0, 0, a, 0, b, damped=False)
    )
    names = [f"k{i}{i + 1}" for i in range(0 if at_wall else 1, n)]
    exact = dict(zip(names, springs if at_wall else springs[1:], strict=True)) | {
        f"m{i + 1}": m for i, m in enumerate(masses)
    }
    point = {name: fmpq(*Fraction(value).as_integer_ratio()) for name, value in exact.items()} | (
        {f"m{n + 1}": fmpq(1)} if at_wall else {}
    )
    expected = eigenvalue_word(masses, springs, a, b)
    assert expected is None or word(receptances(chain, point)[0]) == expected


@pytest.mark.thin(2)
@pytest.mark.parametrize(("n", "a"), [(3, 1), (4, 1), (4, 2), (5, 2), (5, 3)])
def test_neighbours_are_positive_exactly_with_these_words(n, a):
    """Sufficient: a small spring serves. Necessary: no spring of many does."""
    for each in product((0, 1, 2), repeat=n - 1):
        if sum(each) != n - 2:
            continue
        t = from_word(each)
        assert word(t) == each
        if each in words(n, a, a + 1).lower:
            assert has_positive_neighbours(n, a, t, fmpq(1, 2**40))
        else:
            assert not any(
                has_positive_neighbours(n, a, t, fmpq(2) ** e) for e in range(-20, 31, 10)
            )


@pytest.mark.parametrize(
    ("numerator", "denominator", "expected"),
    [
        ([1], [1, 0, 1], ()),  # poles that are not real
        ([-1], [0, 1, 1], ()),  # a negative gain
        ([20, 1], [0, 2, 1], ()),  # a zero outside
        ([5, 2, 1], [0, 8, 6, 1], ()),  # zeros that are not real
        ([9, 6, 1], [0, 8, 6, 1], None),  # a double zero
        ([1, 1], [0, 1, 1], None),  # a zero on a pole
    ],
)
def test_receptances_without_a_word(numerator, denominator, expected):
    assert word(Target(fmpq_poly(numerator), fmpq_poly(denominator))) == expected
