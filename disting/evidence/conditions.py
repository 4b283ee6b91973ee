"""Evidence of conditions 1 to 9: degrees, symbolic forms, ranks, a renaming, a numbering of
masses.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Self

from disting.evidence.kind import COMPLEX, Carrier, Claim, Inside, Kind, Labels, label_runs
from disting.model.question import Domain, Relation

if TYPE_CHECKING:
    from disting.evidence.kind import SampledPair

TRANSCENDENTAL = (
    "a factor exp(−Td s) with Td other than 0 is no rational function, so no other element can"
    " compensate for it"
)
_APART = Claim(Carrier.CONDITION, Relation.DISTINGUISHABLE)
_SAME = Claim(Carrier.CONDITION, Relation.INDISTINGUISHABLE, COMPLEX)


@dataclass(frozen=True, slots=True)
class Counts(Kind):
    """Conditions 1 and 2: degrees (numerator n, denominator m) of both transfer functions; of
    several experiments one pair after the other, (-1, 0) where nothing moves the sensor.
    """

    kind: ClassVar[str] = "counts"
    claim: ClassVar[Claim] = replace(_APART, inside=Inside.NO_LIMIT)
    left: tuple[int, ...]
    right: tuple[int, ...]

    def sentence(self, left: str, right: str) -> str:
        """The first degrees that differ, in words."""
        at, (a, b) = self._first_differing
        where = f"In experiment {at + 1} " if len(self.left) > 2 else ""
        return f"{where}{left} has {_degrees_in_words(a)}, {right} {_degrees_in_words(b)}."

    @property
    def formula(self) -> str:
        """N_MI = n + m + 1 on both sides."""
        (n1, m1), (n2, m2) = self.first
        return f"n + m + 1 = {n1} + {m1} + 1 = {n1 + m1 + 1},  {n2} + {m2} + 1 = {n2 + m2 + 1}"

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """Return True if these are their degrees."""
        degrees = pair.left.degrees, pair.right.degrees
        return degrees == (self.left, self.right) and self.left != self.right

    @property
    def first(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Degrees of both first transfer functions of which they differ."""
        return self._first_differing[1]

    @property
    def _first_differing(self) -> tuple[int, tuple[tuple[int, ...], tuple[int, ...]]]:
        """Number of the first transfer function, from 0, of which the degrees differ, and both."""
        sides = ([s[i : i + 2] for i in range(0, len(s), 2)] for s in (self.left, self.right))
        pairs = list(enumerate(zip(*sides, strict=True)))
        return next((pair for pair in pairs if pair[1][0] != pair[1][1]), pairs[0])


@dataclass(frozen=True, slots=True)
class Forms(Kind):
    """Condition 3: the invariants that vary in one model only."""

    kind: ClassVar[str] = "forms"
    claim: ClassVar[Claim] = _APART
    only_left: Labels
    only_right: Labels

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the invariants that vary on one side only."""
        sides = ((self.only_left, left, right), (self.only_right, right, left))
        parts = [_varies(labels, first, second) for labels, first, second in sides if labels]
        why = f": {TRANSCENDENTAL}" if "Td" in (*self.only_left, *self.only_right) else ""
        return capital("; ".join(parts)) + why + "."

    @property
    def formula(self) -> str:
        """Labels that vary on one side only."""
        return (
            f"free in one only: {label_runs(self.only_left) or '–'} |"
            f" {label_runs(self.only_right) or '–'}"
        )

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """Return True if they vary on one side only."""
        only = (*self.only_left, *self.only_right)
        n_left, n_right = (side.free(representation, only) for side in pair.sides)
        left, right = set(self.only_left), set(self.only_right)
        return bool(only) and left <= n_left - n_right and right <= n_right - n_left


@dataclass(frozen=True, slots=True)
class Ranks(Kind):
    """Conditions 4 and 5: a set of invariants whose Jacobian rows have different generic ranks."""

    kind: ClassVar[str] = "ranks"
    claim: ClassVar[Claim] = _APART
    rows: Labels
    left: int
    right: int
    all_rows: bool

    def sentence(self, left: str, right: str) -> str:
        """Both ranks in words."""
        if self.all_rows:
            return f"{left} has {self.left} determinable parameters, {right} {self.right}."
        return (
            f"In {left} the invariants {label_runs(self.rows)} have rank {self.left}, in {right}"
            f" rank {self.right}."
        )

    @property
    def formula(self) -> str:
        """rank of the Jacobian's rows on both sides."""
        what = "Φ" if self.all_rows else label_runs(self.rows)
        return f"rank ∂({what})/∂p = {self.left} ≠ {self.right}"

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """Recompute both ranks, of existing rows, of all if stated."""
        labels = [side.labels(representation, self.rows) for side in pair.sides]
        every, rows = set[str]().union(*labels), set(self.rows)
        known = rows in labels if self.all_rows else rows <= every
        needed = tuple(every) if self.all_rows else self.rows
        ranks = tuple(side.rank(representation, needed) for side in pair.sides)
        return known and ranks == (self.left, self.right) and self.left != self.right


@dataclass(frozen=True, slots=True)
class Renaming(Kind):
    """Condition 6: pairs (left parameter, right parameter), and the symmetries that give the
    renaming, if any do.
    """

    kind: ClassVar[str] = "renaming"
    claim: ClassVar[Claim] = Claim(
        Carrier.CONDITION | Carrier.ADMISSIBLE, Relation.INDISTINGUISHABLE
    )
    pairs: tuple[tuple[str, str], ...]
    symmetries: tuple[str, ...]

    def sentence(self, left: str, right: str) -> str:
        """The renaming, shortened to what moves."""
        moved = [f"{a} to {b}" for a, b in self.pairs if a != b]
        rename = f"after renaming {', '.join(moved)}" if moved else "without renaming any parameter"
        why = f" ({' and '.join(self.symmetries)})" if self.symmetries else ""
        return (
            f"{left} has the transfer function of {right} {rename}{why}, over positive parameters"
            " too."
        )

    @property
    def formula(self) -> str:
        """All pairs."""
        return ", ".join(f"{a} → {b}" for a, b in self.pairs)

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """Return True if the renaming names every parameter once on either side, turns one model
        into the other, and follows from any symmetries that are named.
        """
        named = [sorted(p for p, _ in self.pairs), sorted(q for _, q in self.pairs)]
        whole = named == [sorted(side.parameters) for side in pair.sides]
        renaming = dict(self.pairs)
        is_why = not self.symmetries or pair.by_symmetry() == (renaming, self.symmetries)
        return whole and is_why and pair.renames(renaming)

    def without_exception(self, domain: Domain) -> bool:
        """It carries all parameters over."""
        return True

    @property
    def turned(self) -> Self:
        """The renaming back."""
        return replace(self, pairs=tuple((b, a) for a, b in self.pairs))


@dataclass(frozen=True, slots=True)
class FreeChoice(Kind):
    """Condition 7: as many determinable parameters as non-constant invariants, on both sides."""

    kind: ClassVar[str] = "free-choice"
    claim: ClassVar[Claim] = _SAME
    rank: int
    free: Labels

    def sentence(self, left: str, right: str) -> str:
        """The two equal numbers in words."""
        return (
            f"Both have {self.rank} determinable parameters for {len(self.free)} non-constant"
            f" invariants, so each of {left} and {right} can give them any generic values, with"
            " complex parameters."
        )

    @property
    def formula(self) -> str:
        """N_R equals the number of free invariants."""
        return f"N_R = {self.rank} = |{{{label_runs(self.free)}}}|"

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """Return True if exactly these vary and have that rank."""
        return all(
            side.free(representation, self.free) == set(self.free)
            and side.rank(representation, self.free) == len(set(self.free)) == self.rank
            for side in pair.sides
        )


@dataclass(frozen=True, slots=True)
class Embedding(Kind):
    """Condition 8: the side that is the submodel, the numbering of its masses in the larger
    model, the common rank.
    """

    kind: ClassVar[str] = "embedding"
    claim: ClassVar[Claim] = _SAME
    left_is_submodel: bool
    numbering: tuple[tuple[int, int], ...]
    rank: int

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the model that is part of the other."""
        part, whole = (left, right) if self.left_is_submodel else (right, left)
        ranks = (
            f"both have {self.rank} determinable parameters, so their behaviours agree over complex"
            " parameters"
        )
        return f"{part} is {whole} with some elements missing, and {ranks}."

    @property
    def formula(self) -> str:
        """Masses of the submodel in the larger model."""
        return ", ".join(f"{a} → {b}" for a, b in self.numbering)

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """The numbering of the part's masses once more, and both ranks."""
        fits = dict(self.numbering) in list(pair.numberings(self.left_is_submodel))
        return fits and all(side.rank("tf") == self.rank for side in pair.sides)


@dataclass(frozen=True, slots=True)
class Supermodel(Kind):
    """Condition 9: the parameters of the common supermodel and the rank that all three share."""

    kind: ClassVar[str] = "supermodel"
    claim: ClassVar[Claim] = _SAME
    symbols: ClassVar[str] = "N_R = {0.rank} for all three"
    parameters: Labels
    rank: int

    def sentence(self, left: str, right: str) -> str:
        """The third model in words."""
        third = ", ".join(self.parameters)
        return (
            f"{left} and {right} are submodels of the chain with {third}; all three have"
            f" {self.rank} determinable parameters, so their behaviours agree over complex"
            " parameters."
        )

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """The third model once more, and all three ranks."""
        third = pair.united()
        if third is None or third.parameters != self.parameters:
            return False
        return all(side.rank("tf") == self.rank for side in (*pair.sides, third))


ByConditions = Counts | Forms | Ranks | Renaming | FreeChoice | Embedding | Supermodel


def _degrees_in_words(degrees: tuple[int, ...]) -> str:
    n, m = degrees
    if n < 0:
        return "a sensor that does not move"
    return f"a numerator of degree {n} over a denominator of degree {m}"


def _varies(labels: Labels, first: str, second: str) -> str:
    depends, are = ("depends", "is") if len(labels) == 1 else ("depend", "are")
    runs = label_runs(labels)
    return f"{runs} {depends} on the parameters in {first} but {are} constant in {second}"


def capital(text: str) -> str:
    """With a capital letter at its beginning."""
    return text[:1].upper() + text[1:]
