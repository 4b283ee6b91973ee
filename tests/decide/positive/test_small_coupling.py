"""The sufficient condition of `words` carried out in numbers for 5 free masses, ports 2 and 4: two
springs between the ports.

Pieces 1-2, 3, 4-5, each lighter than the one before, are tuned by Newton's method until the poles
are the prescribed ones.
"""

from itertools import permutations

import numpy as np
import pytest

from disting.decide.positive.undamped_rows import words

WORDS = sorted(words(5, 2, 4).lower)
COUPLING = 1e-4


def row(alpha, beta, p, omega, total, product):
    """Masses and springs: 1-2 free with poles 0, p and zero alpha at 2; 3 on a spring; 4-5 on a
    spring, zero beta at 4.
    """
    k12 = p - alpha
    k34 = product / beta
    k45 = total - beta - k34
    masses = np.array([k12 / alpha, 1, COUPLING, COUPLING**2, COUPLING**2 * k45 / beta])
    springs = np.array([k12, COUPLING * omega, COUPLING**2 * k34, COUPLING**2 * k45])
    return masses, springs


def poles(masses, springs):
    stiffness = (
        np.diag([*springs, 0]) + np.diag([0, *springs]) - np.diag(springs, 1) - np.diag(springs, -1)
    )
    return np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(masses, masses)))[1:]


def zeros(word):
    return [10 * i + place for i, count in enumerate(word) for place in ((), (4,), (3, 7))[count]]


def starts(word):
    """Every way to share out the poles 10, 20, 30, 40 (0 is in the first piece), and the zeros,
    the row mirrored or not.
    """
    for alpha, beta in permutations(zeros(word)):
        for p, omega, *pair in permutations((10, 20, 30, 40)):
            if alpha < p and pair[0] < beta < pair[1]:
                yield alpha, beta, np.array([p, omega, sum(pair), pair[0] * pair[1]], float)


def tuned(alpha, beta, x, target):
    for _ in range(30):
        here = poles(*row(alpha, beta, *x))
        step = 1e-6 * x
        slopes = np.array(
            [(poles(*row(alpha, beta, *(x + d))) - here) / d.sum() for d in np.diag(step)]
        ).T
        x = x - np.linalg.solve(slopes, here - target)
    return row(alpha, beta, *x)


@pytest.mark.parametrize("word", WORDS)
def test_every_word_is_realised_at_prescribed_poles_and_zeros(word):
    target = np.array([10.0, 20.0, 30.0, 40.0])
    alpha, beta, x = next(starts(word))
    masses, springs = tuned(alpha, beta, x, target)
    assert (masses > 0).all() and (springs > 0).all()
    assert np.abs(poles(masses, springs) - target).max() < 1e-6
    ends = springs[0] / masses[0], springs[3] / masses[4]
    assert sorted(ends) == pytest.approx(zeros(word))


def test_there_is_no_start_for_other_words():
    assert not list(starts((2, 0, 0, 0))) and not list(starts((0, 0, 0, 2)))
