"""Equivalent models as formulas: each parameter of one structure as a rational function of the
parameters of another.

Symmetries and duality for all chains that they connect; for undamped chains Cauer's continued
fraction where a chain, or a part of it, is driven and measured at its end; and both together. Each
map is checked as an identity of both transfer functions.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from disting.algebra.certainty import Certainty
from disting.algebra.symbols import (
    RationalFunction,
    expression,
    latex,
    latex_symbol,
    text,
    variables,
)
from disting.equivalence.checks import holds_at_random, is_identity, safety
from disting.equivalence.inputs import Value, point_of
from disting.equivalence.theorems import Image, expansions, images
from disting.errors import ContradictionError, InputError, of_type, short
from disting.model.chain import Chain
from disting.model.names import name_of, read_together
from disting.model.presentation import summary
from disting.network.notation import notations_of

EXPANDED_UP_TO = 3  # masses of maps that are written out for a proof (10 ms; 2 s for 4)
ONLY_CHAINS = (
    "explicit_map takes chains, as Chain or by a name such as '3:4'; for networks and other models"
    " use equivalents or alternatives; the sentence of compare(..) has the formulas that are known"
)
CAUER_UP_TO = 4  # masses of continued fractions; up to 3 s and 8000 characters
CAUER = "Cauer's continued fraction"


@dataclass(frozen=True, slots=True)
class Map:
    """Parameters of `other` as functions of those of `given`, with the same transfer function.

    `steps`: the theorems used. `certainty`: PROVEN, the identity is written out, or BOUNDED, it
    holds at a random point, and wrong formulas do so with probability 2^-safety at most. The
    formulas hold wherever no denominator and no formula is zero, and give positive parameters for
    positive ones there.
    """

    given: Chain
    other: Chain
    formulas: dict[str, RationalFunction]
    steps: tuple[str, ...]
    certainty: Certainty
    safety: int

    def __repr__(self) -> str:
        parameters = ", ".join(self.given.parameters)
        return summary(self, f"{', '.join(self.formulas)} from {parameters} ({self.certainty})")

    def at(self, values: Mapping[str, Value]) -> dict[str, Any]:
        """Parameters of `other`, exact fractions, at values of the given ones. Raises
        InputError as `point_of` does.
        """
        point: dict[str, fmpq] = point_of(self.given, values)
        return {name: formula.value(point) for name, formula in self.formulas.items()}

    def _repr_latex_(self) -> str:
        return self.latex  # an environment of its own: no dollar signs

    @property
    def python(self) -> str:
        """Python source: symbols for SymPy, positive as those of `sympy`, and a dictionary of
        the formulas.
        """
        names = ", ".join(self.given.parameters)
        lines = "".join(
            f'    "{name}": {text(formula)},\n' for name, formula in self.formulas.items()
        )
        return (
            f'from sympy import symbols\n\n{names} = symbols("{names}", positive=True)\nequivalent'
            f" = {{\n{lines}}}"
        )

    @property
    def text(self) -> str:
        """One line a parameter, in Python's notation; a prime marks the parameters of `other`."""
        width = max(map(len, self.formulas)) + 1
        return "\n".join(
            f"{name + chr(39):{width}} = {text(formula)}" for name, formula in self.formulas.items()
        )

    @property
    def latex(self) -> str:
        """An align environment (amsmath); a prime marks the parameters of `other`."""
        lines = (
            f"  {latex_symbol(name)}' &= {latex(formula)}"
            for name, formula in self.formulas.items()
        )
        return "\\begin{align}\n" + " \\\\\n".join(lines) + "\n\\end{align}"

    def sympy(self) -> dict[str, Any]:
        """SymPy expressions by parameter name of `other`, in positive symbols."""
        return {name: expression(formula) for name, formula in self.formulas.items()}


def explicit_map(
    chain: Chain | str, other: Chain | str, *, damped: bool | None = None
) -> Map | None:
    """The formulas, the simplest ones known; None if no rational map is known here (there may be
    one).

    From a structure to itself: another map than the identity, if there is one. Chains can be named,
    such as "3:1" and "A11": `damped` then applies to both. Raises InputError for a text that names
    no chain.

    >>> found = explicit_map(Chain(2, damped=True), Chain(2, 1, 1, 2, 1, 2, damped=True))
    >>> print(found.text)
    m1'  = m1*(m1 + m2)/m2
    m2'  = m1 + m2
    k01' = k12*(m1 + m2)**2/m2**2
    d01' = d12*(m1 + m2)**2/m2**2
    """
    for given in (chain, other):
        of_type(given, Chain | str, ONLY_CHAINS)
        if isinstance(given, str) and notations_of(given):
            raise InputError(f"{ONLY_CHAINS}, not {short(given)}")
    chain, other = read_together([chain, other], damped=damped)
    image = next(_candidates(chain, other), None)
    if image is None:
        return None
    formulas, steps = {name: image.values[name] for name in other.parameters}, image.steps
    if chain.n_masses <= EXPANDED_UP_TO:
        holds, grade = is_identity(chain, other, formulas), (Certainty.PROVEN, 0)
    else:
        holds = holds_at_random(chain, other, formulas, f"{chain}:{other}")
        grade = (Certainty.BOUNDED, safety(chain, formulas))
    if not holds:
        raise ContradictionError(
            f"the formulas from {name_of(chain)} to {name_of(other)} are wrong"
        )
    return Map(chain, other, formulas, steps, *grade)


def _candidates(chain: Chain, other: Chain) -> Iterator[Image]:
    """Yield the models of `other` that are known as formulas, simplest first, without the
    identity.
    """
    names = variables(["s", *chain.parameters])
    start = {name: names[name] for name in chain.parameters}
    for image in _images(chain, start, other):
        if image.chain == other and (chain != other or image.values != start):
            yield image


def _images(chain: Chain, start: Mapping[str, RationalFunction], other: Chain) -> Iterator[Image]:
    yield from images(chain, start)
    for expansion in expansions(chain) if chain.n_masses <= CAUER_UP_TO else ():
        if any(
            image.chain == other
            for image in images(expansion.chain, dict.fromkeys(expansion.chain.parameters, 1.0))
        ):
            for image in images(expansion.chain, expansion.values()):
                yield Image(image.chain, image.values, (CAUER, *image.steps))
