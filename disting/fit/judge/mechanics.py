"""Structures that data do not exclude, folded to their mechanics.

Structures that differ only in what the actuator adds, a lag or a dead time, have the same masses,
springs and dampers: they are one line of the folded set. Across the lines, what all structures
share is kept apart from what they do not decide.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from disting.fit.judge.members import Member
from disting.fit.search.candidates import reference
from disting.model.chain import Chain

ACTUATOR = {"lag": "lag", "dead_time": "dead time"}  # fields of a chain beside its mechanics
DAMPERS = "db"  # first letters of dampers between masses and to the ground
Parts = tuple[str, ...]


def mechanics(chain: Chain) -> Chain:
    """Return the chain with an ideal actuator.

    >>> reference(mechanics(Chain(2, ground_dampers=(2,), dead_time=True)))
    '2:1+b2'
    """
    return replace(chain, lag=False, dead_time=False)


def actuator(chain: Chain) -> Parts:
    """Return what the actuator of a chain adds, in words; empty where it is ideal.

    >>> actuator(Chain(2, lag=True, dead_time=True)), actuator(Chain(2))
    (('lag', 'dead time'), ())
    """
    return tuple(word for field, word in ACTUATOR.items() if getattr(chain, field))


@dataclass(frozen=True, slots=True)
class Line:
    """Structures of the same mechanics, `chain`, in their order: `members` differ in the actuator
    only.
    """

    chain: Chain
    members: tuple[Member, ...]

    @property
    def name(self) -> str:
        """Such as 2:1+b2, without the actuator."""
        return reference(self.chain)

    @property
    def best(self) -> Member:
        """The member with the lowest cost on unseen data."""
        return min(self.members, key=lambda member: member.candidate.j_test)

    @property
    def actuators(self) -> tuple[Parts, ...]:
        """Actuator terms of each member."""
        return tuple(actuator(member.candidate.chain) for member in self.members)


@dataclass(frozen=True, slots=True)
class Folded:
    """A set of structures, folded: its lines; `sizes`, the numbers of masses that occur; `ports`,
    the gap and the four indices of force and sensor if all structures share them; names of dampers
    that are in all structures, `shared`, and of those that the data do not decide, `undecided`;
    `actuators`: what the actuators add, each once.

    Names of dampers belong to places of force and sensor: without common ones none is given.
    """

    lines: tuple[Line, ...]
    sizes: tuple[int, ...] = ()
    ports: tuple[int, ...] | None = None
    shared: Parts = ()
    undecided: Parts = ()
    actuators: tuple[Parts, ...] = ()


def fold(members: Sequence[Member]) -> Folded:
    """Fold structures to mechanics; lines and members keep their order."""
    each = dict[Chain, list[Member]]()
    for member in members:
        each.setdefault(mechanics(member.candidate.chain), []).append(member)
    ports = {chain.indices[1:] for chain in each}
    common = ports.pop() if len(ports) == 1 else None
    shared, undecided = _dampers(members) if common else ((), ())
    return Folded(
        tuple(Line(chain, tuple(group)) for chain, group in each.items()),
        tuple(sorted({chain.n_masses for chain in each})),
        common,
        shared,
        undecided,
        tuple(dict.fromkeys(actuator(member.candidate.chain) for member in members)),
    )


def _dampers(members: Sequence[Member]) -> tuple[Parts, Parts]:
    """Return the dampers of all structures, and those that are not decided: a structure with room
    for one does without it, or its value may be zero.
    """
    names = dict.fromkeys(n for m in members for n in _rooms(m.candidate.chain))
    shared, undecided = list[str](), list[str]()
    for name in names:
        with_room = [m for m in members if name in _rooms(m.candidate.chain)]
        surely = [_has(m, name) for m in with_room]
        if all(surely):
            shared += [name] if len(with_room) == len(members) else []
        elif any(name in m.candidate.chain.parameters for m in with_room):
            undecided.append(name)
    return tuple(shared), tuple(undecided)


def _rooms(chain: Chain) -> Parts:
    """Names of the dampers that a chain of these masses and springs can have."""
    masses = tuple(range(1, chain.n_masses + 1))
    every = replace(chain, damped=True, ground_dampers=masses, gap_damper=chain.gap > 0)
    return tuple(name for name in every.parameters if name[0] in DAMPERS)


def _has(member: Member, name: str) -> bool:
    """Return True if a structure has a damper whose interval of 95 % does not reach zero."""
    low, _ = member.intervals.get(name, (1.0, 1.0))
    return name in member.candidate.chain.parameters and low > 0
