"""Which method serves which segment; the ports decide."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from disting.fibres.synthesis.branch_ends import OPEN, Leaf
from disting.fibres.synthesis.collocated import collocated
from disting.fibres.synthesis.damped_neighbours import inner_neighbours, serves
from disting.fibres.synthesis.damped_next_to_end import is_untested, next_to_end
from disting.fibres.synthesis.driving import driving_point
from disting.fibres.synthesis.ground_dampers_only import adapts, swinging
from disting.fibres.synthesis.segment import Data, Segment, mirrored
from disting.fibres.synthesis.undamped import neighbours, to_end

Method = Callable[[Segment, Data], Iterator[Leaf]]


def synthesise(segment: Segment, data: Data) -> Iterator[Leaf]:
    """Yield the segments with this receptance; OPEN where no method serves."""
    if segment.elastic and not segment.dampers:
        yield from synthesise(replace(segment, q=1, elastic=False), data.even)
        return
    turned = not segment.wall and _rank(segment.mirrored) < _rank(segment)
    method = method_of(segment.mirrored if turned else segment)
    if method is None:
        yield OPEN
    else:
        yield from (
            map(mirrored, method(segment.mirrored, data)) if turned else method(segment, data)
        )


def is_covered(segment: Segment) -> bool:
    """Whether a method serves this segment or its mirror image."""
    return cost(segment) < _ORDER.index(None)


def cost(segment: Segment) -> int:
    """Rank of the method that serves this segment or its mirror image, cheapest first."""
    if segment.elastic and not segment.dampers:
        return cost(replace(segment, q=1, elastic=False))
    return min(_rank(segment), _rank(segment if segment.wall else segment.mirrored))


def method_of(segment: Segment) -> Method | None:
    """The method for exactly these ports.

    >>> method_of(Segment(3, 1, 3, wall=True, q=2)) is None
    True
    """
    if segment.distance == 0:
        return driving_point if segment.dampers or segment.elastic else collocated
    if segment.elastic:
        return (
            swinging
            if segment.distance == 1 and segment.b == segment.nodes and adapts(segment)
            else None
        )
    if segment.q == 2:
        return _damped(segment)
    if segment.b == segment.nodes:
        return to_end
    return neighbours if segment.distance == 1 else None


def _damped(segment: Segment) -> Method | None:
    if segment.distance > 1:
        return None
    if segment.b == segment.nodes and (
        segment.nodes not in segment.dampers or is_untested(segment)
    ):
        return next_to_end
    return inner_neighbours if serves(segment) and segment.b < segment.nodes else None


def _rank(segment: Segment) -> int:
    return _ORDER.index(method_of(segment))


# cheapest first
_ORDER = (
    collocated,
    driving_point,
    swinging,
    next_to_end,
    to_end,
    neighbours,
    inner_neighbours,
    None,
)
