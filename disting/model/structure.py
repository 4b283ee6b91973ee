"""What a chain is made of: masses, springs, dampers and ports.

A `Structure` is wider than a `Chain`: any set of joints may be present, so the supermodel of two
chains (condition 9), which has no gap, is a structure too. Elements know their parameter's name
and how they enter the equation of motion A(s) x = e_act F with A(s) = M s^2 + D s + K: each adds
parameter * s^power * v v^T for a vector v of the masses.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from disting.errors import InputError

HIGHEST = 2  # derivative that has Markov parameters and a state space whatever the ports


def _between(i: int) -> str:
    return f"{i}{i + 1}" if i < 9 else f"{i}_{i + 1}"


class Mass(NamedTuple):
    """Mass (or inertia) number `at`; parameter m_i [kg or kg m^2]."""

    at: int
    kind: str = "m"

    @property
    def parameter(self) -> str:
        """Name such as m1."""
        return f"m{self.at}"


class Spring(NamedTuple):
    """Spring between node `at` and its right neighbour (node 0 is the ground); parameter k_ij
    [N/m or N m/rad].
    """

    at: int
    kind: str = "k"

    @property
    def parameter(self) -> str:
        """Name such as k01."""
        return f"k{_between(self.at)}"


class Damper(NamedTuple):
    """Damper beside the spring of node `at`; parameter d_ij [N s/m or N m s/rad]."""

    at: int
    kind: str = "d"

    @property
    def parameter(self) -> str:
        """Name such as d01."""
        return f"d{_between(self.at)}"


class GroundDamper(NamedTuple):
    """Damper from mass `at` to the ground; parameter b_i [N s/m or N m s/rad]."""

    at: int
    kind: str = "b"

    @property
    def parameter(self) -> str:
        """Name such as b2."""
        return f"b{self.at}"


class Known(NamedTuple):
    """What adds to A(s)[at, at], with that power of s, something whose size is known: no parameter.

    `kind` is its word, such as inertia.
    """

    at: int
    kind: str
    power: int

    @property
    def parameter(self) -> str:
        """Name of its value, such as +inertia2."""
        return f"+{self.kind}{self.at}"


Element = Mass | Spring | Damper | GroundDamper | Known
_POWER = {"m": 2, "k": 0, "d": 1, "b": 1}


def power(element: Element) -> int:
    """Of s, with which an element's parameter enters A(s)."""
    return element.power if isinstance(element, Known) else _POWER[element.kind]


class Ports(NamedTuple):
    """Where force and sensor attach; 0 is the ground."""

    act_minus: int
    act_plus: int
    meas_minus: int
    meas_plus: int


@dataclass(frozen=True)
class Structure:
    """Elements and ports of a chain-like model; `sensor_order` = differentiations of the
    measured position.
    """

    n_masses: int
    elements: tuple[Element, ...]
    ports: Ports
    sensor_order: int
    lag: bool = False
    dead_time: bool = False

    def __post_init__(self) -> None:
        if not 0 <= self.sensor_order <= HIGHEST:
            raise InputError(
                "a sensor shows the position or one of its first two derivatives, not derivative"
                f" {self.sensor_order}: beyond, the transfer function of a mass is not proper"
            )

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Parameter names in the order of the elements, then T1 and Td."""
        return (*(e.parameter for e in self.elements), *["T1"] * self.lag, *["Td"] * self.dead_time)

    @property
    def n_states(self) -> int:
        """Order N_S of the state space (20): two states a mass, one for the lag."""
        return 2 * self.n_masses + self.lag

    @cached_property
    def row_ends(self) -> tuple[tuple[int, int], ...]:
        """First and last mass of each row; the ground is not counted as a connection."""
        joints = {e.at for e in self.elements if e.kind in "kd"}
        cuts = [0, *(i for i in range(1, self.n_masses) if i not in joints), self.n_masses]
        return tuple((a + 1, b) for a, b in pairwise(cuts))

    def united(self, other: "Structure") -> "Structure":
        """Structure with the elements of both: the smallest common supermodel in one numbering."""
        order = {kind: rank for rank, kind in enumerate("mkdb")}
        elements = sorted({*self.elements, *other.elements}, key=lambda e: (order[e.kind], e.at))
        size = max(self.n_masses, other.n_masses)
        return Structure(
            size,
            tuple(elements),
            self.ports,
            self.sensor_order,
            self.lag or other.lag,
            self.dead_time or other.dead_time,
        )
