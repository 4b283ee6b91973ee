"""Membership proven by construction: undamped chains whose two rows are known exactly.

The undamped methods have no tests: once the receptances of the grounded and of the free row are
rational functions of the right degrees, every choice of roots and gauges leads to a chain, as long
as no element and no divisor is zero, which balls can prove. So a branch that comes to its end is a
proof, if both receptances are exact. They are if the given chain has g or N - 1 - g masses before
its gap (or the other chain has no gap): then its own grounded or free poles are the ones to take.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from flint import ctx, fmpq

from disting.fibres.synthesis.branch import Imprecise, RowValues
from disting.fibres.synthesis.fibre import PRECISIONS
from disting.fibres.synthesis.methods import is_covered, synthesise
from disting.fibres.synthesis.task import Exact, Target, target
from disting.model.chain import Chain
from disting.model.row import Row, grounded_and_free
from disting.model.structure import Ports
from disting.model.symmetry import canonical


def is_plain(chain: Chain) -> bool:
    """Whether it consists of masses and springs alone."""
    return not (chain.damped or chain.ground_dampers or chain.lag or chain.dead_time)


def is_untested(chain: Chain) -> bool:
    """Whether the synthesis of this chain has no tests at all: undamped, one row or force and
    sensor at one mass of each row.

    Then every solution that is listed exists.
    """
    grounded, free = grounded_and_free(chain.structure)
    return is_plain(chain) and (grounded is None or grounded.distance == free.distance == 0)


def is_constructed(given: Chain, point: Mapping[str, fmpq], other: Chain) -> bool:
    """Whether a solution of `other` for the given model is proven to exist; False says nothing."""
    grounded, free = grounded_and_free(canonical(other).chain.structure)
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
        all(_exists(*pair) for pair in pairs)
        for pairs in exact_rows(given, point, whole, grounded, free)
    )


def exact_rows(
    given: Chain, point: Mapping[str, fmpq], whole: Target, grounded: Row, free: Row
) -> Iterator[list[tuple[Row, Target]]]:
    """Yield the receptances of both rows, of the right degrees, where the given chain's own
    poles are the ones to take.
    """
    for poles in _poles(given, point, whole):
        found = _summands(whole, poles) if poles.degree() == grounded.n_masses else None
        pairs = list(zip((grounded, free), found, strict=True)) if found else []
        if pairs and all(t.numerator.degree() == row.numerator_degree for row, t in pairs):
            yield pairs


def _poles(given: Chain, point: Mapping[str, fmpq], whole: Target) -> tuple[Exact, Exact]:
    """Denominator of the given chain's grounded row, and of its free row without the motion
    of the whole.
    """
    ports = Ports(0, given.act_plus, 0, given.meas_plus)
    free = target(replace(given.structure, ports=ports), point).folded(1).denominator
    return whole.denominator // free, free // type(free)([0, 1])


def _summands(whole: Target, poles: Exact) -> tuple[Target, Target] | None:
    """H = R + F with these poles for R."""
    others = whole.denominator // poles
    common, inverse, _ = others.xgcd(poles)
    if common.degree() > 0:
        return None
    top = whole.numerator * inverse % poles
    rest = (whole.numerator - top * others) // poles
    return Target(top, poles), Target(rest, others)


def _exists(row: Row, exact: Target) -> bool:
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            try:
                return any(isinstance(leaf, RowValues) for leaf in synthesise(row, exact.balls))
            except Imprecise:
                continue
    return False
