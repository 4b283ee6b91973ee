"""Equivalents as formulas: written down as evidence, and put into the transfer function again."""

from collections.abc import Iterator, Sequence

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.symbols import RationalFunction
from disting.evidence.general import ZERO, Explicit, Formula, NoEquivalent
from disting.general.boundary import Boundary, at_boundary, equivalents_without
from disting.general.expansion import Expansion
from disting.general.expression import names as symbols_of, polynomial_text, text_of, tree
from disting.general.intermediate_value import End, Path
from disting.general.matrix_model import AnyModel, Model, Terms
from disting.general.orthant import BRIEF, THOROUGH, Effort
from disting.general.sections import Section
from disting.general.which_models import Way, ways_by_all
from disting.model.question import Domain


def explicit(
    ways: Sequence[Way | None],
    left: AnyModel,
    right: AnyModel,
    domain: Domain,
    effort: Effort = THOROUGH,
) -> Explicit | None:
    """The evidence of two ways in which all generic parameters have an equivalent, the left model's
    first; None where one is not known to be such.
    """
    pairs = list[tuple[Formula, ...]]()
    for side, model, other, way in zip(
        (True, False), (left, right), (right, left), ways, strict=True
    ):
        formulas = tuple(of_way(side, way)) if way else ()
        near = None
        if not formulas and domain is Domain.POSITIVE:
            near = at_boundary(model, other, effort)
        if near:
            formulas = tuple(of_boundary(side, other, near))
        if not formulas:
            return None
        pairs.append(formulas)
    return Explicit(domain.value, tuple(f for formulas in pairs for f in formulas))


def of_way(left_given: bool, way: Way) -> Iterator[Formula]:
    """Yield the formulas that give every generic parameter an equivalent, none where none are
    known.
    """
    if way.covering:
        yield from (_of_section(left_given, way, section) for section in way.covering)
    elif path := way.path():
        yield _of_path(left_given, way, path)


def of_boundary(left_given: bool, other: AnyModel, boundary: Boundary) -> Iterator[Formula]:
    """Yield the formulas of equivalents near the boundary, those that are to be small being 0."""
    for side, where, values, root in of_way(left_given, boundary.way):
        texts = dict(values)
        yield side, where, tuple((q, texts.get(q, ZERO)) for q in other.parameters), root


def is_explicit(evidence: Explicit, left: AnyModel, right: AnyModel) -> bool:
    """Return True if every formula gives the same transfer function, and those of either side are
    all of those by which a freshly found solution gives every generic parameter an equivalent.
    """
    pairs = {True: (left, right), False: (right, left)}
    stated = {side: tuple(f for f in evidence.formulas if f[0] is side) for side in pairs}
    if not all(stated.values()) or not fit(evidence, left, right):
        return False
    return evidence.without_exception(Domain(evidence.domain)) or all(
        formulas
        in _found_anew(side, evidence.small(formulas[0]), Domain(evidence.domain), *pairs[side])
        for side, formulas in stated.items()
    )


def _found_anew(
    side: bool, zero: tuple[str, ...], domain: Domain, model: AnyModel, other: AnyModel
) -> Iterator[tuple[Formula, ...]]:
    """Yield the formulas of ways by all efforts, near the boundary where unknowns are small."""
    if not zero:
        yield from (tuple(of_way(side, way)) for way in ways_by_all(model, other, domain))
    elif isinstance(model, Model) and isinstance(other, Model):
        for effort in (BRIEF, THOROUGH):
            near = equivalents_without(model, other, zero, effort)
            if near:
                yield tuple(of_boundary(side, other, Boundary(zero, near)))


def fit(evidence: Explicit, left: AnyModel, right: AnyModel) -> bool:
    """Return True if every formula gives the same transfer function when substituted into both
    models again.
    """
    sides = {True: (left, right), False: (right, left)}
    return all(_fits(f, *sides[f[0]], Domain(evidence.domain)) for f in evidence.formulas)


def is_without(evidence: NoEquivalent, left: AnyModel, right: AnyModel) -> bool:
    """Return True if the freshly found cases are all closed, by these contradictions."""
    model, other = (left, right) if evidence.left_given else (right, left)
    ways = ways_by_all(model, other, Domain(evidence.domain))
    return any(way.never and way.closed == evidence.contradictions for way in ways)


def _of_section(left_given: bool, way: Way, section: Section) -> Formula:
    names = _names(way)
    values = tuple(
        (q, text_of(v, names)) for q, v in zip(way.other.parameters, section.values, strict=True)
    )
    return left_given, tuple(polynomial_text(g, names) for g in section.where), values, ()


def _of_path(left_given: bool, way: Way, path: Path) -> Formula:
    names = _names(way)
    root = names[path.at] = next(n for n in ("x", "root", "x_") if n not in way.given.parameters)
    values = tuple(
        (q, text_of(v, names)) for q, v in zip(way.other.parameters, path.values, strict=True)
    )
    ends = [_end_text(end, names) for end in (path.low, path.high)]
    where = tuple(polynomial_text(g, names) for g in path.where)
    return left_given, where, values, (root, polynomial_text(path.equation, names), *ends)


def _end_text(end: End, names: list[str]) -> str:
    if end[1].is_zero():
        return "infinity" if end[0].is_one() else "-infinity"
    return text_of(RationalFunction(*end), names)


def _names(way: Way) -> list[str]:
    """Of p, q and t: parameters of the given model as they are called, unknowns with names that
    do not occur.
    """
    return [*way.given.parameters, *(f"q{i}'" for i in range(len(way.other.parameters))), "t'"]


def _fits(formula: Formula, model: AnyModel, other: AnyModel, domain: Domain) -> bool:
    """Return True if c_i(q) lead(p) = c_i(p) lead(q) for all coefficients, where the root is one,
    and the values that must be nonzero are.

    That is lead(q), all denominators and, over positive numbers, the values: none is zero or has a
    root in common with the equation for all p.
    """
    _, _, values, root = formula
    names = [*root[:1], *model.parameters]
    ring = dict(zip(names, _ring(names), strict=True))
    expansion = Expansion(ring, next(iter(ring.values())) ** 0)
    unit = expansion.one
    trees = [tree(text) for _, text in values]
    if (
        tuple(name for name, _ in values) != other.parameters
        or not {n for t in trees for n in symbols_of(t)} <= ring.keys()
    ):
        return False
    point = [expansion.value(t) for t in trees]
    inside = [v for v, (_, text) in zip(point, values, strict=True) if text != ZERO]
    generic = [RationalFunction(ring[n], unit) for n in model.parameters]
    pairs = [
        (
            [value_of(c, generic, unit) for c in _every(a)],
            [value_of(c, point, unit) for c in _every(b)],
        )
        for a, b in zip(model.entries, other.entries, strict=True)
    ]
    equation = expansion.value(tree(root[1])).num if root else unit - unit
    rests = [
        b * own_functions[-1] - a * other_functions[-1]
        for own_functions, other_functions in pairs
        for a, b in zip(own_functions, other_functions, strict=True)
    ]
    leads = [other_functions[-1] for _, other_functions in pairs]
    sides = [
        side
        for v in (*inside, *leads)
        for side in ((v.num, v.den) if domain is Domain.POSITIVE else (v.den,))
    ]
    return all(_is_apart(x, equation) for x in (*(v.num for v in leads), *sides)) and all(
        _is_multiple(r.num, equation) for r in rests
    )


def value_of(
    terms: Terms, point: list[RationalFunction], polynomial: fmpz_mpoly
) -> RationalFunction:
    """A polynomial at fractions."""
    total = RationalFunction(polynomial - polynomial, polynomial)
    for exponents, number in terms:
        term = RationalFunction(polynomial * number, polynomial)
        for x, e in zip(point, exponents, strict=True):
            term = term * x**e if e else term
        total = total + term
    return total


def _ring(names: list[str]) -> tuple[fmpz_mpoly, ...]:
    return tuple(fmpz_mpoly_ctx.get(tuple(names), Ordering.lex).gens())


def _is_multiple(polynomial: fmpz_mpoly, of: fmpz_mpoly) -> bool:
    """Return True if a polynomial vanishes where an irreducible one does (0: only zero does)."""
    return bool(polynomial.is_zero()) or (
        not of.is_zero() and not of.is_constant() and bool(of.gcd(polynomial) in (of, -of))
    )


def _is_apart(polynomial: fmpz_mpoly, of: fmpz_mpoly) -> bool:
    """Return True if a polynomial is nonzero, also at any root of another one, for generic values
    of all symbols but the first.
    """
    return not polynomial.is_zero() and (of.is_zero() or not polynomial.gcd(of).degrees()[0])


def _every(model: Model) -> tuple[Terms, ...]:
    return (*model.numerator_terms, *model.denominator_terms)
