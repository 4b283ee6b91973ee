"""Chains with dampers, of equal rank, distinguished by the shares of the numerator's roots, whole
or by the one row in which they differ.

Chains of one row are rows themselves. Of two chains with a gap at the same place, one row may be
the same in both. Let H = R + F be generic of the first, and suppose that its rows satisfy
conditions 1 and 2 of the theorem in `splits`, with x = s. Condition 3 holds: receptances of rows
fall as s^-2 at least. (A row of several masses without any damper, next to one with dampers to the
ground, is even in s and seldom satisfies condition 1; nothing is claimed in that case.) Its proof
is for nonzero poles. The pole of F at zero, double or, with dampers to the ground, simple, belongs
to the free row of both chains: the second one's grounded row, generic too, has none. In the second
case of that proof the residues at S sum to lim s H minus those of the free row, which sum to zero,
the residue at zero included; so they do here. Multiplying all elements of R includes its dampers to
the ground. So the second chain's 2 h poles S hold all or none of the 2 h roots of D_R, and all or
none of the roots of E. If E has not 2 h roots, S holds just those of D_R: the second chain has the
same R and the same F. Where the closures of H are equal, so are those of R and those of F; equal
ranks of H and one common row mean equal ranks of the other: it is enough to distinguish the others.
"""

from collections.abc import Sequence
from dataclasses import replace

from disting.evidence.ideals import NoShares
from disting.fibres.ideals.factored_map import row_factors
from disting.fibres.ideals.shares import TRIES, Try, tell_apart
from disting.fibres.ideals.splits import gap, poles_are_inseparable
from disting.model.chain import Structure
from disting.model.row import rows_of


def tell_chains_apart(
    a: Structure, b: Structure, seed: str, tries: Sequence[Try] = TRIES
) -> tuple[NoShares, int] | None:
    """Evidence that two chains with dampers, of equal rank and size, have different closures, and
    its bits; None where there is none.

    >>> from disting.model.chain import Chain
    >>> chains = (Chain(3, 0, 0, 1, 0, 3, damped=True, ground_dampers=(m,)) for m in (1, 2))
    >>> tell_chains_apart(*(c.structure for c in chains), "doc") is None  # they are the same
    True
    """
    if not _comparable(a, b):
        return None
    pairs = zip(rows_of(a), rows_of(b), strict=True)
    maps = [(row, row_factors(row), row_factors(other)) for row, other in pairs]
    unequal = [m for m in maps if m[1].name != m[2].name]
    if len(unequal) != 1:
        return None
    row, mine, theirs = unequal[0]
    if row.is_whole:
        return tell_apart(mine, theirs, seed, tries)
    shared = tell_apart(mine, theirs, seed, tries) if _stay_together(a, b, seed) else None
    return shared and (replace(shared[0], part=row.name), shared[1])


def _comparable(a: Structure, b: Structure) -> bool:
    """Rows at the same places, with ports in each, with dampers, without lag and dead time."""
    kinds = [(s.n_masses, s.sensor_order, s.row_ends) for s in (a, b)]
    plain = not any(s.lag or s.dead_time for s in (a, b)) and all(
        any(e.kind in "db" for e in s.elements) for s in (a, b)
    )
    complete = all(len(rows_of(s)) == len(s.row_ends) for s in (a, b))
    return plain and kinds[0] == kinds[1] and complete


def _stay_together(a: Structure, b: Structure, seed: str) -> bool:
    """Return True if the poles of the rows of both are inseparable, and no other set is as large as
    the grounded row's.
    """
    free = row_factors(rows_of(a)[-1])
    return len(free.poles) != 2 * gap(a) and all(
        poles_are_inseparable(s, f"shares:{seed}:poles") for s in (a, b)
    )
