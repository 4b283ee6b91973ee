"""What could be measured next: a menu of experiments beside the present one, with what each costs.

An item is one thing that is done at one mass: a sensor there, the force there, a known inertia
added, the mass locked. A further sensor and the present sensor moved show the same: transfer
functions of one machine with one parameter vector, whether they are measured at once or one after
the other. So they are one item, at the cheaper price.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import isfinite

from flint import nmod_poly

from disting.algebra.sampling import PROOF_BITS
from disting.behaviour.transfer import touched
from disting.errors import InputError, shown
from disting.experiments.experiment import GENERIC, Entry, Experiment, MeasuredChain
from disting.experiments.polynomials import residues_of
from disting.experiments.stacked_profiles import drawn
from disting.model.chain import Chain

COSTS = {"sensor": 1.0, "move": 1.0, "inertia": 2.0, "lock": 3.0}


class Kind(StrEnum):
    """What is done."""

    SENSOR = "sensor"
    FORCE = "force"
    INERTIA = "inertia"
    LOCK = "lock"


WORDS = {
    Kind.SENSOR: "a sensor at mass {}",
    Kind.FORCE: "the force moved to mass {}",
    Kind.INERTIA: "a known inertia added to mass {}",
    Kind.LOCK: "mass {} locked",
}
ANYWHERE = {
    Kind.SENSOR: "a sensor at any further mass, one more or the present one moved",
    Kind.FORCE: "the force moved to any other mass",
    Kind.INERTIA: "a known inertia added to any mass",
    Kind.LOCK: "any mass locked that carries neither force nor sensor",
}


class Gain(StrEnum):
    """What an item adds to the present measurement: a NEW transfer function, one that REPEATS
    what the present one tells already, or a sensor that never moves: SILENT.
    """

    NEW = "new"
    REPEATS = "repeats"
    SILENT = "silent"


@dataclass(frozen=True, slots=True, order=True)
class Item:
    """One thing that is done at one mass of a chain."""

    kind: Kind
    at: int

    @property
    def experiment(self) -> Experiment:
        """The further experiment; an added inertia has a generic size."""
        match self.kind:
            case Kind.SENSOR:
                return Experiment(sensor=self.at)
            case Kind.FORCE:
                return Experiment(force=self.at)
            case Kind.INERTIA:
                return Experiment(inertias={self.at: GENERIC})
            case Kind.LOCK:
                return Experiment(locked=self.at)

    @property
    def text(self) -> str:
        """In words, with the mass."""
        return WORDS[self.kind].format(self.at)

    def is_worth(self, gain: Gain) -> bool:
        """Whether there is anything to be seen. An inertia whose effect can be foretold is worth
        it: a structure of which another effect is foretold is excluded. A sensor or a force where
        it is already is none.
        """
        return gain is Gain.NEW or (gain is Gain.REPEATS and self.kind is Kind.INERTIA)


@dataclass(frozen=True)
class Costs:
    """What each kind costs, in any unit; two things together cost their sum. Raises InputError."""

    of: Mapping[str, float] = field(default_factory=lambda: dict(COSTS))

    def __post_init__(self) -> None:
        unknown = [name for name in self.of if name not in COSTS]
        if unknown:
            raise InputError(f"costs are those of {', '.join(COSTS)}, not of {shown(unknown[0])}")
        wrong = [name for name, cost in self.of.items() if not (isfinite(cost) and cost > 0)]
        if wrong:
            raise InputError(f"the cost of {wrong[0]} is a positive number")
        object.__setattr__(self, "of", COSTS | dict(self.of))

    @staticmethod
    def read(text: str) -> "Costs":
        """Costs written sensor=3,lock=1; those that are not named keep their defaults.

        >>> Costs.read("lock=0.5").of["lock"], Costs.read("lock=0.5").of["inertia"]
        (0.5, 2.0)
        """
        given: dict[str, float] = {}
        for part in filter(None, text.split(",")):
            name, _, value = part.strip().partition("=")
            try:
                given[name] = float(value)
            except ValueError:
                raise InputError(f"costs are written sensor=3,lock=1, not {shown(part)}") from None
        return Costs(given)

    def cost(self, kind: Kind) -> float:
        """Of one item of this kind.

        >>> Costs.read("sensor=5,move=2").cost(Kind.SENSOR)
        2.0
        """
        if kind is Kind.SENSOR:
            return min(self.of["sensor"], self.of["move"])
        return self.of["move" if kind is Kind.FORCE else kind.value]

    @property
    def cheapest_first(self) -> tuple[Kind, ...]:
        """All kinds; of equal cost in their order."""
        return tuple(sorted(Kind, key=self.cost))


def kinds(n_masses: int) -> tuple[Kind, ...]:
    """What can be done on chains of this size: a single mass cannot be locked."""
    return tuple(kind for kind in Kind if n_masses > 1 or kind is not Kind.LOCK)


def measured(chain: Chain, *items: Item) -> MeasuredChain:
    """The chain as it is and with these further experiments.

    Where force and sensor are at one place, to move the one or the other is the same (reciprocity:
    A(s) and its inverse are symmetric), so the sensor is moved.
    """
    found = [
        Item(Kind.SENSOR, item.at) if chain.collocated and item.kind is Kind.FORCE else item
        for item in items
    ]
    return MeasuredChain(chain, (Experiment(), *(item.experiment for item in found)))


def gain(chain: Chain, item: Item) -> Gain | None:
    """What an item adds; None where it is not known: at a random point what was measured implies
    the same, so maybe it always does.

    Implied are the same transfer function G and, where force and sensor are at the one mass that
    gets the inertia J, G/(1 + J s^2 R) with the receptance R = G/s^q, q differentiations; a lag
    stands between both. NEW is proven: what differs at a point modulo a prime differs.
    """
    both = measured(chain, item)
    here, there = both.entries
    if not touched(there):
        return Gain.SILENT
    if item.kind is Kind.INERTIA and not chain.lag and here.ports == (0, item.at, 0, item.at):
        return Gain.REPEATS
    if not any(there.experiment.changes) and _seen(here) == _seen(there):
        return Gain.REPEATS
    where = drawn(both, "gain", PROOF_BITS)
    first, second = where.quotients
    if second is None:
        return Gain.SILENT
    if first is None:
        return Gain.NEW
    num, den = first.num, first.den
    if item.kind is Kind.INERTIA:
        (size,) = residues_of(there.known, where.modulus).values()
        den = den + num * nmod_poly([0] * (2 - here.sensor_order) + [size], where.modulus)
    return Gain.NEW if num * second.den != second.num * den else None


def _seen(entry: Entry) -> tuple[object, ...]:
    return entry.ports, entry.sensor_order
