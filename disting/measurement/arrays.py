"""Arrays that cannot change: what the frozen classes of this package are made of."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]


def real(values: Any, name: str) -> Real:
    """One-dimensional, read-only copy of real numbers; raises InputError naming `name`."""
    return np.asarray(_vector(values, name, np.float64))


def complex_(values: Any, name: str) -> Complex:
    """One-dimensional, read-only copy of complex numbers; raises InputError naming `name`."""
    return np.asarray(_vector(values, name, np.complex128))


def optional(values: Any, name: str) -> Real | None:
    """`real`, or None for None."""
    return None if values is None else real(values, name)


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """The array, read-only from now on."""
    array.setflags(write=False)
    return array


def same(left: NDArray[Any] | None, right: NDArray[Any] | None) -> bool:
    """Return True if both are missing, or equal bit by bit."""
    if left is None or right is None:
        return left is right
    return left.shape == right.shape and left.tobytes() == right.tobytes()


def nearest(ordered: Real, wanted: Real) -> NDArray[np.intp]:
    """Indices of the rising numbers `ordered` that are nearest to the wanted ones, the lower of
    two.

    >>> nearest(np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.6, 3.0, 9.0])).tolist()
    [0, 1, 1, 2]
    """
    above = np.clip(np.searchsorted(ordered, wanted), 1, len(ordered) - 1)
    return np.where(wanted - ordered[above - 1] <= ordered[above] - wanted, above - 1, above)


def spread(ordered: Real, count: int) -> NDArray[np.intp]:
    """Indices, rising and all different, of `count` of the rising numbers `ordered`, as near as can
    be to numbers spaced evenly over their range.

    >>> spread(np.array([0.0, 5.0, 6.0, 7.0, 8.0, 9.0]), 4).tolist()
    [0, 1, 2, 5]
    """
    steps = np.arange(count)
    at = nearest(ordered, np.linspace(ordered[0], ordered[-1], count))
    # each once, where they lie too wide
    apart = np.maximum.accumulate(at - steps) + steps
    return np.minimum(apart, len(ordered) - count + steps)


def apply(function: Callable[[Real], Real], array: Real | None) -> Real | None:
    """The function's value, or None for None."""
    return None if array is None else function(array)


def _vector(values: Any, name: str, kind: type[Any]) -> NDArray[Any]:
    if kind is np.float64 and np.iscomplexobj(values):
        raise InputError(f"{name} must be real numbers, not complex ones")
    try:
        array = np.array(values, dtype=kind)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be a row of numbers") from None
    if array.ndim != 1:
        raise InputError(f"{name} must be a row of numbers, shape (n,), not of shape {array.shape}")
    return frozen(array)
