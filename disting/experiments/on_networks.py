"""Networks under one further experiment, as matrices of transfer functions.

With the transfer functions T from the inputs and from one node i to the outputs and to that node,
all in one sensor quantity s^q, whatever is done at the node is seen without another network:

    a sensor there:  T_is          something known, h(s) = s^r:  T_os - h T_oi T_is/(s^q + h T_ii)
    a force there:   T_oi          the node held at zero:        T_os - T_oi T_is/T_ii
    both there:      T_ii

As all values of a network may be given in other units, the known one has size 1. Derivation: what
the node feels from outside is a force f = -h x_i, or the one that makes x_i = 0.
"""

from dataclasses import dataclass, replace

from disting.algebra.rational_function import RationalFunction
from disting.experiments.menu import Gain
from disting.general.matrix_model import MatrixModel, of_ratios
from disting.general.model import network_powers, network_ratios
from disting.model.kinds import Kind
from disting.network.element import Port
from disting.network.network import Network

Ratios = tuple[tuple[RationalFunction, ...], ...]


@dataclass(frozen=True, slots=True)
class Measured:
    """A network with what one further experiment shows: `model`, and what is gained by it."""

    model: MatrixModel
    gain: Gain


def measured(network: Network, kind: Kind, node: int, name: str) -> Measured:
    """The network as it is and with one kind of further experiment at a node; raises InputError.

    >>> from disting.model.kinds import LOCK
    >>> from disting.network import network_of
    >>> print(measured(network_of("1~2; F1; S1"), LOCK, 2, "").model.rows[1][0])
    G(s) = s**2/(k12 + m1*s**2)
    """
    there = Port(node, network.reference)
    ports = (*network.inputs, there), (*network.outputs, there)
    whole = network_ratios(replace(network, inputs=ports[0], outputs=ports[1]))
    now = tuple(row[:-1] for row in whole[:-1])
    more = _shown(kind, whole, network)
    width = len(network.inputs)
    cells = [x for row in more for x in row]
    zero = cells[0] - cells[0]
    cells += [zero] * (-len(cells) % width)
    rows = [*now, *(tuple(cells[i : i + width]) for i in range(0, len(cells), width))]
    powers = network_powers(cells + [x for row in now for x in row], network)
    model = of_ratios(rows, network.parameters, name, powers)
    return Measured(model, _gain(kind, whole, now, more))


def _shown(kind: Kind, whole: Ratios, network: Network) -> Ratios:
    """What the further experiment shows. T_ii is not zero: a node of positive elements moves where
    it is pushed.
    """
    *outer, last = whole
    moved = tuple((row[-1],) for row in outer)
    if kind.is_port:
        shown: dict[str, Ratios] = {"sensor": (last[:-1],), "force": moved, "port": ((last[-1],),)}
        return shown[kind.name]
    below = last[-1]
    if kind.power is not None:
        s = below.num.context().gen(0)
        step = 2 if network.halves else 1
        one = s**0
        known = RationalFunction(s ** (step * kind.power), one)
        quantity = RationalFunction(s ** (step * network.order), one)
        below = quantity / known + below
    return tuple(
        tuple(x - there * left / below for x, left in zip(row[:-1], last[:-1], strict=True))
        for row, (there,) in zip(outer, moved, strict=True)
    )


def _gain(kind: Kind, whole: Ratios, now: Ratios, more: Ratios) -> Gain:
    """SILENT where nothing is seen; REPEATS where all that is seen is seen already, but for its
    sign, or follows from it, as force and sensor are at the node to which something is added.
    """
    seen = [x for row in more for x in row if not x.num.is_zero()]
    if not seen:
        return Gain.SILENT
    known = [x for row in now for x in row]
    if all(x in known or -x in known for x in seen):
        return Gain.REPEATS
    collocated = all(x == seen_at for row in whole for x in row for seen_at in known)
    return Gain.REPEATS if kind.takes_size and collocated else Gain.NEW
