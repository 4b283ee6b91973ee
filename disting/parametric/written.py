"""A transfer function as text that can be read back: coefficients in the parameters, powers of s ascending."""

from collections.abc import Sequence

from flint import fmpz_mpoly


def written(numerator: Sequence[fmpz_mpoly], denominator: Sequence[fmpz_mpoly]) -> str:
    """The quotient of two polynomials in s, given by their coefficients.

    >>> from disting.algebra.symbols import symbols
    >>> k, m = symbols(["k", "m"]).values()
    >>> written([k], [k, m - m, m + 1])
    'k/(k + (m + 1)*s**2)'
    """
    top, bottom = (" + ".join(_term(c, i) for i, c in enumerate(side) if not c.is_zero()) for side in (numerator, denominator))
    if bottom == "1":
        return top
    return f"{_bracketed(top, ' /')}/{_bracketed(bottom, ' */+-')}"


def _term(coefficient: fmpz_mpoly, power: int) -> str:
    number = str(coefficient).replace("^", "**")
    if power == 0:
        return number
    s = "s" if power == 1 else f"s**{power}"
    return s if number == "1" else f"{_bracketed(number, ' ')}*{s}"


def _bracketed(text: str, signs: str) -> str:
    return f"({text})" if any(sign in text for sign in signs) else text
