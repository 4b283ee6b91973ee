"""How a further response of the same machine was measured: what differs from the first one.

The force is the same. The sensor may be elsewhere, masses may be locked (their coordinates are 0)
and inertias of known size may be added. Places are written as the commands write ports, such as 2,
last or 1:3, since candidates of several sizes are asked.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import isfinite

from disting.errors import InputError, shown
from disting.experiments import Experiment, MeasuredChain
from disting.model.chain import Chain, Sensor
from disting.model.structure import Ports, Structure


@dataclass(frozen=True, slots=True)
class Setup:
    """One way to measure; as it stands, that of the first response.

    `sensor`: a port, "" for that of the candidate; `locked`: masses that do not move; `inertias`:
    (mass, size) of what is added, in the unit of the masses; `sign` = -1 for a sensor that is
    reversed against the first; `delay`: name of a dead time of its own, "" for the common one.
    Raises InputError.

    >>> Setup(sensor="3", locked=("2",), inertias=(("1", 0.5),)).text
    'sensor 3, mass 2 locked, inertia 0.5 at mass 1'
    """

    sensor: str = ""
    locked: tuple[str, ...] = ()
    inertias: tuple[tuple[str, float], ...] = ()
    sign: int = 1
    delay: str = ""

    def __post_init__(self) -> None:
        for at in (*self.locked, *(at for at, _ in self.inertias)):
            if not re.fullmatch(r"[1-9]\d*|last", at):
                raise InputError(f"a mass is a number or the word last, not {shown(at)}")
        for _, size in self.inertias:
            if not (size > 0 and isfinite(size)):
                raise InputError(f"a known inertia is a positive number, not {size:g}")
        if self.sign not in (1, -1):
            raise InputError(f"the sign of a sensor is 1 or -1, not {self.sign!r}")

    @property
    def text(self) -> str:
        """The setup in words."""
        said = [f"sensor {self.sensor}"] * bool(self.sensor)
        said += [f"mass {at} locked" for at in self.locked]
        said += [f"inertia {size:g} at mass {at}" for at, size in self.inertias]
        return ", ".join(said) or "the first response"

    def still(self, n: int) -> tuple[int, ...]:
        """The masses of a chain of n masses that do not move; raises InputError."""
        return tuple(sorted({_mass(at, n) for at in self.locked}))

    def added(self, n: int) -> tuple[tuple[int, float], ...]:
        """(mass, size) of what is added in a chain of n masses; raises InputError."""
        return tuple((_mass(at, n), size) for at, size in self.inertias)

    def seen(self, structure: Structure, quantity: Sensor) -> Structure:
        """The structure with this sensor; raises InputError."""
        ports, n = structure.ports, structure.n_masses
        if self.sensor:
            minus, plus = port(self.sensor, n)
            if max(minus, plus) > n or minus == plus or not plus:
                raise InputError(f"there is no place {self.sensor} in a chain of {n} masses")
            ports = Ports(ports.act_minus, ports.act_plus, minus, plus)
        return replace(structure, ports=ports, sensor_order=quantity.order)

    def missing(self, structure: Structure) -> str:
        """Why the machine cannot be measured so; "" where it can."""
        n = structure.n_masses
        try:
            self.seen(structure, Sensor.POSITION)
            self.added(n)
            whole = len(self.still(n)) == n
        except InputError as reason:
            return str(reason)
        return f"all masses of a chain of {n} are locked: leave one that moves" if whole else ""

    def is_silent(self, structure: Structure) -> bool:
        """Whether the sensor never moves: no mass that it shows is joined to one that is driven."""
        ports, still = self.seen(structure, Sensor.POSITION).ports, self.still(structure.n_masses)
        parts = []
        for first, last in structure.row_ends:
            walls = [first - 1, *(i for i in still if first <= i <= last), last + 1]
            parts += [range(a + 1, b) for a, b in pairwise(walls)]
        driven = {i for i in (ports.act_minus, ports.act_plus) if i}
        shown_at = {i for i in (ports.meas_minus, ports.meas_plus) if i}
        return not any(driven & set(part) and shown_at & set(part) for part in parts)


def port(text: str, n: int) -> tuple[int, int]:
    """(minus, plus) of a port's text in a chain of n masses; raises InputError for another text.

    >>> port("last", 3), port("1:3", 3)
    ((0, 3), (1, 3))
    """
    match = re.fullmatch(r"(?:(\d+):)?(\d+|last)", text)
    if not match:
        raise InputError(f"a port is written like 2, last or 1:3, not {shown(text)}")
    return int(match[1] or 0), n if match[2] == "last" else int(match[2])


def measured_chain(chain: Chain, setups: Sequence[Setup]) -> MeasuredChain:
    """The chain under the experiments of all setups, for verdicts; quantities, signs and dead times
    tell nothing more.
    """
    n = chain.n_masses
    found = []
    for setup in setups:
        minus, plus = port(setup.sensor, n) if setup.sensor else (0, 0)
        found.append(
            Experiment(
                sensor=(plus, minus) if plus else None,
                locked=setup.still(n),
                inertias=[(at, repr(size)) for at, size in setup.added(n)],
            )
        )
    return MeasuredChain(chain, tuple(found))


def measurable(chain: Chain, setups: tuple[Setup, ...]) -> tuple[bool, ...]:
    """Which responses a chain has: its masses are there, and the sensor moves."""
    structure = chain.structure
    return tuple(not (s.missing(structure) or s.is_silent(structure)) for s in setups)


def _mass(text: str, n: int) -> int:
    at = n if text == "last" else int(text)
    if at > n:
        raise InputError(f"there is no mass {at} in a chain of {n} masses")
    return at
