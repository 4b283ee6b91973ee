"""A curve the size of a stamp, for a table: without axes, both directions logarithmic."""

import numpy as np

from disting.fit.plant import Real
from disting.report.scene import Ink, Layer, Path, Scene
from disting.report.svg import svg

WIDTH, HEIGHT, EDGE = 280.0, 90.0, 6.0
MOST = 400  # points


def curve(x: Real, y: Real, title: str) -> str:
    """Stand-alone SVG of positive values over rising positive places, shape (n,) each."""
    at = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST)).astype(int))
    across, up = (_scaled(np.log(values[at])) for values in (x, y))
    points = tuple(
        (EDGE + (WIDTH - 2 * EDGE) * float(a), HEIGHT - EDGE - (HEIGHT - 2 * EDGE) * float(b))
        for a, b in zip(across, up, strict=True)
    )
    return svg(Scene(WIDTH, HEIGHT, (Layer("curve", (Path(points, Ink.SENSOR),)),), title))


def _scaled(values: Real) -> Real:
    """From 0 to 1; 1/2 where they are all the same."""
    span = float(np.ptp(values))
    return np.asarray((values - values.min()) / span if span else np.full(len(values), 0.5))
