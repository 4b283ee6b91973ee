"""Circuits as strings, elements in series and parallel in three dialects, and as netlists.

A line is an element with its two nodes; values behind them are of no meaning for a structure. The
port is given by `port 1 0`, or by a source (V or I) between its nodes; else it is from node 1 to 0.
Lines end with a semicolon or where the text does.

    impedance.py, many tools    R0-p(R1,C1)-W1       - series, p(,) parallel
    AutoEIS, EquivalentCircuits R0-[R1,C1]-W1        - series, [,] parallel
    ImpedanceFitter             R0 + parallel(R1, C1) + W1
    Boukamp (CDC), pyimpspec    R(RC)W, R(C[RW])     side by side and [ ] series, ( ) parallel

An element is R, L, C, W or P and a number, or a word that begins with a small letter or an
underscore: Rct, Cdl, CPE_f3. Boukamp's may have none and are numbered. P, a constant phase element,
is CPE of impedance.py and Q of Boukamp. After an element pyimpspec writes values in braces,
R{R=20}, which do not concern the structure (`notation.values` reads them). The port is at both ends
of the circuit.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import count, islice, pairwise

from disting.errors import InputError, short
from disting.network.network import Element, Network, Port

LINE = re.compile(r"([RLCWP]\w*)\s+(\w+)\s+(\w+)(?:\s+\S+)*", re.ASCII)
PORT = re.compile(r"(?:port|[VI]\w*)\s+(\w+)\s+(\w+)(?:\s+\S+)*", re.ASCII | re.IGNORECASE)
WORDS = re.compile(r"\s*(p\(|parallel\(|[-+,()\[\]]|[A-Za-z]\w*|\S)", re.ASCII)
# where elements stand side by side
LETTER = re.compile(r"\s*([()\[\]]|(?:CPE|TLM[A-Z]?|[A-Z][a-z]*)\d*(?:_\w+)?|\S)", re.ASCII)
VALUES = re.compile(r"\{[^{}]*\}")  # of pyimpspec, behind an element
BEHIND = re.compile(rf"\s*({VALUES.pattern})")
ELEMENT = re.compile(r"(CPE|[RLCWPQ])(\d*|[a-z_]\w*)", re.ASCII)
OURS = {"CPE": "P", "Q": "P"}  # what other programs call an element
DEEPEST = 30
IRRATIONAL = "its impedance is no fraction of polynomials in the root of s"
UNSUPPORTED = {
    "Wo": ("finite-length Warburg element with an open end", IRRATIONAL),
    "Ws": ("finite-length Warburg element with a short", IRRATIONAL),
    "T": ("diffusion of finite length (porous electrode)", IRRATIONAL),
    "O": ("finite-length Warburg element with a short", IRRATIONAL),
    "G": ("Gerischer element", "its impedance has the root of s + k"),
    "Gs": ("finite-length Gerischer element", IRRATIONAL),
    "La": ("inductor with an exponent", "its impedance grows with an unknown power of s"),
    "K": ("relaxation R/(1 + s tau)", "write p(R1,C1) in its place"),
    "Zarc": ("resistor beside a constant phase element", "write p(R1,P1) in its place"),
    "TLMQ": ("transmission line", IRRATIONAL),
    "TLM": ("transmission line", IRRATIONAL),
    "H": ("Havriliak-Negami relaxation", "its impedance has a power of 1 + (s tau)^n"),
}  # elements of other programs, and why there are no verdicts on them
KNOWN = re.compile(rf"({'|'.join(sorted(UNSUPPORTED, key=len, reverse=True))})(?:\d+|_\w+)?")


def netlist(text: str, name: str) -> Network:
    """The one-port of a netlist; raises InputError.

    >>> netlist("R1 in 2; C1 2 0; port in 0", "filter").inputs
    (Port(plus=1, minus=0),)
    """
    elements, ports, numbers = [], [], {"0": 0, "gnd": 0, "GND": 0}
    for line in filter(None, (part.strip() for part in re.split(r"[;\n]", text))):
        if line.startswith("*") or line.lower().startswith(".end"):
            continue
        port, element = PORT.fullmatch(line), LINE.fullmatch(line)
        match = port or element
        if match is None:
            raise InputError(
                f"{short(line)} is no line of a netlist: write R, L, C, W or P, a number and two"
                " nodes, as in R1 1 2, or port 1 0"
            )
        *_, a, b = (
            numbers.setdefault(node, len(set(numbers.values()))) for node in match.groups()[-2:]
        )
        if port:
            ports.append(Port(a, b))
        else:
            elements.append(Element(match[1], match[1][0], (a, b)))
    if len(set(ports)) > 1:
        raise InputError("a netlist has one port: leave the other port and the sources away")
    if not ports and "1" not in numbers:
        raise InputError("no port is said and there is no node 1: add a line such as port in 0")
    where = (ports[0] if ports else Port(numbers["1"]),)
    return Network(tuple(elements), where, where, name=name)


@dataclass(frozen=True, slots=True)
class Dialect:
    """Syntax of a notation for parallel parts and series in brackets; `dashes`: series has a sign
    `joint` between its parts, parallel parts have commas.
    """

    name: str
    parallel: tuple[str, str]
    series: tuple[str, str] = ("", "")
    dashes: bool = True
    joint: str = "-"


IMPEDANCE = Dialect("impedance", ("p(", ")"))
AUTOEIS = Dialect("autoeis", ("[", "]"))
FITTER = Dialect("impedancefitter", ("parallel(", ")"), joint="+")
BOUKAMP = Dialect("boukamp", ("(", ")"), ("[", "]"), dashes=False)


def dialects_of(text: str) -> list[Dialect]:
    """The dialects in which a text may be written, by its signs alone."""
    plain = VALUES.sub("", text).replace(" ", "")
    if "parallel(" in plain or "+" in plain:
        return [FITTER]
    if "p(" in plain:
        return [IMPEDANCE]
    if "-" in plain or "," in plain:
        return [AUTOEIS] if "[" in plain else [IMPEDANCE]
    if "(" in plain:
        return [BOUKAMP]
    return [AUTOEIS, BOUKAMP] if "[" in plain else [BOUKAMP]


def circuit(text: str, dialect: Dialect, name: str) -> Network:
    """The one-port that a text describes; raises InputError with the place.

    >>> print(*circuit("R0-p(R1,C1)", IMPEDANCE, "cell").elements, sep=", ")
    R0 1 2, R1 2 0, C1 2 0
    """
    whole, _ = _parse(text, dialect)
    port = (Port(1),)
    return Network(tuple(_place_part(whole, 1, 0, count(2))), port, port, name=name)


def braces(text: str, dialect: Dialect) -> dict[str, str]:
    """Return the texts in braces behind elements, by the names of the elements; raises InputError.

    >>> braces("R{R=20}(R{R=100:ct}C)", BOUKAMP)
    {'R1': 'R=20', 'R2': 'R=100:ct'}
    """
    _, ends = _parse(text, dialect)
    found = {name: BEHIND.match(text, end) for name, end in ends.items()}
    behind = {name: match for name, match in found.items() if match}
    lost = {m.start() for m in VALUES.finditer(text)} - {m.start(1) for m in behind.values()}
    if lost:
        raise InputError(
            f"the braces at position {min(lost) + 1} do not follow an element: write values behind"
            " an element, once, as in R{R=20}"
        )
    return {name: match[1][1:-1] for name, match in behind.items()}


def _parse(text: str, dialect: Dialect) -> "tuple[Part, dict[str, int]]":
    """Return the whole circuit, and where each element ends in the text."""
    token = WORDS if dialect.dashes else LETTER
    # blanks in the place of values keep the places of what follows
    plain = VALUES.sub(lambda values: " " * len(values[0]), text).rstrip()
    reader = _Reader(dialect, list(token.finditer(plain)), plain)
    whole = reader.series()
    if reader.next:
        raise reader.problem("what stands before it is whole; remove it or join it")
    return whole, reader.ends


@dataclass(frozen=True, slots=True)
class Series:
    """Parts one after the other."""

    parts: tuple["Part", ...]


@dataclass(frozen=True, slots=True)
class Parallel:
    """Parts side by side."""

    parts: tuple["Part", ...]


Part = str | Series | Parallel


def _place_part(part: Part, start: int, end: int, new: Iterator[int]) -> Iterator[Element]:
    """Yield the elements of a part between two nodes; `new` numbers further ones."""
    match part:
        case Parallel(parts):
            for each in parts:
                yield from _place_part(each, start, end, new)
        case Series(parts):
            nodes = [start, *islice(new, len(parts) - 1), end]
            for each, (a, b) in zip(parts, pairwise(nodes), strict=True):
                yield from _place_part(each, a, b, new)
        case str():
            yield Element(part, part[0], (start, end))


@dataclass(slots=True)
class _Reader:
    """Tokens, the place in them, the number of times a letter occurred without a number, and where
    elements end in the text.
    """

    dialect: Dialect
    tokens: list[re.Match[str]]
    text: str
    at: int = 0
    depth: int = 0
    unnumbered: Counter[str] = field(default_factory=Counter)
    ends: dict[str, int] = field(default_factory=dict)

    @property
    def next(self) -> str:
        """The next token, "" at the end."""
        return self.tokens[self.at][1] if self.at < len(self.tokens) else ""

    def series(self) -> Part:
        """Parts up to a bracket, a comma or the end."""
        parts = [self.part()]
        while self._goes_on(self.dialect.joint):
            self.at += self.dialect.dashes
            parts.append(self.part())
        return Series(tuple(parts)) if len(parts) > 1 else parts[0]

    def _goes_on(self, sign: str) -> bool:
        """True if a further part follows, behind a sign or side by side."""
        return self.next == sign if self.dialect.dashes else self.next not in ("", ")", "]")

    def part(self) -> Part:
        """An element, or what is in brackets."""
        opening = self.next
        for (first, last), read in (
            (self.dialect.parallel, self.parallel),
            (self.dialect.series, self.series),
        ):
            if opening and opening == first:
                self.at, self.depth = self.at + 1, self.depth + 1
                if self.depth > DEEPEST:
                    raise InputError(f"brackets are nested more than {DEEPEST} deep")
                series = read()
                if self.next != last:
                    raise self.problem(f"{last} is missing, which closes {opening}")
                self.at, self.depth = self.at + 1, self.depth - 1
                return series
        return self.element()

    def parallel(self) -> Part:
        """Parts between commas, or side by side."""
        parts = [self.series() if self.dialect.dashes else self.part()]
        while self._goes_on(","):
            self.at += self.dialect.dashes
            parts.append(self.series() if self.dialect.dashes else self.part())
        if len(parts) < 2:
            raise self.problem("at least two parts are parallel")
        return Parallel(tuple(parts))

    def element(self) -> str:
        """The name of an element; one without a number gets one."""
        known, name = KNOWN.fullmatch(self.next), ELEMENT.fullmatch(self.next)
        if known:
            what, reason = UNSUPPORTED[known[1]]
            raise self.problem(f"{known[1]} ({what}) is not supported: {reason}")
        if not name:
            opening, closing = self.dialect.parallel
            joint = self.dialect.joint
            example = f"R0{joint}{opening}R1,C1{closing}" if self.dialect.dashes else "R(RC)"
            raise self.problem(
                "write R, L, C, W (Warburg) or P (constant phase) and a number or a name, as in"
                f" {example}"
            )
        letter = OURS.get(name[1], name[1])
        if not name[2]:
            self.unnumbered[letter] += 1
        called = f"{letter}{name[2] or self.unnumbered[letter]}"
        self.ends[called] = self.tokens[self.at].end(1)
        self.at += 1
        return called

    def problem(self, remedy: str) -> InputError:
        """Error at the next token."""
        if not self.next:
            return InputError(f"cannot parse the circuit, it ends too early: {remedy}")
        at = self.tokens[self.at]
        return InputError(
            f"cannot parse the circuit at position {at.start(1) + 1} ({short(at[1])}): {remedy}"
        )
