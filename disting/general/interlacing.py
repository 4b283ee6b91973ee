"""Undamped machines whose force and sensor are apart: what poles and zeros they can have.

Let N masses be joined by springs as a tree, with one more spring to the ground, or with none: it is
held or free; x = s^2. Then G = n x^j W(x)/D(x), D = (x + a_1) .. (x + a_N) with 0 < a_1 < a_2 < ..
for generic values, but a_1 = 0 if it is free. Let the zeros of W be the poles of some of the parts
into which the machine falls (H) when one mass is held, or (C) when it is held and one spring
between masses is cut, each once; a pole at 0, of a part that is free then, left out.

THEOREM. For generic values n can have any value of its sign, the other a any positive ones, and the
zeros -w of W any for which each w is between two neighbours a_i and a_(i+1), no two between the
same. So two such machines, both held or both free, with the same N, j, degree of W and sign of n
give the same functions, special ones aside.
Proof. (H) Seen at the mass v the dynamic stiffness is Z = m x + c + sum r_i x/(x + b_i), where b_1
< .. < b_(N-1) are the poles of the parts and m, c, r_i > 0; its zeros are the -a_i. So a_i < b_i <
a_(i+1), and all such a, b, each with any factor, come from one Z (partial fractions). The terms may
be given to the branches at v in any way by their numbers of masses, c to the branch with the spring
to the ground, or to v if it is there: each branch gives any such share (the theorem on trees in the
guide). So any of the b are the poles of the parts in question. If the machine is free, c = 0 and so
a_1 = 0, and the rest is the same.
(C) Let k be the spring, h(x) the compliance between its ends when it is cut, a sum of r_i/(x + b_i)
with r_i > 0, b_1 = 0 for the free part, b_2, .. the other poles of both parts. D is prod (x + b_i)
(1 + k h) up to a factor, so b_i < a_i < b_(i+1), and all such a, b come from one k h (partial
fractions). With k = 1 the terms may be given to both parts in any way by their numbers of masses,
b_1 to the free one: each part, seen at its end, gives any such share (Foster, and the theorem on
trees).
In both cases the w are any of the b between the a. Values times a number t leave a and w as they
are and make n/t of n.

With more springs, wherever they are: let the zeros of such a machine be poles of parts that are
left when one mass is held, and let a tree of the theorem, held or free as the machine is, with the
same N, j, degree of W and sign of n remain when springs are left out.
THEOREM. It gives the same functions as this tree.
Proof. Holding one mass is one condition on a symmetric pencil, so a_i <= b_i <= a_(i+1) as before
(Cauchy), and no zero is a pole: each w is between two neighbours, no two between the same, so it
gives no others. The tree gives all of them: at generic values p the derivatives of the coefficients
have full rank. They depend smoothly on p and on the values e >= 0 of the other springs, and at
e = 0 they are those of the tree. So for small e > 0 some p near by gives the same function
(implicit function theorem).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from math import prod

from flint import fmpz_mpoly

from disting.algebra.determinants import minors
from disting.algebra.symbols import symbols
from disting.errors import InputError
from disting.evidence.decision import GROUNDS, INTERLACING, REPLACEMENT
from disting.general.matrix_model import AnyModel, Model
from disting.general.replacement import simplest_network
from disting.network.grounds import grounded_everywhere, is_undamped
from disting.network.network import Element, Network, Port, parts
from disting.network.simplest import simplest

REMEMBERED = 512  # machines: each is asked about in many pairs
Ring = dict[str, fmpz_mpoly]
"""x and the values of the elements by name."""


@dataclass(frozen=True, slots=True)
class MachineType:
    """Number of masses, held by springs to the ground or not, the power of s that divides the
    denominator, which powers are in the numerator, and its sign.
    """

    masses: int
    is_held: bool
    at_zero: int
    numerator: tuple[bool, ...]
    sign: int


def sets_of(model: AnyModel) -> dict[str, object]:
    """Sets of functions that the model gives by theorems on networks, by their names: models with
    equal sets are equivalent, None gives no information.
    """
    plain, network = simplest_network(model), model.network
    kind, whole = (None, None) if plain is None else _of_simplest(plain)
    grounded = network and grounded_everywhere(network)
    return {
        REPLACEMENT: plain,
        INTERLACING: machine_type(model) or kind,
        GROUNDS: simplest(grounded) if grounded else whole,
    }


@lru_cache(maxsize=REMEMBERED)
def _of_simplest(plain: Network) -> tuple[MachineType | None, Network | None]:
    """The same of a simplest network of masses and springs: many networks have the same one."""
    machines = [*machines_of(plain)]
    kinds = (machine_type(Model.from_network(machine)) for machine in machines)
    grounded = (simplest(whole) for machine in machines if (whole := grounded_everywhere(machine)))
    return next(filter(None, kinds), None), next(filter(None, grounded), None)


def machines_of(network: Network) -> Iterator[Network]:
    """Yield a simplest network of masses and springs as a machine: where all masses meet in one
    node, this node may be the ground.
    """
    masses = [{*_ends(e)} for e in network.elements if e.letter == "j"]
    springs = [e for e in network.elements if e.letter == "k"]
    if not masses or len(masses) + len(springs) < len(network.elements):
        return
    for ground in sorted(set.intersection(*masses)):
        to = {node: node for node in (0, *network.nodes)} | {ground: 0, 0: ground}
        at = sorted(to[node] for ends in masses for node in ends - {ground})
        if at != [*network.nodes]:
            continue
        inputs, outputs = (
            tuple(Port(to[port.plus], to[port.minus]) for port in side)
            for side in (network.inputs, network.outputs)
        )
        elements = [Element(f"m{node}", "m", (node,)) for node in at]
        for i, e in enumerate(springs, 1):
            low, high = sorted(to[node] for node in _ends(e))
            elements.append(Element(f"k{i}", "k", (low, high) if low else (high, 0)))
        yield Network(tuple(elements), inputs, outputs, network.order)


@lru_cache(maxsize=REMEMBERED)
def machine_type(model: AnyModel) -> MachineType | None:
    """The functions of a machine of the theorems, None of any other.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> star, chain = "#~1, #~2, 1~2, 1~3; F1; S2", "#~1, 1~2, 2~3; F1; S2"
    >>> one, other = (machine_type(of_network(network_of(text))) for text in (star, chain))
    >>> one == other
    True
    """
    if not isinstance(model, Model) or model.network is None or model.powers.weights:
        return None
    network, there = model.network, tuple(map(bool, model.numerator_terms))
    masses, is_held = len(network.nodes), _is_held(network)
    at_zero = next(i for i, terms in enumerate(model.denominator_terms) if terms)
    if (
        not is_undamped(network)
        or model.degrees[1] - at_zero != 2 * (masses - (not is_held))
        or not _has_zeros_of_parts(model, network)
    ):
        return None
    first = there.index(True)
    signs = {number > 0 for _, number in model.numerator_terms[first]}
    if len(signs) > 1:
        return None
    found = MachineType(masses, is_held, at_zero, there, 1 if signs.pop() else -1)
    if is_tree(network) or found in map(machine_type, _trees_within(network)):
        return found
    return None


def _has_zeros_of_parts(model: Model, network: Network) -> bool:
    """Return True if the zeros are poles of parts that are left where a mass is held or, in a tree,
    a spring is cut.
    """
    first = next(i for i, terms in enumerate(model.numerator_terms) if terms)
    ring = symbols(["x", *model.parameters])
    zeros = ring["x"] * 0
    for at, terms in enumerate(model.numerator_terms[first::2]):
        for exponents, number in terms:
            powers = zip(model.parameters, exponents, strict=True)
            zeros += int(number) * ring["x"] ** at * prod(ring[p] ** int(e) for p, e in powers)
    is_even = not any(model.numerator_terms[first + 1 :: 2])
    return is_even and any(_are_zeros_of(zeros, chosen) for chosen in _choices(network, ring))


def _trees_within(network: Network) -> Iterator[Model]:
    """Yield what is a tree, held by one spring or free, when springs are left out."""
    springs = [e for e in network.elements if e.letter == "k"]
    masses = [e for e in network.elements if e.letter == "m"]
    for kept in combinations(springs, len(masses) - (not _is_held(network))):
        chosen = tuple(e for e in network.elements if e in masses or e in kept)
        try:
            tree = Network(chosen, network.inputs, network.outputs, network.order)
        except InputError:
            continue
        if is_tree(tree) and len(tree.elements) < len(network.elements):
            yield Model.from_network(tree)


def is_tree(network: Network) -> bool:
    """Return True if it is made of masses, springs that connect them as a tree, and at most one to
    the ground.
    """
    nodes = network.nodes
    springs = [e for e in network.elements if e.letter == "k"]
    joints = [e for e in springs if 0 not in _ends(e)]
    return (
        is_undamped(network)
        and len(springs) <= len(nodes) == len(joints) + 1
        and len(set(parts(nodes, map(_ends, joints)).values())) == 1
    )


def _is_held(network: Network) -> bool:
    return any(0 in _ends(e) for e in network.elements if e.letter == "k")


def _ends(element: Element) -> tuple[int, int]:
    first, second, *_ = (*element.nodes, 0)
    return first, second


def _choices(network: Network, ring: Ring) -> Iterator[tuple[fmpz_mpoly, ...]]:
    """Yield the polynomials of all choices of parts that are left where a mass is held or a spring
    between masses is cut.
    """
    may_be_cut = is_tree(network) and _is_held(network)
    inner = [k for k in network.elements if may_be_cut and 0 not in _ends(k)]
    cut = [[e for e in network.elements if e is not k] for k in inner]
    ways = [*((network.elements, i) for i in network.nodes), *((rest, 0) for rest in cut)]
    for elements, held in ways:
        left = [i for i in network.nodes if i != held]
        joints = [e for e in map(_ends, elements) if not {0, held} & {*e}]
        of = parts(left, joints)
        polynomials = [
            _polynomial([i for i in left if of[i] == part], elements, ring)
            for part in sorted(set(of.values()))
        ]
        for count in range(len(polynomials) + 1):
            yield from combinations(polynomials, count)


def _polynomial(nodes: Sequence[int], elements: Sequence[Element], ring: Ring) -> fmpz_mpoly:
    """The determinant of x M + K of these masses, all others being held; without the factor x of a
    part that is free.
    """
    zero = ring["x"] * 0
    table = [[zero for _ in nodes] for _ in nodes]
    for e in elements:
        ends = [nodes.index(i) for i in _ends(e) if i in nodes]
        value = ring[e.value] * (ring["x"] if e.letter == "m" else 1)
        for i in ends:
            for j in ends:
                table[i][j] += value if i == j else -value
    return _lowest(minors(table, {0: ring["x"] ** 0})[(1 << len(nodes)) - 1], ring["x"])[0]


def _lowest(polynomial: fmpz_mpoly, x: fmpz_mpoly) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Without factors x, and what is left of that at x = 0."""
    while (polynomial % x).is_zero():
        polynomial = polynomial // x
    return polynomial, polynomial % x


def _are_zeros_of(polynomial: fmpz_mpoly, chosen: Sequence[fmpz_mpoly]) -> bool:
    """Return True if it is the product of these except for a factor without x."""
    x = polynomial.context().gens()[0]
    wanted = prod(chosen, start=x**0)
    return bool(polynomial * (wanted % x) == wanted * (polynomial % x))
