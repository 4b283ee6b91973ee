"""Profiles from Jacobians written by hand: the conditions know no mechanics, so neither do
these.
"""

from disting.algebra.certainty import Size
from disting.behaviour.profile import from_samples
from disting.behaviour.sample import Sample
from disting.model.question import Settings

LARGE, SMALL = 2**61 - 1, 2**31 - 1  # Mersenne primes for the proof and for the search


def sample(rows, values, labels, modulus):
    reduced = tuple(tuple(entry % modulus for entry in row) for row in rows)
    return Sample(labels, tuple(v % modulus for v in values), reduced, len(rows[0]), modulus)


def handmade(
    rows,
    values=None,
    *,
    labels=None,
    degrees=None,
    zeros=(),
    count=0,
    n_states=1,
    searched=None,
    limit=1000,
):
    """Profile of a summary with this Jacobian: coefficients b0, b1.. unless labelled otherwise."""
    labels = labels or tuple(f"b{i}" for i in range(len(rows)))
    values = values or [0] * len(rows)
    return from_samples(
        [sample(rows, values, labels, LARGE)] * 2,
        [sample(searched or rows, values, labels, SMALL)],
        frozenset(zeros),
        degrees or (len(rows) - 1, 0),
        count,
        n_states,
        Size(degree=10, bits=20),
        Settings(subset_limit=limit),
    )


def markov(rows, *, n_states, **options):
    """G_0.. of a model with so many states."""
    labels = tuple(f"G{i}" for i in range(len(rows)))
    return handmade(rows, labels=labels, count=len(rows) - 1, n_states=n_states, **options)
