"""Solutions modulo the prime from a Gröbner basis with finitely many of them.

The monomials that no leading monomial divides are a basis b of the quotient. With x_i b = M_i b
modulo the ideal, the values b(q) at a solution q are a common eigenvector of all M_i with the
eigenvalues q_i. So a root, modulo the prime, of the characteristic polynomial of a random
combination of the M_i leads to q, if its eigenspace is a line. (W. Auzinger, H. J. Stetter, An
elimination algorithm for the computation of all zeros, 1988.) There may be none: solutions can lie
in extension fields only.
"""

from collections.abc import Iterator

from flint import nmod_mat

from disting.algebra.certainty import residues
from disting.algebra.groebner.elimination import Basis, MatrixRow

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
        row = _reducer(basis, m)
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


def _reducer(basis: Basis, code: int) -> MatrixRow:
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
