"""Parts of a finding on identifiability, and the functions of the parameters in it.

They are few terms long and are differentiated by hand (d p^a = a p^a/p_i).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from math import ceil, log2
from typing import cast

from disting.algebra.certainty import Certainty, Size
from disting.algebra.symbols import Scalar, Term, latex, text
from disting.model.question import Answer

Exponents = tuple[tuple[str, int], ...]
"""Parameter names with non-zero exponents, in the chain's order."""
PAIR = 2  # names of an exchange
MOST_TERMS = 6  # of a coefficient that is written out; longer ones are named


@dataclass(frozen=True, slots=True)
class Formula:
    """Sum of coefficient * product of name^exponent.

    >>> Formula(((1, (("k12", 1), ("m1", -1), ("m2", -1))),)).text
    'k12/(m1*m2)'
    >>> Formula(((1, (("m1", 1),)), (2, (("m2", 1),)))).latex
    'm_{1} + 2 m_{2}'
    """

    terms: tuple[tuple[int, Exponents], ...]

    def value(self, at: Mapping[str, Scalar]) -> Scalar:
        """Value at a point of a field."""
        return sum(
            (c * _power(at, e) for c, e in self.terms[1:]),
            self.terms[0][0] * _power(at, self.terms[0][1]),
        )

    def gradient(self, at: Mapping[str, int], modulus: int) -> list[int]:
        """Derivatives by all parameters at a point modulo a prime."""
        slopes = dict.fromkeys(at, 0)
        for coefficient, exponents in self.terms:
            value = coefficient
            for name, exponent in exponents:
                value = value * pow(at[name], exponent, modulus) % modulus
            for name, exponent in exponents:
                slopes[name] += value * exponent * pow(at[name], -1, modulus)
        return [s % modulus for s in slopes.values()]

    @property
    def size(self) -> Size:
        """Bounds of the entries of the gradient after clearing denominators."""
        degree = max(sum(abs(e) for _, e in exponents) for _, exponents in self.terms)
        whole = sum(abs(c) * (1 + sum(abs(e) for _, e in exponents)) for c, exponents in self.terms)
        return Size((degree + 1) * (1 + len(self.terms)), ceil(log2(whole + 1)))

    @property
    def text(self) -> str:
        """For people: k01/m1."""
        return text(self._sum)

    @property
    def latex(self) -> str:
        r"""For print: \frac{k_{01}}{m_{1}}."""
        return latex(self._sum)

    def renamed(self, names: Mapping[str, str]) -> "Formula":
        """The same formula in other names."""
        return Formula(
            tuple((c, tuple((names[n], e) for n, e in exponents)) for c, exponents in self.terms)
        )

    @property
    def _sum(self) -> list[Term]:
        return [(c, dict(exponents)) for c, exponents in self.terms]


def monomial(**exponents: int) -> Formula:
    """A product of powers.

    >>> monomial(k01=1, m1=-1).text
    'k01/m1'
    """
    return Formula(((1, tuple((name, e) for name, e in exponents.items() if e)),))


def _power(at: Mapping[str, Scalar], exponents: Exponents) -> Scalar:
    value = cast("Scalar", 1)  # whole numbers are in every field
    for name, exponent in exponents:
        value = value * at[name] ** exponent if exponent > 0 else value / at[name] ** -exponent
    return value


class Level(StrEnum):
    """Structural identifiability over a domain of parameters without zeros, for generic values.

    GLOBAL: one parameter vector has this behaviour. EXCHANGES: several, each an exchange of
    parameters of the others that keeps the response. LOCAL: several, but finitely many, for some
    values at least. NOT: infinitely many. UNKNOWN: finitely many; whether more than one is not
    known.

    >>> from disting import identifiability
    >>> identifiability("2:1").level is Level.GLOBAL
    True
    """

    GLOBAL = "global"
    EXCHANGES = "up to exchanges"
    LOCAL = "local"
    NOT = "not identifiable"
    UNKNOWN = "unknown"


class Origin(StrEnum):
    """Where a parameter vector with the same behaviour comes from.

    GIVEN: the random point itself. SYMMETRY: a renaming by reciprocity or reflection. DUALITY: the
    duality theorem (the mirror image at the gap). OTHER: found by inverse synthesis.
    """

    GIVEN = "given"
    SYMMETRY = "symmetry"
    DUALITY = "duality"
    OTHER = "other"


@dataclass(frozen=True, slots=True)
class Alternative:
    """One parameter vector with the behaviour of the random point; `real` and `positive` refer to
    this point.

    `certainty` that it exists: THEOREM for all parameters, PROVEN at this point, NUMERICAL: all
    equations hold within small balls. `note`: the symmetries behind it.
    """

    origin: Origin
    real: Answer
    positive: Answer
    certainty: Certainty
    note: str = ""


@dataclass(frozen=True, slots=True)
class Renaming:
    """A symmetry of the structure onto itself: after these exchanges (old, new) the behaviour
    is the same. A theorem, or an exact identity.
    """

    moved: tuple[tuple[str, str], ...]
    symmetries: tuple[str, ...]

    @property
    def text(self) -> str:
        """The exchanges, a cycle of three and more from name to name.

        >>> Renaming((("m1", "m3"), ("m3", "m1")), ()).text
        'm1 ↔ m3'
        >>> Renaming((("a", "b"), ("b", "c"), ("c", "a")), ()).text
        'a → b → c → a'
        """
        return ", ".join(_cycle_text(cycle) for cycle in self.cycles)

    @property
    def cycles(self) -> tuple[tuple[str, ...], ...]:
        """The names that take each other's places, in order."""
        to, cycles = dict(self.moved), list[tuple[str, ...]]()
        for name in sorted(to):
            if not any(name in cycle for cycle in cycles):
                cycle = [name]
                while (following := to[cycle[-1]]) != name:
                    cycle.append(following)
                cycles.append(tuple(cycle))
        return tuple(cycles)


def _cycle_text(cycle: tuple[str, ...]) -> str:
    return " ↔ ".join(cycle) if len(cycle) == PAIR else " → ".join((*cycle, cycle[0]))


@dataclass(frozen=True, slots=True)
class Combination:
    """An identifiable function of the parameters; `name` is set for a transfer-function
    coefficient such as a2.

    `unique`: whether it has one value for all parameters with the same behaviour (it has finitely
    many in any case), with the `certainty` of this; UNKNOWN where they could not be listed.
    """

    formula: Formula
    name: str
    unique: Answer
    certainty: Certainty

    @property
    def text(self) -> str:
        """The formula, or which coefficient it is where that is too long to read (a ground
        damper may be called b1 too).
        """
        return f"coefficient {self.name}" if self.is_named else self.formula.text

    @property
    def latex(self) -> str:
        """The same in LaTeX, without dollar signs."""
        return (
            rf"\text{{coefficient }} {self.name[0]}_{{{self.name[1:]}}}"
            if self.is_named
            else self.formula.latex
        )

    @property
    def is_named(self) -> bool:
        """True if it is a coefficient whose formula is too long to read."""
        return bool(self.name) and len(self.formula.terms) > MOST_TERMS
