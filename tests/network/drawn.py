"""Random networks of up to five nodes for hypothesis: machines with masses, inerters, dampers,
springs and gears, circuits with Warburg and constant phase elements, compartments; several ports; parts that float,
hang, or are not held at all.
"""

from hypothesis import strategies as st

from disting.errors import InputError
from disting.network import Element, Network, Port

RATIOS = st.sampled_from(["", "", "", "g", "g2", "3", "2/3", "1", "0.5"])
LETTERS = ["mmjdk", "RLCW", "RLC", "RLCPPW", "a"]
EXPONENTS = st.sampled_from(["na", "nb"])  # elements share them


@st.composite
def descriptions(draw, most_nodes=5, most_elements=9, most_ports=2):
    """Elements, inputs, outputs and order, which may make no network."""
    letters = draw(st.sampled_from(LETTERS))
    top = draw(st.integers(1, most_nodes))
    node, ground = st.integers(1, top), st.integers(0, top)
    elements = []
    for k in range(draw(st.integers(1, most_elements))):
        letter = draw(st.sampled_from(letters))
        ends = (draw(node),) if letter == "m" else (draw(node), draw(ground))
        ratio = draw(RATIOS) if letter in "jdk" and 0 not in ends and top > 1 else ""
        if len(set(ends)) == len(ends):
            exponent = draw(EXPONENTS) if letter == "P" else ""
            elements.append(Element(f"{letter}{k}", letter, ends, ratio, exponent))
    if letters == "a":
        elements += [Element("", "v", (i,)) for i in range(1, top + 1)]
    ports = st.lists(st.builds(Port, node, ground), min_size=1, max_size=most_ports)
    inputs = tuple(draw(ports))
    outputs = inputs if draw(st.booleans()) else tuple(draw(ports))
    return tuple(elements), inputs, outputs, draw(st.integers(0, 2))


def built(description):
    """The network, or the sentence that refuses it."""
    try:
        return Network(*description)
    except InputError as problem:
        return str(problem)
