"""How sure a statement is."""

from enum import StrEnum


class Certainty(StrEnum):
    """THEOREM: holds by a stated theorem. PROVEN: exact computation. BOUNDED: but for a computed probability.

    NUMERICAL: all equations hold within small balls, which proves neither that they hold nor that they fail.
    """

    THEOREM = "theorem"
    PROVEN = "proven"
    BOUNDED = "bounded"
    NUMERICAL = "numerical"


Grade = tuple[Certainty, int]
"""Certainty and, if it is BOUNDED, the bits b of the error bound 2**-b."""


def graded(proven: bool, safety: int) -> Grade:
    """Certainty and error bits: none needed where the finding is proven."""
    return (Certainty.PROVEN, 0) if proven else (Certainty.BOUNDED, safety)
