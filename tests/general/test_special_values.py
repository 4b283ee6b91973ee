"""Special values at which a transfer function has a lower degree, against SymPy."""

from fractions import Fraction

import pytest
from sympy import Poly, Rational, Symbol, cancel, resultant, sign, symbols

from disting import Model, network_of
from disting.general.any_model import of_network
from disting.general.special_values import lower_degree
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
        assert (eval(condition, {}, numbers) == 0) == is_special
        assert (_at(model, numbers) < max(model.degrees)) == is_special


def test_what_is_not_known_is_not_said() -> None:
    assert lower_degree(Model.from_transfer_function(["a", "-b"], ["1", "c"])) is None
    # the resultant x^2 - 3 x + 1 is linear in nothing
    assert lower_degree(Model.from_transfer_function(["1", "x**2 + 1"], ["1", "3*x"])) is None
