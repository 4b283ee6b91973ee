"""Checks of the evidence for verdicts on two general models (recomputed from scratch), and its
certainty.
"""

from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from math import isclose

from disting.conditions.rule import EXACT, Finding, Outcome
from disting.decide import Of, check, deciders_of
from disting.evidence.decision import Theorem
from disting.evidence.general import (
    UNCOUNTED,
    Constants,
    Inequality,
    Witnesses,
)
from disting.evidence.ideals import Refutation, Solutions
from disting.evidence.kind import Kind, SampledPair, samples_of
from disting.evidence.kinds import Evidence
from disting.fibres.ideals import Limits, find_again
from disting.general import fibre_lists, newton
from disting.general.admissible import are_one_ports
from disting.general.any_model import is_renamed, is_writable, maps_of
from disting.general.combination import excludes
from disting.general.equivalent import spell
from disting.general.inequalities import excludes_around, is_contradiction
from disting.general.interlacing import sets_of
from disting.general.matrix_model import AnyModel, Model
from disting.general.model_inclusions import numberings
from disting.general.network_model import behaviour_of
from disting.general.replacement import same_in_units
from disting.general.target import Values
from disting.general.which_models import ways_by_all
from disting.general.witnesses import solutions_at
from disting.model.question import Domain, Settings
from disting.questions.same.exact import by_labels

# relative: so far from values of 6 digits are those found again on some curves, half of it in
# families that are shipped
ROUNDED = 1e-2
AGAIN = Limits(seconds=600.0, entries=40_000_000, safety=1)  # of a contradiction found again


def confirms_models(
    evidence: Evidence, left: AnyModel, right: AnyModel, representation: str = "tf"
) -> bool:
    """Return True if the evidence holds: summaries are computed at fresh points; renamings,
    solutions and formulas are substituted into the transfer functions; contradictions and the cases
    that the formulas cover, or that are closed, are found again.

    Raises NotSeenError where a contradiction takes too long.
    """
    pair = SampledPair(
        left=samples_of(behaviour_of(left)),
        right=samples_of(behaviour_of(right)),
        renames=partial(is_renamed, left, right),
        found_again=partial(_found_again, left=left, right=right),
        numberings=lambda left_is_part: numberings(
            *((left, right) if left_is_part else (right, left))
        ),
    )
    return evidence.holds(pair, representation)


def _found_again(evidence: Kind, left: AnyModel, right: AnyModel) -> bool:
    """Recompute the evidence of the exact decision, or of the decision over real and positive
    parameters.
    """
    return check(evidence, deciders_of(Of.NETWORKS), left, right)


def check_ideal(evidence: Solutions | Refutation, left: AnyModel, right: AnyModel) -> bool:
    """Solutions put into all functions, contradictions found again."""
    # normalised coordinates are those of a chain
    return not evidence.is_normalised and find_again(evidence, *maps_of(left, right), AGAIN)


def check_gears(evidence: Theorem, left: AnyModel, right: AnyModel) -> bool:
    """One machine in other units, those behind gears."""
    return same_in_units(left, right)


def check_sets(evidence: Theorem, left: AnyModel, right: AnyModel) -> bool:
    """Networks that give the same set of functions by a theorem of this name."""
    if not (is_writable(left) and is_writable(right)):
        return False
    given_set = sets_of(left).get(evidence.name)
    return given_set is not None and given_set == sets_of(right).get(evidence.name)


def check_one_ports(evidence: Theorem, left: AnyModel, right: AnyModel) -> bool:
    """One-ports of one kind and order."""
    return are_one_ports(left, right)


def recheck_labels(
    evidence: Solutions | Refutation, left: AnyModel, right: AnyModel, settings: Settings
) -> Finding:
    """Of ideals the labels are drawn again."""
    return by_labels(evidence, *maps_of(left, right), settings.seed)


def check_constants(evidence: Constants, left: AnyModel, right: AnyModel) -> bool:
    """Return True if these are constants of both models that differ, by their exact values."""
    sides = [behaviour_of(model).constants(None) for model in (left, right)]
    stated = (evidence.left, evidence.right)
    constants = [tuple(map(side.get, evidence.labels)) for side in sides]
    differ = all(a != b for a, b in zip(*constants, strict=True))
    is_known = all(label in side for side in sides for label in evidence.labels)
    return bool(evidence.labels) and is_known and tuple(constants) == stated and differ


def confirms(evidence: Witnesses, left: AnyModel, right: AnyModel) -> bool:
    """Return True if both points, and all parameters near them, have the stated properties (the
    search is repeated), and the equivalent and the number of solutions are those of these points.

    Points with a zero are refused: signs are those of parameters without zeros (see `orthant`).
    """
    domain = Domain(evidence.domain)
    sides = {True: (left, right), False: (right, left)}
    first, second = sides[evidence.with_left_given], sides[evidence.without_left_given]
    points = (evidence.point_with, evidence.point_without, evidence.equivalent)
    names = [tuple(name for name, _ in point) for point in points]
    if [*map(sorted, names[:2])] != [sorted(first[0].parameters), sorted(second[0].parameters)]:
        return False
    if names[2] != first[1].parameters or not all(map(_is_rounded, evidence.equivalent)):
        return False
    try:
        with_, without, near = ({name: Fraction(x) for name, x in point} for point in points)
    except (ValueError, ZeroDivisionError):
        return False  # no numbers
    values = [x for point in (with_, without, near) for x in point.values()]
    if 0 in values or (domain is Domain.POSITIVE and min(values) < 0):
        return False
    return (
        evidence.solutions in (UNCOUNTED, solutions_at(*second, evidence.point_without))
        and _has(*first, with_, tuple(map(float, near.values())), domain)
        and _has_none(*second, without, domain)
    )


def _is_rounded(value: tuple[str, str]) -> bool:
    """Return True if a value is written as `spell` writes it."""
    try:
        return spell(float(value[1])) == value[1]
    except ValueError:
        return False


def _has(
    model: AnyModel, other: AnyModel, values: Values, stated: tuple[float, ...], domain: Domain
) -> bool:
    """Return True if the stated values are the equivalent (rounded) of a point around which all
    points have some.
    """
    return any(
        found and all(isclose(x, y, rel_tol=ROUNDED) for x, y in zip(found, stated, strict=True))
        for found in _equivalents(model, other, values, stated, domain)
    )


def _equivalents(
    model: AnyModel, other: AnyModel, values: Values, near: tuple[float, ...], domain: Domain
) -> Iterator[tuple[float, ...] | None]:
    """Yield what each search finds: first what is near values stated."""
    if domain is Domain.POSITIVE:
        yield newton.find_equivalent(model, values, other, near)
        yield fibre_lists.find_equivalent(model, values, other)
    for way in ways_by_all(model, other, domain):
        yield way.having(values)


def _has_none(model: AnyModel, other: AnyModel, values: Values, domain: Domain) -> bool:
    if domain is Domain.POSITIVE:
        pair = [m for m in (model, other) if isinstance(m, Model)]
        if any(
            len(pair) == 2 and shown(pair[0], values, pair[1])
            for shown in (excludes_around, excludes)
        ):
            return True
        if fibre_lists.has_no_equivalent(model, values, other):
            return True
    return any(way.lacking(values) for way in ways_by_all(model, other, domain))


def check_inequalities(evidence: Inequality | Witnesses, left: AnyModel, right: AnyModel) -> bool:
    """The signs of a form, or both points."""
    if isinstance(evidence, Inequality):
        return is_inequality(evidence, left, right)
    return confirms(evidence, left, right)


def is_inequality(evidence: Inequality, left: AnyModel, right: AnyModel) -> bool:
    """Return True if the form has these signs."""
    model, other = (left, right) if evidence.left_given else (right, left)
    if not (isinstance(model, Model) and isinstance(other, Model)):
        return False
    return evidence.domain == Domain.POSITIVE and is_contradiction(evidence.form, model, other)


def constants_finding(left: AnyModel, right: AnyModel) -> Finding:
    """Transfer functions without parameters: unequal numbers, known exactly, distinguish the
    models.
    """
    values = [behaviour_of(model).constants(None) for model in (left, right)]
    differing = tuple(
        label for label, x in values[0].items() if label in values[1] and x != values[1][label]
    )
    if not differing:
        return Finding(
            EXACT,
            Outcome.INAPPLICABLE,
            note="equal constant transfer functions are found by condition 7",
        )
    evidence = Constants(differing, *(tuple(v[x] for x in differing) for v in values))
    return Finding(EXACT, Outcome.FAILS, evidence=evidence)
