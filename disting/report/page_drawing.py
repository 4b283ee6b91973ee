"""Drawings as a page holds them: each once, shown wherever the page refers to it.

Drawings share their parts: a mass, a spring, a place of the force is held once by a page.
Dampers to the ground are parts of their own, one a mass, laid over the drawing of any chain of
that size; where one crosses the bar of a sensor the bar is broken, as in the drawing of a single
chain.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from markupsafe import Markup

from disting.model.chain import Chain
from disting.report.drawing import RISE, STEM, Layout, draw
from disting.report.scene import PAGE_PALETTE, Ink, Layer, Path, Scene
from disting.report.svg import draw_layer, number


@dataclass(frozen=True)
class Drawing:
    """A chain's drawing, held once by a page and shown wherever it is referred to."""

    number: int
    scene: Scene

    @property
    def label(self) -> str:
        """What is seen, in words."""
        return f"A{self.number}: {self.scene.title}"

    @cached_property
    def layers(self) -> tuple[str, ...]:
        """Drawn once: the pages of a model, of its twins and of the family show them."""
        return tuple(draw_layer(layer, PAGE_PALETTE) for layer in self.scene.layers)

    @property
    def width(self) -> str:
        """Natural width [px]."""
        return number(self.scene.width)

    @property
    def box(self) -> str:
        """viewBox."""
        return f"0 0 {number(self.scene.width)} {number(self.scene.height)}"


@dataclass(frozen=True, slots=True)
class Part:
    """Something that several drawings show."""

    name: str
    layer: Layer

    @property
    def definition(self) -> Markup:
        """The part itself; the style sheet says the font and the ends of lines."""
        return Markup(f'<g id="{self.name}">{draw_layer(self.layer, PAGE_PALETTE)}</g>')


def share(drawings: Iterable[Drawing], more: Iterable[Part] = ()) -> Markup:
    """What a page holds: parts of drawings, each once, with `more` of them; and the drawings, which
    refer to their parts from back to front. All but the last, the force of a chain, is a part of
    its own, rest-5 of chain-5.

    >>> two = [Drawing(k, draw(Chain(2, meas_plus=k, damped=False))) for k in (1, 2)]
    >>> share(two).count('<g id="part-'), share(two).count("<use")
    (8, 14)
    """
    numbers, lines = dict[str, int](), list[str]()
    for n, layers in ((d.number, d.layers) for d in drawings):
        at = (numbers.setdefault(layer, len(numbers)) for layer in layers)
        *rest, force = (f'<use href="#part-{i}"/>' for i in at)
        lines.append(f'<g id="chain-{n}"><g id="rest-{n}">{"".join(rest)}</g>{force}</g>')
    parts = (f'<g id="part-{i}">{layer}</g>' for layer, i in numbers.items())
    return Markup("\n".join([*parts, *(part.definition for part in more), *lines]))


def ground_dampers(n_masses: int) -> Iterator[Part]:
    """The damper from each mass to the ground, as a part named ground-1, ground-2, .."""
    masses = tuple(range(1, n_masses + 1))
    at = Layout(all_dampers(n_masses))
    dampers = {layer.name: layer for layer in draw(at.chain).layers}
    for mass in masses:
        x, y = at.middle(mass) - STEM, at.axis + RISE
        broken = Path(((x, y - 2), (x, y + 2)), Ink.PAPER, line=6)
        yield Part(f"ground-{mass}", Layer(f"b{mass}", (broken, *dampers[f"b{mass}"].shapes)))


def height_with_dampers(n_masses: int) -> float:
    """Height of a drawing with dampers to the ground."""
    return Layout(all_dampers(n_masses)).height


def all_dampers(n_masses: int) -> Chain:
    """A chain with a damper to the ground at every mass."""
    return replace(Chain(n_masses, damped=False), ground_dampers=tuple(range(1, n_masses + 1)))
