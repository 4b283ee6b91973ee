"""Polynomials and fractions as FLINT writes them, which `text` reads back.

This is how evidence is stored: its bytes depend on no printer's taste, and a search writes
hundreds without loading SymPy.
"""

from collections.abc import Sequence

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.rational_function import RationalFunction


def polynomial_text(polynomial: fmpz_mpoly, names: Sequence[str]) -> str:
    """A polynomial with other names of its variables."""
    context = fmpz_mpoly_ctx.get(tuple(names), Ordering.degrevlex)
    return str(context.from_dict(polynomial.to_dict())).replace("^", "**")


def text_of(ratio: RationalFunction, names: Sequence[str]) -> str:
    """A fraction with other names of its variables."""
    top, bottom = (polynomial_text(side, names) for side in (ratio.num, ratio.den))
    if bottom == "1":
        return top
    return "/".join(f"({x})" if any(c in x for c in " */") else x for x in (top, bottom))
