"""The parameter vectors of a model with one generic response, over complex, real and positive
parameters: their number, the exchanges among them, and the parameters that have one value.

CASES. All vectors over complex parameters are written as fractions of the parameters p, or by the
roots x of one irreducible polynomial h over the field of fractions of the p (see `vectors`). A
vector of fractions is real for all real p. It is positive where the fractions are: for all positive
p if their factors have one sign each, for none if one fraction is found to be negative, for some
otherwise. Of the vectors of h so many are admissible as h has real roots, or positive roots at
which all fractions are positive; `counts` may show this number to be the same for all p. Where the
equations cannot be solved over complex parameters, they may be over positive ones, where more
factors have one sign.

POINTS. Where the number is not known to be the same for all p it is found at random points p0. If
no polynomial vanishes at p0 that is not zero (of the search, the denominators, the conditions), and
all roots of h(p0, x) are simple and as many as the degree, then the vectors near p0 are as many as
at p0. So two numbers at two points prove that the number depends on the values.

EXCHANGES. Let m renamings keep the response, the identity among them. If the algebra of the fibre
of a random point modulo a random prime has the dimension m, a generic fibre has no other vectors:
suppose that X is another component of all pairs (p, q) of one response. For each renaming some
q_j - p_g(j) is not zero on X, so `one_value` bounds the probability that a random point lies below
no point of X at which it is not zero; but below that it has m + 1 vectors.
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice
from math import prod

from flint import fmpz, fmpz_mpoly

from disting.algebra.certainty import Certainty, about, residues
from disting.algebra.groebner.rational import Bounds, TooLarge
from disting.errors import InputError
from disting.fibres.ideals.one_value import safety_of_count
from disting.general.any_model import map_of
from disting.general.cases import Search, orders, search_cases
from disting.general.counts import at_roots, count_roots_at, number_of_roots
from disting.general.elimination import Case, inequalities
from disting.general.fibre import Extent, solve
from disting.general.matrix_model import AnyModel
from disting.general.model_side import ComparedModel
from disting.general.orthant import Orthant, TooMuch
from disting.general.robust import CaseSearch, find_equivalent
from disting.general.sections import sections
from disting.general.symmetries import Permutation, exchange_of, generators_of, symmetries_of
from disting.general.target import joint_equations, target
from disting.general.vectors import Vector, are_same, plain_vector, vector_of
from disting.model.question import Domain, Question, Settings
from disting.questions.identifiability.domains import OverDomains, Solutions
from disting.questions.identifiability.parts import Level, Renaming

CHEAP_UP_TO, TRIES = 8, 6  # parameters, and orders of the unknowns: a second or two
POINTS = 16  # at which vectors are counted
LISTED = 2  # of them, where all vectors are listed by a Gröbner basis
MOST_BITS = 14  # of a value at a point
QUADRATIC = 2
Factors = tuple[fmpz_mpoly, ...]
Point = dict[int, int]
"""Whole numbers by position in the ring."""


@dataclass(frozen=True, slots=True)
class _Branch:
    """A vector, or those of all roots of its equation: from `least` to `most` of them admissible,
    where all `asked` products are positive.
    """

    vector: Vector
    case: Case
    asked: tuple[Factors, ...]
    least: int
    most: int


@dataclass(frozen=True, slots=True)
class _Group:
    """The renamings of a model's parameters that keep the response."""

    permutations: Sequence[Permutation]
    exchanges: tuple[Renaming, ...]

    @property
    def order(self) -> int:
        """Number of them, the identity among them."""
        return len(self.permutations)

    def orbit(self, at: int) -> set[int]:
        """The positions whose values are exchanged with the one at this position."""
        return {images[at] for images in self.permutations}


def find_solutions(model: AnyModel, settings: Settings) -> OverDomains:
    """The solutions over each domain, in the order of `Domain`.

    >>> from disting.general.matrix_model import Model
    >>> model = Model.from_transfer_function("c", "(s + a)*(s + b)")
    >>> [(s.least, s.most, s.exchanges[0].text) for s in find_solutions(model, Settings())]
    [(2, 2, 'a ↔ b'), (2, 2, 'a ↔ b'), (2, 2, 'a ↔ b')]
    """
    if model.powers.weights or model.powers.unseen:
        return _of_exponents(model, settings)
    permutations = symmetries_of(model)
    chosen = generators_of(permutations)
    exchanges = tuple(exchange_of(images, model.parameters) for images in chosen)
    group = _Group(permutations, exchanges)
    tries = TRIES if len(model.parameters) <= CHEAP_UP_TO else 0
    search = _solve_in_orders(model, Domain.COMPLEX, tries)
    if search is None and group.order > 1:
        safety = safety_of_count(map_of(model), group.order, seed=settings.seed)
        if safety:
            return _as_exchanges(model, group, safety)
    found = [_over(model, domain, group, search, tries, settings) for domain in Domain]
    limit = found[0].most
    return tuple(s if s.most is not None else replace(s, most=limit) for s in found)


def _over(
    model: AnyModel,
    domain: Domain,
    group: _Group,
    search: Search | None,
    tries: int,
    settings: Settings,
) -> Solutions:
    """The solutions over one domain: by the search over complex parameters, by one over the
    domain, or by what points and exchanges show.
    """
    searches = [search]
    if search is None and domain is Domain.POSITIVE:
        searches.append(_solve_in_orders(model, domain, tries))
    for one in searches:
        found = _by_cases(model, domain, group, one) if one else None
        if found:
            return found
    return _by_points(model, domain, group, settings)


def _solve_in_orders(model: AnyModel, domain: Domain, tries: int) -> Search | None:
    """The first search all of whose cases are vectors of fractions, or of roots of one equation in
    one unknown, which no other order of the unknowns turns into fractions.
    """
    size = len(model.parameters)
    ring = Orthant(size, size, domain)
    for order in islice(orders(ring.unknowns), tries):
        try:
            search = search_cases(ring, model, model, order)
        except TooMuch:
            continue
        if all(len(c.equations) == len(ring.occurring(c.equations)) <= 1 for c in search.cases):
            return search
    return None


def _by_cases(model: AnyModel, domain: Domain, group: _Group, search: Search) -> Solutions | None:
    """None where polynomials grow too large."""
    ring = replace(search.ring, domain=domain, spent=[0])
    try:
        branches = _branches(ring, model, search.cases)
        points = list(_points(model, domain))
        if any(_free(branch.vector) for branch in branches):
            existing = [b for b in branches if _exists(ring, model, b, points)]
            levels = _levels(ring, model, group, branches, existing)
            return _solutions(domain, levels, 1, None, group)
        numbers = _numbers(ring, search.generic, branches, points)
    except TooMuch:
        return None
    sampled = sorted({sum(row) for row in numbers})
    used = [b for at, b in enumerate(branches) if b.least or any(row[at] for row in numbers)]
    least = max(sum(b.least for b in branches), group.order)
    most = sum(b.most for b in branches)
    levels = _levels(ring, model, group, branches, used)
    found = _solutions(domain, levels, least, most, group)
    is_open = least < most
    return replace(
        found, sampled=tuple(sampled) if is_open else (), varies=is_open and len(sampled) > 1
    )


def _solutions(
    domain: Domain, levels: dict[str, Level], least: int, most: int | None, group: _Group
) -> Solutions:
    if most is not None and most > group.order:  # values of exchanges, in other combinations
        levels = {n: Level.LOCAL if x is Level.EXCHANGES else x for n, x in levels.items()}
    return Solutions(
        domain=domain,
        levels=levels,
        least=least,
        most=most,
        sampled=(),
        varies=False,
        exchanges=group.exchanges,
        order=group.order,
        certainty=Certainty.PROVEN,
        safety=0,
    )


def _branches(ring: Orthant, model: AnyModel, cases: Sequence[Case]) -> list[_Branch]:
    """The different vectors that may be admissible; raises TooMuch."""
    branches = list[_Branch]()
    for case in cases:
        try:
            vector = vector_of(ring, model, case)
        except TooMuch:
            vector = plain_vector(ring, case)
        if vector is None or any(are_same(vector, b.vector) for b in branches):
            continue
        conditions = _positive_products(ring, case)
        if conditions is None:
            continue
        least, most = _bounds(ring, vector, case, conditions)
        if any(b.vector.at not in (-1, vector.at) for b in branches):
            least = 0  # roots of different unknowns may be the same vectors
        if most:
            branches.append(_Branch(vector, case, conditions, least, most))
    return branches


def _positive_products(ring: Orthant, case: Case) -> tuple[Factors, ...] | None:
    """The products that have to be positive for the values of a case to be; None where they never
    are.
    """
    if ring.domain is not Domain.POSITIVE:
        return ()
    products = [*((g,) for g in case.positive), *((v.num, v.den) for _, v in case.solved)]
    try:
        positive, failing = inequalities(ring, map(ring.product, products))
    except TooMuch:
        return tuple(products)
    return None if failing is not None else tuple((g,) for g in positive)


def _bounds(ring: Orthant, vector: Vector, case: Case, asked: Sequence[Factors]) -> tuple[int, int]:
    """The least and the largest number of admissible vectors of a case, for all p."""
    equation = vector.equation
    if equation is None:
        return int(not asked), 1
    degree = int(equation.degrees()[vector.at])
    if ring.domain is Domain.COMPLEX:
        return degree, degree
    if ring.domain is Domain.REAL:
        return _real_bounds(ring, equation, vector.at, degree)
    ring.begin()
    at = at_roots(ring, replace(case, positive=tuple(map(ring.product, asked))))
    number = 0 if isinstance(at, str) else number_of_roots(ring, at)
    return (0, degree) if number is None else (number, number)


def _real_bounds(ring: Orthant, equation: fmpz_mpoly, at: int, degree: int) -> tuple[int, int]:
    if degree == QUADRATIC:
        c, b, a = ring.coefficients(equation, at)
        sign = ring.sign(b**2 - 4 * a * c)
        return (degree, degree) if sign > 0 else (0, 0) if sign < 0 else (0, degree)
    return degree % 2, degree


def _free(vector: Vector) -> bool:
    """Return True if unknowns other than the root are free: infinitely many vectors."""
    return sum(v is None for v in vector.values) > (vector.equation is not None)


def _levels(
    ring: Orthant,
    model: AnyModel,
    group: _Group,
    branches: Sequence[_Branch],
    existing: Sequence[_Branch],
) -> dict[str, Level]:
    """By parameter: one value in all branches, values of exchanges, several in those that are
    known to exist for some values, or not known.
    """
    levels = dict[str, Level]()
    for at, name in enumerate(model.parameters):
        if all(_is(ring, b.vector, at, {at}) for b in branches):
            levels[name] = Level.GLOBAL
        elif all(_is(ring, b.vector, at, group.orbit(at)) for b in branches):
            levels[name] = Level.EXCHANGES
        elif any(not _is(ring, b.vector, at, {at}) for b in existing):
            levels[name] = Level.LOCAL
        else:
            levels[name] = Level.UNKNOWN
    return levels


def _is(ring: Orthant, vector: Vector, at: int, positions: set[int]) -> bool:
    """Return True if a value is one of the p at these positions, at all roots of the equation."""
    value, equation = vector.values[at], vector.equation
    if value is None:
        return False
    rests = (value.num - value.den * ring.generators[j] for j in positions)
    return any(r.is_zero() or (equation is not None and (r % equation).is_zero()) for r in rests)


def _points(model: AnyModel, domain: Domain) -> Iterator[Point]:
    """Yield random whole numbers of all sizes, with signs over real parameters."""
    size = len(model.parameters)
    for k in range(POINTS):
        label = about(f"solutions:{domain}:{k}", *model.content[1:])
        bits = residues(f"{label}:bits", size, MOST_BITS + 1)
        signs = residues(f"{label}:signs", size, 3) if domain is Domain.REAL else [1] * size
        yield {
            i: (residues(f"{label}:{i}", 1, 1 << b)[0] if b > 1 else 1) * (1 if sign == 1 else -1)
            for i, (b, sign) in enumerate(zip(bits, signs, strict=True))
        }


def _numbers(
    ring: Orthant,
    generic: Sequence[fmpz_mpoly],
    branches: Sequence[_Branch],
    points: Sequence[Point],
) -> list[list[int]]:
    """Of each point the numbers of admissible vectors by branch, until all numbers that may be are
    found; nothing of special points, and of branches that may overlap.
    """
    least, most = (sum(getattr(b, end) for b in branches) for end in ("least", "most"))
    rows = list[list[int]]()
    if least == most or len({b.vector.at for b in branches} - {-1}) > 1:
        return rows
    for point in points:
        if all(_value(g, point) for g in generic):
            row = [n for b in branches if (n := _number_at(ring, b, point)) is not None]
            rows += [row] if len(row) == len(branches) else []
        if {least, most} <= set(map(sum, rows)):
            break
    return rows


def _number_at(ring: Orthant, branch: _Branch, point: Point) -> int | None:
    """Number of vectors of a branch that are admissible near a point; None at special ones."""
    case, vector = branch.case, branch.vector
    if branch.least == branch.most:
        return branch.least
    below = [v.den for _, v in case.solved]
    if vector.equation is not None:
        return count_roots_at(ring, vector.equation, branch.asked, below, vector.at, point)
    values = [prod(_value(g, point) for g in factors) for factors in branch.asked]
    if not all(values) or not all(_value(d, point) for d in below):
        return None
    return int(all(value > 0 for value in values))


def _value(polynomial: fmpz_mpoly, point: Point) -> int:
    """The value of a polynomial in the p alone."""
    at: dict[str | int, int | fmpz] = {i: x for i, x in point.items()}  # noqa: C416
    value = polynomial.subs(at)
    return int(value.leading_coefficient()) if value else 0


def _exists(ring: Orthant, model: AnyModel, branch: _Branch, points: Sequence[Point]) -> bool:
    """Return True if a branch with free unknowns has admissible vectors for some p."""
    if ring.domain is not Domain.POSITIVE:
        return ring.domain is Domain.COMPLEX or branch.vector.equation is None
    search = Search(ring, tuple(ring.unknowns))
    solved, others = ([], [branch.case]) if branch.case.equations else sections(search, branch.case)
    parted = CaseSearch(search, tuple(solved), tuple(others), ring.lead(model))
    exact = ({i: Fraction(x) for i, x in point.items()} for point in points)
    return any(find_equivalent(parted, point) for point in exact)


def _as_exchanges(model: AnyModel, group: _Group, safety: int) -> OverDomains:
    """The solutions where all of them are exchanges."""
    levels = {
        name: Level.EXCHANGES if len(group.orbit(at)) > 1 else Level.GLOBAL
        for at, name in enumerate(model.parameters)
    }
    found = (_solutions(d, levels, group.order, group.order, group) for d in Domain)
    return tuple(replace(s, certainty=Certainty.BOUNDED, safety=safety) for s in found)


def _by_points(model: AnyModel, domain: Domain, group: _Group, settings: Settings) -> Solutions:
    """Solutions from exchanges, and the numbers of vectors at random points, which prove nothing
    for other points.
    """
    levels = {
        name: Level.LOCAL if len(group.orbit(at)) > 1 else Level.UNKNOWN
        for at, name in enumerate(model.parameters)
    }
    found = _solutions(domain, levels, group.order, None, group)
    few = len(model.parameters) <= CHEAP_UP_TO
    points = list(_points(model, domain))[:LISTED] if few else []
    numbers = {n for p in points if (n := _listed_at(model, domain, p, settings)) is not None}
    return replace(found, sampled=tuple(sorted(numbers)))


def _listed_at(model: AnyModel, domain: Domain, point: Point, settings: Settings) -> int | None:
    """The number of vectors at a point, by a Gröbner basis; None where it is not found."""
    values = [(name, Fraction(point[i])) for i, name in enumerate(model.parameters)]
    try:
        goals = [target(entry, values) for entry in model.entries]
        equations = joint_equations(goals, model.entries)
        fibre = solve(equations, model.parameters, settings.seed, Bounds())
    except (TooLarge, InputError):
        return None
    if fibre.extent is not Extent.FINITE:
        return None
    within = list(Domain)[list(Domain).index(domain) :]
    return sum(e.domain in within for e in fibre.equivalents)


def _of_exponents(model: AnyModel, settings: Settings) -> OverDomains:
    """Of a model with exponents as parameters: the exchanges that move exponents, too."""
    names = model.powers.exponents
    exchanges = list[Renaming]()
    for order, renaming in ComparedModel("", model, settings).other_orders:
        if renaming:
            pairs = [*zip(names, order, strict=True), *renaming.pairs]
            exchanges.append(Renaming(tuple((a, b) for a, b in pairs if a != b), ()))
    moved = {name for renaming in exchanges for pair in renaming.moved for name in pair}
    every = (*model.parameters, *names)
    levels = {name: Level.LOCAL if name in moved else Level.UNKNOWN for name in every}
    group = _Group([()] * (1 + len(exchanges)), tuple(exchanges))
    return tuple(_solutions(domain, levels, group.order, None, group) for domain in Domain)


def _encode(answer: OverDomains) -> str:
    return json.dumps([s.to_dict() for s in answer], separators=(",", ":"))


def _decode(text: str) -> OverDomains:
    return tuple(map(Solutions.from_dict, json.loads(text)))


SOLUTIONS = Question("solutions over each domain", find_solutions, _encode, _decode)
