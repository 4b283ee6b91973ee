"""Whether models that agree over complex parameters agree over real or positive ones: always,
never or for some.

What is known each way (see `ways`) is put together: INDISTINGUISHABLE if all generic parameters of
either model have an equivalent in the other one; DISTINGUISHABLE if those of one have none, and so
no admissible parameters agree, but for thin sets; SOMETIMES if in an open set there is an
equivalent, and in another one, of either model, there is none (see `witnesses`). All of it is
proven.
"""

from itertools import islice

from disting.algebra.certainty import Certainty
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE
from disting.errors import ContradictionError
from disting.evidence.decision import Theorem
from disting.evidence.general import Explicit, Inequality, NoEquivalent, Witnesses
from disting.general.formulas import explicit, fit
from disting.general.matrix_model import AnyModel
from disting.general.model import Model
from disting.general.one_ports import same_one_ports
from disting.general.orthant import THOROUGH, Effort
from disting.general.which_models import Way, way
from disting.general.witnesses import (
    Example,
    by_inequalities,
    by_lists,
    by_numbers,
    common_point,
    example,
    points,
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


def admissible_finding(
    left: AnyModel, right: AnyModel, domain: Domain, seed: str, effort: Effort = THOROUGH
) -> Finding:
    """HOLDS, FAILS or SOMETIMES with its evidence, or ABANDONED with what was seen. Lists of all
    equivalents of points cost milliseconds, so a few come first.
    """
    size = max(len(m.parameters) for m in (left, right))
    if domain is Domain.POSITIVE:
        evidence = by_inequalities(left, right, FEW) if size > MANY else None
        evidence = evidence or by_lists(left, right, seed, FIRST)
        if evidence is None and size > SMALL:
            evidence = by_numbers(left, right, seed, FIRST, effort.degree)
        if evidence:
            return _shown(evidence)
    first = way(left, right, domain, effort)
    second = None if first and first.never else way(right, left, domain, effort)
    finding = of_ways(left, right, (first, second), domain, seed, effort)
    if domain is not Domain.POSITIVE or finding.outcome is not Outcome.ABANDONED:
        return finding
    # a brief search of many values has asked for them first, and asks no longer
    was_brief = effort.unknowns is not None and size > effort.unknowns
    evidence = None if was_brief else by_inequalities(left, right)
    return _shown(evidence) if evidence else finding


def of_ways(
    left: AnyModel,
    right: AnyModel,
    ways: Ways,
    domain: Domain,
    seed: str,
    effort: Effort = THOROUGH,
) -> Finding:
    """The finding from what is known each way; raises ContradictionError where that cannot all
    be true.
    """
    never = next((i for i, side in enumerate(ways) if side and side.never), None)
    if never is not None:
        _refuse_equivalents(ways, domain, seed)
        return _never(ways, never, domain)
    if all(side and side.covering for side in ways):
        return _always(explicit(ways, left, right, domain, effort), left, right)
    if domain is Domain.POSITIVE and are_one_ports(left, right):
        return Finding(
            ADMISSIBLE, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem("Foster and Cauer")
        )
    having, lacking, shares = _seen(ways, domain, seed, effort.points)
    if lacking and not having and domain is Domain.POSITIVE:
        having = common_point(left, right)
    if lacking and (side := ways[0 if lacking[0] else 1]) and side.path():
        raise ContradictionError(
            f"a root gives equivalents of all {side.given.name}, and {dict(lacking[1])} has none"
        )
    if having and lacking:
        return _shown(witnesses_of(left, right, having, lacking, domain))
    if not lacking and (formulas := explicit(ways, left, right, domain, effort)):
        return _always(formulas, left, right)
    if domain is Domain.POSITIVE:
        evidence = by_lists(left, right, seed, effort.listed) or by_numbers(
            left, right, seed, effort.listed, effort.degree, having
        )
        if evidence:
            return _shown(evidence)
    note = (
        f"an equivalent with {domain} parameters was found {shares}, which proves nothing of the"
        " others"
    )
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note=note)


def are_one_ports(left: AnyModel, right: AnyModel) -> bool:
    """Whether both are one-ports that give any impedance of their kind, one input and output each
    (see `one_ports`).
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


def _seen(
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
                having.append(example(left_given, values, this_way.other, the_values))
            elif not always and this_way.lacking(values):
                lacking.append(example(left_given, values))
            if having and lacking:
                return having[0], lacking[0], ""
        share = f"{count} of {count_of} random" if this_way.looked_at else "no"
        lost = this_way.not_looked_at
        shares.append(f"at {share} points of {this_way.given.name}{lost and f' ({lost})'}")
    return next(iter(having), None), next(iter(lacking), None), " and ".join(shares)


def _shown(evidence: Inequality | Witnesses) -> Finding:
    outcome = Outcome.FAILS if isinstance(evidence, Inequality) else Outcome.SOMETIMES
    return Finding(ADMISSIBLE, outcome, Certainty.PROVEN, evidence=evidence)
