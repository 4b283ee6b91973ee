"""Equivalents with positive parameters: theorems hold at random points, and what is proven to
exist or not is so.
"""

from itertools import combinations
from math import comb

import numpy as np
import pytest
from flint import fmpq

from disting import Chain, Family
from disting.decide.same.exact import theorem
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.fibres.synthesis.theorems import are_foster, are_same_by_rows
from disting.model.question import Answer
from disting.model.row import rows_of
from disting.model.symmetry import canonical
from tests.oracles.positive_synthesis import positive_equivalent, positive_point


def theorem_pairs(n):
    return [
        (a, b)
        for a, b in combinations(Family(n, damped=False), 2)
        if theorem(a, b) in ("Foster", "parts")
    ]


@pytest.mark.full
@pytest.mark.parametrize("n", [2, 3, 4, pytest.param(5, marks=pytest.mark.slow)])
def test_equivalents_of_the_theorems_are_found_positive(n):
    """Where each row's ports are at most neighbours all members are tried; farther apart only
    one member of a family is.
    """
    for k, (a, b) in enumerate(theorem_pairs(n)):
        for given, other in ((a, b), (b, a)):
            answer = positive_equivalent(given, positive_point(given, f"theorem:{k}"), other)
            assert answer is Answer.YES if distance(other) < 2 else answer is not Answer.NO


def distance(chain):
    """Largest distance of the two ports inside one row."""
    return max(row.distance for row in rows_of(canonical(chain).chain.structure))


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "n",
    [2, 3, 4, 5, pytest.param(6, marks=pytest.mark.slow), pytest.param(8, marks=pytest.mark.slow)],
)
def test_foster_counts_the_solutions(n):
    """C(N-1, g) C(g-1, a-1) C(N-g-1, a_plus-g-1) parameter vectors, all positive."""
    given = Chain(n, damped=False)
    whole = target(given.structure, positive_point(given, f"foster:{n}"))
    for g in range(n):
        for low in range(1, g + 1) if g else (0,):
            for high in range(g + 1, n + 1) if g else range(1, n + 1):
                other = Chain(n, g, low, high, low, high, damped=False)
                found = fibre(other, whole)
                expected = (
                    comb(n - 1, g)
                    * (comb(g - 1, low - 1) if g else 1)
                    * comb(n - g - 1, high - g - 1)
                )
                assert are_foster(given, other)
                assert (found.status, len(found.solutions)) == (Status.COMPLETE, expected)
                assert all(s.positive is Answer.YES for s in found.solutions)


@pytest.mark.parametrize("n", range(2, 7))
def test_rows_at_the_wall_read_backwards_have_positive_springs(n):
    """The reversal theorem in floating point: build the reversed row and compare both responses."""
    rng = np.random.default_rng(n)
    masses, springs = rng.uniform(0.5, 2, n), rng.uniform(0.5, 2, n)
    k = (
        np.diag(springs + np.append(springs[1:], 0))
        - np.diag(springs[1:], 1)
        - np.diag(springs[1:], -1)
    )
    root = np.sqrt(masses)
    j = (k / root / root[:, None])[::-1, ::-1]
    s = np.linalg.solve(j, np.eye(n)[0])
    assert (s > 0).all()
    for a, b in combinations(range(n), 2):
        mirrored = (n - 1 - b, n - 1 - a)
        t = np.sqrt(root[a] * root[b] / (s[mirrored[0]] * s[mirrored[1]]))
        new = np.diag(t * s) @ j @ np.diag(t * s)
        assert (
            np.allclose(new[1:].sum(axis=1), 0) and new[0].sum() > 0 and (np.diag(new, 1) < 0).all()
        )
        for x in (0.3, 1.7, -0.2):
            one = np.linalg.inv(k + x * np.diag(masses))[a, b]
            assert np.isclose(np.linalg.inv(new + x * np.diag((t * s) ** 2))[mirrored], one)


def test_parts_need_the_same_gap_and_no_damping():
    family = Family(4, damped=False)
    assert are_same_by_rows(family[14], family[20]) and not are_same_by_rows(family[2], family[6])
    assert not are_same_by_rows(Family(4, damped=True)[14], Family(4, damped=True)[20])


@pytest.mark.full
def test_some_positive_models_have_an_equivalent_and_others_have_none():
    """4-mass undamped models 2 and 6: every 2 has one in 6, about a quarter of the 6 has none
    in 2.
    """
    two, six = Family(4, damped=False)[2], Family(4, damped=False)[6]
    assert all(
        positive_equivalent(two, positive_point(two, str(k)), six) is Answer.YES for k in range(10)
    )
    answers = [positive_equivalent(six, positive_point(six, str(k)), two) for k in range(20)]
    assert set(answers) == {Answer.YES, Answer.NO}


@pytest.mark.full
def test_a_refuted_point_has_no_member_of_the_family_that_is_positive():
    """Independent: many springs between the ports, everything else by NumPy."""
    two, six = Family(4, damped=False)[2], Family(4, damped=False)[6]
    points, couplings = (
        [positive_point(six, str(k)) for k in range(12)],
        np.geomspace(1e-4, 1e4, 150),
    )
    refuted = [p for p in points if positive_equivalent(six, p, two) is Answer.NO]
    assert refuted
    for point in refuted:
        assert not any(_positive_member(six, point, kappa) for kappa in couplings)
    reached = next(p for p in points if positive_equivalent(six, p, two) is Answer.YES)
    assert any(_positive_member(six, reached, kappa) for kappa in couplings)


def _positive_member(chain, point, kappa):
    """Whether D + kappa N = Theta Phi gives a free row of four with ports 1 and 2: Theta has
    one root, Phi three.
    """
    whole = target(chain.structure, point).folded(1)
    n, d = (
        [float(c.p) / float(c.q) for c in p.coeffs()] for p in (whole.numerator, whole.denominator)
    )
    both = np.polynomial.polynomial.polyadd(d, kappa * np.array(n))
    poles, zeros = (
        np.polynomial.polynomial.polyroots(both),
        np.sort(np.polynomial.polynomial.polyroots(n).real),
    )
    if np.abs(poles.imag).max() > 1e-9 * np.abs(poles).max() or poles.real.max() >= 0:
        return False
    return any(_alternate(np.sort(np.delete(poles.real, k)), zeros) for k in range(len(poles)))


def _alternate(poles, zeros):
    """Roots of Phi and of B alternate, starting and ending with Phi: then Phi/B is a row with
    positive elements.
    """
    return all(poles[i] < zeros[i] < poles[i + 1] for i in range(len(zeros)))


def test_damped_points_never_have_the_negative_equivalent_taken_for_positive():
    """Model 7 lies in model 6, with negative elements: no positive one."""
    family = Family(3, damped=True)
    answers = {
        positive_equivalent(family[7], positive_point(family[7], str(k)), family[6])
        for k in range(4)
    }
    assert Answer.YES not in answers
    assert positive_equivalent(family[1], positive_point(family[1], "none"), family[6]) is Answer.NO


def test_special_points_are_not_decided():
    ones = {name: fmpq(1) for name in Family(4, damped=False)[6].parameters}
    assert (
        positive_equivalent(Family(4, damped=False)[6], ones, Family(4, damped=False)[2])
        is Answer.UNKNOWN
    )
