"""The transfer function of a structure and its derivatives, over any ring: equation (24) without
an inverse.

Each row of masses has a tridiagonal matrix A_c(s) = M s^2 + D s + K. With D_c = det A_c and, for
the row's share of the force and sensor vectors, P_c = e_meas' adj(A_c) e_act, the receptance is
the sum of P_c/D_c. A parameter that enters as w v v' (w a power of s) has dD_c = w v' adj v and,
since d(A^-1) = -w A^-1 v v' A^-1,

    dP_c = w (P_c v' adj v - (v' adj e_act)(v' adj e_meas)) / D_c       (an exact quotient)

so one pair of adjugate columns gives the whole gradient.

A joint whose other end does not move (the ground, a locked mass) acts on one mass alone.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Generic, Protocol, TypeVar

from disting.algebra.determinants import Ring, Tridiagonal
from disting.model.structure import Element, Ports, power

Value = TypeVar("Value")


class Arrangement(Protocol):
    """Rows of masses with elements and ports: a structure, or what an experiment makes of it."""

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""

    @property
    def elements(self) -> tuple[Element, ...]:
        """What adds a term to A(s), by the name of its value."""

    @property
    def ports(self) -> Ports:
        """Where force and sensor attach; 0 does not move."""

    @property
    def row_ends(self) -> tuple[tuple[int, int], ...]:
        """Connected rows of moving masses (first, last)."""

    @property
    def sensor_order(self) -> int:
        """Differentiations of the measured position."""

    @property
    def lag(self) -> bool:
        """Whether the force has a lag."""


@dataclass(frozen=True, slots=True)
class Rational(Generic[Ring]):
    """Receptance times lag as num/den, polynomials in s, with the gradients by parameter name;
    not yet cancelled.
    """

    num: Ring
    den: Ring
    num_gradient: dict[str, Ring]
    den_gradient: dict[str, Ring]


@dataclass(frozen=True)
class _RowMatrix(Generic[Ring]):
    """A row, of a structure of any kind: up to four ports."""

    first: int
    matrix: Tridiagonal[Ring]
    # act_plus, act_minus, meas_plus, meas_minus, counted from the row's first mass
    ports: tuple[int, int, int, int]
    elements: tuple[Element, ...]

    @cached_property
    def act(self) -> list[Ring]:
        """adj(A_c) e_act."""
        return _response(self.matrix, *self.ports[:2])

    @cached_property
    def meas(self) -> list[Ring]:
        """adj(A_c) e_meas."""
        return (
            self.act
            if self.ports[:2] == self.ports[2:]
            else _response(self.matrix, *self.ports[2:])
        )

    @cached_property
    def num(self) -> Ring:
        """P_c."""
        return _difference(self.act, *self.ports[2:])


def receptance(
    structure: Arrangement, values: Mapping[str, Ring], s: Ring, unit: Ring
) -> Rational[Ring]:
    """num, den and gradients at the given parameter values (ring elements); `s` and `unit` belong
    to the same ring.

    Rows without a port do not contribute and are left out, so their parameters have zero
    gradients.
    """
    rows = _matrices(structure, values, s, unit)
    den, num = _sum(rows, unit)
    zero = unit - unit
    num_gradient, den_gradient = (
        {p: zero for p in structure.parameters if p != "Td"} for _ in range(2)
    )
    for row in rows:
        others, rest = _sum([other for other in rows if other is not row], unit)
        for element in row.elements:
            d_num, d_den = _gradient(row, element, s)
            num_gradient[element.parameter] = d_num * others + d_den * rest
            den_gradient[element.parameter] = d_den * others
    plain = Rational(num, den, num_gradient, den_gradient)
    return _lagged(plain, values["T1"], s, unit) if structure.lag else plain


def plain_receptance(
    structure: Arrangement, values: Mapping[str, Ring], s: Ring, unit: Ring
) -> tuple[Ring, Ring]:
    """num and den of `receptance` without the gradients, which are most of its work."""
    den, num = _sum(_matrices(structure, values, s, unit), unit)
    return num, den * (unit + values["T1"] * s) if structure.lag else den


def values_at(
    structure: Arrangement, numbers: Sequence[int], lift: Callable[[int], Value]
) -> dict[str, Value]:
    """Parameter values from numbers, in the structure's order, lifted into the ring."""
    return {name: lift(number) for name, number in zip(structure.parameters, numbers, strict=True)}


def _matrices(
    structure: Arrangement, values: Mapping[str, Ring], s: Ring, unit: Ring
) -> list[_RowMatrix[Ring]]:
    return [_matrix(structure, ends, values, s, unit) for ends in touched_rows(structure)]


def touched_rows(structure: Arrangement) -> tuple[tuple[int, int], ...]:
    """The rows that the force moves and the sensor sees."""
    p = structure.ports
    inside = {ends: [ends[0] <= port <= ends[1] for port in p] for ends in structure.row_ends}
    return tuple(ends for ends, (a, b, c, d) in inside.items() if (a or b) and (c or d))


def _matrix(
    structure: Arrangement, ends: tuple[int, int], values: Mapping[str, Ring], s: Ring, unit: Ring
) -> _RowMatrix[Ring]:
    first, last = ends
    elements = tuple(e for e in structure.elements if _nodes(e, ends))
    powers = [unit, s, s * s]
    diagonal, off = [unit - unit] * (last - first + 1), [unit - unit] * (last - first)
    for e in elements:
        term = values[e.parameter] * powers[power(e)]
        nodes = _nodes(e, ends)
        for node in nodes:
            diagonal[node - first] = diagonal[node - first] + term
        if len(nodes) == 2:
            off[e.at - first] = off[e.at - first] + term
    matrix = Tridiagonal(tuple(diagonal), tuple(off), unit)
    p = structure.ports
    ports = (p.act_plus - first, p.act_minus - first, p.meas_plus - first, p.meas_minus - first)
    return _RowMatrix(first, matrix, ports, elements)


def _nodes(element: Element, span: tuple[int, int]) -> tuple[int, ...]:
    """The masses of a row on which an element acts."""
    ends = (element.at, element.at + 1) if element.kind in "kd" else (element.at,)
    return tuple(node for node in ends if span[0] <= node <= span[1])


def _response(matrix: Tridiagonal[Ring], plus: int, minus: int) -> list[Ring]:
    """adj(A) (e_plus - e_minus), where a port outside the row does not count."""
    size = len(matrix.diagonal)
    up = matrix.adjugate_column(plus) if 0 <= plus < size else None
    down = matrix.adjugate_column(minus) if 0 <= minus < size else None
    if up is None or down is None:
        return up if up is not None else [-entry for entry in down or []]
    return [a - b for a, b in zip(up, down, strict=True)]


def _difference(vector: list[Ring], plus: int, minus: int) -> Ring:
    zero = vector[0] - vector[0]
    inside = [vector[i] if 0 <= i < len(vector) else zero for i in (plus, minus)]
    return inside[0] - inside[1]


def _gradient(row: _RowMatrix[Ring], element: Element, s: Ring) -> tuple[Ring, Ring]:
    """(dP_c, dD_c) for one element."""
    matrix = row.matrix
    nodes = _nodes(element, (row.first, row.first + len(matrix.diagonal) - 1))
    i = nodes[0] - row.first
    if len(nodes) == 2:
        beside = matrix.adjugate_beside(i)
        square = matrix.adjugate_diagonal(i) + matrix.adjugate_diagonal(i + 1) - beside - beside
        act, meas = row.act[i] - row.act[i + 1], row.meas[i] - row.meas[i + 1]
    else:
        square, act, meas = matrix.adjugate_diagonal(i), row.act[i], row.meas[i]
    d_num = (row.num * square - act * meas) // matrix.determinant
    for _ in range(power(element)):
        d_num, square = d_num * s, square * s
    return d_num, square


def _sum(rows: Sequence[_RowMatrix[Ring]], unit: Ring) -> tuple[Ring, Ring]:
    """Product of the determinants, and the numerator of the sum of the receptances over it."""
    num, den = unit - unit, unit
    for row in rows:
        num, den = num * row.matrix.determinant + row.num * den, den * row.matrix.determinant
    return den, num


def _lagged(plain: Rational[Ring], time_constant: Ring, s: Ring, unit: Ring) -> Rational[Ring]:
    factor = unit + time_constant * s
    gradient = {name: d * factor for name, d in plain.den_gradient.items()} | {"T1": s * plain.den}
    return Rational(plain.num, plain.den * factor, plain.num_gradient, gradient)
