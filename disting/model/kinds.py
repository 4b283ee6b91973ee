"""Changes at a mass by which a machine can be measured in another way: the one table of kinds.

A kind either moves a port, or holds the mass still, or adds size * s^power to A(s)[i, i]: a known
inertia J s^2, a known brake c s, a known spring to the ground k. Nothing else is known of it where
transfer functions, ranks, places and symmetries are computed, so a new kind is a row of KINDS.
"""

from dataclasses import dataclass

from disting.errors import InputError

HIGHEST = 2  # power of s in A(s) = M s^2 + D s + K


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Kind:
    """A row of the table; two are the same, and in order, by their `name`, as commands write it.

    `argument`: that of `Experiment`, none of kinds for networks alone. `is_port`: it moves a port;
    else `power` is that of s with which its size enters A(s)[i, i], None of what holds the mass and
    takes no size. `text`, with {at} and {size}, names it in an experiment, `item` and `anywhere` on
    a menu, `title` in a table; `sign` is drawn on the mass. `prices`: the names of what it costs,
    of which the cheapest is paid; `cost`: that of each where none is named, None: on a menu only
    where a cost is named. `always`: experiments without it state that where they are written, as
    they did before there were other kinds. Raises InputError for a power that A(s) does not have.
    """

    name: str
    argument: str = ""
    is_port: bool = False
    power: int | None = None
    text: str = ""
    item: str
    anywhere: str
    title: str
    sign: str = ""
    prices: tuple[str, ...]
    cost: float | None = None
    always: bool = False

    def __post_init__(self) -> None:
        if self.power is not None and not 0 <= self.power <= HIGHEST:
            raise InputError(f"{self.name}: A(s) has the powers 0 to {HIGHEST} of s only")

    def __repr__(self) -> str:
        return f"<{self.name}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Kind) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)

    def __lt__(self, other: "Kind") -> bool:
        return self.name < other.name

    @property
    def takes_size(self) -> bool:
        """True if it adds an element of a known size."""
        return self.power is not None

    @property
    def holds(self) -> bool:
        """True if it locks the mass."""
        return not (self.is_port or self.takes_size)

    @property
    def example(self) -> str:
        """Notation on the command line."""
        return f"{self.name}=1:0.5" if self.takes_size else f"{self.name}=2"


SENSOR = Kind(
    name="sensor",
    argument="sensor",
    is_port=True,
    item="a sensor at mass {}",
    anywhere="a sensor at any further mass, one more or the present one moved",
    title="sensor there, one more or moved",
    prices=("sensor", "move"),
    cost=1.0,
)
FORCE = Kind(
    name="force",
    argument="force",
    is_port=True,
    item="the force moved to mass {}",
    anywhere="the force moved to any other mass",
    title="force moved there",
    prices=("move",),
    cost=1.0,
)
INERTIA = Kind(
    name="inertia",
    argument="inertias",
    power=2,
    text="inertia {size} at mass {at}",
    item="a known inertia added to mass {}",
    anywhere="a known inertia added to any mass",
    title="known inertia added there",
    sign="J",
    prices=("inertia",),
    cost=2.0,
    always=True,
)
LOCK = Kind(
    name="lock",
    argument="locked",
    text="mass {at} locked",
    item="mass {} locked",
    anywhere="any mass locked that carries neither force nor sensor",
    title="mass locked",
    prices=("lock",),
    cost=3.0,
    always=True,
)
SPRING = Kind(
    name="spring",
    argument="springs",
    power=0,
    text="spring {size} at mass {at}",
    item="a known spring from mass {} to the ground",
    anywhere="a known spring from any mass to the ground",
    title="known spring to the ground there",
    sign="k",
    prices=("spring",),
    always=True,
)
BRAKE = Kind(
    name="brake",
    argument="brakes",
    power=1,
    text="brake {size} at mass {at}",
    item="a known brake at mass {}",
    anywhere="a known brake at any mass",
    title="known brake there",
    sign="c",
    prices=("brake",),
)
KINDS = (SENSOR, FORCE, INERTIA, LOCK, SPRING, BRAKE)
"""Of machines, in the order of menus, where costs are equal."""
CIRCUIT_KINDS = (
    Kind(
        name="sensor",
        is_port=True,
        item="the voltage at node {} measured",
        anywhere="the voltage at any further node measured",
        title="voltage measured there",
        prices=("sensor", "move"),
        cost=1.0,
    ),
    Kind(
        name="port",
        is_port=True,
        item="the impedance between node {} and the reference measured",
        anywhere="the impedance between any other node and the reference measured",
        title="impedance measured there",
        prices=("move",),
        cost=1.0,
    ),
    Kind(
        name="short",
        item="node {} shorted to the reference",
        anywhere="any node shorted to the reference",
        title="shorted to the reference there",
        prices=("short",),
        cost=3.0,
    ),
    Kind(
        name="resistor",
        power=0,
        item="a known resistor from node {} to the reference",
        anywhere="a known resistor from any node to the reference",
        title="known resistor to the reference there",
        prices=("resistor",),
        cost=2.0,
    ),
)
"""The same of circuits. The reference is the negative node of the port."""
COMPARTMENT_KINDS = (
    Kind(
        name="sensor",
        is_port=True,
        item="the contents of compartment {} measured",
        anywhere="the contents of any further compartment measured",
        title="contents measured there",
        prices=("sensor", "move"),
        cost=1.0,
    ),
    Kind(
        name="force",
        is_port=True,
        item="the input moved to compartment {}",
        anywhere="the input moved to any other compartment",
        title="input moved there",
        prices=("move",),
        cost=1.0,
    ),
)
ALL_KINDS = (*KINDS, *CIRCUIT_KINDS, *COMPARTMENT_KINDS)
CHANGES = tuple(sorted((k for k in KINDS if not k.is_port), key=lambda k: k.takes_size))
"""Those of the machine, in the order of an experiment's words: what is held still first."""
EXAMPLES = ", ".join(kind.example for kind in KINDS)
BY_NAME = {kind.name: kind for kind in KINDS}
COSTS = {price: k.cost for k in ALL_KINDS if k.cost is not None for price in k.prices}
PRICES = tuple(dict.fromkeys(price for kind in ALL_KINDS for price in kind.prices))
