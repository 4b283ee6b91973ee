"""A general model seen at one random point modulo a prime: its invariants and their Jacobian, from
explicit polynomials.

At a point x without zeros a term t = c x^e has x_j dt/dx_j = e_j t, so one pass over the terms
gives value and gradient.

A point at which the leading denominator coefficient vanishes, or numerator and denominator have a
common root, is drawn again. This conditions the probability of an error on an event of probability
above 1/2 (its complement is bounded by `sampling.safety` as well), so it can double it: one bit a
point, which `local_identifiability` and `profiles` take off.
"""

from collections.abc import Iterator, Sequence

from flint import nmod_poly

from disting.algebra.quotient import Quotient, coefficient_rows, lowest_terms, series_rows
from disting.algebra.sampling import PROOF_BITS, Size, about, prime, residues
from disting.behaviour.sample import Representation, Sample
from disting.errors import InputError
from disting.general.model import Model, Terms

DRAWS = 20  # of a point; one that is special has a probability of about 2^-50


def samples(
    model: Model, representation: Representation, count: int, points: int, seed: str
) -> Iterator[Sample]:
    """Yield samples at independent points, each with its own large prime."""
    return (drawn(model, representation, count, f"{seed}:{k}", PROOF_BITS) for k in range(points))


def drawn(
    model: Model, representation: Representation, count: int, label: str, bits: int
) -> Sample:
    """The sample at the point that the label stands for with this model, modulo its prime of so
    many bits.
    """
    whole = about(label, *model.content)
    for again in (f"{whole}:{attempt}" for attempt in range(DRAWS)):
        modulus = prime(again, bits)
        q = quotient(model, residues(f"point:{again}", len(model.parameters), modulus), modulus)
        if (q.num.degree(), q.den.degree()) == model.degrees:
            return _sample(q, representation, count, len(model.parameters))
    raise InputError(f"the leading coefficients of {model.name} vanish at {DRAWS} random points")


def quotient(model: Model, point: Sequence[int], modulus: int) -> Quotient:
    """The transfer function at a point without zeros, in lowest terms there, with its
    derivatives.
    """
    sides = [
        [evaluated(terms, point, modulus) for terms in side]
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


def evaluated(terms: Terms, point: Sequence[int], modulus: int) -> tuple[int, list[int]]:
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


def minor_size(model: Model, representation: Representation, count: int) -> Size:
    """Bounds for the cleared minors of the Jacobian, from the degrees and coefficients that the
    model has.

    Coefficients of numerator and denominator have a degree of d at most in the parameters, and
    numbers whose sizes sum to 2^h at most. Entry i of the summary is a polynomial over power w of
    the leading coefficient: w = 1 for coefficients of the monic form, w = i + 1 for Markov
    parameters, whose recurrence adds at most 2^i products of w coefficients. So a cleared
    derivative has degree (w + 1) d and numbers whose sizes add up to 2 w d 2^(i + (w + 1) h).
    """
    every = (*model.numerator_terms, *model.denominator_terms)
    degree = max((sum(e) for terms in every for e, _ in terms), default=0)
    bits = max(sum(abs(c) for _, c in terms) for terms in every).bit_length()
    power = 2 if representation is Representation.TF else count + 2
    entry = Size(power * degree, power * (bits + 1) + (power * degree).bit_length() + 1)
    rank = len(model.parameters)
    return Size(rank * entry.degree, rank * (entry.bits + rank.bit_length()))


def _sample(q: Quotient, representation: Representation, count: int, n_parameters: int) -> Sample:
    if representation is Representation.TF:
        n, m = q.num.degree(), q.den.degree()
        top, bottom = (
            coefficient_rows(q.num, q.num_derivatives, n + 1),
            coefficient_rows(q.den, q.den_derivatives, m),
        )
        labels = [f"b{i}" for i in range(n + 1)] + [f"a{i}" for i in range(m)]
        values, rows = top[0] + bottom[0], top[1] + bottom[1]
    else:
        labels = [f"G{i}" for i in range(count + 1)]
        values, rows = series_rows(q, count)
    return Sample(
        tuple(labels), tuple(values), tuple(map(tuple, rows)), n_parameters, int(q.den.modulus())
    )
