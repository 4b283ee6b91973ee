"""All transfer functions of a measured chain as one polynomial map, for the ideal of its fibre.

With w_i = 1/m_i, f = 1/T1 and the other parameters as they are, row i of A(s) times w_i is monic
in s where no inertia is added, and so are the denominators. Determinants and minors are linear in
each mass, so a polynomial in the new unknowns is the old one with the exponents of m_i turned, e
-> 1 - e; the map is birational, which leaves the closure of the image as it is. One map of all
fractions is made by `fibres.ideals.stacked`.
"""

from collections.abc import Sequence
from functools import lru_cache

from flint import fmpz_mpoly

from disting.experiments.experiment import Entry, MeasuredChain
from disting.experiments.polynomials import expanded, shape
from disting.fibres.ideals import Fraction, StackedMap, Terms, stacked_maps

REMEMBERED = 256


def stacked_map(measured: MeasuredChain) -> StackedMap:
    """The map of one measured chain, for its fibre in itself."""
    return matched(measured, measured)[0]


def matched(left: MeasuredChain, right: MeasuredChain) -> tuple[StackedMap, StackedMap]:
    """Both maps, of equal degrees, in a form in which equal transfer functions are equal
    coordinates.
    """
    sides = [[_fraction(e) for e in m.entries if shape(e).numerator] for m in (left, right)]
    found = stacked_maps([m.chain.parameters for m in (left, right)], sides)
    return found[0], found[1]


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
