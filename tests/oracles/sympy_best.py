"""SymPy at its best: a fair speed to compare with. Invariants, ranks and conditions 1 to 5 for all
pairs of a family.

The same work as `sympy_twin` with its waste removed, still on SymPy's own polynomials and matrices:

- 1/m_i are generators of the ring, so that all invariants are polynomials over ZZ and no fraction
  is ever cancelled;
- (I s - A)^-1 and the powers of A are applied to one column; models with the same gap share the
  denominator, models with the same gap and force the columns; sensors measure accelerations, read
  off as s times the velocities;
- no derivative is formed: one pass over the terms of a polynomial gives its gradient at a random
  point modulo 2^61 - 1;
- numerator and denominator are shown to be coprime by a univariate gcd at that point, not by a
  multivariate one;
- sets of independent rows are listed only for models that conditions 1 to 4 leave together with
  another one.

The 4-mass damped class with G_0..G_12 takes 2.7 s on one core, with SymPy's ground types flint and
python alike; the plain twin takes 25 to 30 s, and 45 s more with the textbook inverse.

Run `python -m tests.oracles.sympy_best [masses] [count] [undamped]`.
"""

import random
import sys
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, groupby
from math import prod
from typing import Any

from sympy import GF, ZZ
from sympy.external.gmpy import GROUND_TYPES
from sympy.polys.galoistools import gf_gcd
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import PolyElement

from disting.model.family import Family
from tests.oracles.sympy_twin import polynomial_form

PRIME = 2**61 - 1
FIELD = GF(PRIME, symmetric=False)

Invariants = list[PolyElement]
Monomial = tuple[int, ...]


@dataclass(frozen=True)
class Profile:
    """What conditions 1 to 5 compare; `split` is the number of numerator coefficients, 0 for
    Markov parameters.
    """

    entries: Invariants
    split: int
    point: "Point"

    @cached_property
    def symbolic_form(self) -> tuple[bool, ...]:
        """True for non-constant invariants."""
        return tuple(not entry.is_ground for entry in self.entries)

    @cached_property
    def rows(self) -> DomainMatrix:
        """The Jacobian's rows of the non-constant invariants at the point."""
        rows = [
            [FIELD(x) for x in self.point.gradient(entry)]
            for entry in self.entries
            if not entry.is_ground
        ]
        return DomainMatrix(rows, (len(rows), len(self.point.numbers)), FIELD).to_sparse()

    @cached_property
    def rank(self) -> int:
        """Generic rank."""
        return int(self.rows.rank())

    @cached_property
    def bases(self) -> frozenset[tuple[int, ...]]:
        """Largest sets of independent rows, counted among the non-constant invariants.

        With the rows written in a basis of them, [I | X], a set is independent exactly if the
        minor of X that belongs to the rows it has in place of basis rows is not zero.
        """
        reduced, basis = self.rows.transpose().rref()
        found = []
        for rows in combinations(range(self.rows.shape[0]), self.rank):
            added = [row for row in rows if row not in basis]
            dropped = [place for place, row in enumerate(basis) if row not in rows]
            if reduced.extract(dropped, added).rank() == len(added):
                found.append(rows)
        return frozenset(found)


class Point:
    """A random point modulo the prime; the values of half monomials are kept, for they come
    again and again.
    """

    def __init__(self, n_parameters: int, seed: int) -> None:
        draw = random.Random(seed)
        self.numbers = [draw.randrange(1, PRIME) for _ in range(n_parameters)]
        self._half = n_parameters // 2
        self._lower: dict[Monomial, int] = {}
        self._upper: dict[Monomial, int] = {}

    def value(self, polynomial: PolyElement) -> int:
        """Value modulo the prime."""
        return sum(self._sums(polynomial)[0].values()) % PRIME

    def gradient(self, polynomial: PolyElement) -> list[int]:
        """Derivatives modulo the prime: a term t = c x^e has dt/dx = e t/x."""
        lower, upper = self._sums(polynomial)
        weighted = [
            sum(monomial[i] * total for monomial, total in sums.items())
            for sums, width in ((lower, self._half), (upper, len(self.numbers) - self._half))
            for i in range(width)
        ]
        return [
            total * pow(x, -1, PRIME) % PRIME
            for total, x in zip(weighted, self.numbers, strict=True)
        ]

    def _sums(self, polynomial: PolyElement) -> tuple[Counter[Monomial], Counter[Monomial]]:
        """Sums of the terms with the same exponents in the lower half of the parameters, and in
        the upper half.
        """
        lower, upper, half = Counter(), Counter(), self._half
        for monomial, coefficient in polynomial.items():
            low, high = monomial[:half], monomial[half:]
            if low not in self._lower:
                self._lower[low] = self._monomial(low, self.numbers[:half])
            if high not in self._upper:
                self._upper[high] = self._monomial(high, self.numbers[half:])
            term = int(coefficient) * self._lower[low] * self._upper[high]
            lower[low] += term
            upper[high] += term
        return lower, upper

    def _monomial(self, exponents: Monomial, numbers: Sequence[int]) -> int:
        return prod(pow(x, e, PRIME) for x, e in zip(numbers, exponents, strict=True)) % PRIME


def profiles(chains: Iterable[Any], count: int) -> tuple[list[Profile], list[Profile]]:
    """Profiles by coefficients and by G_0..G_count, in the order of the chains, which are
    sorted by gap and force.
    """
    by_coefficients, by_series = [], []
    for gap, same_gap in groupby(chains, key=lambda chain: chain.gap):
        denominator: Invariants = []
        for _, group in groupby(same_gap, key=lambda chain: (chain.act_minus, chain.act_plus)):
            same_force = list(group)
            a, b, _, _ = polynomial_form(same_force[0])
            denominator = denominator or a.charpoly()[::-1]
            point = Point(a.domain.ngens, seed=gap)
            powers, adjugate = _powers(a, b, count), _adjugate(a, b, denominator)
            for chain in same_force:
                numerator = [a.domain.zero, *(_velocity(chain, column) for column in adjugate)]
                by_coefficients.append(_cancelled(numerator, denominator, point))
                by_series.append(Profile([_velocity(chain, column) for column in powers], 0, point))
    return by_coefficients, by_series


def first_failing(left: Profile, right: Profile) -> int:
    """Number of the first of conditions 1 to 5 that fails, 0 if none does."""
    if len(left.entries) != len(right.entries):
        return 1
    if left.split != right.split:
        return 2
    if left.symbolic_form != right.symbolic_form:
        return 3
    if left.rank != right.rank:
        return 4
    return 0 if left.bases == right.bases else 5


def run(n_masses: int = 4, count: int = 12, damped: bool = True) -> dict[str, dict[int, int]]:
    """Pairs by the first failing condition, 0 for none: with either representation, and with
    one after the other.
    """
    tf, markov = profiles(Family(n_masses, damped), count)
    pairs = list(combinations(range(len(tf)), 2))
    by_tf = {(i, j): first_failing(tf[i], tf[j]) for i, j in pairs}
    by_markov = {(i, j): first_failing(markov[i], markov[j]) for i, j in pairs}
    both = {pair: by_tf[pair] or by_markov[pair] for pair in pairs}
    named = {"tf": by_tf, "markov": by_markov, "tf, then markov": both}
    return {name: dict(sorted(Counter(found.values()).items())) for name, found in named.items()}


def _velocity(chain: Any, column: DomainMatrix) -> PolyElement:
    """Sensed velocity of a column of states; the acceleration is s times as much, so no
    feed-through is to be added.
    """
    plus, minus = (
        column[chain.n_masses + i - 1, 0].element if i else 0
        for i in (chain.meas_plus, chain.meas_minus)
    )
    return plus - minus


def _powers(a: DomainMatrix, b: DomainMatrix, count: int) -> list[DomainMatrix]:
    """B, A B, .., A^count B, see (32); with accelerations G_0 belongs to the first."""
    found = [b]
    while len(found) <= count:
        found.append(a * found[-1])
    return found


def _adjugate(
    a: DomainMatrix, b: DomainMatrix, denominator: Sequence[PolyElement]
) -> list[DomainMatrix]:
    """Columns N_0..N_(m-1) of adj(I s - A) B = sum N_j s^j: N_(m-1) = B, N_(j-1) = A N_j + a_j
    B.
    """
    columns = [b]
    for coefficient in denominator[-2:0:-1]:
        columns.append(a * columns[-1] + b.scalarmul(coefficient))
    return columns[::-1]


def _cancelled(numerator: Invariants, denominator: Invariants, point: Point) -> Profile:
    """Profile of the quotient without common powers of s; raises ArithmeticError where more
    than these are common.
    """
    common = next(j for j, pair in enumerate(zip(numerator, denominator, strict=True)) if any(pair))
    b, a = numerator[common:], denominator[common:]
    while not b[-1]:
        b.pop()
    values = [[ZZ(point.value(coefficient)) for coefficient in reversed(part)] for part in (b, a)]
    if len(gf_gcd(*values, ZZ(PRIME), ZZ)) > 1:
        raise ArithmeticError("numerator and denominator have a common factor besides s")
    return Profile(b + a[:-1], len(b), point)


if __name__ == "__main__":
    sizes = [int(word) for word in sys.argv[1:] if word.isdigit()]
    started = time.perf_counter()
    for representation, found in run(*sizes, damped="undamped" not in sys.argv).items():
        print(f"{representation}: {found}")
    print(f"{time.perf_counter() - started:.2f} s, ground types {GROUND_TYPES}")
