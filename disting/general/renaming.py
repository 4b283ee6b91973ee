"""Condition 6 for general models: a renaming of the parameters, found by colours and proven by
comparing polynomials.

Both transfer functions are in lowest terms over the integers, so a renaming carries coefficients
into coefficients, all of them or none with the sign changed. The functions c_i a_m (a_m the
leading denominator coefficient) are then the same, whatever the sign and without any division, and
colour refinement looks at them, modulo a prime: columns that differ there are different, so no
renaming is missed, and one that is found is proven exactly.
"""

from dataclasses import dataclass
from itertools import islice

from disting.algebra.colouring import renamings
from disting.algebra.sampling import about, digest, prime
from disting.conditions.finding import Finding, Outcome
from disting.conditions.sufficient import CANDIDATES, RENAMING
from disting.evidence.certainty import Certainty
from disting.evidence.conditions import Renaming
from disting.general.model import Model, Terms
from disting.general.samples import evaluated


def condition_6(left: Model, right: Model) -> Finding:
    """A renaming that makes both transfer functions identical, or the proof that there is none."""
    if (left.degrees, len(left.parameters)) != (right.degrees, len(right.parameters)):
        return Finding(RENAMING, Outcome.FAILS, note="no renaming exists")
    modulus = prime(about("renaming", *sorted(digest(*m.content) for m in (left, right))))
    here, there = (
        _Columns((*m.numerator_terms, *m.denominator_terms), modulus) for m in (left, right)
    )
    candidates = list(islice(renamings(here, there, len(left.parameters)), CANDIDATES + 1))
    for images in candidates[:CANDIDATES]:
        pairs = tuple(
            (name, right.parameters[image])
            for name, image in zip(left.parameters, images, strict=True)
        )
        if is_renaming(left, right, dict(pairs)):
            return Finding(RENAMING, Outcome.HOLDS, Certainty.PROVEN, evidence=Renaming(pairs, ()))
    if len(candidates) > CANDIDATES:
        return Finding(
            RENAMING, Outcome.ABANDONED, note=f"more than {CANDIDATES} candidate renamings"
        )
    return Finding(RENAMING, Outcome.FAILS, note="no renaming exists")


def is_renaming(left: Model, right: Model, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters, one to one, turns the left transfer function into
    the right one: exact.
    """
    if sorted(renaming) != sorted(left.parameters) or sorted(renaming.values()) != sorted(
        right.parameters
    ):
        return False
    sources = [
        {there: i for i, there in enumerate(map(renaming.__getitem__, left.parameters))}[q]
        for q in right.parameters
    ]
    sides = [(*m.numerator_terms, *m.denominator_terms) for m in (left, right)]
    moved = [_permuted(terms, sources) for terms in sides[0]]
    there = [dict(terms) for terms in sides[1]]
    negated = [{e: -c for e, c in terms.items()} for terms in there]
    return left.degrees == right.degrees and moved in (there, negated)


def _permuted(terms: Terms, sources: list[int]) -> dict[tuple[int, ...], int]:
    return {tuple(exponents[i] for i in sources): number for exponents, number in terms}


@dataclass(frozen=True, slots=True)
class _Columns:
    """Values and Jacobian columns of the functions c_i a_m at a point, modulo a prime that
    belongs to the pair.
    """

    coefficients: tuple[Terms, ...]
    modulus: int

    def __call__(self, point: list[int]) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
        modulus = self.modulus
        seen = [evaluated(terms, point, modulus) for terms in self.coefficients]
        lead, slopes = seen[-1]
        values = tuple(value * lead % modulus for value, _ in seen)
        rows = [
            [(g * lead + value * h) % modulus for g, h in zip(gradient, slopes, strict=True)]
            for value, gradient in seen
        ]
        return values, list(zip(*rows, strict=True))
