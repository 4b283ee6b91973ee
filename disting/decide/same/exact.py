"""The exact decision where conditions 1 to 9 stay silent: one fibre, by inverse network synthesis
or as a polynomial ideal.

Both sets of behaviours have irreducible closures V1 and V2; of equal dimension they are equal
exactly if a generic point of one lies in the image of the other. So a random rational point of one
model is taken and all parameters of the other model with the same transfer function are listed
(see `disting.fibres.synthesis`).

What one point proves. Let n be the number of parameters of the searched model and D = max(3 N_B +
2, n + 1). The pairs (p, q) of equal transfer functions with all elements of q non-zero (one more
unknown and one more equation ensure it) are given by equations of degree D at most, so a component
that dominates the points p has a degree of at most D^(n+1) (Bezout). If V1 = V2 there is one, and
the points p without an equivalent lie where its projection is not proper: on a hypersurface of no
larger degree (Z. Jelonek, Testing sets for properness of polynomial mappings, Math. Ann. 315,
1999). If V1 is not V2, the points with an equivalent lie on the pull-back of an equation of V2, of
degree D^(n+1) at most too. Coordinates are fractions whose numerators have B random bits, B so
large that the bound is small enough for this n (`synthesis.decide.point_bits`); by Schwartz and
Zippel a point lies there with a probability of at most D^(n+1) / (2^B - 1); up to DRAWS points are
drawn, of either model.

Where the synthesis has no method (force and sensor two or more masses apart inside a row; with
dampers to the ground also some neighbouring ports) or finds only numbers, the ways to share out the
numerator's roots decide (`ideals.by_shares`), then the fibre's ideal, modulo random primes and with
bounds of its own (see `disting.fibres.ideals`). No other program is used: the answer depends on the
question alone.

Dead time. If R1(s) = R2(s) exp(-Td s) with rational functions that are not zero, exp(-Td s) is one
as well. It has neither zeros nor poles, and a rational function without any is a constant: Td = 0.
So models with and without dead time are distinguishable for every Td other than 0, whatever the
rest; and two models with dead times have equal transfer functions only where both the dead times
and the rational parts are equal.

What equal ranks are needed for. One direction is treated, say V1 against V2. Where V1 does not lie
inside V2, the closures differ, whatever the ranks. Where it does, V1 = V2 holds only because both
have one dimension: an irreducible closed set contains none but itself of its own dimension. Ranks
found at points are lower bounds, so two that are found equal may differ. So a bounded HOLDS is as
sure as the fibre and both ranks (`decide.asking.resting_on_ranks`); FAILS, theorems and full rows
need no ranks.
"""

from collections.abc import Sequence
from dataclasses import replace

from disting.algebra.certainty import LEAST_SAFETY, Certainty
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.conditions.side import AnySide
from disting.decide import SAME_CHAINS, first_finding
from disting.evidence.decision import DeadTime, FibreAt, Theorem
from disting.evidence.ideals import NoShares, Refutation, Solutions
from disting.evidence.kinds import Decision
from disting.fibres import ideals
from disting.fibres.ideals import (
    MOST,
    TRIES,
    Limits,
    PolynomialMap,
    Try,
    coefficient_map,
    match_maps,
    normalise,
    safety_of,
    tell_chains_apart,
)
from disting.fibres.ideals.full_rows import same_by_full_rows
from disting.fibres.synthesis.decide import Direction, decide, safety_of_point
from disting.fibres.synthesis.theorems import are_dual, are_foster, are_same_by_rows
from disting.model.chain import Chain, Structure
from disting.model.question import Membership, Question, Settings
from disting.model.symmetry import canonical

# wanted of a fibre: with the ranks that it rests on, the bound may lose one bit
SAFETY = LEAST_SAFETY + 1
# of one ideal; work ends long before: runs repeat
LIMITS = Limits(seconds=3600.0, entries=4_000_000, safety=SAFETY)


def exact_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Exact decision for two chains of equal rank, size and sensor; of unequal dead time they
    differ, by a theorem.
    """
    finding: Finding | None = first_finding(SAME_CHAINS.rows, a, b, settings)
    if finding is None:
        note = "the exact decision compares chains of equal size and sensor"
        return Finding(EXACT, Outcome.INAPPLICABLE, note=note)
    return finding


def refuse_unequal(left: AnySide, right: AnySide) -> Finding | None:
    """Not asked of chains of unequal rank."""
    if left.rank == right.rank:
        return None
    return Finding(EXACT, Outcome.INAPPLICABLE, note="the ranks differ (condition 4)")


def are_alike(a: Chain, b: Chain, settings: Settings) -> bool:
    """Return True for chains of one size and sensor quantity."""
    return (a.n_masses, a.quantity) == (b.n_masses, b.quantity)


def recheck_labels(
    evidence: Solutions | Refutation, a: Chain, b: Chain, settings: Settings
) -> Finding:
    """Of ideals the labels are drawn again."""
    coordinates = normalise if evidence.is_normalised else coefficient_map
    maps = (coordinates(rational_part(chain)) for chain in (a, b))
    return by_labels(evidence, *match_maps(*maps), settings.seed)


def recheck_shares(evidence: NoShares, a: Chain, b: Chain, settings: Settings) -> Finding | None:
    """Shares in the direction of the evidence alone."""
    return by_shares(a, b, settings, [(evidence.left_given, MOST)])


def by_labels(
    evidence: Solutions | Refutation, left: PolynomialMap, right: PolynomialMap, seed: str
) -> Finding:
    """Finding from the ideals at these labels on two models of equal rank, if the seed draws
    them.
    """
    is_solved = isinstance(evidence, Solutions)
    membership = Membership.MEMBER if is_solved else Membership.EXCLUDED
    return as_finding(Decision(membership, safety_of(evidence, left, right, seed), evidence))


def by_theorem(a: Chain, b: Chain, settings: Settings) -> Finding | None:
    """Finding of a theorem for all parameters."""
    named = theorem(a, b)
    if not named:
        return None
    return Finding(EXACT, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(named))


def by_dead_time(a: Chain, b: Chain, settings: Settings) -> Finding | None:
    """A dead time that one of them has alone."""
    if a.dead_time == b.dead_time:
        return None
    return Finding(EXACT, Outcome.FAILS, Certainty.THEOREM, evidence=DeadTime(a.dead_time))


def by_synthesis(a: Chain, b: Chain, settings: Settings) -> Finding | None:
    """Finding of the synthesis, with an error bound; a dead time that both have is a factor of its
    own.
    """
    a, b = (replace(c, dead_time=False) for c in (a, b))
    if a.damped != b.damped:
        return None
    decided_by_fibre = decide(a, b, settings.seed)
    searched = b if decided_by_fibre.direction is Direction.LEFT_IN_RIGHT else a
    decision = decided_by_fibre.decision(safety_of_point(searched))
    return None if decision.membership is Membership.UNKNOWN else as_finding(decision)


def by_full_rows(a: Chain, b: Chain, settings: Settings) -> Finding | None:
    """Finding from rows that can have any receptance; a dead time that both have is a factor of its
    own.
    """
    evidence = same_by_full_rows(a.structure, b.structure)
    return (
        None
        if evidence is None
        else Finding(EXACT, Outcome.HOLDS, Certainty.PROVEN, evidence=evidence)
    )


def by_shares(
    a: Chain, b: Chain, settings: Settings, tries: Sequence[Try] = TRIES
) -> Finding | None:
    """Refutation by the shares of the numerator's roots; a dead time that both have is a factor of
    its own.
    """
    apart = tell_chains_apart(rational_part(a), rational_part(b), settings.seed, tries)
    if apart is None or apart[1] < LEAST_SAFETY:
        return None
    return Finding(
        rule=EXACT,
        outcome=Outcome.FAILS,
        certainty=Certainty.BOUNDED,
        safety=apart[1],
        evidence=apart[0],
    )


def by_ideals(a: Chain, b: Chain, settings: Settings, limits: Limits | None = None) -> Finding:
    """In the parameters themselves, then in normalised ones: sometimes the one is much cheaper,
    sometimes the other.
    """
    limits, reasons = limits or LIMITS, list[str]()
    for coordinates in (coefficient_map, normalise):
        first, second = (coordinates(rational_part(c)) for c in (a, b))
        if first.degrees != second.degrees:
            return Finding(
                EXACT, Outcome.INAPPLICABLE, note="the degrees differ (conditions 1 and 2)"
            )
        decision = ideals.decide(first, second, equal_rank=True, seed=settings.seed, limits=limits)
        if decision.evidence and decision.safety >= limits.safety:
            evidence = replace(decision.evidence, is_normalised=coordinates is normalise)
            return as_finding(replace(decision, evidence=evidence))
        reasons.append(decision.reason)
    return Finding(
        EXACT,
        Outcome.ABANDONED,
        note=f"the ideal of the fibre is too large for the limits ({reasons[-1]})",
    )


def as_finding(decision: Decision[FibreAt | Solutions | Refutation]) -> Finding:
    """Finding from a fibre on two models of equal rank; ABANDONED with the reason if there is
    none.
    """
    if decision.membership is Membership.UNKNOWN:
        return Finding(EXACT, Outcome.ABANDONED, note=decision.reason)
    outcome = Outcome.HOLDS if decision.membership is Membership.MEMBER else Outcome.FAILS
    return Finding(
        EXACT, outcome, Certainty.BOUNDED, safety=decision.safety, evidence=decision.evidence
    )


def rational_part(chain: Chain) -> Structure:
    """The structure without its dead time, a factor of its own that both models share."""
    return replace(chain, dead_time=False).structure


def theorem(a: Chain, b: Chain) -> str:
    """Name of the theorem by which two chains are the same for all parameters; "" if there is none.

    >>> theorem(Chain(2, damped=True), Chain(2, 1, 1, 2, 1, 2, damped=True))
    'duality'
    """
    if canonical(a).chain == canonical(b).chain:
        return "symmetry"
    if are_foster(a, b):
        return "Foster"
    if are_same_by_rows(a, b):
        return "parts"
    return "duality" if are_dual(canonical(a).chain, canonical(b).chain) else ""


EXACTLY = Question("exact decisions", exact_finding, Finding.to_json, Finding.from_json)
