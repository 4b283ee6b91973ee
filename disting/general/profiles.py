"""Profiles of general models: what conditions 1 to 5 and 7 ask, from samples, and constants that
are proven.

Coefficients are explicit polynomials in lowest terms, so it is seen without chance which are zero
or constant multiples of the leading one. Markov parameters follow from G_k = b_(m-k) - sum_j
a_(m-j) G_(k-j), j = 1..k (monic form of degree m); this recurrence is run with the known constants
alone, which proves the zeros below the relative degree and those of even and odd transfer
functions, and constants such as a leading b that is 1.
"""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

from disting.algebra.sampling import SEARCH_BITS, enough
from disting.behaviour.profile import Profile, from_samples, search_labels
from disting.behaviour.sample import Representation
from disting.general.model import Model, Terms
from disting.general.samples import drawn, minor_size, samples
from disting.model.settings import Settings

Known = Fraction | None
"""The value of an invariant that is proven constant, or None."""


@lru_cache(maxsize=64)
def profile(
    model: Model, representation: Representation, count: int, settings: Settings
) -> Profile:
    """Profile from `settings.points` random points, or as many as it takes, with large primes, and
    one with a small prime.

    `proven_zeros` holds all invariants that are proven constant, and `constants` their exact
    values.
    """
    size = minor_size(model, representation, count)
    seen = list(samples(model, representation, count, enough(size, settings.points), settings.seed))
    searches = (
        drawn(model, representation, count, label, SEARCH_BITS)
        for label in search_labels(settings.seed)
    )
    known = proven_constants(model, representation, count)
    found = from_samples(
        seen, searches, frozenset(known), model.degrees, count, model.n_states, size, settings
    )
    values = zip(found.labels, found.constants, strict=True)
    constants = tuple(str(known[label]) if label in known else value for label, value in values)
    return replace(found, constants=constants, safety=found.safety - len(seen))


def proven_constants(
    model: Model, representation: Representation, count: int
) -> dict[str, Fraction]:
    """Label -> value of the invariants that are proven constant."""
    top, bottom = monic_constants(model)
    if representation is Representation.TF:
        pairs = [(f"b{i}", v) for i, v in enumerate(top)] + [
            (f"a{i}", v) for i, v in enumerate(bottom[:-1])
        ]
    else:
        pairs = [(f"G{i}", v) for i, v in enumerate(_series(top, bottom, count))]
    return {label: value for label, value in pairs if value is not None}


def monic_constants(model: Model) -> tuple[list[Known], list[Known]]:
    """For each coefficient over the leading one: its value if that is constant."""
    lead = model.denominator_terms[-1]
    sides = model.numerator_terms, model.denominator_terms
    return tuple([_ratio(terms, lead) for terms in side] for side in sides)  # type: ignore[return-value]


def _ratio(terms: Terms, lead: Terms) -> Known:
    """The number q with terms = q lead, if there is one."""
    if not terms:
        return Fraction(0)
    q = Fraction(terms[0][1], lead[0][1])
    same = len(terms) == len(lead) and all(
        e == f and c == q * d for (e, c), (f, d) in zip(terms, lead, strict=True)
    )
    return q if same else None


def _series(top: Sequence[Known], bottom: Sequence[Known], count: int) -> list[Known]:
    m = len(bottom) - 1
    found: list[Known] = []
    for k in range(count + 1):
        terms = [_product(bottom[m - j], found[k - j]) for j in range(1, min(k, m) + 1)]
        found.append(_difference(top[m - k] if 0 <= m - k < len(top) else Fraction(0), terms))
    return found


def _product(a: Known, b: Known) -> Known:
    if a == 0 or b == 0:
        return Fraction(0)
    return a * b if a is not None and b is not None else None


def _difference(first: Known, terms: list[Known]) -> Known:
    known = [term for term in terms if term is not None]
    return first - sum(known) if first is not None and len(known) == len(terms) else None
