"""Evidence on networks that stand for others: those of which the findings of a pair come."""

from dataclasses import dataclass
from typing import ClassVar

from disting.errors import enumeration
from disting.evidence.decision import Theorem
from disting.evidence.general import Constants, Explicit, Inequality, NoEquivalent, Witnesses
from disting.evidence.kind import Carrier, Claim, Kind, Labels
from disting.model.question import Domain, Relation


class OfSubstitutes(Kind):
    """Evidence on other networks, and what it shows of these."""

    __slots__ = ()
    inner: "OfNetworks"

    @property
    def title(self) -> str:
        """What the inner one is called."""
        return self.inner.title

    @property
    def formula(self) -> str:
        """That of the inner one."""
        return self.inner.formula


@dataclass(frozen=True, slots=True)
class Replacement(OfSubstitutes):
    """What is true of two networks that give the same transfer functions as these for all positive
    values, special ones aside: `left` and `right` are those networks, the simplest ones or others
    as texts have them, `inner` is the evidence on them. One that is `larger` may give more: that
    shows only that there are no equivalents.
    """

    kind: ClassVar[str] = "replaced"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left: str
    right: str
    left_larger: bool
    right_larger: bool
    inner: "OfNetworks"

    def shows(self, domain: Domain) -> Relation:
        """What the inner one shows, of positive values: those theorems speak of no others."""
        relation = self.inner.shows(domain) if domain is Domain.POSITIVE else Relation.UNDECIDED
        larger = self.left_larger or self.right_larger
        return (
            Relation.UNDECIDED if larger and relation is not Relation.DISTINGUISHABLE else relation
        )

    def sentence(self, left: str, right: str) -> str:
        """Which networks stand for these, and what is known of them."""
        said = ["all that", "the same as"]
        return (
            f"Special values aside, A = [{self.left}] gives {said[not self.left_larger]} {left}"
            f"{' gives' * self.left_larger}, B = [{self.right}] {said[not self.right_larger]}"
            f" {right}{' gives' * self.right_larger}. {self.inner.sentence('A', 'B')}"
        )


@dataclass(frozen=True, slots=True)
class AtInverse(OfSubstitutes):
    """What is true of two networks at 1/s: `left` and `right` are those, `inner` is the evidence on
    them.
    """

    kind: ClassVar[str] = "at-inverse"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left: str
    right: str
    inner: "OfNetworks"

    def shows(self, domain: Domain) -> Relation:
        """What the inner one shows, of positive values."""
        return self.inner.shows(domain) if domain is Domain.POSITIVE else Relation.UNDECIDED

    def sentence(self, left: str, right: str) -> str:
        """Which networks stand for these, and what is known of them."""
        return (
            f"With 1/s for s (springs and inerters, inductors and capacitors exchanged) {left} is"
            f" C = [{self.left}], {right} is D = [{self.right}]. {self.inner.sentence('C', 'D')}"
        )


@dataclass(frozen=True, slots=True)
class OfPart(OfSubstitutes):
    """What is true for some values of a network without the `missing` elements, the left one or
    the right one, and of the other network, is so of the whole one: where it is nearly that part.
    Both give as many independent coefficients as there are.
    """

    kind: ClassVar[str] = "of-part"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left_is_part: bool
    missing: Labels
    inner: "OfNetworks"

    def shows(self, domain: Domain) -> Relation:
        """SOMETIMES where the inner one shows that, by a point of the part without an equivalent:
        the whole may give what the part does not.
        """
        is_sometimes = domain is Domain.POSITIVE and self.inner.shows(domain) is Relation.SOMETIMES
        witnesses = witnesses_in(self.inner)
        is_of_part = witnesses is not None and witnesses.without_left_given is self.left_is_part
        return Relation.SOMETIMES if is_sometimes and is_of_part else Relation.UNDECIDED

    def sentence(self, left: str, right: str) -> str:
        """What is left out, and what is known of the rest."""
        whole, names = (left, ("E", right)) if self.left_is_part else (right, (left, "E"))
        return (
            f"E is {whole} without {enumeration(self.missing)}, which gives an open set of"
            f" functions: {whole} gives those around them, with small values of these elements."
            f" {self.inner.sentence(*names)}"
        )


def witnesses_in(evidence: "OfNetworks") -> Witnesses | None:
    """The points that evidence rests on, of whatever networks, if it does."""
    while isinstance(evidence, OfSubstitutes):
        evidence = evidence.inner
    return evidence if isinstance(evidence, Witnesses) else None


OfNetworks = (
    Explicit | NoEquivalent | Inequality | Witnesses | Theorem | Replacement | AtInverse | OfPart
)
OfGeneralModels = (
    Witnesses | Explicit | NoEquivalent | Inequality | Constants | Replacement | AtInverse | OfPart
)
