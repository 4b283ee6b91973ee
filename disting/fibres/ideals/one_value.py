"""Parameters with a single value in a generic fibre of a coefficient map: the fibre over a random
point p0 of the same model, modulo a random prime.

Parameter j has another value there exactly if the equations of the fibre together with t (q_j -
p0_j) = 1 have a solution (J. L. Rabinowitsch 1929): if the Gröbner basis is not {1}. No solution
has to be found, nor need solutions be finitely many: where the rank r is smaller than the number n
of parameters, n - r of them are fixed at random values, which every component of a generic fibre
attains, and the tangent equations hold on each (see `fibre_ideal`). For all components of a
generic fibre have the dimension n - r, so each component of {(p, q): Phi(p) = Phi(q)} that
dominates the points p has the dimension 2 n - r, and dominates the points q as well. So generic
fibres contain no q with an element that is zero either.

EMPTY: q_j = p_j in generic fibres. Suppose that h = q_j - p_j is not zero on a component X that
dominates the points p. As in `bounds`, a point p0 modulo a prime lies below a point of X unless the
product of the leading coefficients A_i vanishes there. Here h has to have an inverse at the point
above, too. h is algebraic over the p and the q that are free: as `bounds` finds A_j for q_j, it
finds an equation c_k h^k + .. + c_0 = 0, with c_0 other than 0 because h is not zero on X, which is
irreducible. So 1/h is integral where c_0 is not zero: one more factor, from a relation in which h,
of degree 1 and norm 2, takes the place of q_j.

NOT EMPTY: q_j takes more values. Suppose that p_j is determined by Phi(p) for generic p; then q_j
is a rational function of Phi (characteristic 0). Take forms in the coordinates as in `bounds`, the
i-th one of the i-th and later ones with a first factor other than 0: l_1, .., l_r that are
algebraically independent on V, and l_0 of the coordinates after the r-th one, such that l_0
distinguishes the points of V that have the same l_1, .., l_r, at most delta of them. Where these
agree in the coordinates after the r-th one they agree, by l_r, .., l_1, in all; so that is one
linear condition for each pair, and factors of 0, .., delta^2 do. Let u be one more variable and G
the irreducible polynomial with G(l, l_0 + u q_j, u) = 0. In its second argument T it has the degree
of the minimal polynomial of l_0, at u = 0 too, so that dG/dT is not zero there. The derivative by u
at u = 0 is dG/dT q_j + dG/du = 0: an identity of integer polynomials in q, which holds modulo every
prime. So all q of the fibre of p0, in whatever extension, and p0 itself satisfy D q_j + N = 0,
where D and N depend on Phi(p0) alone. If q_j is not p0_j, then D = 0: a polynomial in p0 that is
not zero vanishes by accident. G divides the relation of the l_i, l_0 + u q_j, u and the n - r other
q; D is a derivative of it, which multiplies its coefficients by its degree at most.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import ceil, log2
from operator import ge
from time import process_time

from disting.algebra.certainty import LEAST_SAFETY, about
from disting.algebra.groebner.elimination import Basis, TooLarge, basis_steps
from disting.algebra.groebner.modular import Sparse
from disting.errors import ContradictionError
from disting.fibres.ideals.bounds import LEAST, safety_of_one_value, safety_of_other_values
from disting.fibres.ideals.fibre_ideal import FibreIdeal, fibre_ideal
from disting.fibres.ideals.membership import NO_BOUND, OUT_OF_TIME, GivenUp, Limits
from disting.fibres.ideals.system import PolynomialMap

REMEMBERED = 8  # fibres: those of one model, of which two statements are asked one after the other
LIMITS = Limits(seconds=20.0, entries=2_000_000, safety=LEAST_SAFETY + 8)


@dataclass(frozen=True, slots=True)
class ValueCounts:
    """Parameters with one value (`unique`) in a generic fibre and with `several`; for the others
    `reason` explains why nothing is known. Any of it is wrong with a probability of at most
    2**-safety.
    """

    unique: tuple[str, ...] = ()
    several: tuple[str, ...] = ()
    safety: int = 0
    reason: str = ""


def one_value(model: PolynomialMap, names: Iterable[str], *, seed: str) -> ValueCounts:
    """Find the parameters, among these locally identifiable ones, that have a single value.

    >>> from disting.fibres.ideals.system import coefficient_map
    >>> from disting.model.chain import Chain
    >>> chain = Chain(3, act_plus=2, meas_plus=2, damped=False)
    >>> found = one_value(coefficient_map(chain.structure), chain.parameters, seed="doc")
    >>> found.unique, found.several
    (('m2',), ('m1', 'm3', 'k12', 'k23'))
    """
    wanted = [name for name in model.parameters if name in set(names)]
    if not wanted:
        return ValueCounts()
    each = min(safety_of_one_value(model), safety_of_other_values(model))
    if each < LEAST:
        return ValueCounts(reason=NO_BOUND)
    runs = ceil((LIMITS.safety + ceil(log2(len(wanted) + 1))) / each)
    deadline = process_time() + LIMITS.seconds
    label = _label(model, seed)
    single: dict[str, bool] = {}
    try:
        for run in range(runs):
            remaining = wanted if not run else list(single)
            for name, is_one in _at_point(model, remaining, f"{label}:{run}", deadline):
                if single.setdefault(name, is_one) != is_one:
                    return ValueCounts(reason="one random point contradicts another")
    except GivenUp as why:
        return ValueCounts(reason=str(why))
    unique, several = (tuple(n for n in wanted if single[n] is kind) for kind in (True, False))
    return ValueCounts(unique, several, each * runs - ceil(log2(len(wanted) + 1)))


def safety_of_count(model: PolynomialMap, known: int, *, seed: str) -> int:
    """Bits of error probability of "a generic fibre has no other points than these", where so many
    are `known` as images of one of them under renamings; 0 where that is not shown.

    The algebra of the fibre over a random point has the dimension `known`. Another component X of
    all pairs of one response would have a point above it, other than all that are known: for each
    of these a difference h of two coordinates is not zero on X, and EMPTY, above, bounds the
    probability that h has no inverse there.

    >>> from disting.fibres.ideals.system import coefficient_map
    >>> from disting.model.chain import Chain
    >>> chain = Chain(3, act_plus=2, meas_plus=2, damped=False)
    >>> safety_of_count(coefficient_map(chain.structure), 2, seed="doc") > 100
    True
    """
    each = safety_of_one_value(model) - ceil(log2(known + 1)) - 1  # and values that are equal
    if each < LEAST:
        return 0
    runs = ceil(LIMITS.safety / each)
    deadline = process_time() + LIMITS.seconds
    label = _label(model, seed)
    for run in range(runs):
        ideal = _own_fibre(model, f"{label}:{run}")
        if ideal.fixed:
            return 0
        try:
            basis = _basis_at(model, f"{label}:{run}", deadline)
        except GivenUp:
            return 0
        leads = [basis.order.decode(row.codes[0]) for row in basis.rows]
        if _dimension(leads, len(ideal.unknowns), known) != known:
            return 0
    return each * runs


def _dimension(leads: Sequence[tuple[int, ...]], size: int, most: int) -> int:
    """Number of monomials that no leading one divides, as far as it is at most `most`."""
    start = (0,) * size
    visited, waiting = {start}, [start]
    while waiting and len(visited) <= most:
        here = waiting.pop()
        for i in range(size):
            there = tuple(e + (i == j) for j, e in enumerate(here))
            divided = any(all(map(ge, there, lead)) for lead in leads)
            if there not in visited and not divided:
                visited.add(there)
                waiting.append(there)
    return len(visited)


def _at_point(
    model: PolynomialMap, names: Iterable[str], label: str, deadline: float
) -> Iterator[tuple[str, bool]]:
    """Yield whether each parameter has no other value in the fibre of one random point."""
    ideal, basis = _own_fibre(model, label), _basis_at(model, label, deadline)
    if basis.is_one:
        raise ContradictionError("a point does not lie in its own fibre")
    origin = dict(zip(model.parameters, ideal.point, strict=True))
    rows: list[Sparse] = [
        {basis.order.decode(c): x for c, x in zip(row.codes, row.numbers, strict=True)}
        for row in basis.rows
    ]
    for name in names:
        at, value = ideal.unknowns.index(name), origin[name]
        is_single = _is_given(rows, at, value, ideal.modulus)
        yield name, is_single or _has_no_other(ideal, rows, at, value, deadline)


def _label(model: PolynomialMap, seed: str) -> str:
    """The label of the random points: one for both statements, so that the bases of their fibres
    are computed once. Each bound holds for itself.
    """
    return about(f"one value:{seed}", model.content)


@lru_cache(maxsize=REMEMBERED)
def _own_fibre(model: PolynomialMap, label: str) -> FibreIdeal:
    return fibre_ideal(model, model, label, equal_rank=True)


def _basis_at(model: PolynomialMap, label: str, deadline: float) -> Basis:
    """The Gröbner basis of the fibre of one random point; raises GivenUp."""
    found = _own_basis(model, label)
    if isinstance(found, GivenUp):
        raise GivenUp(str(found))
    _check_time(deadline)
    return found


@lru_cache(maxsize=REMEMBERED)
def _own_basis(model: PolynomialMap, label: str) -> Basis | GivenUp:
    """The basis, or why it is given up: the second statement would give it up again."""
    ideal, deadline = _own_fibre(model, label), process_time() + LIMITS.seconds
    try:
        return _basis(ideal.generators, len(ideal.unknowns), ideal.modulus, deadline)
    except GivenUp as why:
        return why


def _check_time(deadline: float) -> None:
    if process_time() > deadline:
        raise GivenUp(f"{OUT_OF_TIME} ({LIMITS.seconds:g} s)")


def _is_given(rows: Iterable[Sparse], at: int, value: int, modulus: int) -> bool:
    """Return True if an equation of the basis states that the unknown has its value at p0."""
    return any(
        len(row) == 2
        and row.get(_power(size := len(next(iter(row))), at)) == 1
        and row.get((0,) * size) == modulus - value
        for row in rows
    )


def _power(size: int, at: int) -> tuple[int, ...]:
    return tuple(int(i == at) for i in range(size))


def _has_no_other(
    ideal: FibreIdeal,
    rows: Iterable[Sparse],
    at: int,
    value: int,
    deadline: float,
) -> bool:
    """Return True if no solution has a value different from that at p0: 1 is in the ideal with t (q
    - p0) - 1.
    """
    size = len(ideal.unknowns) + 1
    t, zero = _power(size, size - 1), (0,) * size
    inverse = {(*_power(size - 1, at), 1): 1, t: -value, zero: -1}
    lifted = [{(*e, 0): c for e, c in row.items()} for row in rows]
    return _basis([*lifted, inverse], size, ideal.modulus, deadline).is_one


def _basis(generators: Iterable[Sparse], size: int, modulus: int, deadline: float) -> Basis:
    """The Gröbner basis; raises GivenUp."""
    try:
        for step in basis_steps(generators, size, modulus):
            if isinstance(step, Basis):
                return step
            if step > LIMITS.entries:
                raise GivenUp(f"too large: a matrix of {step} entries")
            _check_time(deadline)
    except TooLarge as error:
        raise GivenUp(f"too large: {error}") from None
    raise AssertionError("a Gröbner basis ends with a basis")
