"""Equivalents of all generic p near the boundary of the positive values: with some of the unknowns
as small as need be.

Let Y be a model, Z some of its parameters, Y0 what Y is where these are 0, with the same
coefficients there. Let X and Y0 have ranks of at least d, and the coefficients of Y up to a common
factor be in a set of dimension d at most: d is their number less 1, and less the number of
independent equations between them (`relations`).

THEOREM. If all generic p of X have an equivalent in Y0 with positive values, they have one in Y.
Proof. Let V be the closure of the functions of Y. Those of Y0 are in it; X's are among them but
for special ones; all three closures are irreducible and of dimension d, so they are the same. So
for generic p the function F of X is a smooth point of V, and by Sard a regular value of the map of
Y0 to V: at a positive q0 with the function F its derivatives have rank d. The map of Y depends
smoothly on q0 and the values z of Z, also where z = 0, and leads to V; its derivatives by q0 still
have rank d near by. So for small z > 0 there is a q near q0 with the function F (implicit function
theorem), and q is positive as q0 is.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations, islice

from disting.general.matrix_model import AnyModel, Model, Terms
from disting.general.orthant import THOROUGH, Effort
from disting.general.relations import coefficients, dimension_at_least, dimension_at_most
from disting.general.which_models import Way, way
from disting.model.question import Domain

LOOKED_AT, TRIED = 200, 4  # sets of parameters: by their rank, and for formulas
REMEMBERED = 512


@dataclass(frozen=True, slots=True)
class Boundary:
    """Equivalents for all generic p where parameters of the other model are 0."""

    zero: tuple[str, ...]
    way: Way


@lru_cache(maxsize=REMEMBERED)
def at_boundary(model: AnyModel, other: AnyModel, effort: Effort = THOROUGH) -> Boundary | None:
    """Parameters of the other model, and formulas for the others, that show a positive equivalent
    of all generic values; None where none is found.

    >>> a = Model.from_transfer_function("n", "(s + n + x)*(s + y)")
    >>> b = Model.from_transfer_function("n", "(s + n + x)*(s + y + z) - n*z")
    >>> at_boundary(a, b).zero
    ('z',)
    """
    if not (isinstance(model, Model) and isinstance(other, Model)):
        return None
    for zero in islice(_candidates(model, other), TRIED):
        the_way = equivalents_without(model, other, zero, effort)
        if the_way:
            return Boundary(zero, the_way)
    return None


def equivalents_without(
    model: Model, other: Model, zero: tuple[str, ...], effort: Effort = THOROUGH
) -> Way | None:
    """The way to the other model without these parameters, if it gives all generic values an
    equivalent and the theorem applies.
    """
    less = without(other, zero)
    if less is None or not keeps_functions(model, other, less):
        return None
    the_way = way(model, less, Domain.POSITIVE, effort)
    return the_way if the_way and (the_way.covering or the_way.path()) else None


def without(model: Model, zero: tuple[str, ...]) -> Model | None:
    """A model where some parameters are 0; None if another coefficient vanishes then."""
    gone = [model.parameters.index(name) for name in zero]
    kept = [i for i in range(len(model.parameters)) if i not in gone]

    def left(terms: Terms) -> Terms:
        return tuple(
            (tuple(e[i] for i in kept), c) for e, c in terms if not any(e[i] for i in gone)
        )

    sides = [tuple(map(left, side)) for side in (model.numerator_terms, model.denominator_terms)]
    names = tuple(model.parameters[i] for i in kept)
    less = replace(model, parameters=names, numerator_terms=sides[0], denominator_terms=sides[1])
    patterns = [list(map(bool, coefficients(m))) for m in (model, less)]
    return less if kept and patterns[0] == patterns[1] else None


def keeps_functions(model: Model, other: Model, less: Model) -> bool:
    """Return True if the given model and the other one without parameters have the rank that the
    theorem requires.
    """
    enough = dimension_at_most(other)
    return dimension_at_least(less) >= enough and dimension_at_least(model) >= enough


def _candidates(model: Model, other: Model) -> Iterator[tuple[str, ...]]:
    """Yield sets of parameters, those first that leave as many as the rank."""
    spare = len(other.parameters) - dimension_at_most(other)
    sets = (z for count in range(spare, 0, -1) for z in combinations(other.parameters, count))
    for zero in islice(sets, LOOKED_AT):
        less = without(other, zero)
        if less is not None and keeps_functions(model, other, less):
            yield zero
