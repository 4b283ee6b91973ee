"""Equivalence of two networks for all positive values, special ones excepted: both are made of
parts that can replace each other, or both are one-ports of two kinds of elements that give all
functions of one set K(n, c, z) (see `disting.network.normal_form`).

One-ports that are not made in series and parallel, such as bridges. Let N be a one-port of two
kinds of elements, and let one of its minors, in series and parallel, be of the same n, c, z.

THEOREM. For generic values N gives functions of K(n, c, z) only, and all of them but special ones.
Proof. P = s^(r_A) (A + x B) with A, B positive semidefinite, so the compliance is s^(-r_A) F(x),
F = b^T (A + x B)^-1 b. Bringing A and B to diagonal form at once shows that F is a sum of positive
multiples of 1, 1/x and 1/(x + a_i), a_i > 0; n, c, z are those of generic values. The minor gives
all of K(n, c, z) by values p; let F_0 be a regular value of its map, as all but special ones are
(Sard). The values of elements that are deleted, and the inverses of those that are contracted, are
e >= 0: the map of N depends smoothly on p and e, and at e = 0 it is that of the minor, whose
derivatives by p have full rank at the p of F_0. So for small e > 0 some p near by gives F_0
(implicit function theorem).

Whether a one-port of two kinds of elements gives all functions of K(n, c, z), by the degree of
its map: bridges of which no part in series and parallel remains that would show it.

THEOREM. Let N be a one-port of d = 2 n + c + z elements whose generic functions are in K(n, c, z),
and let no network that remains when elements are deleted or contracted have generic functions in
K(m, c, z) with m >= n. Take values such that all positive values with the same function are
regular. If the signs of the determinants there do not add up to 0, N gives all of K(n, c, z).
Proof. K is connected and oriented: the k and 0 < a_1 < a_2 < .. are coordinates. The values U for
which N has order n are an open set of (0, oo)^d, and the map from U to K is proper: of values whose
functions converge to F in K let those of each element converge in [0, oo] for a part of them. By
the theorem of `fibre_lists` F is the function of the network in which elements that tend to 0 are
deleted and those that tend to oo contracted. Its functions are in K(m, c', z') with m at most that
of generic ones; c' and z' are those of all its values: they are 0 where elements of the one kind,
or of the other one, alone join the ends of the port. So F is none of them, unless no element tends
to 0 or oo: the limit is in U. A proper map between oriented manifolds of one dimension, into a
connected one, has a degree, the sum of signs over the values of any function at which all are
regular, which is 0 if some function has none. The coefficients are coordinates of K up to a common
factor of one sign, so that the determinant of them and their derivatives has the sign of the map
everywhere, or everywhere its opposite. Networks that remain are examined while their degree (the
larger one of numerator and denominator) is that of N: those of smaller degree have no functions in
K(m, c, z), m >= n, nor has what remains of them, as limits have no larger degree.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, product

from disting.errors import InputError
from disting.general.fibre_lists import goal_of, one_less, orientation, positive
from disting.general.matrix_model import AnyModel, Model
from disting.general.powers import placed_network
from disting.general.target import Values
from disting.network.network import Element, Network, Port, move
from disting.network.normal_form import Part, Power, normal_form
from disting.network.simplest import same_but_for_gears, simplest

ONE_PORTS = 1024  # one-ports: each is asked about in many pairs
TRIES = 3  # points, of which almost all would do
PRIMES = (2, 3, 5, 7, 11, 13, 17)  # values: of eight elements no list of all was seen to end
SetOf = Callable[[Model], tuple[int, Part] | None]
TWO = 2  # kinds of elements
MOST_LEFT_OUT = 3  # elements, of the minors that are looked at
REMEMBERED = 4096


@lru_cache(maxsize=ONE_PORTS)
def covers(model: Model, whole: Part, set_of: SetOf) -> bool:
    """Return True if a one-port of two kinds gives all functions of the set K(n, c, z), given as a
    part, that contains its generic ones; False proves nothing.
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
    """Return True if a remaining network has functions of that set, or this is unknown."""
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
                    made = Model.from_network(less)
                    if made.n_states * model.powers.step < model.n_states * made.powers.step:
                        continue  # the degree in s is smaller
                    the_full_set = set_of(made)
                except InputError:
                    return True
                if the_full_set is None or (
                    the_full_set[1].single == whole.single
                    and _order(the_full_set[1]) >= _order(whole)
                ):
                    return True
                todo.append(less)
    return False


def _is_of_one_kind(network: Network) -> bool:
    """Its functions have no poles but at 0 and infinity."""
    return len({e.power for e in network.elements}) == 1


def _degree(model: Model, values: Values) -> int | None:
    """The sum of signs over all positive values with the function of these; 0 where they are not
    all known, None where not all are regular.
    """
    goal = goal_of(model, values)
    equivalents = (goal and positive(goal, model, thorough=True)) or ()
    signs = [orientation(model, e) for e in equivalents]
    return sum(signs) if all(signs) else None


def replaceable(left: AnyModel, right: AnyModel) -> bool:
    """Return True if both are networks that give the same functions by the theorems; False proves
    nothing.

    >>> from disting.network import network_of
    >>> bridge = Model.from_network(network_of("R1 1 2; C1 1 3; R2 2 3; R3 2 0; C2 3 0"))
    >>> replaceable(bridge, Model.from_network(network_of("p(R1,C1)-p(R2,C2)")))
    True
    """
    network = simplest_network(left)
    return network is not None and network == simplest_network(right)


def same_in_units(left: AnyModel, right: AnyModel) -> bool:
    """Return True if both are one machine in different units, those behind gears."""
    network, other = (m.network and placed_network(m.network, m.powers) for m in (left, right))
    return network is not None and other is not None and same_but_for_gears(network, other)


def simplest_network(model: AnyModel, larger: bool = False) -> Network | None:
    """The simplest network that gives the same functions by the theorems, None of what is no
    network or has no normal form. `larger`: that gives all of K where the network gives some of it.
    """
    if model.network is None:
        return None
    own_full_set = set_of(model) if larger else full_set(model)
    network = placed_network(model.network, model.powers)
    return simplest(network, own_full_set[1] if own_full_set else None)


def full_set(model: AnyModel) -> tuple[int, Part] | None:
    """The set K(n, c, z) of which a one-port of two kinds of elements gives all, as a part that
    gives it, and the sign before it: -1 where the sensor is turned against the force; None where
    that is not shown.
    """
    the_full_set = set_of(model)
    if the_full_set is None or model.network is None or not isinstance(model, Model):
        return None
    network = placed_network(model.network, model.powers)
    whole = _has_minor(network.grounded, the_full_set[1]) or covers(model, the_full_set[1], set_of)
    return the_full_set if whole else None


def set_of(model: AnyModel) -> tuple[int, Part] | None:
    """The set K(n, c, z) in which the functions of a one-port of two kinds of elements are."""
    if model.network is None or not isinstance(model, Model):
        return None
    network = placed_network(model.network, model.powers)
    sign, kinds = network.sign_of_one_port, sorted({e.power for e in network.seen})
    names = {"", *model.powers.placed.exponents}
    if not sign or len(kinds) != TWO or any(e.exponent not in names for e in network.seen):
        return None
    whole = _set_of(model, network.order, kinds[0], kinds[1])
    return None if whole is None else (sign, whole)


def _set_of(model: Model, order: int, low: Power, high: Power) -> Part | None:
    """n, c, z of F = s^(r_A - q) G, from the degrees of G; None of what is no such F."""
    first, last = (model.powers.placed.of_element(*power) for power in (low, high))
    step, shift = last - first, first - model.powers.step * order
    top, bottom = (
        [i for i, terms in enumerate(side) if terms]
        for side in (model.numerator_terms, model.denominator_terms)
    )
    at_zero, at_oo = top[0] - bottom[0] + shift, top[-1] - bottom[-1] + shift
    if step < 0:  # x falls where v grows
        at_zero, at_oo = at_oo, at_zero
    if at_zero not in (0, -step) or at_oo not in (0, -step):
        return None
    count = (bottom[-1] - bottom[0]) // abs(step)
    single = [r for r, is_there in ((low, at_oo == 0), (high, at_zero == -step)) if is_there]
    return Part("S", tuple(single), (((low, high), count),) if count else ())


@lru_cache(maxsize=REMEMBERED)
def _has_minor(network: Network, wanted: Part) -> bool:
    """Return True if the network, or a minor in series and parallel, is a part that gives all of a
    set.
    """
    port = network.inputs[0]
    elements = network.elements
    for count in range(MOST_LEFT_OUT + 1):
        for left_out in combinations(range(len(elements)), count):
            for contracted in product((False, True), repeat=count):
                chosen = dict(zip(left_out, contracted, strict=True))
                minor = _minor(elements, chosen, port)
                form = None if minor is None else normal_form(minor)
                if form and len(form.edges) == 1 and form.edges[0][2] == wanted:
                    return True
    return False


def _minor(elements: Sequence[Element], left_out: dict[int, bool], port: Port) -> Network | None:
    """The one-port with elements deleted, or contracted where True; None where there is none."""
    places = {i: i for e in elements for i in (*e.nodes, 0)} | {port.plus: port.plus}
    for at, contracted in left_out.items():
        if contracted:
            a, b = (places[i] for i in (*elements[at].nodes, 0)[:2])
            low, high = sorted((a, b))
            places = {i: low if j == high else j for i, j in places.items()}
    kept = [move(e, places) for i, e in enumerate(elements) if i not in left_out]
    other_port = Port(places[port.plus], places[port.minus])
    try:
        return Network(tuple(e for e in kept if e is not None), (other_port,), (other_port,))
    except InputError:
        return None
