"""General models as models of the one kind that samples, profiles and comparisons know: their
transfer functions at a point, from explicit polynomials, and what is proven constant.

At a point x without zeros a term t = c x^e has x_j dt/dx_j = e_j t, so one pass over the terms
gives value and gradient.

A point at which a leading denominator coefficient vanishes, or numerator and denominator have a
common root, is drawn again. This conditions the probability of an error on an event of probability
above 1/2 (its complement is bounded by `sampling.safety` as well), so it can double it: one bit a
point.

Constants. Coefficients are explicit polynomials in lowest terms, so it is decided without chance
which are zero or constant multiples of the leading one. Markov parameters follow from G_k = b_(m-k)
- sum_j a_(m-j) G_(k-j), j = 1..k (monic form of degree m); this recurrence is run with the known
constants alone, which proves the zeros below the relative degree and those of even and odd transfer
functions, and constants such as a leading b that is 1. Two monic denominators D1/a1 and D2/a2 are
equal exactly if D1 a2 = D2 a1.

Renamings. A renaming carries coefficients in lowest terms over the integers into coefficients, all
of them or none with the sign changed. The functions c_i a_m (a_m the leading denominator
coefficient), over the square of a number of a_m, are then the same, whatever the sign, and colour
refinement looks at them, modulo a prime: columns that differ there are different, so no renaming is
missed, and one that is found is proven exactly.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar

from flint import nmod_poly

from disting.algebra.certainty import Size
from disting.algebra.quotient import Quotient, lowest_terms
from disting.behaviour.chain_model import UNBOUNDED, size_of_minors
from disting.behaviour.sample import label, shared_poles
from disting.general.matrix_model import AnyModel, Model, Terms
from disting.model.protocol import ZERO, Columns, Degrees

KnownValue = Fraction | None
"""The value of an invariant that is proven constant, or None."""


@dataclass(frozen=True, slots=True)
class GeneralModel:
    """A model with one transfer function, or with a matrix of them."""

    model: AnyModel
    dead_time: ClassVar[bool] = False
    most_subsets: ClassVar[int] = UNBOUNDED

    @property
    def lost_bits(self) -> int:
        """One, and six where exponents are matched: profiles choose among up to 24 orders of the
        exponents of both models (see `readings`).
        """
        return 1 + 6 * bool(self.model.powers.weights)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the model."""
        return self.model.parameters

    @property
    def n_states(self) -> int:
        """Largest order of a transfer function."""
        return self.model.n_states

    @property
    def content(self) -> tuple[object, ...]:
        """All but its name."""
        return self.model.content

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Those of all transfer functions."""
        return tuple(ZERO if e is None else e.degrees for e in self.model.cells)

    @property
    def is_numbered(self) -> bool:
        """True if there are several transfer functions."""
        return len(self.model.cells) > 1

    def quotients(self, point: Sequence[int], modulus: int) -> tuple[Quotient | None, ...]:
        """All transfer functions, at a point without zeros."""
        return tuple(None if e is None else _quotient(e, point, modulus) for e in self.model.cells)

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Those of the functions c_i a_m of all transfer functions, at a point without zeros."""
        rows = [row for e in self.model.entries for row in _products(e, point, modulus)]
        slopes = (gradient for _, gradient in rows)
        return tuple(value for value, _ in rows), list(zip(*slopes, strict=True))

    def minor_size(self, markov: int | None) -> Size:
        """Bounds for the cleared minors of the Jacobian."""
        largest = [_largest(entry) for entry in self.model.entries]
        return summary_size(self.degrees, largest, len(self.parameters), markov)

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """The exact values of those that are proven constant."""
        texts: dict[str, str] = {}
        for i, entry in enumerate(self.model.cells):
            if entry is None:
                continue
            numbers = _constants(entry, markov)
            shared = shared_poles(self.degrees, i) if markov is None else None
            first = None if shared is None else self.model.cells[shared]
            if first is not None:
                numbers = {n: v for n, v in numbers.items() if n[0] == "b"} | _differences(
                    entry, first
                )
            named = (label(n, i, shared) if self.is_numbered else n for n in numbers)
            texts |= dict(zip(named, map(str, numbers.values()), strict=True))
        return texts


def summary_size(
    degrees: Sequence[Degrees], largest: Sequence[tuple[int, int]], rank: int, markov: int | None
) -> Size:
    """Bounds for the cleared minors of the Jacobian, from the degrees and coefficients that the
    transfer functions have: those of the largest entry, where a difference of two denominators
    has both leading coefficients below it, so twice the power.

    Coefficients of numerator and denominator have a degree of d at most in the parameters, and
    numbers whose sizes sum to 2^h at most. Entry i of the summary is a polynomial over power w
    of the leading coefficient: w = 1 for coefficients of the monic form, w = i + 1 for Markov
    parameters, whose recurrence adds at most 2^i products of w coefficients (i counts from
    G_-k, if the numerator has a degree larger by k). So a cleared derivative has degree (w + 1)
    d and numbers whose sizes add up to 2 w d 2^(i + (w + 1) h).
    """
    above = max(0, *(top - bottom for top, bottom in degrees))
    power = 2 if markov is None else markov + above + 2
    sizes = [size_of_minors(power, *entry, rank) for entry in largest]
    twice = 1 + (len(sizes) > 1)
    return Size(twice * max(s.degree for s in sizes), twice * max(s.bits for s in sizes))


def evaluate(terms: Terms, point: Sequence[int], modulus: int) -> tuple[int, list[int]]:
    """Value and gradient of a polynomial at a point without zeros."""
    total, slopes = 0, [0] * len(point)
    for exponents, number in terms:
        for x, e in zip(point, exponents, strict=True):
            if e:
                number = number * (x if e == 1 else pow(x, e, modulus)) % modulus
        total += number
        for j, e in enumerate(exponents):
            if e:
                slopes[j] += e * number
    return total % modulus, [
        slope * pow(x, -1, modulus) % modulus if slope else 0
        for slope, x in zip(slopes, point, strict=True)
    ]


def _quotient(model: Model, point: Sequence[int], modulus: int) -> Quotient:
    """The transfer function in lowest terms at the point, with its derivatives."""
    sides = [
        [evaluate(terms, point, modulus) for terms in side]
        for side in (model.numerator_terms, model.denominator_terms)
    ]
    if not sides[1][-1][0]:
        zero = nmod_poly([0], modulus)
        return Quotient(zero, zero, (), ())
    num, den = (nmod_poly([v for v, _ in side], modulus) for side in sides)
    slopes = [
        [nmod_poly([g[j] for _, g in side], modulus) for j in range(len(point))] for side in sides
    ]
    return lowest_terms(num, den, *slopes)


def _products(model: Model, point: Sequence[int], modulus: int) -> list[tuple[int, list[int]]]:
    coefficients = (*model.numerator_terms, *model.denominator_terms)
    lead = coefficients[-1]
    total = sum(number for _, number in lead)
    return times_lead(
        [evaluate(terms, point, modulus) for terms in coefficients],
        Fraction(total or 1, len(lead)),
        modulus,
    )


def times_lead(
    rows: Sequence[tuple[int, Sequence[int]]], mean: Fraction, modulus: int
) -> list[tuple[int, list[int]]]:
    """Values and gradients of the functions c_i a_m from those of the coefficients, a_m last, over
    the square of a number that changes as they do where both sides of G are multiplied by one: the
    mean of the numbers of the terms of a_m.
    """
    lead, slopes = rows[-1]
    unit = pow(mean.numerator, -2, modulus) * mean.denominator**2 % modulus
    lead, slopes = lead * unit % modulus, [slope * unit % modulus for slope in slopes]
    return [
        (
            value * lead % modulus,
            [(g * lead + value * h) % modulus for g, h in zip(gradient, slopes, strict=True)],
        )
        for value, gradient in rows
    ]


def _largest(model: Model) -> tuple[int, int]:
    """Largest degree of a coefficient, and bits of the largest sum of the sizes of its numbers."""
    every = (*model.numerator_terms, *model.denominator_terms)
    degree = max((sum(e) for terms in every for e, _ in terms), default=0)
    return degree, max(sum(abs(c) for _, c in terms) for terms in every).bit_length()


def _constants(model: Model, markov: int | None) -> dict[str, Fraction]:
    """Label -> value of the invariants of one transfer function that are proven constant."""
    lead = model.denominator_terms[-1]
    top, bottom = (
        [_ratio(terms, lead) for terms in side]
        for side in (model.numerator_terms, model.denominator_terms)
    )
    return known_invariants(top, bottom, markov)


def known_invariants(
    top: list[KnownValue], bottom: list[KnownValue], markov: int | None
) -> dict[str, Fraction]:
    """The same from what is known of the coefficients over the leading one."""
    sides = {"b": top, "a": bottom[:-1]} if markov is None else {"G": _series(top, bottom, markov)}
    first = {"b": 0, "a": 0, "G": min(0, len(bottom) - len(top))}
    named = (
        (f"{x}{i}", value) for x, side in sides.items() for i, value in enumerate(side, first[x])
    )
    return {name: value for name, value in named if value is not None}


def _ratio(terms: Terms, lead: Terms) -> KnownValue:
    """The number q with terms = q lead, if there is one."""
    if not terms:
        return Fraction(0)
    q = Fraction(terms[0][1], lead[0][1])
    same = len(terms) == len(lead) and all(
        e == f and c == q * d for (e, c), (f, d) in zip(terms, lead, strict=True)
    )
    return q if same else None


def _series(
    top: Sequence[KnownValue], bottom: Sequence[KnownValue], count: int
) -> list[KnownValue]:
    m = len(bottom) - 1
    start = max(m, len(top) - 1)
    numbers: list[KnownValue] = []
    for k in range(start - m + count + 1):
        terms = [_product(bottom[m - j], numbers[k - j]) for j in range(1, min(k, m) + 1)]
        first = top[start - k] if 0 <= start - k < len(top) else Fraction(0)
        summands = [term for term in terms if term is not None]
        sure = first is not None and len(summands) == len(terms)
        numbers.append(first - sum(summands) if first is not None and sure else None)
    return numbers


def _product(a: KnownValue, b: KnownValue) -> KnownValue:
    if a == 0 or b == 0:
        return Fraction(0)
    return a * b if a is not None and b is not None else None


def _differences(entry: Model, first: Model) -> dict[str, Fraction]:
    """Of the monic denominators, where they are proven constant."""
    numbers: dict[str, Fraction] = {}
    polynomials, other = entry.denominator, first.denominator
    mine, theirs = (_constants(m, None) for m in (entry, first))
    for k in range(entry.degrees[1]):
        name = f"a{k}"
        if polynomials[k] * other[-1] == other[k] * polynomials[-1]:
            numbers[name] = Fraction(0)
        elif name in mine and name in theirs:
            numbers[name] = mine[name] - theirs[name]
    return numbers
