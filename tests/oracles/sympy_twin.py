"""Slow, plain SymPy twin of the analysis: sections 4 and 5 of the paper, written down as they
stand.

Chains are read by their indices, flags and parameter names alone, so this file shares no code with
what it checks. All functions are exact. Moment invariants ("entries") are elements of the field of
fractions ZZ(parameters), so that each knows its numerator and denominator; ranks are taken at a
random point modulo the prime 2^61 - 1.

M, D, K are the mechanical matrices (the paper writes C for K); A, B, C, D a state space (19).
"""

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain as flatten, combinations, permutations, product
from typing import Any, NamedTuple

from sympy import (
    GF,
    ZZ,
    Expr,
    Matrix,
    Poly,
    Symbol,
    cancel,
    eye,
    field,
    fraction,
    symbols,
    together,
    zeros,
)
from sympy.polys.fields import FracElement
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import PolyElement

PRIME = 2**61 - 1
FIELD = GF(PRIME, symmetric=False)
REPRESENTATIONS = ("tf", "markov")
S = Symbol("s")

Entries = tuple[FracElement, ...]
Polynomials = list[PolyElement]


# --- section 5.1: the equations of motion and their state space
# -----------------------------------------------------


class Mechanics(NamedTuple):
    """M x'' + D x' + K x = e_act F, y = e_meas^T x^(order)."""

    M: Matrix
    D: Matrix
    K: Matrix
    e_act: Matrix
    e_meas: Matrix


class StateSpace(NamedTuple):
    """x' = A x + B u, y = C x + D u (19)."""

    A: Matrix
    B: Matrix
    C: Matrix
    D: Matrix


def matrices(chain: Any) -> Mechanics:
    """Mechanical matrices by plain assembly: each element adds parameter * v v^T."""
    n = chain.n_masses
    joints = [i for i in range(n) if i != chain.gap]
    return Mechanics(
        M=_assembled(
            n, zip(_named(chain, "m"), [_unit(n, i) for i in range(1, n + 1)], strict=True)
        ),
        D=_assembled(
            n,
            zip(_named(chain, "d"), [_between(n, i) for i in joints if chain.damped], strict=True),
        )
        + _assembled(
            n, zip(_named(chain, "b"), [_unit(n, i) for i in chain.ground_dampers], strict=True)
        ),
        K=_assembled(n, zip(_named(chain, "k"), [_between(n, i) for i in joints], strict=True)),
        e_act=_unit(n, chain.act_plus) - _unit(n, chain.act_minus),
        e_meas=_unit(n, chain.meas_plus) - _unit(n, chain.meas_minus),
    )


def state_space(chain: Any) -> StateSpace:
    """(19) to (23): states are positions and velocities, then the lagged force where the chain
    has a lag.
    """
    if getattr(chain, "dead_time", False):
        raise ValueError("a chain with dead time has no finite state space")
    mechanics, n = matrices(chain), chain.n_masses
    inverse = mechanics.M.inv()
    upper = Matrix.hstack(zeros(n), eye(n))
    lower = Matrix.hstack(-inverse * mechanics.K, -inverse * mechanics.D)
    a = Matrix.vstack(upper, lower)  # (20)
    b = Matrix.vstack(zeros(n), inverse)  # (21)
    c = Matrix.vstack(eye(2 * n), upper * a)  # (22)
    d = Matrix.vstack(zeros(2 * n, n), upper * b)  # (23)
    rows = slice(chain.quantity.order * n, (chain.quantity.order + 1) * n)
    plain = StateSpace(
        a,
        b * mechanics.e_act,
        mechanics.e_meas.T * c[rows, :],
        mechanics.e_meas.T * d[rows, :] * mechanics.e_act,
    )
    return _lagged(plain, Symbol("T1")) if chain.lag else plain


def _named(chain: Any, kind: str) -> list[Symbol]:
    return [Symbol(name) for name in chain.parameters if name.startswith(kind)]


def _unit(n: int, i: int) -> Matrix:
    """Unit vector of mass i; zero for the ground, i = 0."""
    return Matrix([1 if j == i else 0 for j in range(1, n + 1)])


def _between(n: int, i: int) -> Matrix:
    return _unit(n, i + 1) - _unit(n, i)


def _assembled(n: int, elements: Iterable[tuple[Symbol, Matrix]]) -> Matrix:
    return sum((parameter * v * v.T for parameter, v in elements), zeros(n))


def _lagged(plain: StateSpace, time_constant: Symbol) -> StateSpace:
    """The force F follows the input u with T1 F' + F = u and becomes the last state."""
    states = plain.A.rows
    return StateSpace(
        Matrix.vstack(
            Matrix.hstack(plain.A, plain.B),
            Matrix.hstack(zeros(1, states), Matrix([-1 / time_constant])),
        ),
        Matrix.vstack(zeros(states, 1), Matrix([1 / time_constant])),
        Matrix.hstack(plain.C, plain.D),
        zeros(1, 1),
    )


# --- sections 4.1 and 4.3: moment invariants
# ------------------------------------------------------------------------


class TransferFunction(NamedTuple):
    """Coefficients of (25): b0..bn and a0..a(m-1); the leading denominator coefficient is 1."""

    numerator: Entries
    denominator: Entries


def transfer_function_textbook(chain: Any) -> TransferFunction:
    """(24) as printed, with a symbolic inverse of (I s - A) and one `cancel`."""
    a, b, c, d = state_space(chain)
    response = (c * (eye(a.rows) * S - a).inv() * b + d)[0, 0]
    numerator, denominator = (Poly(part, S) for part in fraction(cancel(together(response))))
    fractions = _fractions(chain)
    leading = denominator.LC()
    b_all, a_all = (
        tuple(
            fractions.from_expr(together(coefficient / leading))
            for coefficient in reversed(part.all_coeffs())
        )
        for part in (numerator, denominator)
    )
    return TransferFunction(b_all, a_all[:-1])


def transfer_function(chain: Any) -> TransferFunction:
    """(24) without an inverse: C adj(I s - A) B + D det(I s - A) over det(I s - A), cancelled.

    With det = sum a_j s^j, the columns N_j of adj(I s - A) B = sum N_j s^j follow from (I s - A)
    sum N_j s^j = B det: N_(j-1) = A N_j + a_j B, starting with N_(m-1) = B.
    """
    a, b, c, d = polynomial_form(chain)
    denominator = list(reversed(a.charpoly()))
    numerator = [_scalar(d) * coefficient for coefficient in denominator]
    column = b
    for j in reversed(range(len(denominator) - 1)):
        numerator[j] += _scalar(c * column)
        column = a * column + b.scalarmul(denominator[j])
    numerator, denominator = _lowest_terms(numerator, denominator)
    return TransferFunction(_entries(chain, numerator), _entries(chain, denominator[:-1]))


def markov_parameters(chain: Any, count: int) -> Entries:
    """G_0 = D and G_i = C A^(i-1) B for i = 1..count (32)."""
    a, column, c, d = polynomial_form(chain)
    found = [_scalar(d)]
    for _ in range(count):
        found.append(_scalar(c * column))
        column = a * column
    return _entries(chain, found)


def _fractions(chain: Any) -> Any:
    return field([Symbol(name) for name in chain.parameters], ZZ)[0]


def _is_inverted(parameter: str) -> bool:
    """Masses and the lag's time constant enter (19) only as 1/m and 1/T1."""
    return parameter[0] in "mT"


def polynomial_form(chain: Any) -> list[DomainMatrix]:
    """A, B, C, D with m standing for 1/m and T1 for 1/T1, so that all entries are polynomials."""
    inverted = {Symbol(name): 1 / Symbol(name) for name in chain.parameters if _is_inverted(name)}
    domain = ZZ[symbols(chain.parameters)]
    return [
        DomainMatrix.from_Matrix(part.subs(inverted)).convert_to(domain)
        for part in state_space(chain)
    ]


def _entries(chain: Any, polynomials: Iterable[PolyElement]) -> Entries:
    """Undo the inversion: a polynomial in 1/m becomes (polynomial in m) / (monomial in m)."""
    fractions = _fractions(chain)
    inverted = [_is_inverted(name) for name in chain.parameters]
    return tuple(_reciprocal(polynomial, inverted, fractions) for polynomial in polynomials)


def _reciprocal(polynomial: PolyElement, inverted: Sequence[bool], fractions: Any) -> FracElement:
    degrees = [
        max(degree, 0) if flip else 0
        for degree, flip in zip(polynomial.degrees(), inverted, strict=True)
    ]
    flipped = {
        tuple(
            top - e if flip else e for e, top, flip in zip(monomial, degrees, inverted, strict=True)
        ): coefficient
        for monomial, coefficient in polynomial.items()
    }
    return fractions.raw_new(
        fractions.ring.from_dict(flipped), fractions.ring.from_dict({tuple(degrees): ZZ.one})
    )


def _scalar(matrix: DomainMatrix) -> PolyElement:
    return matrix[0, 0].element


def _lowest_terms(
    numerator: Polynomials, denominator: Polynomials
) -> tuple[Polynomials, Polynomials]:
    """Coefficients (low to high) of the cancelled quotient, the denominator monic again, no
    zeros at the top.
    """
    ring = denominator[-1].ring
    in_s = ring.clone(symbols=(S, *ring.symbols))
    b, a = (
        in_s.from_dict(
            {
                (j, *monomial): c
                for j, coefficient in enumerate(part)
                for monomial, c in coefficient.items()
            }
        )
        for part in (numerator, denominator)
    )
    _, *reduced = b.cofactors(a)
    b, a = (
        [_coefficient_of_s(part, j, ring) for j in range(part.degree() + 1)] for part in reduced
    )
    assert a[-1] in (ring.one, -ring.one)  # a divisor of a monic polynomial is monic up to its sign
    return [x * a[-1] for x in b], [x * a[-1] for x in a]


def _coefficient_of_s(polynomial: PolyElement, power: int, ring: Any) -> PolyElement:
    return ring.from_dict({m[1:]: v for m, v in polynomial.items() if m[0] == power})


# --- values, Jacobians, ranks and row sets at a point
# ---------------------------------------------------------------


def random_point(parameters: Iterable[str], seed: int) -> dict[str, int]:
    """A random non-zero number modulo the prime for each parameter."""
    draw = random.Random(seed)
    return {name: draw.randrange(1, PRIME) for name in parameters}


def values(entries: Iterable[FracElement], point: Mapping[str, int]) -> list[int]:
    """Values of the entries at a point, modulo the prime."""
    return [
        _value(entry.numer, point) * pow(_value(entry.denom, point), -1, PRIME) % PRIME
        for entry in entries
    ]


def jacobian(
    entries: Iterable[FracElement], parameters: Sequence[str], point: Mapping[str, int]
) -> DomainMatrix:
    """J = d Phi / d p at a point, modulo the prime; one row per entry, one column per parameter."""
    rows = [[FIELD(x) for x in _gradient(entry, parameters, point)] for entry in entries]
    return DomainMatrix(rows, (len(rows), len(parameters)), FIELD)


def jacobian_rank(entries: Iterable[FracElement], parameters: Sequence[str], seed: int = 0) -> int:
    """Generic rank of the Jacobian: its rank at a random point, too small with probability
    below 1e-15.
    """
    return int(jacobian(entries, parameters, random_point(parameters, seed)).rank())


def row_bases(jacobian_at_point: DomainMatrix, rank: int) -> frozenset[tuple[int, ...]]:
    """All sets of `rank` independent rows, by trying every combination of the rows that are not
    zero (condition 5).
    """
    height, width = jacobian_at_point.shape
    live = [
        i for i in range(height) if not jacobian_at_point.extract([i], range(width)).is_zero_matrix
    ]
    chosen = combinations(live, rank)
    return frozenset(
        rows for rows in chosen if jacobian_at_point.extract(rows, range(width)).rank() == rank
    )


def _value(polynomial: PolyElement, point: Mapping[str, int]) -> int:
    numbers = [point[str(symbol)] for symbol in polynomial.ring.symbols]
    return sum(_term(int(c), m, numbers) for m, c in polynomial.items()) % PRIME


def _term(coefficient: int, monomial: tuple[int, ...], numbers: Sequence[int]) -> int:
    for number, exponent in zip(numbers, monomial, strict=True):
        if exponent:
            coefficient = coefficient * pow(number, exponent, PRIME) % PRIME
    return coefficient


def _gradient(entry: FracElement, parameters: Sequence[str], point: Mapping[str, int]) -> list[int]:
    """(u/v)' = (u' v - u v') / v^2 for each parameter."""
    u, v = _value(entry.numer, point), _value(entry.denom, point)
    slopes = [
        [_value(part.diff(part.ring(Symbol(name))), point) for part in (entry.numer, entry.denom)]
        for name in parameters
    ]
    return [(du * v - u * dv) * pow(v, -2, PRIME) % PRIME for du, dv in slopes]


# --- section 4.1: conditions
# ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Summary:
    """What the conditions need to know of one model in one representation."""

    representation: str
    parameters: tuple[str, ...]
    n_states: int
    entries: Entries
    n_numerator: int  # 0 for Markov parameters
    seed: int = 0

    @cached_property
    def symbolic_form(self) -> tuple[int, ...]:
        """0 for constant, 1 for non-constant invariants (condition 3)."""
        return tuple(int(not _is_constant(entry)) for entry in self.entries)

    @cached_property
    def constants(self) -> dict[int, Expr]:
        """Constant invariants by position."""
        return {i: entry.as_expr() for i, entry in enumerate(self.entries) if _is_constant(entry)}

    @cached_property
    def jacobian(self) -> DomainMatrix:
        """The Jacobian at this summary's random point."""
        return jacobian(self.entries, self.parameters, random_point(self.parameters, self.seed))

    @cached_property
    def rank(self) -> int:
        """Number of determinable parameters."""
        return int(self.jacobian.rank())

    @cached_property
    def bases(self) -> frozenset[tuple[int, ...]]:
        """Largest sets of linearly independent rows (condition 5)."""
        return row_bases(self.jacobian, self.rank)


def summary(chain: Any, representation: str = "tf", count: int = 0, seed: int = 0) -> Summary:
    """Transfer-function coefficients (b0.., a0..), or G_0..G_count."""
    n_states = 2 * chain.n_masses + chain.lag
    if representation == "tf":
        b, a = transfer_function(chain)
        return Summary("tf", chain.parameters, n_states, b + a, len(b), seed)
    if representation == "markov":
        return Summary(
            "markov", chain.parameters, n_states, markov_parameters(chain, count), 0, seed
        )
    raise ValueError(f"a representation is one of {REPRESENTATIONS}, not {representation!r}")


def condition_1(left: Summary, right: Summary) -> bool:
    """Equally many moment invariants; fulfilled by choice with Markov parameters."""
    return len(left.entries) == len(right.entries)


def condition_2(left: Summary, right: Summary) -> bool:
    """Equally many coefficients in the numerator and in the denominator; Markov parameters have
    no such split.
    """
    return left.n_numerator == right.n_numerator and condition_1(left, right)


def condition_3(left: Summary, right: Summary) -> bool:
    """Same symbolic form."""
    return left.symbolic_form == right.symbolic_form


def condition_4(left: Summary, right: Summary) -> bool:
    """Same generic rank of the Jacobian."""
    return left.rank == right.rank


def condition_5(left: Summary, right: Summary) -> bool:
    """Same largest sets of linearly independent rows."""
    return left.bases == right.bases


def condition_6(left: Summary, right: Summary) -> bool:
    """A renaming of the left parameters turns the left invariants into the right ones."""
    return next(renamings(left, right), None) is not None


def condition_7(left: Summary, right: Summary) -> bool:
    """As many determinable parameters as non-constant invariants in both models, and the same
    constants.
    """
    full = all(model.rank == sum(model.symbolic_form) for model in (left, right))
    return full and left.rank == right.rank and left.constants == right.constants


NECESSARY = (condition_1, condition_2, condition_3, condition_4, condition_5)
SUFFICIENT = (condition_6, condition_7)


def renamings(left: Summary, right: Summary) -> Iterator[dict[str, str]]:
    """Yield each one-to-one renaming of parameters (left to right) that makes all invariants equal.

    Plain search: only parameters of equal degrees in all invariants can take each other's place.
    """
    if len(left.parameters) != len(right.parameters) or len(left.entries) != len(right.entries):
        return
    mine, theirs = _by_degrees(left), _by_degrees(right)
    if {key: len(group) for key, group in mine.items()} != {
        key: len(group) for key, group in theirs.items()
    }:
        return
    for choice in product(*(permutations(theirs[key]) for key in mine)):
        renaming = dict(
            zip(flatten.from_iterable(mine.values()), flatten.from_iterable(choice), strict=True)
        )
        if all(
            _renamed(a, renaming) == _plain(b)
            for a, b in zip(left.entries, right.entries, strict=True)
        ):
            yield renaming


def _is_constant(entry: FracElement) -> bool:
    return entry.numer.is_ground and entry.denom.is_ground


def _by_degrees(model: Summary) -> dict[tuple[tuple[int, int], ...], list[str]]:
    groups: dict[tuple[tuple[int, int], ...], list[str]] = {}
    for position, name in enumerate(model.parameters):
        key = tuple(
            (entry.numer.degree(position), entry.denom.degree(position)) for entry in model.entries
        )
        groups.setdefault(key, []).append(name)
    return groups


def _renamed(
    entry: FracElement, renaming: Mapping[str, str]
) -> list[dict[frozenset[tuple[str, int]], int]]:
    """Numerator and denominator as {monomial: coefficient}, a monomial being a set of (new
    name, exponent).
    """
    names = [renaming.get(str(symbol), str(symbol)) for symbol in entry.numer.ring.symbols]
    return [
        {
            frozenset((x, e) for x, e in zip(names, monomial, strict=True) if e): int(c)
            for monomial, c in part.items()
        }
        for part in (entry.numer, entry.denom)
    ]


def _plain(entry: FracElement) -> list[dict[frozenset[tuple[str, int]], int]]:
    return _renamed(entry, {})


# --- deciding pairs
# -------------------------------------------------------------------------------------------------


def first_failing(left: Summary, right: Summary) -> int:
    """Number of the first necessary condition that fails, 0 if all hold."""
    return next(
        (number for number, condition in enumerate(NECESSARY, 1) if not condition(left, right)), 0
    )


def first_sufficient(left: Summary, right: Summary) -> int:
    """6 or 7 if that condition holds, else 0; too few Markov parameters prove no
    indistinguishability (section 4.3).
    """
    if left.representation == "markov" and len(left.entries) - 1 < left.n_states + right.n_states:
        return 0
    return next(
        (number for number, condition in enumerate(SUFFICIENT, 6) if condition(left, right)), 0
    )


def decide(left: Any, right: Any, representation: str = "tf", count: int = 0) -> int:
    """Number of the first of conditions 1 to 5 that fails for two chains, 0 if none does."""
    return first_failing(
        summary(left, representation, count), summary(right, representation, count)
    )


def decide_family(
    chains: Iterable[Any], representation: str = "tf", count: int = 0
) -> dict[tuple[int, int], int]:
    """Each pair's deciding condition: 1 to 5 distinguishable, 6 and 7 indistinguishable, 0
    open; models from 1.
    """
    models = list(enumerate((summary(chain, representation, count) for chain in chains), 1))
    return {
        (i, j): first_failing(left, right) or first_sufficient(left, right)
        for (i, left), (j, right) in combinations(models, 2)
    }
