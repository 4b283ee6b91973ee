"""Random points and primes, and how surely a generic fact is seen at them.

A rank, a dependence or an identity of polynomials is looked at modulo a random prime near 2^61 and
at a random point. What is non-zero there is non-zero generically: a proof. What is zero there is
generically zero but for a probability that is bounded here, and independent points multiply their
bounds.

Everything is drawn from SHAKE-256 of a label, so that a result depends on the label alone: not on
the order of the work, on the process or on the version of a random generator. The label holds a
digest of the models that are looked at (`about`): the same question has the same points in
whatever order it is asked, and nobody can write a model for which its own points or primes are
special, since they change with every sign of it. Probabilities are those over the choice of a
label's numbers.
"""

import hashlib
from dataclasses import dataclass
from functools import cache
from math import ceil, log2

from flint import fmpz

from disting.algebra.certainty import LEAST_SAFETY
from disting.algebra.content import written

# products of two residues fit into 64 bits: the vectorised searches use such primes
SEARCH_BITS = 31
PROOF_BITS = 61
SHARED = 20  # bits of a bound that many statements share, about a million of them
REDRAWN = 2.0**-19  # bits: -log2(1 - 2^-20) is smaller
# of 61 bits, at least: pi(2x) - pi(x) > 3x/(5 ln x), Rosser and Schoenfeld 1962
_PRIMES = 3 * 2.0**60 / (5 * 61 * 0.6932)


@dataclass(frozen=True, slots=True)
class Size:
    """Bounds of an integer polynomial: total degree, and bits of its largest coefficient."""

    degree: int
    bits: int


def about(label: str, *content: object) -> str:
    """The label of a question about models: with a digest of all of their content (`written`).

    >>> about("doc", "a model") == about("doc", "a model") != about("doc", "another one")
    True
    """
    return f"{label}:{digest(*content)}"


def digest(*content: object) -> str:
    """128 bits of SHA-256 of the content, as text."""
    return hashlib.sha256("\0".join(map(_text, content)).encode()).hexdigest()[:32]


def _text(content: object) -> str:
    """As `written`; numbers of more digits than Python writes in decimal are hexadecimal."""
    try:
        return written(content)
    except ValueError:
        if isinstance(content, int):
            return hex(content)
        if not isinstance(content, tuple):
            raise
        return f"({','.join(map(_text, content))})"


def residues(label: str, count: int, modulus: int) -> list[int]:
    """`count` numbers of 1..modulus-1, uniform to within 2^-64, determined by the label.

    >>> residues("doc", 2, 7) == residues("doc", 2, 7)
    True
    """
    # bytes a number: 67 bits more than needed make the remainder uniform
    width = max(16, modulus.bit_length() // 8 + 9)
    stream = hashlib.shake_256(label.encode()).digest(width * count)
    chunks = (stream[i : i + width] for i in range(0, width * count, width))
    return [1 + int.from_bytes(chunk) % (modulus - 1) for chunk in chunks]


@cache
def prime(label: str, bits: int = PROOF_BITS) -> int:
    """A random prime of exactly `bits` bits, determined by the label.

    >>> prime("doc").bit_length()
    61
    """
    for attempt in range(10_000):
        candidate = (
            residues(f"prime:{label}:{attempt}", 1, 1 << (bits - 1))[0] | (1 << (bits - 1)) | 1
        )
        if fmpz(candidate).is_prime():
            return candidate
    raise AssertionError("a prime of this size has density above 1/50")


def safety(size: Size, points: int) -> int:
    """Largest b with P(a non-zero polynomial of this size vanishes at all points) <= 2^-b.

    Per point: degree/2^60 (Schwartz 1980, Zippel 1979) plus the share of primes of 61 bits that
    divide all coefficients, at most bits/60 of them. A point may have been drawn again where
    another polynomial vanished, with a probability of at most 2^-20: the bound is then divided by
    1 - 2^-20, which costs REDRAWN bits at most.

    >>> safety(Size(degree=200, bits=500), points=3)
    150
    """
    miss = size.degree / 2.0 ** (PROOF_BITS - 1) + (1 + size.bits / (PROOF_BITS - 1)) / _PRIMES
    return int((-log2(miss) - REDRAWN) * points)


def enough(size: Size, asked: int) -> int:
    """How many points to take: as many as asked, or more where an error below 2^-LEAST_SAFETY
    needs them.

    SHARED bits are left for statements that share the bound.

    >>> enough(Size(degree=200, bits=500), asked=1), enough(Size(degree=200, bits=500), asked=5)
    (3, 5)
    """
    each = safety(size, 1)
    return max(asked, ceil((LEAST_SAFETY + SHARED) / each)) if each > 0 else asked
