"""All parameters with a given transfer function: literal cases, SymPy and the synthesis of
chains as oracles, refusals.
"""

from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest
import sympy as sp
from flint import fmpq
from hypothesis import assume, given, settings, strategies as st

from disting import Family, InputError
from disting.algebra.groebner.rational import TooLarge, basis
from disting.conditions.rule import Outcome
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target as chain_target
from disting.general.alternatives import AT_ONCE, alternatives
from disting.general.any_model import of_network
from disting.general.fibre import Extent
from disting.general.matrix_model import MatrixModel, Model
from disting.general.target import fibre_equations, rational_values, target
from disting.model.question import Answer, Domain
from disting.network.notation import network_of
from tests.general.certificate import certified

IRREVERSIBLE = Model.from_state_space(
    [["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1], name="irreversible"
)
REVERSIBLE = Model.from_state_space(
    [["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1], name="reversible"
)
SWAP = Model.from_transfer_function("1", "(s + a)*(s + b)", name="swap")
POLE = Model.from_transfer_function("1", "s + k", name="pole")


def counts(found):
    return tuple(
        len(found.within(domain)) for domain in (Domain.COMPLEX, Domain.REAL, Domain.POSITIVE)
    )


def test_rates_without_a_real_equivalent():
    """k21 and k01 are the roots of t^2 - 1.1 t + 1.1, whose discriminant is 1.21 - 4.4."""
    found = alternatives(IRREVERSIBLE, {"k12": 1, "k01": "0.1", "k02": 1}, REVERSIBLE)
    assert (found.extent, counts(found)) == (Extent.FINITE, (2, 0, 0))
    assert found.exist(Domain.COMPLEX) is Outcome.HOLDS
    assert found.exist(Domain.REAL) is found.exist(Domain.POSITIVE) is Outcome.FAILS
    for x in found.equivalents:
        k = x.values["k01"]
        assert abs(k * k - 1.1 * k + 1.1) < 1e-12 and x.values["k12"] == 1 and not x.is_rational
    assert "0 of them real, 0 positive" in found.sentence


def test_rates_with_equivalents():
    found = alternatives(IRREVERSIBLE, {"k12": 1, "k01": 5, "k02": 1}, REVERSIBLE)  # t^2 - 6 t + 6
    assert counts(found) == (2, 2, 2)
    assert [x.values["k01"] for x in found.equivalents] == pytest.approx([3 - 3**0.5, 3 + 3**0.5])
    # k12 + k01 = 1 + .., roots of t^2 - 6 t + 6
    back = alternatives(REVERSIBLE, {"k12": 1, "k01": 2, "k21": 3}, IRREVERSIBLE)
    assert counts(back) == (2, 2, 2)


def test_a_swap_has_two_exact_alternatives():
    found = alternatives(SWAP, {"a": 1, "b": Fraction(1, 2)}, SWAP)
    assert [x.values for x in found.equivalents] == [
        {"a": Fraction(1, 2), "b": Fraction(1)},
        {"a": Fraction(1), "b": Fraction(1, 2)},
    ]
    assert all(x.is_rational and x.domain is Domain.POSITIVE for x in found.equivalents)


def test_a_double_solution_is_one():
    assert [str(x) for x in alternatives(SWAP, {"a": 3, "b": 3}, SWAP).equivalents] == [
        "a = 3, b = 3"
    ]


def test_a_multiple_solution_in_two_directions_is_one():
    """x^2 = x y = y^2 = 0: no linear form spans the algebra, whose dimension is 3, before the
    ideal is made radical.
    """
    target_of = Model.from_transfer_function("g", "s**2 + k*s + m")
    other = Model.from_transfer_function("x**2 + 1", "s**2 + y**2*s + x*y")
    found = alternatives(target_of, {"g": 1, "k": 0, "m": 0}, other)
    assert [(str(x), x.domain) for x in found.equivalents] == [("x = 0, y = 0", Domain.REAL)]


def test_a_transfer_function_that_is_zero_at_these_values():
    other = Model.from_transfer_function("a*b", "s + c")
    found = alternatives(Model.from_transfer_function("g", "s + k"), {"g": 0, "k": 1}, other)
    assert found.extent is Extent.FAMILY and found.excluded == (Domain.POSITIVE,)
    assert all(x.values["a"] * x.values["b"] == 0 for x in found.equivalents)


def test_zero_and_negative_parameters_are_real_and_not_positive():
    found = alternatives(
        POLE, {"k": 2}, Model.from_transfer_function("1", "s + (k - 1)*(k + 2)*k + 2")
    )
    assert [x.values["k"] for x in found.equivalents] == [-2, 0, 1]
    assert [x.domain for x in found.equivalents] == [Domain.REAL, Domain.REAL, Domain.POSITIVE]


def test_a_family():
    gains = Model.from_transfer_function("a*b", "s + c", name="gains")
    found = alternatives(gains, {"a": 2, "b": 3, "c": 1}, gains)
    assert (
        found.extent is Extent.FAMILY
        and len(found.free) in (1, 2)
        and set(found.free) <= {"a", "b"}
    )
    assert all(x.values["a"] * x.values["b"] == 6 and x.values["c"] == 1 for x in found.equivalents)
    assert len(found.equivalents) >= 3 and found.exist(Domain.POSITIVE) is Outcome.HOLDS


def test_families_without_positive_or_real_members():
    sphere = Model.from_transfer_function("1", "s + a**2 + b**2 + 1")
    found = alternatives(POLE, {"k": "1/2"}, sphere)
    assert (found.extent, found.excluded, found.exist(Domain.POSITIVE)) == (
        Extent.FAMILY,
        (Domain.POSITIVE,),
        Outcome.FAILS,
    )
    # true, but one polynomial alone does not show it
    assert found.exist(Domain.REAL) is Outcome.ABANDONED
    imaginary = Model.from_transfer_function("a*b", "s + c**2")
    found = alternatives(Model.from_transfer_function("g", "s + k"), {"g": 1, "k": -1}, imaginary)
    assert (found.extent, found.exist(Domain.REAL)) == (Extent.FAMILY, Outcome.FAILS)
    circle = alternatives(POLE, {"k": 26}, sphere)
    assert circle.exist(Domain.POSITIVE) is not Outcome.FAILS


def test_a_parameter_without_effect_is_free():
    idle = Model.from_transfer_function("k*(s + p)", "(s + p)*(s + k)")
    found = alternatives(idle, {"k": 2, "p": 1}, idle)
    assert (found.extent, found.free, {x.values["k"] for x in found.equivalents}) == (
        Extent.FAMILY,
        ("p",),
        {2},
    )


def test_none_is_proven():
    zero = Model.from_transfer_function("s + b", "s**2 + a*s + c", name="zero")
    found = alternatives(
        SWAP, {"a": 1, "b": 2}, Model.from_transfer_function("s", "s**2 + a*s + c")
    )
    assert (found.extent, counts(found), found.exist(Domain.COMPLEX)) == (
        Extent.NONE,
        (0, 0, 0),
        Outcome.FAILS,
    )
    assert alternatives(zero, {"a": 1, "b": 2, "c": 5}, SWAP).extent is Extent.NONE
    assert alternatives(POLE, {"k": 1}, SWAP).extent is Extent.NONE
    assert "has no parameters, real or complex" in found.sentence


def test_a_mode_that_cancels_at_these_values():
    lead = Model.from_transfer_function("s + a", "(s + b)*(s + c)")
    found = alternatives(lead, {"a": 2, "b": 2, "c": 7}, POLE)
    assert [str(x) for x in found.equivalents] == ["k = 7"]
    again = alternatives(lead, {"a": 2, "b": 2, "c": 7}, lead)
    assert again.extent is Extent.FAMILY
    assert all(x.values["a"] in (x.values["b"], x.values["c"]) for x in again.equivalents)
    assert all(7 in (x.values["b"], x.values["c"]) for x in again.equivalents)


def test_the_order_of_the_searched_model_is_kept():
    """k = m and k (m + 1) = 2 m: m = 1, or m = k = 0 where numerator and denominator are zero
    and no model is left.
    """
    lag = Model.from_transfer_function("k", "m*s + k*(m + 1)")
    found = alternatives(POLE, {"k": 2}, lag)
    assert [x.values for x in found.equivalents] == [{"k": Fraction(1), "m": Fraction(1)}]


BAD = {
    "no value for b": {"a": 1},
    "no parameter c": {"a": 1, "b": 2, "c": 3},
    "0.1 is a float, which is not exact": {"a": 0.1, "b": 2},
    "the value of a is a number, not 'k'": {"a": "k", "b": 2},
    "not of type NoneType": {"a": None, "b": 2},
    "divides by zero": {"a": "1/0", "b": 2},
    "swap: no value for a, b; no parameter x": {"x": 1},
}


@pytest.mark.parametrize(("message", "values"), BAD.items(), ids=range(len(BAD)))
def test_bad_values(message, values):
    with pytest.raises(InputError, match=message):
        alternatives(SWAP, values, SWAP)


def test_a_vanishing_leading_coefficient_is_refused():
    model = Model.from_transfer_function("k", "m*s + k", name="lag")
    with pytest.raises(InputError, match="lag: the leading denominator coefficient is zero"):
        alternatives(model, {"k": 1, "m": 0}, model)


def test_values_are_read_exactly():
    values = {"a": "-1e-1", "b": sp.Rational(2, 7)}
    assert rational_values(SWAP, values) == (("a", Fraction(-1, 10)), ("b", Fraction(2, 7)))
    assert target(SWAP, rational_values(SWAP, {"a": 0, "b": 2.0})).denominator == (0, 2, 1)


def test_alternatives_are_no_truth_value():
    with pytest.raises(TypeError):
        bool(alternatives(POLE, {"k": 1}, POLE))


small = st.integers(-3, 3)


@pytest.mark.full
@given(st.lists(small, min_size=12, max_size=12), st.tuples(small, small))
@settings(max_examples=40, deadline=None)
def test_counts_against_sympy(numbers, place):
    """Two random quadrics through a point: distinct, real and positive intersections by SymPy's
    own elimination.
    """
    x, y, u = sp.symbols("x y u")
    monomials = (x * x, x * y, y * y, x, y, 1)
    quadrics = [
        sum(c * m for c, m in zip(part, monomials, strict=True))
        for part in (numbers[:6], numbers[6:])
    ]
    targets = [q.subs({x: place[0], y: place[1]}) for q in quadrics]
    form = Model.from_transfer_function("g", "s + k")
    assume(targets[0] != 0 and sp.sympify(sum(quadrics)).free_symbols == {x, y})
    other = Model.from_transfer_function([quadrics[0]], [1, quadrics[1]])
    found = alternatives(form, {"g": targets[0], "k": targets[1]}, other)
    ideal = sp.groebner(
        [*(q - t for q, t in zip(quadrics, targets, strict=True)), u - 17 * x - 239 * y],
        x,
        y,
        u,
        order="lex",
    )
    assert (found.extent is Extent.FINITE) == ideal.is_zero_dimensional
    if ideal.is_zero_dimensional:
        last = sp.Poly(ideal.exprs[-1], u).sqf_part()
        assert counts(found)[:2] == (last.degree(), last.count_roots())
        assert any(v.values == {"x": place[0], "y": place[1]} for v in found.equivalents)


@given(
    st.lists(st.integers(1, 9), min_size=3, max_size=3),
    st.lists(st.integers(1, 9), min_size=3, max_size=3),
)
@settings(max_examples=25, deadline=None)
def test_signs_against_sympy(tops, bottoms):
    values = dict(zip(("k01", "k02", "k12"), map(Fraction, tops, bottoms), strict=True))
    found = alternatives(IRREVERSIBLE, values, REVERSIBLE)
    t = sp.Symbol("t")
    k01, k02, k12 = (sp.Rational(v.numerator, v.denominator) for v in values.values())
    equation = sp.Poly(t**2 - (k01 + k02) * t + k02 * (k01 + k12), t)
    roots = equation.sqf_part()
    assert counts(found) == (roots.degree(), roots.count_roots(), roots.count_roots(0, None))


@pytest.mark.full
@given(st.lists(st.integers(1, 20), min_size=6, max_size=6))
@settings(max_examples=15, deadline=None)
def test_every_equivalent_is_certified_alone(numbers):
    cubic = Model.from_transfer_function("1", "s**3 + (a+b+c)*s**2 + (a*b+b*c+2*c*a)*s + a*b*c")
    values = dict(zip("abc", map(Fraction, numbers[:3], numbers[3:]), strict=True))
    goal = target(cubic, rational_values(cubic, values))
    found = alternatives(cubic, values, cubic)
    assert values in [x.values for x in found.equivalents]
    for x in found.equivalents:
        assert certified(x, goal, cubic)
        assert not certified(x, target(cubic, rational_values(cubic, values | {"a": 21})), cubic)


def test_a_wrong_sign_is_not_certified():
    square = Model.from_transfer_function("1", "s + k**2")
    goal = target(POLE, (("k", Fraction(2)),))
    lower, upper = alternatives(POLE, {"k": 2}, square).equivalents
    assert (lower.domain, upper.domain) == (Domain.REAL, Domain.POSITIVE)
    assert certified(lower, goal, square) and certified(upper, goal, square)
    assert not certified(replace(lower, domain=Domain.POSITIVE), goal, square)
    imaginary = alternatives(POLE, {"k": -2}, square).equivalents[0]
    assert not certified(
        replace(imaginary, domain=Domain.REAL), target(POLE, (("k", Fraction(-2)),)), square
    )


@pytest.mark.slow
def test_a_larger_ideal_is_solved_in_a_process_of_its_own_or_given_up():
    two, five = (Model.from_chain(Family(3, damped=True)[i]) for i in (2, 5))
    values = {name: Fraction(1 + 3 * i % 7) for i, name in enumerate(two.parameters)}
    with pytest.raises(TooLarge):
        basis(fibre_equations(target(two, tuple(values.items())), five), 8, AT_ONCE)
    found, itself = alternatives(two, values, five, seconds=600), alternatives(two, values, two)
    assert values in [x.values for x in itself.equivalents]
    assert (found.extent, counts(found)) == (Extent.FINITE, counts(itself))
    given_up = alternatives(two, values, five, seconds=0.01)
    assert (given_up.extent, given_up.exist(Domain.POSITIVE)) == (Extent.UNKNOWN, Outcome.ABANDONED)
    assert "out of time" in given_up.reason and "was not decided" in given_up.sentence


MULTIPORTS = (
    ("1~2~3~4; F1; S1 S2", "1~2, 2~3, 2~4; F1; S1 S2", 2),
    ("1~2~3~4; F1 F2; S2 S1", "1~2, 2~3, 2~4; F1 F2; S2 S1", 2),
    ("1=2~3~4; F1; S1 S2", "1=2, 2~3, 2~4; F1; S1 S2", 2),
    ("1<>2, 1>0; in 1; out 1, 2", "1<>2, 1>0, 2>0; in 1; out 1, 2", 0),
    ("1>2, 1>0, 2>0; in 1; out 1, 2", "1>2, 1>0, 2>0; in 1; out 1, 2", 1),
)


# at which the trees have rational values
RATIONAL = {"m1": 1, "m2": 2, "m3": 3, "m4": 1, "k12": 1, "k23": 5, "k34": 2}


@pytest.mark.full
@pytest.mark.parametrize(("given_text", "other_text", "count"), MULTIPORTS)
def test_several_ports(given_text, other_text, count):
    """All positive sets: each gives every transfer function exactly."""
    one, two = (of_network(network_of(text)) for text in (given_text, other_text))
    values = {n: RATIONAL.get(n, Fraction(i + 2, 5)) for i, n in enumerate(one.parameters)}
    found = alternatives(one, values, two)
    sets = [x.values for x in found.within(Domain.POSITIVE)]
    assert (found.extent is not Extent.UNKNOWN, len(sets)) == (True, count)
    pairs = list(zip(one.entries, two.entries, strict=True))
    for x in sets:
        for here, there in pairs:
            exact = {n: Fraction(v) for n, v in values.items()}
            assert target(here, list(exact.items())) == target(there, list(x.items()))


def test_several_ports_have_what_each_of_them_has():
    """Two sensors are two conditions: the sets of values are those that serve for both."""
    model = MatrixModel.from_transfer_functions([["1/((s + a)*(s + b))"], ["a/((s + a)*(s + b))"]])
    both = alternatives(model, {"a": 2, "b": 3}, model).equivalents
    alone = [
        [x.values for x in alternatives(entry, {"a": 2, "b": 3}, entry).equivalents]
        for entry in model.entries
    ]
    assert [x.values for x in both] == [x for x in alone[0] if x in alone[1]]
    assert [len(both), *map(len, alone)] == [1, 2, 1]


def test_other_ports_are_refused():
    one, two = (of_network(network_of(f"1~2; F1; {s}")) for s in ("S1 S2", "S2"))
    with pytest.raises(InputError, match="other numbers of inputs and outputs"):
        alternatives(one, {"m1": 1, "m2": 1, "k12": 1}, two)


@pytest.mark.full
@pytest.mark.parametrize("numbers", [(3, 7, 2, 5, 11), (1, 2, 9, 4, 6)])
def test_undamped_chains_against_inverse_synthesis(numbers):
    """Engine A finds the same fibres by peeling masses and springs in ball arithmetic (elements
    that are zero excepted).
    """
    family = list(Family(3, damped=False))
    models = [Model.from_chain(chain) for chain in family]
    seen = []
    for (one, chain), (other, searched) in product(zip(models, family, strict=True), repeat=2):
        values = dict(zip(one.parameters, numbers, strict=True))
        expected = fibre(
            searched, chain_target(chain.structure, {name: fmpq(x) for name, x in values.items()})
        )
        if expected.status not in (Status.COMPLETE, Status.EMPTY):
            continue
        found = [
            x for x in alternatives(one, values, other).equivalents if all(map(any, x.coordinates))
        ]
        answers = [(s.real is Answer.YES, s.positive is Answer.YES) for s in expected.solutions]
        mine = [(x.domain is not Domain.COMPLEX, x.domain is Domain.POSITIVE) for x in found]
        assert sorted(mine) == sorted(answers), (chain, searched)
        seen.append(len(mine))
    assert len(seen) > 50 and max(seen) > 1
