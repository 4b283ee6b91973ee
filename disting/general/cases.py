"""All admissible equivalents of a generic given model, case by case: unknowns solved for one after
the other, exactly.

EQUATIONS. Let given and searched model have the same degrees m in the numerator and n in the
denominator, and let p be such that N1(p), D1(p) are coprime and lead D1(p) is not zero; both hold
outside of the zeros of a polynomial in p that is not zero. Then N2(q)/D2(q) = N1(p)/D1(p) with
lead D2(q) != 0 is the same as equality of all coefficients over the leading one: D1(p) divides
N1(p) D2(q), so D2(q), which has the same degree, so D2(q) is a number times D1(p), and N2(q) the
same number times N1(p). The other direction is plain. For m = n the numerators are replaced by N -
G(oo) D, G(oo) = b_n/a_n, from which they follow. So invariants u(q)/v(q) = u(p)/v(p) are to be
equal, fractions in lowest terms, whose denominators divide powers of the leading coefficients and
are not zero where these are not: u(q) v(p) = u(p) v(q).

CASES. A case is a set of equations, of inequalities g > 0 and of unknowns that are solved for, q_j
= N/c. It starts with all equations and, over positive numbers, with nothing else: q > 0 is required
of each unknown when it is solved for. Each step replaces one case by others which together have the
same admissible solutions:

* A factor of an equation that has one sign is not zero: it is left out. A factor in the p alone is
  not zero where p is generic: it is left out and listed in `generic`. An equation without any
  factor left closes the case.
* Of an equation with several factors one is zero: one case for each.
* An equation c q_j + N = 0, c and N free of q_j: if c has one sign or contains the p alone (then
  it is listed), q_j = -N/c. Else one case with c = N = 0 and one with q_j = -N/c, where c is not
  zero. All other polynomials are multiplied by powers of c to be polynomials again, by even ones
  for inequalities unless c is positive. Over positive numbers -N/c > 0 is one more inequality.
* The case with q_j = -N/c holds only where c is not zero, nor N over positive numbers. Neither of
  it follows from the other equations, which were multiplied by c, nor from the inequalities, which
  lose even powers. So the irreducible factors of c (and N) that contain unknowns are kept as
  `nonzero`, and all that is solved for later is put into them. If one of them becomes 0, or is an
  equation of the case, but for a constant factor, no solution is in the case: it is closed. The
  first of them are the factors of lead(q). All denominators of the solved values divide products
  of these c and of polynomials in the p, so none of them becomes 0 in a case that is open.
* Two different irreducible equations in one and the same unknown and the p: they have no common
  factor over the field of fractions of the p, so their resultant is a polynomial in the p that is
  not zero. It is listed, and the case is closed.
* Of an inequality factors of one sign are left out, and even powers. These are positive or zero,
  so no solution is lost; what is gained are points at which g >= 0 is an equation, or at which a
  denominator is zero. An inequality that is seen to fail closes the case.

So every admissible equivalent of a p at which no `generic` polynomial vanishes belongs to a case;
and a point of a case gives an equivalent if no `nonzero` polynomial, and so no denominator, no
lead(q) and none of the values required to be positive, is zero there.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, permutations

from flint import fmpz_mpoly

from disting.algebra.certainty import residues
from disting.algebra.symbols import RationalFunction
from disting.general.elimination import Case, branches, substitute, unknown_factors
from disting.general.matrix_model import AnyModel
from disting.general.orthant import Orthant, TooMuch
from disting.model.question import Domain

PAIR = 2  # equations of which an unknown is eliminated
CASES = 300  # that are opened before the search is given up
ORDERS = 24  # in which five unknowns and more are solved for
ALL_ORDERS = 4  # unknowns: these have 24 orders
RESULTANTS = 24  # sum of total degrees: resultants stay a matter of milliseconds


@dataclass(slots=True)
class Search:
    """The cases found so far, the polynomials in the p that do not vanish, and why other cases
    are closed.
    """

    ring: Orthant
    order: tuple[int, ...]
    cases: list[Case] = field(default_factory=list)
    generic: list[fmpz_mpoly] = field(default_factory=list)
    closed: list[str] = field(default_factory=list)
    opened: int = 0


def orders(unknowns: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Yield the orders in which unknowns are solved for: all of up to four of them; of more, their
    own one and drawn ones, the same in every run.

    In most orders a search of seven unknowns grows too large, in some it ends at once; neighbours
    in the alphabet begin with the same unknowns, and so fail together.
    """
    if len(unknowns) <= ALL_ORDERS:
        yield from permutations(unknowns)
        return
    yield tuple(unknowns)
    for k in range(1, ORDERS):
        keys = residues(f"order:{k}", len(unknowns), 1 << 61)
        yield tuple(x for _, x in sorted(zip(keys, unknowns, strict=True)))


def search_cases(ring: Orthant, model: AnyModel, other: AnyModel, order: tuple[int, ...]) -> Search:
    """All cases of the equivalents of `model` in `other`, unknowns solved for in this order of
    preference; raises TooMuch.

    Both models have the same degrees.
    """
    start = Case(
        tuple(ring.equations(model, other)), nonzero=unknown_factors(ring, [ring.lead(other)])
    )
    search = cases_of(ring, start, order)
    leads = dict.fromkeys(entry.denominator_terms[-1] for entry in model.entries)
    search.generic += [ring.lifted(lead, 0) for lead in leads]
    return search


def cases_of(ring: Orthant, case: Case, order: tuple[int, ...]) -> Search:
    """All cases that one case leads to; raises TooMuch."""
    search = Search(ring, order)
    _open(search, case)
    return search


def _open(search: Search, case: Case) -> None:
    search.opened += 1
    if search.opened > CASES:
        raise TooMuch(f"more than {CASES} cases")
    polynomials = _factor_equations(search, case.equations)
    if polynomials is None:
        return
    several = next((f for f in polynomials if len(f) > 1), None)
    if several:
        others = tuple(search.ring.product(f) for f in polynomials if f is not several)
        for factor in several:
            _open(search, replace(case, equations=(factor, *others)))
        return
    plain = tuple(f[0] for f in polynomials)
    void = next((c for c in case.nonzero if c in plain or -c in plain), None)
    if void is not None:
        search.closed.append(f"{void} != 0")
        return
    if _close_excluded(search, plain):
        return
    step = _linear(search, plain)
    if step:
        _solve(search, replace(case, equations=plain), *step)
    elif not _eliminate(search, replace(case, equations=plain)):
        search.cases.append(replace(case, equations=plain))


def _factor_equations(
    search: Search, equations: tuple[fmpz_mpoly, ...]
) -> list[tuple[fmpz_mpoly, ...]] | None:
    """Factors of each equation that may vanish, those of few factors first; None if one
    equation has none.
    """
    polynomials: list[tuple[fmpz_mpoly, ...]] = []
    for equation in equations:
        if equation.is_zero():
            continue
        _, factors = search.ring.parts(equation, odd=False)
        kept = tuple(f for f in factors if search.ring.occurring([f]))
        search.generic += [f for f in factors if f not in kept]
        if not kept:
            search.closed.append(str(equation))
            return None
        polynomials.append(kept)
    polynomials.sort(key=lambda factors: (len(factors), sum(map(len, factors))))
    least: list[tuple[fmpz_mpoly, ...]] = []
    for factors in polynomials:
        if not any(all(f in factors for f in fewer) for fewer in least):
            least.append(factors)
    return least


def _close_excluded(search: Search, equations: tuple[fmpz_mpoly, ...]) -> bool:
    """Close the case if two of the equations contain the same unknown and no other: its common
    roots are those of their resultant.
    """
    alone = [(e, u[0]) for e in equations if len(u := search.ring.occurring([e])) == 1]
    for (first, at), (second, place) in combinations(alone, 2):
        if at == place and first.total_degree() + second.total_degree() <= RESULTANTS:
            search.generic.append(first.resultant(second, at))
            search.closed.append(f"both {first} and {second}")
            return True
    return False


def _linear(
    search: Search, equations: tuple[fmpz_mpoly, ...]
) -> tuple[int, int, fmpz_mpoly, fmpz_mpoly, int] | None:
    """The easiest of the equations c q + N = 0: its number, the position of q, c, N and how
    hard it is.
    """
    ring, pairs = search.ring, []
    for number, equation in enumerate(equations):
        degrees = equation.degrees()
        for rank, at in enumerate(search.order):
            if degrees[at] == 1:
                rest, factor = ring.coefficients(equation, at)
                alone = not ring.occurring([factor])
                hard = (0 if alone else 1) if ring.sign(factor) else 2 if alone else 3
                pairs.append(
                    ((hard, rank, len(factor), len(rest)), (number, at, factor, rest, hard))
                )
    return min(pairs, key=lambda x: x[0])[1] if pairs else None


def _solve(
    search: Search,
    case: Case,
    number: int,
    at: int,
    factor: fmpz_mpoly,
    rest: fmpz_mpoly,
    hard: int,
) -> None:
    """Both cases of one linear equation, the one with factor 0 first."""
    others = (*case.equations[:number], *case.equations[number + 1 :])
    if hard == 3:
        _open(search, replace(case, equations=(*others, factor, rest)))
    elif hard == 2:
        search.generic.append(factor)
    _place(search, replace(case, equations=others), at, rest, factor)


def _place(search: Search, case: Case, at: int, rest: fmpz_mpoly, factor: fmpz_mpoly) -> None:
    """The cases of one with the unknown -rest/factor, neither side being zero."""
    ring, positive = search.ring, search.ring.domain is Domain.POSITIVE
    nonzero = unknown_factors(ring, (factor, rest) if positive else (factor,))
    conditions = (*case.positive, ring.generators[at]) if positive else case.positive
    own_case = replace(case, positive=conditions, nonzero=(*case.nonzero, *nonzero))
    the_case = substitute(ring, own_case, at, RationalFunction(-rest, factor))
    if isinstance(the_case, Case):
        _open(search, the_case)
    else:
        search.closed.append(the_case)


def _eliminate(search: Search, case: Case) -> bool:
    """Replace two equations in two unknowns by others (see `elimination`); return True if that
    succeeded.
    """
    ring = search.ring
    the_branches = branches(ring, *case.equations) if len(case.equations) == PAIR else None
    if the_branches is None:
        return False
    search.generic += the_branches.generic
    search.closed += [f"{factor} = 0" for factor in the_branches.closed]
    for branch in the_branches.open:
        if branch.line is None:
            _open(search, replace(case, equations=(branch.factor, *case.equations)))
        else:
            _place(search, replace(case, equations=(branch.factor,)), *branch.line)
    return True
