"""Markov parameters of 1/G: another summary of the same behaviour, whose dependences separate
models that those of G do not.

s^-k/G = H_0 + H_1/s + H_2/s^2 + .., k = deg den - deg num (25). The H_i are fixed rational
functions of the transfer function's coefficients, so models with equal closures of their images
have equal closures in these coordinates too: equal ranks of all sets of rows, as condition 5 has
it for G. H_i is a polynomial over power i + 1 of the numerator's leading coefficient, as G_i is
over that of the denominator's, so the bounds of `profile.minor_size` serve here as well.
"""

from flint import nmod_poly

from disting.algebra.quotient import Quotient, series_rows
from disting.algebra.sampling import PROOF_BITS, SEARCH_BITS, enough
from disting.behaviour.profile import Profile, from_samples, minor_size, search_labels
from disting.behaviour.sample import Representation, Sample, drawn
from disting.model.settings import Settings
from disting.model.structure import Structure


def inverse_profile(structure: Structure, count: int, settings: Settings) -> Profile:
    """Profile of H_0..H_count; a dead time is left out."""
    size = minor_size(structure, Representation.MARKOV, count)
    points = enough(size, settings.points)
    seen = [
        _sample(structure, count, f"{settings.seed}:inverse:{k}", PROOF_BITS) for k in range(points)
    ]
    searches = (
        _sample(structure, count, label, SEARCH_BITS)
        for label in search_labels(f"{settings.seed}:inverse")
    )
    return from_samples(
        seen, searches, frozenset(), (0, 0), count, structure.n_states, size, settings
    )


def _sample(structure: Structure, count: int, label: str, bits: int) -> Sample:
    where = drawn(structure, label, bits)
    values, rows = series_rows(_turned(where.quotient), count)
    labels = tuple(f"H{i}" for i in range(count + 1))
    return Sample(
        labels, tuple(values), tuple(map(tuple, rows)), len(structure.parameters), where.modulus
    )


def _turned(q: Quotient) -> Quotient:
    """den / (s^k num)."""
    k = q.den.degree() - q.num.degree()

    def lifted(polynomial: nmod_poly) -> nmod_poly:
        """Times s^k."""
        return polynomial.left_shift(k)

    return Quotient(q.den, lifted(q.num), q.den_derivatives, tuple(map(lifted, q.num_derivatives)))
