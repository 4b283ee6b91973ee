"""Identifiability of one chain: number of parameters that can be determined, number of sets that
fit, determinable functions.

It is read from plain data, as a cache or a file keeps it.
"""

from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any

from disting.algebra.certainty import Certainty, Grade
from disting.decide.identifiability.domains import (
    count_in_words,
    fields_over_domain,
    plain_over_domain,
)
from disting.decide.identifiability.parts import (
    Alternative,
    Combination,
    Formula,
    Level,
    Origin,
    Renaming,
)
from disting.model.presentation import NotebookTable, plural, summary
from disting.model.question import Answer, Domain

NUMBERS = (
    "no",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
)


@dataclass(frozen=True, slots=True)
class Identifiability(NotebookTable):
    """Identifiability of one chain over a `domain` of parameters.

    `rank`: number of determinable parameters, with its grade. `least` and `most`: bounds of the
    number of parameter vectors of the domain with one generic behaviour (`most` None: infinite or
    not known), `sampled`, `varies`, `exchanges` and `over_complex` as of a
    `ParameterIdentifiability`. `count_grade`: grade of "at most `most`", and of "exactly" where
    both agree.
    `alternatives`: those listed at the random point `point` (name, fraction), the point itself
    first. `singles`: the locally identifiable parameters. `basis`: `rank` independent locally
    identifiable combinations, the most readable found. That both are identifiable, and that no
    other parameter is, is wrong with a probability of at most 2**-safety (0: proven).
    `renamings`: symmetries; `self_dual`: see Origin.DUALITY.

    >>> from disting import identifiability
    >>> found = identifiability("2:2")
    >>> found.rank, found.level.value, [x.text for x in found.basis]
    (3, 'not identifiable', ['k12/d12', 'm1 + m2', 'k12/(m1*m2)'])
    """

    parameters: tuple[str, ...]
    rank: int
    rank_grade: Grade
    level: Level
    level_grade: Grade
    least: int
    most: int | None
    count_grade: Grade
    alternatives: tuple[Alternative, ...]
    singles: tuple[Combination, ...]
    basis: tuple[Combination, ...]
    safety: int
    renamings: tuple[Renaming, ...]
    self_dual: bool
    point: tuple[tuple[str, str], ...]
    reason: str = ""
    domain: Domain = Domain.COMPLEX
    sampled: tuple[int, ...] = ()
    varies: bool = False
    exchanges: tuple[Renaming, ...] = ()
    over_complex: "Identifiability | None" = None

    def __post_init__(self) -> None:
        if self.most is not None and self.least > self.most:
            raise ValueError("the least number of solutions is larger than the most")
        if (self.level is Level.NOT) != (self.rank < len(self.parameters)):
            raise ValueError(
                "a chain is not identifiable exactly if its rank is smaller than the number of its"
                " parameters"
            )

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    @property
    def sentence(self) -> str:
        """The finding in plain English."""
        return _sentence(self)

    @property
    def freedom(self) -> int:
        """Dimension of a generic fibre: so many parameters may be chosen freely."""
        return len(self.parameters) - self.rank

    @property
    def levels(self) -> dict[str, Level]:
        """By parameter: GLOBAL, EXCHANGES, LOCAL, NOT, or UNKNOWN where it is local and maybe
        more.
        """
        several = Level.EXCHANGES if self.level is Level.EXCHANGES else Level.LOCAL
        of = {Answer.YES: Level.GLOBAL, Answer.NO: several, Answer.UNKNOWN: Level.UNKNOWN}
        singles = {c.text: of[c.unique] for c in self.singles}
        return {name: singles.get(name, Level.NOT) for name in self.parameters}

    @property
    def combinations(self) -> tuple[str, ...]:
        """The basis as text: k01/m1."""
        return tuple(c.text for c in self.basis)

    @property
    def real(self) -> int:
        """Number of real ones among the parameter vectors listed at the random point."""
        return sum(a.real is Answer.YES for a in self.alternatives)

    @property
    def positive(self) -> int:
        """Number of positive ones among them."""
        return sum(a.positive is Answer.YES for a in self.alternatives)

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; domains are omitted where there is no statement."""
        return plain_over_domain(asdict(self))

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "Identifiability":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        return Identifiability(**decode(data))

    def __bool__(self) -> bool:
        raise TypeError("identifiability is not true or false; use its level")


def _sentence(answer: Identifiability) -> str:
    """One sentence: how many parameters are determinable, and what else has the same behaviour."""
    many = len(answer.parameters)
    head = plural(many, "parameter")
    if answer.level is Level.NOT:
        return f"{head}, only {answer.rank} determinable: {_list_basis(answer.basis)}."
    return f"{head}, all determinable; {_rest(answer)}."


def _number(count: int) -> str:
    """A small number as a word.

    >>> _number(2), _number(13)
    ('two', '13')
    """
    return NUMBERS[count] if count < len(NUMBERS) else str(count)


def _list_basis(basis: tuple[Combination, ...]) -> str:
    """Formulas, then the coefficients that are only named."""
    formulas = [c.text for c in basis if not c.is_named]
    named = sorted(c.name for c in basis if c.is_named)
    what = "transfer-function coefficient" + ("s" if len(named) > 1 else "")
    return ", ".join([*formulas, f"{what} {', '.join(named)}"] if named else formulas)


def _rest(answer: Identifiability) -> str:
    if answer.over_complex is not None:
        return f"{_over_domain(answer)}; {_over_complex(answer.over_complex)}"
    if answer.level is Level.GLOBAL:
        return "no other non-zero parameters, real or complex, give the same behaviour"
    if answer.level is Level.UNKNOWN:
        return (
            "finitely many parameter vectors give the same behaviour; their number is not known"
            f" ({answer.reason})"
        )
    if answer.level is Level.EXCHANGES:
        texts = " and ".join(r.text for r in answer.exchanges)
        many = f"{_number(answer.least)} {answer.domain} parameter vectors"
        return f"{many} give the same behaviour: unique up to exchanging {texts}"
    return f"{_count(answer)} give the same behaviour{_describe_known(answer)}{_point(answer)}"


def _over_domain(answer: Identifiability) -> str:
    """The number over a domain in which it differs from that over complex parameters."""
    if answer.level is Level.GLOBAL:
        return f"no other {answer.domain} parameters give the same behaviour"
    return count_in_words(answer) + _describe_known(answer)


def _over_complex(answer: Identifiability) -> str:
    return count_in_words(answer) or "the number of sets of complex values that fit is not known"


def _count(answer: Identifiability) -> str:
    """Number of vectors, complex ones included unless all are positive."""
    if answer.most is None:
        return f"at least {_number(answer.least)} positive parameter vectors"
    if answer.most > answer.least:
        return f"{_number(answer.most)} parameter vectors (not all proven to exist)"
    by_theorem = all(a.certainty is Certainty.THEOREM for a in answer.alternatives)
    is_positive = by_theorem or answer.domain is Domain.POSITIVE
    kind = "positive" if is_positive else answer.domain.value
    return f"{_number(answer.most)} {kind} parameter vectors"


def _describe_known(answer: Identifiability) -> str:
    exchanges = [f"exchanging {r.text} changes nothing" for r in answer.renamings]
    dual = ["each is the dual (mirror image at the gap) of another"] * answer.self_dual
    return f": {' and '.join([*exchanges, *dual])}" if exchanges or dual else ""


def _point(answer: Identifiability) -> str:
    """Real and positive ones, which depend on the point, unless theorems name all."""
    if answer.most is None or all(a.certainty is Certainty.THEOREM for a in answer.alternatives):
        return ""
    return (
        f"; with random values {_number(answer.real)} of them real, {_number(answer.positive)}"
        " positive"
    )


def decode(data: dict[str, Any]) -> dict[str, Any]:
    """Fields of an Identifiability; lists become tuples. Raises KeyError, TypeError or
    ValueError for what is none.
    """
    domains = fields_over_domain(data, Identifiability.from_dict)
    return data | {name: _READ[name](data[name]) for name in _READ} | domains


def _each(
    read: Callable[[dict[str, Any]], Any],
) -> Callable[[Iterable[dict[str, Any]]], tuple[Any, ...]]:
    return lambda items: tuple(read(item) for item in items)


def _pairs(items: Iterable[Iterable[Any]]) -> tuple[tuple[Any, ...], ...]:
    return tuple(tuple(pair) for pair in items)


def _grade(items: Iterable[Any]) -> Grade:
    certainty, bits = items
    return Certainty(certainty), int(bits)


def _alternative(d: dict[str, Any]) -> Alternative:
    return Alternative(
        Origin(d["origin"]),
        Answer(d["real"]),
        Answer(d["positive"]),
        Certainty(d["certainty"]),
        d["note"],
    )


def _combination(d: dict[str, Any]) -> Combination:
    terms = tuple((int(c), _pairs(exponents)) for c, exponents in d["formula"]["terms"])
    return Combination(Formula(terms), d["name"], Answer(d["unique"]), Certainty(d["certainty"]))


def _renaming(d: dict[str, Any]) -> Renaming:
    return Renaming(_pairs(d["moved"]), tuple(d["symmetries"]))


_READ: dict[str, Callable[[Any], Any]] = {
    "parameters": tuple,
    "rank_grade": _grade,
    "level": Level,
    "level_grade": _grade,
    "count_grade": _grade,
    "alternatives": _each(_alternative),
    "singles": _each(_combination),
    "basis": _each(_combination),
    "renamings": _each(_renaming),
    "point": _pairs,
}
