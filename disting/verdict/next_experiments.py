"""Next measurements: every experiment of the menu on a group of structures, and the cheapest sets
of them that distinguish all.

A set is taken from the tables of its single experiments, which is safe: more experiments never make
a pair less distinguishable. Two things at one mass of the one structure are at one mass of the
other; at two masses they are at two.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Generic, TypeVar

from disting.conditions.side import AnySide
from disting.errors import InputError, of_type
from disting.experiments.experiment import places_of
from disting.experiments.menu import Costs, Item, as_costs
from disting.model.chain import Chain, Sort
from disting.model.kinds import CIRCUIT_KINDS, COMPARTMENT_KINDS, KINDS, Kind
from disting.model.names import name_of, read_together
from disting.model.presentation import NotebookTable, plural, summary
from disting.network.chains import of_chain
from disting.network.network import Network
from disting.network.notation import network_of, notations_of
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.placement import place
from disting.verdict.placement_record import Placement
from disting.verdict.placement_verdicts import Answer
from disting.verdict.result import Query, Relation, View

NAMED = "the structures are a list of chains, of networks or of texts for them"
S = TypeVar("S", bound=Chain | Network, covariant=True)
MENUS = {
    Sort.MACHINE: KINDS,
    Sort.CIRCUIT: CIRCUIT_KINDS,
    Sort.COMPARTMENTS: COMPARTMENT_KINDS,
}
PLACES = {Sort.MACHINE: "mass", Sort.CIRCUIT: "node", Sort.COMPARTMENTS: "compartment"}


@dataclass(frozen=True, slots=True)
class Option:
    """A set of items at masses of one structure, what it costs, and the structures that it does not
    certainly distinguish from that one.
    """

    items: tuple[Item, ...]
    cost: float
    left: tuple[int, ...]


@dataclass(frozen=True)
class Menu(NotebookTable, Generic[S]):
    """The menu on `structures`, chains or networks, called `names`, that one measurement cannot
    distinguish.
    """

    names: tuple[str, ...]
    structures: tuple[S, ...]
    tables: Mapping[Kind, Placement]
    costs: Costs = field(default_factory=Costs)

    def __repr__(self) -> str:
        kinds = ", ".join(kind.name for kind in self.kinds)
        return summary(self, f"{plural(len(self.structures), 'structure')}: {kinds}")

    def only(self, structures: Sequence[int]) -> "Menu[S]":
        """Some of the structures, counted from 0, in this order."""
        return replace(
            self,
            names=tuple(self.names[k] for k in structures),
            structures=tuple(self.structures[k] for k in structures),
            tables={kind: table.only(structures) for kind, table in self.tables.items()},
        )

    @property
    def place(self) -> str:
        """Word for a place: "mass", "node" or "compartment"."""
        return PLACES[self.structures[0].sort]

    def places(self, structure: int) -> tuple[int, ...]:
        """The masses or nodes of a structure at which something can be done."""
        return places_of(self.structures[structure])

    @property
    def kinds(self) -> tuple[Kind, ...]:
        """Possible kinds, cheapest first."""
        return tuple(sorted(self.tables, key=self.costs.cost))

    def items(self, structure: int) -> Iterator[Item]:
        """Yield the experiments that are worth it on this structure, cheapest first."""
        for kind in self.kinds:
            for at in self.places(structure):
                item = Item(kind, at)
                if item.is_worth(self.tables[kind].gain((structure, at))):
                    yield item

    def others(self, structure: int) -> tuple[int, ...]:
        """The rest of the group."""
        return tuple(k for k in range(len(self.structures)) if k != structure)

    def answer(self, structure: int, item: Item, other: int) -> Answer:
        """Decide whether the item distinguishes the structure from another one."""
        return self.tables[item.kind].answer((structure, item.at), other)

    def whole(self, structure: int, item: Item) -> Answer:
        """The same of all others: SURELY where it is of all, NEVER where of none, not even
        depending on the place.
        """
        answers = {self.answer(structure, item, other) for other in self.others(structure)}
        if len(answers) == 1:
            return answers.pop()
        return Answer.UNKNOWN if answers == {Answer.UNKNOWN, Answer.NEVER} else Answer.DEPENDS

    def anywhere(self, kind: Kind) -> bool:
        """Return True if this kind distinguishes all structures, at any place."""
        spots = [
            (k, item)
            for k in range(len(self.structures))
            for item in self.items(k)
            if item.kind == kind
        ]
        return (
            len(self.structures) > 1
            and bool(spots)
            and all(
                not self.tables[kind].alike((k, item.at), other)
                for k, item in spots
                for other in self.others(k)
            )
        )

    def least(self, structure: int) -> tuple[Option, ...]:
        """The cheapest sets that certainly distinguish this structure from all others: single
        items, or two of them where no single one does; none where two are not known to.
        """
        items = tuple(self.items(structure))
        for count in (1, 2):
            options = (self.option(structure, some) for some in combinations(items, count))
            enough = [o for o in options if not o.left]
            if enough:
                return tuple(o for o in enough if o.cost == min(e.cost for e in enough))
        return ()

    def best(self, structure: int) -> Option | None:
        """Where nothing is enough: the cheapest of the sets of up to two items that leave least."""
        items = tuple(self.items(structure))
        sets = [*((i,) for i in items), *combinations(items, 2)]
        options = [self.option(structure, s) for s in sets]
        return min(options, key=lambda o: (len(o.left), o.cost, o.items), default=None)

    def option(self, structure: int, items: tuple[Item, ...]) -> Option:
        """A set of one or two items at masses of this structure."""
        cost = sum(self.costs.cost(item.kind) for item in items)
        left = (k for k in self.others(structure) if self._may_be(structure, items, k))
        return Option(items, cost, tuple(left))

    def _may_be(self, structure: int, items: Sequence[Item], other: int) -> bool:
        """Return True if some places in the other structure are not excluded by any of the
        items.
        """
        places = [self.tables[i.kind].alike((structure, i.at), other) for i in items]
        if len(items) == 1:
            return bool(places[0])
        same = items[0].at == items[1].at
        return any((a == b) is same for a in places[0] for b in places[1])


def next_experiments(
    models: Sequence[Chain | Network | str],
    *,
    damped: bool | None = None,
    cost: Costs | Mapping[str, float] | str | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Menu[Chain | Network]:
    """Further experiments that distinguish structures with the same response, for each structure
    that may be the true one, cheapest first.

    `models`: chains of one size, or networks of one sort, or texts for them such as "3:1" or
    "R0-p(R1,C1)"; `damped` applies to names of chains. `cost` of each kind of experiment, in any
    unit, as `Costs`, a dict or text such as "sensor=3,lock=1": those that are not named cost what
    `Costs()` says. Decided over complex parameters. Raises InputError for fewer than two
    structures, for the same one twice, and for two that the present measurement distinguishes or
    that are undecided.

    >>> menu = next_experiments(["3:1", "3:11"], cost={"sensor": 2})
    >>> menu.names, menu.costs.of["sensor"]
    (('3:1', '3:11'), 2)
    """
    engine = engine or Engine()
    named = _read_structures(list(of_type(models, Iterable, NAMED)), damped)
    refuse_distinguishable(sides_as_measured(named, engine), engine)
    costs = as_costs(cost)
    return menu_for(named, engine, costs=costs, executor=executor, progress=progress)


def _read_structures(
    models: Sequence[Chain | Network | str], damped: bool | None
) -> list[tuple[str, Chain | Network]]:
    """Two structures at least with their names, each once; raises InputError."""
    for model in models:
        of_type(model, Chain | Network | str, NAMED)
    read = [network_of(m) if isinstance(m, str) and notations_of(m) else m for m in models]
    chains = iter(read_together([m for m in read if isinstance(m, str)], damped=damped))
    structures = [next(chains) if isinstance(m, str) else m for m in read]
    if len(structures) < 2:
        raise InputError("name at least two structures that are to be distinguished")
    named = [(name_of(s) if isinstance(s, Chain) else s.name, s) for s in structures]
    again = [name for i, (name, s) in enumerate(named) if s in structures[:i]]
    if again:
        raise InputError(f"{again[0]} is named twice")
    return named


def sides_as_measured(
    named: Sequence[tuple[str, Chain | Network]], engine: Engine
) -> Sequence[AnySide]:
    """Structures as they are compared now: chains of one size as chains, others as networks.
    Raises InputError for chains of different sizes, and for chains together with networks.
    """
    chains = [(name, s) for name, s in named if isinstance(s, Chain)]
    networks = [s for _, s in named if isinstance(s, Network)]
    if chains and networks:
        raise InputError("chains and networks are on different menus: name structures of one kind")
    if len({chain.n_masses for _, chain in chains}) > 1:
        raise InputError("the structures have different numbers of masses: name some of one size")
    if chains:
        return [engine.subject(name, chain) for name, chain in chains]
    return engine.general_subjects(networks, [name for name, _ in named])


def refuse_distinguishable(sides: Sequence[AnySide], engine: Engine) -> None:
    """Raise Distinguishable for two that the present measurement distinguishes, and InputError
    where that is not known.
    """
    for left, right in combinations(sides, 2):
        verdict = engine.verdict(left, right, Query(View.EXACT, inclusion=False))
        if verdict.relation is Relation.DISTINGUISHABLE:
            raise Distinguishable(
                f"{left.name} and {right.name} are distinguishable by the present measurement"
                " already"
            )
        if verdict.relation is Relation.UNDECIDED:
            raise InputError(f"{left.name} and {right.name} are undecided as they are measured now")


class Distinguishable(InputError):
    """Structures that need no further experiment."""


def menu_for(
    named: Sequence[tuple[str, S]],
    engine: Engine,
    *,
    costs: Costs | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Menu[S]:
    """The menu on structures that are indistinguishable, over complex parameters, as they are
    measured now: chains of one size and sensor, or networks of one sort; raises InputError for
    those that have no menu in common, and for groups that are too large.
    """
    names, structures = zip(*named, strict=True)
    _refuse(structures)
    costs = costs or Costs()
    most = max(len(places_of(s)) for s in structures)
    tables = {
        kind: place(structures, kind, engine, executor=executor, progress=progress)
        for kind in costs.kinds(most, MENUS[structures[0].sort])
    }
    return Menu(names, structures, tables, costs)


def _refuse(structures: Sequence[Chain | Network]) -> None:
    """Raise InputError for structures without a menu in common."""
    if all(isinstance(s, Chain) for s in structures):
        if len({(len(places_of(s)), s.quantity) for s in structures if isinstance(s, Chain)}) > 1:
            raise InputError("the structures have different numbers of masses or sensor quantities")
        return
    networks = [of_chain(s) if isinstance(s, Chain) else s for s in structures]
    if len({(n.sort, n.shape, n.order) for n in networks}) > 1:
        raise InputError(
            "what to measure next is known for networks of one kind with equal numbers of inputs"
            " and outputs and one quantity: give others separately"
        )
