"""Evidence: what made a condition decide, small enough to be stored with the verdict and to be checked again alone.

Each kind says itself in a sentence and in a formula, and turns into plain data and back. `verify.py` checks it anew.
"""

from dataclasses import asdict, dataclass
from itertools import groupby
from typing import ClassVar, get_args

from disting.conditions.ways import BothWays, OddFibres
from disting.conditions.witnesses import Witnesses
from disting.ideals import Refuted, Solved

Labels = tuple[str, ...]
TRANSCENDENTAL = "a factor exp(−Td s) with Td other than 0 is no rational function, so it cannot be made up for"


@dataclass(frozen=True, slots=True)
class Counts:
    """Conditions 1 and 2: degrees (numerator n, denominator m) of both transfer functions."""

    kind: ClassVar[str] = "counts"
    left: tuple[int, int]
    right: tuple[int, int]

    def sentence(self, left: str, right: str) -> str:
        """Both degrees in words."""
        a, b = (f"a numerator of degree {n} over a denominator of degree {m}" for n, m in (self.left, self.right))
        return f"{left} has {a}, {right} {b}."

    @property
    def formula(self) -> str:
        """N_MI = n + m + 1 on both sides."""
        (n1, m1), (n2, m2) = self.left, self.right
        return f"n + m + 1 = {n1} + {m1} + 1 = {n1 + m1 + 1},  {n2} + {m2} + 1 = {n2 + m2 + 1}"


@dataclass(frozen=True, slots=True)
class Forms:
    """Condition 3: the invariants that vary in one model only."""

    kind: ClassVar[str] = "forms"
    only_left: Labels
    only_right: Labels

    def sentence(self, left: str, right: str) -> str:
        """Which invariants vary on one side only."""
        sides = ((self.only_left, left, right), (self.only_right, right, left))
        parts = [_varies(labels, here, there) for labels, here, there in sides if labels]
        why = f": {TRANSCENDENTAL}" if "Td" in (*self.only_left, *self.only_right) else ""
        return _capital("; ".join(parts)) + why + "."

    @property
    def formula(self) -> str:
        """Labels that vary on one side only."""
        return f"free in one only: {spelled(self.only_left) or '–'} | {spelled(self.only_right) or '–'}"


@dataclass(frozen=True, slots=True)
class Ranks:
    """Conditions 4 and 5: a set of invariants whose Jacobian rows have different generic ranks."""

    kind: ClassVar[str] = "ranks"
    rows: Labels
    left: int
    right: int
    all_rows: bool

    def sentence(self, left: str, right: str) -> str:
        """Both ranks in words."""
        if self.all_rows:
            return f"{left} has {self.left} determinable parameters, {right} {self.right}."
        return f"In {left} the invariants {spelled(self.rows)} have rank {self.left}, in {right} rank {self.right}."

    @property
    def formula(self) -> str:
        """rank of the Jacobian's rows on both sides."""
        what = "Φ" if self.all_rows else spelled(self.rows)
        return f"rank ∂({what})/∂p = {self.left} ≠ {self.right}"


@dataclass(frozen=True, slots=True)
class Renaming:
    """Condition 6: pairs (left parameter, right parameter), and the symmetries that give the renaming, if any do."""

    kind: ClassVar[str] = "renaming"
    pairs: tuple[tuple[str, str], ...]
    symmetries: tuple[str, ...]

    def sentence(self, left: str, right: str) -> str:
        """The renaming, shortened to what moves."""
        moved = [f"{a} to {b}" for a, b in self.pairs if a != b]
        rename = f"after renaming {', '.join(moved)}" if moved else "without renaming any parameter"
        why = f" ({' and '.join(self.symmetries)})" if self.symmetries else ""
        return f"{left} has the transfer function of {right} {rename}{why}, over positive parameters too."

    @property
    def formula(self) -> str:
        """All pairs."""
        return ", ".join(f"{a} → {b}" for a, b in self.pairs)


@dataclass(frozen=True, slots=True)
class FreeChoice:
    """Condition 7: as many determinable parameters as non-constant invariants, on both sides."""

    kind: ClassVar[str] = "free-choice"
    rank: int
    free: Labels

    def sentence(self, left: str, right: str) -> str:
        """The two equal numbers in words."""
        return (
            f"Both have {self.rank} determinable parameters for {len(self.free)} non-constant invariants, "
            f"so each of {left} and {right} can give them any generic values."
        )

    @property
    def formula(self) -> str:
        """N_R equals the number of free invariants."""
        return f"N_R = {self.rank} = |{{{spelled(self.free)}}}|"


@dataclass(frozen=True, slots=True)
class Embedding:
    """Condition 8: the side that is the submodel, the numbering of its masses in the larger model, the common rank."""

    kind: ClassVar[str] = "embedding"
    left_is_submodel: bool
    numbering: tuple[tuple[int, int], ...]
    rank: int

    def sentence(self, left: str, right: str) -> str:
        """Which model is part of which."""
        part, whole = (left, right) if self.left_is_submodel else (right, left)
        return f"{part} is {whole} with some elements missing, and both have {self.rank} determinable parameters."

    @property
    def formula(self) -> str:
        """Masses of the submodel in the larger model."""
        return ", ".join(f"{a} → {b}" for a, b in self.numbering)


@dataclass(frozen=True, slots=True)
class Supermodel:
    """Condition 9: the parameters of the common supermodel and the rank that all three share."""

    kind: ClassVar[str] = "supermodel"
    parameters: Labels
    rank: int

    def sentence(self, left: str, right: str) -> str:
        """The third model in words."""
        third = ", ".join(self.parameters)
        return (
            f"{left} and {right} are submodels of the chain with {third}; all three have {self.rank} determinable parameters."
        )

    @property
    def formula(self) -> str:
        """The common rank."""
        return f"N_R = {self.rank} for all three"


@dataclass(frozen=True, slots=True)
class Theorem:
    """Exact decision: a theorem of that `name` says that both models are the same for all parameters."""

    kind: ClassVar[str] = "theorem"
    name: str

    def sentence(self, left: str, right: str) -> str:
        """What the theorem says of this pair."""
        return _THEOREMS[self.name].format(left=left, right=right) + ", over positive parameters too."

    @property
    def formula(self) -> str:
        """The theorem by name."""
        return f"{self.name} theorem"


@dataclass(frozen=True, slots=True)
class DeadTime:
    """Exact decision: one of the two has a dead time, so a factor that is no rational function (see `exact`)."""

    kind: ClassVar[str] = "dead time"
    left_given: bool

    def sentence(self, left: str, right: str) -> str:
        """Whose it is and what that means."""
        with_it, without = (left, right) if self.left_given else (right, left)
        return f"{with_it} has a dead time, {without} has none: {TRANSCENDENTAL}."

    @property
    def formula(self) -> str:
        """The factor."""
        return "exp(−Td s), Td ≠ 0, is not rational"


@dataclass(frozen=True, slots=True)
class FibreAt:
    """Exact decision: the fibre of one model over the transfer function of the other at a rational parameter point.

    Both models are in their canonical forms. `left_given`: the point (name, fraction) is of the left model and the right one
    was searched; `grounds`: "refuted" or "construction" (see `synthesis.decide`); so many of the `solutions` listed are real,
    so many positive.
    """

    kind: ClassVar[str] = "fibre"
    left_given: bool
    point: tuple[tuple[str, str], ...]
    grounds: str
    solutions: int
    real: int
    positive: int

    def sentence(self, left: str, right: str) -> str:
        """What the fibre shows."""
        given, searched = (left, right) if self.left_given else (right, left)
        if self.grounds == "refuted":
            return (
                f"For one choice of rational parameters of {given} no parameters of {searched}, real or complex, give the same "
                "transfer function: every branch of the inverse synthesis is refuted."
            )
        return (
            f"For one choice of rational parameters of {given}, parameters of {searched} with the same transfer function are "
            f"proven to exist: {self.solutions} solutions listed, {self.real} of them real, {self.positive} positive."
        )

    @property
    def formula(self) -> str:
        """The size of the fibre."""
        if self.grounds == "refuted":
            return "Φ₂⁻¹(Φ₁(p₀)) = ∅"
        return f"|Φ₂⁻¹(Φ₁(p₀))| ≥ {self.solutions}"


@dataclass(frozen=True, slots=True)
class ByProgram:
    """Exact decision: an external program found the fibre's equations contradictory, modulo one small prime."""

    kind: ClassVar[str] = "program"
    program: str
    left_given: bool
    label: str

    def sentence(self, left: str, right: str) -> str:
        """What was found, and why it proves nothing."""
        given, searched = (left, right) if self.left_given else (right, left)
        return (
            f"{self.program} finds no parameters of {searched} with the transfer function of {given} at one random point "
            "modulo one prime of 31 bits, too small for an error bound."
        )

    @property
    def formula(self) -> str:
        """The ideal is everything, modulo the prime."""
        return "1 ∈ ⟨Φ₂(q) − Φ₁(p₀)⟩ mod p"


ByConditions = Counts | Forms | Ranks | Renaming | FreeChoice | Embedding | Supermodel


Evidence = ByConditions | Theorem | DeadTime | FibreAt | Solved | Refuted | ByProgram | BothWays | OddFibres | Witnesses
_THEOREMS = {
    "symmetry": "{left} and {right} are one model after exchanging ports or mirroring a part",
    "duality": "{left} and {right} are dual: masses map to masses, springs and dampers are reversed and scaled",
    "Foster": "{left} and {right} are undamped, each with force and sensor at one place: both give any such resonances",
    "parts": "{left} and {right} are undamped and their parts at both sides of the gap can be exchanged one by one",
}
_KINDS: dict[str, type[Evidence]] = {c.kind: c for c in get_args(Evidence)}


def to_dict(evidence: Evidence) -> dict[str, object]:
    """Plain data, ready for JSON."""
    return evidence.to_dict() if isinstance(evidence, BothWays) else {"kind": evidence.kind, **asdict(evidence)}


def from_dict(data: dict[str, object]) -> Evidence:
    """Evidence from plain data; lists become tuples. Raises KeyError, TypeError or ValueError for what is none."""
    if data["kind"] == BothWays.kind:
        return BothWays.from_dict(data)
    fields = {name: _tupled(value) for name, value in data.items() if name != "kind"}
    return _KINDS[str(data["kind"])](**fields)  # type: ignore[arg-type]


def spelled(labels: Labels) -> str:
    """Labels with runs shortened.

    >>> spelled(("b0", "b1", "b2", "a1"))
    'b0–b2, a1'
    """
    numbered = [(label[0], int(label[1:]) if label[1:].isdigit() else -1) for label in labels]
    runs = [list(run) for _, run in groupby(enumerate(numbered), key=lambda x: (x[1][0], x[1][1] - x[0]))]
    ends = [(labels[run[0][0]], labels[run[-1][0]]) for run in runs]
    return ", ".join(a if a == b else f"{a}–{b}" for a, b in ends)


def _tupled(value: object) -> object:
    return tuple(map(_tupled, value)) if isinstance(value, list) else value


def _varies(labels: Labels, here: str, there: str) -> str:
    depends, are = ("depends", "is") if len(labels) == 1 else ("depend", "are")
    return f"{spelled(labels)} {depends} on the parameters in {here} but {are} constant in {there}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
