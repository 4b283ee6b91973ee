"""Drawings as a page holds them: each once, shown wherever the page refers to it.

Several drawings share their parts: a mass, a spring, a place of the force is held once by a page.
Dampers to the ground are parts of their own, one a mass, laid over the drawing of any chain of
that size; where one crosses the bar of a sensor the bar is broken, as in the drawing of a single
chain.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property

from markupsafe import Markup

from disting.model.chain import Chain
from disting.report.drawing import RISE, STEM, Layout, draw
from disting.report.scene import PAGE_PALETTE, Ink, Layer, Path, Scene
from disting.report.svg import body, number


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
    def definition(self) -> Markup:
        """The drawing itself; all but the force is a part of its own, rest-5 of chain-5."""
        drawn = body(self.scene, PAGE_PALETTE, f"rest-{self.number}")
        return Markup(f'<g id="chain-{self.number}">{drawn}</g>')

    @property
    def width(self) -> str:
        """Natural width [px]."""
        return number(self.scene.width)

    @property
    def box(self) -> str:
        """viewBox."""
        return f"0 0 {number(self.scene.width)} {number(self.scene.height)}"


@dataclass(frozen=True)
class SharedDrawing(Drawing):
    """A drawing made of parts that the page holds."""

    parts: tuple[int, ...]

    @cached_property
    def definition(self) -> Markup:
        """References to the parts, from back to front; the last is the force."""
        *rest, force = (f'<use href="#part-{i}"/>' for i in self.parts)
        return Markup(
            f'<g id="chain-{self.number}"><g id="rest-{self.number}">{"".join(rest)}</g>{force}</g>'
        )


@dataclass(frozen=True, slots=True)
class Part:
    """Something that several drawings show."""

    name: str
    layer: Layer

    @property
    def definition(self) -> Markup:
        """The part itself."""
        return Markup(f'<g id="{self.name}">{_drawn(self.layer)}</g>')


@cache
def _drawn(layer: Layer) -> str:
    """Drawn once: the pages of all models of a size show it."""
    return body(Scene(0, 0, (layer,)), PAGE_PALETTE)


def shared(chains: Mapping[int, Chain]) -> tuple[tuple[Part, ...], tuple[SharedDrawing, ...]]:
    """The parts of some models' drawings, each once, and the drawings, by the models' numbers.

    >>> parts, drawings = shared({k: Chain(2, meas_plus=k, damped=False) for k in (1, 2)})
    >>> len(parts), [len(d.parts) for d in drawings]
    (8, [7, 7])
    """
    numbers: dict[Layer, int] = {}
    drawings = [
        SharedDrawing(
            i, scene, tuple(numbers.setdefault(layer, len(numbers)) for layer in scene.layers)
        )
        for i, scene in ((i, draw(chain)) for i, chain in chains.items())
    ]
    return tuple(Part(f"part-{i}", layer) for layer, i in numbers.items()), tuple(drawings)


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


def definitions(parts: Iterable[Part]) -> Markup:
    """The parts, to be held by a page."""
    return Markup("\n").join(part.definition for part in parts)
