"""Choice of the method for each row; the ports decide."""

from collections.abc import Callable, Iterator

from disting.fibres.synthesis.branch import OPEN, Leaf, Receptance, mirror
from disting.fibres.synthesis.damped_neighbours import inner_neighbours, serves
from disting.fibres.synthesis.damped_next_to_end import is_untested, next_to_end
from disting.fibres.synthesis.driving_point import collocated_rows, driving_point
from disting.fibres.synthesis.ground_dampers_only import adapts, swing_rows
from disting.fibres.synthesis.undamped_rows import neighbours, to_end
from disting.model.row import Row

Method = Callable[[Row, Receptance], Iterator[Leaf]]


def synthesise(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield the rows with this receptance, given in the row's own variable (see `Row.q`); OPEN
    where no method applies.
    """
    turned = not row.grounded and _rank(row.mirrored) < _rank(row)
    method = method_of(row.mirrored if turned else row)
    if method is None:
        yield OPEN
    else:
        yield from (map(mirror, method(row.mirrored, data)) if turned else method(row, data))


def is_covered(row: Row) -> bool:
    """Return True if a method applies to this row or its mirror image."""
    return cost(row) < _ORDER.index(None)


def cost(row: Row) -> int:
    """Rank of the method that serves this row or its mirror image, cheapest first."""
    return min(_rank(row), _rank(row if row.grounded else row.mirrored))


def method_of(row: Row) -> Method | None:
    """The method for exactly these ports.

    >>> method_of(Row(3, True, 1, 3, damped=True)) is None
    True
    """
    if row.distance == 0:
        return driving_point if row.ground_dampers else collocated_rows
    if row.damped:
        return _damped_method(row)
    if row.ground_dampers:
        ends = row.distance == 1 and row.b == row.n_masses
        return swing_rows if ends and adapts(row) else None
    if row.b == row.n_masses:
        return to_end
    return neighbours if row.distance == 1 else None


def _damped_method(row: Row) -> Method | None:
    if row.distance > 1:
        return None
    if row.b == row.n_masses and (row.n_masses not in row.ground_dampers or is_untested(row)):
        return next_to_end
    return inner_neighbours if serves(row) and row.b < row.n_masses else None


def _rank(row: Row) -> int:
    return _ORDER.index(method_of(row))


# cheapest first
_ORDER = (
    collocated_rows,
    driving_point,
    swing_rows,
    next_to_end,
    to_end,
    neighbours,
    inner_neighbours,
    None,
)
