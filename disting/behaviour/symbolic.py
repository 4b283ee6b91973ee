"""Moment invariants as polynomials in the parameters, and the rows of their Jacobian: where a rank
is proven, not sampled.

With G = num/den of (24), leading coefficient c of the denominator: coefficient (25) number i is
n_i / c or d_i / c, and Markov parameter (30) number k is g_k / c^(k+1), g_k = c^k n_(m-k) -
sum_(i=1..k) d_(m-i) c^(i-1) g_(k-i), m the denominator's degree.

All G_k but G_0 are functions of the coefficients of G - G_0 (numerator r_i / c^2, r_i = c n_i -
n_m d_i), so their rank is at most that of these coefficients: fewer and shorter polynomials.

Other units of force and of time multiply parameters and invariants by constants, so they leave the
rank alone. In the units in which the first mass and the first spring are one, the Jacobian has two
symbols less.
"""

from collections.abc import Sequence

from flint import fmpz_mpoly

from disting.algebra.fractionfree import rank
from disting.algebra.symbols import coefficients
from disting.behaviour.expanded import expanded
from disting.model.structure import Structure


def rank_is_at_most(structure: Structure, labels: Sequence[str], most: int, seconds: float) -> bool:
    """Proof that the Jacobian's rows with these labels (b_i, a_i, G_k; none = all coefficients)
    have no larger generic rank.

    False says nothing. Raises OutOfTimeError after about `seconds`.

    >>> from disting.model.family import Family
    >>> rank_is_at_most(Family(3, damped=True)[7].structure, (), 6, 5.0)
    True
    """
    tops, bottoms, lead = _normalised(structure)
    if labels and all(name[0] == "G" and name != "G0" for name in labels):
        proper = [
            *((r, 2) for r in _strictly_proper(tops, bottoms)),
            *((d, 1) for d in bottoms[:-1]),
        ]
        if rank([_row(structure, *entry, lead) for entry in proper], seconds) <= most:
            return True
    names = labels or [f"b{i}" for i in range(len(tops))] + [
        f"a{i}" for i in range(len(bottoms) - 1)
    ]
    return (
        rank([_row(structure, *_invariant(name, tops, bottoms), lead) for name in names], seconds)
        <= most
    )


def _normalised(structure: Structure) -> tuple[list[fmpz_mpoly], list[fmpz_mpoly], fmpz_mpoly]:
    tops, bottoms = (coefficients(part, "s") for part in expanded(structure))
    return tops, bottoms, bottoms[-1]


def _invariant(
    name: str, tops: list[fmpz_mpoly], bottoms: list[fmpz_mpoly]
) -> tuple[fmpz_mpoly, int]:
    """Numerator of an invariant, and the power of the leading coefficient below it."""
    kind, number = name[0], int(name[1:])
    if kind == "G":
        return _markov(number, tops, bottoms), number + 1
    chosen = tops if kind == "b" else bottoms
    return (chosen[number] if number < len(chosen) else 0 * bottoms[0]), 1


def _strictly_proper(tops: list[fmpz_mpoly], bottoms: list[fmpz_mpoly]) -> list[fmpz_mpoly]:
    """r_i of G - G_0."""
    if len(tops) < len(bottoms):
        return [bottoms[-1] * n for n in tops]
    return [bottoms[-1] * n - tops[-1] * d for n, d in zip(tops[:-1], bottoms[:-1], strict=True)]


def _markov(number: int, tops: list[fmpz_mpoly], bottoms: list[fmpz_mpoly]) -> fmpz_mpoly:
    """g_k by the recursion."""
    lead, m, zero = bottoms[-1], len(bottoms) - 1, 0 * bottoms[0]
    found: list[fmpz_mpoly] = []
    for k in range(number + 1):
        g = lead**k * (tops[m - k] if 0 <= m - k < len(tops) else zero)
        for i in range(1, min(k, m) + 1):
            g -= bottoms[m - i] * lead ** (i - 1) * found[k - i]
        found.append(g)
    return found[number]


def _row(structure: Structure, top: fmpz_mpoly, power: int, lead: fmpz_mpoly) -> list[fmpz_mpoly]:
    """Gradient of top / lead^power, times lead^(power+1), in the units where the first mass and
    the first spring are one.
    """
    names = [name for name in structure.parameters if name != "Td"]
    units: dict[str | int, int] = {
        next(name for name in names if name[0] == kind): 1
        for kind in "mk"
        if any(name[0] == kind for name in names)
    }
    value, below = (p.subs(units) for p in (top, lead))
    return [
        top.derivative(name).subs(units) * below - power * value * lead.derivative(name).subs(units)
        for name in names
    ]
