"""Minors of a structure: the structures that remain when elements tend to zero or grow without
bound, as of a graph of which edges are deleted and contracted.

`places` takes masses of the `whole` to nodes of the `part`, and 0, the ground, to 0. Masses that it
leaves out move alone; those at 0 are at rest; those at one other node follow one another in a row.
Every element of the part is met by elements of its kind that have their ends where it has its own.
Lag and dead time may be missing in the part.

Theorem. Then for all parameters of the part, its transfer functions are limits of those of the
whole with ports at the same places: all of them together under any experiments, if at every node of
the part what is added to its masses, of known size, adds up to what is added there, kind by kind,
and it is locked there if and only if one of these masses is.

Proof. Let springs between masses of one node be 1/e, and so masses at 0. What meets an element of
the part is a share of it; omitted masses are unchanged. All else is e, the lag and the dead time
that the part lacks as well: their factors tend to 1. So A(s) = A_0 + e A_1 + C/e on the coordinates
that are not locked. For real s other than 0, C is positive semidefinite; in its kernel x_i = y_j
for a mass i at j, with y_0 = 0 and y_j = 0 where the part is locked, and masses that are left out
move in any way. Let the columns of K span the kernel: K' A_0 K is A(s) of the part and a diagonal,
m s^2 and the added terms, of the omitted masses. It is invertible for all but finitely many s. On
the orthogonal complement of the kernel C is positive definite; eliminating the complement shows
that A^-1 -> K (K' A_0 K)^-1 K'. K' turns a force or a sensor at i into one at the node of i. So for
e -> 0 all transfer functions converge, at infinitely many s.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

from disting.model.chain import Element, Structure

REMEMBERED = 1024  # structures whose joints are kept
TIMES = {"T1", "Td"}  # parameters of a lag and of a dead time
Places = Mapping[int, int]
Joint = frozenset[int]


def is_minor(part: Structure, whole: Structure, places: Places) -> bool:
    """Return True if these places make the part a minor of the whole; ports are not checked."""
    nodes, kept = range(part.n_masses + 1), range(whole.n_masses + 1)
    named = set(places) <= set(kept) and set(places.values()) <= set(nodes)
    if not named or places.get(0) != 0 or part.lag > whole.lag or part.dead_time > whole.dead_time:
        return False
    met = {met for e in whole.elements for met in _find_places(e, places)}
    return set(part.elements) <= met and all(
        _is_run(whole, [i for i, at in places.items() if at == node]) for node in nodes[1:]
    )


def minors(part: Structure, whole: Structure, ports: Places) -> Iterator[dict[int, int]]:
    """Yield the places that make the part of the whole and have some nodes at `ports`.

    >>> from disting.model.chain import Chain
    >>> one, two = (Chain(n).structure for n in (1, 2))
    >>> list(minors(one, two, {1: 1}))
    [{0: 0, 1: 1}, {0: 0, 1: 1, 2: 1}, {0: 0, 1: 1, 2: 0}]
    """
    if ports.get(0, 0) == 0:
        search = _Search(part, whole, ports)
        yield from (p for p in search.grown({0: 0}, 1) if is_minor(part, whole, p))


def embeddings(part: Structure, whole: Structure) -> Iterator[dict[int, int]]:
    """Yield every numbering {node of the part: node of the whole} under which all elements and
    ports of the part lie in the whole: nothing is rigid or at rest, and both have a dead time or
    none.

    "Submodel means that model structures are identical except for missing elements" (section 4.4):
    chains embed as shifted or mirrored runs.
    """
    pairs = set(zip(whole.ports, part.ports, strict=True))
    same = (part.sensor_order, part.dead_time) == (whole.sensor_order, whole.dead_time)
    if same and len(dict(pairs)) == len(pairs):
        for places in minors(part, whole, dict(pairs)):
            if len(places) == part.n_masses + 1:
                yield {at: i for i, at in sorted(places.items(), key=lambda x: x[1])}


@dataclass(frozen=True, slots=True)
class Fates:
    """Parameters of the whole in the limit that is the part: `shared`, the parameter of the part of
    which each is a share, and the number of shares; `rigid`, those that grow without bound; `idle`,
    masses that move alone, of any size. All others tend to zero.
    """

    shared: Mapping[str, tuple[str, int]]
    rigid: frozenset[str]
    idle: frozenset[str]


def fates(part: Structure, whole: Structure, places: Places) -> Fates:
    """Return the limits of all parameters of the whole at places that make the part of it.

    >>> from disting.model.chain import Chain
    >>> one, two = (Chain(n).structure for n in (1, 2))
    >>> limits = fates(one, two, {0: 0, 1: 1, 2: 1})
    >>> limits.shared["m2"], sorted(limits.rigid)
    (('m1', 2), ['k12'])
    """
    own = {e: e.parameter for e in part.elements}
    met = {e.parameter: own[x] for e in whole.elements for x in _find_places(e, places) if x in own}
    count = Counter(met.values())
    shared = {name: (mine, count[mine]) for name, mine in met.items()}
    shared |= {name: (name, 1) for name in TIMES & {*part.parameters}}
    rigid = (
        e.parameter
        for e in whole.elements
        if e.kind == "k" and e.at in places and places[e.at] == places.get(e.at + 1)
    )
    idle = (e.parameter for e in whole.elements if e.kind == "m" and e.at not in places)
    return Fates(shared, frozenset(rigid), frozenset(idle))


@dataclass(frozen=True, slots=True)
class _Search:
    """Masses of the whole are placed one after the other, as long as later ones can mend all that
    is lacking.
    """

    part: Structure
    whole: Structure
    ports: Places

    def grown(self, places: dict[int, int], at: int) -> Iterator[dict[int, int]]:
        """Yield the ways to place this mass and those after it."""
        if at > self.whole.n_masses:
            yield places
            return
        for node in self._nodes(places, at):
            further = places if node is None else places | {at: node}
            if self._is_hopeful(further, at):
                yield from self.grown(further, at + 1)

    def _nodes(self, places: Places, at: int) -> Iterator[int | None]:
        """Yield the nodes that have no mass, none, that of the mass before, the ground."""
        if at in self.ports:
            yield self.ports[at]
            return
        yield from sorted(set(range(1, self.part.n_masses + 1)) - set(places.values()))
        yield None
        if places.get(at - 1) and Joint((at - 1, at)) in _joints(self.whole):
            yield places[at - 1]
        yield 0

    def _is_hopeful(self, places: Places, at: int) -> bool:
        """Return True if enough masses remain for the nodes without one, and the node of the mass
        before is complete.
        """
        lacking = self.part.n_masses - len(set(places.values()) - {0})
        before = places.get(at - 1)
        if lacking > self.whole.n_masses - at:
            return False
        if before is None or at == 1 or (before and before == places.get(at)):
            return True
        if before:
            return all(
                joint in self._find_joints(places)
                for joint in _joints(self.part)
                if before in joint
            )
        return at - 1 in self.ports or bool(self._find_joints(places, at - 1) & _joints(self.part))

    def _find_joints(self, places: Places, of: int | None = None) -> set[Joint]:
        """Where joints of the whole, or those of one mass, are in the part."""
        return {
            Joint(places[i] for i in joint)
            for joint in _joints(self.whole)
            if joint <= places.keys() and (of is None or of in joint)
        }


@lru_cache(maxsize=REMEMBERED)
def _joints(structure: Structure) -> frozenset[Joint]:
    return frozenset(Joint((e.at, e.at + 1)) for e in structure.elements if e.kind in "kd")


def _is_run(whole: Structure, masses: list[int]) -> bool:
    """Return True if these masses exist, with a joint between each and the next."""
    steps = (Joint(step) for step in pairwise(sorted(masses)))
    return bool(masses) and all(step in _joints(whole) for step in steps)


def _find_places(e: Element, places: Places) -> Iterator[Element]:
    """Yield where it is in the part, if it is between neighbours there, or at a node."""
    ends = (e.at, e.at + 1) if e.kind in "kd" else (e.at,)
    if all(i in places for i in ends):
        at = sorted(places[i] for i in ends)
        if at[-1] - at[0] == len(ends) - 1:
            yield e._replace(at=at[0])
