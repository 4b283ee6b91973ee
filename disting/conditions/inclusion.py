"""Findings on one-sided inclusion: two statements on a pair, each with evidence of its own, and
their text form.

IMAGE: generic models of one chain have an equivalent in the other with elements that are neither
zero nor infinite. CLOSURE: they are limits of models of the other, whose elements may tend to zero
or grow without bound. IMAGE implies CLOSURE, and what is no limit has no equivalent.
"""

from dataclasses import dataclass
from enum import StrEnum

from disting.algebra.certainty import Certainty, withhold
from disting.evidence.kind import Inside
from disting.evidence.kinds import InclusionEvidence, inclusion_evidence_from


class Inclusion(StrEnum):
    """Whose generic models have equivalents on the other side, or are limits of models there.

    >>> from disting import compare
    >>> compare("2:1", "2:2").closure is Inclusion.RIGHT_IN_LEFT  # every 2:2 is a limit of 2:1
    True
    """

    EQUAL = "equal"
    LEFT_IN_RIGHT = "left-in-right"
    RIGHT_IN_LEFT = "right-in-left"
    NEITHER = "neither"
    UNKNOWN = "unknown"

    @property
    def turned(self) -> "Inclusion":
        """For the pair in the other order."""
        turned = {
            Inclusion.LEFT_IN_RIGHT: Inclusion.RIGHT_IN_LEFT,
            Inclusion.RIGHT_IN_LEFT: Inclusion.LEFT_IN_RIGHT,
        }
        return turned.get(self, self)


class Sense(StrEnum):
    """Kind of inclusion: equivalents with finite nonzero elements, or limits."""

    IMAGE = "image"
    CLOSURE = "closure"


ONE_SIDED = (Inclusion.LEFT_IN_RIGHT, Inclusion.RIGHT_IN_LEFT)


@dataclass(frozen=True, slots=True)
class InclusionFinding:
    """One statement with its evidence; `reason` tells why it is unknown.

    A bound that does not reach 2**-LEAST_SAFETY leaves it unknown.
    """

    inclusion: Inclusion
    certainty: Certainty | None = None
    safety: int = 0
    evidence: InclusionEvidence | None = None
    reason: str = ""

    def __post_init__(self) -> None:
        is_known = self.inclusion is not Inclusion.UNKNOWN
        if (self.evidence is not None, self.certainty is not None) != (is_known, is_known):
            raise ValueError("exactly a finding that is not unknown carries certainty and evidence")
        withhold(
            self,
            (self.certainty, self.safety),
            "reason",
            inclusion=Inclusion.UNKNOWN,
            certainty=None,
        )

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; use its inclusion")

    @property
    def is_known(self) -> bool:
        """True if something was found."""
        return self.inclusion is not Inclusion.UNKNOWN


@dataclass(frozen=True, slots=True)
class Inclusions:
    """Both statements on a pair of unequal rank; raises ValueError where evidence does not prove
    the statement.
    """

    image: InclusionFinding
    closure: InclusionFinding

    def __post_init__(self) -> None:
        image, closure = self.image, self.closure
        equivalents = ((Inside.EQUIVALENT,), (Inside.NO_EQUIVALENT, Inside.NO_LIMIT))
        limits = ((Inside.EQUIVALENT, Inside.LIMIT), (Inside.NO_LIMIT,))
        for finding, proofs in ((image, equivalents), (closure, limits)):
            proof = proofs[finding.inclusion is Inclusion.NEITHER]
            if finding.evidence is not None and finding.evidence.inside not in proof:
                raise ValueError(
                    f"evidence of kind {finding.evidence.kind} does not prove {finding.inclusion}"
                    " in this sense"
                )
        if image.inclusion in ONE_SIDED and closure.inclusion is not image.inclusion:
            raise ValueError("equivalents are limits")
        if closure.inclusion is Inclusion.NEITHER and image.inclusion is not Inclusion.NEITHER:
            raise ValueError("what is no limit has no equivalent")

    def __bool__(self) -> bool:
        raise TypeError("inclusions are not true or false; use image and closure")

    def sentence(self, left: str, right: str) -> str:
        """Both statements in words an engineer understands.

        >>> untried = InclusionFinding(Inclusion.UNKNOWN, reason="not tried")
        >>> Inclusions(untried, untried).sentence("A1", "A2")
        'Whether A1 and A2 are limits of one another is not known.'
        """
        inside = {Inclusion.LEFT_IN_RIGHT: (left, right), Inclusion.RIGHT_IN_LEFT: (right, left)}
        image, closure = self.image.inclusion, self.closure.inclusion
        if closure in inside:
            small, large = inside[closure]
            return f"Every generic {small} is {_AS_LIMIT[image].format(large=large)}."
        if closure is Inclusion.NEITHER:
            return (
                f"No generic {left} is a model {right} or a limit of such models, nor the reverse."
            )
        if image is Inclusion.NEITHER:
            return (
                f"No finite element values of {left} reproduce a generic {right}, nor the reverse;"
                f" {_LIMITS_NOT_KNOWN}."
            )
        return f"Whether {left} and {right} are limits of one another is not known."


_LIMITS_NOT_KNOWN = "whether limits do (elements going to zero or infinity) is not known"
_AS_LIMIT = {
    Inclusion.LEFT_IN_RIGHT: (
        "a model {large} with finite element values (complex ones allowed), not the reverse"
    ),
    Inclusion.RIGHT_IN_LEFT: (
        "a model {large} with finite element values (complex ones allowed), not the reverse"
    ),
    Inclusion.NEITHER: (
        "a limit of models {large} (elements going to zero or infinity), but has no finite element"
        " values there"
    ),
    Inclusion.UNKNOWN: (
        "a limit of models {large} (elements may go to zero or infinity), not the reverse; "
        "whether finite element values do is not known"
    ),
}


def inclusion_to_dict(finding: InclusionFinding) -> dict[str, object]:
    """Plain data, ready for JSON."""
    certainty = finding.certainty.value if finding.certainty else ""
    head = {"inclusion": finding.inclusion.value, "certainty": certainty, "safety": finding.safety}
    return head | {
        "evidence": finding.evidence.to_dict() if finding.evidence else {},
        "reason": finding.reason,
    }


def inclusion_from_dict(data: dict[str, object]) -> InclusionFinding:
    """Inverse of `inclusion_to_dict`; raises KeyError, TypeError or ValueError for what is none."""
    plain, certainty = data["evidence"], data["certainty"]
    evidence = inclusion_evidence_from(plain) if isinstance(plain, dict) and plain else None
    grade = Certainty(str(certainty)) if certainty else None
    return InclusionFinding(
        inclusion=Inclusion(str(data["inclusion"])),
        certainty=grade,
        safety=int(str(data["safety"])),
        evidence=evidence,
        reason=str(data["reason"]),
    )


def inclusions_to_dict(inclusions: Inclusions) -> dict[str, object]:
    """Plain data: `closure`, and `image` where it has another finding (what is no limit has no
    equivalent either).
    """
    same = (
        {}
        if inclusions.image == inclusions.closure
        else {Sense.IMAGE.value: inclusion_to_dict(inclusions.image)}
    )
    return {Sense.CLOSURE.value: inclusion_to_dict(inclusions.closure), **same}


def inclusions_from_dict(data: dict[str, object]) -> Inclusions:
    """Inverse of `inclusions_to_dict`; raises KeyError, TypeError or ValueError for what is
    none.
    """
    closure, image = (
        data[Sense.CLOSURE.value],
        data.get(Sense.IMAGE.value, data[Sense.CLOSURE.value]),
    )
    if not isinstance(closure, dict) or not isinstance(image, dict):
        raise TypeError("both statements are dictionaries")
    return Inclusions(inclusion_from_dict(image), inclusion_from_dict(closure))
