"""Identifiability over complex, real and positive parameters: the number of parameter vectors with
one behaviour in each domain, and the exchanges among them.

An exchange of parameters that keeps the response turns a vector with the behaviour into another
one, in every domain: it keeps signs. So if there are as many vectors over complex parameters as
exchanges, the identity among them, there are as many over real and over positive ones, and the
parameters are unique up to these exchanges. Other vectors may be positive for all values of the
parameters, for none of them or for some. A statement on a domain holds for all its values except
those at which a polynomial is zero that is not zero everywhere.
"""

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any, Protocol

from disting.algebra.certainty import Certainty, Grade, weakest
from disting.decide.identifiability.parts import Level, Renaming
from disting.errors import ContradictionError
from disting.model.question import Domain

if TYPE_CHECKING:
    from disting.decide.identifiability.levels import ParameterIdentifiability

_EMPTY: dict[str, object] = {
    "domain": Domain.COMPLEX,
    "sampled": (),
    "varies": False,
    "exchanges": (),
    "over_complex": None,
}
"""Empty fields of a finding; records that were written before them have none."""


@dataclass(frozen=True, slots=True)
class Solutions:
    """The parameter vectors with one generic behaviour over a domain.

    `levels` of the parameters that take finitely many values. `least` and `most`: bounds of the
    number of vectors (`most` None: infinite or not known). `sampled`: the different numbers found
    at random values of the domain, in order; `varies`: each of them is proven to hold on an open
    set. `exchanges` generate the renamings that keep the response, `order` of them with the
    identity. All of it is wrong with a probability of at most 2**-safety where it is BOUNDED.
    """

    domain: Domain
    levels: dict[str, Level]
    least: int
    most: int | None
    sampled: tuple[int, ...]
    varies: bool
    exchanges: tuple[Renaming, ...]
    order: int
    certainty: Certainty
    safety: int

    @property
    def grade(self) -> Grade:
        """Certainty and error bits."""
        return self.certainty, self.safety

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        return asdict(self)

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "Solutions":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        read = {
            "domain": Domain(data["domain"]),
            "levels": {name: Level(level) for name, level in data["levels"].items()},
            "sampled": tuple(map(int, data["sampled"])),
            "exchanges": _renamings(data["exchanges"]),
            "certainty": Certainty(data["certainty"]),
        }
        return Solutions(**(data | read))


OverDomains = tuple[Solutions, ...]
"""The solutions over each `Domain`, in its order."""


def over(solutions: OverDomains, domain: Domain) -> Solutions:
    """The solutions over one domain."""
    return next(s for s in solutions if s.domain is domain)


class Counted(Protocol):
    """A finding that bounds a number of parameter vectors over a domain."""

    @property
    def domain(self) -> Domain:
        """The admissible parameters."""

    @property
    def least(self) -> int:
        """A lower bound."""

    @property
    def most(self) -> int | None:
        """An upper bound, None where none is known."""

    @property
    def sampled(self) -> tuple[int, ...]:
        """The different numbers found at random values."""

    @property
    def varies(self) -> bool:
        """True if these numbers are proven to hold on open sets."""


def count_in_words(found: Counted) -> str:
    """The number of parameter vectors, "" where nothing is known of it.

    >>> exchanged = Solutions(
    ...     Domain.POSITIVE, {}, 1, 3, (1, 3), True, (), 1, Certainty.PROVEN, 0
    ... )
    >>> count_in_words(exchanged)
    '1 to 3 sets of positive values fit, depending on the values'
    """
    least, most, kind = found.least, found.most, f"of {found.domain} values"
    if most is not None and least == most:
        return _sets(least, least, kind)
    if found.sampled:
        low, high = found.sampled[0], found.sampled[-1]
        limit = "more are not excluded" if most is None else f"at most {most}"
        if not found.varies:
            return f"{_sets(low, high, kind)} at the values sampled, {limit} at others"
        rest = "" if (low, high) == (least, most) else f", {limit} at others"
        return f"{_sets(low, high, kind)}, depending on the values{rest}"
    if most is None:
        return f"at least {_sets(least, least, kind)}" if least > 1 else ""
    return _sets(least, most, kind)


def _sets(low: int, high: int, kind: str) -> str:
    if low == high == 1:
        return f"1 set {kind} fits"
    if low == high:
        return f"{low} sets {kind} fit"
    return f"{low} {'or' if high == low + 1 else 'to'} {high} sets {kind} fit"


def find_over_domain(
    found: "ParameterIdentifiability", solutions: OverDomains, domain: Domain
) -> "ParameterIdentifiability":
    """The finding over complex parameters, and the solutions over a domain, as one finding."""
    plain = _merge(found, over(solutions, Domain.COMPLEX))
    if domain is Domain.COMPLEX:
        return plain
    merged = _merge(found, over(solutions, domain))
    bounds = (plain.least, plain.most) if not plain.freedom else (merged.least, merged.most)
    same = (merged.levels, merged.least, merged.most) == (plain.levels, *bounds)
    return replace(merged, over_complex=None if same else plain)


def _merge(found: "ParameterIdentifiability", solutions: Solutions) -> "ParameterIdentifiability":
    """Bounds and levels of both: what is unique over complex parameters is so in every domain."""
    bounds = [most for most in (found.most, solutions.most) if most is not None]
    most = min(bounds, default=None)
    is_full = found.rank == len(found.levels)
    exchanged = is_full and most == solutions.order
    least = max(solutions.least, found.least) if is_complex(solutions) else solutions.least
    if most is not None and least > most:
        raise ContradictionError(f"{least} parameter vectors, and at most {most}")
    moved = {name for renaming in solutions.exchanges for pair in renaming.moved for name in pair}
    levels = {
        name: Level.EXCHANGES
        if exchanged and name in moved
        else Level.GLOBAL
        if exchanged
        else _level(level, solutions.levels.get(name, Level.UNKNOWN), is_complex(solutions))
        for name, level in found.levels.items()
    }
    settled = Level.UNKNOWN not in levels.values()
    grades = [(found.certainty, found.safety), *([solutions.grade] if _adds(solutions) else [])]
    certainty, safety = weakest(*grades)
    return replace(
        found,
        levels=levels,
        least=most if exchanged and most else least,
        most=most,
        certainty=certainty,
        safety=safety,
        reason="" if settled else found.reason,
        domain=solutions.domain,
        sampled=solutions.sampled,
        varies=solutions.varies,
        exchanges=solutions.exchanges,
    )


def is_complex(solutions: Solutions) -> bool:
    """Return True if these are the solutions over complex parameters."""
    return solutions.domain is Domain.COMPLEX


def _adds(solutions: Solutions) -> bool:
    """Return True if the result rests on more than exact identities."""
    return solutions.certainty is Certainty.BOUNDED


def _level(complex_level: Level, level: Level, is_over_complex: bool) -> Level:
    if complex_level in (Level.GLOBAL, Level.NOT):
        return complex_level
    if is_over_complex and complex_level is Level.LOCAL:
        if level is Level.GLOBAL:
            raise ContradictionError("a parameter has one complex value, and several")
        return Level.LOCAL if level is Level.UNKNOWN else level
    return level


def plain_over_domain(data: dict[str, Any]) -> dict[str, Any]:
    """Plain data without the empty fields on a domain."""
    if data.get("over_complex"):
        data["over_complex"] = plain_over_domain(data["over_complex"])
    return {k: v for k, v in data.items() if k not in _EMPTY or v != _EMPTY[k]}


def fields_over_domain(
    data: Mapping[str, Any], read: Callable[[dict[str, Any]], Any]
) -> dict[str, Any]:
    """The fields of plain data that speak of a domain, `read` making what lies within."""
    made: dict[str, Callable[[Any], Any]] = {
        "domain": Domain,
        "sampled": lambda numbers: tuple(map(int, numbers)),
        "varies": bool,
        "exchanges": _renamings,
        "over_complex": read,
    }
    return {name: make(data[name]) for name, make in made.items() if name in data}


def _renamings(items: Any) -> tuple[Renaming, ...]:
    return tuple(
        Renaming(tuple((a, b) for a, b in item["moved"]), tuple(item["symmetries"]))
        for item in items
    )
