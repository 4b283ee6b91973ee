"""Gröbner bases modulo a prime by linear algebra: the F4 algorithm, in steps that can be
interleaved and given up.

Pairs of basis elements of the smallest degree are reduced all at once, as rows of one matrix
together with the multiples that their monomials call for. Those multiples are many, sparse and
triangular: they are used as they are, row by row, and FLINT brings the few rows that remain into
echelon form. New leading monomials that are of lower degree than their pairs ("mutants") are
handled first in the next step, because the smallest degree comes first. Generators wait until
their own degree is reached, so a system that is contradictory in low degrees never looks at its
large equations. Pairs are thinned out by the criteria of Gebauer and Möller. (J.-C. Faugère, A new
efficient algorithm for computing Gröbner bases (F4), J. Pure Appl. Algebra 139, 1999; R. Gebauer,
H. M. Möller, On an installation of Buchberger's algorithm, J. Symb. Comp. 6, 1988.)

Solutions modulo the prime follow from a basis with finitely many of them. The monomials that no
leading monomial divides are a basis b of the quotient. With x_i b = M_i b modulo the ideal, the
values b(q) at a solution q are a common eigenvector of all M_i with the eigenvalues q_i. So a root,
modulo the prime, of the characteristic polynomial of a random combination of the M_i leads to q, if
its eigenspace is a line. (W. Auzinger, H. J. Stetter, An elimination algorithm for the computation
of all zeros, 1988.) There may be none: solutions can lie in extension fields only.
"""

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import SupportsInt

from flint import nmod_mat

from disting.algebra.certainty import residues
from disting.algebra.groebner.modular import MAX_DEGREE, Order, Sparse, matrix as modular_matrix

Multiple = tuple[list[int], tuple[int, ...]]  # codes and coefficients of a row of the matrix
Pivots = dict[int, Multiple]  # by leading monomial
MAX_PAIRS = 400  # of one step: larger matrices cost more than they save


@dataclass(frozen=True, slots=True)
class MatrixRow:
    """A polynomial with leading coefficient 1: codes in falling order, and coefficients."""

    codes: tuple[int, ...]
    numbers: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Basis:
    """A Gröbner basis modulo a prime; `degree` is the largest degree that was needed to find it."""

    order: Order
    modulus: int
    rows: tuple[MatrixRow, ...]
    degree: int

    @property
    def is_one(self) -> bool:
        """True if the ideal is the whole ring: no common zeros, over any extension field."""
        return any(row.codes[0] == 0 for row in self.rows)


class TooLarge(Exception):
    """A degree that the codes of monomials cannot hold."""


@dataclass(slots=True)
class _Work:
    order: Order
    guard: int  # both of the order
    mask: int
    modulus: int
    waiting: list[MatrixRow]
    rows: list[MatrixRow] = field(default_factory=list)
    # exponents of their leading monomials, also as codes without degrees
    leads: list[tuple[int, ...]] = field(default_factory=list)
    lows: list[int] = field(default_factory=list)
    # elements whose leading monomial no other one divides
    active: list[int] = field(default_factory=list)
    pairs: list[tuple[int, int, int]] = field(default_factory=list)  # lcm, two elements
    reducers: dict[int, int] = field(default_factory=dict)  # monomial -> element that reduces it
    # monomial -> number of elements that were tried in vain
    missed: dict[int, int] = field(default_factory=dict)
    degree: int = 0


def basis_steps(generators: Iterable[Sparse], size: int, modulus: int) -> Iterator[Basis | int]:
    """Yield, before each step, the number of entries of its matrix, and the minimal basis at the
    end; raises TooLarge.

    >>> *_, basis = basis_steps([{(2,): 1, (0,): -1}, {(1,): 1, (0,): -2}], 1, 101)
    >>> basis.is_one  # x^2 = 1 and x = 2
    True
    """
    order, generators = Order(size), [g for g in generators if g]
    _limit(max((sum(e) for g in generators for e in g), default=0))
    rows = [_row({order.encode(e): c for e, c in g.items()}, modulus) for g in generators]
    work = _Work(
        order,
        order.guard,
        order.mask,
        modulus,
        sorted(
            (r for r in rows if r.codes), key=lambda r: (order.degree(r.codes[0]), len(r.codes))
        ),
    )
    while work.pairs or work.waiting:
        pivots, others, columns = _matrix(work, *_select_smallest(work))
        yield len(others) * len(columns)
        for new in _echelon(pivots, others, sorted(columns, reverse=True), modulus):
            if new.codes[0] == 0:
                yield Basis(order, modulus, (new,), work.degree)
                return
            _insert(work, new)
    yield Basis(order, modulus, tuple(work.rows[i] for i in work.active), work.degree)


def _limit(degree: int) -> None:
    if degree > MAX_DEGREE // 2:  # least common multiples have at most twice the degree
        raise TooLarge(f"degree {degree}")


def _row(polynomial: Mapping[int, int], modulus: int) -> MatrixRow:
    items = sorted(((m, c % modulus) for m, c in polynomial.items() if c % modulus), reverse=True)
    if not items:
        return MatrixRow((), ())
    inverse = pow(items[0][1], -1, modulus)
    return MatrixRow(tuple(m for m, _ in items), tuple(c * inverse % modulus for _, c in items))


def _select_smallest(work: _Work) -> tuple[list[MatrixRow], set[tuple[int, int]]]:
    """Generators and multiples (factor, element) of the smallest degree, taken out of what
    waits.
    """
    degree = work.order.degree
    low = min(
        [degree(lcm) for lcm, _, _ in work.pairs] + [degree(r.codes[0]) for r in work.waiting[:1]]
    )
    work.degree = max(work.degree, low)
    _limit(work.degree)
    chosen = sorted(p for p in work.pairs if degree(p[0]) == low)[:MAX_PAIRS]
    gone = set(chosen)
    work.pairs = [p for p in work.pairs if p not in gone]
    fresh = [r for r in work.waiting if degree(r.codes[0]) == low]
    work.waiting = work.waiting[len(fresh) :]
    return fresh, {(lcm - work.rows[i].codes[0], i) for lcm, *two in chosen for i in two}


def _matrix(
    work: _Work, fresh: list[MatrixRow], multiples: set[tuple[int, int]]
) -> tuple[Pivots, list[Multiple], set[int]]:
    """One multiple for each leading monomial that is known, the shortest; all other rows; all
    monomials.
    """
    rows = [_multiple(work, f, i) for f, i in multiples]
    rows.sort(key=lambda row: (row[0][0], len(row[0]), row))
    pivots: Pivots = {}
    others = [row for row in rows if pivots.setdefault(row[0][0], row) is not row]
    others += [(list(r.codes), r.numbers) for r in fresh]
    visited = set(pivots)
    todo = {m for codes, _ in (*pivots.values(), *others) for m in codes} - visited
    while todo:
        visited |= todo
        found = {m: i for m in todo if (i := _reducer(work, m)) is not None}
        added = {m: _multiple(work, m - work.rows[i].codes[0], i) for m, i in found.items()}
        pivots |= added
        todo = {m for codes, _ in added.values() for m in codes} - visited
    return pivots, others, visited


def _multiple(work: _Work, factor: int, element: int) -> Multiple:
    return [m + factor for m in work.rows[element].codes], work.rows[element].numbers


def _reducer(work: _Work, code: int) -> int | None:
    if code in work.reducers:
        return work.reducers[code]
    guard, lows = work.guard, work.lows
    low, tried = (code & work.mask) | guard, work.missed.get(code, 0)
    for i in work.active[bisect_left(work.active, tried) :]:
        if (low - lows[i]) & guard == guard:
            work.reducers[code] = i
            return i
    work.missed[code] = len(work.rows)
    return None


def _echelon(
    pivots: Pivots, others: list[Multiple], columns: list[int], modulus: int
) -> list[MatrixRow]:
    """Rows with new leading monomials: the other rows, freed of the known leading monomials, in
    echelon form; 1 alone, if it is among those of a part of them.
    """
    at = {m: j for j, m in enumerate(columns)}
    placed = {at[m]: ([at[c] for c in codes], numbers) for m, (codes, numbers) in pivots.items()}
    free = [j for j in range(len(columns)) if j not in placed]
    steps = [(j, *placed[j]) for j in sorted(placed)]
    monomials, kept = [columns[j] for j in free], list[list[int]]()
    rows = list[MatrixRow]()
    for part in _parts(others, len(free)):
        reduced = (
            _reduce_row([at[c] for c in codes], numbers, steps, free, modulus)
            for codes, numbers in part
        )
        kept += [row for row in reduced if any(row)]
        rows = _independent(kept, monomials, modulus)
        if rows and rows[-1].codes[0] == 0:
            return rows[-1:]
    return rows


def _parts(rows: list[Multiple], width: int) -> list[list[Multiple]]:
    """All rows; where many depend on others, the larger half first, in which 1 is if anywhere."""
    first = 5 * len(rows) // 8 if 2 * len(rows) > width else 0
    return [part for part in (rows[:first], rows[first:]) if part]


def _independent(rows: list[list[int]], monomials: list[int], modulus: int) -> list[MatrixRow]:
    """Their echelon form."""
    if not rows:
        return []
    width = len(monomials)
    matrix, rank = modular_matrix(
        len(rows), width, [x for row in rows for x in row], modulus
    ).rref()
    entries = matrix.entries()
    return [_new_row(entries[r * width : (r + 1) * width], monomials) for r in range(rank)]


def _reduce_row(
    places: list[int],
    numbers: tuple[int, ...],
    steps: list[tuple[int, list[int], tuple[int, ...]]],
    free: list[int],
    modulus: int,
) -> list[int]:
    """A row minus multiples of the pivot rows, which are sparse, in the order of their columns:
    what is left in the free columns.
    """
    row = [0] * (len(steps) + len(free))
    for j, c in zip(places, numbers, strict=True):
        row[j] = c
    for j, columns, entries in steps:
        if row[j] and (factor := row[j] % modulus):
            for k, c in zip(columns, entries, strict=True):
                row[k] -= factor * c
    return [row[j] % modulus for j in free]


def _new_row(entries: Sequence[SupportsInt], columns: list[int]) -> MatrixRow:
    kept = [(m, int(c)) for m, c in zip(columns, entries, strict=True) if c]
    return MatrixRow(tuple(m for m, _ in kept), tuple(c for _, c in kept))


def _insert(work: _Work, new: MatrixRow) -> None:
    """Add an element, its pairs that the criteria leave, and drop the old pairs that it makes
    superfluous.
    """
    order, lead, h = work.order, new.codes[0], len(work.rows)
    guard, mask, lows = work.guard, work.mask, work.lows
    exponents, low = order.decode(lead), lead & mask
    lcms = {i: _lcm(order, exponents, work.leads[i]) for i in work.active}
    # only where the new leading monomial divides the least common multiple
    met = {
        p
        for p in work.pairs
        if (((p[0] & mask) | guard) - low) & guard == guard and _superfluous(work, p, exponents)
    }
    work.pairs = [p for p in work.pairs if p not in met] if met else work.pairs
    work.pairs += [(lcm, i, h) for lcm, i in _minimal(work, lcms, lead)]
    work.active = [
        *(i for i in work.active if ((lows[i] | guard) - low) & guard != guard),
        h,
    ]
    work.rows.append(new)
    work.lows.append(low)
    work.leads.append(exponents)


def _lcm(order: Order, a: tuple[int, ...], b: tuple[int, ...]) -> int:
    return order.encode(tuple(map(max, a, b)))


def _superfluous(work: _Work, pair: tuple[int, int, int], exponents: tuple[int, ...]) -> bool:
    """Return True if the least common multiples of the new monomial with both monomials of the pair
    differ from the pair's own.
    """
    lcm, i, j = pair
    return all(_lcm(work.order, exponents, work.leads[k]) != lcm for k in (i, j))


def _minimal(work: _Work, lcms: Mapping[int, int], lead: int) -> Iterator[tuple[int, int]]:
    """One pair for each least common multiple that no other divides, and none where a product
    of leading monomials is met.
    """
    groups: dict[int, list[int]] = {}
    for i, lcm in lcms.items():
        groups.setdefault(lcm, []).append(i)
    guard, mask, kept = work.guard, work.mask, list[int]()
    for lcm in sorted(groups):
        high = (lcm & mask) | guard
        if not any((high - low) & guard == guard for low in kept):
            kept.append(lcm & mask)
            if all(lcm != lead + work.rows[i].codes[0] for i in groups[lcm]):
                yield lcm, groups[lcm][0]


MAX_SOLUTIONS = 600


def free_variable(basis: Basis) -> int | None:
    """A variable of which no power is a leading monomial, so that the solutions are not finite in
    number; None if finite.

    The last one: the ideal is not everything.
    """
    pure = {
        e.index(max(e))
        for e in (basis.order.decode(r.codes[0]) for r in basis.rows)
        if sum(map(bool, e)) == 1
    }
    return max((i for i in range(basis.order.size) if i not in pure), default=None)


def solution(basis: Basis, label: str) -> tuple[int, ...] | None:
    """A solution with coordinates modulo the prime, if the basis has finitely many and one of
    these is found.
    """
    standard = [] if free_variable(basis) is not None else _standard(basis)
    if not standard:
        return None
    tables = [_table(basis, standard, i) for i in range(basis.order.size)]
    weights = residues(f"weights:{label}", len(tables), basis.modulus)
    size = len(standard)
    mixed = [
        [
            sum(w * t[r][k] for w, t in zip(weights, tables, strict=True)) % basis.modulus
            for k in range(size)
        ]
        for r in range(size)
    ]
    for vector in _eigenvectors(mixed, basis.modulus):
        scale = pow(vector[0], -1, basis.modulus)  # standard[0] is the monomial 1
        return tuple(
            sum(a * b for a, b in zip(t[0], vector, strict=True)) * scale % basis.modulus
            for t in tables
        )
    return None


def _standard(basis: Basis) -> list[int]:
    """Standard monomials, finitely many, in rising order; none if there are too many."""
    leads = [row.codes[0] for row in basis.rows]
    steps = _variables(basis)
    monomials, layer = list[int](), [0]
    while layer and len(monomials) <= MAX_SOLUTIONS:
        layer = [m for m in layer if not any(basis.order.divides(lead, m) for lead in leads)]
        monomials += layer
        layer = sorted({m + x for m in layer for x in steps})
    return [] if layer else sorted(monomials)


def _variables(basis: Basis) -> list[int]:
    n = basis.order.size
    return [basis.order.encode(tuple(int(i == j) for j in range(n))) for i in range(n)]


def _table(basis: Basis, standard: list[int], variable: int) -> list[list[int]]:
    """M_i: row r holds the normal form of x_i standard[r]."""
    step, at = _variables(basis)[variable], {m: k for k, m in enumerate(standard)}
    forms: dict[int, dict[int, int]] = {m: {m: 1} for m in standard}
    rows = [_normal_form(basis, m + step, forms) for m in standard]
    table = [[0] * len(standard) for _ in standard]
    for r, form in enumerate(rows):
        for m, c in form.items():
            table[r][at[m]] = c
    return table


def _normal_form(basis: Basis, code: int, forms: dict[int, dict[int, int]]) -> dict[int, int]:
    """Combination of standard monomials that equals a monomial; forms already found are kept in
    `forms`.
    """
    todo = [code]
    while todo:
        m = todo[-1]
        if m in forms:
            todo.pop()
            continue
        row = _row_that_reduces(basis, m)
        tail = [
            (c + m - row.codes[0], -x) for c, x in zip(row.codes[1:], row.numbers[1:], strict=True)
        ]
        missing = [c for c, _ in tail if c not in forms]
        if missing:
            todo += missing
            continue
        total: dict[int, int] = {}
        for c, x in tail:
            for standard, y in forms[c].items():
                total[standard] = (total.get(standard, 0) + x * y) % basis.modulus
        forms[m] = total
    return forms[code]


def _row_that_reduces(basis: Basis, code: int) -> MatrixRow:
    return next(row for row in basis.rows if basis.order.divides(row.codes[0], code))


def _eigenvectors(matrix: list[list[int]], modulus: int) -> Iterator[list[int]]:
    """Eigenvectors of the eigenvalues modulo the prime whose eigenspaces are lines, with a
    first entry that is not zero.
    """
    size = len(matrix)
    flat = [x for row in matrix for x in row]
    _, factors = nmod_mat(size, size, flat, modulus).charpoly().factor()
    roots = [-int(f[0]) * pow(int(f[1]), -1, modulus) for f, _ in factors if f.degree() == 1]
    for root in roots:
        shifted = [(x - root * (k % (size + 1) == 0)) % modulus for k, x in enumerate(flat)]
        space, nullity = nmod_mat(size, size, shifted, modulus).nullspace()
        vector = [int(space[i, 0]) for i in range(size)]
        if nullity == 1 and vector[0]:
            yield vector
