"""Equivalent models as a user gets them: values, signs, how well they agree, and whether these
are all.

A list that is not complete gives the reason and a remedy.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from flint import fmpq

from disting.experiments.places import Places
from disting.fibres.synthesis.task import Fibre, Status, target
from disting.files import Format
from disting.model.chain import Chain, text_drawing
from disting.model.presentation import NotebookTable, summary


class Signs(StrEnum):
    """Signs of a parameter vector; the order is that of the lists."""

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

    `values`: floats (complex where `signs` requires it) by parameter name; `text`: the same with 15
    digits; `exact`: fractions where the values are known exactly, else empty. `residual`: the
    largest relative difference between a transfer-function coefficient of the values in `text` and
    the given one (an upper bound, in ball arithmetic, so rounding to 15 digits counts); `bound`:
    the same for the values before rounding, 0 where they are exact. `free_choices`: dimension of
    the family of which this is a member. `proven`: whether the signs are proven. A vector from the
    synthesis is known to agree within `bound`, no more: that it exists exactly is proven only where
    `exact` is given, that no other exists where the listing is complete.
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
    """The equivalents in one structure; `complete`: there are no others. `sentence` gives it in
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
class Equivalents(NotebookTable):
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
        sizes = ", ".join(listing.name for listing in self.listings if listing.members)
        return summary(self, f"{len(self)} of {self.name}" + (f" in {sizes}" if sizes else ""))

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


NONE = "none exists, with positive parameters or any others: proven"


def sentence(fibre: Fibre, count: int, cause: str) -> str:
    """The status in words; `count` parameter vectors are listed, `cause` as from `special`."""
    if fibre.status is Status.EMPTY:
        return f"{NONE} ({fibre.reason})"
    if fibre.status is Status.COMPLETE:
        return (
            "all there are"
            if not fibre.tests.boundary
            else "all there are, except any with an element near zero"
        )
    if fibre.status is Status.INFINITE:
        return "infinitely many: one member of each family is listed, others may have other signs"
    listed = "the list may be incomplete" if count else "nothing is known"
    if fibre.status is Status.NOT_COVERED:
        return f"{listed}: {fibre.reason}"
    if fibre.tests.boundary:
        return (
            f"{listed}, since an element cannot be distinguished from zero: a structure without"
            " it may suffice"
        )
    return f"special values: {listed}, since {cause}; change a value slightly"


def under_all(fibre: Fibre, count: int, is_complete: bool) -> str:
    """Sentence on the members of a list that keep the responses of all experiments."""
    if fibre.status is Status.EMPTY:
        return f"{NONE} ({fibre.reason})"
    if is_complete:
        of = len(fibre.solutions)
        return "all there are" if count else f"none: all {of} that fit one of them miss another one"
    if fibre.status is Status.INFINITE:
        return (
            "infinitely many fit each experiment alone; not all of them were checked against"
            " the others"
        )
    listed = "the list may be incomplete" if count else "nothing is known"
    return f"{listed}: no experiment alone gives a complete list"


def among(chains: Sequence[Chain]) -> str:
    """Searched structures in words: their number, size and kind.

    >>> among([Chain(2, dead_time=True), Chain(2, 1, 1, 2, 1, 2, dead_time=True)])
    'the 2 structures of 2 masses, damped, with a dead time, searched'
    """
    first = chains[0]
    count = "the structure" if len(chains) == 1 else f"the {len(chains)} structures"
    kind = ["damped" if first.damped else "undamped"]
    kind += ["with a lag"] if first.lag else []
    kind += ["with a dead time"] if first.dead_time else []
    dampers = {c.ground_dampers for c in chains}
    kind += ["with dampers to the ground"] if dampers != {()} else []
    sizes = " or ".join(map(str, sorted({c.n_masses for c in chains})))
    return f"{count} of {sizes} mass{'es' if sizes != '1' else ''}, {', '.join(kind)}, searched"


def obstacle(chain: Chain, other: Chain) -> str:
    """Why the synthesis does not apply to this pair, or nothing."""
    if other.n_masses > chain.n_masses:
        return "a structure with more masses would need poles that cancel, which is not covered"
    if (other.damped or other.ground_dampers) and not chain.damped and not chain.ground_dampers:
        return "a structure with dampers for a model without any is not covered"
    if other.lag and not chain.lag:
        return "a structure with a lag would need a pole that cancels, which is not covered"
    return ""


def special(chain: Chain, point: Mapping[str, fmpq]) -> str:
    """Sentence on the special values of a model whose poles or zeros coincide."""
    if target(chain.structure, point).denominator.degree() < 2 * chain.n_masses + chain.lag:
        return "a vibration mode does not appear in the response (poles and zeros cancel)"
    equal = _equal_ratios(chain, point)
    return (
        f"springs have the same ratio k/d ({equal})"
        if equal
        else "poles, zeros or elements coincide"
    )


def _equal_ratios(chain: Chain, point: Mapping[str, fmpq]) -> str:
    """Springs of one ratio each, such as k12/d12 = k23/d23."""
    groups: dict[Any, list[str]] = {}
    for name in chain.parameters:
        if name[0] == "k" and f"d{name[1:]}" in point:
            groups.setdefault(point[name] / point[f"d{name[1:]}"], []).append(f"{name}/d{name[1:]}")
    return ", ".join(" = ".join(names) for names in groups.values() if len(names) > 1)
