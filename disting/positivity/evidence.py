"""Evidence on positive equivalents, small enough to be stored and to be checked again alone (see `verify`).

`given` is the model whose positive parameters are asked about, `other` the one in which equivalents are looked for.
"""

from collections.abc import Container
from dataclasses import asdict, dataclass
from typing import Any, ClassVar, get_args

Values = tuple[tuple[str, str], ...]  # parameter name, fraction
Labels = tuple[str, ...]

_THEOREMS = {
    "symmetry": "{0} and {1} are one model after exchanging ports or mirroring a part",
    "duality": "{0} and {1} are dual: masses map to masses, springs and dampers are reversed and scaled",
    "Foster": "{0} and {1} are undamped with force and sensor at one place: both give any such resonances (Foster's theorem)",
}
_OBSTACLES = {
    "decay": "the transfer functions of {0} and {1} fall off at different rates for high frequencies",
    "residues": "{0} has negative residues in the part where force and sensor are apart, {1} has positive ones alone",
    "own poles": "the grounded and the free part of {1} would have to be those of {0}, which are of another kind",
    "signs": "in the order of the poles the residues of a part of {0} change their signs more often than those of {1} can",
    "swapped parts": "the parts of {1} would be those of {0}, equal or exchanged, which decay or positive masses rule out",
}


def _known(name: str, among: Container[str]) -> None:
    """Raise ValueError for a name from a damaged file, here and not when it is to be told."""
    if name not in among:
        raise ValueError(f"no evidence is called {name!r}")


@dataclass(frozen=True, slots=True)
class SameByTheorem:
    """ALWAYS: a theorem of that `name` maps positive parameters to positive parameters."""

    kind: ClassVar[str] = "theorem"
    name: str

    def __post_init__(self) -> None:
        _known(self.name, _THEOREMS)

    def sentence(self, given: str, other: str) -> str:
        """What the theorem says."""
        return _THEOREMS[self.name].format(given, other) + "."

    @property
    def formula(self) -> str:
        """The theorem by name."""
        return f"{self.name} theorem"


@dataclass(frozen=True, slots=True)
class Excluded:
    """NEVER: the statement of `parts` of that `name`; at the rational `point`, if one is needed, balls are looked at."""

    kind: ClassVar[str] = "excluded"
    name: str
    point: Values = ()

    def __post_init__(self) -> None:
        _known(self.name, _OBSTACLES)

    def sentence(self, given: str, other: str) -> str:
        """What stands against equivalents."""
        why = _OBSTACLES[self.name].format(given, other)
        return f"No generic positive parameters of {given} have a positive equivalent in {other}: {why}."

    @property
    def formula(self) -> str:
        """The statement by name."""
        return f"{self.name} exclude positive equivalents"


@dataclass(frozen=True, slots=True)
class NoEquivalent:
    """NEVER: at this rational point of `given` no parameters of `other`, not even complex ones, are equivalent."""

    kind: ClassVar[str] = "no-equivalent"
    point: Values

    def sentence(self, given: str, other: str) -> str:
        """What the fibre shows."""
        return (
            f"For one choice of rational parameters of {given} no parameters of {other}, real or complex, give the same "
            "transfer function; so generic parameters have no equivalent."
        )

    @property
    def formula(self) -> str:
        """The empty fibre."""
        return "Φ₂⁻¹(Φ₁(p₀)) = ∅"


@dataclass(frozen=True, slots=True)
class PartWords:
    """A part of both models: number of masses, ports of `given` and of `other`, and words that only `given` can have.

    A word says how many zeros lie in each gap between neighbouring poles (see `words`).
    """

    part: str
    nodes: int
    given: tuple[int, int]
    other: tuple[int, int]
    lacking: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True)
class Interlacing:
    """ALWAYS or SOMETIMES: how poles and zeros of each part may lie; rational points with and without an equivalent."""

    kind: ClassVar[str] = "interlacing"
    parts: tuple[PartWords, ...]
    with_one: Values = ()
    without: Values = ()

    def sentence(self, given: str, other: str) -> str:
        """Which arrangements of poles and zeros `other` lacks."""
        lacking = [(p.part, _spelled(p.lacking)) for p in self.parts if p.lacking]
        if not lacking:
            return f"However the zeros of {given} lie between its poles, positive parameters of {other} can do the same."
        which = " and ".join(f"{words} in the {part} part" for part, words in lacking)
        return (
            f"Some positive parameters of {given} have a positive equivalent in {other}, others have none: those where the "
            f"zeros of a part lie between its poles as in no {other} (zeros a gap, slowest gap first: {which})."
        )

    @property
    def formula(self) -> str:
        """Numbers of lacking words."""
        counted = ((p.part, len(p.lacking)) for p in self.parts)
        return ", ".join(f"{part}: {n or 'no'} arrangement{'s' * (n > 1)} lacking" for part, n in counted)


@dataclass(frozen=True, slots=True)
class Points:
    """SOMETIMES: rational points of `given`, one in an open set with positive equivalents, one in an open set without."""

    kind: ClassVar[str] = "points"
    with_one: Values
    without: Values

    def sentence(self, given: str, other: str) -> str:
        """What the two points show."""
        return (
            f"All models near one choice of positive rational parameters of {given} have a positive equivalent in {other}, "
            "generic ones near another choice have none."
        )

    @property
    def formula(self) -> str:
        """One of each."""
        return "∃ p₀: Φ₂⁻¹(Φ₁(p₀)) ∩ ℝ₊ⁿ ≠ ∅,  ∃ p₁: Φ₂⁻¹(Φ₁(p₁)) ∩ ℝ₊ⁿ = ∅"


@dataclass(frozen=True, slots=True)
class BoxMap:
    """ALWAYS, within ranges: a renaming (given, other) takes the ranges of `given` into those of `other`."""

    kind: ClassVar[str] = "box"
    pairs: tuple[tuple[str, str], ...]

    def sentence(self, given: str, other: str) -> str:
        """What the renaming does to the ranges."""
        return f"A renaming turns {given} into {other}, and every range of {given} lies inside the range that it is renamed to."

    @property
    def formula(self) -> str:
        """All pairs."""
        return ", ".join(f"{a} → {b}" for a, b in self.pairs)


Evidence = SameByTheorem | Excluded | NoEquivalent | Interlacing | Points | BoxMap
_KINDS: dict[str, type[Evidence]] = {c.kind: c for c in get_args(Evidence)}


def to_dict(evidence: Evidence) -> dict[str, object]:
    """Plain data, ready for JSON."""
    return {"kind": evidence.kind, **asdict(evidence)}


def from_dict(data: dict[str, object]) -> Evidence:
    """Evidence from plain data. Raises KeyError or TypeError for what is none."""
    fields = {name: _tupled(value) for name, value in data.items() if name != "kind"}
    if "parts" in fields:
        fields["parts"] = _parts(data["parts"])
    return _KINDS[str(data["kind"])](**fields)


def _parts(plain: Any) -> tuple[PartWords, ...]:
    return tuple(PartWords(**{name: _tupled(value) for name, value in p.items()}) for p in plain)


def _tupled(value: Any) -> Any:
    return tuple(map(_tupled, value)) if isinstance(value, list | tuple) else value


def _spelled(words: tuple[tuple[int, ...], ...]) -> str:
    """At most three words, such as 0-2-0."""
    shown = ", ".join("-".join(map(str, w)) for w in words[:3])
    return shown if len(words) <= 3 else f"{shown} and {len(words) - 3} more"
