"""Foster's theorem on random instances: as many solutions as it says, all real and positive."""

from math import comb
from random import Random

import pytest

from disting import Chain
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.question import Answer
from disting.questions.positive.points import random_point

CASES = [
    (2, 1, 1, 2),
    (3, 0, 0, 2),
    (3, 1, 1, 2),
    (4, 2, 1, 4),
    (5, 2, 2, 4),
    (5, 0, 0, 3),
    (6, 1, 1, 3),
    (6, 5, 2, 6),
]
LARGE = [(7, 6, 6, 7), (7, 1, 1, 2), (8, 7, 1, 8), (8, 0, 0, 2)]


def count(n, g, a, b):
    """C(N-1, g) C(g-1, a-1) C(N-g-1, b-g-1); without a gap C(N-1, b-1)."""
    return comb(n - 1, g) * (comb(g - 1, a - 1) if g else 1) * comb(n - g - 1, b - g - 1)


@pytest.mark.parametrize(("n", "g", "a", "b"), CASES + LARGE)
def test_all_solutions_are_positive(n, g, a, b):
    other = Chain(n, g, a, b, a, b, damped=False)
    gap = Random(n * 100 + b).randrange(n)
    given = Chain(n, gap, min(gap, 1), gap + 1, min(gap, 1), gap + 1, damped=False)
    found = fibre(other, target(given.structure, random_point(given, f"foster{n}{g}{a}{b}")))
    assert found.status is Status.COMPLETE and len(found.solutions) == count(n, g, a, b)
    assert all(s.real is s.positive is Answer.YES for s in found.solutions)
