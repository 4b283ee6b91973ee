"""Values of networks whose parts replace each other (see `disting.network.normal_form`): part by
part, each by synthesis.

A one-port of two kinds of elements is a part as a whole, however it is made, if the other one is in
series and parallel. Else both networks are drawn as graphs with parts at their edges, and edges are
matched that have the same sets of functions. Parts of three kinds are matched branch by branch.
Bridges and loops become series and parallel first where a star or a triangle of one kind allows it.
Trees of compartments have their own way (`values_of_compartments`).
"""

import operator
from collections.abc import Iterator, Sequence
from functools import partial, reduce
from itertools import islice, product
from typing import Any

from disting.general.closed_form import ClosedForm
from disting.general.field import Arithmetic, Field, Poly
from disting.general.matrix_model import AnyModel, Model
from disting.general.orthant import TooMuch
from disting.general.powers import placed_network
from disting.general.replacement import set_of
from disting.general.star_triangle import Exchange, without_bridges
from disting.general.synthesis import (
    FieldValues,
    NoFormulas,
    Tree,
    leaf,
    parallel,
    series,
    synthesize,
)
from disting.general.values_of_compartments import values_of_tree
from disting.network.gears import units, unknown_ratios, without_gears
from disting.network.network import Network, Port, join
from disting.network.normal_form import Power

LETTERS = (12, 24, 48, 96, 192)  # of a value without a name: what is written shorter is kept
MOST_MATCHES = 24
TWO = 2  # kinds of elements
Edges = dict[frozenset[int], Tree]


def by_parts(model: AnyModel, other: AnyModel) -> list[ClosedForm]:
    """The values of another network, one form for each way to share terms among its branches, as
    short as names of values make it. Raises NoFormulas. Both models are in powers of one variable.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> one, two = (of_network(network_of(t)) for t in ("R0-p(R1,C1)", "p(R1,R2-C1)"))
    >>> print(by_parts(one, two)[0].text)
    C1' = C1*R1**2/(R0 + R1)**2
    R1' = R0 + R1
    R2' = R0*(R0 + R1)/R1
    """
    closed_forms = list[list[ClosedForm]]()
    for letters in LETTERS:
        try:
            closed_forms.append(list(_forms(model, other, Field(model.parameters, letters))))
        except (TooMuch, ZeroDivisionError):  # too long, or the function is of a smaller set
            continue
    if not closed_forms:
        raise NoFormulas("they grow too long")
    return min(closed_forms, key=lambda forms: sum(f.length for f in forms))


def _forms(model: AnyModel, other: AnyModel, field: Field) -> Iterator[ClosedForm]:
    for values in values_over(field, model, other):
        kept = tuple((name, values[name]) for name in other.parameters)
        steps, written = field.written(kept)
        yield ClosedForm(model.parameters, steps, written, choices=tuple(field.choices))


def values_over(field: Arithmetic, model: AnyModel, other: AnyModel) -> Iterator[FieldValues]:
    """Yield the values of the other network, for each way to share terms among its branches."""
    if other.network is not None and other.network.is_directed and isinstance(model, Model):
        yield from values_of_tree(field, model, other.network.grounded)
        return
    ways = _of_one_port(field, model, other)
    yield from _of_graphs(field, model, other) if ways is None else ways


def _of_graphs(field: Arithmetic, model: AnyModel, other: AnyModel) -> Iterator[FieldValues]:
    """Of networks without their gears, in the units that these make; ratios of the other network
    that are not known are chosen: 1.
    """
    (own_network, ratios), (other_network, chosen) = _place_network(model), _place_network(other)
    known_values = {e.value: field[e.value] for e in own_network.elements}
    for name, unit in _units(field, model.network, [field[n] for n in ratios]).items():
        known_values[name] = field[name] * unit
    back = _units(field, other.network, [field.one] * len(chosen))
    (plain, made), (wanted, undone) = without_bridges(own_network), without_bridges(other_network)
    for exchange in made:
        known_values = exchange.forth(field, known_values)
    for values in _of_edges(field, known_values, plain, wanted):
        values = _before(field, undone, values)
        in_units = {name: x / back.get(name, field.one) for name, x in values.items()}
        yield in_units | dict.fromkeys(chosen, field.one)


def _units(field: Arithmetic, network: Network | None, ratios: Sequence[Any]) -> FieldValues:
    """Those that gears make, with these values for ratios that are not known."""
    unit_of = dict[str, Any]()
    for name, (number, powers) in (units(network) if network else {}).items():
        unit_of[name] = field.number(number.numerator) / field.number(number.denominator)
        for ratio, k in zip(ratios, powers, strict=True):
            unit_of[name] *= reduce(operator.mul, [ratio] * abs(k), field.one) ** (
                1 if k > 0 else -1
            )
    return unit_of


def _place_network(model: AnyModel) -> tuple[Network, list[str]]:
    """Network without gears as it is measured, and the unknown ratios."""
    plain = model.network and without_gears(model.network)
    if model.network is None or plain is None or plain.is_directed:
        raise NoFormulas("they are not made of parts that replace each other")
    powers = next(iter(model.entries)).powers
    return placed_network(plain, powers).grounded, unknown_ratios(model.network)


def _of_one_port(
    field: Arithmetic, model: AnyModel, other: AnyModel
) -> Iterator[FieldValues] | None:
    """Of two one-ports of two kinds, None of others."""
    full_set = set_of(model)
    if full_set is None or full_set != set_of(other) or not isinstance(model, Model):
        return None
    plain, exchanges = without_bridges(_place_network(other)[0])
    edges = _edges(plain)
    if len(edges) != 1:
        return None
    (tree,) = edges.values()
    low, high = sorted(full_set[1].kinds)
    every = synthesize(field, tree, *function_of(field, model, low, high), (low, high))
    return (_before(field, exchanges, values) for values in every)


def _before(field: Arithmetic, exchanges: Sequence[Exchange], values: FieldValues) -> FieldValues:
    """The values before all exchanges; what is chosen of one of three elements is so of all."""
    for exchange in reversed(exchanges):
        values = exchange.back(field, values)
        field.choices = [exchange.widened(names) for names in field.choices]
    return values


def _edges(plain: Network) -> Edges:
    held = {i for p in plain.ports for i in (p.plus, p.minus)}
    return join([(e.nodes, leaf(e)) for e in plain.elements], held, series, parallel)


def function_of(field: Arithmetic, model: Model, low: Power, high: Power) -> tuple[Poly, Poly]:
    """F(x) of a one-port of two kinds, as polynomials in x."""
    network = model.network
    if network is None:
        raise NoFormulas("they are known of networks")
    first, last = (model.powers.placed.of_element(*power) for power in (low, high))
    step, shift = last - first, first - model.powers.step * network.order
    start = next(i for i, c in enumerate(model.denominator) if not c.is_zero())
    sides = [
        {(i + by - start) // step: field.lifted(c) for i, c in enumerate(side) if not c.is_zero()}
        for side, by in ((model.numerator, shift), (model.denominator, 0))
    ]
    least, zero = min(i for side in sides for i in side), field.zero
    top, bottom = (
        tuple(side.get(i + least, zero) for i in range(max(side) - least + 1)) for side in sides
    )
    return (top if network.sign_of_one_port > 0 else tuple(-c for c in top)), bottom


def _of_edges(
    field: Arithmetic, entry: FieldValues, network: Network, other: Network
) -> Iterator[FieldValues]:
    """Of networks that are one graph with parts at the edges, matched in the first way that gives
    formulas; `entry`: the given values.
    """
    trees, two = _edges(network), _edges(other)
    none = NoFormulas("they are not made of parts that replace each other")
    for places in islice(_matches(network, trees, other, two), MOST_MATCHES):
        try:
            parts = [_of_part(field, entry, trees[ends], two[places[ends]]) for ends in trees]
        except NoFormulas as why:
            none = why
            continue
        for chosen in product(*parts):
            yield {name: x for values in chosen for name, x in values.items()}
        return
    raise none


def _matches(
    network: Network, trees: Edges, other: Network, two: Edges
) -> Iterator[dict[frozenset[int], frozenset[int]]]:
    """Yield the edges of the other graph by those of the given one, same sets at both and the same
    ports, all of them perhaps turned; force and sensor may be exchanged.
    """
    import networkx  # imported late: it takes longer than most of what is asked

    wanted = _draw_edges(trees, (*network.inputs, *network.outputs))
    readings = [(*other.inputs, *other.outputs)]
    if len(other.inputs) == len(other.outputs) == 1:
        readings.append((*other.outputs, *other.inputs))
    readings += [tuple(Port(p.minus, p.plus) for p in ports) for ports in readings]
    for ports in readings:
        matcher = networkx.algorithms.isomorphism.GraphMatcher(
            wanted, _draw_edges(two, ports), dict.__eq__, dict.__eq__
        )
        for nodes in matcher.isomorphisms_iter():
            yield {ends: frozenset(nodes[i] for i in ends) for ends in trees}


def _draw_edges(edges: Edges, ports: Sequence[Port]) -> Any:
    import networkx

    graph: Any = networkx.Graph()
    for ends, tree in edges.items():
        graph.add_edge(*ends, part=tree.part.generic)
    for number, port in enumerate(ports):
        for node, sign in ((port.plus, 1), (port.minus, -1)):
            graph.add_node(node)
            graph.nodes[node].setdefault("ports", []).append((number, sign))
    return graph


def _of_part(field: Arithmetic, entry: FieldValues, tree: Tree, other: Tree) -> list[FieldValues]:
    """The values of one part in those of another one of the same set."""
    if len(tree.part.kinds) <= TWO:
        low, *more = sorted(tree.part.kinds)
        kinds = low, more[0] if more else None
        return list(synthesize(field, other, *_compose_branches(field, entry, tree, low), kinds))
    pairs = _pair_branches(tree, other)
    the_pairs = [_of_part(field, entry, a, b) for a, b in pairs]
    return [
        {n: x for values in chosen for n, x in values.items()} for chosen in product(*the_pairs)
    ]


def _pair_branches(tree: Tree, other: Tree) -> list[tuple[Tree, Tree]]:
    """Branches with the same sets."""
    left, pairs = list(other.inside), list[tuple[Tree, Tree]]()
    for branch in tree.inside if tree.form == other.form else ():
        the_tree = next((b for b in left if b.part.generic == branch.part.generic), None)
        if the_tree is None:
            break
        left.remove(the_tree)
        pairs.append((branch, the_tree))
    if left or len(pairs) != len(tree.inside):
        raise NoFormulas("parts of three kinds of elements differ by more than their branches")
    return pairs


def _compose_branches(
    field: Arithmetic, entry: FieldValues, tree: Tree, low: Power
) -> tuple[Poly, Poly]:
    """F(x) of branches of two kinds, of which one has the power `low`."""
    zero, unit = field.zero, field.one
    if tree.element is not None:
        value = entry[tree.element.value]
        value = value if tree.element.kind.divides else unit / value
        return (value,), ((unit,) if tree.element.power == low else (zero, unit))
    functions = [_compose_branches(field, entry, t, low) for t in tree.inside]
    if tree.form == "S":
        return reduce(partial(_sum, field), functions)
    return _inverse(*reduce(partial(_sum, field), (_inverse(*f) for f in functions)))


def _inverse(top: Poly, bottom: Poly) -> tuple[Poly, Poly]:
    return bottom, top


def _sum(
    field: Arithmetic, parts: tuple[Poly, Poly], other: tuple[Poly, Poly]
) -> tuple[Poly, Poly]:
    """Of fractions without common factors but x."""
    (a, b), (c, d), zero = parts, other, field.zero
    if field.is_zero(b[0]) and field.is_zero(d[0]):
        top, bottom = _sum(field, (a, b[1:]), (c, d[1:]))
        return top, (zero, *bottom)
    return field.plus(field.times(a, d), field.times(c, b)), field.times(b, d)
