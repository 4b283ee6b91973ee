"""Setup of a further response of the same machine: the differences from the first one.

Force and sensor may be elsewhere, and the machine may be changed as in any experiment. Places are
written as the commands write ports, such as 2, last or 1:3, since candidates have several sizes:
for a number of masses a setup is an `Experiment`.
"""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from disting.errors import InputError, short
from disting.experiments.changes import Change, changes_of, in_order
from disting.experiments.experiment import Entry, Experiment, MeasuredChain, Place
from disting.model.chain import Chain, Ports, Sensor, Structure


@dataclass(frozen=True, slots=True, init=False)
class Setup:
    """Setup of one measurement; by default that of the first response.

    `sensor`, `force`: a port, "" for that of the candidate; `changes` of the machine, sizes in the
    units of its parameters, also by kind: `locked`, masses that do not move, `inertias`, `springs`,
    `brakes`, (mass, size) of what is added; `sign` = -1 for a sensor that is reversed against the
    first; `delay`: name of a dead time of its own, "" for the common one. Raises InputError.

    >>> Setup(sensor="3", locked=("2",), inertias=(("1", 0.5),)).text
    'sensor 3, mass 2 locked, inertia 0.5 at mass 1'
    """

    sensor: str
    force: str
    changes: tuple[Change[str], ...]
    sign: int
    delay: str

    def __init__(
        self,
        sensor: str = "",
        sign: int = 1,
        delay: str = "",
        *,
        force: str = "",
        changes: Iterable[Change[str]] = (),
        **by_kind: object,
    ) -> None:
        listed = [*changes, *changes_of(by_kind)]
        for change in listed:
            if not re.fullmatch(r"[1-9]\d*|last", str(change.place)):
                raise InputError(f"a mass is a number or the word last, not {short(change.place)}")
        if sign not in (1, -1):
            raise InputError(f"the sign of a sensor is 1 or -1, not {sign!r}")
        for name, value in (
            ("sensor", sensor),
            ("force", force),
            ("changes", in_order(listed)),
            ("sign", sign),
            ("delay", delay),
        ):
            object.__setattr__(self, name, value)

    @property
    def text(self) -> str:
        """The setup in words."""
        ports = (("force", self.force), ("sensor", self.sensor))
        words = [f"{name} {place}" for name, place in ports if place]
        for change in self.changes:
            size = "" if change.size is None else f"{float(change.size):g}"
            words.append(change.kind.text.format(at=change.place, size=size))
        return ", ".join(words) or "the first response"

    def experiment(self, n: int) -> Experiment:
        """Experiment on a chain of n masses, without quantity, sign and dead time; raises
        InputError.
        """
        force, sensor = (
            port(text, n)[::-1] if text else None for text in (self.force, self.sensor)
        )
        changes = [change.moved(partial(_mass, n=n)) for change in self.changes]
        return Experiment(force, sensor, changes=changes)

    def moved(self, n: int, place: Callable[[int], int]) -> "Setup":
        """The same on another chain, at the masses that those of a chain of n masses become."""
        experiment = self.experiment(n).moved(place)
        changes = tuple(change.moved(str) for change in experiment.changes)
        return replace(
            self,
            sensor=_write_place(experiment.sensor),
            force=_write_place(experiment.force),
            changes=changes,
        )

    def still(self, n: int) -> tuple[int, ...]:
        """The masses of a chain of n masses that do not move; raises InputError."""
        return self.experiment(n).still

    def added(self, n: int) -> tuple[tuple[int, int, float], ...]:
        """(mass, power of s, size) of what is added in a chain of n masses; raises InputError."""
        return tuple(
            (change.place, change.kind.power, float(change.size))
            for change in self.experiment(n).changes
            if change.kind.power is not None and change.size is not None
        )

    def seen(self, structure: Structure, quantity: Sensor) -> Structure:
        """The structure with this force and this sensor; raises InputError."""
        own, n = structure.ports, structure.n_masses
        act = _ends(self.force, n) if self.force else own[:2]
        meas = _ends(self.sensor, n) if self.sensor else own[2:]
        return replace(structure, ports=Ports(*act, *meas), sensor_order=quantity.order)

    def missing(self, structure: Structure) -> str:
        """Why the machine cannot be measured so; "" where it can."""
        n = structure.n_masses
        try:
            self.seen(structure, Sensor.POSITION)
            whole = len(self.still(n)) == n
        except InputError as reason:
            return str(reason)
        return f"all masses of a chain of {n} are locked: leave one that moves" if whole else ""

    def is_silent(self, structure: Structure) -> bool:
        """Return True if the sensor never moves: no mass that it measures is connected to a driven
        one.
        """
        return Entry(structure, self.experiment(structure.n_masses)).is_silent


def port(text: str, n: int) -> tuple[int, int]:
    """(minus, plus) of a port's text in a chain of n masses; raises InputError for another text.

    >>> port("last", 3), port("1:3", 3)
    ((0, 3), (1, 3))
    """
    match = re.fullmatch(r"(?:(\d+):)?(\d+|last)", text)
    if not match:
        raise InputError(f"a port is written like 2, last or 1:3, not {short(text)}")
    return int(match[1] or 0), n if match[2] == "last" else int(match[2])


def _ends(text: str, n: int) -> tuple[int, int]:
    """(minus, plus) of a port that a chain of n masses has; raises InputError."""
    minus, plus = port(text, n)
    if max(minus, plus) > n or minus == plus or not plus:
        raise InputError(f"there is no place {text} in a chain of {n} masses")
    return minus, plus


def _write_place(place: Place | None) -> str:
    """A port as it is written, "" where it is that of the chain.

    >>> _write_place((2, 0)), _write_place((3, 1))
    ('2', '1:3')
    """
    if place is None:
        return ""
    plus, minus = place
    return f"{minus}:{plus}" if minus else f"{plus}"


def measured_chain(chain: Chain, setups: Sequence[Setup]) -> MeasuredChain:
    """The chain under the experiments of all setups, for verdicts; quantities, signs and dead times
    add no information.
    """
    experiments = (setup.experiment(chain.n_masses) for setup in setups)
    return MeasuredChain(chain, tuple(experiments))


def measurable(chain: Chain, setups: tuple[Setup, ...]) -> tuple[bool, ...]:
    """Flags of the responses that a chain has: its masses exist, and the sensor moves."""
    structure = chain.structure
    return tuple(not (s.missing(structure) or s.is_silent(structure)) for s in setups)


def _mass(text: str, n: int) -> int:
    at = n if text == "last" else int(text)
    if at > n:
        raise InputError(f"there is no mass {at} in a chain of {n} masses")
    return at
