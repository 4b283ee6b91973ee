"""Existence of an admissible equivalent of the given models in another one: for all, none, or some;
each with its proof.

ALWAYS: sections cover all generic p, or a path gives a root for every p (`sections`,
`intermediate_value`), or as many roots for all p as for one (`counts`). NEVER: no case is left
(`cases`), or none that has a root. Points with and without equivalents in open sets around them are
searched with `robust`.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

from disting.general.cases import orders, search_cases
from disting.general.counts import at_roots, number_of_roots
from disting.general.elimination import Case
from disting.general.intermediate_value import Path, by_count, odd_path, path, without_equations
from disting.general.matrix_model import AnyModel
from disting.general.orthant import BRIEF, THOROUGH, Effort, Orthant, TooMuch
from disting.general.robust import (
    CaseSearch,
    ParameterValues,
    find_equivalent,
    has_no_equivalent,
    searched_cases,
)
from disting.general.sections import Section, cover, sections, sign_on
from disting.general.target import Values
from disting.model.question import Domain

FEW = 5  # orders of the unknowns


@dataclass(frozen=True, slots=True)
class Way:
    """The equivalents of `given` in `other`; `covering`: sections such that every generic p
    lies in one.
    """

    given: AnyModel
    other: AnyModel
    parted: CaseSearch
    covering: tuple[Section, ...]

    @property
    def never(self) -> bool:
        """True if no case remains."""
        return not self.parted.sections and not self.parted.others

    @property
    def closed(self) -> tuple[str, ...]:
        """Contradictions in closed cases, each once."""
        return tuple(dict.fromkeys(self.parted.search.closed))

    def path(self) -> Path | None:
        """A root that gives an equivalent for every generic p, if one that is tried does before
        a polynomial is too large.
        """
        ring = self.parted.search.ring
        tried = odd_path if ring.domain is Domain.REAL else path
        return _first(ring, self.parted.others, tried) or _first(ring, self.parted.others, by_count)

    @property
    def looked_at(self) -> int:
        """Number of cases of the search in which equivalents of a point are searched."""
        return searched_cases(self.parted)

    @property
    def not_looked_at(self) -> str:
        """Why an equivalent of a point may be missed, or "" if all cases are searched."""
        cases = len(self.parted.sections) + len(self.parted.others)
        return (
            ""
            if self.looked_at == cases
            else f"{cases - self.looked_at} of {cases} cases have too many unknowns for a search"
        )

    def having(self, values: Values) -> tuple[float, ...] | None:
        """An equivalent (rounded) of a point around which all have some, as far as found."""
        self.parted.search.ring.begin()
        try:
            return find_equivalent(self.parted, self._point(values))
        except TooMuch:
            return None

    def lacking(self, values: Values) -> bool:
        """Return True if no point around this one has an equivalent, as far as found."""
        self.parted.search.ring.begin()
        try:
            return has_no_equivalent(self.parted, self._point(values))
        except TooMuch:
            return False

    def _point(self, values: Values) -> ParameterValues:
        return {i: values[name] for i, name in enumerate(self.given.parameters)}


def _first(
    ring: Orthant, cases: Sequence[Case], tried: Callable[[Orthant, Case], Path | None]
) -> Path | None:
    ring.begin()
    try:
        return next((p for case in cases if (p := tried(ring, case))), None)
    except TooMuch:
        return None


def way(model: AnyModel, other: AnyModel, domain: Domain, effort: Effort = THOROUGH) -> Way | None:
    """Decide one direction, or return None if the search grew too large. Both models have the same
    degrees.

    Unknowns are solved for in several orders, until all cases are sections; else the order with
    the fewest other cases is kept. After a few orders one equation in one unknown is good enough.
    """
    sizes = len(model.parameters), len(other.parameters)
    if effort.unknowns is not None and max(sizes) > effort.unknowns:
        return None
    ring, best = Orthant(*sizes, domain, effort=effort), list[CaseSearch]()
    for count, order in enumerate(islice(orders(ring.unknowns), effort.orders)):
        ring.begin()
        try:
            parted = _split_cases(ring, model, other, order)
        except TooMuch:
            continue
        best = sorted([*best, parted], key=_count_left)[:1]
        if not best[0].others or (count >= FEW and _has_single_roots(best[0])):
            break
    if not best:
        return None
    ring.begin()
    left = _with_roots(best[0])
    return Way(model, other, left, _covering(left))


def ways_by_all(model: AnyModel, other: AnyModel, domain: Domain) -> Iterator[Way]:
    """Yield what is known one way by each effort: what one of them found the other one may not, as
    it solves in another order.
    """
    for effort in (BRIEF, THOROUGH):
        the_way = way(model, other, domain, effort)
        if the_way:
            yield the_way


def _with_roots(parted: CaseSearch) -> CaseSearch:
    """The same without cases that have no root, inequalities as they are at the roots."""
    search, kept = parted.search, list[Case]()
    for left in parted.others:
        case = at_roots(search.ring, left)
        if isinstance(case, str):
            search.closed.append(case)
        elif number_of_roots(search.ring, case) == 0:
            search.closed.append(
                f"{case.equations[0]} = 0 with {' and '.join(f'{g} > 0' for g in case.positive)}"
            )
        else:
            kept.append(case)
    return replace(parted, others=tuple(kept))


def _has_single_roots(parted: CaseSearch) -> bool:
    ring = parted.search.ring
    return all(
        len(c.equations) == len(ring.occurring((*c.equations, *c.positive))) == 1
        for c in parted.others
    )


def _count_left(parted: CaseSearch) -> tuple[int, int]:
    ring = parted.search.ring
    return len(parted.others), sum(
        len(ring.occurring((*c.equations, *c.positive))) for c in parted.others
    )


def _split_cases(
    ring: Orthant, model: AnyModel, other: AnyModel, order: tuple[int, ...]
) -> CaseSearch:
    search = search_cases(ring, model, other, order)
    the_sections, others = list[Section](), list[Case]()
    for case in search.cases:
        if case.equations:
            others.append(case)
        else:
            parts, left = sections(search, case)
            the_sections += parts
            others += left
    return CaseSearch(search, tuple(the_sections), tuple(others), ring.lead(other))


def _covering(parted: CaseSearch) -> tuple[Section, ...]:
    """Sections that cover all generic p, none if these do not or a polynomial is too large.

    At a section lead(q) and, over positive numbers, the values are not zero for generic p (see
    `cases`); it is checked once more.
    """
    ring = parted.search.ring
    ring.begin()
    conditions = [
        parted.lead,
        *(ring.generators[i] for i in ring.unknowns if ring.domain is Domain.POSITIVE),
    ]
    try:
        every = (*parted.sections, *_by_choice(parted))
        good = [s for s in every if not any(sign_on(ring, g, s).is_zero() for g in conditions)]
        return next(((s,) for s in good if not s.where), tuple(good)) if cover(ring, good) else ()
    except TooMuch:
        return ()


def _by_choice(parted: CaseSearch) -> Iterator[Section]:
    """Sections for all p from cases that could not be written as sections wholly."""
    ring = parted.search.ring
    for case in parted.others:
        the_case = without_equations(ring, case) if not case.equations else None
        if the_case:
            yield from sections(parted.search, the_case)[0]
