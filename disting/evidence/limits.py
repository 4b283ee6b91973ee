"""Evidence on limits, each kind checked again alone: of models of one size, whole chains and what
a row can be, or cannot; and that a chain is, or is not, a limit of chains with more masses.
"""

from dataclasses import dataclass
from enum import StrEnum
from itertools import groupby
from typing import ClassVar, NamedTuple

from disting.evidence.kind import Claim, Inside, Kind, Labels, label_runs

_WORDS = {"∞": "without bound", "0": "zero"}


class RowLimit(NamedTuple):
    """A row (free or grounded) of the larger chain becomes one of the smaller chain, by `steps`
    and by a count.

    Step: an element and what it tends to, masses of the row renumbered after each. `room`: rank,
    coordinates, factors and 1 or 0 for the mass (see `decide.inclusion.limits`) of the last step;
    () if the steps lead to the row itself. Rows are canonical.
    """

    given: str
    wanted: str
    steps: tuple[tuple[str, str], ...]
    room: tuple[int, ...] = ()

    @property
    def sentence(self) -> str:
        """Sentence on the limit of the row, without names of models."""
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
        return ", ".join(limits + ([_describe_count(*self.room)] if self.room else [])) or "="


@dataclass(frozen=True, slots=True)
class Limit(Kind):
    """The smaller chain is a limit of the larger one, row by row; a row that is not named stops
    moving.

    `smaller`, `larger`: indices of the chains of this statement, the same as those given by a
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
        """Sentence on the limit of each row."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        path = "; ".join(part.sentence for part in self.parts)
        same = [
            f"{name} being the same as the chain {shape}"
            for name, shape in self._replace_chains(smaller, larger)
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

    def _replace_chains(self, smaller: str, larger: str) -> list[tuple[str, tuple[int, ...]]]:
        return [
            (name, shape)
            for name, shape in ((smaller, self.smaller), (larger, self.larger))
            if shape
        ]


@dataclass(frozen=True, slots=True)
class Meeting(Kind):
    """Dimensions of closures add up (see `decide.inclusion.limits`), so a common factor exists
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
        return _describe_count(self.rank, self.coordinates, self.factors, self.same_mass)


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
    `decide.inclusion.pole_sharing`).

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
        """Sentence on the contradiction."""
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
    each label, see `disting.evidence.ideals.Solutions`, where `small_given` means that the points
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


def _describe_count(rank: int, coordinates: int, factors: int, same_mass: int) -> str:
    mass = " + 1" if same_mass else ""
    return f"{rank} + {factors}{mass} ≥ {coordinates}"


class Why(StrEnum):
    """Result for one row; INSIDE, FULL and MOMENTUM support limits, the others exclude them."""

    INSIDE = "inside"
    FULL = "full"
    MOMENTUM = "momentum"
    COEFFICIENT = "coefficient"
    RESULTANT = "resultant"
    EQUATION = "equation"
    DIMENSION = "dimension"


SUPPORTS = frozenset({Why.INSIDE, Why.FULL, Why.MOMENTUM})


class RowLimits(NamedTuple):
    """Result for one row (`part`) in one `split` (see `disting.fibres.ideals.splits`; "whole" for a
    chain without a gap).

    `detail`: the coefficient's name, both dimensions, or the label from which primes and points of
    an equation are drawn.
    """

    split: str
    part: str
    why: Why
    detail: str = ""

    def sentence(self, searched: str) -> str:
        """The step in words."""
        row = searched if self.part == WHOLE else f"the {self.part} row of {searched}"
        return _TOLD[self.why].format(row=row, detail=self.detail) + _IN[self.split]


WHOLE = "whole"


@dataclass(frozen=True, slots=True)
class _Steps(Kind):
    left_given: bool
    steps: tuple[RowLimits, ...]

    def __post_init__(self) -> None:
        made = (RowLimits(split, part, Why(why), detail) for split, part, why, detail in self.steps)
        object.__setattr__(self, "steps", tuple(made))

    def _names(self, left: str, right: str) -> tuple[str, str]:
        return (left, right) if self.left_given else (right, left)


@dataclass(frozen=True, slots=True)
class Outside(_Steps):
    """In every split some row cannot be, even in a limit; `left_given`: the right model is the
    one that is searched.

    No steps: no set of poles is large enough for the searched grounded row.
    """

    kind: ClassVar[str] = "outside"
    claim: ClassVar[Claim] = Claim(inside=Inside.NO_LIMIT)

    def sentence(self, left: str, right: str) -> str:
        """Row by row."""
        source, searched = self._names(left, right)
        if not self.steps:
            return (
                f"The poles of each row of a generic {source} stay together in every limit of"
                f" models {searched}, and no choice of rows has as many poles as the grounded row"
                f" of {searched}."
            )
        steps = "; ".join(step.sentence(searched) for step in self.steps)
        return f"A generic {source} is no limit of models {searched}: {steps}."

    @property
    def formula(self) -> str:
        """Formula of the coefficient that does not vanish."""
        return (
            "; ".join(_FORMULAS[step.why].format(detail=step.detail) for step in self.steps)
            or "R₂ + F₂ ≠ R₁ + F₁"
        )


@dataclass(frozen=True, slots=True)
class RowsInside(_Steps):
    """In one split every row can be, at least in a limit, and sums of limits are limits."""

    kind: ClassVar[str] = "parts-inside"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    symbols: ClassVar[str] = "R₁ + F₁ = lim (R₂ + F₂)"

    def sentence(self, left: str, right: str) -> str:
        """Row by row."""
        source, searched = self._names(left, right)
        steps = "; ".join(step.sentence(searched) for step in self.steps)
        return f"Every {source} is a limit of models {searched}: {steps}."


_IN = {
    WHOLE: "",
    "same": ", with the same rows",
    "exchanged": ", with the rows exchanged except for a rigid body",
    "rigid": ", with a rigid body as the free row",
}
_TOLD = {
    Why.INSIDE: "{row} can be the very same",
    Why.FULL: "{row} can have any coefficients that it has at all",
    Why.MOMENTUM: "{row} can have any coefficients that keep the momentum (a₂ b₁ = a₃ b₀)",
    Why.COEFFICIENT: "coefficient {detail} is zero in {row} and would not be",
    Why.RESULTANT: (
        "the coefficients of {row} fulfil an equation, a resultant, that would not hold"
    ),
    Why.EQUATION: "a polynomial equation between the coefficients of {row} does not hold",
    Why.DIMENSION: (
        "{row} has no more determinable parameters than what it would have to be ({detail}), and is"
        " something else"
    ),
}
_FORMULAS = {
    Why.COEFFICIENT: "{detail} ≠ 0",
    Why.RESULTANT: "Res(U, V) ≠ 0",
    Why.EQUATION: "F(b, a) ≠ 0",
    Why.DIMENSION: "{detail}, V₁ ≠ V₂",
}


@dataclass(frozen=True, slots=True)
class LargerProjection(Kind):
    """The invariants `rows` have a larger rank in the model of the smaller rank; ranks in the
    pair's order.
    """

    kind: ClassVar[str] = "larger-projection"
    claim: ClassVar[Claim] = Claim(inside=Inside.NO_LIMIT)
    rows: Labels
    left: int
    right: int

    def sentence(self, left: str, right: str) -> str:
        """Both ranks in words."""
        runs = label_runs(self.rows)
        return f"The invariants {runs} have rank {self.left} in {left} and {self.right} in {right}."

    @property
    def formula(self) -> str:
        """The two ranks."""
        return f"rank ∂({label_runs(self.rows)})/∂p = {self.left}, {self.right}"


@dataclass(frozen=True, slots=True)
class MissingElements(Kind):
    """One model is what remains of the other one when elements tend to zero or grow without bound
    (see `disting.model.minors`), all experiments at the same masses.

    `numbering`: (in the part, in the whole), 0 being the ground: several masses of the whole at one
    of the part are one rigid body, those at 0 are at rest, those that are not named move alone.
    """

    kind: ClassVar[str] = "missing-elements"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    left_is_part: bool
    numbering: tuple[tuple[int, int], ...]

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the model that is part of the other."""
        part, whole = (left, right) if self.left_is_part else (right, left)
        bodies = [f"masses {' and '.join(map(str, body))} one rigid body" for body in self._bodies]
        stiff = [*bodies, *(f"mass {i} at rest" for i, at in self._nodes if i and not at)]
        how = ", ".join(["some elements missing", *stiff])
        bound = " or grow without bound" if stiff else ""
        return (
            f"{part} is {whole} with {how}, measured at the same masses: elements of {whole} that"
            f" go to zero{bound} give every response of {part}."
        )

    @property
    def formula(self) -> str:
        """Masses of the part in the whole."""
        return ", ".join(f"{a} → {b}" for a, b in self.numbering)

    @property
    def _nodes(self) -> list[tuple[int, int]]:
        """(mass of the whole, node of the part)."""
        return sorted((i, at) for at, i in self.numbering)

    @property
    def _bodies(self) -> list[list[int]]:
        """Masses of the whole that are one body, more than one each."""
        runs = groupby(self._nodes, key=lambda x: x[1])
        bodies = ([i for i, _ in run] for at, run in runs if at)
        return [body for body in bodies if len(body) > 1]


@dataclass(frozen=True, slots=True)
class Minor(Kind):
    """One network is what remains of the other one when elements tend to zero or grow without bound
    (see `disting.network.minors`).

    `places`: (node of the whole, node of the part), 0 being the ground: several nodes of the whole
    at one node of the part are one; none where one-ports are the same but for the order of branches
    in series. `missing` and `rigid`: values of the whole whose elements are not there, and of those
    in whose place nodes are connected directly. `exponents`: constant phase elements of the whole,
    by value, and the exponent that makes each one of the part.
    """

    kind: ClassVar[str] = "minor"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    left_is_part: bool
    places: tuple[tuple[int, int], ...]
    missing: tuple[str, ...]
    rigid: tuple[str, ...]
    exponents: tuple[tuple[str, str], ...] = ()

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the network that is part of the other."""
        part, whole = (left, right) if self.left_is_part else (right, left)
        how = [f"without {', '.join(self.missing)}"] if self.missing else []
        how += (
            [f"with a direct connection in place of {', '.join(self.rigid)}"] if self.rigid else []
        )
        how += [f"with the exponent {x} of {name}" for name, x in self.exponents]
        return (
            f"{whole} {' and '.join(how)} is {part}; as the elements come near to that, every"
            f" response of {part} is approached."
        )

    @property
    def formula(self) -> str:
        """Nodes of the whole in the part, or what tends to what."""
        limits = [f"{p} missing" for p in self.missing] + [f"{p} rigid" for p in self.rigid]
        return ", ".join([f"{a} → {b}" for a, b in self.places] or limits)


@dataclass(frozen=True, slots=True)
class FullImage(Kind):
    """The model of the larger rank has as many determinable parameters as non-constant
    invariants.
    """

    kind: ClassVar[str] = "full-image"
    claim: ClassVar[Claim] = Claim(inside=Inside.LIMIT)
    words: ClassVar[str] = (
        "{larger} gives its {0.rank} invariants any generic values, so those of {smaller} are"
        " limits of its own."
    )
    left_is_larger: bool
    rank: int
    free: Labels

    @property
    def formula(self) -> str:
        """N_R equals the number of free invariants."""
        return f"N_R = {self.rank} = |{{{label_runs(self.free)}}}|"


@dataclass(frozen=True, slots=True)
class RelativeDegrees(Kind):
    """Relative degrees of the receptances in s, in the pair's order, where no finite elements
    other than zero give the larger model that of the smaller one.
    """

    kind: ClassVar[str] = "relative-degrees"
    left_is_larger: bool
    left: int
    right: int

    def sentence(self, left: str, right: str) -> str:
        """Both relative degrees in words."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        degree, other_degree = (
            (self.left, self.right) if self.left_is_larger else (self.right, self.left)
        )
        if degree > other_degree:
            return (
                f"The receptance of {larger} falls at least as fast as s^-{degree} for all finite"
                f" elements other than zero, that of {smaller} as s^-{other_degree}."
            )
        return (
            f"The receptance of {larger} falls as s^-{degree} for all elements other than zero,"
            f" that of {smaller} at least as fast as s^-{other_degree}."
        )

    @property
    def formula(self) -> str:
        """The two relative degrees."""
        degree, other_degree = (
            (self.left, self.right) if self.left_is_larger else (self.right, self.left)
        )
        if degree > other_degree:
            return f"deg D₂ − deg N₂ ≥ {degree} > {other_degree} = deg D₁ − deg N₁"
        return f"deg D₂ − deg N₂ = {degree} < {other_degree} ≤ deg D₁ − deg N₁"
