"""Formulas for the values of a network or a model that is equivalent to another one: by renaming,
the theorems on chains, synthesis of parts, or sections of the equations.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

from flint import fmpz_mpoly

from disting.algebra.certainty import residues
from disting.algebra.symbols import RationalFunction, symbols
from disting.equivalence.maps import explicit_map
from disting.evidence.conditions import Renaming
from disting.general import AnyModel, Model
from disting.general.any_model import on_one_variable
from disting.general.closed_form import ClosedForm, confirm
from disting.general.elimination import fix_free
from disting.general.field import Assignment, Field
from disting.general.sections import Section
from disting.general.synthesis import NeedsRoots, NoFormulas
from disting.general.values_of_parts import by_parts
from disting.general.which_models import Way, way
from disting.model.question import Domain
from disting.verdict.result import Verdict

MOST_SOLVED = 6  # parameters of models whose equations are solved as they are
QUADRATIC = 2
TRIALS = 40  # points at which positive values are looked for


def closed_forms(model: AnyModel, other: AnyModel, verdict: Verdict) -> tuple[ClosedForm, ...]:
    """The values of the other model in those of the given one, as far as formulas are known: each
    checked as an identity. Raises NoFormulas with the reason.
    """
    this_model, two = on_one_variable([model, other])
    the_closed_forms = by_name(model, other, verdict)
    if not the_closed_forms:
        try:
            the_closed_forms = by_parts(this_model, two)
        except NeedsRoots:
            raise
        except NoFormulas as none:
            if len(other.parameters) > MOST_SOLVED:
                more = f"they have more than {MOST_SOLVED} values"
                raise NoFormulas(f"{none}, and {more}") from none
            the_closed_forms = _from_sections(this_model, two)
    if not the_closed_forms:
        raise NoFormulas("none that is known is positive")
    return tuple(confirm(form, this_model, two) for form in the_closed_forms)


def by_name(model: AnyModel, other: AnyModel, verdict: Verdict) -> list[ClosedForm]:
    """The renaming that a verdict rests on, or the theorems on chains; none of others."""
    return _from_renaming(model, other, verdict) or _of_chains(model, other)


def _from_renaming(model: AnyModel, other: AnyModel, verdict: Verdict) -> list[ClosedForm]:
    """The renaming that a verdict rests on: of its left model's parameters to the right one's."""
    if not isinstance(verdict.evidence, Renaming):
        return []
    is_left, ring = verdict.left == model.name, symbols(model.parameters)
    pairs = ((a, b) if is_left else (b, a) for a, b in verdict.evidence.pairs)
    values = {b: RationalFunction(ring[a], ring[a] ** 0) for a, b in pairs}
    return [ClosedForm(model.parameters, (), tuple((n, values[n]) for n in other.parameters))]


def _of_chains(model: AnyModel, other: AnyModel) -> list[ClosedForm]:
    """The theorems on chains."""
    chain, two = (m.chain if isinstance(m, Model) else None for m in (model, other))
    formula_map = explicit_map(chain, two) if chain and two else None
    if formula_map is None:
        return []
    return [ClosedForm(model.parameters, (), tuple(sorted(formula_map.formulas.items())))]


def _from_sections(model: AnyModel, other: AnyModel) -> list[ClosedForm]:
    """Sections of the equations that hold for all generic positive values; else the roots of a
    path, one of which does, or all those known over complex values, as far as they are found to be
    positive.
    """
    field, the_way = Field(model.parameters), way(model, other, Domain.POSITIVE)
    if the_way is not None and the_way.covering:
        return [_of_section(field, the_way, section) for section in the_way.covering]
    root = the_way.path() if the_way is not None else None
    if the_way is not None and root is not None:
        degree = int(root.equation.degrees()[root.at])
        if degree > QUADRATIC:
            raise NoFormulas(f"roots of a polynomial of degree {degree} are needed")
        return _count_positive_points(_of_root(the_way, root.at, root.equation, root.values))
    return _count_positive_points(_of_cases(model, other))


def _of_cases(model: AnyModel, other: AnyModel) -> Iterator[ClosedForm]:
    """Yield what the cases of the equations give over complex values; raises NoFormulas."""
    the_way = way(model, other, Domain.COMPLEX)
    if the_way is None:
        raise NoFormulas("the equations grow too large")
    for section in the_way.parted.sections:
        yield _of_section(Field(model.parameters), the_way, section)
    ring = the_way.parted.search.ring
    for left in the_way.parted.others:
        case = fix_free(ring, left)
        unknown = ring.occurring(case.equations)
        degree = max(int(e.degrees()[i]) for e in case.equations for i in unknown)
        if (len(case.equations), len(unknown)) != (1, 1) or degree > QUADRATIC:
            raise NoFormulas(f"equations of degree {degree} in {len(unknown)} unknowns are left")
        (at,) = unknown
        functions = {at: RationalFunction(ring.generators[at], ring.number(1)), **dict(case.solved)}
        yield from _of_root(the_way, at, case.equations[0], [functions[i] for i in ring.unknowns])


def _count_positive_points(forms: Iterable[ClosedForm]) -> list[ClosedForm]:
    """Those that are positive at some points that are tried, and at how many: no proof of more."""
    counts = ((form, _positive(form)) for form in forms)
    words = "positive at {} of {} points that were tried"
    return [replace(f, seen=words.format(n, TRIALS)) for f, n in counts if n]


def _positive(form: ClosedForm) -> int:
    """At how many points all values are positive, in rounded numbers."""
    count = 0
    for k in range(TRIALS):
        point = [x / 7 for x in residues(f"positive:{k}", len(form.given), 71)]
        with suppress(ArithmeticError):
            count += all(x.imag == 0 and x.real > 0 for x in form.at(point).values())
    return count


def _of_section(field: Field, the_way: Way, section: Section) -> ClosedForm:
    values = _values(field, the_way, section.values, {})
    where = tuple(_lift_polynomial(field, g, {}).num for g in section.where)
    return ClosedForm(the_way.given.parameters, (), values, where=where)


def _of_root(
    the_way: Way, at: int, equation: fmpz_mpoly, values: Sequence[RationalFunction]
) -> list[ClosedForm]:
    """Both roots of a quadratic equation for one unknown of which all others are fractions."""
    field, ring = Field(the_way.given.parameters), the_way.parted.search.ring
    quadratic = tuple(_lift_polynomial(field, c, {}) for c in ring.coefficients(equation, at))
    forms = list[ClosedForm]()
    for root in field.split(quadratic):
        steps, written = field.written(_values(field, the_way, values, {at: root}))
        forms.append(ClosedForm(the_way.given.parameters, steps, written))
    return forms


def _values(
    field: Field,
    the_way: Way,
    values: Sequence[RationalFunction],
    functions: dict[int, RationalFunction],
) -> Assignment:
    return tuple(
        (
            name,
            _lift_polynomial(field, v.num, functions) / _lift_polynomial(field, v.den, functions),
        )
        for name, v in zip(the_way.other.parameters, values, strict=True)
    )


def _lift_polynomial(
    field: Field, polynomial: fmpz_mpoly, functions: dict[int, RationalFunction]
) -> RationalFunction:
    """A polynomial of the equations in the parameters of the given model, and in a root."""
    zero = field.one - field.one
    size = len(field.parameters)
    images = [field[n].num for n in field.parameters]
    names = len(polynomial.context().names())
    images += [functions.get(i, zero).num for i in range(size, names)]
    return RationalFunction(polynomial.compose(*images, ctx=field.one.num.context()), field.one.num)
