"""All parameter vectors with the behaviour of one random rational point: how many, which are known
exactly, which are real.

Number of solutions. Let n parameters, all of them determinable, and D = 3 N_B + 2. The pairs (p,
q) of equal transfer functions with all elements of q non-zero have components of degree D^(n+1) at
most (Bezout, see `disting.questions.same.exact`). Off the hypersurface where the projection to p is
not proper (Jelonek 1999), of no larger degree, every solution of a generic point near p0 is near a
solution of p0; where the Jacobian there is injective (a Krawczyk step proves it) only one is. So a
generic point has no more solutions than were listed. Off the images of the components that do not
dominate, of no larger degree either, no fewer than those proven to exist. Schwartz and Zippel
bound the probability that p0 lies on either hypersurface.

Exactly known are the point itself, its renamings by symmetries of the chain onto itself, and, if
the chain is its own dual, the dual points. The others exist if as many coefficients as parameters
are not constant, since a Krawczyk step then proves all equations, or if the synthesis has no
tests.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import comb

from flint import acb, fmpq

from disting.algebra.certainty import Certainty, Grade, about
from disting.errors import ContradictionError
from disting.fibres.synthesis.decide import DRAWS, point_bits, rational_point, safety_of_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import (
    Confirmation,
    Fibre,
    Solution,
    SolutionValues,
    Status,
    target,
)
from disting.fibres.synthesis.theorems import are_dual, dual, is_untested
from disting.model.chain import Chain
from disting.model.question import Answer
from disting.model.row import grounded_and_free
from disting.model.symmetry import forms
from disting.questions.identifiability.parts import Alternative, Origin, Renaming

MOST_LISTED = 100  # solutions of an undamped chain whose number a theorem tells


@dataclass(frozen=True, slots=True)
class Member:
    """A parameter vector with the behaviour of the point, and its properties."""

    values: SolutionValues
    said: Alternative


@dataclass(frozen=True, slots=True)
class Listing:
    """All members found, the point first; bounds of their number for a generic point;
    `complete`: none is missing.
    """

    point: Mapping[str, fmpq]
    members: tuple[Member, ...]
    status: Status
    least: int
    most: int | None
    grade: Grade
    reason: str


def listing(chain: Chain, invariants: int, seed: str) -> Listing:
    """Solutions of a canonical chain at a random point; `invariants` = number of its non-constant
    coefficients.

    A dead time is left out: a rational function times exp(-Td s) determines both factors.
    """
    plain = _plain(chain)
    for draw in range(DRAWS):
        point = rational_point(
            chain, about(f"identifiability:{seed}:{draw}", chain), point_bits(chain)
        )
        whole = (
            Fibre(Status.NOT_COVERED)
            if _many(plain)
            else fibre(plain, target(plain.structure, point))
        )
        if whole.status is not Status.DEGENERATE:
            break
    solutions = _listing(plain, invariants - chain.dead_time, point, whole)
    return replace(
        solutions,
        members=tuple(replace(m, values={**point, **m.values}) for m in solutions.members),
    )


def _plain(chain: Chain) -> Chain:
    """Without dead time; a chain without springs has no dampers in parallel."""
    return replace(chain, dead_time=False, damped=chain.damped and chain.n_masses > 1)


def _many(chain: Chain) -> bool:
    """Return True if a theorem counts more solutions than it is useful to list."""
    return (foster_count(chain) or 0) > MOST_LISTED


def _listing(chain: Chain, invariants: int, point: Mapping[str, fmpq], whole: Fibre) -> Listing:
    exact = images(chain, {name: point[name] for name in chain.parameters})
    if _many(chain):
        count = foster_count(chain) or 0
        return Listing(point, tuple(exact), whole.status, count, count, (Certainty.THEOREM, 0), "")
    if whole.status is not Status.COMPLETE:
        certainty = (
            Certainty.PROVEN if whole.solutions and is_untested(chain) else Certainty.NUMERICAL
        )
        others = [_other(s, certainty) for s in whole.solutions]
        return Listing(
            point,
            (*exact, *others),
            whole.status,
            len(exact),
            None,
            (Certainty.THEOREM, 0),
            whole.reason,
        )
    others = [
        _other(s, _existence(chain, s, invariants)) for s in _find_unmatched(whole.solutions, exact)
    ]
    least = len(exact) + sum(m.said.certainty is not Certainty.NUMERICAL for m in others)
    grade = _grade(chain, whole)
    return Listing(
        point, (*exact, *others), whole.status, least, len(whole.solutions), grade, whole.reason
    )


def renamings(chain: Chain) -> tuple[Renaming, ...]:
    """Symmetries of the class that lead from the chain to itself and move a parameter.

    >>> [r.text for r in renamings(Chain(3, act_plus=2, meas_plus=2, damped=False))]
    ['k12 ↔ k23, m1 ↔ m3']
    """
    by_pairs: dict[tuple[tuple[str, str], ...], Renaming] = {}
    for form in forms(chain):
        moved = tuple((a, b) for a, b in form.renaming.items() if a != b)
        if form.chain == chain and moved:
            by_pairs.setdefault(moved, Renaming(moved, tuple(s.value for s in form.symmetries)))
    return tuple(by_pairs.values())


def is_self_dual(chain: Chain) -> bool:
    """Return True if the duality theorem maps the chain to itself, with other parameters."""
    return chain.n_masses > 1 and are_dual(_plain(chain), _plain(chain))


def images(chain: Chain, point: Mapping[str, fmpq]) -> list[Member]:
    """The point, and the points that symmetries and duality make of it: exact, real and
    positive.
    """
    symmetric = renamings(chain)
    members = [Member(point, _exact(Origin.GIVEN, ""))]
    members += [Member(_move_point(point, r), _exact(Origin.SYMMETRY, r.text)) for r in symmetric]
    if is_self_dual(chain):
        image = dual(chain, point)
        members.append(Member(image, _exact(Origin.DUALITY, "")))
        members += [
            Member(_move_point(image, r), _exact(Origin.DUALITY, r.text)) for r in symmetric
        ]
    return members


def _exact(origin: Origin, note: str) -> Alternative:
    return Alternative(origin, Answer.YES, Answer.YES, Certainty.THEOREM, note)


def _move_point(point: Mapping[str, fmpq], renaming: Renaming) -> dict[str, fmpq]:
    moved = {new: point[old] for old, new in renaming.moved}
    return {name: moved.get(name, value) for name, value in point.items()}


def _find_unmatched(solutions: tuple[Solution, ...], exact: list[Member]) -> list[Solution]:
    """The solutions that are none of those known exactly; raises ContradictionError if one of
    these is missing.
    """
    rest = list(solutions)
    for member in exact:
        same = [
            s
            for s in rest
            if all(s.values[name].overlaps(acb(value)) for name, value in member.values.items())
        ]
        if not same:
            raise ContradictionError(
                "a complete fibre lacks a parameter vector that belongs to it"
                f" ({member.said.origin.value})"
            )
        rest = [s for s in rest if s is not same[0]]
    return rest


def _other(solution: Solution, certainty: Certainty) -> Member:
    return Member(
        solution.values, Alternative(Origin.OTHER, solution.real, solution.positive, certainty)
    )


def _existence(chain: Chain, solution: Solution, invariants: int) -> Certainty:
    if foster_count(chain) is not None:
        return Certainty.THEOREM
    square = solution.confirmation is Confirmation.SUBSYSTEM and invariants == len(chain.parameters)
    return Certainty.PROVEN if square or is_untested(chain) else Certainty.NUMERICAL


def _grade(chain: Chain, whole: Fibre) -> Grade:
    """Of the statement that a generic point has no more solutions than were listed, and no
    fewer than those that exist.
    """
    if foster_count(chain) is not None:
        if foster_count(chain) != len(whole.solutions):
            raise ContradictionError(
                f"Foster's theorem gives {foster_count(chain)} solutions, not"
                f" {len(whole.solutions)}"
            )
        return Certainty.THEOREM, 0
    simple = all(s.confirmation is Confirmation.SUBSYSTEM for s in whole.solutions)
    bounded = simple and not whole.tests.boundary
    return (Certainty.BOUNDED, safety_of_point(chain) - 1) if bounded else (Certainty.NUMERICAL, 0)


def foster_count(chain: Chain) -> int | None:
    """Number of solutions of an undamped chain with force and sensor at one place: all ways to
    share out poles and zeros.

    All of them are real and positive (R. Foster, A reactance theorem, 1924). None for other chains.

    >>> [foster_count(Chain(*i, damped=False)) for i in ((4, 2, 1, 3, 1, 3), (2, 0, 0, 1, 0, 2))]
    [3, None]
    """
    grounded, free = grounded_and_free(chain.structure)
    if (
        chain.lag
        or chain.ground_dampers
        or chain.damped
        or free.distance
        or (grounded is not None and grounded.distance)
    ):
        return None
    ways = comb(free.n_masses - 1, free.a - 1)
    if grounded is not None:
        ways *= comb(chain.n_masses - 1, chain.gap) * comb(chain.gap - 1, grounded.a - 1)
    return ways
