"""All transfer functions of a measured chain as one polynomial map, for the ideal of its fibre.

With w_i = 1/m_i, f = 1/T1 and the other parameters as they are, row i of A(s) times w_i is monic
in s where no inertia is added, and so are the denominators: equal transfer functions have equal
coefficients. Determinants and minors are linear in each mass, so a polynomial in the new
unknowns is the old one with the exponents of m_i turned, e -> 1 - e; the map is birational, which
leaves the closure of the image as it is. A denominator that is not monic takes one more unknown, a
common factor of all polynomials of its experiments (they are those of one fraction N_1 : N_2 : ..
: D only up to it). Parameters that occur in no entry are left out.

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
    by_mass = _by_mass(left, right)
    if by_mass is not None:
        return by_mass
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
    return _of_used([*names, *scales], coordinates)


def _by_mass(left: MeasuredChain, right: MeasuredChain) -> tuple[StackedMap, StackedMap] | None:
    """Both maps as (w, c0, c1), where the second experiment is the first one with an inertia."""
    here, there = _split(left), _split(right)
    if (
        here is None
        or there is None
        or (here.kind, len(here.parts))
        != (
            there.kind,
            len(there.parts),
        )
    ):
        return None
    pairs = list(zip(here.parts, there.parts, strict=True))
    if not any(not (a or c) and b and d for (a, b), (c, d) in pairs):
        return None
    seen = [(k, i) for k, (a, b) in enumerate(pairs) for i in (0, 1) if a[i] or b[i]]
    return tuple(  # type: ignore[return-value]
        _of_used(m.chain.parameters, [split.inverse_mass, *(split.parts[k][i] for k, i in seen)])
        for m, split in ((left, here), (right, there))
    )


@dataclass(frozen=True, slots=True)
class _Split:
    """w, and (c0, c1) of all coefficients; `kind`: the inertia's size, the numerator's length."""

    kind: tuple[object, ...]
    inverse_mass: Terms
    parts: tuple[tuple[Terms, Terms], ...]


def _split(measured: MeasuredChain) -> _Split | None:
    """None unless one inertia is all that is done in the second of two experiments."""
    if len(measured.experiments) != 2:
        return None
    first, second = measured.experiments
    if any(first.changes) or len(second.inertias) != 1:
        return None
    if replace(second, inertias=()) != first:
        return None
    ((mass, size),) = second.inertias
    num, den = _fraction(measured.entries[0])
    if not _is_one(den[-1]):
        return None
    names = measured.chain.parameters
    at = names.index(f"m{mass}")
    parts = tuple(_by_power_of(c, at) for c in (*num, *den[:-1]))
    one = tuple(int(k == at) for k in range(len(names)))
    return _Split((size, len(num)), ((one, 1),), parts)


def _by_power_of(terms: Terms, at: int) -> tuple[Terms, Terms]:
    """c0 and c1 of c0 + c1 w, w the unknown at a position."""
    without = tuple((e, c) for e, c in terms if not e[at])
    factor = tuple(((*e[:at], 0, *e[at + 1 :]), c) for e, c in terms if e[at])
    return without, factor


def _of_used(names: Sequence[str], coordinates: Sequence[Terms]) -> StackedMap:
    """The map in those of the parameters that occur in it."""
    used = sorted({j for terms in coordinates for e, _ in terms for j, x in enumerate(e) if x})
    return StackedMap(
        tuple(names[j] for j in used),
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
