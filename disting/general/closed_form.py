"""Values of one model in those of another one with the same transfer functions: fractions and
square roots, written in steps.

What is found is put in. Coefficients of both transfer functions, over the leading one, are compared
at points drawn at random modulo a prime, with all choices of signs of the square roots. Written as
sum c_S w_S, w_S the products of different square roots, a difference that is zero for all signs has
c_S = 0 at the point: polynomials in the parameters, so that the bound of Schwartz and Zippel holds.
Only points count at which all discriminants are squares, 1 of 2 for each root: as many are drawn as
that takes, and the bound is that for all which may be drawn.
"""

import cmath
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import log2
from typing import Any

from flint import fmpz_mod_ctx, fmpz_mpoly
from flint.utils.flint_exceptions import DomainError

from disting.algebra.certainty import Certainty, Size, about, enough, prime, residues, safety
from disting.algebra.symbols import (
    RationalFunction,
    factorise,
    latex,
    latex_symbol,
    text,
    variables,
)
from disting.errors import ContradictionError
from disting.general.any_model import on_one_variable
from disting.general.field import Step, letters
from disting.general.matrix_model import AnyModel, Terms

POINTS = 2
DRAWS = 512  # of a point, until all discriminants are squares
Residue = Any  # of a prime
Writer = Callable[[RationalFunction], str]


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """`values` of the parameters of another model, in those of the given one and in `steps`, for
    values at which all of `where` are positive. `choices`: elements that share equally what could
    be shared in infinitely many ways. `seen`: at how many points they were positive, where no
    theorem proves it everywhere.

    They give the same transfer functions wherever no denominator is zero; a wrong formula would
    have passed with a probability of at most 2^-safety.
    """

    given: tuple[str, ...]
    steps: tuple[Step, ...]
    values: tuple[tuple[str, RationalFunction], ...]
    where: tuple[fmpz_mpoly, ...] = ()
    choices: tuple[tuple[str, ...], ...] = ()
    seen: str = ""
    safety: int = 0

    @property
    def checked(self) -> str:
        """Certainty of the identity, in words."""
        return f"identity checked, {Certainty.BOUNDED.in_words(self.safety)}"

    @property
    def chosen(self) -> tuple[str, ...]:
        """Parameters whose values are numbers, whatever the given ones are."""
        return tuple(n for n, v in self.values if v.num.is_constant() and v.den.is_constant())

    @property
    def length(self) -> int:
        """Letters of all factors that are written."""
        every = [v for s in self.steps for v in (s.root or (s.value,))]
        every += [v for _, v in self.values]
        sides = (side for v in every for side in (v.num, v.den))
        return sum(letters(f) for side in sides for f, _ in factorise(side)[1])

    def at(self, point: Sequence[float]) -> dict[str, complex]:
        """The values at rounded ones of the given parameters."""
        values = {n: complex(x) for n, x in zip(self.given, point, strict=True)}
        return next(_evaluate_form(self, values, cmath.sqrt))

    @property
    def text(self) -> str:
        """One line a value, in Python's notation, those with a name first; a prime marks the
        parameters of the other model.
        """
        lines = list(self.named)
        lines += [(f"{name}'", text(value)) for name, value in self.values]
        width = max(len(name) for name, _ in lines)
        return "\n".join(f"{name:{width}} = {of}" for name, of in lines)

    @property
    def named(self) -> tuple[tuple[str, str], ...]:
        """The steps, names and values in Python's notation."""
        return tuple(self._name_steps(text, _python_root))

    @property
    def latex(self) -> str:
        """An align environment (amsmath)."""
        lines = [(latex_symbol(name), of) for name, of in self._name_steps(latex, _latex_root)]
        lines += [(f"{latex_symbol(name)}'", latex(value)) for name, value in self.values]
        rows = " \\\\\n".join(f"  {name} &= {of}" for name, of in lines)
        return f"\\begin{{align}}\n{rows}\n\\end{{align}}"

    @property
    def python(self) -> str:
        """Python source: symbols for SymPy, positive ones, the steps and a dictionary of values."""
        names = ", ".join(self.given)
        comma = "," if len(self.given) == 1 else ""
        steps = "".join(f"{name} = {of}\n" for name, of in self.named)
        values = "".join(f'    "{name}": {text(value)},\n' for name, value in self.values)
        return (
            f'from sympy import sqrt, symbols\n\n{names}{comma} = symbols("{names}{comma}",'
            f" positive=True)\n{steps}equivalent = {{\n{values}}}"
        )

    def _name_steps(self, written: Writer, root: Callable[..., str]) -> Iterator[tuple[str, str]]:
        """Yield the steps: a value, a root, or as the other root what is left of -b/a."""
        for step in self.steps:
            if not step.root:
                yield step.name, written(step.value)
                continue
            _, b, a = step.root
            if step.sign > 0:
                twice = RationalFunction(2 * a.num, a.den)
                yield step.name, root(written(-b), written(step.discriminant), written(twice))
            else:
                first = next(s.name for s in self.steps if s.root == step.root and s.sign > 0)
                (symbol,) = (v for v in variables([first]).values())
                yield step.name, f"{written(-(b / a))} - {written(symbol)}"


def _python_root(b: str, discriminant: str, twice: str) -> str:
    return f"({b} + sqrt({discriminant}))/({twice})"


def _latex_root(b: str, discriminant: str, twice: str) -> str:
    return rf"\frac{{{b} + \sqrt{{{discriminant}}}}}{{{twice}}}"


def confirm(form: ClosedForm, model: AnyModel, other: AnyModel) -> ClosedForm:
    """The same with its error bound; raises ContradictionError where it is wrong."""
    own_model, other_model = on_one_variable([model, other])
    once = _size(form, own_model, other_model)
    size = Size(once.degree * DRAWS, once.bits)
    label = about("closed form", own_model.content, other_model.content)
    points = enough(size, POINTS)
    if not all(
        _agrees(form, own_model, other_model, f"{label}:{number}") for number in range(points)
    ):
        raise ContradictionError(f"the formulas from {model.name} to {other.name} are wrong")
    return replace(form, safety=safety(size, points))


def _agrees(form: ClosedForm, model: AnyModel, other: AnyModel, label: str) -> bool:
    """Return True if both transfer functions agree at one point, whatever the signs of the
    roots.
    """
    modulus = prime(label)
    field = fmpz_mod_ctx(modulus)
    for draw in range(DRAWS):
        drawn = residues(f"{label}:{draw}", len(form.given), modulus)
        point = {n: field(x) for n, x in zip(form.given, drawn, strict=True)}
        try:
            rows = list(_evaluate_form(form, point, _square_root))
        except (ZeroDivisionError, _NoSquareError):
            continue
        given = [point[n] for n in model.parameters]
        return all(
            _same(model, other, given, [values[n] for n in other.parameters]) for values in rows
        )
    raise ContradictionError("a discriminant is a square at no point that was drawn")


class _NoSquareError(Exception):
    """A discriminant is no square at a point."""


def _evaluate_form(
    form: ClosedForm, point: Mapping[str, Residue], square_root: Callable[[Residue], Residue]
) -> Iterator[dict[str, Residue]]:
    """Yield the values at a point, for all signs of the square roots."""
    quadratics = [s.root for s in form.steps if s.root and s.sign > 0]
    for signs in product((1, -1), repeat=len(quadratics)):
        values_so_far = dict(point)
        for step in form.steps:
            if step.root:
                _, b, a = step.root
                way = step.sign * signs[quadratics.index(step.root)]
                root = way * square_root(_number(step.discriminant, values_so_far))
                values_so_far[step.name] = (root - _number(b, values_so_far)) / (
                    2 * _number(a, values_so_far)
                )
            else:
                values_so_far[step.name] = _number(step.value, values_so_far)
        yield {name: _number(value, values_so_far) for name, value in form.values}


def _square_root(number: Residue) -> Residue:
    try:
        return number.sqrt()
    except DomainError as none:
        raise _NoSquareError from none


def _number(value: RationalFunction, at: Mapping[str, Residue]) -> Residue:
    return _polynomial(value.num, at) / _polynomial(value.den, at)


def _polynomial(polynomial: fmpz_mpoly, at: Mapping[str, Residue]) -> Residue:
    names = polynomial.context().names()
    zero = total = next(iter(at.values())) * 0
    for exponents, number in polynomial.to_dict().items():
        term = zero + int(number)
        for name, e in zip(names, exponents, strict=True):
            if e:
                term *= at[name] ** int(e)
        total += term
    return total


def _same(model: AnyModel, other: AnyModel, p: Sequence[Residue], q: Sequence[Residue]) -> bool:
    """Return True if all coefficients divided by the leading one are equal, with nonzero leading
    coefficients.
    """
    for own_model, other_model in zip(model.entries, other.entries, strict=True):
        own_values, other_values = (
            [_value_of(t, at) for t in (*m.numerator_terms, *m.denominator_terms)]
            for m, at in ((own_model, p), (other_model, q))
        )
        if len(own_values) != len(other_values) or not other_values[-1]:
            return False
        if any(
            a * other_values[-1] != b * own_values[-1]
            for a, b in zip(own_values, other_values, strict=True)
        ):
            return False
    return True


def _value_of(terms: Terms, point: Sequence[Residue]) -> Residue:
    zero = total = point[0] * 0
    for exponents, number in terms:
        term = zero + number
        for x, e in zip(point, exponents, strict=True):
            if e:
                term *= x**e
        total += term
    return total


def _size(form: ClosedForm, given_model: AnyModel, other: AnyModel) -> Size:
    """Bounds of the polynomials c_S, of what is compared and of all denominators."""
    bounds = dict.fromkeys(form.given, (1.0, 0.0))
    for step in form.steps:
        parts = [_bounds(v, bounds) for v in step.made_of]
        if step.root:  # (-b + w)/(2 a), w^2 the discriminant
            parts = [*parts[1:], _bounds(step.discriminant, bounds), (0.0, 2.0)]
        bounds[step.name] = sum(d for d, _ in parts), sum(b for _, b in parts)
    values = {name: _bounds(value, bounds) for name, value in form.values}
    parts = [*bounds.values(), *values.values()]
    for model, at in ((given_model, bounds), (other, values)):
        for entry in model.entries:
            every = [t for c in (*entry.numerator_terms, *entry.denominator_terms) for t in c]
            powers = [max(e[i] for e, _ in every) for i in range(len(entry.parameters))]
            used = [(2 * k, *at[n]) for k, n in zip(powers, entry.parameters, strict=True)]
            parts += [(0.0, 2 * log2(sum(abs(c) for _, c in every)))]
            parts += [(k * d, k * b) for k, d, b in used]
    return Size(int(sum(d for d, _ in parts)) + 1, int(sum(b for _, b in parts)) + 1)


def _bounds(
    value: RationalFunction, entries: Mapping[str, tuple[float, float]]
) -> tuple[float, float]:
    """Degree, and bits of the sum of all coefficients' sizes, of numerator and denominator in the
    parameters once what has a name is put in.
    """
    names = value.num.context().names()
    powers = [max(pair) for pair in zip(value.num.degrees(), value.den.degrees(), strict=True)]
    used = [(int(k), *entries[n]) for k, n in zip(powers, names, strict=True) if k]
    most = max(sum(abs(int(c)) for c in side.coeffs()) for side in (value.num, value.den))
    return sum(k * d for k, d, _ in used), log2(most) + sum(k * b for k, _, b in used)
