"""Formulas for the values of a network or a model that does the same as another one: by renaming,
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
from disting.general.any_model import on_one_variable
from disting.general.closed_form import ClosedForm, confirmed
from disting.general.elimination import numbered
from disting.general.field import Field, Values
from disting.general.matrix_model import AnyModel
from disting.general.model import Model
from disting.general.sections import Section
from disting.general.synthesis import NeedsRoots, NoFormulas
from disting.general.values_of_parts import by_parts
from disting.general.which_models import Way, way
from disting.model.question import Domain
from disting.verdict.result import Verdict

MOST_SOLVED = 6  # parameters of models whose equations are solved as they are
QUADRATIC = 2
TRIALS = 40  # points at which positive values are looked for


def closed_forms(given: AnyModel, other: AnyModel, verdict: Verdict) -> tuple[ClosedForm, ...]:
    """The values of the other model in those of the given one, as far as formulas are known: each
    checked as an identity. Raises NoFormulas with the reason.
    """
    one, two = on_one_variable([given, other])
    found = by_name(given, other, verdict)
    if not found:
        try:
            found = by_parts(one, two)
        except NeedsRoots:
            raise
        except NoFormulas as none:
            if len(other.parameters) > MOST_SOLVED:
                more = f"they have more than {MOST_SOLVED} values"
                raise NoFormulas(f"{none}, and {more}") from none
            found = _solved(one, two)
    if not found:
        raise NoFormulas("none that is known is positive")
    return tuple(confirmed(form, one, two) for form in found)


def by_name(given: AnyModel, other: AnyModel, verdict: Verdict) -> list[ClosedForm]:
    """The renaming that a verdict rests on, or the theorems on chains; none of others."""
    return _renamed(given, other, verdict) or _of_chains(given, other)


def _renamed(given: AnyModel, other: AnyModel, verdict: Verdict) -> list[ClosedForm]:
    """The renaming that a verdict rests on: of its left model's parameters to the right one's."""
    if not isinstance(verdict.evidence, Renaming):
        return []
    is_left, ring = verdict.left == given.name, symbols(given.parameters)
    pairs = ((a, b) if is_left else (b, a) for a, b in verdict.evidence.pairs)
    values = {b: RationalFunction(ring[a], ring[a] ** 0) for a, b in pairs}
    return [ClosedForm(given.parameters, (), tuple((n, values[n]) for n in other.parameters))]


def _of_chains(given: AnyModel, other: AnyModel) -> list[ClosedForm]:
    """The theorems on chains."""
    one, two = (m.chain if isinstance(m, Model) else None for m in (given, other))
    found = explicit_map(one, two) if one and two else None
    if found is None:
        return []
    return [ClosedForm(given.parameters, (), tuple(sorted(found.formulas.items())))]


def _solved(given: AnyModel, other: AnyModel) -> list[ClosedForm]:
    """Sections of the equations that hold for all generic positive values; else the roots of a
    path, one of which does, or all that is known over complex values, as far as seen positive.
    """
    field, found = Field(given.parameters), way(given, other, Domain.POSITIVE)
    if found is not None and found.covering:
        return [_of_section(field, found, section) for section in found.covering]
    root = found.path() if found is not None else None
    if found is not None and root is not None:
        degree = int(root.equation.degrees()[root.at])
        if degree > QUADRATIC:
            raise NoFormulas(f"roots of a polynomial of degree {degree} are needed")
        return _seen(_of_root(found, root.at, root.equation, root.values))
    return _seen(_of_cases(given, other))


def _of_cases(given: AnyModel, other: AnyModel) -> Iterator[ClosedForm]:
    """Yield what the cases of the equations give over complex values; raises NoFormulas."""
    found = way(given, other, Domain.COMPLEX)
    if found is None:
        raise NoFormulas("the equations grow too large")
    for section in found.parted.sections:
        yield _of_section(Field(given.parameters), found, section)
    ring = found.parted.search.ring
    for left in found.parted.others:
        case = numbered(ring, left)
        unknown = ring.occurring(case.equations)
        degree = max(int(e.degrees()[i]) for e in case.equations for i in unknown)
        if (len(case.equations), len(unknown)) != (1, 1) or degree > QUADRATIC:
            raise NoFormulas(f"equations of degree {degree} in {len(unknown)} unknowns are left")
        (at,) = unknown
        known = {at: RationalFunction(ring.generators[at], ring.number(1)), **dict(case.solved)}
        yield from _of_root(found, at, case.equations[0], [known[i] for i in ring.unknowns])


def _seen(forms: Iterable[ClosedForm]) -> list[ClosedForm]:
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


def _of_section(field: Field, found: Way, section: Section) -> ClosedForm:
    values = _values(field, found, section.values, {})
    where = tuple(_lifted(field, g, {}).num for g in section.where)
    return ClosedForm(found.given.parameters, (), values, where=where)


def _of_root(
    found: Way, at: int, equation: fmpz_mpoly, values: Sequence[RationalFunction]
) -> list[ClosedForm]:
    """Both roots of a quadratic equation for one unknown of which all others are fractions."""
    field, ring = Field(found.given.parameters), found.parted.search.ring
    quadratic = tuple(_lifted(field, c, {}) for c in ring.coefficients(equation, at))
    forms = list[ClosedForm]()
    for root in field.split(quadratic):
        steps, written = field.written(_values(field, found, values, {at: root}))
        forms.append(ClosedForm(found.given.parameters, steps, written))
    return forms


def _values(
    field: Field,
    found: Way,
    values: Sequence[RationalFunction],
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
