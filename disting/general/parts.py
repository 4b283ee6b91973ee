"""Networks without some of their elements that still give an open set of functions.

Let the whole network N give functions with m coefficients that vary, and let its part P, in which
the admittances e of some elements are 0, give the same coefficients at rank m.
THEOREM. If, over positive values, functions of P around a point have no equivalent in another
network, and those around another point have some, the same is true of N.
Proof. Of an open set of values some have rank m. The map of N depends smoothly on e, at e = 0 it is
that of P: so functions around that of such values are those of N for small e > 0 (implicit function
theorem). They are an open set of all functions with these coefficients, so they are given by open
sets of values of N, which have an equivalent, or have none, as those of P.

A part has fewer unknowns than the whole, so it is searched in less time, and its functions are at
the border of what the whole gives: there others end.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.errors import InputError
from disting.evidence.kind import Labels
from disting.general.any_model import of_network, on_one_variable
from disting.general.matrix_model import AnyModel
from disting.general.network_model import behaviour_of
from disting.model.question import Settings


def parts_of(whole: AnyModel) -> Iterator[tuple[Labels, AnyModel]]:
    """Yield names of elements with the part that has all but these, the smallest parts first."""
    the_profile = _profile(whole)
    if whole.network is None or not _is_open(the_profile):
        return
    values = [e.value for e in whole.network.elements if e.value]
    for count in range(len(whole.parameters) - the_profile.rank, 0, -1):
        for missing in combinations(values, count):
            part = without(whole, missing)
            if part:
                yield missing, part


def without(whole: AnyModel, missing: Labels) -> AnyModel | None:
    """The part that has all but these elements, if it gives an open set of the same functions.

    >>> from disting.network import network_of
    >>> whole = of_network(network_of("1>2, 2>1, 2>3, 3>2, 1>0, 2>0; in 1; out 1"))
    >>> without(whole, ("a20",)).parameters, without(whole, ("a32",))
    (('a10', 'a12', 'a21', 'a23', 'a32'), None)
    """
    network = whole.network
    if network is None or network.exponents or not {*missing} <= {*network.parameters}:
        return None
    try:
        rest = tuple(e for e in network.elements if e.value not in missing)
        part, same = on_one_variable([of_network(replace(network, elements=rest)), whole])
    except InputError:
        return None
    if same.powers != whole.powers or part.shape != whole.shape:
        return None
    mine, theirs = _profile(part), _profile(whole)
    alike = (mine.form, mine.constants, mine.degrees) == (
        theirs.form,
        theirs.constants,
        theirs.degrees,
    )
    return part if alike and _is_open(mine) and _is_open(theirs) else None


def _profile(model: AnyModel) -> Profile:
    return profile(behaviour_of(model), Representation.TF, 0, Settings())


def _is_open(the_profile: Profile) -> bool:
    """Return True if all varying coefficients are independent, which a rank at a point proves."""
    return the_profile.rank_proven and the_profile.rank == len(the_profile.form)
