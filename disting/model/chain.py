"""A chain model: masses in a row, springs between neighbours, one gap, a force and a sensor
(section 5.1 of the paper).

Index 0 is the ground, which counts as the left neighbour of mass 1. There is a spring between all
neighbours except at the gap. The force acts with +F on mass `act_plus` and with -F on `act_minus`;
the sensor shows x[meas_plus] - x[meas_minus].

`text_drawing` is a chain in one line of text, for tables in a terminal; a chain with numbers is a
state space.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from disting.errors import ConstraintViolation, InputError, enumeration, short
from disting.model.presentation import LONGEST, NotebookPicture, plural, summary
from disting.model.structure import (
    Damper,
    Element,
    GroundDamper,
    Indices,
    Mass,
    Ports,
    Sort,
    Spring,
    Structure,
    violations,
)
from disting.quantities import Sensor as Sensor, as_sensor as as_sensor, sensor_of_model

if TYPE_CHECKING:
    import control
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from disting.algebra.symbols import Expr

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
    """What a name such as 3:4 leaves to be said: dampers beside the springs, the sensor quantity,
    and how else the machine is measured. A network says its dampers and its quantity itself: of it
    both are None.

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
    (0 = ground); the sensor quantity; `damped` = a damper beside every spring, as every name of a
    model means it too unless undamped is said; `ground_dampers` = the masses with a damper to the
    ground; `lag` = a first-order torque lag 1/(1 + T1 s) [T1 in s]; `dead_time` = a factor
    exp(-Td s) [Td in s]; `gap_damper` = a damper across the gap, such as the friction of a bearing
    between a rotor and its housing. The class of the paper does not have it: fits and simulations
    know it, verdicts on chains refuse it, and compare it as a network. Raises ConstraintViolation
    where (36) or (37) is broken, InputError for other bad values.

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
        """What its text in keys and files is made of: `gap_damper` only where there is one."""
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
        """How often what the sensor shows is differentiated."""
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
