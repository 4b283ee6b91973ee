"""Polynomials and rational functions with named symbols.

Lowest terms are exact: numerator and denominator have no common factor in Z[symbols], numbers
included, and the first coefficient of the denominator (in the ring's lexicographic order) is
positive. So equal functions are equal pairs.

People read them as text that Python reads, in LaTeX, and as SymPy's expressions.

Text and LaTeX keep the order of the terms, which is the chain's (k12/m1 + k12/m2, where SymPy would
sort k12/m2 + k12/m1), and write numbers before sums. Expressions are in symbols that are positive,
as parameters are, but for the frequency variable s. Importing SymPy takes about as long as
importing all of this package, and 18 MB: only who computes with an expression of SymPy loads it.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias, TypeVar, cast

from flint import Ordering, fmpq_mpoly_ctx, fmpz, fmpz_mpoly, fmpz_mpoly_ctx

if TYPE_CHECKING:
    import sympy
    from flint.typing import scalar_p

REMEMBERED = 2048  # polynomials with their factors
Polynomial = fmpz_mpoly
Term = tuple[int, Mapping[str, int]]
"""Coefficient and {symbol: exponent}."""
Content = tuple[tuple[str, ...], tuple[tuple[tuple[int, ...], int], ...]]
"""Names, and (exponents, coefficient) of every term; unlike a polynomial it has a hash."""
Scalar = TypeVar("Scalar", bound="scalar_p")
"""An element of a field."""


def symbols(names: Sequence[str]) -> dict[str, fmpz_mpoly]:
    """The generators of Z[names], in lexicographic order of the names as given."""
    context = fmpz_mpoly_ctx.get(tuple(names), Ordering.lex)
    return dict(zip(names, context.gens(), strict=True))


def content(polynomial: Polynomial) -> Content:
    """The names of its ring, and its terms, in an order: equal polynomials have equal content.

    >>> m, k = symbols(["m1", "k12"]).values()
    >>> content(k - 2 * m)
    (('m1', 'k12'), (((1, 0), -2), ((0, 1), 1)))
    """
    entries = tuple((powers, int(number)) for powers, number in polynomial.to_dict().items())
    return polynomial.context().names(), entries


def polynomial_of(entries_of: Content) -> Polynomial:
    """The polynomial of this content.

    >>> polynomial_of((("m1", "k12"), (((1, 0), -2), ((0, 1), 1))))
    -2*m1 + k12
    """
    names, entries = entries_of
    return fmpz_mpoly_ctx.get(names, Ordering.lex).from_dict(dict(entries))


def rename_symbols(
    polynomial: fmpz_mpoly, ring: Mapping[str, fmpz_mpoly], renaming: Mapping[str, str]
) -> fmpz_mpoly:
    """The polynomial with each symbol replaced by the one that `renaming` names (itself where
    not named), in `ring`.
    """
    names = [str(g) for g in polynomial.context().gens()]
    images = [ring[renaming.get(name, name)] for name in names]
    return polynomial.compose(*images, ctx=images[0].context())


def coefficients(polynomial: fmpz_mpoly, variable: str) -> list[fmpz_mpoly]:
    """Coefficients of the powers 0, 1, .. of one symbol.

    >>> s, m = symbols(["s", "m1"]).values()
    >>> [str(c) for c in coefficients(m * s**2 + 3, "s")]
    ['3', '0', 'm1']
    """
    context = polynomial.context()
    names = [str(g) for g in context.gens()]
    at = names.index(variable)
    parts: list[dict[tuple[int, ...], int]] = [{} for _ in range(polynomial.degrees()[at] + 1)]
    for powers, number in polynomial.to_dict().items():
        rest = tuple(0 if i == at else power for i, power in enumerate(powers))
        parts[powers[at]][rest] = int(number)
    return [context.from_dict(part) for part in parts]


def terms(polynomial: fmpz_mpoly) -> list[Term]:
    """Every term, in the ring's order.

    >>> m, k = symbols(["m1", "k12"]).values()
    >>> terms(k - 2 * m**2)
    [(-2, {'m1': 2}), (1, {'k12': 1})]
    """
    names = polynomial.context().names()
    pairs = polynomial.terms()
    return [
        (int(c), {name: int(e) for name, e in zip(names, powers, strict=True) if e})
        for powers, c in pairs
    ]


def factors(polynomial: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    """The integer content with sign, and the irreducible factors with exponents, single symbols
    first.
    """
    content, powers = factorise(polynomial)
    return content, sorted(powers, key=lambda pe: (len(pe[0]), str(pe[0])))


def factorise(polynomial: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    """The integer content with sign, and the irreducible factors with exponents, in FLINT's order;
    of coefficients of any size.

    `fmpz_mpoly.factor()` of python-flint 0.9 sorts what it found by differences of coefficients
    that it takes for C integers: from 2^31 on it raises OverflowError. `fmpq_mpoly.factor()` finds
    the same factors, primitive and in the same order, and compares numbers of any size.

    >>> x, y = symbols(["x", "y"]).values()
    >>> factorise(6 * (x + 3 * 10**9) * (x + 1) ** 2 * (x - 10**9))
    (6, [(x - 1000000000, 1), (x + 3000000000, 1), (x + 1, 2)])
    """
    number, powers = _known_factors(polynomial.context(), frozenset(polynomial.to_dict().items()))
    return number, list(powers)


@lru_cache(maxsize=REMEMBERED)
def _known_factors(
    ring: fmpz_mpoly_ctx, items: frozenset[tuple[tuple[int, ...], fmpz]]
) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    """Content and factors of a polynomial by its terms, which can be a key: searches by cases meet
    the same one again and again.
    """
    polynomial = ring.from_dict(dict(items))
    try:
        number, powers = polynomial.factor()
    except OverflowError:
        return _over_rationals(polynomial)
    return int(number), [(factor, int(power)) for factor, power in powers]


def _over_rationals(polynomial: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    ring = polynomial.context()
    field = fmpq_mpoly_ctx.get(ring.names(), ring.ordering())
    number, powers = field.from_dict(polynomial.to_dict()).factor()
    return int(number), [
        (ring.from_dict({e: int(c) for e, c in factor.to_dict().items()}), power)
        for factor, power in powers
    ]


@dataclass(frozen=True, slots=True)
class RationalFunction:
    """num/den, polynomials of one ring; raises ZeroDivisionError where den is zero.

    >>> x, y = variables(["x", "y"]).values()
    >>> (x**2 - y**2) / (x + y) == x - y, (x / y).degree
    (True, 1)
    """

    num: fmpz_mpoly
    den: fmpz_mpoly

    def __post_init__(self) -> None:
        if self.den.is_zero():
            raise ZeroDivisionError("a rational function divided by zero")
        if self.den.is_one():
            return
        common = self.num.gcd(self.den)
        if self.den.leading_coefficient() < 0:
            common = -common
        if not common.is_one():
            object.__setattr__(self, "num", self.num // common)
            object.__setattr__(self, "den", self.den // common)

    def __add__(self, other: "RationalFunction") -> "RationalFunction":
        common = self.den.gcd(other.den)
        left, right = other.den // common, self.den // common
        return RationalFunction(self.num * left + other.num * right, self.den * left)

    def __sub__(self, other: "RationalFunction") -> "RationalFunction":
        return self + -other

    def __neg__(self) -> "RationalFunction":
        return RationalFunction(-self.num, self.den)

    def __mul__(self, other: "RationalFunction") -> "RationalFunction":
        return RationalFunction(self.num * other.num, self.den * other.den)

    def __truediv__(self, other: "RationalFunction") -> "RationalFunction":
        return RationalFunction(self.num * other.den, self.den * other.num)

    __floordiv__ = __truediv__  # in a field every division is exact

    def __pow__(self, exponent: int) -> "RationalFunction":
        top, bottom = (self.num, self.den) if exponent >= 0 else (self.den, self.num)
        return RationalFunction(top ** abs(exponent), bottom ** abs(exponent))

    @property
    def degree(self) -> int:
        """The larger total degree of numerator and denominator."""
        return max(int(p.total_degree()) for p in (self.num, self.den))

    def value(self, at: Mapping[str, Scalar]) -> Scalar:
        """Value at a point of a field. Raises ZeroDivisionError at a pole."""
        return _value(self.num, at) / _value(self.den, at)


def variables(names: Sequence[str]) -> dict[str, RationalFunction]:
    """The symbols as rational functions."""
    return {name: RationalFunction(symbol, symbol**0) for name, symbol in symbols(names).items()}


def _value(polynomial: fmpz_mpoly, at: Mapping[str, Scalar]) -> Scalar:
    total = cast("Scalar", 0)  # whole numbers are in every field
    for coefficient, powers in terms(polynomial):
        term = cast("Scalar", coefficient)
        for name, exponent in powers.items():
            term = term * at[name] ** exponent
        total = total + term
    return total


Expr: TypeAlias = "sympy.Expr"
Sum = Sequence[Term]
"""A sum of products of powers, whose exponents may be negative."""
Power = tuple[str | Sum, int]
"""A symbol, by its name, or a sum, and its exponent."""


@dataclass(frozen=True, slots=True)
class Notation:
    """Notation of formulas: a `symbol`, by its name; a `power`; a first term's `minus`; a `sum`
    that is a factor; a product of `times`; and a quotient of two products, `over`, in which a sum
    that is the only factor above or below is written as a factor or, `bare`, without brackets.
    """

    symbol: Callable[[str], str]
    power: str
    minus: str
    sum: str
    times: str
    over: Callable[[list[str], list[str]], str]
    bare: bool

    def written(self, of: RationalFunction | Sum) -> str:
        """A rational function factorised, a sum term by term."""
        if not isinstance(of, RationalFunction):
            return self._sum(of)
        number, powers = _factorise(of)
        return self.product(number, [(str(p) if len(p) == 1 else terms(p), e) for p, e in powers])

    def product(self, number: Fraction, powers: Sequence[Power]) -> str:
        """A number times powers."""
        top = [(base, e) for base, e in powers if e > 0]
        bottom = [(base, -e) for base, e in powers if e < 0]
        is_quotient = bool(bottom) or number.denominator > 1
        bare = self.bare if is_quotient else number > 0
        above = self._side(abs(number.numerator), top, bare)
        below = self._side(number.denominator, bottom, bare)
        text = self.over(above, below) if is_quotient else self.times.join(above)
        return self.minus + text if number < 0 else text

    def _side(self, number: int, powers: Sequence[Power], bare: bool) -> list[str]:
        """The factors above or below."""
        numbers = [str(number)] if number != 1 or not powers else []
        alone = bare and not numbers and len(powers) == 1
        return [*numbers, *(self._power(base, e, alone) for base, e in powers)]

    def _power(self, base: str | Sum, exponent: int, alone: bool) -> str:
        text = self.symbol(base) if isinstance(base, str) else self._sum(base)
        if not (isinstance(base, str) or (alone and exponent == 1)):
            text = self.sum.format(text)
        return text if exponent == 1 else self.power.format(text, exponent)

    def _sum(self, products: Sum) -> str:
        text = "".join(
            (" - " if c < 0 else " + ") + self.product(Fraction(abs(c)), list(powers.items()))
            for c, powers in products
        )
        return (self.minus if text.startswith(" - ") else "") + (text[3:] or "0")


def text(of: RationalFunction | Sum) -> str:
    """A valid Python expression.

    >>> text([(1, {"k12": 1, "m1": -1}), (-2, {"k12": 1, "m2": -1})])
    'k12/m1 - 2*k12/m2'
    """
    return TEXT.written(of)


def latex(of: RationalFunction | Sum) -> str:
    r"""In LaTeX, without dollar signs.

    >>> latex([(1, {"k9_10": 2, "m1": -1})])
    '\\frac{k_{9,10}^{2}}{m_{1}}'
    """
    return LATEX.written(of)


def text_in_s(
    above: Sequence[Polynomial], below: Sequence[Polynomial], power: Callable[[int], str]
) -> str:
    """A rational function of s as a valid Python expression, from the coefficients of the powers
    0, 1, .. of numerator and denominator; `power` writes these.

    >>> from disting.algebra.symbols import symbols
    >>> k, m = symbols(["k", "m"]).values()
    >>> text_in_s([k], [k, m - m, m + 1], lambda n: f"s**{n}" if n else "")
    'k/(k + (m + 1)*s**2)'
    """
    (n, top), (d, bottom) = (_as_product(list(_in_s(side, power))) for side in (above, below))
    return TEXT.product(Fraction(n, d), [*top, *((base, -e) for base, e in bottom)])


def _in_s(coefficients: Sequence[Polynomial], power: Callable[[int], str]) -> Iterator[Term]:
    """The terms of a polynomial in s; sums in brackets, and powers of s, are symbols."""
    for i, products_in_s in enumerate(map(terms, coefficients)):
        in_brackets: Sum = [(1, {TEXT.sum.format(text(products_in_s)): 1})]
        for number, powers in in_brackets if i and len(products_in_s) > 1 else products_in_s:
            yield number, {**powers, power(i): 1} if power(i) else powers


def _as_product(of: Sum) -> tuple[int, list[Power]]:
    """A sum's only term, or the sum as a factor."""
    return (of[0][0], list(of[0][1].items())) if len(of) == 1 else (1, [(of, 1)])


def expression(of: RationalFunction | Sum) -> Expr:
    """The same for SymPy; a rational function factorised, a sum term by term.

    >>> from disting.algebra.symbols import variables
    >>> a, b = variables(["m1", "m2"]).values()
    >>> expression((a**2 - b**2) / a) * expression([(1, {"m1": 1})])
    (m1 - m2)*(m1 + m2)
    """
    from sympy import Add, Mul, Rational

    if not isinstance(of, RationalFunction):
        return Add(*(Mul(c, *(symbol(n) ** e for n, e in powers.items())) for c, powers in of))
    number, factored = _factorise(of)
    return Mul(Rational(number), *(expression(terms(p)) ** e for p, e in factored))


def _factorise(of: RationalFunction) -> tuple[Fraction, list[tuple[Polynomial, int]]]:
    """The number, and the other factors with their exponents."""
    (above, top), (below, bottom) = factors(of.num), factors(of.den)
    return Fraction(above, below), [*top, *((p, -e) for p, e in bottom)]


def quotient(
    above: Sequence[Polynomial], below: Sequence[Polynomial], power: Callable[[int], Expr] = int
) -> Expr:
    """A rational function of s for SymPy, from the coefficients of the powers 0, 1, .. of numerator
    and denominator, or of those that `power` makes of 0, 1, ..
    """
    top, bottom = (
        sum(expression(terms(p)) * symbol("s") ** power(i) for i, p in enumerate(side))
        for side in (above, below)
    )
    return top / bottom


def symbol(name: str) -> Expr:
    """A parameter, which is positive, or the frequency variable s."""
    from sympy import Symbol

    return Symbol(name) if name == "s" else Symbol(name, positive=True)


def latex_symbol(name: str) -> str:
    r"""m_{1} for m1, k_{9,10} for k9_10, s for s; names of several letters are upright.

    >>> latex_symbol("k9_10"), latex_symbol("gain"), latex_symbol("k_on2")
    ('k_{9,10}', '\\mathrm{gain}', 'k_{on2}')
    """
    head, index = split_name(name)
    letter = head if len(head) == 1 else rf"\mathrm{{{head.replace('_', chr(92) + '_')}}}"
    return f"{letter}_{{{index}}}" if index else letter


def split_name(name: str) -> tuple[str, str]:
    """The letters of a name, and its index: what follows from a digit or an underscore on, or a
    single small letter after a capital one.

    >>> split_name("k9_10"), split_name("tau_m"), split_name("s"), split_name("_x")
    (('k', '9,10'), ('tau', 'm'), ('s', ''), ('_x', ''))
    >>> split_name("Td"), split_name("Gain")
    (('T', 'd'), ('Gain', ''))
    """
    head = re.match(r"[A-Z](?=[a-z]$)|[^\W\d_]+", name)
    if head is None:
        return name, ""
    return head[0], name[head.end() :].strip("_").replace("_", ",")


def _python_over(above: list[str], below: list[str]) -> str:
    bottom = "*".join(below)
    return f"{'*'.join(above)}/{f'({bottom})' if len(below) > 1 else bottom}"


def _latex_over(above: list[str], below: list[str]) -> str:
    return rf"\frac{{{' '.join(above)}}}{{{' '.join(below)}}}"


TEXT = Notation(str, "{}**{}", "-", "({})", "*", _python_over, bare=False)
LATEX = Notation(latex_symbol, "{}^{{{}}}", "- ", r"\left({}\right)", " ", _latex_over, bare=True)
