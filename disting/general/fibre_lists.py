"""Points with and without positive equivalents, from lists of all equivalents of a rational point;
what holds at such a point is proven to hold near it.

WITH. Let the same coefficients of both be zero for all parameters, let the searched model Y have n
parameters and n + 1 others, and at a point x of the given model X an equivalent y, positive, at
which the matrix of these and their derivatives is not singular. Then all transfer functions with
such coefficients near that of y are those of parameters near y, which are positive, so all x near
by have an equivalent.

WITHOUT. Let Y be a one-port of positive elements, and let the function g of X at x be that of no
positive values of Y, and of no positive values of a minor of Y (elements deleted or contracted).
THEOREM. Then all x near by have no positive equivalent in Y. Proof. Else there are positive values
of Y whose functions converge to g. Of each element let its admittance p s^r converge in [0, oo],
for a part of the sequence (p alone decides that, s > 0). At every s > 0 the admittance of a network
of positive ones is least energy over potentials, so upper semicontinuous on [0, oo]^n, and by
Thomson's principle its inverse is least energy over flows, so it is lower semicontinuous too: it
converges to that of the limit, where elements of admittance 0 are deleted and those of oo are
contracted. So g is the function of Y or of a minor, at all s > 0, with positive values.
A limit of functions has no larger degree (the larger one of numerator and denominator), so a minor
of smaller degree has no function g, nor do its own minors.
"""

from dataclasses import replace
from functools import lru_cache

from flint import Ordering, fmpq, fmpq_poly, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.determinants import minors as subdeterminants
from disting.algebra.groebner.rational import Bounds, TooLarge
from disting.errors import InputError
from disting.general.any_model import in_powers
from disting.general.equivalent import Equivalent, sign_at
from disting.general.fibre import Extent, solve
from disting.general.matrix_model import AnyModel, Model
from disting.general.powers import MOST_EXPONENTS, Powers, place_name, placed_network
from disting.general.target import Target, Values, fibre_equations, rational_values, target
from disting.model.question import Domain
from disting.network.network import Network, Port, move, seen_by_blocks

REMEMBERED = 512
MOST_ELEMENTS = 6  # of a network of which all minors are looked at
PLACES = [place_name(i) for i in range(MOST_EXPONENTS)]


def find_equivalent(model: AnyModel, values: Values, other: AnyModel) -> tuple[float, ...] | None:
    """A positive equivalent (rounded) in the other model of a point around which all have some;
    None where that is not shown.
    """
    if not (isinstance(model, Model) and isinstance(other, Model)):
        return None
    is_there = _there(other)
    if _there(model) != is_there or len(other.parameters) != sum(map(sum, is_there)) - 1:
        return None
    goal = goal_of(model, values)
    equivalents = (goal and positive(goal, other)) or ()
    regular = (e for e in equivalents if orientation(other, e))
    return next((tuple(x.real for x in e.numbers) for e in regular), None)


def has_no_equivalent(model: AnyModel, values: Values, other: AnyModel) -> bool:
    """Return True if it is proven that no point around this one has a positive equivalent in the
    other model.
    """
    if not (isinstance(model, Model) and isinstance(other, Model)):
        return False
    network = other.network
    if not is_in_one_variable(model.powers, other.powers):
        return False
    if network is None or not network.sign_of_one_port or len(network.seen) > MOST_ELEMENTS:
        return False
    goal = goal_of(model, values)
    if goal is None or positive(goal, other) != ():
        return False
    degree = max(len(goal.numerator), len(goal.denominator)) - 1
    matched = placed_network(network, other.powers)
    minors = _of_degree(matched, degree, replace(other.powers, lost=0))
    return minors is not None and all(positive(goal, m) == () for m in minors)


def is_in_one_variable(powers: Powers, other: Powers) -> bool:
    """Return True if both count powers of the same v."""
    weights = zip(powers.weights, other.weights, strict=False)
    return powers.halves == other.halves and all(a == b for (_, a), (_, b) in weights)


def _there(model: Model) -> tuple[list[bool], list[bool]]:
    """Flags of the coefficients that are not identically zero."""
    return list(map(bool, model.numerator_terms)), list(map(bool, model.denominator_terms))


def goal_of(model: Model, values: Values) -> Target | None:
    """None where a pole runs to infinity."""
    try:
        return target(model, rational_values(model, values))
    except InputError:
        return None


def is_regular(model: Model, values: Values) -> bool:
    """Return True if numerator and denominator are coprime and of full degree at a point."""
    goal = goal_of(model, values)
    return goal is not None and model.degrees == (
        len(goal.numerator) - 1,
        len(goal.denominator) - 1,
    )


def positive(goal: Target, other: Model) -> tuple[Equivalent, ...] | None:
    """All positive equivalents; None where they are not all known."""
    try:
        fibre = solve(fibre_equations(goal, other), other.parameters, "list", Bounds())
    except TooLarge:
        return None
    if fibre.extent in (Extent.NONE, Extent.FINITE):
        return tuple(e for e in fibre.equivalents if e.domain is Domain.POSITIVE)
    return () if Domain.POSITIVE in fibre.excluded or Domain.REAL in fibre.excluded else None


@lru_cache(maxsize=REMEMBERED)
def _of_degree(network: Network, degree: int, powers: Powers) -> tuple[Model, ...] | None:
    """The minors of at least this degree, one for each function; None where not all are known."""
    todo, met, kept = [network], {network}, dict[object, Model]()
    while todo:
        whole = todo.pop()
        for at in range(len(whole.elements)):
            for contracted in (False, True):
                try:
                    the_network = one_less(whole, at, contracted)
                    if the_network is None or the_network in met:
                        continue
                    met.add(the_network)
                    made = Model.from_network(the_network)
                except InputError:
                    return None
                names = PLACES[: len(powers.weights)]
                if not set(made.powers.exponents) <= set(names):
                    return None
                model = in_powers(made, powers, [names.index(n) for n in made.powers.exponents])
                if max(model.degrees) >= degree:
                    kept.setdefault(model.content, model)
                    todo.append(the_network)
    return tuple(kept.values())


def one_less(whole: Network, at: int, contracted: bool) -> Network | None:
    """A one-port with an element deleted or contracted, as far as it can be measured; None where
    the port is open or shorted then.
    """
    places = {i: i for e in whole.elements for i in (*e.nodes, 0)}
    places |= {i: i for p in whole.ports for i in (p.plus, p.minus)}
    if contracted:
        low, high = sorted((*whole.elements[at].nodes, 0)[:2])
        places[high] = low
    (force,), (sensor,) = whole.inputs, whole.outputs
    if places[force.plus] == places[force.minus]:
        return None
    rest = [e for i, e in enumerate(whole.elements) if i != at]
    kept = [m for e in rest if (m := move(e, places)) is not None]
    ports = [Port(places[p.plus], places[p.minus]) for p in (force, sensor)]
    observable = [kept[i] for i in sorted(seen_by_blocks(kept, ports[:1], ports[1:]))]
    if not observable:
        return None
    if not any(0 in (*e.nodes, 0)[:2] for e in observable):  # it floats: one end becomes its ground
        places = {i: i for e in observable for i in e.nodes} | {ports[0].minus: 0}
        observable = [m for e in observable if (m := move(e, places)) is not None]
        ports = [Port(places[p.plus], places[p.minus]) for p in ports]
    return Network(tuple(observable), (ports[0],), (ports[1],), whole.order)


def orientation(model: Model, at: Equivalent) -> int:
    """The sign at a real vector of values of the determinant of the matrix of the n + 1
    coefficients and their derivatives, those left out that are always zero. At a root of an
    irreducible polynomial it is zero only where that divides it.
    """
    modulus = fmpq_poly(list(at.polynomial))
    values = [fmpq_poly([fmpq(x.numerator, x.denominator) for x in c]) for c in at.coordinates]
    total = fmpq_poly([0])
    for powers, number in _jacobian(model).to_dict().items():
        term = fmpq_poly([int(number)])
        for x, e in zip(values, powers, strict=True):
            term = term * x ** int(e) % modulus
        total += term
    return sign_at(total % modulus, at)


@lru_cache(maxsize=REMEMBERED)
def _jacobian(model: Model) -> fmpz_mpoly:
    context = fmpz_mpoly_ctx.get(model.parameters, Ordering.lex)
    row = [c for c in (*model.numerator, *model.denominator) if not c.is_zero()]
    derivatives = [[c.derivative(i) for c in row] for i in range(len(model.parameters))]
    polynomials = subdeterminants([row, *derivatives], {0: context.constant(1)})
    return polynomials.get((1 << len(row)) - 1, context.constant(0))
