"""Equivalence of two networks for all positive values, special ones excepted: both are made of
parts that can replace each other, or both are one-ports of two kinds of elements that give all
functions of one set K(n, c, z) (see `disting.network.normal_form`).

One-ports that are not made in series and parallel, such as bridges. Let N be a one-port of two
kinds of elements, and let one of its minors be of the same n, c, z and give all of K(n, c, z).

THEOREM. For generic values N gives functions of K(n, c, z) only, and all of them but special ones.
Proof. P = s^(r_A) (A + x B) with A, B positive semidefinite, so the compliance is s^(-r_A) F(x),
F = b^T (A + x B)^-1 b. Bringing A and B to diagonal form at once shows that F is a sum of positive
multiples of 1, 1/x and 1/(x + a_i), a_i > 0; n, c, z are those of generic values. The minor gives
all of K(n, c, z) by values p; let F_0 be a regular value of its map, as all but special ones are
(Sard). The values of elements that are deleted, and the inverses of those that are contracted, are
e >= 0: the map of N depends smoothly on p and e, and at e = 0 it is that of the minor, whose
derivatives by p have full rank at the p of F_0. So for small e > 0 some p near by gives F_0
(implicit function theorem).

Where nothing smaller remains that gives as much, as of bridges with as many elements as K(n, c, z)
has coordinates, the degree of the map decides. Let A and B be the kinds of elements, x the power of
s in B over that in A, and an element be seen if its value matters.

LEMMA. A function of K(n, c, z) takes at least n + c elements A and n + z elements B that are seen.
Proof. With A and B diagonal, F is a sum of v^2/(alpha + x beta) with alpha, beta >= 0: n terms have
both, the constant has alpha alone, the pole at 0 beta alone. So these are least ranks of A and B.

Let N have d = 2 n + c + z elements, all seen, and generic functions in K = K(n, c, z). So n + c of
them are A and n + z are B, both without loops, and there are n + c + z nodes beside the ground.
THEOREM. The map of N into K has a degree, the sum over the values of any function at which all are
regular of the signs of the determinants there. If it is not 0, N gives all of K.
Proof. K is connected and oriented: the k and 0 < a_1 < a_2 < .. are coordinates. The values U for
which N has order n are an open set of (0, oo)^d, and the map from U to K is proper: of values whose
functions converge to F in K let those of each element converge in [0, oo] for a part of them. By
the theorem of `fibre_lists` F is the function of the network in which elements that tend to 0 are
deleted and those that tend to oo contracted. If there are any, it has too few by the lemma. So the
limit is in (0, oo)^d, and in U. A proper map between oriented manifolds of one dimension, into a
connected one, has a degree, which is 0 if some function has no values. The coefficients are
coordinates of K up to a common factor of one sign, so that the determinant of them and their
derivatives has the sign of the map everywhere, or everywhere its opposite.

Let K' be K(n - 1, 1, z) if c = 0, where a_n tends to oo and k_n/a_n does not, and K(n, 0, z) if
c = 1, where k tends to 0. K and K' together are a manifold whose boundary is K', with the
coordinates 1/a_n >= 0 and k_n/a_n, or k >= 0. Let N_1, N_2, .. be the networks of d - 1 elements,
all seen, and generic functions in K' that remain when one B is deleted (c = 0) or one A is
contracted (c = 1).
THEOREM. The degree of N is the sum of those of the N_i, each times 1 or -1: -1 to the power of
d + i + 1 if c = 0, of n + z + i if c = 1, i being the place, from 0, of the element that is gone.
One element has the degree 1.
Proof. Let F in K' be regular for all N_i and no function of fewer than d - 1 elements, which have
fewer dimensions. Let functions of K tend to F, and of values with these functions let a part
converge in [0, oo]. F is a function of what remains. That is not N, whose functions all have its c,
so something is gone, and as F is generic one element is gone and an N_i remains, all of whose
values have limits in (0, oo). The coefficients are sums of products of admittances (spanning trees
and pairs of trees), and since all elements are seen the sum of the denominator and y times the
numerator has no factor but x (the graph and an edge y at the port are in one block), so nothing
cancels. Let e >= 0 be the admittance of the B or the inverse one of the A. One coefficient tends to
0 with e, that of the highest power of x in the denominator (c = 0) or in the numerator (c = 1): it
is e times the product of all other B. The others are those of N_i at e = 0. So the determinant of
N is there that of N_i times this product, but for the sign: of the place of this coefficient, of
the place of the element, and of the inverse. The map is one to one near such values, with e = 0
where it gives K', and functions of K near F have exactly one set of values near each of those of F,
and no other.
"""

from functools import lru_cache
from itertools import product

from disting.errors import InputError
from disting.general.fibre_lists import one_less
from disting.general.matrix_model import AnyModel, Model
from disting.general.powers import placed_network
from disting.network.network import Network, parts
from disting.network.normal_form import Part, Power, normal_form
from disting.network.simplest import same_but_for_gears, simplest

REMEMBERED = 4096  # networks: each is asked about in many pairs
MOST_ELEMENTS = 14  # of a one-port whose degree is computed: what remains of it doubles with each
MOST_LEFT_OUT = 3  # elements, of what remains
TWO = 2  # kinds of elements


@lru_cache(maxsize=REMEMBERED)
def degree(network: Network) -> int:
    """The degree, up to its sign, of the map of a one-port of two kinds of elements to its set
    K(n, c, z); 0 also where its elements are not 2 n + c + z, all seen, or more than 14.

    >>> from disting.network import network_of
    >>> abs(degree(network_of("#~1, 1~2, 1~3; F3:2; S3:2")))
    2
    """
    d, kinds = len(network.elements), sorted({e.power for e in network.elements})
    if d == 1:
        return 1
    numbers = _numbers(network, *kinds) if len(kinds) == TWO and d <= MOST_ELEMENTS else None
    if numbers is None:
        return 0
    n, c, z = numbers
    total = 0
    for at, e in enumerate(network.elements):
        less = one_less(network, at, contracted=c) if e.power == kinds[not c] else None
        if less is not None and len(less.elements) == d - 1:
            total += (-1) ** (at + (n + z if c else d + 1)) * degree(less)
    return total


def _numbers(network: Network, low: Power, high: Power) -> tuple[int, bool, bool] | None:
    """n, c, z of a one-port of 2 n + c + z elements that are all seen; None of any other."""
    if len(network.seen) < len(network.elements) or any(e.ratio for e in network.elements):
        return None
    nodes, port = (0, *network.nodes), network.inputs[0]
    ends = [((e.nodes[0], (*e.nodes, 0)[1]), e.power) for e in network.elements]
    by_low, by_high = (parts(nodes, [x for x, kind in ends if kind == k]) for k in (low, high))
    c, z = by_high[port.plus] != by_high[port.minus], by_low[port.plus] != by_low[port.minus]
    of_low, of_high, of_all = (
        len(nodes) - len({*by.values()})  # edges of a spanning forest
        for by in (by_low, by_high, parts(nodes, [x for x, _ in ends]))
    )
    n = of_low + of_high - of_all
    return (n, c, z) if len(ends) == 2 * n + c + z else None


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
    return the_full_set if _is_full(network, the_full_set[1]) else None


def _is_full(network: Network, wanted: Part) -> bool:
    """Return True if the network gives all of the set in which its functions are."""
    try:
        return _gives_all(network, wanted)
    except InputError:  # of a network that remains
        return False


@lru_cache(maxsize=REMEMBERED)
def _gives_all(network: Network, wanted: Part) -> bool:
    """Return True if it, or what remains where elements are deleted or contracted, is a part that
    gives all of a set, or has a degree that is not 0.
    """
    form = normal_form(network.grounded)
    if form and len(form.edges) == 1 and form.edges[0][2] == wanted:
        return True
    too_many = len(network.elements) - 2 * sum(n for _, n in wanted.terms) - len(wanted.single)
    if not 0 < too_many <= MOST_LEFT_OUT:
        return bool(degree(network))
    ways = product(range(len(network.elements)), (False, True))
    rest = filter(None, (one_less(network, at, contracted) for at, contracted in ways))
    return any(_is_in(less, wanted) and _gives_all(less, wanted) for less in rest)


def _is_in(network: Network, wanted: Part) -> bool:
    own = set_of(Model.from_network(network))
    return own is not None and own[1] == wanted


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
