"""User input: matrices and lists of entries, checked for shape and turned into trees."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from disting.errors import InputError, short
from disting.general.expression import Power, Product, Sum, Tree, names, tree

MOST_SYMBOLS = 300

Matrix = list[list[Tree]]
ZERO = Fraction(0)


@dataclass(frozen=True, slots=True)
class StateSpace:
    """x' = a x + b u, y = c x + d u with n states: a is n x n, b is n x inputs, c is outputs x n
    and d is outputs x inputs.
    """

    a: Matrix
    b: Matrix
    c: Matrix
    d: Matrix

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of outputs and inputs."""
        return len(self.c), len(self.b[0])

    @property
    def entries(self) -> list[Tree]:
        """All entries."""
        return [e for matrix in (self.a, self.b, self.c, self.d) for row in matrix for e in row]


def state_space(a: object, b: object, c: object, d: object, x0: object = None) -> StateSpace:
    """Four matrices as a user gives them: SymPy or NumPy ones, nested lists; flat lists for a B of
    one column and a C of one row, one entry for a D of one entry, 0 for a D of zeros.

    An initial state x0 is one more input on which a unit impulse acts, the last column of B; B may
    be None then. Raises InputError.
    """
    if x0 is None:
        if b is None:
            raise InputError("nothing moves the states: give B, or an initial state x0")
        return _space(a, b, c, d)
    start = _start(x0, len(_matrix(a, "A")))
    if b is None:
        return _space(a, [[entry] for entry in start], c, d)
    space = _space(a, b, c, d)
    force = [[*row, tree(entry)] for row, entry in zip(space.b, start, strict=True)]
    return StateSpace(space.a, force, space.c, [[*row, ZERO] for row in space.d])


def _space(a: object, b: object, c: object, d: object) -> StateSpace:
    rows = _matrix(a, "A")
    n = len(rows)
    if any(len(row) != n for row in rows):
        raise InputError(f"A is square, not {n} x {max(map(len, rows))}")
    force = _column(b) if _is_flat(b) else _matrix(b, "B")
    sensor = _row(c) if _is_flat(c) else _matrix(c, "C")
    inputs, outputs = _width(force), len(sensor)
    _refuse_shape(force, n, inputs, "B")
    _refuse_shape(sensor, outputs, n, "C")
    direct = _row(d) if _is_flat(d) else _matrix(d, "D")
    if direct == [[ZERO]]:
        direct = [[ZERO] * inputs for _ in sensor]
    _refuse_shape(direct, outputs, inputs, "D")
    return StateSpace(rows, force, sensor, direct)


def _start(x0: object, n: int) -> list[Any]:
    if not _is_list(x0) or not _is_flat(x0) or len(_as_list(x0)) != n:
        raise InputError(f"x0 is a list of the {n} initial values of the states, in order")
    return _as_list(x0)


def refuse_namesakes(*parts: object) -> None:
    """Raises InputError where two symbols of SymPy that are not the same have one name: they
    would become one parameter.
    """
    entry: dict[str, Any] = {}
    for symbol in _symbols(parts):
        if entry.setdefault(symbol.name, symbol) != symbol:
            raise InputError(
                f"two different symbols are called {short(symbol.name)}; use one of them"
            )


def polynomial(side: object, variable: str) -> Tree:
    """A numerator or denominator: a list of the coefficients of falling powers, or an
    expression.
    """
    if not _is_list(side):
        return tree(side)
    coefficients = [tree(entry) for entry in _as_list(side)]
    if not coefficients:
        raise InputError("a list of coefficients is not empty")
    if variable in {name for c in coefficients for name in names(c)}:
        raise InputError(
            f"the coefficients contain the frequency variable {variable}; name another one with"
            " s=.."
        )
    top = len(coefficients) - 1
    return Sum(tuple(Product((c, Power(variable, top - i))) for i, c in enumerate(coefficients)))


def rows_of(entries: object) -> list[list[Any]]:
    """The rows of a matrix of transfer functions as they are given; raises InputError."""
    if not _is_list(entries) or not all(map(_is_list, _as_list(entries))):
        raise InputError(
            'a matrix of transfer functions is a list of rows; coefficients are "num" and "den"'
        )
    rows = [_as_list(row) for row in _as_list(entries)]
    if not rows or not rows[0] or any(len(row) != len(rows[0]) for row in rows):
        raise InputError("the rows of a matrix of transfer functions have equally many entries")
    if any(map(_is_list, (entry for row in rows for entry in row))):
        raise InputError("an entry of a matrix of transfer functions is an expression in s")
    return rows


def _matrix(entries: object, name: str) -> Matrix:
    if not _is_list(entries) or not all(map(_is_list, _as_list(entries))):
        raise InputError(f"{name} is a matrix: a list of rows")
    return [[tree(entry) for entry in _as_list(row)] for row in _as_list(entries)]


def _is_flat(entries: object) -> bool:
    """Return True if it is one entry, or a list of entries."""
    return not any(map(_is_list, _entries(entries)))


def _entries(entries: object) -> list[Any]:
    return _as_list(entries) if _is_list(entries) else [entries]


def _column(entries: object) -> Matrix:
    return [[tree(entry)] for entry in _entries(entries)]


def _row(entries: object) -> Matrix:
    trees = [tree(entry) for entry in _entries(entries)]
    return [trees] if trees else []


def _width(rows: Matrix) -> int:
    return max(map(len, rows), default=0)


def _refuse_shape(rows: Matrix, height: int, width: int, name: str) -> None:
    """Raises InputError for a matrix of another shape, or an empty one."""
    if len(rows) != height or not rows or any(len(row) != width or not row for row in rows):
        raise InputError(
            f"{name} is {height or 1} x {width or 1} (B has a row and C a column for each row of A,"
            f" D a row for each row of C and a column for each column of B), not {len(rows)} x"
            f" {_width(rows)}"
        )


def _symbols(value: Any) -> Iterator[Any]:
    if _is_list(value):
        for entry in _as_list(value):
            yield from _symbols(entry)
    elif hasattr(value, "is_Symbol"):
        yield from value.free_symbols


def _is_list(entry: object) -> bool:
    """Lists, tuples, and arrays or matrices that turn into a list."""
    return isinstance(entry, (list, tuple)) or (
        hasattr(entry, "tolist") and isinstance(entry.tolist(), list)
    )


def _as_list(entry: Any) -> list[Any]:
    return list(entry) if isinstance(entry, (list, tuple)) else list(entry.tolist())


def parameters_of(entries: Iterable[Tree], variable: str = "") -> tuple[str, ...]:
    """All names but that of the frequency variable, sorted; raises InputError."""
    the_names = tuple(sorted({n for entry in entries for n in names(entry)} - {variable}))
    if len(the_names) > MOST_SYMBOLS:
        raise InputError(f"a model has {MOST_SYMBOLS} parameters at most, not {len(the_names)}")
    foreign = [name for name in the_names if not (name.isascii() and name.isprintable() and name)]
    if foreign:
        raise InputError(f"names of parameters are ASCII, not {short(foreign[0])}")
    return the_names


def refuse_name(name: object) -> None:
    """Raises InputError for what no sentence can hold in one line."""
    if not isinstance(name, str) or not name.isprintable():
        raise InputError(f"the name of a model has printable characters only, not {short(name)}")


def frequency(s: object) -> str:
    """The name of the frequency variable; raises InputError."""
    name = tree(s)
    if not isinstance(name, str):
        raise InputError(f"the frequency variable is a symbol or its name, not {short(s)}")
    return name
