"""Special values at which a transfer function has a lower degree, against SymPy."""

from fractions import Fraction

import pytest
from sympy import (
    Poly,
    Rational,
    Symbol,
    cancel,
    resultant,
    sign,
    simplify,
    solve,
    symbols,
    sympify,
)

from disting import Model, network_of
from disting.general.any_model import of_network
from disting.general.special_values import lower_degree, special_values
from disting.network.families import FAMILIES

S = Symbol("s")


def _sides(model: Model):  # type: ignore[no-untyped-def]
    values = symbols(list(model.parameters))
    return [
        sum(
            number * S**power * _powers(values, exponents)
            for power, terms in enumerate(side)
            for exponents, number in terms
        )
        for side in (model.numerator_terms, model.denominator_terms)
    ]


def _powers(values, exponents):  # type: ignore[no-untyped-def]
    made = 1
    for x, e in zip(values, exponents, strict=True):
        made *= x**e
    return made


def _at(model: Model, values: dict[str, Fraction]) -> int:
    """The degree of the transfer function at some values, by SymPy."""
    top, bottom = (
        side.subs({Symbol(p): Rational(v.numerator, v.denominator) for p, v in values.items()})
        for side in _sides(model)
    )
    num, den = cancel(top / bottom).as_numer_denom()
    return max(Poly(part, S).degree() for part in (num, den))


@pytest.mark.thin(8)
@pytest.mark.parametrize("network", FAMILIES["circuits-4"].networks[::2], ids=lambda n: n.name)
def test_signs_of_the_resultant_say_whether_a_degree_can_fall(network) -> None:  # type: ignore[no-untyped-def]
    model = of_network(network)
    top, bottom = _sides(model)
    found = lower_degree(model)
    assert found is not None
    if not model.degrees[0] or not model.degrees[1]:
        assert found == ()
        return
    coefficients = Poly(resultant(top, bottom, S), *symbols(list(model.parameters))).coeffs()
    assert (len({sign(c) for c in coefficients}) > 1) == bool(found)


@pytest.mark.parametrize(
    ("text", "special", "generic"),
    [
        ("p(R1,C1)-p(R2,C2)", {"R1": 2, "C1": 3, "R2": 1, "C2": 6}, {"R1": 2, "C1": 3, "R2": 1, "C2": 5}),
        ("p(R1,L1)-p(R2,C1)", {"R1": 2, "L1": 6, "R2": 1, "C1": 3}, {"R1": 2, "L1": 5, "R2": 1, "C1": 3}),
    ],
)  # fmt: skip
def test_at_the_special_values_the_degree_is_lower(text, special, generic) -> None:  # type: ignore[no-untyped-def]
    model = of_network(network_of(text))
    (condition,) = lower_degree(model)
    for values, is_special in ((special, True), (generic, False)):
        numbers = {p: Fraction(v) for p, v in values.items()}
        assert (eval(condition.polynomial, {}, numbers) == 0) == is_special
        assert (_at(model, numbers) < max(model.degrees)) == is_special


@pytest.mark.full
@pytest.mark.parametrize(
    ("text", "poles", "zeros"),
    [
        ("p(R1,C1)-p(R2,C2)", True, False),
        ("p(R1-C1,R2-C2)", False, True),
        ("R1-p(R2,C1)-p(R3,C2)", True, False),
        ("p(R1,R2-C1,R3-C2)", False, True),
    ],
)
def test_poles_or_zeros_fall_together(text, poles, zeros) -> None:  # type: ignore[no-untyped-def]
    """R1 C1 = R2 C2 put in by SymPy, before anything cancels."""
    model = of_network(network_of(text))
    (found,) = lower_degree(model)
    assert (found.poles, found.zeros) == (poles, zeros)
    (equation,) = solve(sympify(found.polynomial), Symbol("C1"))
    top, bottom = (Poly(side.subs(Symbol("C1"), equation), S) for side in _sides(model))
    assert (simplify(bottom.discriminant()) == 0) == poles
    assert (simplify(top.discriminant()) == 0) == zeros


@pytest.mark.parametrize(
    ("left", "right", "said"),
    [
        ("p(R1,R2-C1,R3-C2)", "R1-p(R2,C1)-p(R3,C2)", "A and B give the same, for all positive values (proven)."),
        ("R1-p(R2,C1)", "R1-p(R2,C1)-p(R3,C2)", "For all positive values of A, B can give the same (proven), but not the other way round. B has fewer poles where C1*R2 - C2*R3 = 0."),
        ("1~2~3, 2~4, 2~5; F1; S3", "1~2~3, 2~4~5; F1; S3", "For all positive values of B, A can give the same (proven); the converse is not known."),
        ("R1-C1", "R1-L1", ""),
    ],
)  # fmt: skip
def test_what_is_said_of_special_values(left, right, said) -> None:  # type: ignore[no-untyped-def]
    found = special_values(*(of_network(network_of(text)) for text in (left, right)))
    assert found.sentence("A", "B") == said


def test_what_is_not_known_is_not_said() -> None:
    assert lower_degree(Model.from_transfer_function(["a", "-b"], ["1", "c"])) is None
    # the resultant x^2 - 3 x + 1 is linear in nothing
    assert lower_degree(Model.from_transfer_function(["1", "x**2 + 1"], ["1", "3*x"])) is None
