"""Equivalent models as a user gets them: values, signs, how well they agree, and whether these
are all.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from disting.experiments import Places
from disting.fibres.synthesis.result import Status
from disting.model.chain import Chain
from disting.model.drawing import text_drawing
from disting.model.shown import Shown, summary
from disting.schemas import Format


class Signs(StrEnum):
    """What a parameter vector looks like; the order is that of the lists."""

    POSITIVE = "positive"
    REAL = "real, some negative"
    COMPLEX = "complex"


class Origin(StrEnum):
    """Where a parameter vector comes from. All but SYNTHESIS are exact theorems, PROPORTIONAL
    applied to a synthesis.
    """

    GIVEN = "the given model"
    RENAMING = "renaming by symmetry"
    DUALITY = "duality theorem"
    PROPORTIONAL = "synthesis without dampers, for proportional damping"
    SYNTHESIS = "network synthesis"


@dataclass(frozen=True, slots=True)
class Equivalent:
    """A parameter vector of `chain` with the same transfer function.

    `values`: floats (complex where `signs` says so) by parameter name; `text`: the same with 15
    digits; `exact`: fractions where the values are known exactly, else empty. `residual`: the
    largest relative difference between a transfer-function coefficient of the values in `text` and
    the given one (an upper bound, in ball arithmetic, so rounding to 15 digits counts); `bound`:
    the same for the values before rounding, 0 where they are exact. `free_choices`: dimension of
    the family of which this is a member. `proven`: whether the signs are proven. A vector from the
    synthesis is known to agree within `bound`, no more: that it exists exactly is proven only
    where `exact` is given, that no other exists where the listing is complete.
    """

    chain: Chain
    values: dict[str, float | complex]
    text: dict[str, str]
    exact: dict[str, Fraction]
    signs: Signs
    origin: Origin
    residual: float
    bound: float
    free_choices: int = 0
    proven: bool = True

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:.4g}" for name, value in self.values.items())
        return summary(self, f"{self.signs}, {values}")

    def to_dict(self) -> dict[str, Any]:
        """For JSON: values as text, exact ones as fractions."""
        return {
            "values": self.text,
            "exact": {name: str(value) for name, value in self.exact.items()},
            "signs": self.signs.value,
            "signs_proven": self.proven,
            "origin": self.origin.value,
            "residual": self.residual,
            "bound": self.bound,
            "free_choices": self.free_choices,
        }


@dataclass(frozen=True, slots=True)
class Listing:
    """The equivalents in one structure; `complete`: there are no others. `sentence` says it in
    words. `places`: which of its masses is which of the given model, under experiments.
    """

    name: str
    chain: Chain
    status: Status
    members: tuple[Equivalent, ...]
    complete: bool
    sentence: str
    places: Places = ()

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "model": self.name,
            "drawing": text_drawing(self.chain),
            "status": self.status.value,
            "complete": self.complete,
            "sentence": self.sentence,
            "equivalents": [member.to_dict() for member in self.members],
            **({"places": {str(a): b for a, b in self.places}} if self.places else {}),
        }


@dataclass(frozen=True, slots=True)
class Equivalents(Shown):
    """The given model, its exact values, and a listing for each structure looked at.

    `proportional`: all of two or more springs have the same ratio k/d, which makes more structures
    equivalent than other dampers do. `experiments`: in words, those whose responses all are kept;
    none: the transfer function of the model as it is. Iterates over all parameter vectors,
    positive ones first.
    """

    name: str
    chain: Chain
    values: dict[str, Fraction]
    listings: tuple[Listing, ...]
    proportional: bool = False
    experiments: tuple[str, ...] = ()

    def __repr__(self) -> str:
        there = ", ".join(listing.name for listing in self.listings if listing.members)
        return summary(self, f"{len(self)} of {self.name}" + f" in {there}" * bool(there))

    def __iter__(self) -> Iterator[Equivalent]:
        members = [member for listing in self.listings for member in listing.members]
        return iter(sorted(members, key=lambda member: list(Signs).index(member.signs)))

    def __len__(self) -> int:
        return sum(len(listing.members) for listing in self.listings)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "format": Format.EQUIVALENTS.value,
            "model": self.name,
            "values": {name: str(value) for name, value in self.values.items()},
            "proportional_damping": self.proportional,
            **({"experiments": list(self.experiments)} if self.experiments else {}),
            "listings": [listing.to_dict() for listing in self.listings],
        }
