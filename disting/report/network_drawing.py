"""A network as an engineer sketches it: machines with masses, springs, dampers and ground,
compartments with arrows (`graph_drawing`), circuits in series and parallel as circuit diagrams
(`circuit_drawing`), other circuits as graphs.
"""

from functools import lru_cache

from disting.general import AnyModel, as_chain
from disting.model.chain import Chain, Sensor
from disting.model.structure import Sort
from disting.network import Element, Network
from disting.report.circuit_drawing import circuit_layers, series_parallel
from disting.report.drawing import draw
from disting.report.graph_drawing import graph_layers, port_signs
from disting.report.png import png
from disting.report.scene import Scene, frame
from disting.report.svg import svg
from disting.report.words import plural


def network_svg(network: Network) -> str:
    """Stand-alone SVG of a network.

    >>> from disting import network_of
    >>> network_svg(network_of("R0-p(R1,C1)"))[:4]
    '<svg'
    """
    return svg(draw_network(network))


def network_png(network: Network, *, scale: float = 3) -> bytes:
    """PNG of a network, `scale` pixels a unit. Raises InputError for a scale that is no positive
    number.

    >>> from disting import network_of
    >>> network_png(network_of("1=2=3, 2=4; F1; S4"))[1:4]
    b'PNG'
    """
    return png(draw_network(network), scale=scale)


def scene_of(model: Chain | AnyModel) -> Scene | None:
    """The drawing of a chain, or of a model that is a chain or a network; None of another one."""
    chain = as_chain(model)
    if chain is not None:
        return draw(chain)
    network = model.network if not isinstance(model, Chain) else None
    return draw_network(network) if network is not None else None


@lru_cache(maxsize=1_000)
def draw_network(network: Network) -> Scene:
    """The drawing of a network; each of its elements is one layer, named like its value."""
    whole = series_parallel(network)
    layers = circuit_layers(whole) if whole else graph_layers(network)
    return frame(layers, describe_network(network))


def describe_network(network: Network) -> str:
    """The network in words.

    >>> from disting.network.notation import network_of
    >>> describe_network(network_of("1>2, 2>0; in 1; out 2"))
    '2 compartments: a12 from 1 to 2, a20 from 2 to the outside; in at 1; out at 2.'
    """
    what = {
        Sort.MACHINE: plural(len(network.nodes), "mass", "masses"),
        Sort.CIRCUIT: plural(len(network.elements), "element"),
        Sort.COMPARTMENTS: plural(len(network.nodes), "compartment"),
    }[network.sort]
    joints = [_in_words(e, network.sort) for e in network.elements if e.kind.ends == 2]
    end = "the ground" if network.sort is Sort.MACHINE else "the outside"
    ports = []
    sides = network.inputs, network.outputs
    for signs, side in zip(port_signs(network), sides, strict=True):
        for sign, p in zip(signs, side, strict=True):
            other = f" against {p.minus or end}" if p.minus or network.sort is Sort.CIRCUIT else ""
            shown = f" ({list(Sensor)[network.order]})" if sign[0] == "y" else ""
            ports.append(f"{sign}{shown} at {p.plus}{other}")
    if network.inputs == network.outputs and network.sort is Sort.CIRCUIT:
        ports = [f"port between {p.plus} and {p.minus}" for p in network.inputs]
    return f"{what}: {', '.join(joints)}; {'; '.join(ports)}."


def _in_words(e: Element, sort: Sort) -> str:
    a, b = e.nodes
    if sort is Sort.COMPARTMENTS:
        return f"{e.value} from {a} to {b or 'the outside'}"
    ground = "the ground" if sort is Sort.MACHINE else "0"
    ratio = f", ratio {e.ratio}" if e.ratio else ""
    return f"{e.value} between {a or ground} and {b or ground}{ratio}"
