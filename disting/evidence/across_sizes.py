"""What shows that a chain is, or is not, a limit of chains with more masses: kinds of evidence,
each checked again alone.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from disting.evidence.kind import Claim, Inside, Kind

_WORDS = {"∞": "without bound", "0": "zero"}


class RowLimit(NamedTuple):
    """A row (free or grounded) of the larger chain becomes one of the smaller chain, by `steps`
    and by a count.

    Step: an element and what it tends to, masses of the row numbered anew after each. `room`:
    rank, coordinates, factors and 1 or 0 for the mass (see `questions.inclusion.limits`) of the
    last step; () if the steps lead to the row itself. Rows are canonical.
    """

    given: str
    wanted: str
    steps: tuple[tuple[str, str], ...]
    room: tuple[int, ...] = ()

    @property
    def sentence(self) -> str:
        """What happens to the row, without names of models."""
        path = ", then ".join(f"{element} {_WORDS[limit]}" for element, limit in self.steps)
        ways = [f"with {path}"] if path else []
        ways += ["by a count of dimensions"] if self.room else []
        becomes = (
            f"becomes the {self.wanted} one {' and '.join(ways)}"
            if ways
            else f"is the {self.wanted} one"
        )
        return f"the {self.given} row {becomes}"

    @property
    def formula(self) -> str:
        """The limits, and the numbers of the count."""
        limits = [f"{element} → {limit}" for element, limit in self.steps]
        return ", ".join(limits + ([_counted(*self.room)] if self.room else [])) or "="


@dataclass(frozen=True, slots=True)
class Limit(Kind):
    """The smaller chain is a limit of the larger one, row by row; a row that is not named comes to
    rest.

    `smaller`, `larger`: indices of the chains of which this is said, the same as those given by a
    theorem; () for themselves.
    """

    kind: ClassVar[str] = "limit"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    left_is_larger: bool
    parts: tuple[RowLimit, ...]
    smaller: tuple[int, ...] = ()
    larger: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "parts", tuple(RowLimit(*part) for part in self.parts))

    def sentence(self, left: str, right: str) -> str:
        """What becomes of each row."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        path = "; ".join(part.sentence for part in self.parts)
        same = [
            f"{name} being the same as the chain {shape}"
            for name, shape in self._replaced(smaller, larger)
        ]
        why = f" ({' and '.join(same)})" if same else ""
        how = "masses of a row numbered from 1 at each step"
        return (
            f"{smaller} is a limit of {larger} for all parameters of {smaller}{why}; {how}: {path}."
        )

    @property
    def formula(self) -> str:
        """The limits of each row."""
        return "; ".join(f"{part.given} ⇒ {part.wanted}: {part.formula}" for part in self.parts)

    def _replaced(self, smaller: str, larger: str) -> list[tuple[str, tuple[int, ...]]]:
        return [
            (name, shape)
            for name, shape in ((smaller, self.smaller), (larger, self.larger))
            if shape
        ]


@dataclass(frozen=True, slots=True)
class Meeting(Kind):
    """Dimensions of closures add up (see `questions.inclusion.limits`), so a common factor exists
    with which the smaller model is a limit.
    """

    kind: ClassVar[str] = "meeting"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    left_is_larger: bool
    rank: int
    coordinates: int
    factors: int
    same_mass: bool

    def sentence(self, left: str, right: str) -> str:
        """The count in words."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        mass = ", total masses being equal" if self.same_mass else ""
        return (
            f"{larger} has {self.rank} determinable parameters for {self.coordinates} coefficients"
            f" up to a factor, those of {smaller} may be multiplied by any polynomial of"
            f" {self.factors} coefficients: dimensions add up{mass}, so every {smaller} is a limit"
            f" of {larger}."
        )

    @property
    def formula(self) -> str:
        """The inequality."""
        return _counted(self.rank, self.coordinates, self.factors, self.same_mass)


@dataclass(frozen=True, slots=True)
class TooLarge(Kind):
    """Numbers of determinable parameters, in the pair's order: the chain with fewer masses has
    as many or more.
    """

    kind: ClassVar[str] = "too-large"
    claim: ClassVar[Claim] = Claim(inside=Inside.NO_LIMIT)
    words: ClassVar[str] = (
        "{left} has {0.left} determinable parameters, {right} {0.right}: limits with fewer poles"
        " have fewer than the models that they are limits of."
    )
    symbols: ClassVar[str] = "N_R = {0.left}, {0.right}"
    left: int
    right: int


@dataclass(frozen=True, slots=True)
class PoleSharing(Kind):
    """Smaller models whose poles cannot be distributed to the rows of the larger chain (see
    `questions.inclusion.pole_sharing`).

    `points`: their parameters in order, canonical form, each modulo the prime that belongs to the
    label and its place. One point needs no more; at several, equations of the grounded row were
    used too, found with an error bound.
    """

    kind: ClassVar[str] = "pole-sharing"
    claim: ClassVar[Claim] = Claim(inside=Inside.NO_LIMIT)
    symbols: ClassVar[str] = "v n = l₁ f₂ + l₂ f₁, d = e f₁ f₂  ⇒  v = 0"
    left_is_larger: bool
    label: str
    points: tuple[tuple[int, ...], ...]

    def sentence(self, left: str, right: str) -> str:
        """What is impossible."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        subject = "A model" if len(self.points) == 1 else f"Each of {len(self.points)} models"
        row = "" if len(self.points) == 1 else " that its grounded row can have"
        return (
            f"{subject} of {smaller} given in numbers is no limit of {larger}: no distribution of"
            f" the poles to its two rows gives the zeros{row}."
        )


@dataclass(frozen=True, slots=True)
class LimitFibre(Kind):
    """Generic smaller models are found, with an error bound, among what limits of the larger
    chain's rows lead to.

    `steps` of each row by name, the others being at rest; `solutions` at the prime and point of
    each label, see `disting.evidence.ideals.Solutions`, where `small_given` says that the points
    are of the smaller chain.
    """

    kind: ClassVar[str] = "limit-fibre"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    left_is_larger: bool
    steps: tuple[tuple[str, tuple[tuple[str, str], ...]], ...]
    small_given: bool
    labels: tuple[str, ...]
    solutions: tuple[tuple[int, ...], ...]

    def sentence(self, left: str, right: str) -> str:
        """The limits, and what was computed."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        source, searched = (smaller, "the limit") if self.small_given else ("the limit", smaller)
        rows = [
            f"{', then '.join(f'{e} {_WORDS[x]}' for e, x in path)} in the {name} row"
            for name, path in self.steps
            if path
        ]
        return (
            f"{smaller} is part of a limit of {larger} with"
            f" {' and '.join(rows) or 'a row at rest'}: for random parameters of {source} modulo"
            f" random primes, parameters of {searched} with the same transfer function were"
            " computed."
        )

    @property
    def formula(self) -> str:
        """The limits, and that the fibre has a point."""
        rows = [
            f"{name}: {', '.join(f'{e} → {x}' for e, x in path)}"
            for name, path in self.steps
            if path
        ]
        return "; ".join([*rows, "Φ₂(q₀) ≡ Φ₁(p₀)"])


AcrossSizes = Limit | Meeting | TooLarge | PoleSharing | LimitFibre


def _counted(rank: int, coordinates: int, factors: int, same_mass: int) -> str:
    mass = " + 1" if same_mass else ""
    return f"{rank} + {factors}{mass} ≥ {coordinates}"
