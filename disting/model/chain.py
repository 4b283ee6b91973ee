"""A chain model: masses in a row, springs between neighbours, one gap, a force and a sensor
(section 5.1 of the paper).

Index 0 is the ground, which counts as the left neighbour of mass 1. There is a spring between all
neighbours except at the gap. The force acts with +F on mass `act_plus` and with -F on `act_minus`;
the sensor shows x[meas_plus] - x[meas_minus].

`text_drawing` is a chain in one line of text, for tables in a terminal; a chain with numbers is a
state space.

A chain is made of masses, springs, dampers and ports. A `Structure` is wider than a `Chain`: any
set of joints may be present, so the supermodel of two chains (condition 9), which has no gap, is a
structure too. Elements know their parameter's name and how they enter the equation of motion
A(s) x = e_act F with A(s) = M s^2 + D s + K: each adds parameter * s^power * v v^T for a vector v
of the masses.

The constraints (36), (37) and (38) of the paper are predicates, each with its equation number. (36)
restricts the places of ports, (37) requires that every mass is excited and measured, (38) breaks
the symmetry between models that differ in the numbering only. A chain that breaks (36) or (37) is
no model; one that breaks (38) is a model with another numbering, so it can be made and compared but
is not listed in a family.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from enum import StrEnum
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from disting.errors import ConstraintViolation, InputError, enumeration, short
from disting.model.presentation import LONGEST, NotebookPicture, plural, summary
from disting.quantities import (
    Sensor as Sensor,
    as_sensor as as_sensor,
    refuse_improper,
    sensor_of_model,
)

if TYPE_CHECKING:
    import control
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from disting.algebra.symbols import Expr


class Sort(StrEnum):
    """Physical domain of a model; its elements are all of one domain."""

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
        """Message about a chain that violates it: in words, then in the paper's symbols."""
        words = self.words.format(**i._asdict(), low=i.gap + 1, highest_gap=i.n_masses - 1)
        return (
            f"{words} (constraint ({self.equation}) {self.text} is violated by N_B={i.n_masses},"
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
    """Damper in parallel with the spring of node `at`; parameter d_ij [N s/m or N m s/rad]."""

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
    """Known term of A(s)[at, at], with that power of s: its size is known and no parameter.

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


if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StateSpace:
    """x' = A x + B u, y = C x + D u of a chain; states: positions, velocities, the lag's force;
    `delay` of the input [s]; `states` by name, `units` of states, of the input u and the output y
    where the parameters are in SI units of translation.
    """

    A: "Real"
    B: "Real"
    C: "Real"
    D: "Real"
    delay: float
    states: tuple[str, ...]
    units: dict[str, str]

    def __repr__(self) -> str:
        return summary(
            self,
            plural(len(self.A), "state") + (f", dead time {self.delay:g} s" if self.delay else ""),
        )


AS_IT_IS = "as it is"  # an experiment that changes nothing, in words
PORTS = (0, 0, 1, 0, 1)  # gap, ends of the force and of the sensor, where nothing is said
LEGEND = (
    "# ground, ~ spring, = spring and damper, comma: ground damper,\n"
    "F and f: force and its reference, S and s: sensor and its reference"
)


@dataclass(frozen=True, slots=True)
class Premise:
    """Premise that a name such as 3:4 does not state: dampers in parallel with the springs, the
    sensor quantity, and further changes of the measurement. A network states its dampers and its
    quantity itself: for it both are None.

    >>> str(Premise(True, Sensor.ACCELERATION, ("as it is", "sensor 3, mass 2 locked")))
    'damped, acceleration, measured as it is and with sensor 3, mass 2 locked'
    """

    damped: bool | None
    quantity: Sensor | None
    experiments: tuple[str, ...] = ()

    def __str__(self) -> str:
        ways = " and ".join(t if t == AS_IT_IS else f"with {t}" for t in self.experiments)
        how = [f"measured {ways}"] if ways else []
        if self.quantity is None:
            return "".join(how)
        return ", ".join(["damped" if self.damped else "undamped", self.quantity.value, *how])

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        plain: dict[str, object] = {}
        if self.quantity is not None:
            plain = {"damped": self.damped, "quantity": self.quantity.value}
        return plain | ({"experiments": list(self.experiments)} if self.experiments else {})

    @staticmethod
    def from_dict(data: Mapping[str, Any]) -> "Premise":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        experiments = tuple(map(str, data.get("experiments", ())))
        if data.keys() == {"experiments"}:
            return Premise(None, None, experiments)
        if type(data["damped"]) is not bool:
            raise TypeError("whether a chain is damped is true or false")
        return Premise(data["damped"], Sensor(data["quantity"]), experiments)


@dataclass(frozen=True, slots=True)
class Chain(NotebookPicture):
    """One chain model; immutable and hashable, its content is its identity.

    Arguments: `n_masses` = N_B; the indices n_gap, n_act-, n_act+, n_meas-, n_meas+ of section 5.1
    (0 = ground); the sensor quantity; `damped` = a damper in parallel with every spring, the
    default of every name of a model; `ground_dampers` = the masses with a damper to the ground;
    `lag` = a first-order torque lag 1/(1 + T1 s) [T1 in s]; `dead_time` = a factor exp(-Td s) [Td
    in s]; `gap_damper` = a damper across the gap, such as the friction of a bearing between a rotor
    and its housing. The class of the paper does not have it: fits and simulations know it, verdicts
    on chains refuse it, and compare it as a network. Raises ConstraintViolation where (36) or (37)
    is broken, InputError for other bad values.

    >>> Chain(2, gap=1, act_minus=1, act_plus=2, meas_minus=1, meas_plus=2).parameters
    ('m1', 'm2', 'k01', 'd01')
    """

    n_masses: int
    gap: int = 0
    act_minus: int = 0
    act_plus: int = 1
    meas_minus: int = 0
    meas_plus: int = 1
    sensor: Sensor = Sensor.ACCELERATION
    damped: bool = True
    ground_dampers: tuple[int, ...] = ()
    lag: bool = False
    dead_time: bool = False
    gap_damper: bool = False

    def __post_init__(self) -> None:
        if any(
            isinstance(i, bool) or not isinstance(i, int)
            for i in (*self.indices, *self.ground_dampers)
        ):
            raise InputError(
                "the size, the indices and the ground dampers of a chain are whole numbers"
            )
        for name in ("damped", "lag", "dead_time", "gap_damper"):
            if not isinstance(getattr(self, name), bool):
                raise InputError(f"{name} is True or False, not {short(getattr(self, name))}")
        if self.gap_damper and not self.gap:
            raise InputError(
                "there is no gap for a damper across it: name a ground damper at mass 1"
            )
        if self.n_masses < 1:
            raise InputError(f"a chain has at least one mass, not {self.n_masses}")
        for broken in violations(self.indices, (36, 37)):
            raise ConstraintViolation(broken.refusal(self.indices))
        object.__setattr__(self, "sensor", sensor_of_model(self.sensor))
        object.__setattr__(self, "ground_dampers", _damper_set(self.ground_dampers, self.n_masses))

    def __repr__(self) -> str:
        from disting.model.names import name_of  # names are made of chains

        line = f"<Chain: {name_of(self)} {text_drawing(self)}, {self.premise}>"
        return line if len(line) <= LONGEST else f"{line[: LONGEST - 2]}…>"

    def transfer_function(self) -> "Expr":
        """G(s) from force to sensor as a SymPy expression in s and positive symbols named as the
        parameters [kg, N/m, N s/m, s]; equation (24), with lag and dead time.

        >>> Chain(1, ground_dampers=(1,), damped=False).transfer_function()
        s/(b1 + m1*s)
        """
        return self._presenter.transfer_function(self)

    def frequency_response(
        self, values: Mapping[str, float], omega: "ArrayLike"
    ) -> "NDArray[np.complex128]":
        """G(j omega) with numbers: complex array of the shape of `omega` [rad/s], shape (n_f,).

        `values`: one for each of `parameters`, in SI units [kg, N/m, N s/m, s] or, of rotation,
        [kg m^2, Nm/rad, Nm s/rad, s]; the response is then in m, m/s or m/s^2 per N, or in rad,
        rad/s or rad/s^2 per Nm. Raises InputError for missing, unknown or negative values, and at
        an undamped resonance.

        >>> abs(Chain(1, damped=False, sensor="velocity").frequency_response({"m1": 2.0}, [1, 10]))
        array([0.5 , 0.05])
        """
        response: NDArray[np.complex128] = self._presenter.frequency_response(self, values, omega)
        return response

    def state_space(self, values: Mapping[str, float]) -> "StateSpace":
        """x' = A x + B u, y = C x + D u with numbers, equations (20) to (23), and the `delay` of
        the input [s], which is in no matrix.

        States, in this order: positions x1.. [m], velocities v1.. [m/s], of a lag the force [N];
        `states` and `units` of what is returned name them. `values` and errors as in
        `frequency_response`.

        >>> space = Chain(1, damped=False, sensor="position").state_space({"m1": 2.0})
        >>> space.states, space.B.tolist(), space.units["y"]
        (('x1', 'v1'), [[0.0], [0.5]], 'm')
        """
        space: StateSpace = self._presenter.state_space(self, values)
        return space

    def to_control(self, values: Mapping[str, float]) -> "control.StateSpace":
        """A `control.StateSpace` of python-control, its states, input u and output y named, without
        the dead time; `values` and errors as in `frequency_response`. Raises InputError where
        python-control is not installed (`pip install "disting[control]"`).

        >>> drive = Chain(1, damped=False, sensor="position").to_control({"m1": 2.0})
        >>> drive.nstates, drive.state_labels, complex(drive(1j))
        (2, ['x1', 'v1'], (-0.5+0j))
        """
        return self._presenter.to_control(self, values)

    @property
    def written_fields(self) -> dict[str, Any]:
        """Fields of its text in keys and files: `gap_damper` only where there is one."""
        names = [f.name for f in fields(self) if f.name != "gap_damper" or self.gap_damper]
        return {name: getattr(self, name) for name in names}

    @property
    def indices(self) -> Indices:
        """Size and the five indices, in the order in which a family is numbered."""
        return Indices(
            self.n_masses, self.gap, self.act_minus, self.act_plus, self.meas_minus, self.meas_plus
        )

    @property
    def sort(self) -> Sort:
        """A machine, as of a network."""
        return Sort.MACHINE

    @property
    def order(self) -> int:
        """Number of time derivatives of the position that the sensor measures."""
        return self.sensor.order

    @property
    def premise(self) -> Premise:
        """Damping and sensor quantity."""
        return Premise(self.damped, self.sensor)

    @property
    def structure(self) -> Structure:
        """The elements and ports of this chain, as a graph knows them."""
        return _structure(self)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Parameter names in fixed order: m1.., k01.., d01.., b1.., T1, Td."""
        return self.structure.parameters

    @property
    def collocated(self) -> bool:
        """Force and sensor at the same place (marked with an asterisk in Table 3)."""
        return (self.act_minus, self.act_plus) == (self.meas_minus, self.meas_plus)

    def __str__(self) -> str:
        ports = f"force {self.act_plus}-{self.act_minus}, sensor {self.meas_plus}-{self.meas_minus}"
        dampers = "+".join(map(str, self.ground_dampers))
        extras = [self.sensor.value] if self.sensor is not Sensor.ACCELERATION else []
        extras += ["damped"] if self.damped else []
        extras += [f"ground dampers {dampers}"] if dampers else []
        extras += ["damper across the gap"] if self.gap_damper else []
        extras += ["lag"] if self.lag else []
        extras += ["dead time"] if self.dead_time else []
        return ", ".join([f"{self.n_masses} masses, gap {self.gap}, {ports}", *extras])


@lru_cache(maxsize=10_000)  # asked for again and again, dearer to make than to find
def _structure(chain: Chain) -> Structure:
    joints = [i for i in range(chain.n_masses) if i != chain.gap]
    across = [chain.gap] if chain.gap_damper else []
    elements: list[Mass | Spring | Damper | GroundDamper] = [
        Mass(i) for i in range(1, chain.n_masses + 1)
    ]
    elements += [Spring(i) for i in joints]
    elements += [Damper(i) for i in sorted([*(joints if chain.damped else []), *across])]
    elements += [GroundDamper(i) for i in chain.ground_dampers]
    ports = Ports(chain.act_minus, chain.act_plus, chain.meas_minus, chain.meas_plus)
    return Structure(
        chain.n_masses, tuple(elements), ports, chain.sensor.order, chain.lag, chain.dead_time
    )


def _damper_set(masses: Iterable[int], n_masses: int) -> tuple[int, ...]:
    chosen = tuple(sorted(set(masses)))
    if chosen and not 1 <= chosen[0] <= chosen[-1] <= n_masses:
        wrong = enumeration(str(i) for i in chosen if not 1 <= i <= n_masses)
        raise InputError(f"ground dampers sit at masses 1 to {n_masses}, not at {wrong}")
    return chosen


def text_drawing(chain: Chain, ports: Ports | None = None) -> str:
    """The chain from left to right, with its own ports or others; references to the ground are not
    drawn.

    >>> ports = {"act_minus": 1, "act_plus": 2, "meas_minus": 1, "meas_plus": 3}
    >>> text_drawing(Chain(3, gap=1, **ports, damped=True))
    '#=[1fs]   [2F]=[3S]'
    """
    elements = set(chain.structure.elements)
    parts = ["#" + _joint(elements, 0)] if Spring(0) in elements else []
    for i in range(1, chain.n_masses + 1):
        damper = "," if GroundDamper(i) in elements else ""
        parts.append(f"[{i}{_roles(ports or chain, i)}]{damper}")
        parts.append(_joint(elements, i) if i < chain.n_masses else "")
    return "".join(parts)


def _joint(elements: set[Element], i: int) -> str:
    if Spring(i) not in elements:
        return " - " if Damper(i) in elements else "   "
    return "=" if Damper(i) in elements else "~"


def _roles(at: Chain | Ports, i: int) -> str:
    places = {"F": at.act_plus, "f": at.act_minus, "S": at.meas_plus, "s": at.meas_minus}
    return "".join(sign for sign, at in places.items() if at == i)
