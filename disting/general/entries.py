"""What a user writes down: matrices and lists of entries, checked for shape and turned into
trees.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from disting.errors import InputError, shown
from disting.general.expression import tree
from disting.general.trees import Power, Product, Sum, Tree, names

Matrix = list[list[Tree]]


@dataclass(frozen=True, slots=True)
class StateSpace:
    """x' = a x + b u, y = c x + d u: a is n x n, b and c have n entries."""

    a: Matrix
    b: list[Tree]
    c: list[Tree]
    d: Tree

    @property
    def entries(self) -> list[Tree]:
        """All entries."""
        return [*(entry for row in self.a for entry in row), *self.b, *self.c, self.d]


def state_space(a: object, b: object, c: object, d: object) -> StateSpace:
    """Four matrices as a user gives them: SymPy or NumPy ones, nested lists, for b and c flat
    lists too.
    """
    rows = _matrix(a, "A")
    n = len(rows)
    if any(len(row) != n for row in rows):
        raise InputError(f"A is square, not {n} x {max(map(len, rows))}")
    column = [entry for row in _shaped(b, n, 1, "B") for entry in row]
    return StateSpace(rows, column, _shaped(c, 1, n, "C")[0], _shaped(d, 1, 1, "D")[0][0])


def refuse_namesakes(*given: object) -> None:
    """Raises InputError where two symbols of SymPy that are not the same have one name: they
    would become one parameter.
    """
    known: dict[str, Any] = {}
    for symbol in _symbols(given):
        if known.setdefault(symbol.name, symbol) != symbol:
            raise InputError(
                f"two different symbols are called {shown(symbol.name)}; use one of them"
            )


def polynomial(side: object, variable: str) -> Tree:
    """A numerator or denominator: a list of the coefficients of falling powers, or an
    expression.
    """
    if not _is_list(side):
        return tree(side)
    coefficients = [tree(entry) for entry in _listed(side)]
    if not coefficients:
        raise InputError("a list of coefficients is not empty")
    if variable in {name for c in coefficients for name in names(c)}:
        raise InputError(
            f"the coefficients contain the frequency variable {variable}; name another one with"
            " s=.."
        )
    top = len(coefficients) - 1
    return Sum(tuple(Product((c, Power(variable, top - i))) for i, c in enumerate(coefficients)))


def _matrix(entries: object, name: str) -> Matrix:
    if not _is_list(entries) or not all(map(_is_list, _listed(entries))):
        raise InputError(f"{name} is a matrix: a list of rows")
    return [[tree(entry) for entry in _listed(row)] for row in _listed(entries)]


def _shaped(entries: object, height: int, width: int, name: str) -> Matrix:
    """A matrix of this shape; one row or column may be given as a flat list, one entry as it is."""
    flat = _listed(entries) if _is_list(entries) else [entries]
    if any(map(_is_list, flat)):
        rows = _matrix(entries, name)
    else:
        rows = (
            [[tree(entry)] for entry in flat] if width == 1 else [[tree(entry) for entry in flat]]
        )
    if len(rows) != height or any(len(row) != width for row in rows):
        found = f"{len(rows)} x {max(map(len, rows), default=0)}"
        raise InputError(
            f"{name} is {height} x {width} (one input, one output, A with {max(height, width)}"
            f" rows), not {found}"
        )
    return rows


def _symbols(given: Any) -> Iterator[Any]:
    if _is_list(given):
        for entry in _listed(given):
            yield from _symbols(entry)
    elif hasattr(given, "is_Symbol"):
        yield from given.free_symbols


def _is_list(entry: object) -> bool:
    """Lists, tuples, and arrays or matrices that turn into a list."""
    return isinstance(entry, (list, tuple)) or (
        hasattr(entry, "tolist") and isinstance(entry.tolist(), list)
    )


def _listed(entry: Any) -> list[Any]:
    return list(entry) if isinstance(entry, (list, tuple)) else list(entry.tolist())
