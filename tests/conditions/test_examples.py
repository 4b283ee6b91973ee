"""Section 4.2: whether a condition can tell two models apart depends on the representation.

z_1 = a_1 b_1 and z_2 = a_2 b_2 (1 + i), with the Jacobians (28) and (29) at a random point modulo
a prime; phases in turns, so that pi/4 is 1/8, and sqrt 2 = 2^31 modulo 2^61 - 1 (2^16 modulo 2^31
- 1).
"""

import pytest

from disting import Outcome
from disting.algebra.certainty import Size, residues
from disting.behaviour.profile import from_samples
from disting.conditions.necessary import (
    condition_1,
    condition_2,
    condition_3,
    condition_4,
    condition_5,
)
from disting.conditions.sufficient import condition_7
from disting.model.question import Settings
from tests.conditions.handmade import LARGE, SMALL, sample

LABELS = ("b0", "b1")
ROOT = {LARGE: 2**31, SMALL: 2**16}


def summary(rows_and_values, *, constants=()):
    """Profile of two moment invariants, each (value, derivative by a, derivative by b) at a, b,
    modulo p; constants by name.
    """
    samples = []
    for label, modulus in [("one", LARGE), ("two", LARGE), ("search", SMALL)]:
        entries = rows_and_values(*residues(label, 2, modulus), modulus)
        samples.append(
            sample([row for _, *row in entries], [value for value, *_ in entries], LABELS, modulus)
        )
    return from_samples(
        samples[:2], samples[2:], frozenset(constants), (1, 0), 0, 1, Size(2, 2), Settings()
    )


MAGNITUDE_PHASE = (
    summary(lambda a, b, p: [(a * b, b, a), (0, 0, 0)], constants=["b1"]),
    summary(
        lambda a, b, p: [(ROOT[p] * a * b, ROOT[p] * b, ROOT[p] * a), (pow(8, -1, p), 0, 0)],
        constants=["b1"],
    ),
)
REAL_IMAGINARY = (
    summary(lambda a, b, p: [(a * b, b, a), (0, 0, 0)]),
    summary(lambda a, b, p: [(a * b, b, a), (a * b, b, a)]),
)


@pytest.mark.parametrize("modulus", [LARGE, SMALL])
def test_the_root_of_two(modulus):
    assert ROOT[modulus] ** 2 % modulus == 2


def test_magnitude_and_phase_leave_the_pair_open():
    necessary = (condition_1, condition_2, condition_3, condition_4, condition_5)
    assert [c(*MAGNITUDE_PHASE).outcome for c in necessary] == [Outcome.HOLDS] * 5
    finding = condition_7(*MAGNITUDE_PHASE)
    assert (finding.outcome, finding.note) == (Outcome.FAILS, "the constant invariants differ")


def test_the_two_phases_are_the_constants():
    assert [p.constants for p in MAGNITUDE_PHASE] == [("", "0"), ("", "1/8")]
    assert [(p.rank, sorted(p.form)) for p in MAGNITUDE_PHASE] == [(1, ["b0"])] * 2


def test_with_equal_phases_condition_7_holds():
    assert condition_7(MAGNITUDE_PHASE[0], MAGNITUDE_PHASE[0]).outcome is Outcome.HOLDS


def test_real_and_imaginary_part_tell_them_apart():
    """(29): symbolic forms [1 0] and [1 1]."""
    assert [sorted(p.form) for p in REAL_IMAGINARY] == [["b0"], ["b0", "b1"]]
    assert [p.rank for p in REAL_IMAGINARY] == [1, 1]
    finding = condition_3(*REAL_IMAGINARY)
    assert finding.outcome is Outcome.FAILS
    assert (finding.evidence.only_left, finding.evidence.only_right) == ((), ("b1",))


def test_real_and_imaginary_part_have_other_sets_of_independent_rows():
    """Printed: condition 5 alone could tell them apart, too; after condition 3 it is not asked."""
    left, right = (p.matroid for p in REAL_IMAGINARY)
    assert (left.rank, [c.rows for c in left.components]) == (1, [(0,)])
    assert (right.rank, [c.rows for c in right.components]) == (1, [(0, 1)])
    assert condition_5(*REAL_IMAGINARY).outcome is Outcome.INAPPLICABLE
