"""Transfer functions in s and in powers s^n of constant phase elements, as quotients of polynomials
in one variable.

For generic exponents n s and all s^n are algebraically independent (see the guide), so such a
function is a quotient of polynomials in as many variables. With v for s, or for s^(1/2) where
Warburg elements are, and v^w for s^n, it is one in v. Weights w larger than all powers that occur
in the product of two sides leave different monomials different, as digits of a number do: two
functions are equal exactly if they are equal in v (Kronecker 1882). What is common to both sides
then is a power of v, which is cancelled and remembered, or the weights are chosen again.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import permutations

from flint import fmpz_mpoly, nmod_poly

from disting.algebra.certainty import prime, residues
from disting.algebra.symbols import RationalFunction, symbol
from disting.errors import InputError
from disting.model.presentation import COUNTED, HALVES
from disting.network.network import Network

MOST_EXPONENTS = 4
MOST_TRIED = 64  # weights: one lot in thousands makes a common factor
Terms = tuple[tuple[tuple[int, ...], int], ...]
"""A polynomial in the parameters: exponents and coefficient of each term, in falling
lexicographic order.
"""
Side = Mapping[tuple[int, ...], Terms]
"""Numerator or denominator: its coefficients by the powers of s, or s^(1/2), and of every s^n."""
Cell = tuple[Side, Side]


@dataclass(frozen=True, slots=True)
class Powers:
    """Meaning of the powers of v: v is s^(1/2) with `halves`, else s; `weights` of the exponents by
    name, that of s^n in v, rising; v^lost was cancelled; `unseen` exponents do not appear.

    >>> Powers(weights=(("n1", 5),)).parts(12)
    (2, 2)
    """

    halves: bool = False
    weights: tuple[tuple[str, int], ...] = ()
    lost: int = 0
    unseen: tuple[str, ...] = ()

    @property
    def exponents(self) -> tuple[str, ...]:
        """Names of those that enter."""
        return tuple(name for name, _ in self.weights)

    @property
    def placed(self) -> "Powers":
        """The same with exponents that are called by their places: those of two networks that are
        matched have one name.
        """
        weights = tuple((place_name(i), w) for i, (_, w) in enumerate(self.weights))
        return replace(self, weights=weights)

    @property
    def step(self) -> int:
        """s as a power of v."""
        return 1 + self.halves

    def parts(self, power: int) -> tuple[int, ...]:
        """The powers of s, or s^(1/2), and of every s^n that a power of v denotes."""
        left, numbers = power + self.lost, list[int]()
        for _, weight in reversed(self.weights):
            many, left = divmod(left, weight)
            numbers.append(many)
        return (left, *reversed(numbers))

    def power(self, parts: Sequence[int]) -> int:
        """The power of v, before anything is cancelled."""
        first, *others = parts
        return first + sum(w * n for (_, w), n in zip(self.weights, others, strict=True))

    def exponent(self, power: int) -> object:
        """v^power as a power of s, for SymPy."""
        from sympy import Rational

        first, *others = self.parts(power)
        named = (symbol(n) * k for n, k in zip(self.exponents, others, strict=True))
        return sum(named, Rational(first, self.step))

    def text(self, power: int) -> str:
        """v^power as a power of s, as Python writes it; "" for 1.

        >>> Powers(True, (("n1", 5),)).text(6), Powers(True).text(1), Powers().text(2)
        ('s**(1/2 + n1)', 'sqrt(s)', 's**2')
        """
        first, *others = self.parts(power)
        weighted = zip(others, self.exponents, strict=True)
        summands = [str(Fraction(first, self.step))] if first else []
        summands += [n if k == 1 else f"{k}*{n}" for k, n in weighted if k]
        exponent = " + ".join(summands)
        short = {"": "", "1": "s", "1/2": "sqrt(s)"}
        return short.get(exponent, f"s**{exponent}" if exponent.isalnum() else f"s**({exponent})")

    def of_element(self, halves: int, exponent: str) -> int:
        """The power of v of an element's power of s."""
        whole, odd = divmod(halves * self.step, 2)
        if odd:
            raise ValueError("half powers are counted in powers of s")
        return whole + dict(self.weights).get(exponent, 0)

    def sentence(self, model: str) -> str:
        """Sentence on the variable that degrees of a model of this name count; "" where they count
        powers of s.

        >>> Powers(True, (("n1", 5),)).sentence("R0-p(W1,P1)")
        'degrees count powers of v: in R0-p(W1,P1) s = v^2, s^n1 = v^5'
        """
        if not self.weights:
            return HALVES if self.halves else ""
        rows = [("s", self.step)] if self.halves or self.weights[0][1] > 1 else []
        rows += [(f"s^{name}", weight) for name, weight in self.weights]
        equal = (f"{power} = v" + (f"^{weight}" if weight > 1 else "") for power, weight in rows)
        return f"{COUNTED}v: in {model} {', '.join(equal)}"


PLAIN = Powers()


def place_name(place: int) -> str:
    """Name of the exponent of a place when networks are matched."""
    return f"n{place + 1}"


def placed_network(network: Network, powers: Powers) -> Network:
    """A network with exponents that are called by their places in these powers."""
    if not network.exponents:
        return network
    every = [*powers.exponents, *(n for n in network.exponents if n not in powers.exponents)]
    names = {"": ""} | {name: place_name(at) for at, name in enumerate(every)}
    elements = tuple(replace(e, exponent=names[e.exponent]) for e in network.elements)
    return replace(network, elements=elements)


def powers_of(
    ratios: Sequence[RationalFunction], halves: bool, exponents: Sequence[str], size: int
) -> Powers:
    """Weights for these functions in rings of s, the exponents and so many parameters; raises
    InputError for too many exponents.

    Exponents come in the order in which the powers that occur are the least: the same for two
    functions that differ by an exchange of exponents, ties aside (`orders`).
    """
    if not exponents:
        return Powers(halves)
    cells = [cell_in(ratio, exponents, size) for ratio in ratios]
    used = [j for j, name in enumerate(exponents) if _degree(cells, j + 1)]
    unseen = tuple(name for j, name in enumerate(exponents) if j not in used)
    if len(used) > MOST_EXPONENTS:
        raise InputError(
            f"a network has {MOST_EXPONENTS} different exponents at most, not {len(used)}: let some"
            " elements share one"
        )
    first, *_ = _orders(cells, used)
    names = [exponents[j] for j in first]
    kept = [cell_in(ratio, names, size) for ratio in ratios]
    return replace(separating_weights(kept, halves, names), unseen=unseen)


def separating_weights(cells: Sequence[Cell], halves: bool, names: Sequence[str]) -> Powers:
    """Weights that keep all monomials of products of two sides apart, and both sides of each cell
    without a common factor but v.
    """
    tops = [2 * _degree(cells, j) + 1 for j in range(len(names) + 1)]
    for more in range(MOST_TRIED):
        weights, size = list[tuple[str, int]](), 1
        for name, top in zip(names, tops, strict=False):
            size *= top + more
            weights.append((name, size))
        powers = Powers(halves, tuple(weights))
        if all(_is_coprime(cell, powers) for cell in cells):
            return powers
    raise InputError("the functions have a common factor for all weights of their exponents")


def cell_in(ratio: RationalFunction, exponents: Sequence[str], size: int) -> Cell:
    """Both sides of a function in a ring that begins with s, has these exponents among its
    generators, and ends with so many parameters.
    """
    return _side(ratio.num, exponents, size), _side(ratio.den, exponents, size)


def in_v(cell: Cell, powers: Powers) -> tuple[tuple[Terms, ...], tuple[Terms, ...], Powers]:
    """Coefficients of v^0, v^1, .. of both sides, and what was cancelled."""
    sides = [{powers.power(parts): terms for parts, terms in side.items()} for side in cell]
    lost = min(power for side in sides for power in side)
    top, bottom = (
        tuple(side.get(power, ()) for power in range(lost, max(side, default=lost) + 1))
        for side in sides
    )
    return top, bottom, replace(powers, lost=lost)


def out_of_v(sides: tuple[tuple[Terms, ...], tuple[Terms, ...]], powers: Powers) -> Cell:
    """Inverse of `in_v`."""
    top, bottom = (
        {powers.parts(power): terms for power, terms in enumerate(side) if terms} for side in sides
    )
    return top, bottom


def orders(cells: Sequence[Cell], size: int) -> Iterator[tuple[int, ...]]:
    """Yield the orders of so many exponents, other than their own, in which the same powers occur:
    those in which another function's exponents may be theirs.
    """
    own, *others = _orders(cells, range(size))
    if own == tuple(range(size)):
        yield from others


def _orders(cells: Sequence[Cell], chosen: Iterable[int]) -> list[tuple[int, ...]]:
    """The orders of the chosen exponents for which the powers that occur are the least."""
    entries: dict[object, list[tuple[int, ...]]] = {}
    for order in permutations(chosen):
        key = tuple(
            tuple(sorted((p[0], *(p[j + 1] for j in order)) for p in side))
            for cell in cells
            for side in cell
        )
        entries.setdefault(key, []).append(order)
    return entries[min(entries)]  # type: ignore[type-var]


def _side(polynomial: fmpz_mpoly, exponents: Sequence[str], size: int) -> Side:
    names = polynomial.context().names()
    places = [0, *(names.index(name) for name in exponents)]
    behind = len(names) - size
    entries: dict[tuple[int, ...], list[tuple[tuple[int, ...], int]]] = {}
    for powers, number in polynomial.to_dict().items():
        key = tuple(int(powers[at]) for at in places)
        entries.setdefault(key, []).append((tuple(map(int, powers[behind:])), int(number)))
    return {key: tuple(sorted(terms, reverse=True)) for key, terms in entries.items()}


def _degree(cells: Iterable[Cell], at: int) -> int:
    return max((parts[at] for cell in cells for side in cell for parts in side), default=0)


def _is_coprime(cell: Cell, powers: Powers) -> bool:
    """Return True if both sides have no common factor in v: shown at one point modulo a prime,
    where they keep their degrees.
    """
    top, bottom, _ = in_v(cell, powers)
    size = len((top[-1] or bottom[-1])[0][0])
    modulus = prime("weights")
    point = residues("weights", size, modulus)
    sides = [
        nmod_poly([_value(c, point, modulus) for c in side], modulus) for side in (top, bottom)
    ]
    kept = [side.degree() + 1 == len(c) for side, c in zip(sides, (top, bottom), strict=True)]
    return all(kept) and bool(sides[0].gcd(sides[1]).degree() == 0)


def _value(terms: Terms, point: Sequence[int], modulus: int) -> int:
    total = 0
    for exponents, number in terms:
        for x, e in zip(point, exponents, strict=True):
            number = number * pow(x, e, modulus) % modulus
        total += number
    return total % modulus
