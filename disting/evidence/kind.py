"""What every kind of evidence declares: which rules may carry it, which relation it shows over
which parameters, what it says of limits, in which words, and how it is stored.

A condition is any row of the table of conditions: which one it was is seen by asking that row
again. What shows that models are the same over complex parameters says nothing of others, unless
it gives their values.
"""

from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from enum import Enum, Flag, auto
from types import UnionType
from typing import Any, ClassVar, Self, Union, get_args, get_origin, get_type_hints

from disting.evidence.seen import SeenPair
from disting.model.question import Domain, Relation

GONE = {
    "program": "an external program, which decides nothing now",
    "row": "an answer about rows of masses that is shipped no more",
}  # kinds that older versions wrote, each with what it rested on


class Carrier(Flag):
    """Who decides by it: a condition, the exact decision, or the one on real and positive
    parameters.
    """

    NOBODY = 0
    CONDITION = auto()
    EXACT = auto()
    ADMISSIBLE = auto()


class Inside(Enum):
    """What is said of the generic models on the side of smaller rank: whether they have equivalents
    on the other side, finite and not zero, or are limits of models there; those of LIMIT may have
    elements that are zero.
    """

    EQUIVALENT = auto()
    LIMIT = auto()
    NO_EQUIVALENT = auto()
    NO_LIMIT = auto()


@dataclass(frozen=True, slots=True)
class Claim:
    """What all evidence of a kind claims, if its class says no more: that `relation` over these
    `domains`, by the rules that are its `carriers`; `grounds`, how the exact decision calls it;
    `inside`, what it says of an inclusion.
    """

    carriers: Carrier = Carrier.NOBODY
    relation: Relation = Relation.UNDECIDED
    domains: tuple[Domain, ...] = tuple(Domain)
    grounds: str = ""
    inside: Inside = Inside.NO_EQUIVALENT


COMPLEX = (Domain.COMPLEX,)


@dataclass(frozen=True, slots=True)
class Kind:
    """Evidence of a kind: `kind` is its name in files, its fields are what is stored, `sentence`
    and `formula` of two models its words.
    """

    kind: ClassVar[str]
    claim: ClassVar[Claim] = Claim()

    def shows(self, domain: Domain) -> Relation:
        """Which relation it shows over a domain, UNDECIDED: nothing. A difference over complex
        parameters is one over real and positive ones, which are dense among them.
        """
        return self.claim.relation if domain in self.claim.domains else Relation.UNDECIDED

    def without_exception(self, domain: Domain) -> bool:
        """Whether it says of all parameters in this domain that they have equivalents; else special
        values, a set of measure zero, are left out: ranks and fibres speak of generic ones.
        """
        return False

    @property
    def title(self) -> str:
        """What the theorem is called that it speaks by; "" where it has no name of its own."""
        return ""

    def holds(self, pair: SeenPair, representation: str) -> bool:
        """Whether it is true of two models, seen anew, and decides them; unless a class says how,
        by the method that finds such evidence.
        """
        return pair.found_again(self)

    @property
    def inside(self) -> Inside:
        """What it says of an inclusion."""
        return self.claim.inside

    @property
    def turned(self) -> Self:
        """The same of the pair in the other order, where fields tell left from right."""
        told = {f.name: getattr(self, f.name) for f in fields(self)}
        sides = {name: name.replace("left", "right") for name in told if "left" in name}
        twins = {name: twin for name, twin in sides.items() if twin in told}
        flipped = {name: not told[name] for name in sides.keys() - twins.keys()}
        swapped = {a: told[b] for pair in twins.items() for a, b in (pair, pair[::-1])}
        return replace(self, **flipped, **swapped)

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return {"kind": self.kind, **asdict(self)}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Self:
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        return cls(**plain_fields(data))


def read(data: dict[str, Any], kinds: Iterable[type[Any]]) -> Any:
    """Evidence of one of these kinds; lists become tuples. Raises KeyError, TypeError or
    ValueError for what is none.
    """
    name = str(data["kind"])
    if name in GONE:
        raise ValueError(f"this verdict rests on {GONE[name]}; ask for it again")
    return {k.kind: k for k in kinds}[name].from_dict(data)


def plain_fields(data: dict[str, Any]) -> dict[str, Any]:
    """All but the kind."""
    return {name: tupled(value) for name, value in data.items() if name != "kind"}


def tupled(value: Any) -> Any:
    """Lists as tuples, however deep."""
    return tuple(map(tupled, value)) if isinstance(value, list | tuple) else value


def is_well_typed(evidence: Any) -> bool:
    """Whether every field of evidence, however deep, is of the type that its class says: what a
    file holds may be anything. None is no evidence.
    """
    return evidence is None or all(
        _is_of(getattr(evidence, name), hint) for name, hint in _hints(type(evidence)).items()
    )


def _hints(kind: type[Any]) -> dict[str, Any]:
    """Types of the fields of a dataclass or a named tuple."""
    found = get_type_hints(kind)
    return {name: hint for name, hint in found.items() if get_origin(hint) is not ClassVar}


def _is_of(value: Any, hint: Any) -> bool:
    if get_origin(hint) in (Union, UnionType):
        return any(_is_of(value, one) for one in get_args(hint))
    if get_origin(hint) is tuple:
        return isinstance(value, tuple) and _items_are_of(value, get_args(hint))
    if hint in (int, bool, str):
        return type(value) is hint
    whole = is_dataclass(hint) or hasattr(hint, "_fields")
    return isinstance(value, hint) and (not whole or is_well_typed(value))


def _items_are_of(value: tuple[Any, ...], items: tuple[Any, ...]) -> bool:
    if items[1:] == (Ellipsis,):
        return all(_is_of(item, items[0]) for item in value)
    return len(value) == len(items) and all(map(_is_of, value, items))
