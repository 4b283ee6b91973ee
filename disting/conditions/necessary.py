"""Conditions 1 to 5 (section 4.1): necessary for indistinguishability, so one that fails proves
the pair distinguishable.

Each compares one property of two profiles. The property is a function of one model alone, so it
also sorts a whole family into buckets. That a condition holds proves nothing.
"""

from collections.abc import Hashable

from disting.algebra.certainty import Certainty, Grade, grade_of
from disting.algebra.matroid import Matroid, rank_in, separating_rows
from disting.behaviour.profile import NoMatroid, Profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import (
    DEGREES,
    DEPENDENCES,
    FORM,
    INVARIANTS,
    RANK,
    Finding,
    Outcome,
    Rule,
)
from disting.evidence.conditions import Counts, Forms, Ranks
from disting.evidence.kinds import Evidence

NO_DEGREES = (
    "Markov parameters have no numerator and denominator, and equally many of them are compared"
)


def number_of_invariants(profile: Profile) -> Hashable:
    """N_MI = n + m + 1 by degree, zero coefficients included; the fixed leading one is not
    counted. Of several transfer functions the sum.
    """
    if profile.representation is Representation.MARKOV:
        return 0
    return sum(profile.degrees) + len(profile.degrees) // 2


def numbers_of_coefficients(profile: Profile) -> Hashable:
    """Degrees n and m of numerator and denominator."""
    return profile.degrees if profile.representation is Representation.TF else 0


def symbolic_form(profile: Profile) -> Hashable:
    """The labels of the non-constant invariants."""
    return profile.form


def generic_rank(profile: Profile) -> Hashable:
    """N_R, the generic rank of the Jacobian: the number of determinable parameters."""
    return profile.rank


def dependences(profile: Profile) -> Hashable:
    """The matroid of the Jacobian's rows."""
    return profile.matroid


def condition_1(left: Profile, right: Profile) -> Finding:
    """Cond. 1: "The same number of moment invariants N_MI exist." Counted by polynomial degree."""
    return _by_degree(
        INVARIANTS, left, right, number_of_invariants(left) == number_of_invariants(right)
    )


def condition_2(left: Profile, right: Profile) -> Finding:
    """Cond. 2: "The same number of coefficients exist in numerator n and denominator m in both
    models."
    """
    return _by_degree(
        DEGREES, left, right, numbers_of_coefficients(left) == numbers_of_coefficients(right)
    )


def condition_3(left: Profile, right: Profile) -> Finding:
    """Cond. 3: "Both sets of moment invariants have the same symbolic form", zeros for constants,
    ones for the others.

    Values of constants do not enter here (condition 7 compares them); an invariant that one model
    lacks is constant there.
    """
    if left.form == right.form:
        return Finding(FORM, Outcome.HOLDS)
    only = Forms(
        _order_labels(left, left.form - right.form), _order_labels(right, right.form - left.form)
    )
    return Finding(FORM, Outcome.FAILS, *form_grade(left, right), only)


def condition_4(left: Profile, right: Profile) -> Finding:
    """Cond. 4: "The rank N_R of the Jacobian matrix J = dPhi/dp of the moment invariants is the
    same for both models."
    """
    if left.rank == right.rank:
        return Finding(
            RANK,
            Outcome.HOLDS,
            *grade_of(left.rank_proven and right.rank_proven, _safety(left, right)),
        )
    evidence = Ranks(left.labels, left.rank, right.rank, all_rows=True)
    return Finding(RANK, Outcome.FAILS, *rank_grade(left, right), evidence)


def condition_5(left: Profile, right: Profile) -> Finding:
    """Cond. 5: "The same linear dependencies among moment invariants exist": equal largest
    independent row sets.

    These sets are the bases of a matroid, compared by its canonical form. Constant invariants
    (zero rows) are left out.
    """
    if left.form != right.form or left.rank != right.rank:
        return Finding(DEPENDENCES, Outcome.INAPPLICABLE, note="condition 3 or 4 fails")
    if isinstance(left.matroid, NoMatroid) or isinstance(right.matroid, NoMatroid):
        reasons = [p.matroid.reason for p in (left, right) if isinstance(p.matroid, NoMatroid)]
        return Finding(DEPENDENCES, Outcome.ABANDONED, note=reasons[0])
    mine, theirs = _restrict_matroid(left, left.matroid), _restrict_matroid(right, right.matroid)
    outcome, evidence = (
        (Outcome.HOLDS, None)
        if mine == theirs
        else (Outcome.FAILS, _unequal_rows(left, mine, theirs))
    )
    return Finding(DEPENDENCES, outcome, *dependence_grade(left, right), evidence)


def degree_grade(left: Profile, right: Profile) -> Grade:
    """Degrees are exact: a leading coefficient that is not zero at a point is not zero, nor is
    a resultant.
    """
    return grade_of(True, 0)


def form_grade(left: Profile, right: Profile) -> Grade:
    """Proven where some invariant varies in one model and provably vanishes in the other; a
    dead time is a theorem's.
    """
    if ("Td" in left.labels) != ("Td" in right.labels):
        return Certainty.THEOREM, 0
    proven = any(
        _surely_constant(b, x) for a, b in ((left, right), (right, left)) for x in a.form - b.form
    )
    return grade_of(proven, _safety(left, right))


def rank_grade(left: Profile, right: Profile) -> Grade:
    """A rank found at a point is certainly a lower bound; only the smaller of two could be too
    small by chance.
    """
    return grade_of(min((left, right), key=lambda p: p.rank).rank_proven, _safety(left, right))


def dependence_grade(left: Profile, right: Profile) -> Grade:
    """A dependence found at all points could be accidental, within the bound."""
    return grade_of(False, _safety(left, right))


def _restrict_matroid(profile: Profile, shape: Matroid) -> Matroid:
    """The matroid on the free rows only, numbered again, so that summaries with other constants
    compare.
    """
    if all(profile.free):
        return shape
    return shape.relabelled(
        {row: i for i, row in enumerate(r for r, free in enumerate(profile.free) if free)}
    )


def _unequal_rows(left: Profile, mine: Matroid, theirs: Matroid) -> Evidence:
    labels = _order_labels(left, left.form)
    rows = separating_rows(mine, theirs)
    return Ranks(
        tuple(labels[i] for i in rows), rank_in(mine, rows), rank_in(theirs, rows), all_rows=False
    )


def _by_degree(rule: Rule, left: Profile, right: Profile, equal: bool) -> Finding:
    if Representation.MARKOV in (left.representation, right.representation):
        return Finding(rule, Outcome.INAPPLICABLE, note=NO_DEGREES)
    if equal:
        return Finding(rule, Outcome.HOLDS)
    return Finding(rule, Outcome.FAILS, evidence=Counts(left.degrees, right.degrees))


def _order_labels(profile: Profile, labels: frozenset[str]) -> tuple[str, ...]:
    return tuple(label for label in profile.labels if label in labels)


def _surely_constant(profile: Profile, label: str) -> bool:
    return label in profile.proven_zeros or label not in profile.labels


def _safety(left: Profile, right: Profile) -> int:
    """Two events of probability 2^-b or less: 2^-(b-1)."""
    return min(left.safety, right.safety) - 1
