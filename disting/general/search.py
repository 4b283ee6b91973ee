"""Searches in rounded numbers, by least squares from drawn starts, that propose where equivalents
may be: what they find proves nothing.
"""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import Any

from disting.algebra.certainty import residues
from disting.general.matrix_model import Model, Terms
from disting.general.relations import coefficients
from disting.general.target import Values

STARTS = 8  # of a search
FARTHEST = 20.0  # logarithm of a value: farther away it runs to zero or infinity
CLOSE = 1e-9  # relative error of coefficients, where a search has found something
DIGITS = 100  # denominators of points that are proposed


def values_near(
    rows: Sequence[Terms], wanted: Sequence[float], unknowns: int
) -> Iterator[tuple[float, ...]]:
    """Yield positive values at which coefficients over the first one are nearly those wanted."""
    import numpy as np  # imported late: all of it takes longer than most of what is asked

    goal, ratios = np.array(wanted), _ratios(rows, unknowns)

    def errors(logs: Any) -> tuple[Any, Any]:
        """Relative differences of both, and their derivatives by the logarithms of all values."""
        values, slopes = ratios(logs)
        return values / goal - 1, slopes / goal[:, None]

    for k in range(STARTS):
        values = _search(errors, f"{k}", unknowns)
        if values is not None:
            yield values


def common_points(
    left: Model, right: Model, starts: int = STARTS
) -> Iterator[tuple[bool, Values, tuple[float, ...]]]:
    """Yield rounded values of one model with those of the other one that have nearly the same
    transfer function, and whether they are of the left one: where to look for equivalents.
    """
    import numpy as np

    sides = [[t for t in coefficients(m) if t] for m in (left, right)]
    count = len(left.parameters)
    ratios = [
        _ratios(rows, len(m.parameters)) for rows, m in zip(sides, (left, right), strict=True)
    ]

    def errors(logs: Any) -> tuple[Any, Any]:
        """Relative differences of both, and their derivatives by the logarithms of all values."""
        (own, slopes), (other, along) = ratios[0](logs[:count]), ratios[1](logs[count:])
        quotient = own / other
        both = [slopes / other[:, None], -along * (quotient / other)[:, None]]
        return quotient - 1, np.hstack(both)

    for k in range(starts):
        value = _search(errors, f"common:{k}", count + len(right.parameters))
        if value is None:
            continue
        values = value[:count], value[count:]
        for at, model in enumerate((left, right)):
            rounded = [Fraction(x).limit_denominator(DIGITS) for x in values[at]]
            if all(rounded):
                yield not at, dict(zip(model.parameters, rounded, strict=True)), values[1 - at]


def _ratios(rows: Sequence[Terms], unknowns: int) -> Callable[[Any], tuple[Any, Any]]:
    """All c_i/c_0 of logarithms of values, and their derivatives, in rounded numbers."""
    import numpy as np

    terms = [(i, e, float(c)) for i, row in enumerate(rows) for e, c in row]
    places = np.array([i for i, _, _ in terms])
    powers = np.array([e for _, e, _ in terms], float)
    numbers = np.array([c for _, _, c in terms])

    def at(logs: Any) -> tuple[Any, Any]:
        """c_i/c_0, shape (n_c - 1,), and the derivatives, shape (n_c - 1, n_p)."""
        each = numbers * np.exp(np.clip(powers @ logs, -300, 300))
        totals, slopes = np.bincount(places, each, len(rows)), np.zeros((len(rows), unknowns))
        np.add.at(slopes, places, each[:, None] * powers)
        quotients = totals[1:] / totals[0]
        return quotients, slopes[1:] / totals[0] - quotients[:, None] * slopes[0] / totals[0]

    return at


def _search(
    errors: Callable[[Any], tuple[Any, Any]], label: str, unknowns: int
) -> tuple[float, ...] | None:
    """Positive values where all errors are nearly zero, by least squares from a drawn start."""
    import numpy as np
    from scipy.optimize import least_squares

    start = np.array([(x - 2001) / 1000 for x in residues(f"start:{label}", unknowns, 4001)])
    with np.errstate(all="ignore"):
        if not np.all(np.isfinite(errors(start)[0])):
            return None
        result = least_squares(
            lambda x: errors(x)[0],
            start,
            lambda x: errors(x)[1],
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
        )
    if np.max(np.abs(result.fun)) > CLOSE or np.max(np.abs(result.x)) > FARTHEST:
        return None
    return tuple(map(float, np.exp(result.x)))
