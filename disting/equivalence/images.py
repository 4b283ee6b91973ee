"""Equivalent parameter vectors that theorems give for every value: symmetries of the class and
duality.

Symmetries (`disting.model.symmetry`) rename parameters; the duality theorem
(`disting.fibres.synthesis.duality`) applies where both ports sit at the two sides of the gap. All
are exact in any field, numbers or rational functions, and keep positive parameters positive.
Symmetries, duality, symmetries again: more duality leads back, as only the mirrored form leaves
the gap.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from disting.fibres.synthesis.duality import are_dual, dual
from disting.model.chain import Chain
from disting.model.symmetry import forms

Number = Any  # an element of a field
Values = Mapping[str, Number]
DUALITY = "duality of chains with both ports at the gap"


@dataclass(frozen=True, slots=True)
class Image:
    """A chain with the same transfer function, its parameters, and the theorems that lead to it
    (none: the chain itself).
    """

    chain: Chain
    values: Values
    steps: tuple[str, ...]


def images(chain: Chain, values: Values) -> tuple[Image, ...]:
    """All of them, the chain itself first, those by fewer theorems before the others, none twice.

    >>> two = Chain(2, damped=False)
    >>> [str(i.chain) for i in images(two, {"m1": 1.0, "m2": 2.0, "k12": 3.0})][1]
    '2 masses, gap 0, force 2-0, sensor 2-0'
    """
    found: list[Image] = []
    for image in (*_moved(Image(chain, values, ())), *_duals(Image(chain, values, ()))):
        if not any(image.chain == known.chain and image.values == known.values for known in found):
            found.append(image)
    return tuple(sorted(found, key=lambda image: len(image.steps)))


def dual_chain(chain: Chain) -> Chain | None:
    """The chain that the duality theorem leads to, if it applies.

    >>> dual_chain(Chain(3, damped=True)) == Chain(3, 2, 2, 3, 2, 3, damped=True)
    True
    """
    h = chain.n_masses - 1 - chain.gap
    other = replace(chain, gap=h, act_minus=h, act_plus=h + 1, meas_minus=h, meas_plus=h + 1)
    return other if are_dual(chain, other) else None


def _moved(image: Image) -> Iterator[Image]:
    """The forms of a chain by symmetries."""
    for form in forms(image.chain):
        values = {form.renaming[name]: value for name, value in image.values.items()}
        ordered = {name: values[name] for name in form.chain.parameters}
        yield Image(form.chain, ordered, (*image.steps, *(s.value for s in form.symmetries)))


def _duals(image: Image) -> Iterator[Image]:
    for form in _moved(image):
        other = dual_chain(form.chain)
        if other is not None:
            yield from _moved(Image(other, dual(form.chain, form.values), (*form.steps, DUALITY)))
