"""Evidence of the exact decision: a theorem, a dead time, a fibre."""

from dataclasses import dataclass
from typing import ClassVar

from disting.evidence.conditions import TRANSCENDENTAL
from disting.evidence.kind import Carrier, Claim, Inside, Kind
from disting.model.question import Domain, Relation

THEOREMS = {
    "Foster and Cauer": (
        "{left} and {right} are driving-point functions of the same order with two kinds of"
        " elements (or with parts like them): by Foster's and Cauer's theorems each realises all"
        " such functions with positive elements"
    ),
    "symmetry": (
        "{left} and {right} become the same model when ports are exchanged or a row is mirrored"
    ),
    "duality": (
        "{left} and {right} are dual: each parameter set of one has an equivalent set of the"
        " other, which is positive if the first is (disting equivalents --formulas prints it);"
        " masses are computed from masses, springs and dampers are reversed and scaled"
    ),
    "Foster": (
        "{left} and {right} are undamped with force and sensor at one place: by Foster's theorem"
        " each can have any alternating resonances and antiresonances"
    ),
    "Cauer": (
        "{left} and {right} are undamped with force and sensor at an end of their only long row: by"
        " Cauer's continued fraction each can have any alternating resonances and antiresonances,"
        " with one set of positive values"
    ),
    "replacement": (
        "{left} and {right} are the same except for parts that can replace each other (two-terminal"
        " parts of two kinds of elements, trees that hang at a compartment, outflows)"
    ),
    "gears": (
        "{left} and {right} are the same except for gears: a gear changes only the units behind it"
    ),
    "interlacing": (
        "{left} and {right} are undamped machines with the same number of masses: each can have any"
        " resonances (the lowest is 0 if they are free), and any antiresonances that lie each"
        " between two neighbouring resonances"
    ),
    "springs to the ground": (
        "{left} and {right} are undamped, with force and sensor each at one mass, and become the"
        " same when springs to the ground are moved: their places make no difference"
    ),
    "parts": (
        "{left} and {right} are undamped, and their rows on both sides of the gap can replace each"
        " other one by one"
    ),
}
WEAKER = {"Cauer": "Foster"}
"""Weaker statement that also holds where a theorem applies: files may rest on it."""
RATIONAL = ("symmetry", "duality", "gears")
"""Theorems whose maps are rational, so that they take real parameters to real ones."""

GEARS = "gears"
"""That of `disting.network.gears`."""
GROUNDS = "springs to the ground"
"""That of `disting.network.grounds`."""
INTERLACING = "interlacing"
ONE_PORTS = "Foster and Cauer"
REPLACEMENT = "replacement"
"""The theorem on networks of `disting.network.normal_form`."""

TITLES = {
    "Foster and Cauer": "Foster's and Cauer's theorems",
    "symmetry": "symmetry",
    "duality": "duality theorem",
    "Foster": "Foster's theorem",
    "Cauer": "Cauer's continued fraction",
    "replacement": "replacement of parts",
    "gears": "gears as units",
    "interlacing": "antiresonances between resonances",
    "parts": "reversal of undamped rows",
    "springs to the ground": "places of springs to the ground",
}


@dataclass(frozen=True, slots=True)
class Theorem(Kind):
    """A theorem of that `name` gives each model an equivalent in the other, with positive
    parameters if its own are.
    """

    kind: ClassVar[str] = "theorem"
    claim: ClassVar[Claim] = Claim(~Carrier.NOBODY, grounds="a theorem")
    symbols: ClassVar[str] = "{0.name} theorem"
    name: str

    def __post_init__(self) -> None:
        # from a damaged file: said here, and not when it is to be told
        if self.name not in THEOREMS:
            raise ValueError(f"no theorem is called {self.name!r}")

    @property
    def title(self) -> str:
        """Name of the theorem."""
        return TITLES[self.name]

    def sentence(self, left: str, right: str) -> str:
        """Statement of the theorem for this pair."""
        return THEOREMS[self.name].format(left=left, right=right) + "."

    def shows(self, domain: Domain) -> Relation:
        """For positive models of chains the direction of the equivalence is stored (`BothWays`)."""
        holds_over = {
            Domain.COMPLEX: True,
            Domain.REAL: self.name in RATIONAL,
            Domain.POSITIVE: self.name
            in ("Foster and Cauer", GEARS, GROUNDS, INTERLACING, REPLACEMENT),
        }
        return Relation.INDISTINGUISHABLE if holds_over[domain] else Relation.UNDECIDED

    def without_exception(self, domain: Domain) -> bool:
        """Symmetries of a chain carry all parameters over, and so do units. So does duality where
        they are positive: its formulas divide by sums of masses alone. Foster's theorem speaks
        of generic ones: of a chain with the force on its middle mass and both sides alike a pole is
        cancelled. A chain with the force at its end has always all of them ("Cauer").
        """
        everywhere = self.name in ("symmetry", GEARS)
        return everywhere or (self.name in ("duality", "Cauer") and domain is Domain.POSITIVE)


@dataclass(frozen=True, slots=True)
class DeadTime(Kind):
    """Exact decision: one of the two has a dead time, so a factor that is no rational function
    (see `decide.same.exact`).
    """

    kind: ClassVar[str] = "dead time"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, Relation.DISTINGUISHABLE, grounds="dead time")
    theorem: ClassVar[str] = "dead time"
    symbols: ClassVar[str] = "exp(−Td s), Td ≠ 0, is not rational"
    left_given: bool

    def sentence(self, left: str, right: str) -> str:
        """Whose it is and what that means."""
        with_it, without = (left, right) if self.left_given else (right, left)
        return f"{with_it} has a dead time, {without} has none: {TRANSCENDENTAL}."


@dataclass(frozen=True, slots=True)
class FibreUnder(Kind):
    """Exact decision under several experiments: at a rational point of one model all parameters
    of the other one that fit experiment `listed`, and for each an experiment that it misses.

    `left_given`: the point (name, fraction) is of the left model and the right one was searched;
    experiments are counted from 1.
    """

    kind: ClassVar[str] = "fibre under experiments"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, Relation.DISTINGUISHABLE, grounds="one fibre")
    symbols: ClassVar[str] = "q ∈ Φ₂,{0.listed}⁻¹(Φ₁,{0.listed}(p₀)) ⇒ Φ₂(q) ≠ Φ₁(p₀)"
    left_given: bool
    point: tuple[tuple[str, str], ...]
    listed: int
    missed: tuple[int, ...]

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the number of listed models and on their refutation."""
        source, searched = (left, right) if self.left_given else (right, left)
        start = f"For one choice of rational parameters of {source}, {searched} has "
        if not self.missed:
            return f"{start}no parameters, real or complex, that fit experiment {self.listed}."
        count = len(self.missed)
        fit = "1 parameter vector" if count == 1 else f"{count} parameter vectors"
        where = " or ".join(map(str, sorted(set(self.missed))))
        each = "it gives" if count == 1 else "each gives"
        return (
            f"{start}{fit}, complex ones included, with the same transfer function in experiment"
            f" {self.listed}, and {each} another one in experiment {where}."
        )


@dataclass(frozen=True, slots=True)
class FibreAt(Kind):
    """Exact decision: the fibre of one model over the transfer function of the other at a rational
    parameter point.

    Both models are in their canonical forms. `left_given`: the point (name, fraction) is of the
    left model and the right one was searched; `grounds`: "refuted" or "construction" (see
    `synthesis.decide`); and the numbers of real and of positive ones among the listed `solutions`.
    """

    kind: ClassVar[str] = "fibre"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, grounds="one fibre")
    left_given: bool
    point: tuple[tuple[str, str], ...]
    grounds: str
    solutions: int
    real: int
    positive: int

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the computed fibre."""
        source, searched = (left, right) if self.left_given else (right, left)
        if self.grounds == "refuted":
            return (
                f"For one choice of rational parameters of {source} no parameters of {searched},"
                " real or complex, give the same transfer function: every branch of the inverse"
                " synthesis is refuted."
            )
        return (
            f"For one choice of rational parameters of {source}, parameters of {searched} with the"
            f" same transfer function are proven to exist: {self.solutions} solutions listed,"
            f" {self.real} of them real, {self.positive} positive."
        )

    @property
    def formula(self) -> str:
        """The size of the fibre."""
        if self.grounds == "refuted":
            return "Φ₂⁻¹(Φ₁(p₀)) = ∅"
        return f"|Φ₂⁻¹(Φ₁(p₀))| ≥ {self.solutions}"

    def shows(self, domain: Domain) -> Relation:
        """Nothing of real and positive parameters where there are solutions."""
        if self.grounds == "refuted":
            return Relation.DISTINGUISHABLE
        return Relation.INDISTINGUISHABLE if domain is Domain.COMPLEX else Relation.UNDECIDED

    @property
    def inside(self) -> Inside:
        """Solutions have elements that are neither zero nor infinite."""
        return Inside.EQUIVALENT if self.solutions > 0 else Inside.NO_EQUIVALENT


_OBSTACLES = {
    "decay": (
        "the transfer functions of {0} and {1} fall off at different rates for high frequencies"
    ),
    "residues": (
        "{0} has negative residues in the row where force and sensor are apart, {1} has only"
        " positive ones"
    ),
    "own poles": (
        "the grounded and the free row of {1} would have to be those of {0}, which are of another"
        " kind"
    ),
    "signs": (
        "in the order of the poles the residues of a row of {0} change their signs more often than"
        " those of {1} can"
    ),
    "swapped parts": (
        "the rows of {1} would be those of {0}, equal or exchanged, which decay or positive masses"
        " rule out"
    ),
}


@dataclass(frozen=True, slots=True)
class Exclusion(Kind):
    """NEVER: the statement of that `name`, see `positivity.obstacles`; at the rational `point`, if
    one is needed, balls are used.
    """

    kind: ClassVar[str] = "excluded"
    symbols: ClassVar[str] = "{0.name} exclude positive equivalents"
    name: str
    point: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        # from a damaged file: said here, and not when it is to be told
        if self.name not in _OBSTACLES:
            raise ValueError(f"nothing that excludes equivalents is called {self.name!r}")

    def sentence(self, source: str, other: str) -> str:
        """Sentence on the obstruction to equivalents."""
        why = _OBSTACLES[self.name].format(source, other)
        return (
            f"No generic positive parameters of {source} have a positive equivalent in {other}:"
            f" {why}."
        )

    @property
    def title(self) -> str:
        """The statement by name."""
        return self.name
