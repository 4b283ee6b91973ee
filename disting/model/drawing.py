"""A chain in one line of text: for tables in a terminal."""

from disting.model.chain import Chain
from disting.model.structure import Damper, Element, GroundDamper, Ports, Spring

LEGEND = (
    "# ground, ~ spring, = spring and damper, comma: ground damper,\n"
    "F and f: force and its reference, S and s: sensor and its reference"
)


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
        parts.append(f"[{i}{_roles(ports or chain, i)}]" + "," * (GroundDamper(i) in elements))
        parts.append(_joint(elements, i) if i < chain.n_masses else "")
    return "".join(parts)


def _joint(elements: set[Element], i: int) -> str:
    if Spring(i) not in elements:
        return "   "
    return "=" if Damper(i) in elements else "~"


def _roles(at: Chain | Ports, i: int) -> str:
    places = {"F": at.act_plus, "f": at.act_minus, "S": at.meas_plus, "s": at.meas_minus}
    return "".join(sign for sign, at in places.items() if at == i)
