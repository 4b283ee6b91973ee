"""Measurement setup of a machine: ports, sensor quantity, and changes of the machine.

An experiment is one force, one sensor and one state of the machine. A locked mass does not move:
its coordinate is 0, so it cuts its row, and what was a joint to it is a joint to something that
does not move. What is added, of a known size, adds size * s^power to A(s)[i, i] (`model.kinds`).
Everything else is the chain, with its own parameters, whatever is done to it.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from disting.behaviour.transfer import touched_rows
from disting.errors import ConstraintViolation, InputError, enumeration, short
from disting.experiments.changes import Change, changes_of, in_order
from disting.model.chain import AS_IT_IS, Chain, Element, Known, Ports, Sort, Structure
from disting.model.kinds import CHANGES, Kind
from disting.model.presentation import summary
from disting.network.network import Network
from disting.quantities import Sensor, sensor_of_model

AnyStructure = Chain | Network
Place = tuple[int, int]
"""Plus and minus mass of a port; 0 is the ground."""


@dataclass(frozen=True, slots=True, init=False, repr=False)
class Experiment:
    """One way to measure a chain; by default that of the chain itself.

    `force` and `sensor`: a mass, or two of which the second is the other end (0 is the ground);
    None: as in the chain. `quantity`: position, velocity or acceleration, None: as in the chain.
    `changes` of the machine are also given by kind: `locked`, masses that do not move; `inertias`,
    `brakes` and `springs`, {mass: size} of known inertias and of known dampers and springs to the
    ground, exact positive numbers or "generic". Raises InputError.

    >>> Experiment(sensor=3, locked=2, inertias={1: "0.5"}).text
    'sensor 3, mass 2 locked, inertia 1/2 at mass 1'
    """

    force: Place | None
    sensor: Place | None
    quantity: Sensor | None
    changes: tuple[Change[int], ...]

    def __init__(
        self,
        force: Place | int | None = None,
        sensor: Place | int | None = None,
        quantity: Sensor | str | None = None,
        *,
        changes: Iterable[Change[int]] = (),
        **by_kind: object,
    ) -> None:
        listed = [*changes, *changes_of(by_kind)]
        for change in listed:
            if type(change.place) is not int or change.place < 1:
                raise InputError(
                    f"the place of a {change.kind.name} is mass 1, 2, .., not {short(change.place)}"
                )
        for name, value in (
            ("force", _place("force", force)),
            ("sensor", _place("sensor", sensor)),
            ("quantity", None if quantity is None else _quantity(quantity)),
            ("changes", in_order(listed)),
        ):
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        words = [
            f"{name}={place[0] if not place[1] else place}"
            for name, place in (("force", self.force), ("sensor", self.sensor))
            if place
        ]
        words += [f"quantity={self.quantity.value!r}"] if self.quantity else []
        for kind in CHANGES:
            listed = self.of(kind)
            items = ", ".join(f"{c.place}: {str(c.size)!r}" for c in listed)
            what = f"{{{items}}}" if kind.takes_size else f"{tuple(c.place for c in listed)}"
            words += [f"{kind.argument}={what}"] if listed else []
        return f"Experiment({', '.join(words)})"

    def of(self, kind: Kind) -> tuple[Change[int], ...]:
        """The changes of this kind, by mass."""
        return tuple(change for change in self.changes if change.kind == kind)

    @property
    def still(self) -> tuple[int, ...]:
        """The masses that do not move."""
        return tuple(c.place for c in self.changes if c.kind.holds)

    @property
    def masses(self) -> tuple[int, ...]:
        """All masses that it names."""
        ports = [i for port in (self.force, self.sensor) for i in port or () if i]
        return (*ports, *(change.place for change in self.changes))

    @property
    def written_fields(self) -> dict[str, object]:
        """All its content, by argument: masses, or (mass, size) where a size is taken. Kinds that
        came later are there where something is done, so that what was written before them is
        written so again.
        """
        names = "force", "sensor", "quantity"
        entries: dict[str, object] = {name: getattr(self, name) for name in names}
        for kind in CHANGES:
            listed = self.of(kind)
            if listed or kind.always:
                entries[kind.argument] = tuple(
                    (c.place, c.size) if kind.takes_size else c.place for c in listed
                )
        return entries

    def moved(self, place: Callable[[int], int]) -> "Experiment":
        """The same at the masses that its own become; the ground stays the ground."""

        def port(at: Place | None) -> Place | None:
            """A port there."""
            return None if at is None else (end(at[0]), end(at[1]))

        def end(at: int) -> int:
            """One end of a port there."""
            return place(at) if at else 0

        changes = tuple(change.moved(place) for change in self.changes)
        return replace(self, force=port(self.force), sensor=port(self.sensor), changes=changes)

    @property
    def text(self) -> str:
        """The experiment in words."""
        ports = [
            f"{name} {place[0]}-{place[1]}" if place[1] else f"{name} {place[0]}"
            for name, place in (("force", self.force), ("sensor", self.sensor))
            if place
        ]
        quantity = [self.quantity.value] if self.quantity else []
        return ", ".join([*ports, *quantity, *(c.text for c in self.changes)]) or AS_IT_IS

    def refuse(self, structure: AnyStructure) -> None:
        """Raise InputError if the structure has no such place, or nothing is left that moves."""
        masses, what = places_of(structure), "chain" if isinstance(structure, Chain) else "machine"
        wrong = [i for i in self.masses if i not in masses]
        if wrong:
            raise InputError(f"there is no mass {wrong[0]} in a {what} with {range_of(masses)}")
        if set(masses) <= set(self.still):
            raise InputError("all masses are locked: leave one that moves")


@dataclass(frozen=True)
class Entry:
    """One transfer function of a chain: its structure under one experiment.

    As `transfer.Arrangement` it has the parameters of the whole structure, so that all entries of
    a chain share one order of them; those of what does not move do not occur in it.
    """

    structure: Structure
    experiment: Experiment

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the structure."""
        return self.structure.parameters

    @property
    def lag(self) -> bool:
        """True if the force has a lag."""
        return self.structure.lag

    @property
    def is_silent(self) -> bool:
        """True if the sensor never moves: no mass that it measures is connected to a driven one."""
        return not touched_rows(self)

    @cached_property
    def sensor_order(self) -> int:
        """Differentiations of the position."""
        quantity = self.experiment.quantity
        return self.structure.sensor_order if quantity is None else quantity.order

    @cached_property
    def attached(self) -> Ports:
        """Where force and sensor attach."""
        p = self.structure.ports
        act_plus, act_minus = self.experiment.force or (p.act_plus, p.act_minus)
        meas_plus, meas_minus = self.experiment.sensor or (p.meas_plus, p.meas_minus)
        return Ports(act_minus, act_plus, meas_minus, meas_plus)

    @cached_property
    def ports(self) -> Ports:
        """The same, a locked mass being as good as the ground."""
        still = set(self.experiment.still)
        return Ports(*(0 if i in still else i for i in self.attached))

    @cached_property
    def row_ends(self) -> tuple[tuple[int, int], ...]:
        """Rows of masses that move, cut at the locked ones."""
        still = set(self.experiment.still)
        rows = []
        for first, last in self.structure.row_ends:
            walls = [first - 1, *(i for i in range(first, last + 1) if i in still), last + 1]
            rows += [(a + 1, b - 1) for a, b in pairwise(walls) if b - a > 1]
        return tuple(rows)

    @cached_property
    def elements(self) -> tuple[Element, ...]:
        """Those of the structure that act on a mass that moves, and what is added to it."""
        still = {0, *self.experiment.still}

        def moves(e: Element) -> bool:
            """Return True if the element acts on a mass that moves."""
            return not ({e.at, e.at + 1} if e.kind in "kd" else {e.at}) <= still

        return tuple(e for e in (*self.structure.elements, *self._added) if moves(e))

    @cached_property
    def known(self) -> dict[str, Fraction]:
        """Sizes of what is added, by the names of `elements`."""
        return {element.parameter: size for element, size in self._added.items()}

    @cached_property
    def _added(self) -> dict[Known, Fraction]:
        return {
            Known(change.place, change.kind.name, change.kind.power): change.size
            for change in self.experiment.changes
            if change.kind.power is not None and change.size is not None
        }


@dataclass(frozen=True)
class MeasuredChain:
    """A chain under several experiments, with one parameter vector for all; raises InputError.

    >>> MeasuredChain(Chain(2, damped=False), (Experiment(), Experiment(sensor=2))).text
    ('as it is', 'sensor 2')
    """

    chain: Chain
    experiments: tuple[Experiment, ...]

    def __post_init__(self) -> None:
        if not self.experiments:
            raise InputError("at least one experiment is needed")
        for experiment in self.experiments:
            experiment.refuse(self.chain)

    def __repr__(self) -> str:
        return summary(self, f"{self.chain} | {' | '.join(self.text)}")

    @cached_property
    def entries(self) -> tuple[Entry, ...]:
        """The transfer functions, without the dead time that they share."""
        return tuple(Entry(self.chain.structure, e) for e in self.experiments)

    def alone(self, at: int) -> Chain | None:
        """The chain that this one is in one of its experiments (counted from 0), where nothing is
        done to the machine and the ports are those of a chain of the class.

        >>> MeasuredChain(Chain(2), (Experiment(sensor=2),)).alone(0) == Chain(2, meas_plus=2)
        True
        """
        entry, experiment = self.entries[at], self.experiments[at]
        if experiment.changes:
            return None
        quantity = experiment.quantity or self.chain.sensor
        try:
            return replace(self.chain, **entry.ports._asdict(), sensor=quantity)
        except ConstraintViolation:
            return None

    def is_plain(self, at: int) -> bool:
        """Return True if one of its experiments (counted from 0) is that of the unmodified
        chain.
        """
        return self.alone(at) == self.chain

    @property
    def silent(self) -> tuple[int, ...]:
        """Experiments, from 0, in which the sensor never moves: their transfer function is zero."""
        return tuple(i for i, entry in enumerate(self.entries) if entry.is_silent)

    @property
    def text(self) -> tuple[str, ...]:
        """The experiments in words."""
        return tuple(e.text for e in self.experiments)


def places_of(structure: AnyStructure) -> tuple[int, ...]:
    """Masses of a chain; nodes of a network but the one that its elements are measured against."""
    if isinstance(structure, Chain):
        return tuple(range(1, structure.n_masses + 1))
    ends = {i for e in structure.elements for i in e.nodes}
    ground = {0} if structure.sort is Sort.CIRCUIT else set()
    return tuple(sorted((set(structure.nodes) | (ends & ground)) - {structure.reference}))


def range_of(masses: tuple[int, ...]) -> str:
    """Masses in words.

    >>> range_of((1, 2, 3)), range_of((1, 4))
    ('masses 1 to 3', 'masses 1, 4')
    """
    if masses == tuple(range(1, len(masses) + 1)):
        return f"masses 1 to {len(masses)}"
    return f"masses {enumeration(map(str, masses))}"


def _place(what: str, place: object) -> Place | None:
    if place is None:
        return None
    ends = tuple(place) if isinstance(place, tuple | list) else (place, 0)
    wrong = any(isinstance(i, bool) or not isinstance(i, int) or i < 0 for i in ends)
    if len(ends) != 2 or wrong:
        raise InputError(f"a {what} is at a mass or between two, not {short(place)}")
    if ends[0] == ends[1]:
        raise InputError(f"a {what} has two different ends, not twice {short(ends[0])}")
    return ends[0], ends[1]


def _quantity(quantity: object) -> Sensor:
    return sensor_of_model(str(quantity))
