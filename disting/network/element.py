"""Elements of linear networks: what connects the nodes of a machine, of a circuit, of compartments.

An element of value p adds p s^r u v^T to the matrix P(s) of its network, where u and v say at which
nodes it pulls and what it feels; of a resistor, an inductor and a Warburg element 1/p stands for p.
The power r of a constant phase element is its exponent, a parameter that has a name.
Node 0 is the ground (a reference node, the outside) and has no row.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from disting.errors import InputError, short
from disting.model.chain import Sort


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of element: its letter, what it is called, and its term of P(s).

    `halves`: 2 r, as the power of s is a half for a Warburg element; `divides`: 1/p enters;
    `ends`: at how many nodes it sits.
    """

    letter: str
    word: str
    sort: Sort
    halves: int
    divides: bool = False
    ends: int = 2


_M, _C, _F = Sort
KINDS = {
    kind.letter: kind
    for kind in (
        Kind("m", "mass", _M, 4, ends=1),
        Kind("j", "inerter", _M, 4),
        Kind("d", "damper", _M, 2),
        Kind("k", "spring", _M, 0),
        Kind("R", "resistor", _C, 0, divides=True),
        Kind("L", "inductor", _C, -2, divides=True),
        Kind("C", "capacitor", _C, 2),
        Kind("W", "Warburg element", _C, 1, divides=True),
        Kind("P", "constant phase element", _C, 0),
        Kind("a", "flow", _F, 0),
        Kind("v", "compartment", _F, 2, ends=1),
    )
}


PHASE = "P"  # the letter of a constant phase element, whose exponent is a parameter


@dataclass(frozen=True, slots=True)
class Element:
    """One element: the name of its value (none of a compartment, whose contents are the state
    itself), the letter of its kind, the nodes at its ends, the ratio of a gear, and the exponent of
    a constant phase element.

    Kinds are m mass, j inerter, d damper, k spring; R resistor, L inductor, C capacitor, W Warburg
    element, P constant phase element; a flow, v compartment; the name of a value begins with the
    letter of its kind (of a damper b too). Node 0 is the ground. Of two ends i and j with a ratio
    g the element feels x_i - g x_j: g is the name of a parameter or a number such as "3/2". A flow
    goes from its first node to its second one. The admittance of a constant phase element is p s^n:
    n is the name of its exponent, n1 of P1 where none is given. Immutable and hashable. Raises
    InputError.

    >>> spring = Element("k12", "k", (1, 2), "3/2")
    >>> spring.kind.word, spring.parameters, str(spring)
    ('spring', ('k12',), 'k12 1 2 *3/2')
    >>> Element("P1", "P", (1, 2)).exponent
    'n1'
    """

    value: str
    letter: str
    nodes: tuple[int, ...]
    ratio: str = ""
    exponent: str = ""

    def __post_init__(self) -> None:
        if self.letter == PHASE and not self.exponent and isinstance(self.value, str):
            object.__setattr__(self, "exponent", f"n{self.value[1:]}")
        for problem in _problems(self):
            raise InputError(problem)

    @property
    def kind(self) -> Kind:
        """What it is."""
        return KINDS[self.letter]

    @property
    def power(self) -> tuple[int, str]:
        """Its power of s: 2 r, and the exponent that is added to r."""
        return self.kind.halves, self.exponent

    @property
    def known_ratio(self) -> Fraction | None:
        """The ratio where it is a number: 1 without a gear."""
        return as_number(self.ratio) if self.ratio else Fraction(1)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Its value, and a ratio that is unknown."""
        unknown = [self.ratio] if self.known_ratio is None else []
        return (*([self.value] if self.value else []), *unknown)

    @property
    def feels(self) -> dict[int, Fraction | str]:
        """The vector v, by nodes other than the ground; a text stands for minus a parameter."""
        first, *others = self.nodes
        if self.letter == "a" or not others:
            return {first: Fraction(1)}
        ratio = self.known_ratio
        number: Fraction | str = self.ratio if ratio is None else -ratio
        return {i: x for i, x in ((first, Fraction(1)), (others[0], number)) if i}

    @property
    def pulls(self) -> dict[int, Fraction | str]:
        """The vector u."""
        if self.letter != "a":
            return self.feels
        return {i: x for i, x in zip(self.nodes, (Fraction(1), Fraction(-1)), strict=True) if i}

    def __str__(self) -> str:
        where = " ".join(map(str, self.nodes))
        more = f" *{self.ratio}" if self.ratio else ""
        more += f" ^{self.exponent}" if self.exponent else ""
        return f"{self.value or self.letter} {where}{more}"


@dataclass(frozen=True, slots=True)
class Port:
    """Where a force acts or a current enters (+ at `plus`, - at `minus`), or what a sensor shows:
    x[plus] - x[minus]. Node 0 is the ground. Immutable and hashable. Raises InputError.

    >>> Port(3), Port(2, 1).ends
    (Port(plus=3, minus=0), {2: 1, 1: -1})
    """

    plus: int
    minus: int = 0

    def __post_init__(self) -> None:
        for end in (self.plus, self.minus):
            if type(end) is not int or end < 0:
                raise InputError(f"a port is at nodes 1, 2, .. or 0, the ground, not {short(end)}")

    @property
    def ends(self) -> dict[int, int]:
        """The vector b or c, by nodes other than the ground; nothing where both ends are one."""
        apart = self.plus != self.minus
        return {i: x for i, x in ((self.plus, 1), (self.minus, -1)) if i and apart}


def _problems(e: Element) -> Iterator[str]:
    """Yield what is wrong with one element, each with its remedy."""
    for text in (e.value, e.letter, e.ratio, e.exponent):
        if not isinstance(text, str):
            yield f"name, kind, ratio and exponent of an element are texts, not {short(text)}"
    if e.letter not in KINDS:
        yield f"kinds of elements are {_words(KINDS)}, not {short(e.letter)}"
    if not isinstance(e.nodes, tuple) or not all(type(i) is int for i in e.nodes):
        yield f"nodes of an element are a tuple of whole numbers, not {short(e.nodes)}"
    called = e.value or "one"
    if min(e.nodes, default=-1) < 0 or len(e.nodes) != e.kind.ends or len({*e.nodes}) < e.kind.ends:
        ends = {1: "one node", 2: "two different nodes"}[e.kind.ends]
        yield f"{called} is a {e.kind.word}: it sits at {ends}, 0 for the ground"
    if e.nodes[0] == 0 and e.kind.sort is Sort.COMPARTMENTS:
        yield (
            f"{called} is a {e.kind.word}: number compartments from 1; 0 is the outside, where a"
            " flow ends"
        )
    if e.nodes[0] == 0 and e.kind.ends == 1:
        yield f"{called} is a {e.kind.word}: it cannot be at the ground"
    if e.letter == "v" and e.value:
        yield f"{short(e.value)} is a compartment, which has no value: leave its name empty"
    if e.letter != "v" and not _is_name(e.value):
        yield f"{short(e.value)} is no name of a value: use letters, digits and _, and not s alone"
    if e.letter != "v" and kind_of(e.value) != e.kind:
        yield (
            f"{e.value} names a {kind_of(e.value).word}: begin the name of a {e.kind.word} with"
            f" {e.letter}"
        )
    if e.ratio and (e.kind.ends == 1 or e.letter == "a" or 0 in e.nodes):
        yield f"{called} has a ratio, as of a gear: that needs two nodes other than the ground"
    if e.exponent and e.letter != "P":
        yield f"{called} is a {e.kind.word}, which has no exponent: leave that away"
    if e.exponent and not _is_name(e.exponent):
        yield f"{short(e.exponent)} is no exponent: use a name such as n1"
    if e.known_ratio == 0:
        yield f"the ratio of {called} is zero: leave the gear away"
    if e.known_ratio is None and not _is_name(e.ratio):
        yield f"{short(e.ratio)} is no ratio: use a name other than s, or a number such as 3/2"


def _is_name(text: str) -> bool:
    """Whether it can name a value: s is the frequency variable."""
    return text.isidentifier() and text.isascii() and text != "s"


def _words(letters: Iterable[str]) -> str:
    return ", ".join(f"{letter} {KINDS[letter].word}" for letter in letters)


def as_number(text: str) -> Fraction | None:
    """The number that a text is: 3, 3/2, 0.25; None of another text."""
    if not re.fullmatch(r"\d{1,30}(\.\d{1,30}|/\d{1,30})?", text) or re.search(r"/0+$", text):
        return None
    return Fraction(text)


def kind_of(name: str) -> Kind:
    """The kind that the first letter of a name says: b is a damper too, as of bearings; raises
    InputError.

    >>> kind_of("k12").word, kind_of("b2").word
    ('spring', 'damper')
    """
    letter = "d" if name[:1] == "b" else name[:1]
    if name[:3] == "CPE":
        raise InputError(f"{short(name)} is a constant phase element: call it P{name[3:]}")
    if letter not in KINDS or letter == "v":
        letters = _words(letter for letter in KINDS if letter != "v")
        raise InputError(f"{short(name)} begins with no letter of an element; there are {letters}")
    return KINDS[letter]
