"""Values that are written in steps: fractions of parameters, of values that have a name of their
own, and of roots of quadratic equations.

A value of more than some terms gets a name, and what is made of it contains the name. So what would
be a fraction of thousands of terms is some short ones. Names are not independent: whether a value
is zero cannot be decided from its notation. Code that builds values ensures it otherwise, and the
values are substituted into the equations (see `closed_form`).
"""

from abc import abstractmethod
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import reduce
from itertools import count
from typing import Any

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction, coefficients, factorise, symbols
from disting.general.orthant import TooMuch

QUADRATIC = 2
MOST_NAMES = 60
LARGEST = 2000  # terms of a polynomial that is factored
Poly = tuple[Any, ...]
"""Coefficients of x^0, x^1, .."""
Assignment = tuple[tuple[str, RationalFunction], ...]
"""By the names of parameters."""


@dataclass(frozen=True, slots=True)
class Step:
    """A value with a name: `value`, or with `root` = (c, b, a) a root of c + b x + a x^2, that with
    this `sign` of the square root.
    """

    name: str
    value: RationalFunction
    root: Poly = ()
    sign: int = 1

    @property
    def made_of(self) -> tuple[RationalFunction, ...]:
        """Rational functions in which the step is written."""
        return self.root or (self.value,)

    def renamed(self, name: str, by: Sequence[fmpz_mpoly]) -> "Step":
        """The same in other names."""
        root = tuple(compose(c, by) for c in self.root)
        return Step(name, compose(self.value, by), root, self.sign)

    @property
    def discriminant(self) -> RationalFunction:
        """b^2 - 4 a c."""
        c, b, a = self.root
        function: RationalFunction = b * b - four(a * c)
        return function


def four(value: RationalFunction) -> RationalFunction:
    """Four times a value."""
    return RationalFunction(4 * value.num, value.den)


class Arithmetic:
    """Polynomials in x over a field, a subclass defines its values. `choices`: elements of which
    only some sum of what they have is determined.
    """

    one: Any
    choices: list[tuple[str, ...]]

    @property
    def zero(self) -> Any:
        """Nothing."""
        return self.one - self.one

    def is_zero(self, value: Any) -> bool:
        """Return True if it is written as zero."""
        return bool(value == self.zero)

    def short(self, value: Any) -> Any:
        """The value, or a name for it."""
        return value

    def times(self, *polynomials: Poly) -> Poly:
        """Their product."""
        return reduce(self._times, polynomials, (self.one,))

    def _times(self, first: Poly, other: Poly) -> Poly:
        product = [self.zero] * (len(first) + len(other) - 1)
        for i, a in enumerate(first):
            for j, b in enumerate(other):
                product[i + j] += a * b
        return tuple(map(self.short, product))

    def plus(self, parts: Poly, other: Poly, factor: Any = None) -> Poly:
        """one + factor other."""
        by = self.one if factor is None else factor
        size = max(len(parts), len(other))
        a, b = ((*p, *[self.zero] * (size - len(p))) for p in (parts, other))
        return tuple(self.short(x + by * y) for x, y in zip(a, b, strict=True))

    @abstractmethod
    def number(self, value: int) -> Any:
        """A constant."""

    @abstractmethod
    def lifted(self, polynomial: fmpz_mpoly) -> Any:
        """A polynomial in the parameters."""

    @abstractmethod
    def __getitem__(self, name: str) -> Any:
        """A parameter."""

    @abstractmethod
    def factors(self, polynomial: Poly) -> list[Poly]:
        """Polynomials whose product it is, but for a factor without x."""

    def linear(self, factor: Poly) -> list[Poly]:
        """Factors of one of `factors` with a new root, itself where there are none."""
        return [factor]

    def choose(self, names: Sequence[str]) -> None:
        """Remember that only some sum of what these elements have is determined."""
        if tuple(names) not in self.choices:
            self.choices.append(tuple(names))


@dataclass
class Field(Arithmetic):
    """Fractions of some parameters and of values that get a name on the way; raises TooMuch where
    these are too many.

    >>> found = Field(("a", "b"))
    >>> one, _ = found.split((found["b"], found["a"], found.one))
    >>> str(one.num), found.steps[0].discriminant == found["a"]**2 - four(found["b"])
    ('x1', True)
    """

    parameters: tuple[str, ...]
    letters: int = 40  # of a value without a name
    steps: list[Step] = field(default_factory=list)
    choices: list[tuple[str, ...]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._letters = [
            next(c * k for k in count(1) if not any(n.startswith(c * k) for n in self.parameters))
            for c in "ux"
        ]
        names = [f"{c}{i}" for c in self._letters for i in range(1, MOST_NAMES + 1)]
        self.ring = symbols([*self.parameters, *names, " "])
        self.one = RationalFunction(self.ring[" "] ** 0, self.ring[" "] ** 0)

    def __getitem__(self, name: str) -> RationalFunction:
        return RationalFunction(self.ring[name], self.one.num)

    def short(self, value: RationalFunction) -> RationalFunction:
        """The value, or a name for it."""
        if letters(value.num) + letters(value.den) <= self.letters:
            return value
        step = next((s for s in self.steps if not s.root and s.value == value), None)
        return self[step.name] if step else self._name_value(0, value)

    def number(self, value: int) -> RationalFunction:
        """A constant."""
        return RationalFunction(self.one.num * value, self.one.num)

    def linear(self, factor: Poly) -> list[Poly]:
        """Both of a factor of degree 2, by names of its roots; others as they are."""
        if len(factor) - 1 != QUADRATIC:
            return [factor]
        return [(-root, self.one) for root in self.split(factor)]

    def split(self, quadratic: Poly) -> tuple[RationalFunction, RationalFunction]:
        """Both roots of a polynomial of degree 2, by names."""
        steps = [s for s in self.steps if s.root == quadratic]
        if steps:
            function, other = (self[s.name] for s in steps)
        else:
            function, other = (self._name_value(1, self.one, quadratic, sign) for sign in (1, -1))
        return function, other

    def _name_value(
        self, letter: int, value: RationalFunction, root: Poly = (), sign: int = 1
    ) -> RationalFunction:
        start = self._letters[letter]
        number = 1 + sum(bool(s.root) == letter for s in self.steps)
        if number > MOST_NAMES:
            raise TooMuch(f"more than {MOST_NAMES} values with a name")
        self.steps.append(Step(f"{start}{number}", value, root, sign))
        return self[f"{start}{number}"]

    def written(self, values: Assignment) -> tuple[tuple[Step, ...], Assignment]:
        """The steps that values are made of, renumbered, and the values: one that is a name that
        occurs nowhere else is written out.
        """
        steps = {s.name: s for s in self._steps_of(v for _, v in values)}
        used = Counter(
            name
            for v in (*(v for _, v in values), *(x for s in steps.values() for x in s.made_of))
            for name in names_in(v)
        )
        kept = dict(values)
        for name, value in values:
            symbol = next(iter(names_in(value)), "")
            alone = symbol in steps and used[symbol] == 1 and value == self[symbol]
            if alone and not steps[symbol].root:
                kept[name] = steps.pop(symbol).value
        numbers, images = Counter[str](), dict(self.ring)
        for name in steps:
            letter = name.rstrip("0123456789")
            numbers[letter] += 1
            images[name] = self.ring[f"{letter}{numbers[letter]}"]
        by = list(images.values())
        return (
            tuple(s.renamed(str(images[s.name]), by) for s in steps.values()),
            tuple((name, compose(v, by)) for name, v in kept.items()),
        )

    def _steps_of(self, values: Iterable[RationalFunction]) -> tuple[Step, ...]:
        wanted, kept = {n for v in values for n in names_in(v)}, list[Step]()
        for step in reversed(self.steps):
            if step.name in wanted or (step.root and self._other_root(step) in wanted):
                kept.append(step)
                wanted |= {n for v in step.made_of for n in names_in(v)}
        return tuple(reversed(kept))

    def _other_root(self, step: Step) -> str:
        return next(s.name for s in self.steps if s.root == step.root and s.sign != step.sign)

    def lifted(self, polynomial: fmpz_mpoly) -> RationalFunction:
        """A polynomial in the parameters."""
        images = [self.ring[n] for n in polynomial.context().names()]
        return RationalFunction(
            polynomial.compose(*images, ctx=self.one.num.context()), self.one.num
        )

    def factors(self, polynomial: Poly) -> list[Poly]:
        """Polynomials whose product it is, up to a factor without x; none of them is a product as
        far as the notation of its coefficients shows.
        """
        common = reduce(_multiple, (c.den for c in polynomial))
        x = self.ring[" "]
        whole = sum(((c.num * (common // c.den)) * x**i for i, c in enumerate(polynomial)), x - x)
        if len(whole) > LARGEST:
            return [polynomial]
        return [
            tuple(RationalFunction(c, self.one.num) for c in coefficients(f, " "))
            for f, power in factorise(whole)[1]
            for _ in range(power)
            if f.degrees()[-1]
        ]


def compose(value: RationalFunction, by: Sequence[fmpz_mpoly]) -> RationalFunction:
    """The value with other symbols in place of those of its ring."""
    ring = value.num.context()
    return RationalFunction(*(side.compose(*by, ctx=ring) for side in (value.num, value.den)))


def letters(polynomial: fmpz_mpoly) -> int:
    """Number of written symbols, not counting powers; a number is one."""
    return sum(max(1, sum(map(bool, e))) for e in polynomial.monoms())


def names_in(value: RationalFunction) -> set[str]:
    """The symbols that occur."""
    names = value.num.context().names()
    return {
        name
        for side in (value.num, value.den)
        for name, degree in zip(names, side.degrees(), strict=True)
        if degree
    }


def _multiple(polynomial: fmpz_mpoly, other: fmpz_mpoly) -> fmpz_mpoly:
    return polynomial // polynomial.gcd(other) * other
