"""How sure a statement is, and how surely a bounded one must be known to be made at all."""

from collections import Counter
from collections.abc import Iterable
from enum import StrEnum
from fractions import Fraction
from math import ceil, log2
from typing import Any

# bits: what is wrong with a larger probability than 2**-100, or could be, is not said
LEAST_SAFETY = 100
# bits of a bound that says nothing; 0 bits are those of a statement that needs no bound
USELESS = -1


class Certainty(StrEnum):
    """THEOREM: holds by a stated theorem. PROVEN: exact computation. BOUNDED: but for a computed
    probability.

    NUMERICAL: all equations hold within small balls, which proves neither that they hold nor that
    they fail.

    >>> from disting import compare
    >>> compare("3:1", "3:11").certainty is Certainty.THEOREM
    True
    """

    THEOREM = "theorem"
    PROVEN = "proven"
    BOUNDED = "bounded"
    NUMERICAL = "numerical"

    def in_words(self, safety: int = 0, theorem: str = "") -> str:
        """How sure a statement is, as it is said everywhere: to a reader of a sentence, a page, a
        notebook. `theorem` names the one that it holds by.

        >>> Certainty.THEOREM.in_words(theorem="duality theorem"), Certainty.PROVEN.in_words()
        ('proven (duality theorem)', 'proven')
        >>> Certainty.BOUNDED.in_words(132)
        'probability of error at most 2^-132'
        """
        match self:
            case Certainty.THEOREM:
                return f"proven ({theorem or 'theorem'})"
            case Certainty.PROVEN:
                return "proven"
            case Certainty.BOUNDED:
                return f"probability of error at most {bits_in_words(safety)}"
            case Certainty.NUMERICAL:
                return "found numerically, not proven"


def bits_in_words(safety: int) -> str:
    """Text of an error bound 2**-safety.

    >>> bits_in_words(132), bits_in_words(USELESS)
    ('2^-132', '1')
    """
    return f"2^-{safety}" if safety > 0 else "1"


Grade = tuple[Certainty, int]
"""Certainty and, if it is BOUNDED, the bits b of the error bound 2**-b."""


def graded(proven: bool, safety: int) -> Grade:
    """Certainty and error bits: none needed where the finding is proven."""
    return (Certainty.PROVEN, 0) if proven else (Certainty.BOUNDED, safety)


def shortfall(certainty: Certainty | None, safety: int) -> str:
    """Why a statement may not be made with this grade, "" if it may: asked wherever a finding is
    made.

    Raises ValueError for an error bound of what is not BOUNDED.

    >>> shortfall(Certainty.BOUNDED, 99)
    'its error bound would be 2^-99, and more than 2^-100 is not accepted'
    """
    if certainty is Certainty.BOUNDED:
        bound = bits_in_words(safety)
        return (
            ""
            if safety >= LEAST_SAFETY
            else f"its error bound would be {bound}, and more than 2^-100 is not accepted"
        )
    if safety:
        raise ValueError("only a bounded finding carries an error bound")
    return ""


def withhold(finding: Any, why: str, **unknown: object) -> None:
    """A finding whose grade is not enough says nothing: its fields become `unknown`, its evidence
    and its bits none, the field `why` what is lacking (`shortfall`).
    """
    lacking = shortfall(finding.certainty, finding.safety)
    if lacking:
        for name, value in {"safety": 0, "evidence": None, why: lacking, **unknown}.items():
            object.__setattr__(finding, name, value)


def joint_safety(safeties: Iterable[int]) -> int:
    """Largest b with sum 2^-s <= 2^-b: the probability that any of these statements is wrong is at
    most 2**-b.

    No independence is needed: it is the sum that bounds a union. 0 for no statement at all, and
    only then: nothing can be wrong. USELESS where the sum is more than 1/2, so that no bound is
    left.

    >>> joint_safety([120] * 1000), joint_safety([100, 140])
    (110, 99)
    >>> joint_safety([]), joint_safety([1, 100])
    (0, -1)
    """
    total = sum(
        (Fraction(1, 2) ** s * count for s, count in Counter(safeties).items()), Fraction(0)
    )
    if not total:
        return 0
    return int(1 / total).bit_length() - 1 if 2 * total <= 1 else USELESS


def weakest(*grades: Grade) -> Grade:
    """Grade of a statement that rests on all of these: error probabilities add up.

    >>> weakest((Certainty.THEOREM, 0), (Certainty.BOUNDED, 120), (Certainty.BOUNDED, 140))
    (<Certainty.BOUNDED: 'bounded'>, 119)
    """
    certainty = max((c for c, _ in grades), key=list(Certainty).index)  # the strongest comes first
    bits = [b for c, b in grades if c is Certainty.BOUNDED]
    return certainty, min(bits) - ceil(log2(len(bits))) if certainty is Certainty.BOUNDED else 0
