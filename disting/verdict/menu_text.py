"""A menu of next measurements as text: the structures with their drawings, each with its
experiments, cheapest first, and the conclusion.
"""

from collections.abc import Sequence

from disting.experiments.experiment import places_of
from disting.experiments.menu import Item
from disting.model.chain import LEGEND, Chain, Sort, text_drawing
from disting.network.network import Network
from disting.verdict.next_words import AnyMenu, anywhere, conclusion, in_words

DOMAIN = (
    "decided over complex parameters: structures that differ there differ over positive ones"
    " too; all ways of matching the {place} of two structures are tested"
)

BRIEF = "only menus with a sufficient experiment are shown; --json has them all"


def menu_text(advice: AnyMenu) -> str:
    """The menu for each structure, cheapest first, with what its words mean."""
    legend = [LEGEND] if isinstance(advice.structures[0], Chain) else []
    return "\n".join(describe_menu(advice, ["", *legend, DOMAIN.format(place=advice.place)]))


def describe_menu(advice: AnyMenu, words: Sequence[str] = (), *, brief: bool = False) -> list[str]:
    """The menu of each structure; `brief`: only where something on it is surely enough."""
    width = max(map(len, advice.names))
    structures: tuple[Chain | Network, ...] = advice.structures
    drawings = [
        f"  {name:{width}}  {_draw_structure(structure)}".rstrip()
        for name, structure in zip(advice.names, structures, strict=True)
    ]
    head = f"{len(advice.names)} structures that the present measurement cannot distinguish:"
    enough = anywhere(advice)
    phrases = [f"what separates all of them: {enough}"] if enough else []
    lines = [head, *drawings, *words, *phrases]
    for structure, name in enumerate(advice.names):
        lines += ["", f"if it is {name}:"]
        for kind in advice.kinds if advice.least(structure) or not brief else ():
            cost = f"{kind.name:8} cost {advice.costs.cost(kind):g}"
            for at in advice.places(structure):
                answer = in_words(advice, structure, Item(kind, at))
                lines.append(f"  {cost}  {advice.place} {at}: {answer}")
        lines.append(f"  {conclusion(advice, structure)}")
    return lines


def _draw_structure(structure: Chain | Network) -> str:
    """A chain as a drawing; of a circuit what meets in each node."""
    if isinstance(structure, Chain):
        return text_drawing(structure)
    if structure.sort is not Sort.CIRCUIT:
        return ""
    meeting = {
        i: ", ".join(e.value for e in structure.elements if i in e.nodes)
        for i in (*places_of(structure), structure.reference)
    }
    nodes = "; ".join(f"{i}: {values}" for i, values in meeting.items())
    return f"(what meets in its nodes, the reference last: {nodes})"
