"""Damped chains of equal rank told apart by the shares of the numerator's roots, whole or by the
one part in which they differ.

Chains of one row are rows themselves. Of two chains with a gap at the same place, one part may be
the same in both. Let H = R + F be generic of the first, and suppose that its parts satisfy
conditions 1 and 2 of the theorem in `parts`. Condition 3 holds: receptances of damped rows fall as
s^-2. Its proof speaks of poles that are not zero. The pole of F at zero, double or, with dampers
to the ground, simple, belongs to the free part of both chains: the second one's grounded part,
generic too, has none. In the second case of that proof the residues at S sum to lim s H minus
those of the free part, which sum to zero, the residue at zero included; so they do here.
Multiplying all elements of R includes its dampers to the ground. So the second chain's 2 h poles S
hold all or none of the 2 h roots of D_R, and all or none of the roots of E. If E has not 2 h
roots, S holds just those of D_R: the second chain has the same R and the same F. Where the
closures of H are equal, so are those of R and those of F; equal ranks of H and one common part
mean equal ranks of the other: it is enough to tell the others apart.
"""

from dataclasses import replace

from disting.evidence.ideals import Shared
from disting.ideals.factored import FactoredMap, factored
from disting.ideals.monodromy import poles_are_inseparable
from disting.ideals.parts import gap
from disting.ideals.shares import told_apart
from disting.ideals.system import Span, rows
from disting.model.structure import Structure

PARTS = ("grounded", "free")
Pair = tuple[FactoredMap, FactoredMap]


def chains_told_apart(a: Structure, b: Structure, seed: str) -> tuple[Shared, int] | None:
    """Evidence that two damped chains of equal rank and size have different closures, and its
    bits; None where there is none.

    >>> from disting.model.chain import Chain
    >>> chains = (Chain(3, 0, 0, 1, 0, 3, damped=True, ground_dampers=(m,)) for m in (1, 2))
    >>> chains_told_apart(*(c.structure for c in chains), "doc") is None  # they are the same
    True
    """
    if not _comparable(a, b):
        return None
    spans = [span for span, _ in rows(a)]
    pairs = [(factored(a, span), factored(b, span)) for span in spans]
    unequal = [k for k, (one, other) in enumerate(pairs) if one.name != other.name]
    if len(unequal) != 1:
        return None
    at = unequal[0]
    if len(pairs) == 1:
        return told_apart(*pairs[at], seed)
    found = told_apart(*pairs[at], seed) if _stay_together(a, b, seed) else None
    return found and (replace(found[0], part=PARTS[at]), found[1])


def _comparable(a: Structure, b: Structure) -> bool:
    """Damped rows at the same places, with ports in each, without lag and dead time."""
    kinds = [(s.n_masses, s.sensor_order, s.row_ends, _spans(s)) for s in (a, b)]
    plain = not any(s.lag or s.dead_time for s in (a, b)) and all(
        any(e.kind == "d" for e in s.elements) for s in (a, b)
    )
    return plain and kinds[0] == kinds[1] and len(a.row_ends) == len(kinds[0][3])


def _spans(structure: Structure) -> tuple[Span, ...]:
    return tuple(span for span, _ in rows(structure))


def _stay_together(a: Structure, b: Structure, seed: str) -> bool:
    """Whether the poles of the parts of both are inseparable, and no other set is as large as
    the grounded part's.
    """
    free = factored(a, _spans(a)[1])
    return len(free.poles) != 2 * gap(a) and all(
        poles_are_inseparable(s, f"shares:{seed}:poles") for s in (a, b)
    )
