"""All transfer functions of a measured chain as one polynomial map, for the ideal of its fibre.

With w_i = 1/m_i, f = 1/T1 and the other parameters as they are, row i of A(s) times w_i is monic
in s where no inertia is added, and so are the denominators: equal transfer functions have equal
coefficients. Determinants and minors are linear in each mass, so a polynomial in the new
unknowns is the old one with the exponents of m_i turned, e -> 1 - e; the map is birational, which
leaves the closure of the image as it is. A denominator that is not monic takes one more unknown, a
common factor of all polynomials of its experiments (they are those of one fraction N_1 : N_2 : ..
: D only up to it). Parameters that occur in no entry are left out.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby

from flint import fmpz_mpoly

from disting.algebra.sampling import digest
from disting.experiments.experiment import Entry, MeasuredChain
from disting.experiments.polynomials import expanded, shape
from disting.fibres.ideals import Terms

REMEMBERED = 256
Fraction = tuple[tuple[Terms, ...], tuple[Terms, ...]]
"""Coefficients of numerator and denominator."""


@dataclass(frozen=True)
class StackedMap:
    """Parameters -> coefficients of all transfer functions, one after the other."""

    parameters: tuple[str, ...]
    coordinates: tuple[Terms, ...]

    @cached_property
    def content(self) -> str:
        """A digest of all that tells two maps apart."""
        return digest(self.parameters, self.coordinates)

    def __hash__(self) -> int:
        return hash(self.content)


def matched(left: MeasuredChain, right: MeasuredChain) -> tuple[StackedMap, StackedMap]:
    """Both maps, of equal degrees, in a form in which equal transfer functions are equal
    coordinates: entries share a denominator where they do on both sides.
    """
    sides = [[_fraction(e) for e in m.entries if shape(e).numerator] for m in (left, right)]
    shared = [(a[1], b[1]) for a, b in zip(*sides, strict=True)]
    order = sorted(range(len(shared)), key=lambda i: shared.index(shared[i]))
    groups = [list(g) for _, g in groupby(order, key=lambda i: shared.index(shared[i]))]
    monic = [all(_is_one(side[g[0]][1][-1]) for side in sides) for g in groups]
    return tuple(  # type: ignore[return-value]
        _stacked(m, side, groups, monic) for m, side in zip((left, right), sides, strict=True)
    )


def _stacked(
    measured: MeasuredChain,
    fractions: Sequence[Fraction],
    groups: Sequence[Sequence[int]],
    monic: Sequence[bool],
) -> StackedMap:
    names = measured.chain.parameters
    scales = [f"scale{k + 1}" for k, is_monic in enumerate(monic) if not is_monic]
    coordinates: list[Terms] = []
    at = 0
    for group, is_monic in zip(groups, monic, strict=True):
        whole = [*(c for i in group for c in fractions[i][0]), *fractions[group[0]][1]]
        factor = [0] * len(scales)
        if not is_monic:
            factor[at], at = 1, at + 1
        kept = whole[:-1] if is_monic else whole
        coordinates += [tuple(((*e, *factor), c) for e, c in terms) for terms in kept]
    used = sorted({j for terms in coordinates for e, _ in terms for j, x in enumerate(e) if x})
    return StackedMap(
        tuple([*names, *scales][j] for j in used),
        tuple(tuple((tuple(e[j] for j in used), c) for e, c in terms) for terms in coordinates),
    )


def _is_one(terms: Terms) -> bool:
    return len(terms) == 1 and terms[0][1] == 1 and not any(terms[0][0])


@lru_cache(maxsize=REMEMBERED)
def _fraction(entry: Entry) -> Fraction:
    """Coefficients in the new unknowns, without a common factor of them."""
    num, den = expanded(entry)
    names = entry.parameters
    turned = [
        j
        for j, name in enumerate(names)
        if (name[0] == "m" or name == "T1") and _occurs(j, num, den)
    ]
    sides = [_turned(p, turned) for p in (num, den)]
    every = [e for side in sides for e in side]
    common = [min(e[j] for e in every) for j in range(len(names) + 1)]
    return tuple(_by_power(side, common) for side in sides)  # type: ignore[return-value]


def _occurs(at: int, num: fmpz_mpoly, den: fmpz_mpoly) -> bool:
    return any(e[at + 1] for p in (num, den) for e in p.monoms())


def _turned(polynomial: fmpz_mpoly, at: Sequence[int]) -> dict[tuple[int, ...], int]:
    """Exponents of s and of all parameters, those at `at` turned."""
    chosen = {j + 1 for j in at}
    return {
        tuple(1 - int(x) if j in chosen else int(x) for j, x in enumerate(e)): int(c)
        for e, c in polynomial.to_dict().items()
    }


def _by_power(side: dict[tuple[int, ...], int], common: Sequence[int]) -> tuple[Terms, ...]:
    lowered = {tuple(x - y for x, y in zip(e, common, strict=True)): c for e, c in side.items()}
    top = max(e[0] for e in lowered)
    return tuple(
        tuple(sorted((e[1:], c) for e, c in lowered.items() if e[0] == power))
        for power in range(top + 1)
    )
