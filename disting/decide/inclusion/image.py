"""Equivalents with finite elements other than zero: whether generic models of a chain of smaller
rank have any in another one.

What one fibre proves. Let a rational point p0 of the given model have an equivalent in the other
one, all elements q of it finite and not zero (see `disting.fibres.synthesis`). The triples (p, q,
t) with Phi2(q) = t Phi1(p) and all elements of q non-zero (one more unknown and equation say so)
are given by c + 1 equations of degree D at most, c the number of coefficients that do not vanish
identically in both, D as in `disting.decide.same.exact`. The degrees of all components of the
set add up to D^(c + 1) at most (Bezout, J. Heintz, Definability and fast quantifier elimination in
algebraically closed fields, Theoret. Comput. Sci. 24, 1983), and projections have no larger
degrees. So if no component dominates the points p, those with an equivalent lie on a hypersurface
of degree D^(c + 1), which p0 meets by accident only. Otherwise generic p have equivalents, for
what is dense and constructible holds a dense open set.

An empty fibre proves the opposite, as in `disting.decide.same.exact`, whose argument does not
use equal ranks.
"""

from dataclasses import replace
from math import ceil, log2

from disting.algebra.certainty import LEAST_SAFETY, Certainty
from disting.behaviour.chain_model import powers
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.decide.inclusion.profiles import by_relative_degrees
from disting.decide.same.exact import rational_part
from disting.evidence.ideals import Refutation
from disting.fibres.ideals import Limits, decide, normalise, refuted_by_rows
from disting.fibres.synthesis.decide import (
    DRAWS,
    member,
    point_bits,
    safety_of_point,
)
from disting.model.chain import Chain
from disting.model.question import Membership, Settings

LIMITS = Limits(seconds=5.0, entries=20_000, safety=LEAST_SAFETY)  # of the ideal of one fibre


def by_degrees(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    """Relative degrees of the rows, without any chance."""
    return by_relative_degrees(small, large)


def by_rows(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    """Markov parameters of the rows, without any chance."""
    exact = refuted_by_rows(rational_part(small), rational_part(large), settings.seed)
    if exact is None:
        return None
    return InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=exact)


def by_synthesis(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """One fibre, which refutes or proves."""
    unknown = InclusionFinding(
        Inclusion.UNKNOWN, reason="no method finds all equivalents with finite elements"
    )
    if any(c.lag or c.dead_time for c in (small, large)) or small.damped != large.damped:
        return unknown
    equivalent = member(small, large, settings.seed)
    if equivalent.membership is Membership.EXCLUDED:
        decision, inclusion = equivalent.decision(safety_of_point(large)), Inclusion.NEITHER
    else:
        decision = equivalent.decision(safety_of_equivalent(small, large))
        inclusion = Inclusion.LEFT_IN_RIGHT
    if decision.membership is Membership.UNKNOWN:
        return unknown
    return InclusionFinding(inclusion, Certainty.BOUNDED, decision.safety, equivalent.evidence)


def by_small_ideal(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    """An empty fibre as a small ideal; a solution proves nothing here, its elements may be zero."""
    maps = (normalise(rational_part(c)) for c in (small, large))
    decided = decide(*maps, equal_rank=False, seed=settings.seed, limits=LIMITS)
    if not isinstance(decided.evidence, Refutation) or decided.safety < LEAST_SAFETY:
        return None
    evidence = replace(decided.evidence, is_normalised=True)
    return InclusionFinding(Inclusion.NEITHER, Certainty.BOUNDED, decided.safety, evidence)


def safety_of_equivalent(small: Chain, large: Chain) -> int:
    """Largest b with DRAWS D^(c + 1) / (2^B - 1) <= 2^-b, B bits a coordinate: one equivalent
    proves a statement on generic ones.
    """
    small_powers, large_powers = (powers(rational_part(c)) for c in (small, large))
    coefficients = sum(len(a | b) for a, b in zip(small_powers, large_powers, strict=True))
    degree = max(3 * large.n_masses + 2, len(large.parameters) + 1)
    return point_bits(large) - ceil((coefficients + 1) * log2(degree) + log2(DRAWS)) - 1
