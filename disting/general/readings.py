"""In which order the exponents of a model are matched with those of another one.

Two networks with constant phase elements are the same if their functions are, with exponents that
are matched in some order. What occurs in a function, and its profile, do not depend on the order in
which its exponents are named; so each model takes the order in which these are the least, and
models that these distinguish differ in every order. Orders that are left are symmetries, most of
them; for others the exact decision cannot prove that nothing matches.
"""

from collections.abc import Callable

from disting.algebra.certainty import full_text
from disting.behaviour.profile import Profile
from disting.general.any_model import cells_of, in_powers
from disting.general.matrix_model import AnyModel
from disting.general.powers import orders

ProfileOf = Callable[[AnyModel], Profile]


def readings(model: AnyModel) -> list[AnyModel]:
    """The model with its exponents in the other orders in which the same powers occur."""
    size = len(model.powers.weights)
    if not size:
        return []
    return [in_powers(model, model.powers, order) for order in orders(cells_of(model), size)]


def normalise(model: AnyModel, profile_of: ProfileOf) -> AnyModel:
    """The model with its exponents in the order of the least profile, and of these in the one whose
    coefficients are the least: that is a guess, which `profile_text` states.
    """
    others = readings(model)
    if not others:
        return model
    return min((model, *others), key=lambda m: (profile_text(profile_of(m)), _shape(m)))


def _shape(model: AnyModel) -> list[list[tuple[int, int]]]:
    """Total degrees and numbers of all terms, coefficient by coefficient."""
    sides = (side for e in model.entries for side in (e.numerator_terms, e.denominator_terms))
    return [sorted((sum(e), number) for e, number in terms) for side in sides for terms in side]


def profile_text(profile: Profile) -> str:
    """All that conditions compare, as text."""
    p = profile
    return full_text((p.degrees, sorted(p.form), p.constants, p.rank, p.matroid))
