"""Signs of the elements of networks, each drawn along a straight track between any two points.

A sign is in the middle of its track; the rest of the track is a plain line. The kinds are those of
`disting.network.network`; a kind without a sign here is a box.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from disting.report.scene import Circle, Ink, Layer, Path, Place, Shape, Text, extent

STEP = 4.0  # between the points by which what is drawn is remembered

HALF = 15.0  # of the length of a sign
THICK = 9.0  # half of its height at most
ARC = 6  # pieces of a half circle


@dataclass(frozen=True, slots=True)
class Track:
    """The way from one point to another."""

    start: Place
    end: Place

    @property
    def length(self) -> float:
        """Its length."""
        return hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])

    @property
    def direction(self) -> Place:
        """Unit vector along it."""
        n = self.length
        return (self.end[0] - self.start[0]) / n, (self.end[1] - self.start[1]) / n

    def at(self, along: float, aside: float = 0.0) -> Place:
        """The point so far from its start, and so far to the right of the way.

        >>> Track((0, 0), (10, 0)).at(4, 1)
        (4.0, 1.0)
        """
        (x, y), (ux, uy) = self.start, self.direction
        return x + along * ux - aside * uy, y + along * uy + aside * ux

    def path(self, places: Iterable[Place], line: float = 1.5) -> Path:
        """A line through places (along, aside), counted from the middle."""
        middle = self.length / 2
        return Path(tuple(self.at(middle + a, b) for a, b in places), line=line)

    def shifted(self, aside: float, short: float) -> "Track":
        """Beside it, shorter at both ends."""
        return Track(self.at(short, aside), self.at(self.length - short, aside))


def draw_symbol(letter: str, track: Track) -> tuple[Shape, ...]:
    """The sign of a kind on its track.

    >>> [type(shape).__name__ for shape in draw_symbol("C", Track((0, 0), (60, 0)))]
    ['Path', 'Path', 'Path', 'Path']
    """
    return SIGNS.get(letter, _box)(track)


def _leads(track: Track, half: float) -> tuple[Path, ...]:
    """The plain line on both sides of a sign of this half length."""
    rest = track.length / 2
    return track.path(((-rest, 0), (-half, 0))), track.path(((half, 0), (rest, 0)))


def _frame(track: Track, half: float, thick: float) -> Path:
    corners = (-half, -thick), (half, -thick), (half, thick), (-half, thick), (-half, -thick)
    return track.path(corners)


def _box(track: Track) -> tuple[Shape, ...]:
    """A resistor, and what has no other sign."""
    return *_leads(track, HALF), _frame(track, HALF, 5.5)


def _inductor(track: Track) -> tuple[Shape, ...]:
    loops, radius = 4, HALF / 4
    places = [
        (
            -HALF + (2 * k + 1) * radius - radius * cos(pi * i / ARC),
            -1.5 * radius * sin(pi * i / ARC),
        )
        for k in range(loops)
        for i in range(ARC + 1)
    ]
    return *_leads(track, HALF), track.path(places)


def _capacitor(track: Track) -> tuple[Shape, ...]:
    plates = (track.path(((x, -THICK), (x, THICK)), line=2) for x in (-3, 3))
    return *_leads(track, 3), *plates


def _warburg(track: Track) -> tuple[Shape, ...]:
    """A box with the slope of its line in a Nyquist plot."""
    return *_box(track), track.path(((-5, 5.5), (5, -5.5)))


def _constant_phase(track: Track) -> tuple[Shape, ...]:
    """Plates of a capacitor that lean."""
    plates = (track.path(((x - 6, -THICK), (x, 0), (x - 6, THICK)), line=2) for x in (-1, 6))
    return *_leads(track, 3.5)[:1], track.path(((6, 0), (track.length / 2, 0))), *plates


def _spring(track: Track) -> tuple[Shape, ...]:
    turns = 6
    step = 2 * HALF / turns
    tops = [(-HALF + (i + 0.5) * step, -6.0 if i % 2 else 6.0) for i in range(turns)]
    return *_leads(track, HALF), track.path(((-HALF, 0), *tops, (HALF, 0)))


def _damper(track: Track) -> tuple[Shape, ...]:
    """A cup and a piston in it."""
    rest = track.length / 2
    return (
        track.path(((-rest, 0), (-8, 0))),
        track.path(((9, -6), (-8, -6), (-8, 6), (9, 6))),
        track.path(((1, -4), (1, 4)), line=2.5),
        track.path(((1, 0), (rest, 0))),
    )


def _inerter(track: Track) -> tuple[Shape, ...]:
    """A box with a flywheel in it."""
    x, y = track.at(track.length / 2)
    return *_leads(track, 11), _frame(track, 11, 8), Circle(x, y, 4.5, Ink.NONE, Ink.LINE)


def _flow(track: Track) -> tuple[Shape, ...]:
    rest, head = track.length / 2, 9.0
    tip = tuple(
        track.at(track.length - back, aside) for back, aside in ((0, 0), (head, -4), (head, 4))
    )
    return track.path(((-rest, 0), (rest - head, 0))), Path(tip, Ink.NONE, Ink.LINE)


def gear(track: Track) -> tuple[Shape, ...]:
    """Two wheels on a track, before its end."""
    wheels = ((15.0, 6.0), (5.5, 3.5))
    return tuple(
        Circle(*track.at(track.length - back), radius, Ink.PAPER, Ink.LINE)
        for back, radius in wheels
    )


SIGNS: dict[str, Callable[[Track], tuple[Shape, ...]]] = {
    "L": _inductor,
    "C": _capacitor,
    "W": _warburg,
    "P": _constant_phase,
    "k": _spring,
    "d": _damper,
    "j": _inerter,
    "a": _flow,
}


@dataclass(slots=True)
class Sheet:
    """Content of the drawing so far, as layers and as a cloud of points that covers it."""

    layers: list[Layer] = field(default_factory=list)
    clouds: list[NDArray[np.float64]] = field(default_factory=list)

    def add(self, name: str, shapes: Iterable[Shape]) -> None:
        """Draw something."""
        rects = tuple(shapes)
        self.layers.append(Layer(name, rects))
        self.clouds += [_cloud(shape) for shape in rects]

    def crowd(self, track: Track, half: float) -> int:
        """Number of points within a distance of a track."""
        points = np.concatenate(self.clouds) - np.array(track.start)
        ux, uy = track.direction
        along, aside = points @ (ux, uy), points @ (-uy, ux)
        inside = (along > 0) & (along < track.length) & (abs(aside) < half)
        return int(inside.sum())

    def crowd_of(self, text: Text) -> int:
        """Number of points in the area of a text."""
        left, top, right, bottom = extent(text)
        return self.crowd(
            Track((left, (top + bottom) / 2), (right + 0.1, (top + bottom) / 2)),
            (bottom - top) / 2 + 2,
        )

    def clearest(self, texts: Sequence[Text]) -> Text:
        """The first of the texts that meet least."""
        return min(texts, key=self.crowd_of)


def _cloud(shape: Shape) -> NDArray[np.float64]:
    """Points on a shape: on a line every few pixels, in a box or a text a raster of them."""
    if isinstance(shape, Path):
        pieces = [
            np.linspace(a, b, 2 + int(max(abs(a[0] - b[0]), abs(a[1] - b[1])) / STEP))
            for a, b in pairwise(shape.points)
        ]
        return np.concatenate(pieces)
    left, top, right, bottom = extent(shape)
    xs, ys = (np.arange(low, high + STEP, STEP) for low, high in ((left, right), (top, bottom)))
    return np.stack(np.meshgrid(xs, ys), -1).reshape(-1, 2)
