"""Rounded values, written with as many digits as their response needs.

What a search shows is that an exact equivalent is near some numbers. Those that are written down
are to give the response themselves: every coefficient, over the leading one of the denominator, to
a relative error of `AGREE`. That is seen with fractions, so nothing is lost on the way. Where
coefficients are differences, or a value is not known that well, no digits may be enough.
"""

from collections.abc import Sequence
from fractions import Fraction

from disting.errors import InputError
from disting.evidence.kind import PointText
from disting.general.matrix_model import AnyModel, Model
from disting.general.target import Values, rational_values, value_at

AGREE = Fraction(1, 10**9)
DIGITS = range(6, 18)  # 17 give any number of double precision back


def written(
    model: AnyModel, values: Values, other: AnyModel, equivalent: Sequence[float]
) -> PointText | None:
    """An equivalent in the other model of a point, with the fewest digits that give its response;
    None where no digits do.

    >>> from disting.general.matrix_model import Model
    >>> one, two = (Model.from_transfer_function("b", f"s + {d}") for d in ("a + b", "a"))
    >>> written(one, {"a": Fraction(1, 3), "b": Fraction(3)}, two, (10 / 3, 3.0))
    (('a', '3.33333333'), ('b', '3'))
    >>> written(one, {"a": Fraction(1, 3), "b": Fraction(3)}, two, (3.3, 3.0)) is None
    True
    """
    texts = (
        tuple((name, f"{x:.{n}g}") for name, x in zip(other.parameters, equivalent, strict=True))
        for n in DIGITS
    )
    return next((t for t in texts if agree(model, values, other, _read(t))), None)


def _read(text: PointText) -> Values:
    return {name: Fraction(x) for name, x in text}


def is_plain(text: str) -> bool:
    """Return True if a number is spelled as it is `written`."""
    try:
        number = float(text)
    except ValueError:
        return False
    return any(f"{number:.{n}g}" == text for n in DIGITS)


def agree(model: AnyModel, values: Values, other: AnyModel, others: Values) -> bool:
    """Return True if both have nearly the same coefficients at these values."""
    pairs = list(zip(model.entries, other.entries, strict=True))
    try:
        sides = [(_ratios(a, values), _ratios(b, others)) for a, b in pairs]
    except (InputError, ZeroDivisionError):
        return False
    return all(
        len(own) == len(found)
        and all(abs(x - y) <= AGREE * abs(x) for x, y in zip(own, found, strict=True))
        for own, found in sides
    )


def _ratios(model: Model, values: Values) -> list[Fraction]:
    """All coefficients over the leading one of the denominator: those of the denominator, of which
    the last one is 1, then those of the numerator.
    """
    point = [x for _, x in rational_values(model, values)]
    terms = (*model.denominator_terms, *model.numerator_terms)
    numbers = [value_at(t, point) for t in terms]
    lead = numbers[len(model.denominator_terms) - 1]
    return [x / lead for x in numbers]
