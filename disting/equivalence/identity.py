"""Whether formulas for the parameters of one chain turn its transfer function into that of
another: an identity, checked.

Small chains: both receptances are written out as rational functions and compared, a proof. Larger
ones: both are evaluated at a random point, exactly, over the fractions, and compared as
polynomials in s. A receptance is num/den with coefficients that are of degree one in each
parameter, so with formulas a_j/b_j, E_j = max(deg a_j, deg b_j), every coefficient of num den' -
num' den becomes, multiplied by all b_j, a polynomial of degree at most sum E_j + n in the n given
parameters. If it is not zero, it vanishes at a point with coordinates from a set of S numbers with
probability (sum E_j + n)/S at most (Schwartz and Zippel); so does one of the b_j.
"""

from collections.abc import Mapping
from hashlib import shake_256
from math import ceil, log2

from flint import fmpq

from disting.algebra.rational_function import RationalFunction, variables
from disting.algebra.symbols import symbols
from disting.behaviour.transfer import plain_receptance
from disting.equivalence.residual import exactly_equal
from disting.model.chain import Chain

BITS = 256  # of a random coordinate


def is_identity(given: Chain, other: Chain, formulas: Mapping[str, RationalFunction]) -> bool:
    """Written out: exact. For small chains and short formulas."""
    ring = symbols(["s", *given.parameters])
    names = variables(["s", *given.parameters])
    one = names["s"] / names["s"]
    plain = plain_receptance(given.structure, ring, ring["s"], ring["s"] ** 0)
    num, den = plain_receptance(other.structure, formulas, names["s"], one)
    return bool((num / den) == RationalFunction(*plain))


def holds_at_random(
    given: Chain, other: Chain, formulas: Mapping[str, RationalFunction], seed: str
) -> bool:
    """At one random point, exactly; False is a proof that the formulas are wrong, True holds
    but for `safety`.
    """
    count = BITS // 8
    digits = shake_256(f"equivalence:{seed}".encode()).digest(count * len(given.parameters))
    numbers = [
        int.from_bytes(digits[i * count : (i + 1) * count], "big") + 1
        for i in range(len(given.parameters))
    ]
    point = {name: fmpq(number) for name, number in zip(given.parameters, numbers, strict=True)}
    return exactly_equal(
        given, point, other, {name: formula.value(point) for name, formula in formulas.items()}
    )


def safety(given: Chain, formulas: Mapping[str, RationalFunction]) -> int:
    """The probability that wrong formulas pass at one random point is at most 2^-safety."""
    degree = sum(formula.degree for formula in formulas.values()) + len(given.parameters)
    return BITS - ceil(log2(degree))
