"""Inclusion that the elements of two models show by themselves: one is the other with elements
missing, or has a dead time that the other one lacks.

The receptance of a chain with a gap is the sum of those of its rows, each between its own two
ports. By reciprocity it does not matter which of them is the force's, nor which row is which: force
and sensor cross the gap in the same sense. So ports of the whole may stand at those of the part in
eight ways.
"""

from collections.abc import Iterator
from itertools import product

from disting.algebra.certainty import Certainty
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.evidence.limits import LargerProjection, MissingElements
from disting.model.chain import Chain
from disting.model.minors import is_minor, minors

Ports = tuple[tuple[int, int], ...]
"""(node of the whole, node of the part)."""


def by_elements(small: Chain, large: Chain, left_is_smaller: bool) -> InclusionFinding | None:
    """A chain, of one sensor quantity, of smaller rank in another one; None if elements do not
    tell.
    """
    if small.dead_time and not large.dead_time:
        return without_dead_time(left_is_smaller)
    if len(small.parameters) >= len(large.parameters):
        return None
    elements = (
        places
        for ports in _ways(small, large)
        for places in minors(small.structure, large.structure, dict(ports))
    )
    places = next(elements, None)
    return None if places is None else missing(places, left_is_smaller)


def missing(places: dict[int, int], left_is_part: bool) -> InclusionFinding:
    """The part is a limit of the whole, its masses at these places."""
    numbering = tuple(sorted((at, i) for i, at in places.items()))
    evidence = MissingElements(left_is_part, numbering)
    inclusion = Inclusion.LEFT_IN_RIGHT if left_is_part else Inclusion.RIGHT_IN_LEFT
    return InclusionFinding(inclusion, Certainty.THEOREM, evidence=evidence)


def without_dead_time(left_is_smaller: bool) -> InclusionFinding:
    """The model of smaller rank alone has a dead time."""
    ranks = (1, 0) if left_is_smaller else (0, 1)
    return InclusionFinding(
        Inclusion.NEITHER, Certainty.PROVEN, evidence=LargerProjection(("Td",), *ranks)
    )


def confirms_missing(evidence: MissingElements, left: Chain, right: Chain) -> bool:
    """Whether the numbering makes the part of the whole, ports included."""
    part, whole = (left, right) if evidence.left_is_part else (right, left)
    places = {i: at for at, i in evidence.numbering}
    ways = (all(places.get(i) == at for i, at in ports) for ports in _ways(part, whole))
    whole_numbering = len(places) == len(evidence.numbering)
    return whole_numbering and any(ways) and is_minor(part.structure, whole.structure, places)


def _ways(part: Chain, whole: Chain) -> Iterator[Ports]:
    """Yield where the four ports of the whole may stand."""
    plus, minus = (part.act_plus, part.meas_plus), (part.act_minus, part.meas_minus)
    mine = (whole.act_plus, whole.meas_plus, whole.act_minus, whole.meas_minus)
    for (first, second), turned, again in product(((plus, minus), (minus, plus)), (1, -1), (1, -1)):
        ports = tuple(zip(mine, (*first[::turned], *second[::again]), strict=True))
        if len(dict(ports)) == len(set(ports)):
            yield ports
