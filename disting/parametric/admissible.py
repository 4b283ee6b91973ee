"""Whether models that agree over complex parameters agree over real or positive ones: points with and without an equivalent.

Random rational points of either model are taken and their fibres solved exactly. A point p with an admissible equivalent q
shows the same for the other direction, where q has the equivalent p. So one point with and one without, in any directions,
prove that the pair agrees for some admissible parameters only. Special points (a cancellation, two solutions that meet, a zero
parameter) are no witnesses: only points whose fibre is as large as that of any other point seen, and without zeros. Samples
prove nothing else: that all points seen have equivalents, or none has, is reported as what it is, a share of the points.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from time import monotonic

from disting.algebra.sampling import residues
from disting.certainty import Certainty
from disting.conditions.admissible import ADMISSIBLE
from disting.conditions.finding import Finding, Outcome
from disting.conditions.witnesses import Point, Witnesses
from disting.domain import Domain
from disting.errors import InputError
from disting.parametric.alternatives import Alternatives, alternatives
from disting.parametric.certificate import certified
from disting.parametric.equivalent import spelled
from disting.parametric.fibre import Extent
from disting.parametric.model import Model
from disting.parametric.target import rational_values, target

POINTS = 60  # of either model
ORDINARY = 3  # points of one model that are to be seen before one of them is called ordinary
SECONDS = 30.0
SPREADS = (9, 30, 3)  # numerators and denominators: values within a factor of about 9, 30, 3 of 1


@dataclass(frozen=True, slots=True)
class Seen:
    """The alternatives at one point, and of which model it was."""

    left_given: bool
    found: Alternatives


def admissible_finding(left: Model, right: Model, domain: Domain, seed: str, seconds: float = SECONDS) -> Finding:
    """SOMETIMES with both points as evidence, or ABANDONED with the share of points that have an equivalent."""
    seen: list[Seen] = []
    for one in _samples(left, right, domain, seed, monotonic() + seconds):
        seen.append(one)
        having, lacking = (_first(seen, domain, outcome) for outcome in (Outcome.HOLDS, Outcome.FAILS))
        if having and lacking:
            evidence = _witnesses(having, lacking, domain)
            return Finding(ADMISSIBLE, Outcome.SOMETIMES, Certainty.PROVEN, evidence=evidence)
    shares = [f"at {_share(seen, way, domain)} random points of {m.name}" for way, m in ((True, left), (False, right))]
    note = f"an equivalent with {domain} parameters was found {' and '.join(shares)}, which proves nothing of the others"
    return Finding(ADMISSIBLE, Outcome.ABANDONED, note=note)


def confirms(evidence: Witnesses, left: Model, right: Model) -> bool:
    """Whether both points are what they are said to be: their fibres are solved anew, with other linear forms."""
    domain = Domain(evidence.domain)
    sides = {True: (left, right), False: (right, left)}
    here = (*sides[evidence.with_left_given], evidence.point_with)
    there = (*sides[evidence.without_left_given], evidence.point_without)
    return _has_certified(*here, domain) and _lacks(*there, domain)


def _has_certified(given: Model, other: Model, point: Point, domain: Domain) -> bool:
    """An equivalent at this point is put into the transfer function and looked at in intervals."""
    goal = target(given, rational_values(given, dict(point)))
    found = alternatives(given, dict(point), other, seed="confirms").within(domain)
    return _is_inside(point, domain) and any(certified(x, goal, other) for x in found)


def _lacks(given: Model, other: Model, point: Point, domain: Domain) -> bool:
    return _is_inside(point, domain) and alternatives(given, dict(point), other, seed="confirms").exist(domain) is Outcome.FAILS


def _is_inside(point: Point, domain: Domain) -> bool:
    return domain is not Domain.POSITIVE or all(Fraction(value) > 0 for _, value in point)


def points(model: Model, domain: Domain, seed: str) -> Iterator[dict[str, Fraction]]:
    """Yield random rational parameters of a domain, without end, determined by the seed."""
    n, k = len(model.parameters), 0
    while True:
        spread = SPREADS[k % len(SPREADS)]
        tops, bottoms, signs = (
            residues(f"{what}:{seed}:{k}", n, below) for what, below in (("p", spread + 1), ("q", spread + 1), ("sign", 3))
        )
        values = (Fraction(p, q) for p, q in zip(tops, bottoms, strict=True))
        signed = (x if s == 1 or domain is Domain.POSITIVE else -x for x, s in zip(values, signs, strict=True))
        yield dict(zip(model.parameters, signed, strict=True))
        k += 1


def _samples(left: Model, right: Model, domain: Domain, seed: str, deadline: float) -> Iterator[Seen]:
    """Alternatives at points of both models in turn, until the time or the number is up; special points are left out."""
    for pair in islice(zip(*(points(m, domain, f"{seed}:{m.parameters}") for m in (left, right)), strict=True), POINTS):
        for left_given, values in zip((True, False), pair, strict=True):
            remaining = deadline - monotonic()
            if remaining <= 0:
                return
            given, other = (left, right) if left_given else (right, left)
            try:
                yield Seen(left_given, alternatives(given, values, other, seed=seed, seconds=remaining))
            except InputError:  # the leading coefficient vanishes there
                continue


def _witnesses(having: Seen, lacking: Seen, domain: Domain) -> Witnesses:
    equivalent = having.found.within(domain)[0]
    infinite = lacking.found.extent is Extent.FAMILY
    return Witnesses(
        domain.value,
        having.left_given,
        tuple((name, str(x)) for name, x in having.found.values),
        tuple((name, spelled(x)) for name, x in equivalent.values.items()),
        lacking.left_given,
        tuple((name, str(x)) for name, x in lacking.found.values),
        -1 if infinite else len(lacking.found.equivalents),
    )


def _first(seen: list[Seen], domain: Domain, outcome: Outcome) -> Seen | None:
    """The first ordinary point with this outcome."""
    ordinary = (one for way in (True, False) for one in _ordinary([x for x in seen if x.left_given is way]))
    return next((one for one in ordinary if one.found.exist(domain) is outcome), None)


def _ordinary(seen: list[Seen]) -> list[Seen]:
    """Points whose fibres look like a generic one: finite where any is, as large as any finite one, nothing on a boundary."""
    if len(seen) < ORDINARY:
        return []
    largest = max(len(x.found.equivalents) if x.found.extent is Extent.FINITE else 0 for x in seen)
    if not largest:
        return [x for x in seen if x.found.extent is Extent.FAMILY]
    finite = (x for x in seen if x.found.extent is Extent.FINITE and len(x.found.equivalents) == largest)
    return [x for x in finite if all(any(c) for e in x.found.equivalents for c in e.coordinates)]


def _share(seen: list[Seen], way: bool, domain: Domain) -> str:
    outcomes = [x.found.exist(domain) for x in seen if x.left_given is way]
    return f"{outcomes.count(Outcome.HOLDS)} of {len(outcomes)}"
