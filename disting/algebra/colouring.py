"""Renamings of parameters by colour refinement on values: which parameters can play which role.

A renaming carries one list of functions into another by a permutation of their variables. Give all
variables one value: the column of the Jacobian of each variable is then the same in both lists for
variables that correspond. These columns are colours; give each colour its own value, look again,
and refine until nothing splits (as in colour refinement of graphs, with the expanded polynomials
as the graph, but without expanding them). Different sets of colours prove that no renaming exists;
ties are broken by individualising one variable after another.
"""

import hashlib
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

Columns = Callable[[list[int]], tuple[tuple[int, ...], list[tuple[int, ...]]]]
"""Values of the functions and, per variable, the column of derivatives, at a point."""


@dataclass(frozen=True, slots=True)
class Colouring:
    """A stable colour for each variable and the values of the functions there: equal for lists
    that are renamings.
    """

    colours: tuple[str, ...]
    values: tuple[int, ...]

    @property
    def fingerprint(self) -> str:
        """One text that is equal for lists that a renaming connects."""
        return _digest(*sorted(self.colours), *map(str, self.values))


def colouring(columns: Columns, start: tuple[str, ...]) -> Colouring:
    """Refine the start colours (one text a variable) until no class splits."""
    colours = start
    while True:
        values, own = columns([_number(c) for c in colours])
        refined = tuple(
            _digest(c, *map(str, column)) for c, column in zip(colours, own, strict=True)
        )
        if len(set(refined)) == len(set(colours)):
            return Colouring(refined, values)
        colours = refined


def renamings(left: Columns, right: Columns, size: int) -> Iterator[tuple[int, ...]]:
    """Yield candidates: for each variable of the left list the corresponding one of the right list.

    Every renaming is among them; a candidate is to be verified.
    """
    yield from _match(left, right, colouring(left, ("",) * size), colouring(right, ("",) * size))


def _match(
    left: Columns, right: Columns, own: Colouring, other: Colouring
) -> Iterator[tuple[int, ...]]:
    if own.fingerprint != other.fingerprint:
        return
    count = Counter(own.colours)
    tied = [i for i, colour in enumerate(own.colours) if count[colour] > 1]
    if not tied:
        yield tuple(other.colours.index(colour) for colour in own.colours)
        return
    chosen = tied[0]
    for partner in (j for j, colour in enumerate(other.colours) if colour == own.colours[chosen]):
        yield from _match(
            left,
            right,
            colouring(left, _individualise(own.colours, chosen)),
            colouring(right, _individualise(other.colours, partner)),
        )


def _individualise(colours: tuple[str, ...], chosen: int) -> tuple[str, ...]:
    return tuple(_digest(c, "chosen") if i == chosen else c for i, c in enumerate(colours))


def _digest(*texts: str) -> str:
    return hashlib.blake2b("|".join(texts).encode(), digest_size=16).hexdigest()


def _number(colour: str) -> int:
    # below 2^60, so never 0 modulo a prime of 61 bits
    return int(_digest("value", colour)[:15], 16) + 1
