"""Inclusion of the transfer functions of one network in those of another one, special values
included.

THEOREM. A part of two kinds in series and parallel gives, for all positive values, exactly the
union of K(m, c, z) for least <= m <= most, whole sets: one element m = 0; in series c, z are those
of any branch, most is the sum, least the largest of the branches; in parallel the same is true of
1/(x F), which turns K(m, c, z) into K(m + c + z - 1, not c, not z).
Proof, by the number of elements. In series all coefficients k are positive, so neither a pole nor a
constant nor a pole at 0 of a branch vanishes in the sum. So F has at least as many poles as any of
its branches, and at most as many as all together; branches may share some. Conversely, let F in
K(m, c, z) be given, m between least and most. Choose m_i within the bounds of each branch, none
above m, with a sum of m or more. Such are found: from all m_i at their least, raise one at a time
by 1 to their most; the intervals from the largest m_i to their sum begin at least, end at most, and
have no gaps, as neither end rises by more than 1. Give each branch m_i of the m poles, so that each
pole is given to one at least, and to branches that share a pole, k or k_0, positive parts of it. By
the induction each branch gives what it is given. In parallel 1/(x F) maps the sets one to one (see
`disting.network.normal_form`).

K(m, c, z) of different m, c, z have no function in common. So of two one-ports of the same two
kinds the one's functions are among the other's exactly if c, z are the same and its numbers m are
among the other's. Values of different parts are chosen independently; so in any networks that are
the same graph with parts at its edges, the one gives no more than the other one if none of its
parts does.
"""

from disting.network.network import Network
from disting.network.normal_form import NormalForm, Part, exact_form
from disting.network.simplest import canonical_numbers

TWO = 2  # kinds of elements


def within(inner: Network, outer: Network) -> bool | None:
    """Decide whether every transfer function of one network for positive values, special ones
    included, is one of the other network; None where that is unknown.

    >>> from disting.network.notation import network_of
    >>> foster, cauer = network_of("p(R1,C1)-p(R2,C2)"), network_of("p(C1,R1-p(C2,R2))")
    >>> within(cauer, foster), within(foster, cauer)
    (True, False)
    >>> within(network_of("p(R1,C1)"), foster)
    True
    """
    if (inner.sort, inner.order, inner.shape) != (outer.sort, outer.order, outer.shape):
        return None
    the_pairs = [exact_form(n) for n in (inner, outer)]
    if None in the_pairs or inner.exponents or outer.exponents:
        return None
    drawn, other_drawn = (
        canonical_numbers(n, NormalForm(edges or (), ()))
        for n, edges in zip((inner, outer), the_pairs, strict=True)
    )
    (ports, left, _), (others, right, _) = drawn, other_drawn
    if ports != others or [ends for ends, _ in left] != [ends for ends, _ in right]:
        return None
    pairs = [(a, b) for (_, a), (_, b) in zip(left, right, strict=True)]
    if all(_gives_no_more(a, b) for a, b in pairs):
        return True
    alone = len(pairs) == 1 and all(not p.others and len(p.kinds) == TWO for p in pairs[0])
    return False if alone and pairs[0][0].kinds == pairs[0][1].kinds else None


def _gives_no_more(part: Part, other: Part) -> bool:
    """Return True if another part gives everything that a part gives, as far as the theorem
    decides.
    """
    if (part.form, part.single, len(part.others)) != (other.form, other.single, len(other.others)):
        return False
    terms, wanted = dict(part.terms), dict(other.terms)
    spare, missing = dict(part.spare), dict(other.spare)
    for pair in terms.keys() | wanted.keys():
        most, bound = terms.get(pair, 0), wanted.get(pair, 0)
        if most > bound or most - spare.get(pair, 0) < bound - missing.get(pair, 0):
            return False
    return all(_gives_no_more(a, b) for a, b in zip(part.others, other.others, strict=True))
