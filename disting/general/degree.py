"""Whether a one-port of two kinds of elements gives all functions of K(n, c, z), by the degree of
its map: bridges of which no part in series and parallel remains that would show it.

THEOREM. Let N be a one-port of d = 2 n + c + z elements whose generic functions are in K(n, c, z),
and let no network that remains when elements are deleted or contracted have generic functions in
K(m, c, z) with m >= n. Take values such that all positive values with the same function are
regular. If the signs of the determinants there do not add up to 0, N gives all of K(n, c, z).
Proof. K is connected and oriented: the k and 0 < a_1 < a_2 < .. are coordinates. The values U for
which N has order n are an open set of (0, oo)^d, and the map from U to K is proper: of values whose
functions converge to F in K let those of each element converge in [0, oo] for a part of them. By
the theorem of `listed` F is the function of the network in which elements that tend to 0 are
deleted and those that tend to oo contracted. Its functions are in K(m, c', z') with m at most that
of generic ones; c' and z' are those of all its values: they are 0 where elements of the one kind,
or of the other one, alone join the ends of the port. So F is none of them, unless no element tends
to 0 or oo: the limit is in U. A proper map between oriented manifolds of one dimension, into a
connected one, has a degree, the sum of signs over the values of any function at which all are
regular, which is 0 if some function has none. The coefficients are coordinates of K up to a common
factor of one sign, so that the determinant of them and their derivatives has the sign of the map
everywhere, or everywhere its opposite.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache

from disting.errors import InputError
from disting.general.listed import goal_of, one_less, orientation, positive
from disting.general.model import Model
from disting.general.powers import placed_network
from disting.network.network import Network
from disting.network.normal_form import Part

REMEMBERED = 1024  # one-ports: each is asked about in many pairs
TRIES = 3  # points, of which almost all would do
PRIMES = (2, 3, 5, 7, 11, 13, 17, 19)
SetOf = Callable[[Model], tuple[int, Part] | None]


@lru_cache(maxsize=REMEMBERED)
def covers(model: Model, whole: Part, set_of: SetOf) -> bool:
    """Whether a one-port of two kinds gives all functions of the set K(n, c, z), given as a part,
    in which its generic ones are; False says nothing.
    """
    names, network = model.parameters, model.network
    coefficients = [c for c in (*model.numerator, *model.denominator) if not c.is_zero()]
    d = 2 * _order(whole) + len(whole.single)
    if network is None or not d == len(names) == len(network.seen) == len(coefficients) - 1:
        return False
    if d > len(PRIMES) or model.powers.weights or _some_minor_reaches(model, whole, set_of):
        return False
    points = (
        {name: Fraction(PRIMES[(i * (k + 1)) % d], k + 1) for i, name in enumerate(names)}
        for k in range(TRIES)
    )
    degrees = (_degree(model, values) for values in points)
    return bool(next((degree for degree in degrees if degree is not None), 0))


def _order(part: Part) -> int:
    return sum(n for _, n in part.terms)


def _some_minor_reaches(model: Model, whole: Part, set_of: SetOf) -> bool:
    """Whether a network that remains has functions of that set, or it is not known."""
    assert model.network is not None
    todo = [placed_network(model.network, model.powers)]
    met = set(todo)
    while todo:
        network = todo.pop()
        for at in range(len(network.elements)):
            for contracted in (False, True):
                less = one_less(network, at, contracted)
                if less is None or less in met or _is_of_one_kind(less):
                    continue
                met.add(less)
                try:
                    found = set_of(Model.from_network(less))
                except InputError:
                    return True
                if found is None or (
                    found[1].single == whole.single and _order(found[1]) >= _order(whole)
                ):
                    return True
                todo.append(less)
    return False


def _is_of_one_kind(network: Network) -> bool:
    """Its functions have no poles but at 0 and infinity."""
    return len({e.power for e in network.elements}) == 1


def _degree(model: Model, values: dict[str, Fraction]) -> int | None:
    """The sum of signs over all positive values with the function of these; 0 where they are not
    all known, None where not all are regular.
    """
    goal = goal_of(model, values)
    found = (goal and positive(goal, model, thorough=True)) or ()
    signs = [orientation(model, e) for e in found]
    return sum(signs) if all(signs) else None
