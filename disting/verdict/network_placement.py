"""One kind of further experiment on networks that one measurement cannot tell apart: every node of
every network against every node of every other one.

A spot is a network as it is and with the experiment at one of its nodes, a matrix of transfer
functions; all of them are decided together, over generic complex parameters.

Networks under one further experiment, as matrices of transfer functions.

With the transfer functions T from the inputs and from one node i to the outputs and to that node,
all in one sensor quantity s^q, whatever is done at the node is seen without another network:

    a sensor there:  T_is          something known, h(s) = s^r:  T_os - h T_oi T_is/(s^q + h T_ii)
    a force there:   T_oi          the node held at zero:        T_os - T_oi T_is/T_ii
    both there:      T_ii

As all values of a network may be given in other units, the known one has size 1. Derivation: what
the node feels from outside is a force f = -h x_i, or the one that makes x_i = 0.
"""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property

from disting.algebra.symbols import RationalFunction
from disting.errors import InputError
from disting.experiments.menu import Costs, Gain
from disting.general.matrix_model import MatrixModel, of_ratios
from disting.general.response import network_powers, network_ratios
from disting.model.kinds import CIRCUIT_KINDS, COMPARTMENT_KINDS, KINDS, Kind
from disting.model.structure import Sort
from disting.network import Network, Port
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.next_experiments import Menu, places_of
from disting.verdict.placement_record import Spot, answer_of
from disting.verdict.placement_verdicts import Answer
from disting.verdict.query import Query, View
from disting.verdict.result import Relation

Ratios = tuple[tuple[RationalFunction, ...], ...]
MENUS = {
    Sort.MACHINE: KINDS,
    Sort.CIRCUIT: CIRCUIT_KINDS,
    Sort.COMPARTMENTS: COMPARTMENT_KINDS,
}
MOST_SPOTS = 400
QUERY = Query(View.EXACT, inclusion=False)


@dataclass(frozen=True, slots=True)
class MeasuredNetwork:
    """A network with what one further experiment shows: `model`, and what is gained by it."""

    model: MatrixModel
    gain: Gain


def measure(network: Network, kind: Kind, node: int, name: str) -> MeasuredNetwork:
    """The network as it is and with one kind of further experiment at a node; raises InputError.

    >>> from disting.model.kinds import LOCK
    >>> from disting.network import network_of
    >>> print(measure(network_of("1~2; F1; S1"), LOCK, 2, "").model.rows[1][0])
    G(s) = s**2/(k12 + m1*s**2)
    """
    port = Port(node, network.reference)
    ports = (*network.inputs, port), (*network.outputs, port)
    whole = network_ratios(replace(network, inputs=ports[0], outputs=ports[1]))
    now = tuple(row[:-1] for row in whole[:-1])
    more = _shown(kind, whole, network)
    width = len(network.inputs)
    cells = [x for row in more for x in row]
    zero = cells[0] - cells[0]
    cells += [zero] * (-len(cells) % width)
    rows = [*now, *(tuple(cells[i : i + width]) for i in range(0, len(cells), width))]
    powers = network_powers(cells + [x for row in now for x in row], network)
    model = of_ratios(rows, network.parameters, name, powers)
    return MeasuredNetwork(model, _gain(kind, whole, now, more))


def _shown(kind: Kind, whole: Ratios, network: Network) -> Ratios:
    """What the further experiment shows. T_ii is not zero: a node of positive elements moves where
    it is pushed.
    """
    *outer, last = whole
    moved = tuple((row[-1],) for row in outer)
    if kind.is_port:
        shown: dict[str, Ratios] = {"sensor": (last[:-1],), "force": moved, "port": ((last[-1],),)}
        return shown[kind.name]
    below = last[-1]
    if kind.power is not None:
        s = below.num.context().gen(0)
        step = 2 if network.halves else 1
        unit = s**0
        added = RationalFunction(s ** (step * kind.power), unit)
        quantity = RationalFunction(s ** (step * network.order), unit)
        below = quantity / added + below
    return tuple(
        tuple(x - moves * left / below for x, left in zip(row[:-1], last[:-1], strict=True))
        for row, (moves,) in zip(outer, moved, strict=True)
    )


def _gain(kind: Kind, whole: Ratios, now: Ratios, more: Ratios) -> Gain:
    """SILENT where nothing is seen; REPEATS where all that is seen is seen already, but for its
    sign, or follows from it, as force and sensor are at the node to which something is added.
    """
    seen = [x for row in more for x in row if not x.num.is_zero()]
    if not seen:
        return Gain.SILENT
    responses = [x for row in now for x in row]
    if all(x in responses or -x in responses for x in seen):
        return Gain.REPEATS
    collocated = all(x == seen_at for row in whole for x in row for seen_at in responses)
    return Gain.REPEATS if kind.takes_size and collocated else Gain.NEW


@dataclass(frozen=True)
class NetworkTable:
    """What one kind of experiment leaves together (a `Table`).

    `places[k]`: nodes of network k; `spots[s]`: subject s of `decided`; `gains[s]`: what is gained.
    """

    places: tuple[tuple[int, ...], ...]
    spots: tuple[Spot, ...]
    gains: tuple[Gain, ...]
    decided: Decisions

    def only(self, structures: Sequence[int]) -> "NetworkTable":
        """Some of the networks, counted from 0, in this order."""
        new = {old: k for k, old in enumerate(structures)}
        places = tuple(self.places[k] for k in structures)
        spots = tuple((new.get(k, -1), i) for k, i in self.spots)  # -1: not asked for any more
        return replace(self, places=places, spots=spots)

    def gain(self, spot: Spot) -> Gain:
        """What is gained there."""
        return self.gains[self._at[spot]]

    def look_up(self, left: Spot, right: Spot) -> tuple[Relation, str]:
        """Relation and deciding rule of two spots, "" if undecided."""
        a, b = self._at[left], self._at[right]
        return self.decided.relation(a, b), self.decided.rule(a, b)

    def grade(self, left: Spot, right: Spot) -> tuple[str, int]:
        """Certainty and safety of the verdict."""
        a, b = sorted((self._at[left], self._at[right]))
        return self._grades[a, b]

    def alike(self, spot: Spot, other: int) -> tuple[int, ...]:
        """Nodes of another network at which it is not told from this one at this spot."""
        apart = Relation.DISTINGUISHABLE
        return tuple(
            j for j in self.places[other] if self.look_up(spot, (other, j))[0] is not apart
        )

    def answer(self, spot: Spot, other: int) -> Answer:
        """Whether the experiment at a spot tells its network from another one, wherever the place
        is in that.
        """
        return answer_of({self.look_up(spot, (other, j))[0] for j in self.places[other]})

    @cached_property
    def _at(self) -> dict[Spot, int]:
        return {spot: s for s, spot in enumerate(self.spots)}

    @cached_property
    def _grades(self) -> dict[tuple[int, int], tuple[str, int]]:
        return {(i, j): (grade, bits) for i, j, _, _, grade, bits in self.decided.grades()}


def further_networks(
    named: Sequence[tuple[str, Network]],
    engine: Engine,
    *,
    costs: Costs | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Menu[Network]:
    """The menu on networks of one sort that are indistinguishable, over complex parameters, as
    they are measured now; raises InputError for those that have no menu in common, and for groups
    that are too large.
    """
    names, networks = zip(*named, strict=True)
    if len({(n.sort, n.shape, n.order) for n in networks}) > 1:
        raise InputError(
            "what to measure next is told of networks of one sort with the same numbers of inputs"
            " and outputs and one sensor quantity: ask for those apart"
        )
    costs = costs or Costs()
    places = tuple(map(places_of, networks))
    spots = tuple((k, i) for k, nodes in enumerate(places) for i in nodes)
    if len(spots) > MOST_SPOTS:
        raise InputError(
            f"these networks have {len(spots)} nodes together; {MOST_SPOTS} at most are looked at:"
            " name some of them only"
        )
    tables = {}
    for kind in costs.priced(MENUS[networks[0].sort]):
        if kind.holds and max(map(len, places)) < 2:
            continue
        machines = [measure(networks[k], kind, i, f"{names[k]} at {i}") for k, i in spots]
        sides = engine.general_subjects([m.model for m in machines])
        decided = engine.decisions(sides, QUERY, executor=executor, progress=progress)
        tables[kind] = NetworkTable(places, spots, tuple(m.gain for m in machines), decided)
    return Menu(names, networks, tables, costs)
