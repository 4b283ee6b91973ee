"""How a machine is measured: ports, sensor quantity, and changes of the machine whose size is
known.

An experiment is one force, one sensor and one state of the machine. A locked mass does not move:
its coordinate is 0, so it cuts its row, and what was a joint to it is a joint to something that
does not move. A known inertia J at mass i adds J s^2, a known spring k to the ground adds k to
A(s)[i, i]. Everything else is the chain, with its own parameters, whatever is done to it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from disting.algebra.sampling import residues
from disting.behaviour.transfer import touched
from disting.errors import ConstraintViolation, InputError, shown
from disting.model.chain import Chain, Sensor
from disting.model.exact_number import is_too_long
from disting.model.shown import summary
from disting.model.structure import Element, Known, Ports, Structure

GENERIC = "generic"  # in place of a number: one that is drawn once, the same for all models
GENERIC_BITS = 64
Place = tuple[int, int]
"""Plus and minus mass of a port; 0 is the ground."""
Sizes = tuple[tuple[int, Fraction], ...]
"""(mass, size) of what is added."""
Given = Mapping[int, object] | Iterable[tuple[int, object]]


@dataclass(frozen=True, slots=True)
class Experiment:
    """One way to measure a chain; as it stands, that of the chain itself.

    `force` and `sensor`: a mass, or two of which the second is the other end (0 is the ground);
    None: as in the chain. `quantity`: position, velocity or acceleration, None: as in the chain.
    `locked`: masses that do not move. `inertias`, `springs`: {mass: size} of known inertias and of
    known springs to the ground, exact positive numbers or GENERIC. Raises InputError.

    >>> Experiment(sensor=3, locked=2, inertias={1: "0.5"}).text
    'sensor 3, mass 2 locked, inertia 1/2 at mass 1'
    """

    force: Place | None = None
    sensor: Place | None = None
    quantity: Sensor | None = None
    locked: tuple[int, ...] = ()
    inertias: Sizes = ()
    springs: Sizes = ()

    if TYPE_CHECKING:  # what may be given, and what it becomes

        def __init__(
            self,
            force: Place | int | None = None,
            sensor: Place | int | None = None,
            quantity: Sensor | str | None = None,
            locked: Iterable[int] | int = (),
            inertias: Given = (),
            springs: Given = (),
        ) -> None:
            """See the class."""

    def __post_init__(self) -> None:
        given = {
            "force": _place("force", self.force),
            "sensor": _place("sensor", self.sensor),
            "quantity": None if self.quantity is None else _quantity(self.quantity),
            "locked": _masses("a locked mass", self.locked),
            "inertias": _sizes("inertia", self.inertias),
            "springs": _sizes("spring", self.springs),
        }
        for name, value in given.items():
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        given = [
            f"{name}={place[0] if not place[1] else place}"
            for name, place in (("force", self.force), ("sensor", self.sensor))
            if place
        ]
        given += [f"quantity={self.quantity.value!r}"] if self.quantity else []
        given += [f"locked={self.locked}"] * bool(self.locked)
        for name, sizes in (("inertias", self.inertias), ("springs", self.springs)):
            items = ", ".join(f"{mass}: {str(size)!r}" for mass, size in sizes)
            given += [f"{name}={{{items}}}"] * bool(items)
        return f"Experiment({', '.join(given)})"

    @property
    def masses(self) -> tuple[int, ...]:
        """All masses that it names."""
        ports = [i for port in (self.force, self.sensor) for i in port or () if i]
        return (*ports, *self.locked, *(i for i, _ in (*self.inertias, *self.springs)))

    @property
    def changes(self) -> tuple[object, ...]:
        """The state of the machine: experiments that share it share their poles."""
        return self.locked, self.inertias, self.springs

    @property
    def text(self) -> str:
        """The experiment in words."""
        ports = [
            f"{name} {place[0]}-{place[1]}" if place[1] else f"{name} {place[0]}"
            for name, place in (("force", self.force), ("sensor", self.sensor))
            if place
        ]
        added = [
            f"{what} {size} at mass {mass}"
            for what, sizes in (("inertia", self.inertias), ("spring", self.springs))
            for mass, size in sizes
        ]
        locked = [f"mass {i} locked" for i in self.locked]
        quantity = [self.quantity.value] if self.quantity else []
        return ", ".join([*ports, *quantity, *locked, *added]) or "as it is"

    def refuse(self, chain: Chain) -> None:
        """Raise InputError if the chain has no such place, or nothing is left that moves."""
        n = chain.n_masses
        wrong = [i for i in self.masses if i > n]
        if wrong:
            raise InputError(f"there is no mass {wrong[0]} in a chain with masses 1 to {n}")
        if len(self.locked) == n:
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
        """Whether the force has a lag."""
        return self.structure.lag

    @cached_property
    def sensor_order(self) -> int:
        """Differentiations of the position."""
        quantity = self.experiment.quantity
        return self.structure.sensor_order if quantity is None else quantity.order

    @cached_property
    def ports(self) -> Ports:
        """Where force and sensor attach; a locked mass is as good as the ground."""
        p = self.structure.ports
        act = self.experiment.force or (p.act_plus, p.act_minus)
        meas = self.experiment.sensor or (p.meas_plus, p.meas_minus)
        still = set(self.experiment.locked)
        act_plus, act_minus, meas_plus, meas_minus = (0 if i in still else i for i in (*act, *meas))
        return Ports(act_minus, act_plus, meas_minus, meas_plus)

    @cached_property
    def row_ends(self) -> tuple[tuple[int, int], ...]:
        """Rows of masses that move, cut at the locked ones."""
        still = set(self.experiment.locked)
        found = []
        for first, last in self.structure.row_ends:
            walls = [first - 1, *(i for i in range(first, last + 1) if i in still), last + 1]
            found += [(a + 1, b - 1) for a, b in pairwise(walls) if b - a > 1]
        return tuple(found)

    @cached_property
    def elements(self) -> tuple[Element, ...]:
        """Those of the structure that act on a mass that moves, and what is added to it."""
        still = {0, *self.experiment.locked}

        def moves(e: Element) -> bool:
            """Whether the element acts on a mass that moves."""
            return not ({e.at, e.at + 1} if e.kind in "kd" else {e.at}) <= still

        added = [Known(i, kind) for kind, sizes in self._added for i, _ in sizes]
        return tuple(e for e in (*self.structure.elements, *added) if moves(e))

    @cached_property
    def known(self) -> dict[str, Fraction]:
        """Sizes of what is added, by the names of `elements`."""
        return {Known(i, kind).parameter: size for kind, sizes in self._added for i, size in sizes}

    @property
    def _added(self) -> tuple[tuple[str, Sizes], ...]:
        return ("m", self.experiment.inertias), ("g", self.experiment.springs)


@dataclass(frozen=True)
class MeasuredChain:
    """A chain under several experiments, with one parameter vector for all; raises InputError.

    >>> MeasuredChain(Chain(2), (Experiment(), Experiment(sensor=2))).text
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
        if any(experiment.changes):
            return None
        quantity = experiment.quantity or self.chain.sensor
        try:
            return replace(self.chain, **entry.ports._asdict(), sensor=quantity)
        except ConstraintViolation:
            return None

    @property
    def silent(self) -> tuple[int, ...]:
        """Experiments, from 0, in which the sensor never moves: their transfer function is zero."""
        return tuple(i for i, entry in enumerate(self.entries) if not touched(entry))

    @property
    def text(self) -> tuple[str, ...]:
        """The experiments in words."""
        return tuple(e.text for e in self.experiments)


def _place(what: str, given: object) -> Place | None:
    if given is None:
        return None
    ends = tuple(given) if isinstance(given, tuple | list) else (given, 0)
    wrong = any(isinstance(i, bool) or not isinstance(i, int) or i < 0 for i in ends)
    if len(ends) != 2 or wrong:
        raise InputError(f"a {what} is at a mass or between two, not {shown(given)}")
    if ends[0] == ends[1]:
        raise InputError(f"a {what} has two different ends, not twice {shown(ends[0])}")
    return ends[0], ends[1]


def _masses(what: str, given: object) -> tuple[int, ...]:
    listed = (given,) if isinstance(given, int) else given
    if not isinstance(listed, Iterable):
        raise InputError(f"{what} is a whole number, not {shown(given)}")
    found = list(listed)
    wrong = [i for i in found if isinstance(i, bool) or not isinstance(i, int) or i < 1]
    if wrong:
        raise InputError(f"{what} is mass 1, 2, .., not {shown(wrong[0])}")
    return tuple(sorted(set(found)))


def _quantity(given: object) -> Sensor:
    try:
        return Sensor(str(given))
    except ValueError:
        raise InputError(
            f"a sensor shows position, velocity or acceleration, not {shown(given)}"
        ) from None


def _sizes(what: str, given: object) -> Sizes:
    listed = given.items() if isinstance(given, Mapping) else given
    try:
        items = [(mass, size) for mass, size in listed]  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise InputError(f"known sizes are written {{mass: size}}, not {shown(given)}") from None
    masses = [mass for mass, _ in items]
    if len(_masses(f"the place of a known {what}", masses)) < len(masses):
        raise InputError(f"two known {what}s at one mass: give their sum")
    return tuple(sorted((mass, number(what, size)) for mass, size in items))


def number(what: str, given: object) -> Fraction:
    """A known size, exact; GENERIC is one that is drawn once and for all, between 1 and 2.

    >>> number("inertia", 0.5), 1 < number("inertia", "generic") < 2
    (Fraction(1, 2), True)
    """
    if given == GENERIC:
        low = 1 << (GENERIC_BITS - 1)
        return Fraction(low + residues(f"generic {what}", 1, low)[0], low)
    try:
        size = Fraction(given if isinstance(given, Fraction) else _written(given))
    except (ValueError, ZeroDivisionError):
        raise InputError(
            f"a known {what} is a positive number or {GENERIC}, not {shown(given)}"
        ) from None
    if size <= 0:
        raise InputError(f"a known {what} is positive, not {shown(str(given))}")
    return size


def _written(given: object) -> str:
    text = str(given)
    if isinstance(given, bool) or is_too_long(text):
        raise ValueError(text)
    return text
