"""Membership proven by construction: undamped chains whose two parts are known exactly.

The undamped methods have no tests: once the receptances of the grounded and of the free part are
rational functions of the right degrees, every choice of roots and gauges leads to a chain, as long
as no element and no divisor is zero, which balls can prove. So a branch that comes to its end is a
proof, if the two parts are exact. They are if the given chain has g or N - 1 - g masses before its
gap (or the other chain has no gap): then its own grounded or free poles are the ones to take.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from flint import ctx, fmpq

from disting.fibres.synthesis.ball import Imprecise
from disting.fibres.synthesis.branch_ends import Part
from disting.fibres.synthesis.fibre import PRECISIONS, segments
from disting.fibres.synthesis.methods import is_covered, synthesise
from disting.fibres.synthesis.segment import Segment
from disting.fibres.synthesis.target import Exact, Target, target
from disting.model.chain import Chain
from disting.model.structure import Ports
from disting.model.symmetry import canonical


def is_plain(chain: Chain) -> bool:
    """Whether it consists of masses and springs alone."""
    return not (chain.damped or chain.ground_dampers or chain.lag or chain.dead_time)


def is_untested(chain: Chain) -> bool:
    """Whether the synthesis of this chain has no tests at all: undamped, one part or force and
    sensor at one mass of each part.

    Then every solution that is listed exists.
    """
    grounded, free = segments(chain)
    return is_plain(chain) and (grounded is None or grounded.distance == free.distance == 0)


def is_constructed(given: Chain, point: Mapping[str, fmpq], other: Chain) -> bool:
    """Whether a solution of `other` for the given model is proven to exist; False says nothing."""
    grounded, free = segments(canonical(other).chain)
    if (
        not is_plain(given)
        or not is_plain(other)
        or not all(is_covered(s) for s in (grounded, free) if s)
    ):
        return False
    whole = target(given.structure, point).folded(1)
    if grounded is None:
        return whole.numerator.degree() == free.numerator_degree and _exists(free, whole)
    return any(
        all(_exists(*part) for part in parts)
        for parts in exact_parts(given, point, whole, grounded, free)
    )


def exact_parts(
    given: Chain, point: Mapping[str, fmpq], whole: Target, grounded: Segment, free: Segment
) -> Iterator[list[tuple[Segment, Target]]]:
    """Yield the receptances of both parts, of the right degrees, where the given chain's own
    poles are the ones to take.
    """
    for poles in _poles(given, point, whole):
        parts = _parts(whole, poles) if poles.degree() == grounded.nodes else None
        if parts and all(
            t.numerator.degree() == s.numerator_degree
            for s, t in zip((grounded, free), parts, strict=True)
        ):
            yield list(zip((grounded, free), parts, strict=True))


def _poles(given: Chain, point: Mapping[str, fmpq], whole: Target) -> tuple[Exact, Exact]:
    """Denominator of the given chain's grounded part, and of its free part without the motion
    of the whole.
    """
    ports = Ports(0, given.act_plus, 0, given.meas_plus)
    free = target(replace(given.structure, ports=ports), point).folded(1).denominator
    return whole.denominator // free, free // type(free)([0, 1])


def _parts(whole: Target, poles: Exact) -> tuple[Target, Target] | None:
    """H = R + F with these poles for R."""
    others = whole.denominator // poles
    common, inverse, _ = others.xgcd(poles)
    if common.degree() > 0:
        return None
    top = whole.numerator * inverse % poles
    rest = (whole.numerator - top * others) // poles
    return Target(top, poles), Target(rest, others)


def _exists(segment: Segment, exact: Target) -> bool:
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            try:
                return any(isinstance(leaf, Part) for leaf in synthesise(segment, exact.balls))
            except Imprecise:
                continue
    return False
