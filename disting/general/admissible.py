"""Equivalence over real or positive parameters of models that are equivalent over complex ones:
always, never or for some.

The results in both directions (see `ways`) is put together: INDISTINGUISHABLE if all generic
parameters of either model have an equivalent in the other one; DISTINGUISHABLE if those of one have
none, and so no admissible parameters agree, but for thin sets; SOMETIMES if in an open set there is
an equivalent, and in another one, of either model, there is none (see `witnesses`). All of it is
proven.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from disting.algebra.certainty import Certainty
from disting.conditions.rule import ADMISSIBLE, Finding, Outcome
from disting.decide import VALUES_POSITIVE, VALUES_REAL, first_finding
from disting.errors import ContradictionError
from disting.evidence.decision import ONE_PORTS, Theorem
from disting.evidence.general import Explicit, Inequality, NoEquivalent, Witnesses
from disting.general.formulas import explicit, fit
from disting.general.matrix_model import AnyModel, Model
from disting.general.one_ports import same_one_ports
from disting.general.orthant import THOROUGH, Effort
from disting.general.which_models import Way, way
from disting.general.witnesses import (
    Example,
    by_inequalities,
    by_lists,
    by_numbers,
    common_point,
    points,
    with_equivalent,
    without_equivalent,
    witnesses_of,
)
from disting.model.question import Domain

FIRST = 3  # of either model, whose equivalents are all listed or excluded
SMALL = 5  # parameters: formulas for so few come before searches in rounded numbers
MANY = 9  # parameters: elimination of more unknowns seldom ends, so inequalities come before
FEW = 3  # starts of searches for a common point of so many: most find one at once
GUARDS = 4  # of either model, where no equivalents are to be found
TOO_LARGE = "the search for all equivalents grew too large"

Ways = tuple[Way | None, Way | None]


@dataclass(frozen=True)
class ValueSearch:
    """The search for equivalents of two models over a domain, as far as this effort goes; what
    several methods look at is computed once. `known_ways`: where they are known already.
    """

    left: AnyModel
    right: AnyModel
    domain: Domain
    seed: str
    effort: Effort = THOROUGH
    known_ways: Ways | None = None

    @property
    def size(self) -> int:
        """Number of parameters of the larger model."""
        return max(len(m.parameters) for m in (self.left, self.right))

    @cached_property
    def ways(self) -> Ways:
        """Results in both directions; the second one is skipped where the first is "never"."""
        if self.known_ways is not None:
            return self.known_ways
        first = way(self.left, self.right, self.domain, self.effort)
        settled = first and first.never
        return first, None if settled else way(self.right, self.left, self.domain, self.effort)

    @cached_property
    def seen(self) -> tuple[Example | None, Example | None, str]:
        """A point with and one without an equivalent, and the shares of those with one."""
        having, lacking, shares = _search_examples(
            self.ways, self.domain, self.seed, self.effort.points
        )
        if lacking and not having and self.domain is Domain.POSITIVE:
            having = common_point(self.left, self.right)
        return having, lacking, shares


def admissible_finding(
    left: AnyModel, right: AnyModel, domain: Domain, seed: str, effort: Effort = THOROUGH
) -> Finding:
    """HOLDS, FAILS or SOMETIMES with its evidence, or ABANDONED with the partial results."""
    rows = VALUES_POSITIVE.rows if domain is Domain.POSITIVE else VALUES_REAL.rows
    finding: Finding = first_finding(rows, ValueSearch(left, right, domain, seed, effort))
    return finding


def by_first_inequalities(search: ValueSearch) -> Finding | None:
    """Inequalities of models of many parameters, with few starts: before eliminations."""
    found = by_inequalities(search.left, search.right, FEW) if search.size > MANY else None
    return _finding_of(found) if found else None


def by_first_lists(search: ValueSearch) -> Finding | None:
    """Lists of all equivalents of points cost milliseconds, so a few come first."""
    found = by_lists(search.left, search.right, search.seed, FIRST)
    return _finding_of(found) if found else None


def by_first_numbers(search: ValueSearch) -> Finding | None:
    """Searches in rounded numbers at a few points, where formulas are not to be expected."""
    if search.size <= SMALL:
        return None
    found = by_numbers(search.left, search.right, search.seed, FIRST, search.effort.degree)
    return _finding_of(found) if found else None


def by_no_case(search: ValueSearch) -> Finding | None:
    """No generic parameters of one model have an equivalent: all cases are closed. Raises
    ContradictionError where some have one.
    """
    never = next((i for i, side in enumerate(search.ways) if side and side.never), None)
    if never is None:
        return None
    _refuse_equivalents(search.ways, search.domain, search.seed)
    return _never(search.ways, never, search.domain)


def by_covering_maps(search: ValueSearch) -> Finding | None:
    """Sections that cover all generic parameters, both ways. Raises ContradictionError where their
    formulas give other functions.
    """
    if not all(side and side.covering for side in search.ways):
        return None
    return _always(_formulas(search), search.left, search.right)


def by_one_ports(search: ValueSearch) -> Finding | None:
    """One-ports that give any impedance of their kind (see `one_ports`)."""
    if not are_one_ports(search.left, search.right):
        return None
    evidence = Theorem(ONE_PORTS)
    return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=evidence)


def by_witnesses(search: ValueSearch) -> Finding | None:
    """A point with and one without an equivalent, and all around them. Raises ContradictionError
    where a root gives equivalents of all.
    """
    having, lacking, _ = search.seen
    if lacking and (side := search.ways[0 if lacking[0] else 1]) and side.path():
        raise ContradictionError(
            f"a root gives equivalents of all {side.given.name}, and {dict(lacking[1])} has none"
        )
    if not (having and lacking):
        return None
    return _finding_of(witnesses_of(search.left, search.right, having, lacking, search.domain))


def by_maps(search: ValueSearch) -> Finding | None:
    """Formulas for all parameters, where no point without an equivalent was found."""
    formulas = None if search.seen[1] else _formulas(search)
    return _always(formulas, search.left, search.right) if formulas else None


def by_more_lists(search: ValueSearch) -> Finding | None:
    """Lists of all equivalents of as many points as the effort allows."""
    found = by_lists(search.left, search.right, search.seed, search.effort.listed)
    return _finding_of(found) if found else None


def by_more_numbers(search: ValueSearch) -> Finding | None:
    """Searches in rounded numbers at as many points."""
    effort, having = search.effort, search.seen[0]
    found = by_numbers(search.left, search.right, search.seed, effort.listed, effort.degree, having)
    return _finding_of(found) if found else None


def by_all_inequalities(search: ValueSearch) -> Finding | None:
    """Inequalities with all starts. A brief search of many values has tried them first, and does
    not repeat them.
    """
    most = search.effort.unknowns
    was_brief = most is not None and search.size > most
    found = None if was_brief else by_inequalities(search.left, search.right)
    return _finding_of(found) if found else None


def left_open(search: ValueSearch) -> Finding:
    """Partial results, where nothing decides."""
    note = (
        f"an equivalent with {search.domain} parameters was found {search.seen[2]}, which proves"
        " nothing about the others"
    )
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note=note)


def _formulas(search: ValueSearch) -> Explicit | None:
    return explicit(search.ways, search.left, search.right, search.domain, search.effort)


def are_one_ports(left: AnyModel, right: AnyModel) -> bool:
    """Return True if both are one-ports that give any impedance of their kind, one input and output
    each (see `one_ports`).
    """
    if isinstance(left, Model) and isinstance(right, Model):
        return same_one_ports(left, right)
    return False


def _never(ways: Ways, at: int, domain: Domain) -> Finding:
    """No generic parameters have an equivalent, as the way at this place shows."""
    this_way = ways[at]
    closed = this_way.closed if this_way else ()
    evidence = NoEquivalent(domain.value, at == 0, closed)
    return Finding(ADMISSIBLE, Outcome.FAILS, Certainty.PROVEN, evidence=evidence)


def _refuse_equivalents(ways: Ways, domain: Domain, seed: str) -> None:
    """Raise ContradictionError if one model has equivalents although the other has none: they
    would be equivalents of it.
    """
    for side in ways:
        if side and (
            side.covering
            or side.path()
            or any(map(side.having, islice(points(side.given, domain, seed), GUARDS)))
        ):
            raise ContradictionError(
                f"{side.given.name} has equivalents in {side.other.name}, which has none in it"
            )


def _always(evidence: Explicit | None, left: AnyModel, right: AnyModel) -> Finding:
    if evidence is None or not fit(evidence, left, right):
        raise ContradictionError(
            f"a formula for {left.name} and {right.name} gives another transfer function"
        )
    return Finding(ADMISSIBLE, Outcome.HOLDS, Certainty.PROVEN, evidence=evidence)


def _search_examples(
    ways: Ways, domain: Domain, seed: str, count_of: int
) -> tuple[Example | None, Example | None, str]:
    """A point with and one without an equivalent, of either model, and the shares of those with
    one.
    """
    having, lacking, shares = list[Example](), list[Example](), list[str]()
    for left_given, this_way in zip((True, False), ways, strict=True):
        if this_way is None:
            shares.append(
                f"at no points of the {'left' if left_given else 'right'} model ({TOO_LARGE})"
            )
            continue
        count, always = 0, bool(this_way.covering)
        for values in islice(points(this_way.given, domain, seed), count_of):
            the_values = this_way.having(values)
            count += bool(the_values)
            if the_values:
                having += with_equivalent(
                    left_given, this_way.given, values, this_way.other, the_values
                )
            elif not always and this_way.lacking(values):
                lacking.append(without_equivalent(left_given, values))
            if having and lacking:
                return having[0], lacking[0], ""
        share = f"{count} of {count_of} random" if this_way.looked_at else "no"
        lost = this_way.not_looked_at
        shares.append(f"at {share} points of {this_way.given.name}{lost and f' ({lost})'}")
    return next(iter(having), None), next(iter(lacking), None), " and ".join(shares)


def _finding_of(evidence: Inequality | Witnesses) -> Finding:
    outcome = Outcome.FAILS if isinstance(evidence, Inequality) else Outcome.SOMETIMES
    return Finding(ADMISSIBLE, outcome, Certainty.PROVEN, evidence=evidence)
