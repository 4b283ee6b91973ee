"""What a chain is made of: masses, springs, dampers and ports.

A `Structure` is wider than a `Chain`: any set of joints may be present, so the supermodel of two
chains (condition 9), which has no gap, is a structure too. Elements know their parameter's name
and how they enter the equation of motion A(s) x = e_act F with A(s) = M s^2 + D s + K: each adds
parameter * s^power * v v^T for a vector v of the masses.

The constraints (36), (37) and (38) of the paper, each a named predicate with its equation
number.

(36) says where a port may be, (37) that every mass is excited and measured, (38) breaks the
symmetry between models that differ in the numbering only. A chain that breaks (36) or (37) is no
model; one that breaks (38) is a model with another numbering, so it can be made and compared but
is not listed in a family.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from disting.quantities import refuse_improper


class Sort(StrEnum):
    """What a model is of; its elements are all of one sort."""

    MACHINE = "machine"
    CIRCUIT = "circuit"
    COMPARTMENTS = "compartments"


class Indices(NamedTuple):
    """Size and the five indices of section 5.1; index 0 is the ground."""

    n_masses: int
    gap: int
    act_minus: int
    act_plus: int
    meas_minus: int
    meas_plus: int


@dataclass(frozen=True, slots=True)
class Constraint:
    """One line of an equation: its number, its text in the paper's symbols, the predicate itself,
    and, of what a chain may break, what is wrong and possible instead.
    """

    equation: int
    name: str
    text: str
    holds: Callable[[Indices], bool]
    words: str = ""

    def refusal(self, i: Indices) -> str:
        """What is said of a chain that breaks it: in words, then in the paper's symbols."""
        said = self.words.format(**i._asdict(), low=i.gap + 1, highest_gap=i.n_masses - 1)
        return (
            f"{said} (constraint ({self.equation}) {self.text} is violated by N_B={i.n_masses},"
            f" n_gap={i.gap}, n_act-={i.act_minus}, n_act+={i.act_plus}, n_meas-={i.meas_minus},"
            f" n_meas+={i.meas_plus})"
        )


CONSTRAINTS: tuple[Constraint, ...] = (
    Constraint(
        36,
        "gap-range",
        "0 <= n_gap <= N_B - 1",
        lambda i: 0 <= i.gap <= i.n_masses - 1,
        "the gap lies above mass 0 (the ground) to {highest_gap}, not {gap}",
    ),
    Constraint(
        36,
        "force-reference",
        "0 <= n_act- <= n_gap",
        lambda i: 0 <= i.act_minus <= i.gap,
        "the force acts across the gap, against mass 0 (the ground) to {gap}, not {act_minus}",
    ),
    Constraint(
        36,
        "force",
        "n_gap + 1 <= n_act+ <= N_B",
        lambda i: i.gap + 1 <= i.act_plus <= i.n_masses,
        "the force acts on a mass from {low} to {n_masses}, not {act_plus}",
    ),
    Constraint(
        36,
        "sensor-reference",
        "0 <= n_meas- <= n_gap",
        lambda i: 0 <= i.meas_minus <= i.gap,
        "the sensor looks across the gap, from mass 0 (the ground) to {gap}, not {meas_minus}",
    ),
    Constraint(
        36,
        "sensor",
        "n_gap + 1 <= n_meas+ <= N_B",
        lambda i: i.gap + 1 <= i.meas_plus <= i.n_masses,
        "the sensor is at a mass from {low} to {n_masses}, not {meas_plus}",
    ),
    Constraint(
        37,
        "excitability",
        "n_gap = 0 or n_act- > 0",
        lambda i: i.gap == 0 or i.act_minus > 0,
        "nothing moves the masses below the gap: the force acts against one of 1 to {gap}, not the"
        " ground",
    ),
    Constraint(
        37,
        "sensitivity",
        "n_gap = 0 or n_meas- > 0",
        lambda i: i.gap == 0 or i.meas_minus > 0,
        "nothing shows the masses below the gap: the sensor looks from one of 1 to {gap}, not the"
        " ground",
    ),
    Constraint(
        38, "reciprocity-breaking", "n_act+ <= n_meas+", lambda i: i.act_plus <= i.meas_plus
    ),
    Constraint(
        38,
        "reflection-breaking",
        "n_act+ <= n_gap + ceil((N_B - n_gap)/2)",
        lambda i: i.act_plus <= i.gap + (i.n_masses - i.gap + 1) // 2,
    ),
)


def violations(indices: Indices, equations: tuple[int, ...]) -> Iterator[Constraint]:
    """Yield the constraints of the given equations that the indices break, in the paper's order."""
    return (c for c in CONSTRAINTS if c.equation in equations and not c.holds(indices))


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
        refuse_improper(self.sensor_order)

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Parameter names in the order of the elements, then T1 and Td."""
        return (
            *(e.parameter for e in self.elements),
            *(["T1"] if self.lag else []),
            *(["Td"] if self.dead_time else []),
        )

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
