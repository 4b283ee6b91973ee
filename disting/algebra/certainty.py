"""Certainty of a statement, and the random points and primes at which generic facts are computed.

A rank, a dependence or an identity of polynomials is computed modulo a random prime near 2^61 and
at a random point. What is non-zero there is non-zero generically: a proof. What is zero there is
generically zero but for a probability that is bounded here, and independent points multiply their
bounds.

Everything is drawn from SHAKE-256 of a label, so that a result depends on the label alone: not on
the order of the work, on the process or on the version of a random generator. The label holds a
digest of the models that are examined (`about`): the same question has the same points in any order
of questions, and nobody can write a model for which its own points or primes are special, since
they change with every sign of it. Probabilities are those over the choice of a label's numbers.

Keys of stored values and labels of random points are made of `full_text`, the text of all that
makes a value what it is. It is not `repr`, which is made for a reader and may leave things out: a
key that leaves something out serves one model's answer for another one.
"""

import hashlib
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cache
from math import ceil, log2
from typing import Any

from flint import fmpz

PLAIN = {int, str, bool, float, complex, type(None)}  # whose `repr` tells all


def full_text(value: Any) -> str:
    """A value with all fields of all dataclasses in it, except those with `repr=False`; other
    objects than dataclasses, tuples, lists and mappings by their `repr`. A dataclass whose text
    must not change with its layout says its fields in `written_fields`, a word its text in
    `written_text`.

    Raises ValueError for a whole number of more digits than Python writes in decimal.

    >>> from disting import Chain
    >>> full_text((Chain(1),))[:42], repr((Chain(1),))[:18]
    ('(Chain(n_masses=1, gap=0, act_minus=0, act', '(<Chain: 1:1 [1FS]')
    """
    kind = type(value)
    if kind in PLAIN:
        return repr(value)
    if isinstance(value, str):
        return getattr(value, "written_text", None) or repr(value)
    if isinstance(value, tuple) and PLAIN.issuperset(map(type, value)):
        return repr(value)  # a named tuple says its name
    if kind is tuple:
        parts = ", ".join(map(full_text, value))
        return f"({parts},)" if len(value) == 1 else f"({parts})"
    if kind is list:
        return f"[{', '.join(map(full_text, value))}]"
    if is_dataclass(kind):
        own = getattr(value, "written_fields", None)
        inside_fields = (
            {name: getattr(value, name) for name in _names(kind)} if own is None else own
        )
        inside = ", ".join(f"{name}={full_text(item)}" for name, item in inside_fields.items())
        return f"{kind.__qualname__}({inside})"
    if isinstance(value, Mapping):
        parts = ", ".join(f"{full_text(key)}: {full_text(item)}" for key, item in value.items())
        return f"{{{parts}}}"
    return repr(value)


@cache
def _names(kind: type) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind) if field.repr)


# bits: what is wrong with a larger probability than 2**-100, or could be, is not said
LEAST_SAFETY = 100
# bits of a bound that says nothing; 0 bits are those of a statement that needs no bound
USELESS = -1
# products of two residues fit into 64 bits: the vectorised searches use such primes
SEARCH_BITS = 31
PROOF_BITS = 61
SHARED = 20  # bits of a bound that many statements share, about a million of them
REDRAWN = 2.0**-19  # bits: -log2(1 - 2^-20) is smaller
# of 61 bits, at least: pi(2x) - pi(x) > 3x/(5 ln x), Rosser and Schoenfeld 1962
_PRIMES = 3 * 2.0**60 / (5 * 61 * 0.6932)


class Certainty(StrEnum):
    """THEOREM: holds by a stated theorem. PROVEN: exact computation. BOUNDED: but for a computed
    probability.

    NUMERICAL: all equations hold within small balls, which proves neither that they hold nor that
    they fail.

    >>> from disting import compare
    >>> compare("3:1", "3:11").certainty is Certainty.THEOREM
    True
    """

    THEOREM = "theorem"
    PROVEN = "proven"
    BOUNDED = "bounded"
    NUMERICAL = "numerical"

    def in_words(self, safety: int = 0, theorem: str = "") -> str:
        """Certainty of a statement in the words that sentences, pages and notebooks share.
        `theorem` names the one that it holds by.

        >>> Certainty.THEOREM.in_words(theorem="duality theorem"), Certainty.PROVEN.in_words()
        ('proven (duality theorem)', 'proven')
        >>> Certainty.BOUNDED.in_words(132)
        'probability of error at most 2^-132'
        """
        match self:
            case Certainty.THEOREM:
                return f"proven ({theorem or 'theorem'})"
            case Certainty.PROVEN:
                return "proven"
            case Certainty.BOUNDED:
                return f"probability of error at most {bits_in_words(safety)}"
            case Certainty.NUMERICAL:
                return "found numerically, not proven"


def bits_in_words(safety: int) -> str:
    """Text of an error bound 2**-safety.

    >>> bits_in_words(132), bits_in_words(USELESS)
    ('2^-132', '1')
    """
    return f"2^-{safety}" if safety > 0 else "1"


Grade = tuple[Certainty, int]
"""Certainty and, if it is BOUNDED, the bits b of the error bound 2**-b."""


def grade_of(proven: bool, safety: int) -> Grade:
    """Certainty and error bits: none needed where the finding is proven."""
    return (Certainty.PROVEN, 0) if proven else (Certainty.BOUNDED, safety)


def shortfall(certainty: Certainty | None, safety: int) -> str:
    """Why a statement may not be made with this grade, "" if it may: checked wherever a finding is
    made.

    Raises ValueError for an error bound of what is not BOUNDED.

    >>> shortfall(Certainty.BOUNDED, 99)
    'its error bound would be 2^-99, and more than 2^-100 is not accepted'
    """
    if certainty is Certainty.BOUNDED:
        bound = bits_in_words(safety)
        return (
            ""
            if safety >= LEAST_SAFETY
            else f"its error bound would be {bound}, and more than 2^-100 is not accepted"
        )
    if safety:
        raise ValueError("only a bounded finding carries an error bound")
    return ""


def withhold(
    finding: object, grade: tuple[Certainty | None, int], why: str, **unknown: object
) -> None:
    """Withhold a finding of insufficient grade: its fields become `unknown`, its evidence and its
    bits none, and the field `why` states what is lacking (`shortfall`).
    """
    lacking = shortfall(*grade)
    if lacking:
        for name, value in {"safety": 0, "evidence": None, why: lacking, **unknown}.items():
            object.__setattr__(finding, name, value)


def joint_safety(safeties: Iterable[int]) -> int:
    """Largest b with sum 2^-s <= 2^-b: the probability that any of these statements is wrong is at
    most 2**-b.

    No independence is needed: it is the sum that bounds a union. 0 for no statement at all, and
    only then: nothing can be wrong. USELESS where the sum is more than 1/2, so that no bound is
    left.

    >>> joint_safety([120] * 1000), joint_safety([100, 140])
    (110, 99)
    >>> joint_safety([]), joint_safety([1, 100])
    (0, -1)
    """
    total = sum(
        (Fraction(1, 2) ** s * count for s, count in Counter(safeties).items()), Fraction(0)
    )
    if not total:
        return 0
    return int(1 / total).bit_length() - 1 if 2 * total <= 1 else USELESS


def weakest(*grades: Grade) -> Grade:
    """Grade of a statement that rests on all of these: error probabilities add up.

    >>> weakest((Certainty.THEOREM, 0), (Certainty.BOUNDED, 120), (Certainty.BOUNDED, 140))
    (<Certainty.BOUNDED: 'bounded'>, 119)
    """
    certainty = max((c for c, _ in grades), key=list(Certainty).index)  # the strongest comes first
    bits = [b for c, b in grades if c is Certainty.BOUNDED]
    return certainty, min(bits) - ceil(log2(len(bits))) if certainty is Certainty.BOUNDED else 0


@dataclass(frozen=True, slots=True)
class Size:
    """Bounds of an integer polynomial: total degree, and bits of its largest coefficient."""

    degree: int
    bits: int


def about(label: str, *content: object) -> str:
    """The label of a question about models: with a digest of all of their content (`full_text`).

    >>> about("doc", "a model") == about("doc", "a model") != about("doc", "another one")
    True
    """
    return f"{label}:{digest(*content)}"


def digest(*content: object) -> str:
    """128 bits of SHA-256 of the content, as text."""
    return hashlib.sha256("\0".join(map(_text, content)).encode()).hexdigest()[:32]


def _text(content: object) -> str:
    """As `full_text`; numbers of more digits than Python writes in decimal are hexadecimal."""
    try:
        return full_text(content)
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
    """Number of points to take: the requested number, or more where the error would exceed
    2^-LEAST_SAFETY.

    SHARED bits are left for statements that share the bound.

    >>> enough(Size(degree=200, bits=500), asked=1), enough(Size(degree=200, bits=500), asked=5)
    (3, 5)
    """
    each = safety(size, 1)
    return max(asked, ceil((LEAST_SAFETY + SHARED) / each)) if each > 0 else asked
