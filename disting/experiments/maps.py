"""All transfer functions of a measured chain as one polynomial map, for the ideal of its fibre.

With w_i = 1/m_i, f = 1/T1 and the other parameters as they are, row i of A(s) times w_i is monic
in s where no inertia is added, and so are the denominators. Determinants and minors are linear in
each mass, so a polynomial in the new unknowns is the old one with the exponents of m_i turned, e
-> 1 - e; the map is birational, which leaves the closure of the image as it is. One map of all
fractions is made by `fibres.ideals.stacked_map`.

One inertia J that is added to mass i, and nothing else, turns w = 1/m_i into w' = w/(1 + J w) in
the same polynomials: each coefficient c0 + c1 w (linear in w, as determinants are) becomes c0 + c1
w'. Where c0 is the constant 0 in some coefficient, c and c' of it give w = (c/c' - 1)/J, then w',
and each other pair gives c1 = (c - c')/(w - w') and c0. So (c, c') and (w, c0, c1) are birational
images of each other by formulas that speak of no model: two models whose c0 vanishes in the same
coefficient, with the same J, have equal closures of the ones where they have equal closures of
the others. c0 are the coefficients with mass i locked. The new coordinates are of lower degree, no
scale is unknown, and J does not occur in them. The lowest coefficient of a numerator, that of the
motion at rest, is always such a one.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from flint import fmpz_mpoly

from disting.experiments.experiment import Entry, MeasuredChain
from disting.experiments.machine_model import expand, shape
from disting.fibres.ideals import Fraction, StackedMap, Terms, stacked_maps
from disting.fibres.ideals.stacked_map import is_one, map_of

REMEMBERED = 256
OF_MASSES = 2  # power of s with which a mass stands in A(s), so what adds to it


def stacked_map(measured: MeasuredChain) -> StackedMap:
    """The map of one measured chain, for its fibre in itself."""
    return match_maps(measured, measured)[0]


def match_maps(left: MeasuredChain, right: MeasuredChain) -> tuple[StackedMap, StackedMap]:
    """Both maps, of equal degrees, in a form in which equal transfer functions are equal
    coordinates.
    """
    by_mass = _by_mass(left, right)
    if by_mass is not None:
        return by_mass
    sides = [[_fraction(e) for e in m.entries if shape(e).numerator] for m in (left, right)]
    maps = stacked_maps([m.chain.parameters for m in (left, right)], sides)
    return maps[0], maps[1]


def _by_mass(left: MeasuredChain, right: MeasuredChain) -> tuple[StackedMap, StackedMap] | None:
    """Both maps as (w, c0, c1), where the second experiment is the first one with an inertia."""
    first, second = _split(left), _split(right)
    if first is None or second is None or first.kind != second.kind:
        return None
    numerators = zip(first.parts[0], first.parts[1], second.parts[0], second.parts[1], strict=True)
    if not any(b and d and not (a or c) for a, b, c, d in numerators):
        return None
    observed = [
        [k for k, pair in enumerate(zip(*part, strict=True)) if any(pair)]
        for part in zip(first.parts, second.parts, strict=True)
    ]
    return tuple(  # type: ignore[return-value]
        map_of(
            m.chain.parameters,
            [
                [split.inverse_mass],
                *(
                    [part[k] for k in kept]
                    for part, kept in zip(split.parts, observed, strict=True)
                ),
            ],
        )
        for m, split in ((left, first), (right, second))
    )


@dataclass(frozen=True, slots=True)
class _Split:
    """w, and c0 and c1 of the numerator, c0 and c1 of the denominator; `kind`: the inertia's size
    and how many coefficients there are.
    """

    kind: tuple[object, ...]
    inverse_mass: Terms
    parts: tuple[tuple[Terms, ...], ...]


def _split(measured: MeasuredChain) -> _Split | None:
    """None unless one inertia is all that is done in the second of two experiments."""
    if len(measured.experiments) != 2:
        return None
    first, second = measured.experiments
    if first.changes or len(second.changes) != 1 or replace(second, changes=()) != first:
        return None
    (change,) = second.changes
    if change.kind.power != OF_MASSES:
        return None
    mass, size = change.place, change.size
    num, den = _fraction(measured.entries[0])
    if not is_one(den[-1]):
        return None
    names = measured.chain.parameters
    at = names.index(f"m{mass}")
    parts = tuple(
        tuple(_factor(c, at, power) for c in side) for side in (num, den[:-1]) for power in (0, 1)
    )
    exponents = tuple(int(k == at) for k in range(len(names)))
    return _Split((size, len(num), len(den)), ((exponents, 1),), parts)


def _factor(terms: Terms, at: int, power: int) -> Terms:
    """Factor of this power of the unknown at a position."""
    return tuple(((*e[:at], 0, *e[at + 1 :]), c) for e, c in terms if e[at] == power)


@lru_cache(maxsize=REMEMBERED)
def _fraction(entry: Entry) -> Fraction:
    """Coefficients in the new unknowns, without a common factor of them."""
    num, den = expand(entry)
    names = entry.parameters
    turned = [
        j
        for j, name in enumerate(names)
        if (name[0] == "m" or name == "T1") and _occurs(j, num, den)
    ]
    sides = [_turn_exponents(p, turned) for p in (num, den)]
    every = [e for side in sides for e in side]
    common = [min(e[j] for e in every) for j in range(len(names) + 1)]
    return tuple(_by_power(side, common) for side in sides)  # type: ignore[return-value]


def _occurs(at: int, num: fmpz_mpoly, den: fmpz_mpoly) -> bool:
    return any(e[at + 1] for p in (num, den) for e in p.monoms())


def _turn_exponents(polynomial: fmpz_mpoly, at: Sequence[int]) -> dict[tuple[int, ...], int]:
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
