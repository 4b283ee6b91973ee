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
has coordinates, the degree of the map decides.

THEOREM. Let N be a one-port of d = 2 n + c + z elements whose generic functions are in K(n, c, z),
and let no network that remains when elements are deleted or contracted have generic functions in
K(m, c, z) with m >= n. Then its map into K has a degree, the sum over the values of any function at
which all are regular of the signs of the determinants there. If it is not 0, N gives all of K.
Proof. K is connected and oriented: the k and 0 < a_1 < a_2 < .. are coordinates. The values U for
which N has order n are an open set of (0, oo)^d, and the map from U to K is proper: of values whose
functions converge to F in K let those of each element converge in [0, oo] for a part of them. By
the theorem of `fibre_lists` F is the function of the network in which elements that tend to 0 are
deleted and those that tend to oo contracted. Its functions are in K(m, c', z') with m at most that
of generic ones; c' and z' are those of all its values: they are 0 where elements of the one kind,
or of the other one, alone join the ends of the port. So F is none of them, unless no element tends
to 0 or oo: the limit is in U. A proper map between oriented manifolds of one dimension, into a
connected one, has a degree, which is 0 if some function has no values. The coefficients are
coordinates of K up to a common factor of one sign, so that the determinant of them and their
derivatives has the sign of the map everywhere, or everywhere its opposite. Networks that remain are
examined while their degree (the larger one of numerator and denominator) is that of N: those of
smaller degree have no functions in K(m, c, z), m >= n, nor has what remains of them, as limits have
no larger degree.

Let K' be K(n - 1, 1, z) if c = 0, where a_n tends to oo and k_n/a_n does not, and K(n, 0, z) if
c = 1, where k tends to 0. K and K' together are a manifold whose boundary is K', with the
coordinates 1/a_n >= 0 and k_n/a_n, or k >= 0. Let N_1, N_2, .. be the networks that remain when one
element is deleted or contracted, that have d - 1 elements, generic functions in K', and regular
values.
THEOREM. If all of these have a degree, that of N is the sum of theirs, each times 1 or -1: the sign
of N's determinant, while that element is near its limit, times the sign of that of the N_i.
Proof. Let F in K' be regular for all N_i, and no function of a network of fewer elements, of one of
no regular values, or of values of a larger order: these have fewer dimensions. Let functions of K
tend to F, and of values with these functions let a part converge in [0, oo]. F is a function of
what remains. That is not N, whose functions all have c and z, so something is gone, and as F is
generic one element is gone and an N_i remains. Let e >= 0 be the value of the element that is
deleted or the inverse of one that is contracted. The coefficients are affine in e, all their terms
have one sign, and at e = 0 they are those of N_i but for one that vanishes, that of the highest
power of x in the denominator, or of the numerator if c = 1: it is e times a factor that is not 0 at
positive values. So the determinant at e = 0 is that of N_i times this factor: near such values the
map is one to one, with e = 0 where it gives K'. Hence functions of K near F have exactly one set of
values near each of those of F, and no other. The signs are those in question.
"""

from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import product

from flint import fmpz, fmpz_mat

from disting.errors import InputError
from disting.general.fibre_lists import coefficients, jacobian, one_less
from disting.general.matrix_model import AnyModel, Model
from disting.general.powers import placed_network
from disting.network.network import Element, Network
from disting.network.normal_form import Part, Power, normal_form
from disting.network.simplest import same_but_for_gears, simplest

ONE_PORTS = 1024  # one-ports: each is asked about in many pairs
MOST_ELEMENTS = 10  # of a one-port whose degree is computed: what remains of it doubles with each
POWERS = (1, 2, 3)  # of values at which a determinant may be 0 by chance
TWO = 2  # kinds of elements
REMEMBERED = 4096


@lru_cache(maxsize=ONE_PORTS)
def degree(network: Network) -> int | None:
    """The degree of the map of a one-port of two kinds of elements, or of one element, to its set
    K(n, c, z), up to its sign; None where it is not shown to have one.

    >>> from disting.network import network_of
    >>> degree(network_of("#~1, 1~2, 2~3; F3:1; S3:1"))
    1
    """
    model, kinds = Model.from_network(network), sorted({e.power for e in network.seen})
    whole, d = _part_of(model), len(model.parameters)
    if whole is None or not d == len(network.elements) == 2 * _order(whole) + len(whole.single):
        return None
    if d == 1:
        return 1 if _determinant(model, _point(model, 1)) > 0 else -1
    if d > MOST_ELEMENTS or model.powers.weights or _some_minor_reaches(network, whole):
        return None
    total, face = 0, _face(whole, kinds[0], kinds[-1])
    for at, contracted, made in _one_less_each(network):
        part = _part_of(made)
        if part is None and len(made.parameters) == d - 1:
            return None
        if part == face and len(made.parameters) == d - 1 and _is_regular(made):
            assert made.network is not None
            known = degree(made.network)
            if known is None:
                return None
            total += known * _sign_near(model, at, contracted, made)
    return total


def _part_of(model: Model) -> Part | None:
    """K(n, c, z) as a part that gives it, that of a single kind of elements being one of them."""
    assert model.network is not None
    kinds = {e.power for e in model.network.seen}
    if len(kinds) == 1:
        return Part("S", (*kinds,))
    own = set_of(model)
    return own and own[1]


def _order(part: Part) -> int:
    return sum(n for _, n in part.terms)


def _face(whole: Part, low: Power, high: Power) -> Part:
    """K': the constant vanishes, or a term becomes the constant."""
    n = _order(whole)
    if low in whole.single:
        return Part("S", tuple(x for x in whole.single if x != low), whole.terms)
    return Part("S", (low, *whole.single), (((low, high), n - 1),) if n > 1 else ())


def _one_less_each(network: Network) -> Iterator[tuple[Element, bool, Model]]:
    """Yield each element that can be deleted, or contracted, and what remains."""
    for (at, e), contracted in product(enumerate(network.elements), (False, True)):
        less = one_less(network, at, contracted)
        if less is not None:
            yield e, contracted, Model.from_network(less)


def _is_regular(model: Model) -> bool:
    """Return True if the determinant is not 0 at all values."""
    numbers = (_determinant(model, _point(model, step)) for step in POWERS)
    return any(numbers) or not jacobian(model).is_zero()


def _sign_near(model: Model, gone: Element, contracted: bool, rest: Model) -> int:
    """The sign of the determinant while an element is near its limit, times that of what remains:
    the same at all values but those where one is 0.
    """
    at, to_zero = model.parameters.index(gone.value), contracted == gone.kind.divides
    number, step = fmpz(0), 0
    while not number:
        step += 1
        point = _point(model, step) | {gone.value: 0}
        number = _determinant(rest, point) * _determinant(model, point, at, to_zero)
    return 1 if number > 0 else -1


def _point(model: Model, step: int) -> dict[str, int]:
    """Values, the more different the higher the step."""
    return {name: (i + 2) ** step + i for i, name in enumerate(model.parameters)}


def _determinant(
    model: Model, point: Mapping[str, int], at: int | None = None, to_zero: bool = False
) -> fmpz:
    """The determinant of the coefficients and their derivatives at a point; or its factor of the
    lowest or the highest power of a value, which is 0 there. The coefficients a + b p are affine in
    it: that is the determinant of a, the derivatives of a or of b by the others, and b.
    """
    values, row = [point[name] for name in model.parameters], coefficients(model)
    varying = row if at is None or to_zero else [c.derivative(at) for c in row]
    table = [row, *([c.derivative(i) for c in varying] for i in range(len(values)))]
    if at is not None:
        table[at + 1] = [c.derivative(at) for c in row]
    return fmpz_mat([[c(*values) for c in entries] for entries in table]).det()


def _some_minor_reaches(network: Network, whole: Part) -> bool:
    """Return True if a remaining network has functions of that set, or this is unknown."""
    model = Model.from_network(network)
    todo, met = [network], {network}
    while todo:
        for _, _, made in _one_less_each(todo.pop()):
            less = made.network
            if less is None or less in met or _is_of_one_kind(less):
                continue
            met.add(less)
            if made.n_states * model.powers.step < model.n_states * made.powers.step:
                continue  # the degree in s is smaller
            part = _part_of(made)
            if part is None or (part.single == whole.single and _order(part) >= _order(whole)):
                return True
            todo.append(less)
    return False


def _is_of_one_kind(network: Network) -> bool:
    """Its functions have no poles but at 0 and infinity."""
    return len({e.power for e in network.elements}) == 1


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
    if len(network.elements) <= 2 * _order(wanted) + len(wanted.single):
        return bool(degree(network))
    rest = (made for _, _, made in _one_less_each(network) if _part_of(made) == wanted)
    return any(made.network is not None and _gives_all(made.network, wanted) for made in rest)


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
