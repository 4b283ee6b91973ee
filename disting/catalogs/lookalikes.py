"""Models that are not distinguishable from a given one: the row of its like in a shipped catalogue.

A catalogue lists each network once, up to numbering and, of machines, the exchange of force and
sensor (reciprocity): neither changes a relation. Names, groups and relations are read from the
file as they are written, since making a family anew takes seconds.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from disting.catalogs.catalog import catalog
from disting.catalogs.dampers import SHIPPED_SIZES as DAMPER_SIZES, damper_catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.catalogs.network_files import SHIPPED, in_order, name_of
from disting.files import intact_text, shipped_folder
from disting.model.chain import Chain, Quantity, Sort
from disting.network.families import family_of
from disting.network.isomorphism import is_same_network
from disting.network.network import Network
from disting.network.notation import network_of
from disting.verdict.result import Relation, View

Decide = Callable[[Chain, Chain], Relation]


@dataclass(frozen=True, slots=True)
class Lookalikes:
    """Row of a model in a catalogue: `family`, such as "trees-4", or the number of masses of
    chains; its `title`, and `size` in models; the name of the `member` that is the model; the
    `others` by name that are not distinguishable from it over positive parameters.
    """

    family: str
    title: str
    size: int
    member: str
    others: Mapping[str, Relation]


@dataclass(frozen=True, slots=True)
class _Family:
    """Networks of a shipped file by their names, and relations over positive parameters of pairs
    of places that are not distinguishable over complex ones.
    """

    networks: tuple[Network, ...]
    relations: dict[tuple[int, int], Relation]

    def others(self, at: int) -> dict[str, Relation]:
        """Networks that are not distinguishable from one, the surest first."""
        pairs = ((sum(pair) - at, r) for pair, r in self.relations.items() if at in pair)
        kept = ((i, r) for i, r in pairs if r is not Relation.DISTINGUISHABLE)
        ordered = sorted(kept, key=lambda x: (x[1] is not Relation.INDISTINGUISHABLE, x[0]))
        return {self.networks[i].name: r for i, r in ordered}


def of_network(network: Network) -> Lookalikes | None:
    """Return the row of a network in the first catalogue that lists it; None if none does.

    >>> found = of_network(network_of("p(R1,R2-C1)"))
    >>> [name for name, relation in found.others.items() if relation == "indistinguishable"]
    ['R1-p(R2,C1)', 'R1-p(R2,R3-C1)', 'p(R1,R2-p(R3,C1))']
    """
    for name in _families_for(network):
        family = _read(name)
        at = next((i for i, n in enumerate(family.networks) if _is_same(network, n)), None)
        if at is not None:
            title, size = family_of(name).title, len(family.networks)
            return Lookalikes(name, title, size, family.networks[at].name, family.others(at))
    return None


def of_chain(chain: Chain) -> Lookalikes | None:
    """Return the row of a chain without ground dampers, lag and dead time; None of others.

    >>> from disting import Family
    >>> of_chain(Family(4)[3]).family
    '4'
    """
    plain = Chain(*chain.indices, damped=chain.damped, quantity=chain.quantity)
    if chain.n_masses not in SHIPPED_SIZES or plain != chain:
        return None
    shipped = catalog(chain.n_masses, damped=chain.damped)
    own = replace(chain, quantity=Quantity.ACCELERATION)
    if own not in shipped.family:
        return None
    number, n = shipped.family.number(own), chain.n_masses
    group = next((g for g in shipped.classes(View.EXACT) if number in g), ())
    pairs = ((i, min(i, number), max(i, number)) for i in group if i != number)
    relations = ((i, shipped.verdict(low, high, View.POSITIVE).relation) for i, low, high in pairs)
    others = {f"{n}:{i}": r for i, r in relations if r is not Relation.DISTINGUISHABLE}
    damping = "damped" if chain.damped else "undamped"
    return Lookalikes(
        str(n), f"Chains of {n} masses, {damping}", len(shipped.family), f"{n}:{number}", others
    )


def of_ground_dampers(chain: Chain, decide: Decide) -> Lookalikes | None:
    """Return the row of a chain with ground dampers among all of its size with any set of them;
    None of others.

    The shipped verdicts are over complex parameters: what these distinguish is distinguishable over
    positive ones too. For the few others `decide` gives the relation over positive parameters.

    >>> from disting import compare
    >>> from disting.model.names import read_together
    >>> (chain,) = read_together(["4:3+b2"])
    >>> found = of_ground_dampers(chain, lambda a, b: compare(a, b).relation)
    >>> found.size, found.member, dict(found.others)
    (464, '4:3+b2', {'4:7+b3': <Relation.INDISTINGUISHABLE: 'indistinguishable'>})
    """
    plain = replace(chain, ground_dampers=(), quantity=Quantity.ACCELERATION)
    simple = Chain(*chain.indices, damped=chain.damped)
    if not chain.ground_dampers or chain.n_masses not in DAMPER_SIZES or plain != simple:
        return None
    shipped = damper_catalog(chain.n_masses, damped=chain.damped)
    if plain not in shipped.family:
        return None
    at = shipped.place((shipped.family.number(plain), chain.ground_dampers))
    others = dict[str, Relation]()
    for i, other in enumerate(shipped.found.chains):
        if i != at and shipped.found.look_up(at, i)[0] is not Relation.DISTINGUISHABLE:
            others[shipped.text(i)] = decide(replace(other, quantity=chain.quantity), chain)
    kept = {n: r for n, r in others.items() if r is not Relation.DISTINGUISHABLE}
    damping = "damped" if chain.damped else "undamped"
    title = f"Chains of {chain.n_masses} masses, {damping}, with dampers to the ground"
    return Lookalikes(str(chain.n_masses), title, len(shipped), shipped.text(at), kept)


def _families_for(network: Network) -> Iterator[str]:
    """Yield the shipped families that may list a network: of its sort, and of machines of its
    masses, with dampers or without.
    """
    for name in SHIPPED:
        first = _first(name)
        is_machine = network.sort is Sort.MACHINE
        if first.sort is network.sort and (not is_machine or _kind(first) == _kind(network)):
            yield name


def _kind(machine: Network) -> tuple[int, frozenset[str]]:
    """Number of masses, and letters of the elements."""
    return len(machine.nodes), frozenset(e.letter for e in machine.elements)


@cache
def _first(name: str) -> Network:
    """The first network of a shipped file."""
    with _path(name).open(encoding="utf-8") as file:
        _, line = file.readline(), file.readline()
    return network_of(json.loads(line)["network"])


def _path(name: str) -> Path:
    return shipped_folder() / f"{name_of(name)}.jsonl"


@cache
def _read(name: str) -> _Family:
    """The networks of a shipped file, as it writes them."""
    header, *rows = map(json.loads, intact_text(_path(name)).splitlines())
    models, pairs = rows[: header["models"]], rows[header["models"] :]
    at = {(r["left"], r["right"]): r for r in pairs}
    relations = {
        (i - 1, j - 1): Relation(
            (r if "positive" in r else at[in_order(*r["as"])])["positive"]["relation"]
        )
        for (i, j), r in at.items()
    }
    return _Family(tuple(network_of(row["network"]) for row in models), relations)


def _is_same(network: Network, listed: Network) -> bool:
    """Return True if they are the same up to numbering and names, and of machines up to the
    exchange of force and sensor; the quantity of the sensor is no matter.
    """
    if len(network.elements) != len(listed.elements):
        return False
    own = replace(network, order=listed.order)
    if is_same_network(own, listed):
        return True
    turned = replace(own, inputs=own.outputs, outputs=own.inputs)
    return network.sort is Sort.MACHINE and is_same_network(turned, listed)
