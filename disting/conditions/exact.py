"""The exact decision where conditions 1 to 9 stay silent: one fibre, by inverse network synthesis.

Both sets of behaviours have irreducible closures V1 and V2; of equal dimension they are equal exactly if a generic point of one
lies in the image of the other. So a random rational point of one model is taken and all parameters of the other model with the
same transfer function are listed (see `disting.synthesis`).

What one point proves. Let D = 3 N_B + 2 and n the number of parameters of the searched model. The pairs (p, q) of equal
transfer functions with all elements of q non-zero (one more unknown and one more equation say so) are given by equations of
degree D at most, so a component that dominates the points p has a degree of at most D^(n+1) (Bezout). If V1 = V2 there is one,
and the points p without an equivalent lie where its projection is not proper: on a hypersurface of no larger degree
(Z. Jelonek, Testing sets for properness of polynomial mappings, Math. Ann. 315, 1999). If V1 is not V2, the points with an
equivalent lie on the pull-back of an equation of V2, of degree D^(n+1) at most too. Coordinates are fractions whose numerators
have POINT_BITS random bits, so by Schwartz and Zippel a point lies there with a probability of at most D^(n+1) / 2^POINT_BITS;
up to DRAWS points are drawn.
"""

from dataclasses import replace
from math import ceil, log2, log10

from disting.certainty import Certainty, Grade
from disting.conditions.evidence import FibreAt, Theorem
from disting.conditions.finding import Finding, Outcome
from disting.model.chain import Chain
from disting.model.symmetry import canonical
from disting.settings import Settings
from disting.synthesis.decide import DRAWS, POINT_BITS, Direction, Exact, Grounds, Membership, decide
from disting.synthesis.duality import are_dual

EXACT = 10  # number of the exact decision, after the nine conditions


def exact_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Exact decision for two chains of equal rank; equal size, damping and sensor, no lag, dead time or ground dampers."""
    named = theorem(a, b)
    if named:
        return Finding(EXACT, Outcome.HOLDS, Certainty.THEOREM, evidence=Theorem(named))
    if not _covered(a, b):
        return Finding(EXACT, Outcome.INAPPLICABLE, note="the exact decision covers plain chains of equal size and damping")
    found = decide(a, b, settings.seed)
    if found.membership is Membership.UNKNOWN:
        return Finding(EXACT, Outcome.ABANDONED, note=found.reason)
    grade = _grade(found, a.n_masses)
    if grade[0] is Certainty.BOUNDED and grade[1] <= 0:
        return Finding(EXACT, Outcome.ABANDONED, note="one point gives no bound for chains of this size")
    outcome = Outcome.HOLDS if found.membership is Membership.MEMBER else Outcome.FAILS
    return Finding(EXACT, outcome, *grade, _evidence(found))


def mirrored(finding: Finding) -> Finding:
    """The finding on the pair in the other order."""
    if not isinstance(finding.evidence, FibreAt):
        return finding
    return replace(finding, evidence=replace(finding.evidence, left_given=not finding.evidence.left_given))


def theorem(a: Chain, b: Chain) -> str:
    """Name of the theorem by which two chains are the same for all parameters; "" if there is none.

    >>> theorem(Chain(2), Chain(2, 1, 1, 2, 1, 2))
    'duality'
    """
    if canonical(a).chain == canonical(b).chain:
        return "symmetry"
    return "duality" if are_dual(canonical(a).chain, canonical(b).chain) else ""


def safety_of_point(n_masses: int, unknowns: int) -> int:
    """Largest b with DRAWS * D^(n+1) / 2^POINT_BITS <= 2^-b, for n unknowns."""
    return POINT_BITS - ceil((unknowns + 1) * log2(3 * n_masses + 2) + log2(DRAWS))


def _covered(a: Chain, b: Chain) -> bool:
    plain = not any(c.lag or c.dead_time or c.ground_dampers for c in (a, b))
    return plain and (a.n_masses, a.damped, a.sensor) == (b.n_masses, b.damped, b.sensor)


def _grade(found: Exact, n_masses: int) -> Grade:
    if found.grounds in (Grounds.REFUTED, Grounds.CONSTRUCTION):
        return Certainty.BOUNDED, safety_of_point(n_masses, len(found.point))
    return Certainty.NUMERICAL, 0


def _is_numerical(found: Exact) -> bool:
    return found.grounds in (Grounds.SUBSYSTEM, Grounds.BALLS)


def _evidence(found: Exact) -> FibreAt:
    return FibreAt(
        left_given=found.direction is Direction.LEFT_IN_RIGHT,
        point=tuple((name, str(value)) for name, value in found.point.items()),
        grounds=found.grounds.value,
        solutions=found.solutions,
        real=found.real,
        positive=found.positive,
        decades=int(-log10(found.width)) if _is_numerical(found) and found.width else 0,
    )
