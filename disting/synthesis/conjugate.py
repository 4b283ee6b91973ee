"""Whether the zeros of a polynomial over Q are conjugate under all permutations: then one way to share them out speaks for all.

Equations with coefficients in Q(z_1, .., z_m), z_i the zeros of N in Q[s], have a complex solution exactly if they have an
algebraic one, and an automorphism over Q carries the solutions of one way to share out the zeros to those of another. If the
Galois group of N over Q is the symmetric group, it carries each way to every other with as many zeros in each place: all have
solutions or none has.

The group is seen modulo primes. Where N is squarefree modulo a prime that divides no denominator and not the leading
coefficient, the group holds an element whose cycles are as long as its irreducible factors (Dedekind; B. L. van der Waerden,
Algebra I, section 61). N irreducible makes it transitive; a linear and one other factor, doubly transitive; one factor of
degree 2 and otherwise odd degrees gives an element of which an odd power is a transposition. Its conjugates are all
transpositions, which generate the symmetric group. What is found holds without any chance.
"""

from functools import cache
from typing import Any

from flint import fmpz, nmod_poly

PRIMES = 200  # tried; a degree m needs about m of them
FIRST = 1 << 20


def zeros_are_conjugate(numerator: Any) -> bool:
    """Whether it is proven, of a polynomial with rational coefficients (fmpq_poly).

    >>> from flint import fmpq_poly
    >>> zeros_are_conjugate(fmpq_poly([-2, 0, 0, 1])), zeros_are_conjugate(fmpq_poly([1, 0, 0, 0, 1]))
    (True, False)
    """
    whole = [int(c) for c in numerator.numer().coeffs()]
    wanted = {"transitive", "doubly", "transposition"} if len(whole) > 3 else {"transitive"} if len(whole) == 3 else set()
    for modulus in _primes():
        if not wanted:
            break
        if whole[-1] % modulus:
            wanted -= _shown(nmod_poly([c % modulus for c in whole], modulus))
    return not wanted


def _shown(polynomial: nmod_poly) -> set[str]:
    """What the factors of a polynomial modulo a prime show of the group; nothing if one is multiple."""
    _, factors = polynomial.factor()
    if any(e > 1 for _, e in factors):
        return set()
    degrees = sorted(f.degree() for f, _ in factors)
    shown = {
        "transitive": len(degrees) == 1,
        "doubly": len(degrees) == 2 and degrees[0] == 1,
        "transposition": [d for d in degrees if d % 2 == 0] == [2],
    }
    return {name for name, holds in shown.items() if holds}


@cache
def _primes() -> tuple[int, ...]:
    found = list[int]()
    candidate = FIRST + 1
    while len(found) < PRIMES:
        found += [candidate] if fmpz(candidate).is_prime() else []
        candidate += 2
    return tuple(found)
