"""Formulas for the values of a network or a model that does the same as another one: by renaming,
the theorems on chains, synthesis of parts, or sections of the equations.
"""

from collections.abc import Iterator

from flint import fmpz_mpoly

from disting.algebra.rational_function import RationalFunction
from disting.algebra.symbols import symbols
from disting.equivalence.maps import explicit_map
from disting.evidence.conditions import Renaming
from disting.general.any_model import on_one_variable
from disting.general.between import Path
from disting.general.closed_form import ClosedForm, confirmed
from disting.general.field import Field, Values
from disting.general.matrix_model import AnyModel
from disting.general.model import Model
from disting.general.sections import Section
from disting.general.synthesis import NoFormulas
from disting.general.values_of_parts import by_parts
from disting.general.which_models import Way, way
from disting.model.question import Domain
from disting.verdict.result import Verdict

MOST_SOLVED = 6  # parameters of models whose equations are solved as they are
QUADRATIC = 2


def closed_forms(given: AnyModel, other: AnyModel, verdict: Verdict) -> tuple[ClosedForm, ...]:
    """The values of the other model in those of the given one, as far as formulas are known: each
    checked as an identity. Raises NoFormulas with the reason.
    """
    one, two = on_one_variable([given, other])
    found = _renamed(given, other, verdict) or _of_chains(given, other)
    if found is None:
        try:
            found = by_parts(one, two)
        except NoFormulas as none:
            if len(other.parameters) > MOST_SOLVED:
                raise
            found = _solved(one, two, none)
    return tuple(confirmed(form, one, two) for form in found)


def _renamed(given: AnyModel, other: AnyModel, verdict: Verdict) -> list[ClosedForm] | None:
    """The renaming that a verdict rests on."""
    if not isinstance(verdict.evidence, Renaming):
        return None
    pairs = verdict.evidence.pairs
    if {a for a, _ in pairs} != {*other.parameters}:
        pairs = tuple((b, a) for a, b in pairs)
    ring = symbols(given.parameters)
    values = ((b, RationalFunction(ring[a], ring[a] ** 0)) for b, a in pairs)
    return [ClosedForm(given.parameters, (), tuple(sorted(values, key=lambda x: x[0])))]


def _of_chains(given: AnyModel, other: AnyModel) -> list[ClosedForm] | None:
    """The theorems on chains."""
    one, two = (m.chain if isinstance(m, Model) else None for m in (given, other))
    found = explicit_map(one, two) if one and two else None
    if found is None:
        return None
    return [ClosedForm(given.parameters, (), tuple(sorted(found.formulas.items())))]


def _solved(given: AnyModel, other: AnyModel, none: NoFormulas) -> list[ClosedForm]:
    """Sections of the equations that hold for all generic positive values, or a root that does."""
    found = way(given, other, Domain.POSITIVE)
    if found is not None and found.covering:
        field = Field(given.parameters)
        return [_of_section(field, found, section) for section in found.covering]
    root = found.path() if found is not None else None
    if found is None or root is None:
        raise none
    degree = int(root.equation.degrees()[root.at])
    if degree > QUADRATIC:
        raise NoFormulas(f"roots of a polynomial of degree {degree} are needed")
    return list(_of_path(found, root))


def _of_section(field: Field, found: Way, section: Section) -> ClosedForm:
    values = _values(field, found, section.values, {})
    where = tuple(_lifted(field, g, {}).num for g in section.where)
    return ClosedForm(found.given.parameters, (), values, where=where)


def _of_path(found: Way, path: Path) -> Iterator[ClosedForm]:
    """Both roots of the quadratic equation, those at which all values are positive somewhere."""
    field, ring = Field(found.given.parameters), found.parted.search.ring
    plain = tuple(_lifted(field, c, {}) for c in ring.coefficients(path.equation, path.at))
    for root in field.split(plain):
        values = _values(field, found, path.values, {path.at: root})
        yield ClosedForm(found.given.parameters, *field.written(values))


def _values(
    field: Field,
    found: Way,
    values: tuple[RationalFunction, ...],
    known: dict[int, RationalFunction],
) -> Values:
    return tuple(
        (name, _lifted(field, v.num, known) / _lifted(field, v.den, known))
        for name, v in zip(found.other.parameters, values, strict=True)
    )


def _lifted(
    field: Field, polynomial: fmpz_mpoly, known: dict[int, RationalFunction]
) -> RationalFunction:
    """A polynomial of the equations in the parameters of the given model, and in a root."""
    zero = field.one - field.one
    size = len(field.parameters)
    images = [field[n].num for n in field.parameters]
    names = len(polynomial.context().names())
    images += [known.get(i, zero).num for i in range(size, names)]
    return RationalFunction(polynomial.compose(*images, ctx=field.one.num.context()), field.one.num)
