"""Limits of one row of a larger chain: decides whether a wanted receptance is a limit of its
receptances.

* INSIDE: it is the very same map. FULL: its rank is the number of its coefficients, up to a common
  factor, that do not vanish identically, so its closure is the linear space of all such. MOMENTUM:
  a free damped row has a_2 b_1 = a_3 b_0 (see `limits`), an irreducible quadric; where the rank
  is one less than in FULL, its closure is this quadric. A rank seen modulo a prime is a lower
  bound of the rank, so nothing of this is left to chance.
* COEFFICIENT: one that vanishes identically in the row and not in what is wanted.
* RESULTANT: see `row_resultants`, `row_neighbours`. EQUATION: see `row_equations`, found with an
  error bound.
* DIMENSION: what is wanted has the largest rank that the row could have. Then its closure lies in
  that of the row, both irreducible, only if they are the same. That they are not is shown at random
  points, with an error bound: where what is wanted is a row with as many zeros, poles and unknowns,
  by all ways to share out its zeros (`fibres.ideals.shares`), else by the ideal of the fibre with
  its tangent equations.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

from disting.algebra.certainty import LEAST_SAFETY, prime, residues
from disting.behaviour.chain_model import powers
from disting.decide.inclusion.row_equations import equation_safety, label_of, row_equation
from disting.decide.inclusion.row_neighbours import are_no_limits
from disting.decide.inclusion.row_resultants import end_resultant, inner_resultant
from disting.evidence.limits import RowLimits, Why
from disting.fibres.ideals import CoefficientMap, Limits, decide
from disting.fibres.ideals.factored_map import row_factors
from disting.fibres.ideals.fibre_ideal import generic_rank, sides_at
from disting.fibres.ideals.shares import may_share, tell_apart
from disting.model.question import Membership
from disting.model.row import Row

# masses of a row whose equations are looked for: those of larger ones have too many monomials
LARGEST_ROW = 3
# label of the points where ranks are seen: they prove what they show, so all pairs may share them
RANKS = "ranks of rows"
REMEMBERED = 256  # rows whose rank is kept
SAFETY = LEAST_SAFETY + 2  # of DIMENSION: three of them, one a split, reach LEAST_SAFETY
AGAIN = 1  # bits of what is found again, at a point and prime of its own
# of the ideal of one row; work ends long before: runs repeat
DIMENSION_LIMITS = Limits(seconds=3600.0, entries=900_000)
DRAWS = 60  # points among which a numerator without factors is looked for
TRIALS = 3  # primes and points at which an equation must not vanish
Support = tuple[frozenset[int], frozenset[int]]


@dataclass(frozen=True, slots=True)
class Task:
    """A receptance wanted of a row of the larger chain in one split, with the map and the row that
    are there; `name`: "grounded", "free", "whole". `own`: the row whose receptance it is, if any.
    """

    split: str
    name: str
    receptance: CoefficientMap
    searched: CoefficientMap
    row: Row
    own: Row | None = None


class Proof(NamedTuple):
    """A step with the bits of its error bound, 0: proven."""

    step: RowLimits
    safety: int


def show(wanted: Task, label: str) -> Proof | None:
    """Decide a row at little cost, the cheapest proof first; None if none succeeds."""
    named = f"{label}:{label_of(wanted.row)}"
    finding = next(filter(None, (test(wanted, named) for test in _TESTS)), None)
    if finding is None:
        return None
    bits = _safety(wanted.row) if finding[0] is Why.EQUATION else 0
    return Proof(RowLimits(wanted.split, wanted.name, *finding), bits)


def by_dimension(wanted: Task, seed: str) -> Proof | None:
    """Prove that rows of one dimension differ, by ideals: up to some seconds; None if nothing is
    found.
    """
    step = _dimension(wanted, seed)
    return step and Proof(RowLimits(wanted.split, wanted.name, *step), SAFETY)


def as_large(wanted: Task) -> bool:
    """Return True if the wanted receptances have the largest rank that the row could have, and the
    row has it.
    """
    most = _most_rank(wanted.searched)
    return most == generic_rank(wanted.searched, RANKS) and most == _rank_of_function(
        wanted.receptance
    )


def holds(step: RowLimits, wanted: Task) -> bool:
    """Return True if a step holds at fresh points; an equation, or a proof that rows differ, is
    found again.
    """
    if step.why is Why.COEFFICIENT:
        pairs = zip("ba", _support(wanted.receptance), _support(wanted.searched), strict=True)
        return any(
            step.detail == f"{letter}{i}" for letter, own, others in pairs for i in own - others
        )
    if step.why is Why.EQUATION:
        return _equation(wanted, step.detail) is not None
    if step.why is Why.DIMENSION:
        return _dimension(wanted, "verify", AGAIN) == (step.why, step.detail)
    return _OF[step.why](wanted, "verify") == (step.why, step.detail)


def _inside(wanted: Task, label: str) -> tuple[Why, str] | None:
    return (Why.INSIDE, "") if wanted.receptance == wanted.searched else None


def _coefficient(wanted: Task, label: str) -> tuple[Why, str] | None:
    pairs = zip("ba", _support(wanted.receptance), _support(wanted.searched), strict=True)
    more = [f"{letter}{i}" for letter, own, others in pairs for i in sorted(own - others)]
    return (Why.COEFFICIENT, more[-1]) if more else None


def _full(wanted: Task, label: str) -> tuple[Why, str] | None:
    if _coefficient(wanted, label) is not None:
        return None
    missing = _coordinates(wanted.searched) - generic_rank(wanted.searched, RANKS)
    if missing == 0:
        return Why.FULL, ""
    return (Why.MOMENTUM, "") if missing == 1 and _keeps_momentum(wanted) else None


def _dimension(wanted: Task, seed: str, bits: int = SAFETY) -> tuple[Why, str] | None:
    if not as_large(wanted):
        return None
    own, most = wanted.own, _most_rank(wanted.searched)
    if own is not None and own.damped and may_share(row_factors(own), row_factors(wanted.row)):
        differ = _differ_by_shares(own, wanted.row, seed, bits)
    else:
        differ = _differ_by_ideals(wanted.receptance, wanted.searched, seed, bits)
    return (Why.DIMENSION, f"{most} = {most}") if differ else None


@lru_cache(maxsize=REMEMBERED)
def _differ_by_shares(row: Row, searched: Row, seed: str, bits: int) -> bool:
    """Return True if two rows of one dimension differ; many pairs of chains need the same two."""
    apart = tell_apart(row_factors(row), row_factors(searched), seed)
    return apart is not None and apart[1] >= bits


@lru_cache(maxsize=REMEMBERED)
def _differ_by_ideals(
    wanted: CoefficientMap, searched: CoefficientMap, seed: str, bits: int
) -> bool:
    """The same of what is wanted of a row."""
    limits = replace(DIMENSION_LIMITS, safety=bits)
    decided = decide(wanted, searched, equal_rank=True, seed=seed, limits=limits, members=False)
    return decided.membership is Membership.EXCLUDED and decided.safety >= bits


def _resultant(wanted: Task, label: str) -> tuple[Why, str] | None:
    modulus = prime(label)
    coefficients = _at(wanted.receptance, label, modulus)
    labels = (f"{label}:{k}" for k in range(DRAWS))
    drawn = ((*_at(wanted.receptance, at, p), p) for at in labels for p in [prime(at)])
    resultants = (
        made(wanted.row, *coefficients, modulus) for made in (end_resultant, inner_resultant)
    )
    return (Why.RESULTANT, "") if any(resultants) or are_no_limits(wanted.row, drawn) else None


def _equation(wanted: Task, label: str) -> tuple[Why, str] | None:
    if (
        wanted.row.n_masses > LARGEST_ROW
        or _coefficient(wanted, label) is not None
        or _safety(wanted.row) < LEAST_SAFETY
    ):
        return None
    return (
        (Why.EQUATION, label)
        if all(_does_not_vanish(wanted, f"{label}:{k}") for k in range(TRIALS))
        else None
    )


def _support(model: CoefficientMap) -> Support:
    """Powers of s whose coefficients do not vanish identically."""
    num, den = (
        frozenset(i for i, c in enumerate(p) if not c.is_zero())
        for p in (model.numerator, model.denominator)
    )
    return num, den


def _most_rank(model: CoefficientMap) -> int:
    """A bound of the rank that rests on no point."""
    return min(len(model.parameters), _coordinates(model))


def _coordinates(model: CoefficientMap) -> int:
    """Coefficients up to a common factor that do not vanish identically."""
    return sum(map(len, _support(model))) - 1


def _keeps_momentum(wanted: Task) -> bool:
    """Return True if a_0 = a_1 = 0 and a_2 b_1 = a_3 b_0 hold in both identically, all four being
    nonzero where present.
    """
    for m in (wanted.receptance, wanted.searched):
        a, b = (*m.denominator, *m.denominator[:1] * 4), (*m.numerator, m.denominator[0])
        if len(m.denominator) < 4 or not (
            a[0].is_zero() and a[1].is_zero() and a[2] * b[1] == a[3] * b[0]
        ):
            return False
    num, den = _support(wanted.searched)
    return {0, 1} <= num and {2, 3} <= den


@lru_cache(maxsize=REMEMBERED)
def _rank_of_function(model: CoefficientMap) -> int:
    """Rank of the coefficients up to a common factor."""
    return generic_rank(model.with_scale(), RANKS) - 1


def _at(model: CoefficientMap, label: str, modulus: int) -> tuple[list[int], list[int]]:
    """Coefficients of numerator and denominator at the point of a label, modulo a prime."""
    return sides_at(model, residues(label, len(model.parameters), modulus), modulus)


def _does_not_vanish(wanted: Task, label: str) -> bool:
    """Return True if the row's equation of this label does not hold at a random point of the wanted
    receptance.
    """
    equation = row_equation(wanted.row, label)
    if equation is None:
        return False
    num, den = _at(wanted.receptance, f"{label}:wanted", equation.modulus)
    sides = zip((num, den), powers(wanted.row.structure), strict=True)
    return not equation.holds(
        tuple(p[i] if i < len(p) else 0 for p, kept in sides for i in sorted(kept))
    )


def _safety(row: Row) -> int:
    return TRIALS * equation_safety(row)


_TESTS = (_inside, _coefficient, _full, _resultant, _equation)
_OF = {
    Why.INSIDE: _inside,
    Why.FULL: _full,
    Why.MOMENTUM: _full,
    Why.RESULTANT: _resultant,
}
