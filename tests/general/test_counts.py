"""Cases with the same number of roots for all parameters, against numbers of roots at many points."""

import random

import numpy as np
import pytest

from disting import Domain
from disting.general.counts import at_roots, count_roots_at, number_of_roots
from disting.general.elimination import Case
from disting.general.orthant import Orthant

RING = Orthant(2, 1, Domain.POSITIVE)
A, B, X, _ = RING.generators
KNOWN = [
    ((X**2 - A,), (), 1),
    ((X**2 - A * X - B,), (), 1),
    ((X**2 + A * X + B,), (), 0),
    ((X**2 - (A + B) * X + A * B,), (), None),  # a double root at a = b
    ((X**2 - (2 * A + B) * X + A * (A + B),), (), 2),  # roots a and a + b
    ((X**2 - (2 * A + B) * X + A * (A + B),), (X - A - B**2,), None),
    ((X**2 - 2 * (A + B) * X + A * B,), (X - A - B,), 1),
    ((X**2 - 2 * (A + B) * X + A * B,), (A + B - X,), 1),
    ((X**2 - 2 * (A + B) * X + A * B,), (X - 3 * (A + B),), 0),
    ((X**2 - 2 * X + A,), (), None),
    ((A * X**3 - B,), (X**2 + A * X - B**2,), None),
    (((A - B) * X - 1,), (), None),
]


def seen(case, a, b):
    """How many roots there are at numbers, by their eigenvalues."""
    at = [
        np.polynomial.Polynomial(
            [
                float(
                    sum(
                        int(c) * a ** int(e[0]) * b ** int(e[1])
                        for e, c in g.to_dict().items()
                        if e[2] == k
                    )
                )
                for k in range(int(g.degrees()[2]) + 1)
            ]
        )
        for g in (*case.equations, *case.positive)
    ]
    real = [r.real for r in at[0].roots() if abs(r.imag) < 1e-9 and r.real > 0]
    return sum(all(g(r) > 0 for g in at[1:]) for r in real)


@pytest.mark.full
@pytest.mark.parametrize(("equations", "positive", "number"), KNOWN)
def test_known_numbers(equations, positive, number):
    case = Case(equations, positive)
    assert number_of_roots(RING, case) == number
    draw = random.Random(3)
    numbers = {seen(case, *np.exp([draw.uniform(-3, 3), draw.uniform(-3, 3)])) for _ in range(300)}
    assert number is None or numbers == {number}


@pytest.mark.thin(8)
@pytest.mark.parametrize("seed", range(60))
def test_a_number_that_is_told_is_that_of_every_point(seed):
    draw = random.Random(seed)

    def drawn(terms, degree):
        return sum(
            (
                draw.choice([-2, -1, 1, 1, 2])
                * A ** draw.randint(0, 1)
                * B ** draw.randint(0, 1)
                * X ** draw.randint(0, degree)
                for _ in range(terms)
            ),
            RING.number(0),
        )

    equation = drawn(3, 2) + X ** draw.randint(1, 3) * A
    case = Case((equation,), tuple(drawn(2, 1) for _ in range(draw.randint(0, 1))))
    found = number_of_roots(RING, case)
    if found is None:
        return
    for _ in range(40):
        assert seen(case, *np.exp([draw.uniform(-3, 3), draw.uniform(-3, 3)])) == found


def test_real_numbers_are_not_asked():
    ring = Orthant(1, 1, Domain.REAL)
    p, x, _ = ring.generators
    assert number_of_roots(ring, Case((x**2 - p,))) is None


@pytest.mark.parametrize(
    ("equation", "asked", "number"),
    [
        (X**2 - A, (), 1),
        (X**2 - A, (X - 1,), 1),
        ((X - A) ** 2, (), None),  # a double root
        ((A - 2) * X**2 + X - 1, (), None),  # one that is infinite
        (X**2 - A, (X**2 - A,), None),  # a sign that is zero, to however many bits
    ],
)
def test_roots_at_one_point_are_counted_where_all_signs_are_known(equation, asked, number):
    assert count_roots_at(RING, equation, [(g,) for g in asked], (), 2, {0: 2, 1: 3}) == number


def test_a_remainder_of_more_terms_than_are_allowed_leaves_the_case_as_it_is():
    case = Case((X**2 - A,), (X**3 - B,))
    assert at_roots(RING, case).positive == (A * X - B,)
    assert at_roots(Orthant(2, 1, Domain.POSITIVE, terms=0), case) == case
