"""Menu of possible further measurements in addition to the present one, with their costs.

An item is one thing of the table of kinds (`model.kinds`) that is done at one mass: a sensor there,
the force there, a known inertia added, the mass locked. A further sensor and the present sensor
moved show the same: transfer functions of one machine with one parameter vector, whether they are
measured at once or one after the other. So they are one item, at the cheaper price.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import isfinite
from typing import Any

from flint import nmod_poly

from disting.behaviour.sample import draw_point
from disting.errors import InputError, short
from disting.experiments.changes import GENERIC
from disting.experiments.experiment import Entry, Experiment, MeasuredChain
from disting.experiments.machine_model import MachineModel, residues_of
from disting.model.chain import Chain
from disting.model.kinds import COSTS, FORCE, KINDS, PRICES, SENSOR, Kind


class Gain(StrEnum):
    """Gain of an item over the present measurement: a NEW transfer function, one that REPEATS
    information of the present one, or a sensor that never moves: SILENT.
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
        """The further experiment; what takes a size has a generic one."""
        arguments: dict[str, Any] = {self.kind.argument: self.at}
        if self.kind.takes_size:
            arguments = {self.kind.argument: {self.at: GENERIC}}
        return Experiment(**arguments)

    @property
    def text(self) -> str:
        """In words, with the mass."""
        return self.kind.item.format(self.at)

    def is_worth(self, gain: Gain) -> bool:
        """Return True if the item can give new information. Something known whose effect can be
        foretold is worth it: a structure of which another effect is foretold is excluded. A sensor
        or a force where it is already is none.
        """
        return gain is Gain.NEW or (gain is Gain.REPEATS and self.kind.takes_size)


@dataclass(frozen=True)
class Costs:
    """Cost of each kind, in any unit; the cost of a combination is the sum. Kinds without a cost of
    their own are on a menu only where one is named. Raises InputError.
    """

    of: Mapping[str, float] = field(default_factory=lambda: dict(COSTS))

    def __post_init__(self) -> None:
        unknown = [name for name in self.of if name not in PRICES]
        if unknown:
            raise InputError(f"costs are those of {', '.join(PRICES)}, not of {short(unknown[0])}")
        wrong = [name for name, cost in self.of.items() if not (isfinite(cost) and cost > 0)]
        if wrong:
            cost = short(self.of[wrong[0]])
            raise InputError(f"the cost of {wrong[0]} is a positive number, not {cost}")
        object.__setattr__(self, "of", COSTS | dict(self.of))

    @staticmethod
    def read(text: str) -> "Costs":
        """Costs written sensor=3,lock=1; those that are not named keep their defaults.

        >>> Costs.read("lock=0.5").of["lock"], Costs.read("lock=0.5").of["inertia"]
        (0.5, 2.0)
        """
        costs: dict[str, float] = {}
        for part in filter(None, text.split(",")):
            name, _, value = part.strip().partition("=")
            try:
                costs[name] = float(value)
            except ValueError:
                raise InputError(f"costs are written sensor=3,lock=1, not {short(part)}") from None
        return Costs(costs)

    def cost(self, kind: Kind) -> float:
        """Of one item of this kind.

        >>> Costs.read("sensor=5,move=2").cost(SENSOR)
        2.0
        """
        return min(self.of[price] for price in kind.prices)

    def of_kinds(self, kinds: Iterable[Kind]) -> dict[str, float]:
        """The costs that count where these kinds are on the menu."""
        used = {price for kind in kinds for price in kind.prices}
        return {price: cost for price, cost in self.of.items() if price in used}

    @property
    def cheapest_first(self) -> tuple[Kind, ...]:
        """All kinds that have a cost; of equal cost in their order."""
        return tuple(sorted(self.priced(KINDS), key=self.cost))

    def priced(self, kinds: Iterable[Kind]) -> tuple[Kind, ...]:
        """Those of them that have a cost."""
        return tuple(kind for kind in kinds if set(kind.prices) <= self.of.keys())

    def kinds(self, n_places: int, menu: Iterable[Kind] = KINDS) -> tuple[Kind, ...]:
        """Kinds that are possible on structures with this number of masses or nodes, in the order
        of the table: a single mass cannot be locked.
        """
        return tuple(k for k in self.priced(menu) if n_places > 1 or not k.holds)


def measure_with(chain: Chain, *items: Item) -> MeasuredChain:
    """The chain as it is and with these further experiments.

    Where force and sensor are at one place, to move the one or the other is the same (reciprocity:
    A(s) and its inverse are symmetric), so the sensor is moved.
    """
    items_in_order = [
        Item(SENSOR, item.at) if chain.collocated and item.kind == FORCE else item for item in items
    ]
    return MeasuredChain(chain, (Experiment(), *(item.experiment for item in items_in_order)))


def gain(chain: Chain, item: Item) -> Gain | None:
    """Gain of an item; None where it is unknown: at a random point the present measurement implies
    the same, so possibly always.

    Implied are the same transfer function G and, where force and sensor are at the one mass to
    which h(s) is added, such as J s^2, G/(1 + h R) with the receptance R = G/s^q, q
    differentiations; a lag is between both. NEW is proven: what differs at a point modulo a prime
    differs.
    """
    both = measure_with(chain, item)
    plain, further = both.entries
    if further.is_silent:
        return Gain.SILENT
    sized = item.kind.power is not None
    if sized and not chain.lag and plain.ports == (0, item.at, 0, item.at):
        return Gain.REPEATS
    if not further.experiment.changes and _key_of(plain) == _key_of(further):
        return Gain.REPEATS
    where = draw_point(MachineModel(both), "gain")
    first, second = where.quotients
    if second is None:
        return Gain.SILENT
    if first is None:
        return Gain.NEW
    num, den = first.num, first.den
    if item.kind.power is not None:
        (size,) = residues_of(further.known, where.modulus).values()
        lift = item.kind.power - plain.sensor_order
        num, den = (_multiply_by_power(p, -lift) for p in (num, den)) if lift < 0 else (num, den)
        den = den + _multiply_by_power(first.num, lift) * size
    return Gain.NEW if num * second.den != second.num * den else None


def _multiply_by_power(p: nmod_poly, by: int) -> nmod_poly:
    """A polynomial times s^by, itself where that is none."""
    return p * nmod_poly([0] * by + [1], p.modulus()) if by > 0 else p


def _key_of(entry: Entry) -> tuple[object, ...]:
    return entry.ports, entry.sensor_order


def as_costs(cost: Costs | Mapping[str, float] | str | None) -> Costs:
    """Costs from a dict by kind, or from text such as "sensor=3,lock=1"; the usual ones for None.
    Raises InputError.
    """
    if isinstance(cost, Costs):
        return cost
    return Costs.read(cost) if isinstance(cost, str) else Costs(cost or {})
