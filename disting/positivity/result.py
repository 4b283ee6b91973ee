"""Findings on positive equivalents: how many of the positive models of one chain have a positive equivalent in another."""

import json
from dataclasses import asdict, dataclass
from enum import StrEnum
from math import sqrt
from typing import Any

from disting.certainty import Certainty, shortfall
from disting.positivity.evidence import Evidence, from_dict, to_dict

Z95 = 1.96  # quantile of the normal distribution for 95 %


class Share(StrEnum):
    """Which generic positive models have a positive equivalent: all, some (and some have none), none; or that is not known."""

    ALWAYS = "always"
    SOMETIMES = "sometimes"
    NEVER = "never"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Empirical:
    """Of `tries` random models `hits` have an equivalent for certain; of `open` ones it is not known."""

    hits: int
    tries: int
    open: int = 0

    def __post_init__(self) -> None:
        if min(self.hits, self.open, self.tries - self.hits - self.open) < 0 or not self.tries:
            raise ValueError("hits and open points are at most as many as tries, of which there are some")

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval (1927) of the share for this distribution; open points count as misses below, as hits above.

        >>> tuple(round(x, 3) for x in Empirical(0, 10).interval)
        (0.0, 0.278)
        """
        return _wilson(self.hits, self.tries)[0], _wilson(self.hits + self.open, self.tries)[1]

    @property
    def sentence(self) -> str:
        """The share in words."""
        low, high = self.interval
        return f"{self.hits} of {self.tries} random points have one: empirically {low:.0%} to {high:.0%}"


@dataclass(frozen=True, slots=True)
class PositiveFinding:
    """`share` is proven as `certainty` says (BOUNDED: wrong with a probability of at most 2**-safety); `empirical` is sampled.

    `reason` says why nothing is known. A bound that does not reach 2**-LEAST_SAFETY leaves the share unknown.
    """

    share: Share
    certainty: Certainty | None = None
    safety: int = 0
    evidence: Evidence | None = None
    empirical: Empirical | None = None
    reason: str = ""

    def __post_init__(self) -> None:
        if (self.share is Share.UNKNOWN) == (self.evidence is not None and self.certainty is not None):
            raise ValueError("exactly a share that is not unknown carries certainty and evidence")
        lacking = shortfall(self.certainty, self.safety)
        if lacking:
            given_up = {"share": Share.UNKNOWN, "certainty": None, "safety": 0, "evidence": None, "reason": lacking}
            for name, value in given_up.items():
                object.__setattr__(self, name, value)

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its share")

    def sentence(self, given: str, other: str) -> str:
        """What is known and why; a sampled share is called empirical."""
        if self.evidence is None:
            return f"Which positive {given} have a positive equivalent in {other} is not known: {self.reason}."
        seen = f" {self.empirical.sentence}." if self.empirical and self.share is Share.SOMETIMES else ""
        return self.evidence.sentence(given, other) + seen

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; what is empty is left out."""
        plain: dict[str, object] = {"share": self.share.value}
        if self.evidence and self.certainty:
            plain |= {"certainty": self.certainty.value, "safety": self.safety, "evidence": to_dict(self.evidence)}
        if self.empirical:
            plain["empirical"] = asdict(self.empirical)
        return plain | ({"reason": self.reason} if self.reason else {})

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "PositiveFinding":
        """Inverse of `to_dict`; raises ValueError, KeyError or TypeError for what is none."""
        certainty = Certainty(data["certainty"]) if "certainty" in data else None
        evidence = from_dict(data["evidence"]) if "evidence" in data else None
        empirical = Empirical(**data["empirical"]) if "empirical" in data else None
        return PositiveFinding(
            Share(data["share"]), certainty, data.get("safety", 0), evidence, empirical, data.get("reason", "")
        )

    def to_json(self) -> str:
        """Compact JSON text."""
        return json.dumps(self.to_dict(), separators=(",", ":"), ensure_ascii=False)

    @staticmethod
    def from_json(text: str) -> "PositiveFinding":
        """Inverse of `to_json`; raises ValueError, KeyError or TypeError for what is none."""
        return PositiveFinding.from_dict(json.loads(text))


def _wilson(hits: int, tries: int) -> tuple[float, float]:
    p, z = hits / tries, Z95
    middle, spread = p + z * z / (2 * tries), z * sqrt(p * (1 - p) / tries + z * z / (4 * tries * tries))
    return max(0.0, (middle - spread) / (1 + z * z / tries)), min(1.0, (middle + spread) / (1 + z * z / tries))
