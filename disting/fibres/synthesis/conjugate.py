"""Conjugate zeros of a polynomial over Q: of several conjugate distributions, one represents all.

Equations with coefficients in Q(z_1, .., z_m), z_i the zeros of N in Q[s], have a complex solution
exactly if they have an algebraic one, and an automorphism over Q carries the solutions of one way
to share out the zeros to those of another. Let N be a product of irreducible factors N_1, .., N_r
over Q, each one once. If the Galois group of N over Q is the product of the symmetric groups of
all N_i, it carries each way to every other that puts as many zeros of each N_i in each place: all
such ways have solutions or none has.

The group is computed modulo primes. Where N is squarefree modulo a prime that divides no
denominator and not the leading coefficient, the group holds an element whose cycles are as long as
its irreducible factors (Dedekind; B. L. van der Waerden, Algebra I, section 61), sorted by the N_i.
N_i irreducible makes the group transitive on its zeros; a linear and one other factor, doubly
transitive. If N_i has one factor of degree 2 and otherwise odd degrees, and all other N_j have odd
degrees only, an odd power is a transposition of two zeros of N_i that moves nothing else. Its
conjugates are all transpositions of zeros of N_i, which generate the symmetric group. What is found
holds without any chance.
"""

from collections import defaultdict
from collections.abc import Iterable
from functools import cache
from itertools import chain, combinations

from flint import acb_poly, fmpq_poly, fmpz, fmpz_poly, nmod_poly

from disting.fibres.synthesis.branch import Ball, Receptance, roots

PRIMES = 400  # tried; a degree m needs about m of them, and r factors about 2^r times as many
FIRST = 1 << 20
# which zero is -rho, which are those of A and of B
Way = tuple[int, tuple[int, ...], tuple[int, ...]]
Signs = set[tuple[int, str]]  # number of the factor, and what is known of its zeros


def conjugate_factors(numerator: fmpq_poly) -> tuple[fmpz_poly, ...]:
    """The N_i of a polynomial with rational coefficients, if the group is proven to be
    the product; else ().

    >>> from flint import fmpq_poly
    >>> conjugate_factors(fmpq_poly([-2, 0, 0, 1]))
    (x^3 + (-2),)
    >>> conjugate_factors(fmpq_poly([-2, 0, 0, 1]) * fmpq_poly([1, 1]))
    (x + 1, x^3 + (-2))
    >>> conjugate_factors(fmpq_poly([1, 0, 0, 0, 1]))
    ()
    """
    _, powers = numerator.numer().factor()
    factors = tuple(sorted((f for f, _ in powers), key=lambda f: (f.degree(), str(f))))
    wanted = {(i, what) for i, f in enumerate(factors) for what in _WANTED[min(f.degree(), 3)]}
    if any(e > 1 for _, e in powers):
        return ()
    for modulus in _primes():
        if not wanted:
            break
        wanted -= _signs_of(factors, modulus)
    return () if wanted else factors


_WANTED = ((), (), ("transposition",), ("transitive", "doubly", "transposition"))


def _signs_of(factors: tuple[fmpz_poly, ...], modulus: int) -> Signs:
    """Information on the group from the factors modulo a prime; none if one is multiple or a degree
    falls.
    """
    reduced = [nmod_poly([int(c) % modulus for c in f.coeffs()], modulus) for f in factors]
    split = [r.factor()[1] for r in reduced]
    all_factors = [f for f, _ in chain.from_iterable(split)]
    multiple = any(e > 1 for _, e in chain.from_iterable(split)) or len(
        set(map(str, all_factors))
    ) < len(all_factors)
    if multiple or any(r.degree() < f.degree() for r, f in zip(reduced, factors, strict=True)):
        return set()
    degrees = [sorted(f.degree() for f, _ in some) for some in split]
    even = [[d for d in some if d % 2 == 0] for some in degrees]
    alone = [i for i, some in enumerate(even) if some == [2]] if sum(map(len, even)) == 1 else []
    shown = {(i, "transitive") for i, some in enumerate(degrees) if len(some) == 1}
    shown |= {(i, "doubly") for i, some in enumerate(degrees) if len(some) == 2 and some[0] == 1}
    return shown | {(i, "transposition") for i in alone}


@cache
def _primes() -> tuple[int, ...]:
    primes = list[int]()
    candidate = FIRST + 1
    while len(primes) < PRIMES:
        primes += [candidate] if fmpz(candidate).is_prime() else []
        candidate += 2
    return tuple(primes)


def zeros_of(data: Receptance, degree: int) -> list[tuple[int, Ball]]:
    """The zeros of N, each with the number of its kind; those of one kind are proven conjugate."""
    factors = () if data.exact is None else conjugate_factors(data.exact)
    if not factors:
        return list(enumerate(roots(data.numerator, degree)))
    return [(kind, z) for kind, f in enumerate(factors) for z in roots(acb_poly(f), f.degree())]


def conjugate_ways(kinds: list[int], size: int) -> Iterable[list[Way]]:
    """Every way to choose rho and `size` zeros for A; those with as many zeros of each kind in each
    place are grouped.
    """
    ways = defaultdict[tuple[int, ...], list[Way]](list)
    for rho in range(len(kinds)):
        others = [i for i in range(len(kinds)) if i != rho]
        for left in combinations(others, size):
            right = tuple(i for i in others if i not in left)
            ways[kinds[rho], *sorted(kinds[i] for i in left)].append((rho, left, right))
    return ways.values()
