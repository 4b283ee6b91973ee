"""Networks under several experiments with one vector of values: a matrix of transfer functions.

A force or a sensor at another place is another port. A change at node i is computed without another
network: with the transfer functions T from all forces and from i to all sensors and to i, in one
sensor quantity s^q,

    something known added there, h(s) = size s^r:  T_os - h T_oi T_is/(s^q + h T_ii)
    the node held at zero:                         T_os - T_oi T_is/T_ii

Derivation: what the node feels from outside is a force f = -h x_i, or the one that makes x_i = 0.
Several things are done one after the other.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from disting.algebra.symbols import RationalFunction
from disting.errors import InputError
from disting.experiments.experiment import AnyStructure, Experiment, MeasuredChain, Place
from disting.experiments.menu import Gain
from disting.general.any_model import as_chain
from disting.general.matrix_model import AnyModel, MatrixModel, of_ratios
from disting.general.response import network_powers, network_ratios
from disting.model.chain import Chain, Sort
from disting.model.kinds import Kind
from disting.model.presentation import summary
from disting.network import Network, Port

Ratios = tuple[tuple[RationalFunction, ...], ...]
"""Outputs x inputs."""
NO_PLACES = "{} is given by formulas: they have no masses to measure at"
ONLY_MACHINES = (
    "experiments are on machines, whose masses have numbers; of a circuit or of compartments"
    " 'disting next' tells what a further measurement at a node shows"
)


@dataclass(frozen=True, slots=True)
class Setup:
    """One way to measure a network: where force and sensor are and how often the sensor
    differentiates, None: as in the network; `changes`: (node, power of s, size) of what is added
    there, the power is None of what is held.
    """

    force: Port | None = None
    sensor: Port | None = None
    order: int | None = None
    changes: tuple[tuple[int, int | None, Fraction], ...] = ()


@dataclass(frozen=True)
class MeasuredNetwork:
    """A machine under several experiments, which name its masses; raises InputError.

    >>> from disting.network import network_of
    >>> MeasuredNetwork(network_of("1~2; F1; S1"), (Experiment(), Experiment(locked=2))).model.shape
    (2, 1)
    """

    network: Network
    experiments: tuple[Experiment, ...]

    def __post_init__(self) -> None:
        if not self.experiments:
            raise InputError("at least one experiment is needed")
        if self.network.sort is not Sort.MACHINE:
            raise InputError(ONLY_MACHINES)
        for experiment in self.experiments:
            experiment.refuse(self.network)

    def __repr__(self) -> str:
        return summary(self, f"{self.network.name} | {' | '.join(self.text)}")

    @property
    def text(self) -> tuple[str, ...]:
        """The experiments in words."""
        return tuple(e.text for e in self.experiments)

    @cached_property
    def blocks(self) -> tuple[Ratios, ...]:
        """The transfer functions in each experiment; raises InputError if they are too large."""
        return responses(self.network, [_setup(e, self.network) for e in self.experiments])

    def is_plain(self, at: int) -> bool:
        """Return True if one of its experiments (counted from 0) is that of the unmodified
        network.
        """
        return self.experiments[at] == Experiment()

    @property
    def silent(self) -> tuple[int, ...]:
        """Experiments, from 0, in which the sensor never moves: their transfer function is zero."""
        return tuple(i for i, block in enumerate(self.blocks) if not _nonzero(block))

    @property
    def model(self) -> MatrixModel:
        """All transfer functions, those of the first experiment first; raises InputError."""
        return _stack(self.blocks, self.network, self.network.name)


def structure_of(model: Chain | AnyModel) -> AnyStructure:
    """The chain or the machine network that a model is, whose masses experiments name; raises
    InputError.
    """
    if isinstance(model, Chain):
        return model
    structure = as_chain(model) or model.network
    if structure is None:
        raise InputError(NO_PLACES.format(model.name))
    if structure.sort is not Sort.MACHINE:
        raise InputError(ONLY_MACHINES)
    return structure


def measure(
    model: Chain | AnyModel, experiments: tuple[Experiment, ...]
) -> MeasuredChain | MeasuredNetwork:
    """A chain or a machine network under experiments; raises InputError."""
    structure = structure_of(model)
    if isinstance(structure, Chain):
        return MeasuredChain(structure, experiments)
    return MeasuredNetwork(structure, experiments)


def further_model(network: Network, kind: Kind, node: int, name: str) -> tuple[MatrixModel, Gain]:
    """The network as it is and with one kind of further experiment at a node, and what is gained;
    raises InputError.

    As all values of a network may be given in other units, what is added there has the size 1.

    >>> from disting.model.kinds import LOCK
    >>> from disting.network import network_of
    >>> print(further_model(network_of("1~2; F1; S1"), LOCK, 2, "")[0].rows[1][0])
    G(s) = s**2/(k12 + m1*s**2)
    """
    port = Port(node, network.reference)
    around = Setup(), Setup(sensor=port), Setup(port), Setup(port, port)
    ports = dict(zip(("", "sensor", "force", "port"), around, strict=True))
    changed = Setup(changes=((node, kind.power, Fraction(1)),))
    setup = ports[kind.name] if kind.is_port else changed
    more, *whole = responses(network, (setup, *around))
    model = _stack((whole[0], more), network, name)
    return model, _gain(kind, more, whole)


def responses(network: Network, setups: Sequence[Setup]) -> tuple[Ratios, ...]:
    """The transfer functions in each way to measure the network, in lowest terms, outputs x inputs;
    raises InputError where they are too large.
    """
    ports = dict.fromkeys(p for s in setups for p in (s.force, s.sensor, *_nodes(s, network)) if p)
    extra = {port: number for number, port in enumerate(ports)}
    whole = network_ratios(
        replace(network, inputs=(*network.inputs, *extra), outputs=(*network.outputs, *extra))
    )
    return tuple(_block(setup, whole, network, extra) for setup in setups)


def _block(setup: Setup, whole: Ratios, network: Network, extra: dict[Port, int]) -> Ratios:
    """The transfer functions in one way to measure, from those between all ports, the further ones
    behind those of the network.
    """
    (n_out, n_in), nodes = network.shape, [extra[port] for port in _nodes(setup, network)]
    rows = range(n_out) if setup.sensor is None else [n_out + extra[setup.sensor]]
    columns = range(n_in) if setup.force is None else [n_in + extra[setup.force]]
    across = (*columns, *(n_in + k for k in nodes))
    cells = [[whole[r][c] for c in across] for r in (*rows, *(n_out + k for k in nodes))]
    for at, (_, power, size) in enumerate(setup.changes):
        known = None if power is None else _power(whole, network, network.order - power, 1 / size)
        cells = _change_functions(cells, len(rows) + at, len(columns) + at, known)
    block = tuple(tuple(row[: len(columns)]) for row in cells[: len(rows)])
    if setup.order is None:
        return block
    by = _power(whole, network, setup.order - network.order)
    return tuple(tuple(x * by for x in row) for row in block)


def _change_functions(
    cells: list[list[RationalFunction]], row: int, column: int, known: RationalFunction | None
) -> list[list[RationalFunction]]:
    """All transfer functions with something done at the node of this row and column; `known`:
    s^q/h, None of what is held. A node that is already locked is not affected.
    """
    own = cells[row][column]
    below = own if known is None else known + own
    if own.num.is_zero():
        return cells
    return [
        [x - other[column] * left / below for x, left in zip(other, cells[row], strict=True)]
        for other in cells
    ]


def _nodes(setup: Setup, network: Network) -> list[Port]:
    return [Port(node, network.reference) for node, _, _ in setup.changes]


def _power(
    whole: Ratios, network: Network, exponent: int, size: Fraction = Fraction(1)
) -> RationalFunction:
    """size * s^exponent in the ring of the transfer functions."""
    s = whole[0][0].num.context().gen(0)
    unit = s**0
    ratio = RationalFunction(s ** (2 if network.halves else 1), unit) ** exponent
    return ratio * RationalFunction(unit * size.numerator, unit * size.denominator)


def _stack(blocks: Sequence[Ratios], network: Network, name: str) -> MatrixModel:
    """One matrix as wide as the first block; the cells of the others follow row by row, filled up
    with zeros.
    """
    first, *rest = blocks
    width, cells = len(first[0]), [x for block in rest for row in block for x in row]
    zero = first[0][0] - first[0][0]
    cells += [zero] * (-len(cells) % width)
    rows = [*first, *(tuple(cells[i : i + width]) for i in range(0, len(cells), width))]
    powers = network_powers([x for row in rows for x in row], network)
    return of_ratios(rows, network.parameters, name, powers)


def _gain(kind: Kind, more: Ratios, whole: Sequence[Ratios]) -> Gain:
    """SILENT where nothing is measured; REPEATS where all that is measured is known already, up to
    its sign, or follows from it, as force and sensor are at the node to which something is added.
    `whole`: as it is, and with the sensor, the force, and both at the node.
    """
    measured = _nonzero(more)
    if not measured:
        return Gain.SILENT
    known = [x for row in whole[0] for x in row]
    if all(x in known or -x in known for x in measured):
        return Gain.REPEATS
    collocated = all(x == y for block in whole for row in block for x in row for y in known)
    return Gain.REPEATS if kind.takes_size and collocated else Gain.NEW


def _nonzero(block: Ratios) -> list[RationalFunction]:
    return [x for row in block for x in row if not x.num.is_zero()]


def _setup(experiment: Experiment, network: Network) -> Setup:
    def port(at: Place | None) -> Port | None:
        """A port of the network there."""
        return None if at is None else Port(*at)

    changes = tuple((c.place, c.kind.power, c.size or Fraction(1)) for c in experiment.changes)
    order = None if experiment.quantity is None else experiment.quantity.order
    return Setup(port(experiment.force), port(experiment.sensor), order, changes)
