"""Evidence on admissible parameters: positive equivalents both ways, and odd numbers of equivalents."""

from dataclasses import dataclass
from math import ceil, log2
from typing import Any, ClassVar

from disting.certainty import Certainty, Grade
from disting.positivity import PositiveFinding
from disting.positivity.evidence import SameByTheorem

ORDER = tuple(Certainty)  # the strongest first


@dataclass(frozen=True, slots=True)
class BothWays:
    """Which positive models of the left chain have a positive equivalent in the right one, and the reverse.

    Both chains are in their canonical forms.
    """

    kind: ClassVar[str] = "both ways"
    left: PositiveFinding
    right: PositiveFinding

    def sentence(self, left: str, right: str) -> str:
        """Both ways in words; a theorem, which holds both ways, once."""
        here, there = self.left.sentence(left, right), self.right.sentence(right, left)
        same = isinstance(self.left.evidence, SameByTheorem) and self.left.evidence == self.right.evidence
        return here if same else f"{here} {there}"

    @property
    def formula(self) -> str:
        """Both formulas, from left to right and back, or one if they are the same."""
        here, there = (x.evidence.formula if x.evidence else "not known" for x in (self.left, self.right))
        return here if here == there else f"→ {here}; ← {there}"

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return {"kind": self.kind, "left": self.left.to_dict(), "right": self.right.to_dict()}

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "BothWays":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        return BothWays(*(PositiveFinding.from_dict(data[side]) for side in ("left", "right")))


@dataclass(frozen=True, slots=True)
class OddFibres:
    """Over real parameters: so many parameter vectors of either chain have one generic behaviour, all of them simple.

    Those of a real behaviour that are not real are pairs of conjugates, so of an odd number at least one is real.
    """

    kind: ClassVar[str] = "odd fibres"
    left: int
    right: int

    def sentence(self, left: str, right: str) -> str:
        """Both numbers and what they mean."""
        here, there = (_equivalents(n) for n in (self.right, self.left))
        return (
            f"Generic parameters of {left} have {here} in {right}, and those of {right} have {there} in {left}; solutions "
            "that are not real are pairs of conjugates, so of an odd number at least one is real."
        )

    @property
    def formula(self) -> str:
        """Both numbers."""
        return f"|Φ₁⁻¹(Φ₁(p))| = {self.left}, |Φ₂⁻¹(Φ₂(q))| = {self.right}"


def weakest(*grades: Grade) -> Grade:
    """Grade of a statement that rests on all of these: error probabilities add up.

    >>> weakest((Certainty.THEOREM, 0), (Certainty.BOUNDED, 120), (Certainty.BOUNDED, 140))
    (<Certainty.BOUNDED: 'bounded'>, 119)
    """
    certainty = max((c for c, _ in grades), key=ORDER.index)
    bits = [b for c, b in grades if c is Certainty.BOUNDED]
    return certainty, min(bits) - ceil(log2(len(bits))) if certainty is Certainty.BOUNDED else 0


def _equivalents(count: int) -> str:
    return "one equivalent" if count == 1 else f"{count} equivalents"
