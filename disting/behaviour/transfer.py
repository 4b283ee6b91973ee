"""The transfer function of a structure and its derivatives, over any ring: equation (24) without
an inverse.

Each row of masses has a tridiagonal matrix A_c(s) = M s^2 + D s + K. With D_c = det A_c and, for
the row's share of the force and sensor vectors, P_c = e_meas' adj(A_c) e_act, the receptance is
the sum of P_c/D_c. A parameter that enters as w v v' (w a power of s) has dD_c = w v' adj v and,
since d(A^-1) = -w A^-1 v v' A^-1,

    dP_c = w (P_c v' adj v - (v' adj e_act)(v' adj e_meas)) / D_c       (an exact quotient)

so one pair of adjugate columns gives the whole gradient.

A joint whose other end does not move (the ground, a locked mass) acts on one mass alone.

Where a person reads it or an identity is proven, the transfer function is written out in the
chain's parameters; where a rank is proven, so are its moment invariants with the rows of their
Jacobian.

With G = num/den of (24), leading coefficient c of the denominator: coefficient (25) number i is
n_i / c or d_i / c, and Markov parameter (30) number k is g_k / c^(k+1), g_k = c^k n_(m-k) -
sum_(i=1..k) d_(m-i) c^(i-1) g_(k-i), m the denominator's degree.

All G_k but G_0 are functions of the coefficients of G - G_0 (numerator r_i / c^2, r_i = c n_i -
n_m d_i), so their rank is at most that of these coefficients: fewer and shorter polynomials.

Other units of force and of time multiply parameters and invariants by constants, so they leave the
rank alone. In the units in which the first mass and the first spring are one, the Jacobian has two
symbols less.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Generic, Protocol, TypeVar

from flint import fmpz_mpoly

from disting.algebra.determinants import Ring, Tridiagonal, rank
from disting.algebra.symbols import Expr, coefficients, quotient, rename_symbols, symbol, symbols
from disting.model.chain import Chain, Element, Ports, Sensor, Structure, power
from disting.model.names import read_together
from disting.renamed import renamed

Value = TypeVar("Value")


class Arrangement(Protocol):
    """Rows of masses with elements and ports: a structure, or what an experiment makes of it."""

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""

    @property
    def elements(self) -> tuple[Element, ...]:
        """Elements that add a term to A(s), by the names of their values."""

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
        """True if the force has a lag."""


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
    return _add_lag(plain, values["T1"], s, unit) if structure.lag else plain


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
    """The rows that the force moves and the sensor measures."""
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


def _add_lag(plain: Rational[Ring], time_constant: Ring, s: Ring, unit: Ring) -> Rational[Ring]:
    factor = unit + time_constant * s
    gradient = {name: d * factor for name, d in plain.den_gradient.items()} | {"T1": s * plain.den}
    return Rational(plain.num, plain.den * factor, plain.num_gradient, gradient)


Quotient = tuple[fmpz_mpoly, fmpz_mpoly]

NO_UNITS: Mapping[str | int, int] = MappingProxyType({})


def expand(structure: Structure) -> Quotient:
    """Numerator and denominator of the transfer function (24) without dead time, in lowest terms
    for every chain of the class.

    They are polynomials in s and the parameters with integer coefficients; only powers of s had to
    be cancelled.

    >>> expand(Chain(1, damped=False).structure)
    (1, m1)
    """
    num, den = numerator_and_denominator(structure)
    s = num.context().gens()[0]
    power = min(_valuation(num), _valuation(den))
    return num // s**power, den // s**power


def numerator_and_denominator(structure: Structure) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator (times s to the sensor's order) and denominator, common powers of s not
    cancelled; s is the first symbol.
    """
    ring = symbols(["s", *structure.parameters])
    num, den = plain_receptance(structure, ring, ring["s"], ring["s"] ** 0)
    return num * ring["s"] ** structure.sensor_order, den


@renamed(sensor="quantity")
def transfer_function(
    chain: Chain | str, *, damped: bool | None = None, quantity: Sensor | str | None = None
) -> Expr:
    """G(s) from force to sensor as a SymPy expression in s and positive symbols named as the
    parameters.

    The quotient of two polynomials in s, a lag among its poles, times exp(-s Td) where there is a
    dead time. A chain can be named, such as "3:1+b2": `damped` and `quantity` then state how to
    read it. Raises InputError for a text that names no chain.

    >>> transfer_function("2:1", damped=False)
    (k12 + m2*s**2)/(k12*m1 + k12*m2 + m1*m2*s**2)
    """
    from sympy import exp

    (chain,) = read_together([chain], damped=damped, sensor=quantity)
    num, den = expand(chain.structure)
    rational = quotient(coefficients(num, "s"), coefficients(den, "s"))
    return rational * exp(-symbol("s") * symbol("Td")) if chain.dead_time else rational


def is_renaming(left: Structure, right: Structure, renaming: dict[str, str]) -> bool:
    """Return True if renaming the left parameters turns the left transfer function into the right
    one: an exact identity.

    A dead time is a factor of its own, so it can only become the other's dead time.
    """
    if left.dead_time != right.dead_time or (left.dead_time and renaming["Td"] != "Td"):
        return False
    return become(expand(left), expand(right), renaming)


def become(a: Quotient, b: Quotient, renaming: Mapping[str, str]) -> bool:
    """Return True if renaming turns one numerator and its denominator into the other ones: an
    identity.
    """
    ring = symbols([str(g) for g in b[1].context().gens()])
    num, den = (rename_symbols(p, ring, renaming) for p in a)
    return (num, den) == b or bool(num * b[1] == b[0] * den)


def _valuation(polynomial: fmpz_mpoly) -> int:
    return min((powers[0] for powers in polynomial.monoms()), default=0)


def rank_is_at_most(structure: Structure, labels: Sequence[str], most: int, seconds: float) -> bool:
    """Proof that the Jacobian's rows with these labels (b_i, a_i, G_k; none = all coefficients)
    have no larger generic rank.

    False proves nothing. Raises OutOfTimeError after about `seconds`.

    >>> from disting.model.family import Family
    >>> rank_is_at_most(Family(3, damped=True)[7].structure, (), 6, 5.0)
    True
    """
    top, bottom = (coefficients(part, "s") for part in expand(structure))
    names = [name for name in structure.parameters if name != "Td"]
    units: dict[str | int, int] = {
        next(name for name in names if name[0] == kind): 1
        for kind in "mk"
        if any(name[0] == kind for name in names)
    }
    return coefficients_have_rank([(top, bottom)], names, labels, most, seconds, units)


def coefficients_have_rank(
    entries: Sequence[tuple[Sequence[fmpz_mpoly], Sequence[fmpz_mpoly]]],
    names: Sequence[str],
    labels: Sequence[str],
    most: int,
    seconds: float,
    units: Mapping[str | int, int] = NO_UNITS,
) -> bool:
    """Proof that coefficients of transfer functions have a Jacobian of rank `most` at most, in the
    parameters `names`; `units`: parameters that are one without loss of generality.

    `entries`: numerator and denominator of each, coefficients of s^0, s^1, ..; `labels` as in
    `rank_is_at_most`, of a single transfer function. False proves nothing. Raises OutOfTimeError.
    """
    if not labels:
        every = [
            (ratio, 1, bottom[-1]) for top, bottom in entries for ratio in (*top, *bottom[:-1])
        ]
        return rank([_row(names, units, *ratio) for ratio in every], seconds) <= most
    ((top, bottom),) = entries
    lead = bottom[-1]
    if all(name[0] == "G" and name != "G0" for name in labels):
        proper = [
            *((r, 2) for r in _strictly_proper(top, bottom)),
            *((d, 1) for d in bottom[:-1]),
        ]
        if rank([_row(names, units, *entry, lead) for entry in proper], seconds) <= most:
            return True
    rows = [_row(names, units, *_invariant(name, top, bottom), lead) for name in labels]
    return rank(rows, seconds) <= most


def _invariant(
    name: str, tops: Sequence[fmpz_mpoly], bottoms: Sequence[fmpz_mpoly]
) -> tuple[fmpz_mpoly, int]:
    """Numerator of an invariant, and the power of the leading coefficient below it."""
    kind, number = name[0], int(name[1:])
    if kind == "G":
        return _markov(number, tops, bottoms), number + 1
    chosen = tops if kind == "b" else bottoms
    return (chosen[number] if number < len(chosen) else 0 * bottoms[0]), 1


def _strictly_proper(tops: Sequence[fmpz_mpoly], bottoms: Sequence[fmpz_mpoly]) -> list[fmpz_mpoly]:
    """r_i of G - G_0."""
    if len(tops) < len(bottoms):
        return [bottoms[-1] * n for n in tops]
    return [bottoms[-1] * n - tops[-1] * d for n, d in zip(tops[:-1], bottoms[:-1], strict=True)]


def _markov(number: int, tops: Sequence[fmpz_mpoly], bottoms: Sequence[fmpz_mpoly]) -> fmpz_mpoly:
    """g_k by the recursion."""
    lead, m, zero = bottoms[-1], len(bottoms) - 1, 0 * bottoms[0]
    parameters: list[fmpz_mpoly] = []
    for k in range(number + 1):
        g = lead**k * (tops[m - k] if 0 <= m - k < len(tops) else zero)
        for i in range(1, min(k, m) + 1):
            g -= bottoms[m - i] * lead ** (i - 1) * parameters[k - i]
        parameters.append(g)
    return parameters[number]


def _row(
    names: Sequence[str],
    units: Mapping[str | int, int],
    top: fmpz_mpoly,
    power: int,
    lead: fmpz_mpoly,
) -> list[fmpz_mpoly]:
    """Gradient of top / lead^power, times lead^(power+1), in the units in which those parameters
    are one.
    """
    unknowns = dict(units)
    value, below = (p.subs(unknowns) for p in (top, lead))
    return [
        top.derivative(name).subs(unknowns) * below
        - power * value * lead.derivative(name).subs(unknowns)
        for name in names
    ]
