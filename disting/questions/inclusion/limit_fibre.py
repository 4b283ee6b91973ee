"""Limits of the rows of a larger chain, and then a fibre: whether what results contains a smaller
chain in its closure.

What results is a model of one or two rows, not always a chain: both rows may be free. Whether
generic models of the smaller chain are such models is decided by the ideal of one fibre
(`disting.fibres.ideals.membership`), with its error bound.

A solution for a given model of what results shows only that this lies in the smaller chain's
closure. Both are equal if their ranks are. Ranks found at points are lower bounds: so equality is
proven where the smaller chain's rank cannot exceed the rank found, being the number of its
parameters or of its coefficients; else such a solution proves nothing here.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, islice, product
from math import ceil, log2

from disting.algebra.certainty import LEAST_SAFETY
from disting.behaviour.chain_model import powers
from disting.evidence.ideals import Refutation, Solutions
from disting.fibres.ideals import Decision, Limits, coefficient_map, decide, holds_for
from disting.model.chain import Chain, Damper, Element, Mass, Ports, Sensor, Spring, Structure
from disting.model.question import Membership
from disting.model.row import Row, canonical_rows
from disting.questions.inclusion.limits import Step, follows, least_rank, most_rank, reach

LIMITS = Limits(seconds=60.0, entries=30_000, safety=104)  # of the ideal of one fibre
MODELS = 12  # that are tried for a pair
RowSteps = tuple[tuple[str, tuple[Step, ...]], ...]


@dataclass(frozen=True, slots=True)
class Containment:
    """The steps of each row of the larger chain by name, a solution of the fibre of what
    results, and its error bound.
    """

    steps: RowSteps
    solved: Solutions
    safety: int


def find_containment(small: Chain, large: Chain, seed: str) -> Containment | None:
    """A way from the larger chain to models among which those of the smaller one are; None if
    none is found.
    """
    if any(c.lag or c.ground_dampers for c in (small, large)):
        return None
    target = position(small)
    for steps, rows in islice(_results(target, large), MODELS):
        decided = _decide_rows(target, join(rows), seed)
        safety = decided.safety - ceil(log2(MODELS))  # any of the models tried may mislead
        solved = decided.evidence
        if (
            decided.membership is not Membership.MEMBER
            or not isinstance(solved, Solutions)
            or safety < LEAST_SAFETY
        ):
            continue
        if tells(solved, target, join(rows), seed) and _follow(
            steps, rows, canonical_rows(large.structure)
        ):
            return Containment(steps, solved, safety)
    return None


def contains(small: Chain, large: Chain, steps: RowSteps, solved: Solutions) -> bool:
    """Return True if the limits hold and the solutions are solutions, for models of the smaller
    chain or for ranks proven equal.
    """
    target, rows_of_large = position(small), canonical_rows(large.structure)
    names = {name for name, _ in steps}
    if not names or len(names) < len(steps) or not names <= rows_of_large.keys():
        return False
    ends = product(*(follows(rows_of_large[name], path) for name, path in steps))
    return any(_holds(target, join(rows), solved) for rows in ends if _fit(rows))


def position(chain: Chain) -> Structure:
    """The chain's structure with a sensor of position, without dead time."""
    return replace(chain, sensor=Sensor.POSITION, dead_time=False).structure


def join(rows: Sequence[Row]) -> Structure:
    """The model of one or two rows, only the first of which may have a wall; its receptance is
    the sum of theirs.
    """
    first, size = rows[0].n_masses, sum(row.n_masses for row in rows)
    placed = list(zip(rows, (0, first), strict=False))
    elements: list[Element] = [Mass(i) for i in range(1, size + 1)]
    elements += [Spring(i + at) for row, at in placed for i in row.joints]
    elements += [Damper(i + at) for row, at in placed for i in row.joints if row.damped]
    minus, plus = (0, 0), rows[0].ports
    if len(rows) > 1:
        minus, plus = plus, (first + rows[1].a, first + rows[1].b)
    return Structure(size, tuple(elements), Ports(minus[0], plus[0], minus[1], plus[1]), 0)


def _results(target: Structure, large: Chain) -> Iterator[tuple[RowSteps, tuple[Row, ...]]]:
    """Limits of the rows with the powers of s of the smaller chain and at least its rank."""
    ways = [
        [(name, below, path) for below, path in reach(row).items()]
        for name, row in canonical_rows(large.structure).items()
    ]
    for chosen in (
        c
        for count in range(1, len(ways) + 1)
        for some in combinations(ways[::-1], count)
        for c in product(*some)
    ):
        rows = tuple(below for _, below, _ in chosen)
        if (
            _fit(rows)
            and powers(join(rows)) == powers(target)
            and least_rank(join(rows)) >= least_rank(target)
        ):
            yield tuple((name, path) for name, _, path in chosen), rows


def _fit(rows: Sequence[Row]) -> bool:
    """Return True if the model of these rows can be written: only the first one has a wall, and no
    damper to the ground remains.
    """
    return not any(row.grounded for row in rows[1:]) and not any(row.ground_dampers for row in rows)


def _decide_rows(
    target: Structure, result: Structure, seed: str
) -> Decision[Solutions | Refutation]:
    equal = least_rank(target) == least_rank(result)
    return decide(
        *map(coefficient_map, (target, result)), equal_rank=equal, seed=seed, limits=LIMITS
    )


def _holds(target: Structure, result: Structure, solved: Solutions) -> bool:
    is_solved = tells(solved, target, result, "verify") and not solved.is_normalised
    return is_solved and holds_for(solved, coefficient_map(target), coefficient_map(result))


def tells(solved: Solutions, target: Structure, result: Structure, seed: str) -> bool:
    """Return True if the solution shows that generic models of the target are among the resulting
    ones, or limits of them.
    """
    return solved.left_given or most_rank(target) <= least_rank(result, seed)


def _follow(steps: RowSteps, rows: Sequence[Row], rows_by_name: dict[str, Row]) -> bool:
    """Return True if each of the limits is an identity."""
    return all(
        row in follows(rows_by_name[name], path)
        for row, (name, path) in zip(rows, steps, strict=True)
    )
