"""Declarations that every kind of evidence makes.

A condition is any row of the table of conditions: which one it was is found by evaluating that row
again. Evidence of equivalence over complex parameters proves nothing over others, unless it gives
their values.

It is checked on samples of both models, which are drawn again, at fresh points.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from enum import Enum, Flag, auto
from functools import cache
from itertools import chain, groupby
from types import UnionType
from typing import Any, ClassVar, Self, Union, get_args, get_origin, get_type_hints

from disting.behaviour.sample import Representation, Sample, samples
from disting.model.protocol import Model
from disting.model.question import Domain, Relation

Labels = tuple[str, ...]
PointText = tuple[tuple[str, str], ...]
"""Parameter names and their values, as text."""
# kinds that older versions wrote, each with what it rested on
OUTSIDE = "an external program, which is no longer used"
GONE = {"program": OUTSIDE, "row": "results on rows of masses that are no longer shipped"}


def label_runs(labels: Labels) -> str:
    """Labels with runs shortened.

    >>> label_runs(("b0", "b1", "b2", "a1")), label_runs(("b0[2]", "b1[2]"))
    ('b0–b2, a1', 'b0[2]–b1[2]')
    """
    matches = [re.fullmatch(r"([A-Za-z]+)(\d+)(.*)", label) for label in labels]
    numbered = enumerate((m[1] + m[3], int(m[2])) if m else ("", -1) for m in matches)
    groups = groupby(numbered, key=lambda x: (x[1][0], x[1][1] - x[0]))
    runs = [list(run) for _, run in groups]
    ends = [(labels[run[0][0]], labels[run[-1][0]]) for run in runs]
    return ", ".join(a if a == b else f"{a}–{b}" for a, b in ends)


class Carrier(Flag):
    """Who decides by it: a condition, the exact decision, or the one on real and positive
    parameters.
    """

    NOBODY = 0
    CONDITION = auto()
    EXACT = auto()
    ADMISSIBLE = auto()


class Inside(Enum):
    """Statement on the generic models on the side of smaller rank: they have finite nonzero
    equivalents on the other side, or they are limits of models there; those of LIMIT may have
    elements that are zero.
    """

    EQUIVALENT = auto()
    LIMIT = auto()
    NO_EQUIVALENT = auto()
    NO_LIMIT = auto()


@dataclass(frozen=True, slots=True)
class Claim:
    """Claim that all evidence of a kind makes unless its class states more: `relation` over these
    `domains`, by the rules that are its `carriers`; `grounds`, its name in the exact decision;
    `inside`, its statement on an inclusion.
    """

    carriers: Carrier = Carrier.NOBODY
    relation: Relation = Relation.UNDECIDED
    domains: tuple[Domain, ...] = tuple(Domain)
    grounds: str = ""
    inside: Inside = Inside.NO_EQUIVALENT


COMPLEX = (Domain.COMPLEX,)
ROLES = {
    "left_given": ("given", "searched"),
    "left_is_larger": ("larger", "smaller"),
    "left_is_part": ("part", "whole"),
}  # of the left model and the right one where the field is true, exchanged where it is not


@dataclass(frozen=True, slots=True)
class Kind:
    """Evidence of a kind: `kind` is its name in files, its fields are what is stored.

    `words`, `symbols` and `theorem` make `sentence`, `formula` and `title`, if its class does not
    override them: {0} is the evidence, {left} and {right} are the models, also by the roles
    (`ROLES`) that a field of it gives them.
    """

    kind: ClassVar[str]
    claim: ClassVar[Claim] = Claim()
    words: ClassVar[str] = ""
    symbols: ClassVar[str] = ""
    theorem: ClassVar[str] = ""

    def sentence(self, left: str, right: str) -> str:
        """Statement of this evidence on two models with these names."""
        names = {"left": left, "right": right}
        for flag, (first, second) in ROLES.items():
            ordered = (left, right) if getattr(self, flag, True) else (right, left)
            names |= zip((first, second), ordered, strict=True)
        return self.words.format(self, **names)

    @property
    def formula(self) -> str:
        """The same in symbols."""
        return self.symbols.format(self)

    def shows(self, domain: Domain) -> Relation:
        """Relation that it proves over a domain; UNDECIDED if it proves nothing. A difference over
        complex parameters is one over real and positive ones, which are dense among them.
        """
        return self.claim.relation if domain in self.claim.domains else Relation.UNDECIDED

    def without_exception(self, domain: Domain) -> bool:
        """Return True if it states that all parameters in this domain have equivalents; else
        special values, a set of measure zero, are excepted: ranks and fibres apply to generic
        parameters.
        """
        return False

    @property
    def title(self) -> str:
        """Name of the theorem that it rests on; "" for a theorem without a name."""
        return self.theorem

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        """Return True if the evidence holds for two models (recomputed from scratch) and decides
        them; unless the class overrides it, by the method that finds such evidence.
        """
        return pair.found_again(self)

    @property
    def inside(self) -> Inside:
        """Statement of this evidence on an inclusion."""
        return self.claim.inside

    @property
    def turned(self) -> Self:
        """The same for the pair in the other order, where fields tell left from right."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        inner = {name: value.turned for name, value in values.items() if isinstance(value, Kind)}
        sides = {name: name.replace("left", "right") for name in values if "left" in name}
        twins = {name: twin for name, twin in sides.items() if twin in values}
        flipped = {name: not values[name] for name in sides.keys() - twins.keys()}
        swapped = {a: values[b] for pair in twins.items() for a, b in (pair, pair[::-1])}
        return replace(self, **inner, **flipped, **swapped)

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; evidence inside it in its own form."""
        values = ((f.name, getattr(self, f.name)) for f in fields(self))
        inner = {name: value.to_dict() for name, value in values if hasattr(value, "to_dict")}
        return {"kind": self.kind, **asdict(self), **inner}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Self:
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        kind: Any = cls
        hints = _hints(kind)
        return cls(**{x: _field(value, hints.get(x)) for x, value in data.items() if x != "kind"})


def _field(value: Any, hint: Any) -> Any:
    """The value of a field: evidence by its kind, what reads itself, or plain data."""
    kinds = [k for k in get_args(hint) or (hint,) if isinstance(k, type) and issubclass(k, Kind)]
    if kinds:
        return read(value, kinds)
    return hint.from_dict(value) if hasattr(hint, "from_dict") else as_tuples(value)


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
    return {name: as_tuples(value) for name, value in data.items() if name != "kind"}


def as_tuples(value: Any) -> Any:
    """Lists as tuples, however deep."""
    return tuple(map(as_tuples, value)) if isinstance(value, list | tuple) else value


def is_well_typed(evidence: Any) -> bool:
    """Return True if every field of evidence, at any depth, has the type that its class declares: a
    file may hold anything. None is no evidence.
    """
    kind: Any = type(evidence)
    hints = {} if evidence is None else _hints(kind)
    return all(_is_of(getattr(evidence, name), hint) for name, hint in hints.items())


@cache
def _hints(kind: Any) -> dict[str, Any]:
    """Types of the fields of a dataclass or a named tuple."""
    hints = get_type_hints(kind)
    return {name: hint for name, hint in hints.items() if get_origin(hint) is not ClassVar}


def _is_of(value: Any, hint: Any) -> bool:
    if get_origin(hint) in (Union, UnionType):
        return any(_is_of(value, option) for option in get_args(hint))
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


POINTS = 3

MOST_MARKOV = 1000  # of a file that somebody else wrote: each costs a row


@dataclass(frozen=True, slots=True)
class ModelSamples:
    """Samples of one model's behaviour: `draw` gives samples with this number of Markov parameters
    after G_0; `degrees` of numerator and denominator, of several transfer functions one pair after
    the other.
    """

    parameters: Labels
    degrees: tuple[int, ...]
    draw: Callable[[Representation, int], tuple[Sample, ...]]

    def rank(self, representation: str, rows: Labels = ()) -> int:
        """Rank of the named rows, or of all: the largest found."""
        sampled = self._samples(representation, rows)
        at = tuple(i for i, label in enumerate(sampled[0].labels) if not rows or label in rows)
        return max(s.rank(at) for s in sampled)

    def labels(self, representation: str, rows: Labels = ()) -> set[str]:
        """All invariants, with as many Markov parameters as these rows need."""
        return set(self._samples(representation, rows)[0].labels)

    def free(self, representation: str, rows: Labels) -> set[str]:
        """Those of them that vary."""
        first, *more = self._samples(representation, rows)
        labels = enumerate(first.labels)
        return {label for i, label in labels if any(any(s.rows[i]) for s in (first, *more))}

    def _samples(self, representation: str, rows: Labels) -> tuple[Sample, ...]:
        return self.draw(Representation(representation), markov_count(rows))


@dataclass(frozen=True, slots=True)
class SampledPair:
    """Both models: whether a renaming `renames` the left one to the right one, and evidence is
    `found_again` by the method that finds such. Of chains and networks also the `numberings` of
    the nodes of a part, which the left one is or the right one, in the whole; of chains the model
    with the elements of both, and the renaming that symmetries give, with their names.
    """

    left: ModelSamples
    right: ModelSamples
    renames: Callable[[dict[str, str]], bool]
    found_again: Callable[[Any], bool]
    numberings: Callable[[bool], Iterable[dict[int, int]]] = lambda left_is_part: ()
    united: Callable[[], ModelSamples | None] = lambda: None
    by_symmetry: Callable[[], tuple[dict[str, str], Labels] | None] = lambda: None

    @property
    def sides(self) -> tuple[ModelSamples, ModelSamples]:
        """Left and right."""
        return self.left, self.right


def samples_of(model: Model, seed: str = "verify") -> ModelSamples:
    """A model at fresh points, the same for all questions."""

    @cache
    def draw(representation: Representation, count: int) -> tuple[Sample, ...]:
        """Samples in this representation."""
        return tuple(samples(model, representation, count, POINTS, seed))

    return ModelSamples(model.parameters, tuple(chain.from_iterable(model.degrees)), draw)


def markov_count(labels: Labels) -> int:
    """Markov parameters needed to have all these labels, such as G3 or G3[2]; raises ValueError for
    more than are ever computed.
    """
    matches = (re.fullmatch(r"G(\d{1,9})(?:\[\d+\])?", label) for label in labels)
    most = max((int(x[1]) for x in matches if x), default=0)
    if most > MOST_MARKOV:
        raise ValueError(f"G{most} is beyond the first {MOST_MARKOV} Markov parameters")
    return most
