"""All parameter vectors of other structures that give exactly the same transfer function as a
given model.

Theorems first (`images`, exact for all values), then inverse network synthesis
(`disting.fibres.synthesis.fibre`), which lists what else there is and proves whether the list is
complete; for special values that it cannot treat, the theorems remain, and with proportional
damping the synthesis without dampers.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from flint import acb, arb, fmpq

from disting.equivalence.checks import Bench, benches, difference
from disting.equivalence.inputs import Value, chains_of, point_of
from disting.equivalence.listing import (
    Equivalent,
    Equivalents,
    Listing,
    Origin,
    Signs,
    obstacle,
    sentence,
    special,
    under_all,
)
from disting.equivalence.theorems import (
    DUALITY,
    Image,
    common_ratio,
    images,
    proportional_solutions,
)
from disting.errors import ContradictionError, InputError
from disting.experiments import Experiment, parse_experiment
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Fibre, Point, Solution, Status, target
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import name_of, read_together
from disting.model.question import Answer


def chain_equivalents(
    model: Chain | str,
    values: Mapping[str, Value],
    to: Chain | Family | str,
    *,
    damped: bool | None = None,
    also: Sequence[str | Experiment] = (),
) -> Equivalents:
    """Equivalents of a chain among chains; arguments as those of `any_model.equivalents`. Raises
    InputError.
    """
    beside = [] if isinstance(to, str) else [to[1] if isinstance(to, Family) else to]
    chain = read_together([model, *beside], damped=damped)[0]
    point = point_of(chain, values)
    others = chains_of(to, chain)
    if others[0].quantity is not chain.quantity:
        raise InputError(
            f"the quantities differ: {chain.quantity.value} and {others[0].quantity.value}; choose"
            " one for both"
        )
    listings = tuple(
        listing
        for other in others
        for listing in (
            (_under(bench, point) for bench in benches(chain, other, also))
            if also
            else (_listing(chain, point, other),)
        )
    )
    fractions = {name: Fraction(int(v.p), int(v.q)) for name, v in point.items()}
    special_damping = chain.n_masses > 2 and common_ratio(chain, point) is not None
    return Equivalents(
        name=name_of(chain),
        chain=chain,
        values=fractions,
        listings=listings,
        proportional=special_damping,
        experiments=tuple(_text(e) for e in (Experiment(), *also)) if also else (),
    )


def _text(item: str | Experiment) -> str:
    return (parse_experiment(item).experiment if isinstance(item, str) else item).text


@dataclass(frozen=True, slots=True)
class _Found:
    """Solutions that fit one experiment: exact images, and solutions with their origin."""

    given: Chain
    other: Chain
    fibre: Fibre
    exact: tuple[Image, ...]
    others: tuple[tuple[Solution, Origin], ...]

    @property
    def is_complete(self) -> bool:
        """True if there are no further solutions."""
        return _is_complete(self.fibre)


def _find_solutions(chain: Chain, point: Point, other: Chain) -> _Found:
    fibre = _fibre(chain, point, other)
    exact = [i for i in images(chain, point) if i.chain == other]
    others = [(s, Origin.SYNTHESIS) for s in _others(fibre, exact)]
    if fibre.status is Status.DEGENERATE:
        lifted = _unlike(proportional_solutions(chain, point, other), exact)
        others += [(s, Origin.PROPORTIONAL) for s in lifted]
    return _Found(chain, other, fibre, tuple(exact), tuple(others))


def _listing(chain: Chain, point: Point, other: Chain) -> Listing:
    search = _find_solutions(chain, point, other)
    members = _members(search, point)
    cause = special(chain, point) if search.fibre.status is Status.DEGENERATE else ""
    text = sentence(search.fibre, len(members), cause)
    return Listing(name_of(other), other, search.fibre.status, members, search.is_complete, text)


def _members(search: _Found, point: Point) -> tuple[Equivalent, ...]:
    own_equivalents = [_from_theorem(search.given, point, image) for image in search.exact]
    others = [_from_solution(search.given, point, search.other, *each) for each in search.others]
    return tuple(sorted([*own_equivalents, *others], key=_order))


def _under(bench: Bench, point: Point) -> Listing:
    """Listing of the models that keep the responses of all experiments, from the first list that is
    complete.
    """
    tried: list[_Found] = []
    for own_chain, other_chain in bench.alone:
        tried.append(_find_solutions(own_chain, point, other_chain))
        if tried[-1].is_complete:
            break
    search = next((f for f in tried if f.is_complete), tried[0])
    plain = {name: value for name, value in point.items() if name != "Td"}
    kept = replace(
        search,
        exact=tuple(i for i in search.exact if bench.agrees(plain, _plain(i.values))),
        others=tuple((s, o) for s, o in search.others if bench.agrees(plain, _plain(s.values))),
    )
    other = bench.other.chain
    members = tuple(_everywhere(m, bench, plain) for m in _members(kept, point))
    text = under_all(search.fibre, len(members), search.is_complete)
    return Listing(
        name_of(other), other, search.fibre.status, members, search.is_complete, text, bench.places
    )


def _everywhere(member: Equivalent, bench: Bench, point: Point) -> Equivalent:
    """The member with what all responses differ by."""
    rounded = bench.deviation(point, _plain(_read(member.text)))
    residual = max(member.residual, rounded) if member.residual else 0.0
    return replace(member, chain=bench.other.chain, residual=residual)


def _plain(values: Mapping[str, Any]) -> dict[str, Any]:
    """Without the dead time, which belongs to both models or to none."""
    return {name: value for name, value in values.items() if name != "Td"}


def _is_complete(the_fibre: Fibre) -> bool:
    return the_fibre.status in (Status.COMPLETE, Status.EMPTY) and not the_fibre.tests.boundary


def _fibre(chain: Chain, point: Point, other: Chain) -> Fibre:
    """The synthesis, where it applies; a dead time is no rational function and belongs to both
    models or to none.
    """
    if chain.dead_time != other.dead_time:
        return Fibre(Status.EMPTY, reason="only one of them has a dead time")
    plain = replace(other, dead_time=False)
    plain_values = {name: point[name] for name in chain.parameters if name != "Td"}
    the_fibre = fibre(plain, target(chain.structure, plain_values), confirm=False)
    why = obstacle(chain, other)
    if the_fibre.status is Status.DEGENERATE and why:
        return Fibre(Status.NOT_COVERED, reason=why)
    late = {"Td": acb(point["Td"])} if other.dead_time else {}
    return replace(
        the_fibre,
        solutions=tuple(replace(s, values={**s.values, **late}) for s in the_fibre.solutions),
    )


def _others(the_fibre: Fibre, exact: list[Image]) -> list[Solution]:
    """The solutions that no theorem gives. Raises ContradictionError if a list that should be
    complete lacks one that is.
    """
    rest = _unlike(the_fibre.solutions, exact)
    lacking = len(the_fibre.solutions) - len(rest) < len(exact)
    if lacking and _is_complete(the_fibre):
        raise ContradictionError("a complete list of equivalents lacks one that a theorem gives")
    return rest


def _unlike(solutions: Iterable[Solution], exact: list[Image]) -> list[Solution]:
    """One solution less for each exact one that it may be; members of families are kept."""
    rest = list(solutions)
    for image in exact:
        same = [
            s
            for s in rest
            if not s.gauges and all(s.values[n].overlaps(acb(v)) for n, v in image.values.items())
        ]
        rest = [s for s in rest if not same or s is not same[0]]
    return rest


def _from_theorem(chain: Chain, point: Point, image: Image) -> Equivalent:
    origin = (
        Origin.GIVEN
        if not image.steps
        else Origin.DUALITY
        if DUALITY in image.steps
        else Origin.RENAMING
    )
    exact = {name: Fraction(int(v.p), int(v.q)) for name, v in image.values.items()}
    text = {name: f"{float(v):.15g}" for name, v in exact.items()}
    rounded = any(Fraction(text[name]) != value for name, value in exact.items())
    residual = difference(chain, point, image.chain, _read(text)) if rounded else 0.0
    return Equivalent(
        image.chain, _floats(text), text, exact, Signs.POSITIVE, origin, residual, 0.0
    )


def _from_solution(
    chain: Chain, point: Point, other: Chain, solution: Solution, origin: Origin
) -> Equivalent:
    real = solution.real is not Answer.NO
    text = {name: _round_value(v, real) for name, v in solution.values.items()}
    residual = difference(chain, point, other, _read(text))
    unknown = Answer.UNKNOWN
    proven = solution.real is not unknown and not (real and solution.positive is unknown)
    bound = difference(chain, point, other, solution.values)
    signs, values = _signs(solution, real), _floats(text)
    errors = residual, bound, solution.gauges
    return Equivalent(other, values, text, {}, signs, origin, *errors, proven)


def _signs(solution: Solution, real: bool) -> Signs:
    if not real:
        return Signs.COMPLEX
    return Signs.POSITIVE if all(v.real.mid() > 0 for v in solution.values.values()) else Signs.REAL


def _round_value(value: Any, real: bool) -> str:
    if real:
        return f"{float(value.real.mid()):.15g}"
    return f"{float(value.real.mid()):.15g}{float(value.imag.mid()):+.15g}j"


def _floats(text: Mapping[str, str]) -> dict[str, float | complex]:
    return {name: complex(t) if t.endswith("j") else float(t) for name, t in text.items()}


def _read(text: Mapping[str, str]) -> dict[str, Any]:
    """The values in the texts, as balls around exactly these decimals."""
    return {name: _ball(t) for name, t in text.items()}


def _ball(text: str) -> Any:
    value = complex(text) if text.endswith("j") else float(text)
    if isinstance(value, float):
        return _decimal(text)
    return acb(*(_decimal(f"{part:.15g}") for part in (value.real, value.imag)))


def _decimal(text: str) -> Any:
    exact = Fraction(text)
    return arb(fmpq(exact.numerator, exact.denominator))


def _order(member: Equivalent) -> tuple[int, bool, list[tuple[float, float]]]:
    """Positive ones first, exact ones before others, then by value."""
    numbers = [(complex(v).real, complex(v).imag) for v in member.values.values()]
    return list(Signs).index(member.signs), not member.exact, numbers
