"""Rational functions for people: as text that Python and SymPy read, in LaTeX, and as SymPy expressions."""

from collections.abc import Callable
from importlib import import_module
from typing import Any

from disting.equivalence.expression import Expression, Polynomial, factors, terms
from disting.errors import InputError

Power = Callable[[str, int], str]


def text(expression: Expression) -> str:
    """Factorised, a valid Python expression.

    >>> from disting.equivalence.expression import variables
    >>> a, b = variables(["m1", "m2"]).values()
    >>> text(a * a * (a + b) / b)
    'm1**2*(m1 + m2)/m2'
    """
    top, bottom = _product(expression.num, "*", _power, "()"), _product(expression.den, "*", _power, "()")
    if expression.den.is_one():
        return _bare(expression.num, _power, "*") or top
    above = top if _is_product(expression.num) else f"({_bare(expression.num, _power, '*')})"
    return f"{above}/{bottom}" if _is_single(expression.den) else f"{above}/({bottom})"


def latex(expression: Expression) -> str:
    r"""Factorised.

    >>> from disting.equivalence.expression import variables
    >>> a, b = variables(["m1", "m2"]).values()
    >>> latex(a * b / (a + b) ** 2)
    '\\frac{m_{1} m_{2}}{\\left(m_{1} + m_{2}\\right)^{2}}'
    """
    top, bottom = (
        _bare(p, _latex_power, " ") or _product(p, " ", _latex_power, (r"\left(", r"\right)"))
        for p in (expression.num, expression.den)
    )
    return top if expression.den.is_one() else rf"\frac{{{top}}}{{{bottom}}}"


def latex_symbol(name: str) -> str:
    """m_{1} for m1, k_{9,10} for k9_10."""
    return f"{name[0]}_{{{name[1:].replace('_', ',')}}}"


def sympy_expression(expression: Expression) -> Any:
    """The same for SymPy, with plain symbols of the parameters' names. Raises InputError where SymPy is not installed."""
    try:
        sympy = import_module("sympy")  # optional, and without types
    except ImportError:
        raise InputError("SymPy is not installed: pip install sympy, or use the formulas as text or LaTeX") from None

    def of(polynomial: Polynomial) -> Any:
        """The sum of its terms."""
        summands = ((c, powers.items()) for c, powers in terms(polynomial))
        return sympy.Add(*(c * sympy.Mul(*(sympy.Symbol(n) ** e for n, e in powers)) for c, powers in summands))

    top, bottom = (
        sympy.Mul(content, *(of(p) ** e for p, e in found))
        for content, found in (factors(p) for p in (expression.num, expression.den))
    )
    return top / bottom


def _bare(polynomial: Polynomial, power: Power, times: str) -> str:
    """A sum that is irreducible, without parentheses; nothing for others."""
    content, found = factors(polynomial)
    single = abs(content) == 1 and len(found) == 1 and found[0][1] == 1
    return _sum(polynomial, power, times) if single or not found else ""


def _product(polynomial: Polynomial, times: str, power: Power, brackets: Any) -> str:
    content, found = factors(polynomial)
    number = [str(abs(content))] if abs(content) != 1 or not found else []
    parts = [_factor(p, e, power, times, brackets) for p, e in found]
    return ("-" if content < 0 else "") + times.join(number + parts)


def _factor(polynomial: Polynomial, exponent: int, power: Power, times: str, brackets: Any) -> str:
    inner = _sum(polynomial, power, times)
    return power(inner if len(polynomial) == 1 else f"{brackets[0]}{inner}{brackets[1]}", exponent)


def _sum(polynomial: Polynomial, power: Power, times: str) -> str:
    written = [_term(c, powers, power, times) for c, powers in terms(polynomial)]
    return " + ".join(written).replace("+ -", "- ")


def _term(coefficient: int, powers: dict[str, int], power: Power, times: str) -> str:
    symbol = latex_symbol if power is _latex_power else str
    names = [power(symbol(name), e) for name, e in powers.items()]
    number = [] if abs(coefficient) == 1 and names else [str(abs(coefficient))]
    return ("-" if coefficient < 0 else "") + times.join(number + names)


def _power(base: str, exponent: int) -> str:
    return base if exponent == 1 else f"{base}**{exponent}"


def _latex_power(base: str, exponent: int) -> str:
    return base if exponent == 1 else f"{base}^{{{exponent}}}"


def _is_product(polynomial: Polynomial) -> bool:
    return not _bare(polynomial, _power, "*") or len(polynomial) == 1


def _is_single(polynomial: Polynomial) -> bool:
    """Whether it may stand behind a slash: one factor, not a product."""
    content, found = factors(polynomial)
    return len(found) + (abs(content) != 1) == 1
